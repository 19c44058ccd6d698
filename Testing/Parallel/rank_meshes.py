# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the tests under mpirun, the same in every process, and how they are divided."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray, vtkVariant, vtkVariantArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import delaunayflip


def make_random(count, seed=1):
    """A bad mesh of points in a square: the strips that a triangulation starts from."""
    points = np.r_[np.random.default_rng(seed).random((count, 2)), [[0, 0], [1, 0], [1, 1], [0, 1]]]
    strips = delaunayflip.triangulate(points, maximum_iterations=0).triangles
    return np.c_[points, np.zeros(len(points))], strips


def make_bumps(count, seed=1):
    """A random mesh as a surface with steep bumps."""
    points, triangles = make_random(count, seed)
    points[:, 2] = 0.3 * np.sin(9 * points[:, 0]) * np.cos(7 * points[:, 1])
    return points, triangles


def divide(points, triangles, ranks, kind):
    """The rank of every triangle."""
    centers = points[triangles].mean(1)
    if kind == "scattered":
        return np.random.default_rng(3).integers(0, ranks, len(triangles))
    if kind == "one has all":
        return np.full(len(triangles), ranks - 1)
    order = np.argsort(centers[:, 0], kind="stable")
    owners = np.empty(len(triangles), int)
    owners[order] = np.arange(len(triangles)) * ranks // len(triangles)
    if kind == "one is empty":
        owners[owners == 1] = 0
    return owners


def make_poly_data(points, triangles):
    mesh, at, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    at.SetData(numpy_to_vtk(points, deep=1))
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel().astype(np.int64), deep=1))
    mesh.SetPoints(at)
    mesh.SetPolys(cells)
    return mesh


def make_lines(points, pairs):
    lines, at, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    at.SetData(numpy_to_vtk(points[pairs.ravel()], deep=1))
    cells.SetData(2, numpy_to_vtkIdTypeArray(np.arange(pairs.size, dtype=np.int64), deep=1))
    lines.SetPoints(at)
    lines.SetLines(cells)
    return lines


def add_array(data, name, values):
    array = numpy_to_vtk(values, deep=1)
    array.SetName(name)
    data.AddArray(array)
    return array


def make_variant(slot):
    """A number of many digits, a text, an integer of 64 bits, or nothing."""
    values = slot + 0.123456789, f"text {slot}", 2**60 + int(slot)
    return vtkVariant(values[slot % 4]) if slot % 4 < 3 else vtkVariant()


def make_piece(points, triangles, slots, ids):
    """The piece with the triangles `slots`, their data, an array without a name and, if `ids`, global
    point ids. Its points are only those that it needs."""
    used, local = np.unique(triangles[slots], return_inverse=True)
    piece = make_poly_data(points[used], local.reshape(-1, 3))
    if len(slots) == 0:
        return vtkPolyData()
    for name in (None, "height"):
        add_array(piece.GetPointData(), name, points[used] @ [1.0, 2.0, 3.0])
    add_array(piece.GetCellData(), "slot", np.asarray(slots, np.int64))
    piece.GetCellData().SetActiveScalars("slot")
    piece.GetCellData().SetActivePedigreeIds("slot")
    names = vtkStringArray()
    names.SetName("name")
    for slot in slots:
        names.InsertNextValue(f"triangle {slot}")
    piece.GetCellData().AddArray(names)
    variants = vtkVariantArray()
    variants.SetName("variant")
    for slot in slots:
        variants.InsertNextValue(make_variant(slot))
    piece.GetCellData().AddArray(variants)
    if ids:
        numbers = numpy_to_vtkIdTypeArray(used.astype(np.int64), deep=1)
        numbers.SetName("GlobalPointIds")
        piece.GetPointData().SetGlobalIds(numbers)
    return piece


def read_triangles(mesh):
    if mesh.GetNumberOfPolys() == 0:
        return np.zeros((0, 3), np.int64)
    return vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def read_points(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData()) if mesh.GetPoints() else np.zeros((0, 3))


def are_same(triangles, mesh):
    """Whether a mesh has these triangles, whatever their order and first corner."""
    return bool(np.array_equal(as_set(triangles), as_set(read_triangles(mesh))))


def as_set(triangles):
    """The triangles of an array of ids, whatever their order and first corner."""
    first = np.argmin(triangles, 1)[:, None]
    turned = np.take_along_axis(triangles, (first + np.arange(3)) % 3, 1)
    return turned[np.lexsort(turned.T[::-1])]
