# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh for the live viewer to improve."""
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

RIM, SPLITS = 3, 300


def make_bad_mesh():
    """A fan in a square, each of its triangles split into three again and again: slivers."""
    points = [(0.44, 0.53)]
    for x, y, dx, dy in ((0, 0, 1, 0), (1, 0, 0, 1), (1, 1, -1, 0), (0, 1, 0, -1)):
        points += [(x + dx * i / RIM, y + dy * i / RIM) for i in range(RIM)]
    triangles = [(0, 1 + i, 1 + (i + 1) % (4 * RIM)) for i in range(4 * RIM)]
    for i in range(SPLITS):
        a, b, c = triangles[i]
        points.append([0.28 * points[a][k] + 0.33 * points[b][k] + 0.39 * points[c][k]
                       for k in range(2)])
        p = len(points) - 1
        triangles += [(a, b, p), (b, c, p), (c, a, p)]
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    for x, y in points:
        mesh.GetPoints().InsertNextPoint(x, y, 0)
    mesh.SetPolys(vtkCellArray())
    for triangle in triangles[SPLITS:]:
        mesh.GetPolys().InsertNextCell(3, triangle)
    return mesh
