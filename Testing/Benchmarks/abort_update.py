#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Measures how long an update of the filter continues after a request to abort. Prints the times
without judging them.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/abort_update.py [TRIANGLES]

TRIANGLES: the approximate number of triangles of each mesh, by default 1,000,000. Each row is a
mesh or an option. `update` is the time of a whole update, `events` the number of its progress
events. Then the update is aborted at each of its events in turn. The wait is the time from the
event before, the earliest moment at which the request may have been made, to the end of the update.
`longest` is the longest wait, `at` the progress at which it ended. All times are processor time in
milliseconds, on one thread, so other programs hardly affect them. With another number of THREADS
(0: all) they are wall-clock time, for a quiet machine. The best of RUNS (1) runs counts.
"""
import os
import sys
import time

import numpy
from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

RUNS = int(os.environ.get("RUNS", "1"))
THREADS = int(os.environ.get("THREADS", "1"))
CLOCK = time.process_time if THREADS == 1 else time.perf_counter
MOST_EVENTS = 12


def make_cells(ids):
    cells = vtkCellArray()
    count, size = ids.shape
    cells.SetData(
        numpy_to_vtkIdTypeArray(numpy.arange(0, size * count + 1, size, dtype=numpy.int64), deep=True),
        numpy_to_vtkIdTypeArray(ids.ravel().astype(numpy.int64), deep=True),
    )
    return cells


def make_points(xyz):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(xyz, deep=True))
    return points


def make_quads(triangles, height=0.0):
    """Points and quads of a jittered, sheared lattice; a surface if it has a height."""
    random = numpy.random.default_rng(1)
    side = int((triangles / 2) ** 0.5) + 1
    x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
    xyz = numpy.zeros((side * side, 3))
    xyz[:, 0], xyz[:, 1] = x.ravel(), y.ravel()
    xyz[:, :2] += random.uniform(-0.3, 0.3, (side * side, 2))
    xyz[:, 2] = height * numpy.sin(0.3 * xyz[:, 0]) * numpy.cos(0.2 * xyz[:, 1])
    xyz[:, 0] += 2.5 * xyz[:, 1]
    ids = numpy.arange(side * side).reshape(side, side)
    corners = (ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1])
    return xyz, numpy.stack([part.ravel() for part in corners], axis=1)


def split(quads):
    random = numpy.random.default_rng(2)
    a, b, c, d = quads.T
    flip = random.random(a.size) < 0.5
    first = numpy.stack([a, b, numpy.where(flip, d, c)], axis=1)
    second = numpy.stack([numpy.where(flip, b, a), c, d], axis=1)
    return numpy.stack([first, second], axis=1).reshape(-1, 3)


def make_mesh(xyz, cells):
    mesh = vtkPolyData()
    mesh.SetPoints(make_points(xyz))
    mesh.SetPolys(make_cells(cells))
    return mesh


def add_cell_array(mesh, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    mesh.GetCellData().AddArray(array)
    return array


class Cases:
    """Each method returns an input and sets the options of a filter."""

    def __init__(self, triangles):
        self.triangles = triangles
        self.xyz, self.quads = make_quads(triangles)
        self.cells = split(self.quads)

    def plain(self, _):
        return make_mesh(self.xyz, self.cells)

    def surface(self, flip):
        flip.SetGeometryToSurface()
        xyz, _ = make_quads(self.triangles, 3.0)
        return make_mesh(xyz, self.cells)

    def quads_with_arrays(self, _):
        mesh = make_mesh(self.xyz, self.quads)
        for number in range(8):
            add_cell_array(mesh, f"array {number}", numpy.zeros((len(self.quads), 3)))
        return mesh

    def quads_that_stay(self, flip):
        flip.TriangulateOff()
        return make_mesh(self.xyz, self.quads)

    def cell_normals(self, _):
        mesh = make_mesh(self.xyz, self.cells)
        normals = numpy.tile([0.0, 0.0, 1.0], (len(self.cells), 1))
        mesh.GetCellData().SetNormals(numpy_to_vtk(normals, deep=True))
        return mesh

    def counts_and_angles(self, flip):
        flip.GenerateFlipCountOn()
        flip.GenerateQualityOn()
        return make_mesh(self.xyz, self.cells)

    def lines(self, _):
        mesh = make_mesh(self.xyz, self.cells)
        mesh.SetLines(make_cells(self.cells[::2, :2]))
        return mesh

    def constraints_by_id(self, flip):
        return self.constrained(flip, None)

    def constraints_by_place(self, flip):
        return self.constrained(flip, self.xyz.astype(numpy.float32))

    def constrained(self, flip, points):
        edges = vtkPolyData()
        if points is not None:
            edges.SetPoints(make_points(points))
        edges.SetLines(make_cells(self.cells[:, :2]))
        flip.SetConstraintsData(edges)
        return make_mesh(self.xyz, self.cells)

    def crowded_constraints(self, flip):
        """Every point twice, as on both sides of a slit."""
        count = len(self.xyz)
        mesh = make_mesh(numpy.vstack([self.xyz, self.xyz]), self.cells + count * (
            numpy.arange(len(self.cells)) % 2)[:, None])
        edges = vtkPolyData()
        edges.SetPoints(make_points(self.xyz.astype(numpy.float32)))
        edges.SetLines(make_cells(self.cells[:, :2]))
        flip.SetConstraintsData(edges)
        return mesh

    def inserted_constraints(self, flip):
        """Lines through the whole mesh: each crosses thousands of edges."""
        side = int(len(self.xyz) ** 0.5)
        ends = numpy.arange(0, side, max(1, side // 100))
        edges = vtkPolyData()
        edges.SetLines(make_cells(numpy.stack([ends, ends[::-1] + side * (side - 1)], axis=1)))
        flip.SetConstraintsData(edges)
        return make_mesh(self.xyz, self.cells)

    def regions(self, flip):
        mesh = make_mesh(self.xyz, self.cells)
        add_cell_array(mesh, "region", numpy.arange(len(self.cells)) // 2 * 7919 % 1000003)
        flip.SetRegionArray("region")
        return mesh

    def named_regions(self, flip):
        mesh = make_mesh(self.xyz, self.cells)
        names = vtkStringArray()
        names.SetName("region")
        names.SetNumberOfValues(len(self.cells))
        for cell in range(len(self.cells)):
            names.SetValue(cell, f"region {cell // 1000}")
        mesh.GetCellData().AddArray(names)
        flip.SetRegionArray("region")
        return mesh

    def ghosts(self, _):
        mesh = make_mesh(self.xyz, self.cells)
        add_cell_array(mesh, "vtkGhostType", (numpy.arange(len(self.cells)) % 9 == 0).astype(numpy.uint8))
        return mesh

    def live(self, flip):
        flip.LiveUpdateOn()
        flip.SetIterationsPerUpdate(5)
        return make_mesh(self.xyz, self.cells)

    def warm_start(self, flip):
        """Points are moved after a whole run; the next update is the one that is measured."""
        flip.LiveUpdateOn()
        flip.SetIterationsPerUpdate(10000)
        mesh = make_mesh(self.xyz, self.cells)
        flip.SetInputData(mesh)
        flip.Update()
        xyz = vtk_to_numpy(mesh.GetPoints().GetData())
        xyz += numpy.random.default_rng(3).uniform(-0.1, 0.1, xyz.shape) * [1, 1, 0]
        mesh.GetPoints().GetData().Modified()
        mesh.GetPoints().Modified()
        mesh.Modified()
        return mesh


class Watch:
    """The progress events of an update; stops it at one of them."""

    def __init__(self, case, last=None):
        flip = vtkDelaunayFlip()
        flip.SetBackendToThreads()
        flip.SetNumberOfThreads(THREADS)
        flip.SetInputData(case(flip))
        self.times = [CLOCK()]
        self.progress = [0.0]

        def watch(_caller, _event):
            if flip.GetProgress() == 0.0:
                return
            self.times.append(CLOCK())
            self.progress.append(flip.GetProgress())
            if last is not None and len(self.times) > last:
                flip.SetAbortExecute(1)

        flip.AddObserver("ProgressEvent", watch)
        self.times[0] = CLOCK()
        flip.Update()
        self.end = CLOCK()
        self.total = 1e3 * (self.end - self.times[0])

    def wait(self, event):
        """From the event before this one to the end, and the progress at its end."""
        if event >= len(self.times):
            return 1e3 * (self.end - self.times[-1]), 1.0
        return 1e3 * (self.end - self.times[event - 1]), self.progress[event]


def measure(case):
    whole = min((Watch(case) for _ in range(RUNS)), key=lambda watch: watch.total)
    events = len(whole.times) - 1
    step = max(1, events // MOST_EVENTS)
    waits = [whole.wait(events + 1)]
    for event in range(1, events + 1, step):
        waits.append(min(Watch(case, event).wait(event) for _ in range(RUNS)))
    return whole.total, events, max(waits)


def main():
    triangles = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    cases = Cases(triangles)
    vtkObject.GlobalWarningDisplayOff()
    wanted = sys.argv[2:] or [name for name in dir(Cases) if not name.startswith("_")]
    print(f"{'':24}{'update':>8}{'events':>8}{'longest':>9}{'at':>6}")
    for name in wanted:
        if name == "constrained":
            continue
        total, events, (longest, at) = measure(getattr(cases, name))
        print(f"{name.replace('_', ' '):24}{total:8.0f}{events:8}{longest:9.0f}{at:6.0%}", flush=True)


if __name__ == "__main__":
    main()
