#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Prints times of the filter, without judging them.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/filter_times.py \\
      abort|live [TRIANGLES [CASE...]]

abort: how long an update continues after a request to abort. Each row is a mesh or an option.
`update` is the time of a whole update, `events` the number of its progress events. Then the update
is aborted at each of its events in turn. The wait is the time from the event before, the earliest
moment at which the request may have been made, to the end of the update. `longest` is the longest
wait, `at` the progress at which it ended. All times are processor time in milliseconds, on one
thread, so other programs hardly affect them. With another number of THREADS (0: all) they are
wall-clock time, for a quiet machine. The best of RUNS (1) runs counts.

live: what an update of a live run costs beyond its iterations, of which there is one per update. A
row has the time of the first update, which builds the edges, and the median and the slowest of the
others, in milliseconds; `rest` is the time outside the iterations.
"""
import os
import statistics
import sys
import time

import numpy
from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObject, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

RUNS = int(os.environ.get("RUNS", "1"))
THREADS = int(os.environ.get("THREADS", "1"))
CLOCK = time.process_time if THREADS == 1 else time.perf_counter
MOST_EVENTS = 12


def make_poly_data(points=None, cells=None, lines=None):
    def make_cells(ids):
        cells = vtkCellArray()
        offsets = numpy.arange(0, ids.size + 1, ids.shape[1], dtype=numpy.int64)
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(ids.ravel().astype(numpy.int64), deep=True))
        return cells

    mesh = vtkPolyData()
    if points is not None:
        mesh.SetPoints(vtkPoints())
        mesh.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    if cells is not None:
        mesh.SetPolys(make_cells(cells))
    if lines is not None:
        mesh.SetLines(make_cells(lines))
    return mesh


def add_cell_array(mesh, name, values):
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    mesh.GetCellData().AddArray(array)


class Cases:
    """Each method returns an input and sets the options of a filter. The mesh is a jittered, sheared
    lattice with random diagonals: nearly every edge is bad."""

    def __init__(self, triangles):
        random = numpy.random.default_rng(1)
        side = int((triangles / 2) ** 0.5) + 1
        x, y = numpy.meshgrid(numpy.arange(side), numpy.arange(side))
        self.xyz = numpy.zeros((side * side, 3))
        self.xyz[:, 0], self.xyz[:, 1] = x.ravel(), y.ravel()
        self.xyz[:, :2] += random.uniform(-0.3, 0.3, (side * side, 2))
        self.hills = 3 * numpy.sin(0.3 * self.xyz[:, 0]) * numpy.cos(0.2 * self.xyz[:, 1])
        self.xyz[:, 0] += 2.5 * self.xyz[:, 1]
        ids = numpy.arange(side * side).reshape(side, side)
        a, b, c, d = (part.ravel() for part in (
            ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]))
        self.quads = numpy.stack([a, b, c, d], axis=1)
        flip = random.random(a.size) < 0.5
        first = numpy.stack([a, b, numpy.where(flip, d, c)], axis=1)
        second = numpy.stack([numpy.where(flip, b, a), c, d], axis=1)
        self.cells = numpy.stack([first, second], axis=1).reshape(-1, 3)

    def plain(self, _):
        return make_poly_data(self.xyz, self.cells)

    def surface(self, flip):
        flip.SetGeometryToSurface()
        return make_poly_data(numpy.column_stack((self.xyz[:, :2], self.hills)), self.cells)

    def quads_with_arrays(self, _):
        mesh = make_poly_data(self.xyz, self.quads)
        for number in range(8):
            add_cell_array(mesh, f"array {number}", numpy.zeros((len(self.quads), 3)))
        return mesh

    def cell_normals(self, flip):
        mesh = self.plain(flip)
        normals = numpy.tile([0.0, 0.0, 1.0], (len(self.cells), 1))
        mesh.GetCellData().SetNormals(numpy_to_vtk(normals, deep=True))
        return mesh

    def counts_and_angles(self, flip):
        flip.GenerateFlipCountOn()
        flip.GenerateQualityOn()
        return self.plain(flip)

    def lines(self, _):
        return make_poly_data(self.xyz, self.cells, self.cells[::2, :2])

    def constraints_by_id(self, flip):
        flip.SetConstraintsData(make_poly_data(lines=self.cells[:, :2]))
        return self.plain(flip)

    def constraints_by_place(self, flip):
        flip.SetConstraintsData(make_poly_data(
            self.xyz.astype(numpy.float32), lines=self.cells[:, :2]))
        return self.plain(flip)

    def inserted_constraints(self, flip):
        """Lines through the whole mesh: each crosses thousands of edges."""
        side = int(len(self.xyz) ** 0.5)
        ends = numpy.arange(0, side, max(1, side // 100))
        flip.SetConstraintsData(make_poly_data(
            lines=numpy.stack([ends, ends[::-1] + side * (side - 1)], axis=1)))
        return self.plain(flip)

    def regions(self, flip):
        mesh = self.plain(flip)
        add_cell_array(mesh, "region", numpy.arange(len(self.cells)) // 2 * 7919 % 1000003)
        flip.SetRegionArray("region")
        return mesh

    def ghosts(self, flip):
        mesh = self.plain(flip)
        ghosts = numpy.arange(len(self.cells)) % 9 == 0
        add_cell_array(mesh, "vtkGhostType", ghosts.astype(numpy.uint8))
        return mesh

    def warm_start(self, flip):
        """Points are moved after a whole run; the next update is the one that is measured."""
        flip.LiveUpdateOn()
        flip.SetIterationsPerUpdate(10000)
        mesh = self.plain(flip)
        flip.SetInputData(mesh)
        flip.Update()
        xyz = vtk_to_numpy(mesh.GetPoints().GetData())
        xyz += numpy.random.default_rng(3).uniform(-0.1, 0.1, xyz.shape) * [1, 1, 0]
        mesh.GetPoints().GetData().Modified()
        mesh.GetPoints().Modified()
        mesh.Modified()
        return mesh


def watch_update(case, last=None):
    """Times of the events of an update, its begin and end included, and the progress at each. Stops
    the update at event number `last`."""
    flip = vtkDelaunayFlip()
    flip.SetBackendToThreads()
    flip.SetNumberOfThreads(THREADS)
    flip.SetInputData(case(flip))
    times, progress = [], [0.0]

    def watch(_caller, _event):
        if flip.GetProgress() > 0.0:
            times.append(CLOCK())
            progress.append(flip.GetProgress())
            if last is not None and len(times) > last:
                flip.SetAbortExecute(1)

    flip.AddObserver("ProgressEvent", watch)
    times.append(CLOCK())
    flip.Update()
    return [*times, CLOCK()], [*progress, 1.0]


def find_wait(case, event):
    """Milliseconds from the event before this one to the end, and the progress at its end."""
    times, progress = watch_update(case, event)
    event = min(event, len(times) - 1)
    return 1e3 * (times[-1] - times[event - 1]), progress[event]


def time_aborts(triangles, names):
    cases = Cases(triangles)
    print(f"{'':24}{'update':>8}{'events':>8}{'longest':>9}{'at':>6}")
    for name in names or [name for name in dir(Cases) if not name.startswith("_")]:
        case = getattr(cases, name)
        times = min((watch_update(case)[0] for _ in range(RUNS)),
                    key=lambda times: times[-1] - times[0])
        events = len(times) - 2
        waits = [(1e3 * (times[-1] - times[-2]), 1.0)]
        for event in range(1, events + 1, max(1, events // MOST_EVENTS)):
            waits.append(min(find_wait(case, event) for _ in range(RUNS)))
        longest, at = max(waits)
        print(f"{name.replace('_', ' '):24}{1e3 * (times[-1] - times[0]):8.0f}{events:8}"
              f"{longest:9.0f}{at:6.0%}", flush=True)


def time_live_run(triangles, names):
    cases = Cases(triangles)
    print(f"{'':24}{'updates':>8}{'first':>8}{'update':>9}{'slowest':>9}{'rest':>8}{'slowest':>9}")
    for name in names or ("plain", "cell_normals", "counts_and_angles"):
        flip = vtkDelaunayFlip()
        flip.SetInputData(getattr(cases, name)(flip))
        flip.SetBackendToThreads()
        flip.LiveUpdateOn()
        updates, rest, rows, goes_on = [], [], 0, True
        while goes_on:
            start = time.perf_counter()
            flip.Update()
            updates.append(1e3 * (time.perf_counter() - start))
            seconds = vtk_to_numpy(flip.GetIterations().GetColumnByName("Seconds"))
            rest.append(updates[-1] - 1e3 * seconds[rows:].sum())
            rows = len(seconds)
            goes_on = flip.Advance()
        print(f"{name.replace('_', ' '):24}{len(updates):8}{updates[0]:8.1f}"
              f"{statistics.median(updates[1:]):9.1f}{max(updates[1:]):9.1f}"
              f"{statistics.median(rest[1:]):8.1f}{max(rest[1:]):9.1f}")


if __name__ == "__main__":
    MODES = {"abort": time_aborts, "live": time_live_run}
    if len(sys.argv) < 2 or sys.argv[1] not in MODES:
        sys.exit(__doc__)
    vtkObject.GlobalWarningDisplayOff()
    MODES[sys.argv[1]](int(sys.argv[2]) if len(sys.argv) > 2 else 400_000, sys.argv[3:])
