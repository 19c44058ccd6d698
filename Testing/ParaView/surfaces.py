# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the plugin's tests, whole or in pieces on ranks. Imports nothing of ParaView, so
servers can run it."""

import json
import os

from vtkmodules.vtkCommonCore import vtkIdList, vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def make_cells(cells):
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), cell)
    return array


def make_fan(number_of_points):
    """Points on a parabola, all connected to the last one: the worst case, about n^2 / 2 flips.

    Its cell array Side distinguishes the triangles of the left half from those of the right.
    """
    points = vtkPoints()
    for i in range(number_of_points):
        points.InsertNextPoint(i, 0.1 * i * i, 0.0)
    last = number_of_points - 1
    triangles = [(last, i, i + 1) for i in range(last - 1)]
    sides = vtkIntArray()
    sides.SetName("Side")
    for triangle in triangles:
        sides.InsertNextValue(int(2 * triangle[1] >= number_of_points))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(make_cells(triangles))
    mesh.GetCellData().AddArray(sides)
    return mesh


def make_lattice(side, shear=0.7):
    """side x side points in a sheared lattice, row by row, and the quads between them."""
    points = vtkPoints()
    for i in range(side * side):
        points.InsertNextPoint(i % side + shear * (i // side), i // side, 0.0)
    corners = [x + side * y for y in range(side - 1) for x in range(side - 1)]
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(make_cells([(i, i + 1, i + side + 1, i + side) for i in corners]))
    return mesh


def get_triangles(mesh):
    ids = vtkIdList()
    result = []
    for i in range(mesh.GetPolys().GetNumberOfCells()):
        mesh.GetPolys().GetCellAtId(i, ids)
        result.append(tuple(ids.GetId(k) for k in range(ids.GetNumberOfIds())))
    return result


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


def get_rank():
    """The number of this rank, and of all."""
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


def make_piece(output, size, broken):
    """Run by every rank for parallel_cases.py: its piece of a fan. The last one may be broken."""
    rank, ranks = get_rank()
    mesh = cut(make_fan(size), rank, ranks)
    if broken and rank == ranks - 1:
        mesh.SetPolys(make_cells([(0, 1, 77)]))
    output.ShallowCopy(mesh)


def write_rank(mesh, folder):
    """Run by every rank: writes its triangles, by the places of their corners, and field data."""
    data = mesh.GetFieldData()
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    result = {
        "triangles": [[mesh.GetPoint(i) for i in cell] for cell in get_triangles(mesh)],
        "field": {array.GetName(): [str(array.GetVariantValue(i))
                                    for i in range(array.GetNumberOfValues())] for array in arrays}}
    with open(os.path.join(folder, f"{get_rank()[0]}.json"), "w", encoding="utf-8") as file:
        json.dump(result, file)
