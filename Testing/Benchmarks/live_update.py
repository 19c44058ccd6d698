#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what an update of a live run costs beyond its iterations.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/live_update.py [POINTS]

POINTS: the size of the mesh, by default about 200,000. Each row is a live run of one mesh with one
iteration per update. It has the time of the first update, which builds the edges, and the median
and the slowest of the others, in milliseconds; `rest` is the time outside the iterations.
"""
import statistics
import sys
import time

import numpy
from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def make_mesh(points, with_normals):
    """A jittered lattice with random diagonals, sheared: nearly every edge is bad."""
    random = numpy.random.default_rng(1)
    side = int(points ** 0.5)
    x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
    xyz = numpy.zeros((side * side, 3))
    xyz[:, 0], xyz[:, 1] = x.ravel(), y.ravel()
    xyz[:, :2] += random.uniform(-0.3, 0.3, (side * side, 2))
    xyz[:, 0] += 2.5 * xyz[:, 1]
    ids = numpy.arange(side * side).reshape(side, side)
    a, b, c, d = (part.ravel() for part in (ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]))
    flip = random.random(a.size) < 0.5
    first = numpy.stack([a, b, numpy.where(flip, d, c)], axis=1)
    second = numpy.stack([numpy.where(flip, b, a), c, d], axis=1)
    triangles = numpy.stack([first, second], axis=1).reshape(-1, 3)
    mesh = vtkPolyData()
    mesh.SetPoints(vtkPoints())
    mesh.GetPoints().SetData(numpy_to_vtk(xyz, deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, 3 * len(triangles) + 1, 3), deep=True),
                  numpy_to_vtkIdTypeArray(triangles.ravel().astype(numpy.int64), deep=True))
    mesh.SetPolys(cells)
    if with_normals:
        normals = numpy_to_vtk(numpy.tile([0.0, 0.0, 1.0], (len(triangles), 1)), deep=True)
        mesh.GetCellData().SetNormals(normals)
    return mesh


def time_run(mesh, configure):
    """Milliseconds of every update, and of the iterations in it."""
    flip = vtkDelaunayFlip()
    flip.SetInputData(mesh)
    flip.SetBackendToThreads()
    flip.LiveUpdateOn()
    configure(flip)
    updates, iterations, rows = [], [], 0
    while True:
        start = time.perf_counter()
        flip.Update()
        updates.append(1e3 * (time.perf_counter() - start))
        seconds = vtk_to_numpy(flip.GetIterations().GetColumnByName("Seconds"))
        iterations.append(1e3 * seconds[rows:].sum())
        rows = len(seconds)
        if not flip.Advance():
            return updates, iterations


def main():
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
    print(f"{'':24}{'updates':>8}{'first':>8}{'update':>9}{'slowest':>9}{'rest':>8}{'slowest':>9}")
    for name, normals, configure in (
            ("plain", False, lambda flip: None),
            ("cell normals", True, lambda flip: None),
            ("flip counts", False, lambda flip: flip.GenerateFlipCountOn()),
            ("angles", False, lambda flip: flip.GenerateQualityOn()),
            ("50 ms per update", False, lambda flip: flip.SetIterationsPerUpdate(0))):
        updates, iterations = time_run(make_mesh(points, normals), configure)
        rest = [update - done for update, done in zip(updates, iterations)]
        print(f"{name:24}{len(updates):8}{updates[0]:8.1f}{statistics.median(updates[1:]):9.1f}"
              f"{max(updates[1:]):9.1f}{statistics.median(rest[1:]):8.1f}{max(rest[1:]):9.1f}")


if __name__ == "__main__":
    main()
