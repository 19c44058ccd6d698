# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the cases that ranks run under mpirun share: updates, and comparisons over all ranks."""
from mpi4py import MPI
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController

import delaunayflip
import rank_meshes

WORLD = MPI.COMM_WORLD
RANK, RANKS = WORLD.rank, WORLD.size


def start():
    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    return controller


def set_options(flip, options):
    for name, value in options.items():
        getattr(flip, "Set" + name)(value)
    return flip


def listen(flip):
    said = []

    def note(_caller, _event, text):
        said.append(text)

    note.CallDataType = "string0"
    flip.AddObserver("ErrorEvent", note)
    flip.AddObserver("WarningEvent", note)
    return said


def flip_piece(piece, options):
    flip = set_options(delaunayflip.vtkPDelaunayFlip(), options)
    flip.SetInputData(piece)
    said = listen(flip)
    flip.UpdatePiece(RANK, RANKS, 0)
    return flip, said


def make_own_piece(points, triangles, kind, ids=True):
    """This rank's piece of a mesh that is divided in a way of rank_meshes.divide."""
    slots = np.flatnonzero(rank_meshes.divide(points, triangles, RANKS, kind) == RANK)
    return rank_meshes.make_piece(points, triangles, slots, ids)


def describe(flip, said):
    return {
        "flips": flip.GetTotalFlips(), "left": flip.GetNonDelaunayAfter(),
        "rounds": flip.GetNumberOfRounds() if isinstance(flip, delaunayflip.vtkPDelaunayFlip) else 0,
        "stopped": flip.GetStopReasonAsString(), "geometry": flip.GetGeometryUsedAsString(),
        "constraints": flip.GetNumberOfConstraintEdges(),
        "unmatched": flip.GetNumberOfUnmatchedConstraints(), "error": flip.GetErrorMessage(),
        "iterations": flip.GetNumberOfIterations(), "said": said}


def require(condition, text):
    if not condition:
        raise AssertionError(f"rank {RANK}: {text}")


def require_same(facts):
    for other in WORLD.allgather(facts):
        require(other == facts, f"ranks differ: {other} {facts}")


def find_ids(points, found):
    """The ids in the whole mesh of points at the same places."""
    ids = {tuple(x): i for i, x in enumerate(points)}
    return np.array([ids[tuple(x)] for x in found], np.int64)


def check_data(points, output):
    """Every triangle and point has the data that it had."""
    if output.GetNumberOfPolys() == 0:
        return
    slots = vtk_to_numpy(output.GetCellData().GetArray("slot"))
    names = output.GetCellData().GetAbstractArray("name")
    variants = output.GetCellData().GetAbstractArray("variant")
    for cell, slot in enumerate(slots):
        require(names.GetValue(cell) == f"triangle {slot}", "a name is lost")
        found, given = variants.GetValue(cell), rank_meshes.make_variant(slot)
        require(found.GetType() == given.GetType() and found == given, f"the variant of {slot} became {found!r}")
    cells, points = output.GetCellData(), output.GetPointData()
    require(cells.GetScalars() is cells.GetPedigreeIds() is not None, "an attribute is lost")
    arrays = [points.GetArray(i) for i in range(points.GetNumberOfArrays())]
    heights = [vtk_to_numpy(array) for array in arrays if array.GetName() in (None, "height")]
    require(len(heights) == 2, f"{len(heights)} arrays of heights")
    for values in heights:
        require(np.array_equal(values, rank_meshes.read_points(output) @ [1.0, 2.0, 3.0]),
                "point data are lost")


def gather_triangles(points, output):
    """The triangles of all ranks by ids of the whole mesh, and their slots; on rank 0."""
    ids = find_ids(points, rank_meshes.read_points(output))
    triangles = rank_meshes.read_triangles(output)
    own = ids[triangles] if len(triangles) else triangles
    slots = output.GetCellData().GetArray("slot")
    parts = WORLD.gather((own, vtk_to_numpy(slots) if slots else np.zeros(0, np.int64)))
    if RANK == 0:
        return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])
    return None, None


def flip_alone(points, triangles, options):
    flip = set_options(delaunayflip.vtkDelaunayFlip(), options)
    flip.SetInputData(rank_meshes.make_poly_data(points, triangles))
    flip.Update()
    return flip


def same(points, triangles, kind="space", ids=True, options=None, unique=True):
    """Flips this rank's piece of a mesh, and compares the pieces with a run of one rank."""
    options = options or {}
    flip, _ = flip_piece(make_own_piece(points, triangles, kind, ids), options)
    output = flip.GetOutput()
    check_data(points, output)
    facts = describe(flip, [])
    require_same(facts)
    after, slots = gather_triangles(points, output)
    if RANK == 0:
        require(np.array_equal(np.sort(slots), np.arange(len(triangles))), "triangles are lost")
        alone = flip_alone(points, triangles, options)
        if unique:
            facts["same"] = rank_meshes.are_same(after, alone.GetOutput())
        again = flip_alone(points, after, {**options, "FeatureAngle": 180.0})
        facts["again"] = again.GetTotalFlips()
        facts["left again"] = again.GetNonDelaunayAfter()
        facts["geometry alone"] = alone.GetGeometryUsedAsString()
    return facts
