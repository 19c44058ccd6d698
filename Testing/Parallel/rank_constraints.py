# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of constraints that ranks insert."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import delaunayflip
import rank_meshes
from rank_runs import (
    RANK, RANKS, describe, gather_triangles, listen, require, require_same, set_options)


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def cross(points, one, other):
    a, b, c, d = points[[*one, *other]]
    return turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0


def draw_pairs(points, triangles, owners, count, are_within):
    """Other diagonals of quads, which do not cross each other: those of two triangles of one rank,
    or of two ranks."""
    opposite, quads, pairs = {}, [], []
    for triangle, owner in zip(triangles, owners):
        for i in range(3):
            edge = frozenset((triangle[i - 2], triangle[i - 1]))
            if edge in opposite:
                other, other_owner = opposite[edge]
                if (owner == other_owner) == are_within:
                    quads.append((np.array(sorted(edge)), np.array([triangle[i], other])))
            opposite[edge] = triangle[i], owner
    for place in np.random.default_rng(5).permutation(len(quads)):
        edge, pair = quads[place]
        if len(pairs) < count and cross(points, edge, pair) and not any(
                cross(points, pair, known) for known in pairs):
            pairs.append(pair)
    return np.array(pairs, int).reshape(-1, 2)


def describe_all(flip):
    return {**describe(flip, []), "inserted": flip.GetNumberOfInsertedConstraints()}


def add_lines(piece, used, points, pairs):
    """Gives the piece lines, and the points that these need but its triangles do not use."""
    ends = np.unique(pairs)
    more = np.setdiff1d(ends, used)
    used = np.r_[used, more]
    whole = rank_meshes.make_poly_data(points[used], rank_meshes.read_triangles(piece))
    place = {point: i for i, point in enumerate(used)}
    lines = vtkCellArray()
    for pair in pairs:
        lines.InsertNextCell(2, [place[end] for end in pair])
    whole.SetLines(lines)
    slots = np.r_[np.full(len(pairs), -1),
                  vtk_to_numpy(piece.GetCellData().GetArray("slot"))]
    rank_meshes.add_array(whole.GetCellData(), "slot", slots.astype(np.int64))
    return whole, used


def make_case(points, triangles, pairs, kind, given, ids):
    """This rank's filter with its piece and its constraints."""
    owners = rank_meshes.divide(points, triangles, RANKS, kind)
    slots = np.flatnonzero(owners == RANK)
    piece = rank_meshes.make_piece(points, triangles, slots, False)
    used = np.unique(triangles[slots])
    flip = delaunayflip.vtkPDelaunayFlip()
    if given == "lines":
        set_options(flip, {"LinesAsConstraints": True, "InsertLines": True})
        if len(slots):
            piece, used = add_lines(piece, used, points, pairs[RANK // 2 % 2::2])
    elif given == "parts":
        flip.SetConstraintsData(rank_meshes.make_lines(points, pairs[RANK % 2:]))
    else:
        flip.SetConstraintsData(
            rank_meshes.make_lines(points, pairs) if RANK == 0 else vtkPolyData())
    if ids and len(slots):
        numbers = rank_meshes.numpy_to_vtkIdTypeArray(used.astype(np.int64), deep=1)
        piece.GetPointData().SetGlobalIds(numbers)
    flip.SetInputData(piece)
    return flip


def run_alone(points, triangles, pairs, options):
    flip = set_options(delaunayflip.vtkDelaunayFlip(), options)
    flip.SetInputData(rank_meshes.make_poly_data(points, triangles))
    flip.SetConstraintsData(rank_meshes.make_lines(points, pairs))
    flip.Update()
    return flip


def compare_inserted(points, triangles, pairs, kind, given="rank 0", ids=True, across=()):
    """Compares with a run of one process that has no constraints across ranks."""
    options = {"TieRule": 1, "NumberOfThreads": 1}
    whole = np.r_[pairs, across] if len(across) else pairs
    flip = set_options(make_case(points, triangles, whole, kind, given, ids), options)
    said = listen(flip)
    flip.UpdatePiece(RANK, RANKS, 0)
    facts = describe_all(flip)
    require_same(facts)
    output = vtkPolyData()
    output.SetPoints(flip.GetOutput().GetPoints())
    output.SetPolys(flip.GetOutput().GetPolys())
    slots = flip.GetOutput().GetCellData().GetArray("slot")
    if slots:
        own = vtk_to_numpy(slots)
        rank_meshes.add_array(output.GetCellData(), "slot", own[own >= 0])
    after, slots = gather_triangles(points, output)
    if RANK == 0:
        require(np.array_equal(np.sort(slots), np.arange(len(triangles))), "triangles are lost")
        alone = run_alone(points, triangles, pairs, options)
        facts["alone"] = describe_all(alone)
        facts["same"] = rank_meshes.are_same(after, alone.GetOutput())
        facts["said"] = " ".join(said)
    return facts


def run_inserted(count, pairs, across, kind, **arguments):
    """Random constraints that do not cross each other, within ranks and across them."""
    points, triangles = rank_meshes.make_random(count)
    owners = rank_meshes.divide(points, triangles, RANKS, kind)
    within = draw_pairs(points, triangles, owners, pairs, True)
    between = draw_pairs(points, triangles, owners, across, False)
    facts = compare_inserted(points, triangles, within, kind, across=between, **arguments)
    return {**facts, "across": len(between)}
