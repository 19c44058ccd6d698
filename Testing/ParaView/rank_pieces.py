# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What parallel_cases.py runs on the ranks: makes their pieces and writes their results."""

import json
import os

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TRIANGLE, vtkPolyData, vtkStructuredGrid, vtkUnstructuredGrid)
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from surfaces import convert_surface, get_triangles, make_cells, make_fan, make_lattice


def cut(mesh, rank, ranks):
    """The cells of a mesh that a rank has, next to each other, with the points that they need."""
    cells = get_triangles(mesh)
    own = cells[len(cells) * rank // ranks:len(cells) * (rank + 1) // ranks]
    ids = sorted({i for cell in own for i in cell})
    new = {old: i for i, old in enumerate(ids)}
    piece = vtkPolyData()
    piece.SetPoints(vtkPoints())
    for i in ids:
        piece.GetPoints().InsertNextPoint(mesh.GetPoint(i))
    piece.SetPolys(make_cells([[new[i] for i in cell] for cell in own]))
    return piece


def cut_lattice(size, rank, ranks):
    """The rows of a sheared lattice that a rank has, as a structured grid."""
    first, last = ((size - 1) * r // ranks for r in (rank, rank + 1))
    grid = vtkStructuredGrid()
    grid.SetDimensions(size, last - first + 1, 1)
    lattice = make_lattice(size)
    grid.SetPoints(vtkPoints())
    for i in range(first * size, (last + 1) * size):
        grid.GetPoints().InsertNextPoint(lattice.GetPoint(i))
    return grid


def make_piece(size, kind, rank, ranks):
    """The piece of a rank of a mesh. Image data are on one rank."""
    if size == 0 or kind == "vtkImageData":
        return convert_surface(size, kind) if size else vtkPolyData()
    if kind == "vtkStructuredGrid":
        return cut_lattice(size, rank, ranks)
    mesh = cut(make_fan(abs(size)), rank, ranks)
    if size < 0 and rank == ranks - 1:
        mesh.SetPolys(make_cells([(0, 1, 77)]))
    if kind is None:
        return mesh
    grid = vtkUnstructuredGrid()
    grid.SetPoints(mesh.GetPoints())
    grid.SetCells(VTK_TRIANGLE, mesh.GetPolys())
    return grid


def make_pieces(output, sizes, kinds, alone):
    """Run by every rank for parallel_cases.py. A mesh of `alone` is on the last rank only."""
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    for block, size in sizes.items():
        own = (rank, ranks)
        if block in alone:
            own = (0, 1) if rank == ranks - 1 else None
        piece = make_piece(size, kinds.get(block), *own) if own else None
        if output.IsA("vtkMultiBlockDataSet"):
            output.SetBlock(block, piece)
        elif piece:
            output.ShallowCopy(piece)


def list_leaves(data):
    """The meshes of a dataset, by their blocks."""
    if not data.IsA("vtkMultiBlockDataSet"):
        return {0: data}
    leaves = {i: data.GetBlock(i) for i in range(data.GetNumberOfBlocks())}
    return {i: leaf for i, leaf in leaves.items() if leaf}


def describe_leaf(leaf):
    """The triangles of a mesh, by the places of their corners, and its field data."""
    data = leaf.GetFieldData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    values = {name: data.GetAbstractArray(name) for name in names}
    return {
        "triangles": [[leaf.GetPoint(i) for i in cell] for cell in get_triangles(leaf)],
        "field": {name: [str(array.GetVariantValue(i)) for i in range(array.GetNumberOfValues())]
                  for name, array in values.items()}}


def write_rank(data, folder):
    """Run by every rank for parallel_cases.py: writes the rank's meshes."""
    rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
    with open(os.path.join(folder, f"{rank}.json"), "w", encoding="utf-8") as file:
        json.dump({str(block): describe_leaf(leaf)
                   for block, leaf in list_leaves(data).items()}, file)
