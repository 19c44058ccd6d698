# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The cases of composite datasets that ranks run under mpirun: a leaf is a mesh of which each rank may
have a piece."""
import numpy as np
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet,
    vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData)

import delaunayflip
import rank_meshes
from rank_runs import (
    RANK, RANKS, WORLD, check_data, describe, flip_alone, listen, require, require_same,
    set_options)

OPTIONS = {"TieRule": 1, "NumberOfThreads": 1}


def make_mesh(number):
    points, triangles = rank_meshes.make_random(150 + 50 * number, number)
    return points + [2.0 * number, 0.0, 0.0], triangles


def cut(number, first=0):
    """The piece of this rank of a mesh that the ranks from `first` on have; None if it has none."""
    points, triangles = make_mesh(number)
    owners = first + rank_meshes.divide(points, triangles, RANKS - first, "space")
    slots = np.flatnonzero(owners == RANK)
    return rank_meshes.make_piece(points, triangles, slots, True) if len(slots) else None


def make_solid():
    solid = vtkImageData()
    solid.SetDimensions(3, 3, 3)
    return solid


def make_blocks():
    """Mesh 0; no surface; and, one level down, mesh 1 on all ranks but the first, mesh 2 on one."""
    inner = vtkMultiBlockDataSet()
    inner.SetBlock(0, cut(1, 1))
    inner.SetBlock(1, cut(2, RANKS - 1))
    inner.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), "wing")
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, cut(0))
    blocks.SetBlock(1, make_solid() if RANK > 0 else None)
    blocks.SetBlock(2, inner)
    return blocks


def make_partitions(number=0):
    """The pieces at places that differ from rank to rank, after partitions without cells."""
    partitions = vtkPartitionedDataSet()
    partitions.SetNumberOfPartitions(RANK + 1)
    for i in range(RANK):
        partitions.SetPartition(i, vtkPolyData() if i % 2 else None)
    partitions.SetPartition(RANK, cut(number))
    return partitions


def make_collection():
    collection = vtkPartitionedDataSetCollection()
    for number in range(3):
        collection.SetPartitionedDataSet(number, make_partitions(number))
    return collection


def make_some_partitions(counts, kind="space", ids=True):
    """Rank r has counts[r] pieces of a mesh."""
    points, triangles = make_mesh(0)
    owners = rank_meshes.divide(points, triangles, sum(counts), kind)
    first = sum(counts[:RANK])
    partitions = vtkPartitionedDataSet()
    for i in range(counts[RANK]):
        slots = np.flatnonzero(owners == first + i)
        piece = rank_meshes.make_piece(points, triangles, slots, ids)
        partitions.SetPartition(i + RANK, piece)
    return partitions


MAKERS = {
    "blocks": make_blocks, "partitions": make_partitions, "collection": make_collection,
    "two partitions": lambda: make_some_partitions([2] * RANKS),
    # None, one, two and so on. Those of several ranks are between those of one.
    "uneven partitions": lambda: make_some_partitions(range(RANKS), "scattered"),
    "anonymous partitions": lambda: make_some_partitions([3] * RANKS, "scattered", False)}


def list_leaves(data):
    leaves, iterator = [], data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


def find_number(mesh):
    """The number of the mesh that a leaf is a piece of, by its place."""
    return int(mesh.GetPoint(0)[0] // 2.0)


def join_places(leaves):
    """The triangles of all ranks, by their corners, for each mesh."""
    own = []
    for leaf in leaves:
        if leaf.IsA("vtkPolyData") and leaf.GetNumberOfPolys():
            corners = rank_meshes.read_points(leaf)[rank_meshes.read_triangles(leaf)]
            own.append((find_number(leaf), corners))
    joined = {}
    for number, corners in (leaf for part in WORLD.allgather(own) for leaf in part):
        joined.setdefault(number, []).append(corners)
    return {number: np.concatenate(parts) for number, parts in joined.items()}


def is_same(number, corners, alone=None):
    """Whether the triangles of all ranks are those of one."""
    points, triangles = make_mesh(number)
    ids = {tuple(x): i for i, x in enumerate(points)}
    found = np.array([[ids[tuple(x)] for x in triangle] for triangle in corners])
    alone = alone or flip_alone(points, triangles, OPTIONS)
    return rank_meshes.are_same(found, alone.GetOutput())


def update(data, prepare=lambda flip: None):
    flip = set_options(delaunayflip.vtkPDelaunayFlip(), OPTIONS)
    flip.SetInputData(data)
    prepare(flip)
    said = listen(flip)
    flip.UpdatePiece(RANK, RANKS, 0)
    facts = describe(flip, [])
    require_same(facts)
    require(not said or RANK == 0, f"rank {RANK} said {said}")
    return flip, {**facts, "said": said}


def run_composite(kind):
    """Compares the leaves with runs of one rank; the field data are those of a leaf."""
    data = MAKERS[kind]()
    flip, facts = update(data)
    output = flip.GetOutputDataObject(0)
    require(output.GetClassName() == data.GetClassName(), output.GetClassName())
    given, leaves = list_leaves(data), list_leaves(output)
    require([leaf.GetClassName() for leaf in leaves] == [leaf.GetClassName() for leaf in given],
            "other leaves")
    joined = join_places(leaves)
    facts["same"] = [is_same(number, joined[number]) for number in sorted(joined)]
    if kind.endswith(" partitions"):
        for leaf in leaves:
            check_data(make_mesh(0)[0], leaf)
        facts["partitions"] = sum(WORLD.allgather(len(leaves)))
    facts["triangles"] = [len(joined[number]) for number in sorted(joined)]
    facts["flips of leaves"] = sorted(set(WORLD.allreduce(
        [int(leaf.GetFieldData().GetArray("DelaunayFlip:TotalFlips").GetValue(0))
         for leaf in leaves if leaf.GetFieldData().GetArray("DelaunayFlip:TotalFlips")])))
    facts["rows"] = flip.GetIterations().GetNumberOfRows()
    return facts


def run_failing_block():
    """Mesh 1 is broken on rank 1: its leaves are empty, the others are flipped."""
    data = make_blocks()
    if RANK == 1:
        wrong = np.array([[0, 1, 7777]])
        wing = data.GetBlock(2).GetBlock(0)
        wing.SetPolys(rank_meshes.make_poly_data(rank_meshes.read_points(wing), wrong).GetPolys())
        wing.GetCellData().Initialize()
    flip, facts = update(data)
    facts["meshes"] = sorted(join_places(list_leaves(flip.GetOutputDataObject(0))))
    return facts


def run_mixed_kinds():
    """One rank has composite data, the others a mesh."""
    return update(make_blocks() if RANK == 0 else cut(0))[1]


def run_constraints_of_blocks(kind):
    """Constraints of mesh 0, which rank 0 has: for its block alone, or for all blocks."""
    points, triangles = make_mesh(0)
    lines = rank_meshes.make_lines(points, triangles[::9, :2])
    constraints = lines if RANK == 0 else vtkPolyData()
    if kind == "composite":
        constraints = vtkMultiBlockDataSet()
        constraints.SetNumberOfBlocks(4)
        constraints.SetBlock(0, lines if RANK == 0 else None)
        constraints.SetBlock(3, lines if RANK == 1 else None)

    def prepare(flip):
        flip.SetInsertConstraints(False)
        flip.SetInputDataObject(1, constraints)

    flip, facts = update(make_blocks(), prepare)
    alone = set_options(delaunayflip.vtkDelaunayFlip(), OPTIONS)
    alone.SetInputData(rank_meshes.make_poly_data(points, triangles))
    alone.SetInsertConstraints(False)
    alone.SetConstraintsData(lines)
    alone.Update()
    facts["constraints alone"] = alone.GetNumberOfConstraintEdges()
    corners = join_places(list_leaves(flip.GetOutputDataObject(0)))[0]
    facts["same"] = is_same(0, corners, alone)
    return facts
