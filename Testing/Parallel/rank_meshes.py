# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of the tests under mpirun, the same in every process, and how they are divided."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def make_random(count, seed=1):
    """Points in a square, each of which splits the triangle that holds it: a bad mesh."""
    points = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    triangles, children = [(0, 1, 2), (0, 2, 3)], {}

    def turn(a, b, p):
        return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])

    def holds(triangle, p):
        a, b, c = (points[i] for i in triangles[triangle])
        return turn(a, b, p) > 0 and turn(b, c, p) > 0 and turn(c, a, p) > 0

    for p in np.random.default_rng(seed).random((count, 2)):
        at = 0 if holds(0, p) else 1
        while at in children:
            at = next((c for c in children[at] if holds(c, p)), None)
        if at is None or not holds(at, p):
            continue
        new, first = len(points), len(triangles)
        points.append(tuple(p))
        a, b, c = triangles[at]
        triangles += [(a, b, new), (b, c, new), (c, a, new)]
        children[at] = (first, first + 1, first + 2)
    leaves = [t for t in range(len(triangles)) if t not in children]
    return np.c_[np.array(points), np.zeros(len(points))], np.array([triangles[t] for t in leaves])


def make_bumps(count, seed=1):
    """The same as a surface with steep bumps."""
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
