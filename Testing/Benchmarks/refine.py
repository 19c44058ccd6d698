#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Refines domains to a smallest angle, beside other libraries, on one machine and in one run.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/refine.py \\
      [--coasts 5000,20000,60000] [--points 20000,300000] [--angles 25,30] [--threads 1,2] [--rounds 3]

A coast is a closed line with bays, of so many segments; points are uniform in a square. In every round
each program runs once, in random order, so a busy machine slows all of them alike. Printed are the median
seconds of processor time and of real time, the number of points and the smallest angle; if Triangle is
installed, also the number of points and the real time divided by Triangle's.

threads: N  triangulate(minimum_angle=...)
cuda        the same on a GPU, from and to arrays of NumPy
cupy        the same on a GPU, from points and to triangles of CuPy; points are returned on the host
triangle    Triangle by its Python package, with the switches p and q
pythoncdt   CDT's refinement
gmsh        Gmsh's Delaunay algorithm, on coasts alone. It has no smallest angle: sizes grow with the distance
            from the coast, so its numbers of points and angles are results, not goals

What is not installed is named and left out.
"""
import argparse
import importlib
import random
import statistics
import time

import numpy

import delaunayflip


def make_coast(size):
    """Corners of a closed line around a bay, counter-clockwise."""
    draw = numpy.random.default_rng(2)
    angle = numpy.arange(size) / size * 2 * numpy.pi
    radius = numpy.ones(size)
    for wave in range(1, 200):
        radius += draw.normal() * 0.25 * wave ** -1.3 * numpy.cos(wave * angle + draw.random() * 6.28)
    radius = numpy.maximum(radius, 0.2)
    ring = numpy.arange(size)
    return numpy.c_[radius * numpy.cos(angle), radius * numpy.sin(angle)], ring


def make_square(size):
    """Uniform points, and the corners of a square around them."""
    draw = numpy.random.default_rng(2)
    corners = numpy.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    return numpy.r_[corners, draw.random((size, 2))], numpy.arange(4)


def measure_angle(points, triangles):
    """The smallest angle in degrees."""
    corners = points[triangles]
    smallest = numpy.inf
    for k in range(3):
        u = corners[:, (k + 1) % 3] - corners[:, k]
        v = corners[:, (k + 2) % 3] - corners[:, k]
        angles = numpy.arctan2(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1))
        smallest = min(smallest, float(angles.min()))
    return numpy.degrees(smallest)


def refine_ours(points, ring, angle, **options):
    found = delaunayflip.triangulate(points, outline=[ring.tolist()], minimum_angle=angle, **options)
    return found.points, found.triangles


def refine_cupy(points, ring, angle):
    return refine_ours(importlib.import_module("cupy").asarray(points), ring, angle)


def refine_triangle(points, ring, angle):
    data = {"vertices": points, "segments": numpy.c_[ring, numpy.roll(ring, -1)]}
    found = importlib.import_module("triangle").triangulate(data, f"pq{angle:g}")
    return found["vertices"], found["triangles"]


def refine_cdt(points, ring, angle):
    cdt = importlib.import_module("pythoncdt")
    found = cdt.Triangulation(cdt.VertexInsertionOrder.AUTO, cdt.IntersectingConstraintEdges.TRY_RESOLVE, 0.0)
    found.insert_vertices(points)
    found.insert_edges(numpy.c_[ring, numpy.roll(ring, -1)].astype(numpy.uintc))
    outside = set(found.collect_outer_triangles_and_holes())
    found.refine_triangles(10_000_000, cdt.RefinementCriterion.SMALLEST_ANGLE, float(numpy.radians(angle)),
                           outside)
    found.finalize_triangulation(outside)
    count = found.vertices_count
    return count() if callable(count) else count


def refine_gmsh(points, ring, _angle):
    gmsh = importlib.import_module("gmsh")
    gmsh.initialize(interruptible=False)
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("Mesh.Algorithm", 5)
    lengths = numpy.hypot(*(points[numpy.roll(ring, -1)] - points[ring]).T)
    sizes = (lengths + numpy.roll(lengths, 1)) / 2
    draw = gmsh.model.geo
    corners = [draw.addPoint(*points[corner], 0, size) for corner, size in zip(ring, sizes)]
    lines = [draw.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    surface = draw.addPlaneSurface([draw.addCurveLoop(lines)])
    draw.synchronize()
    grow = gmsh.model.mesh.field.add("Extend")  # sizes grow linearly with the distance
    gmsh.model.mesh.field.setNumbers(grow, "CurvesList", lines)
    gmsh.model.mesh.field.setNumbers(grow, "SurfacesList", [surface])
    gmsh.model.mesh.field.setNumber(grow, "DistMax", 1)
    gmsh.model.mesh.field.setNumber(grow, "SizeMax", 1)
    gmsh.model.mesh.field.setAsBackgroundMesh(grow)
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    gmsh.model.mesh.generate(2)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    _, corners_of = gmsh.model.mesh.getElementsByType(2)
    gmsh.finalize()
    number = numpy.zeros(int(tags.max()) + 1, dtype=int)
    number[tags] = numpy.arange(len(tags))
    return coordinates.reshape(-1, 3)[:, :2], number[corners_of].reshape(-1, 3)


def list_programs(threads):
    """Pairs of a name and a function, and the names of those that are left out."""
    programs = [(f"threads: {count}",
                 lambda *case, count=count: refine_ours(*case, backend="threads", threads=count))
                for count in threads]
    absent = []
    if delaunayflip.has_cuda_device():
        programs.append(("cuda", lambda *case: refine_ours(*case, backend="cuda")))
    else:
        absent.append("cuda (no GPU)")
    others = [("triangle", refine_triangle), ("pythoncdt", refine_cdt), ("gmsh", refine_gmsh)]
    if not absent:
        others.insert(0, ("cupy", refine_cupy))
    for name, function in others:
        try:
            importlib.import_module(name)
            programs.append((name, function))
        except ImportError:
            absent.append(f"{name} (not installed)")
    return programs, absent


def describe(found):
    if isinstance(found, int):
        return f"{found:10,}{'-':>10}"
    points, triangles = found
    if hasattr(triangles, "get"):
        triangles = triangles.get()  # an array of CuPy
    return f"{len(points):10,}{measure_angle(numpy.asarray(points), numpy.asarray(triangles)):10.3f}"


def count_points(found):
    return found if isinstance(found, int) else len(found[0])


def run(title, points, ring, angle, programs, rounds):
    print(f"\n{title}, {angle:g} degrees")
    if len(points) > len(ring):
        programs = [program for program in programs if program[0] != "gmsh"]
    has_triangle = any(name == "triangle" for name, _ in programs)
    ratios = f"{'points/T':>10}{'seconds/T':>10}" if has_triangle else ""
    print(f"{'':14}{'processor':>10}{'seconds':>10}{'points':>10}{'smallest':>10}{ratios}")
    times = {name: [] for name, _ in programs}
    results = {}
    for _ in range(rounds):
        for name, function in random.sample(programs, len(programs)):
            begin = time.process_time(), time.perf_counter()
            results[name] = function(points, ring, angle)
            times[name].append((time.process_time() - begin[0], time.perf_counter() - begin[1]))
    medians = {name: [statistics.median(column) for column in zip(*rows)] for name, rows in times.items()}
    for name, (processor, real) in medians.items():
        ratios = ""
        if has_triangle:
            more = count_points(results[name]) / count_points(results["triangle"])
            ratios = f"{more:10.3f}{real / medians['triangle'][1]:10.2f}"
        print(f"{name:14}{processor:10.3f}{real:10.3f}{describe(results[name])}{ratios}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])

    def numbers(kind):
        return lambda text: [kind(float(word)) for word in text.split(",") if word]

    parser.add_argument("--coasts", type=numbers(int), default=[5000, 20000, 60000])
    parser.add_argument("--points", type=numbers(int), default=[20000, 300000])
    parser.add_argument("--angles", type=numbers(float), default=[25.0, 30.0])
    parser.add_argument("--threads", type=numbers(int), default=[1, 2])
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    programs, absent = list_programs(arguments.threads)
    for angle in arguments.angles:
        for size in arguments.coasts:
            run(f"coast of {size:,} segments", *make_coast(size), angle, programs, arguments.rounds)
        for size in arguments.points:
            run(f"{size:,} points", *make_square(size), angle, programs, arguments.rounds)
    for text in absent:
        print(f"left out: {text}")


if __name__ == "__main__":
    main()
