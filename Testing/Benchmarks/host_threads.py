# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: host_threads.py [ROUNDS]

Tests whether VTK's threads and the engine's disturb each other in one process. Runs a threaded
filter of VTK and vtkDelaunayFlip, each alone and then in turns. Prints the time of each, the
processor time of all threads, the number of threads in the process, and its copies of oneTBB. Needs
PYTHONPATH as in the README.
"""
import os
import re
import statistics
import sys
import time

import numpy
from delaunayflip import vtkDelaunayFlip
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints, vtkSMPTools, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

RUNS = 5  # per round
SIDE = 400  # squares per side of the mesh: 320,000 triangles


def make_mesh():
    """A sheared grid, whose diagonals are all bad."""
    i, j = numpy.mgrid[: SIDE + 1, : SIDE + 1].reshape(2, -1).astype(float)
    coordinates = numpy.stack([i + 0.7 * j, j, 0 * i], 1)
    i, j = numpy.mgrid[:SIDE, :SIDE].reshape(2, -1)
    a = i * (SIDE + 1) + j
    b, c, d = a + 1, a + SIDE + 2, a + SIDE + 1
    triangles = numpy.concatenate([numpy.stack([a, c, b], 1), numpy.stack([a, d, c], 1)])
    points = vtkPoints()
    points.SetData(numpy_to_vtk(coordinates, deep=True))
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(numpy.arange(0, triangles.size + 1, 3), deep=True),
        numpy_to_vtkIdTypeArray(triangles.ravel(), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


def measure(algorithm):
    """Wall-clock and processor time of an update, in ms."""
    algorithm.Modified()
    wall, cpu = time.perf_counter(), time.process_time()
    algorithm.Update()
    return 1e3 * (time.perf_counter() - wall), 1e3 * (time.process_time() - cpu)


def print_medians(what, times):
    wall, cpu = (statistics.median(column) for column in zip(*times))
    print(f"{what:34} {wall:8.1f} ms {cpu:8.1f} ms of processor time")


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 21
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-60, 60, -60, 60, -60, 60)
    source.Update()
    contour = vtkFlyingEdges3D()
    contour.SetInputData(source.GetOutput())
    contour.SetValue(0, 150)
    flip = vtkDelaunayFlip()
    flip.SetInputData(make_mesh())
    for algorithm in (contour, flip):  # threads start here
        measure(algorithm)
    alone, turns = ([], []), ([], [])
    for _ in range(rounds):  # so that slow periods of the machine affect all of them
        alone[0].extend(measure(contour) for _ in range(RUNS))
        alone[1].extend(measure(flip) for _ in range(RUNS))
        for _ in range(RUNS):
            turns[0].append(measure(contour))
            turns[1].append(measure(flip))
    for what, times in (("contour alone", alone[0]), ("contour, in turns with flips", turns[0]),
                        ("flip alone", alone[1]), ("flip, in turns with contours", turns[1])):
        print_medians(what, times)
    with open("/proc/self/maps", encoding="utf-8") as maps:
        libraries = sorted(set(re.findall(r"\S*/(libtbb[^/\s]*\.so\S*)", maps.read())))
    print(f"{len(os.listdir('/proc/self/task'))} threads on {os.cpu_count()} cores; {libraries}; "
          f"VTK {vtkVersion.GetVTKVersion()}, SMP backend {vtkSMPTools.GetBackend()}")


if __name__ == "__main__":
    main()
