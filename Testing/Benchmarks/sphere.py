#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Triangulates points on a sphere, beside Qhull, on one machine and in one run.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/sphere.py \\
      [--points 200000] [--kinds uniform,fibonacci,grid] [--threads 1] [--rounds 3]

A row has the median seconds from an array of x, y and z to triangles, the ratio to our time, the number of
triangles, and how many of Qhull's triangles are not among ours. Where four points tie, the two may choose
different triangles. Qhull is SciPy's ConvexHull; without SciPy its rows are left out.
"""
import argparse
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


def measure(function, rounds):
    """The median of the seconds, and the result."""
    seconds = []
    for _ in range(rounds):
        begin = time.perf_counter()
        result = function()
        seconds.append(time.perf_counter() - begin)
    return statistics.median(seconds), result


def number_triangles(triangles):
    """A number for each triangle, which does not depend on its first corner and its winding."""
    ids = numpy.sort(triangles.astype(object if triangles.max(initial=0) >= 2**21 else numpy.int64), axis=1)
    return ids @ numpy.array([1 << 42, 1 << 21, 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=200_000)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    try:
        from scipy.spatial import ConvexHull
    except ImportError:
        ConvexHull = None
        print("no SciPy: without Qhull")
    print(f"{'points':>20} {'program':>12} {'seconds':>9} {'times':>7} {'triangles':>10} {'not ours':>9}")
    for kind in arguments.kinds.split(","):
        points = KINDS[kind](arguments.points)
        name = f"{kind} {len(points)}"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            own, globe = measure(
                lambda: delaunayflip.triangulate_sphere(points, threads=arguments.threads, backend="threads"),
                arguments.rounds)
        print(f"{name:>20} {f'threads: {arguments.threads}':>12} {own:9.3f} {1:7.1f} {len(globe.triangles):10}",
              flush=True)
        if ConvexHull:
            seconds, hull = measure(lambda: ConvexHull(points), arguments.rounds)
            missing = len(numpy.setdiff1d(number_triangles(hull.simplices), number_triangles(globe.triangles)))
            print(f"{name:>20} {'qhull':>12} {seconds:9.3f} {seconds / own:7.1f} {len(hull.simplices):10} "
                  f"{missing:9}", flush=True)


if __name__ == "__main__":
    main()
