# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run by tests under mpirun: flip_on_ranks.py CASE ARGUMENTS FILE

ARGUMENTS is JSON. Rank 0 writes what it finds to FILE, as JSON. A rank that finds something wrong
ends the job with a traceback.
"""
import json
import sys
import traceback

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes
from vtkmodules.vtkParallelCore import vtkMultiProcessController

import rank_blocks
import rank_constraints
import rank_meshes
from rank_runs import (
    RANK, RANKS, WORLD, describe, flip_alone, flip_piece, gather_triangles, make_own_piece, require,
    same, start)


def run_same(maker, count, kind, ids, options, unique=True):
    points, triangles = getattr(rank_meshes, maker)(count)
    return same(points, triangles, kind, ids, options, unique)


def run_ghosts(count, wrong=None):
    """Every piece also has the neighbours' triangles at its border, as duplicate ghosts. On rank
    `wrong` the ghost array has two components."""
    points, triangles = rank_meshes.make_random(count)
    owners = rank_meshes.divide(points, triangles, RANKS, "space")
    touched = np.isin(triangles, triangles[owners == RANK]).any(1)
    slots = np.flatnonzero(touched)
    piece = rank_meshes.make_piece(points, triangles, slots, True)
    ghosts = np.where(owners[slots] == RANK, 0, vtkDataSetAttributes.DUPLICATECELL)
    ghosts = np.stack([ghosts] * 2, 1) if RANK == wrong else ghosts
    rank_meshes.add_array(piece.GetCellData(), "vtkGhostType", ghosts.astype(np.uint8))
    flip, said = flip_piece(piece, {"TieRule": 1})
    after, slots = gather_triangles(points, flip.GetOutput())
    facts = describe(flip, said)
    if RANK == 0:
        alone = flip_alone(points, triangles, {"TieRule": 1})
        facts["same"] = rank_meshes.are_same(after, alone.GetOutput())
    return facts


def run_missing_data():
    """Rank 1 lacks the cell data of rank 0, but gets triangles from it."""
    points, triangles = rank_meshes.make_random(200)
    piece = make_own_piece(points, triangles, "scattered")
    if RANK == 1:
        piece.GetCellData().Initialize()
    flip, said = flip_piece(piece, {})
    cells = flip.GetOutput().GetCellData()
    require(cells.GetScalars() is cells.GetPedigreeIds() is not None, "an attribute is lost")
    return describe(flip, said)


def run_slit(ids):
    """Two points of rank 0 are at the same place, at the two sides of a slit; rank 1 has one of them."""
    points = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0, 0, 0], [0.5, -1, 0], [-1, 1, 0.0]])
    slots = np.array([2] if RANK == 1 else [0, 1])
    triangles = np.array([[0, 1, 2], [3, 4, 1], [0, 2, 5]])
    return describe(*flip_piece(rank_meshes.make_piece(points, triangles, slots, ids), {}))


def run_failure(rank, wrong):
    """One rank has a triangle that names a point which does not exist, or an option is wrong."""
    points, triangles = rank_meshes.make_random(200)
    piece = make_own_piece(points, triangles, "space")
    options = {}
    if RANK == rank and wrong == "point":
        cells = rank_meshes.read_triangles(piece).copy()
        cells[3, 1] = 7777
        piece.SetPolys(rank_meshes.make_poly_data(points, cells).GetPolys())
    if wrong == "regions":
        options["RegionArray"] = "missing"
    flip, said = flip_piece(piece, options)
    require(flip.GetOutput().GetNumberOfCells() == 0, "output after an error")
    errors = WORLD.allgather(flip.GetErrorMessage())
    require(len(set(errors)) == 1, f"different messages: {errors}")
    require((len(said) > 0) == (RANK == 0), f"messages of rank {RANK}: {said}")
    facts = describe(flip, said)
    flip.SetInputData(make_own_piece(points, triangles, "space"))
    flip.SetRegionArray("")
    flip.UpdatePiece(RANK, RANKS, 0)
    facts["then"] = flip.GetStopReasonAsString()
    return facts


def main():
    controller = start()
    name, arguments = sys.argv[1], json.loads(sys.argv[2])
    cases = {**vars(rank_blocks), **vars(rank_constraints), **globals()}
    facts = cases["run_" + name](**arguments)
    if RANK == 0:  # not to stdout, where mpirun may put words of other ranks into the line
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            json.dump(facts, file)
    vtkMultiProcessController.SetGlobalController(None)
    del controller


try:
    main()
except BaseException:  # or the other ranks would wait
    traceback.print_exc()
    sys.stderr.flush()
    WORLD.Abort(1)
