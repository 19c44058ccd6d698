#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points on a sphere, beside Qhull, on one machine and in one run.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/sphere.py \\
      [--points 200000] [--kinds uniform,fibonacci,grid] [--threads 1] [--rounds 3]

A row has the median seconds from an array of x, y and z to triangles, the ratio to our time on threads, the
number of triangles, and how many of them are not among those of our threads.

threads: N  from and to arrays of NumPy
cuda        the same on a GPU
cuda, cupy  the same with arrays of CuPy that stay on the GPU
qhull       SciPy's ConvexHull. Where four points tie, it may choose different triangles. It is left out above
            1,000,000 points, where it takes minutes

A GPU is warmed up by one triangulation that is not timed. What is not installed is named and left out.
"""
import argparse
import functools
import importlib
import statistics
import time
import warnings

import numpy

import delaunayflip


def make_uniform(count):
    points = numpy.random.default_rng(1).normal(size=(count, 3))
    return points / numpy.linalg.norm(points, axis=1, keepdims=True)


def make_fibonacci(count):
    number = numpy.arange(count) + 0.5
    z = 1 - 2 * number / count
    turn, radius = numpy.pi * (1 + 5 ** 0.5) * number, numpy.sqrt(1 - z * z)
    return numpy.c_[radius * numpy.cos(turn), radius * numpy.sin(turn), z]


def make_grid(count):
    rows = int((count / 2) ** 0.5)
    longitudes, latitudes = numpy.meshgrid(
        numpy.arange(2 * rows) * 180 / rows, (numpy.arange(rows) + 0.5) * 180 / rows - 90)
    turn, height = numpy.radians(longitudes.ravel()), numpy.radians(latitudes.ravel())
    return numpy.c_[numpy.cos(height) * numpy.cos(turn), numpy.cos(height) * numpy.sin(turn), numpy.sin(height)]


KINDS = {"uniform": make_uniform, "fibonacci": make_fibonacci, "grid": make_grid}


MOST_OF_QHULL = 1_000_000  # points


def measure(function, rounds):
    """The median of the seconds, and the result."""
    seconds = []
    for _ in range(rounds):
        begin = time.perf_counter()
        result = function()
        seconds.append(time.perf_counter() - begin)
    return statistics.median(seconds), result


def number_triangles(triangles):
    """A hash of each triangle, which does not depend on its first corner and its winding."""
    ids = numpy.sort(triangles, axis=1).astype(numpy.uint64)
    factors = numpy.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], numpy.uint64)
    return ids @ factors


def find(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        print(f"left out: {name} (not installed)")
        return None


def triangulate(points, **options):
    """An array of the ids of triangles."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return delaunayflip.triangulate_sphere(points, **options).triangles


def list_programs(threads):
    """Triples of a name, a function that copies points to where the program has them, and one that makes
    triangles of them; ours on threads first."""
    programs = [(f"threads: {threads}", numpy.asarray,
                 functools.partial(triangulate, threads=threads, backend="threads"))]
    if not delaunayflip.has_cuda_device():
        print("left out: cuda (no GPU)")
    else:
        on_gpu = functools.partial(triangulate, backend="cuda")
        programs.append(("cuda", numpy.asarray, on_gpu))
        cupy = find("cupy")
        if cupy:
            def triangulate_there(points):
                triangles = on_gpu(points)
                cupy.cuda.runtime.deviceSynchronize()
                return triangles
            programs.append(("cuda, cupy", cupy.asarray, triangulate_there))
    spatial = find("scipy.spatial")
    if spatial:
        programs.append(("qhull", numpy.asarray, lambda points: spatial.ConvexHull(points).simplices))
    return programs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=lambda text: int(float(text)), default=200_000)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    programs = list_programs(arguments.threads)
    print(f"{'points':>20} {'program':>12} {'seconds':>9} {'times':>7} {'triangles':>10} {'not ours':>9}")
    for kind in arguments.kinds.split(","):
        points = KINDS[kind](arguments.points)
        name = f"{kind} {len(points)}"
        own = ours = None
        for program, copy, run in programs:
            if program == "qhull" and len(points) > MOST_OF_QHULL:
                continue
            there = copy(points)
            if "cuda" in program:
                run(there)
            seconds, triangles = measure(lambda: run(there), arguments.rounds)
            triangles = triangles.get() if hasattr(triangles, "get") else triangles
            numbers = number_triangles(triangles)
            if ours is None:
                own, ours = seconds, numbers
            missing = len(numpy.setdiff1d(numbers, ours))
            print(f"{name:>20} {program:>12} {seconds:9.4f} {seconds / own:7.2f} {len(triangles):10} "
                  f"{missing:9}", flush=True)


if __name__ == "__main__":
    main()
