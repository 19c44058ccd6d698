#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares this project with others on surfaces and planes, on one machine and in one run.

    python3 -m venv others && others/bin/pip install -r Testing/Benchmarks/requirements.txt
    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/compare.py \\
      --others others/bin/python [--threads 1,2,4] [--seconds 5] [MESH...]

A MESH is a file that the filter of VTK reads (.ply, .stl, .obj, .vtk, .vtp), a .dfmesh of
Testing/Gpu/export_meshes.py, which needs no VTK, or lattice:N or torus:N, a sheared plane or a
torus of about N points with diagonals drawn at random (default: both with 100,000 points).

In every round each program runs once, in random order, so a busy machine slows all of them alike.
Rounds are repeated for --seconds, at least five times. Printed are the median and the quartiles of
wall-clock time, the median of processor time, how many times as long as the engine with as many
threads a program takes, and its speed-up over one thread.

arrays      the engine's C interface, from arrays to arrays that were written before
update      vtkDelaunayFlip::Update()
numpy       delaunayflip.flip()
arithmetic  no mesh: as many processes as threads each add numbers. Its speed-up over one process
            is what the machine has to give.
meshlib     MeshLib: a mesh of arrays, and flips until none is left, at most 100 for an edge
libigl      intrinsic_delaunay_triangulation, which needs the lengths of edges. One thread.
triangulate delaunayflip.triangulate() of the points, where all z are equal; so the next three,
            which have one thread
cgal        CGAL's Delaunay_triangulation_2. Time to take Python's points is included;
            delaunay-flip-benchmark measures without it.
scipy       SciPy's Delaunay, by Qhull
triangle    Triangle

What is not installed, or not built, is left out and named.
"""
import argparse
import functools
import json
import multiprocessing
import os
import random
import statistics
import subprocess
import sys
import tempfile
import time

import numpy


def read_mesh(name):
    """Points and triangles."""
    kind, _, size = name.partition(":")
    if kind in ("lattice", "torus") and size:
        return make_mesh(kind, max(3, int(int(size) ** 0.5)))
    if name.endswith(".dfmesh"):
        with open(name, "rb") as file:
            data = file.read()
        width, points, triangles = numpy.frombuffer(data, "<i8", 3, 8).tolist()
        xyz = numpy.frombuffer(data, f"<f{width}", 3 * points, 48).reshape(-1, 3)
        ids = numpy.frombuffer(data, "<i4", 3 * triangles, 48 + xyz.nbytes).reshape(-1, 3)
        return xyz, ids.astype(numpy.int64)
    sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "Gpu"))
    from export_meshes import convert
    return convert(name)[:2]


def make_mesh(kind, side):
    """A jittered, sheared lattice, or one that is bent to a torus; nearly every edge is bad."""
    draw = numpy.random.default_rng(1)
    ids = numpy.arange(side * side).reshape(side, side)
    y, x = numpy.divmod(ids.ravel(), side) + draw.uniform(-0.25, 0.25, (2, ids.size))
    if kind == "lattice":
        xyz = numpy.stack([x + 2.5 * y, y, 0 * x], axis=1)
        corners = ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]
    else:
        u, v = 2 * numpy.pi * (x + 2.0 * y) / side, 2 * numpy.pi * y / side
        r = 2 + numpy.cos(v)
        xyz = numpy.stack([r * numpy.cos(u), r * numpy.sin(u), numpy.sin(v)], axis=1)
        down, right = numpy.roll(ids, -1, axis=0), numpy.roll(ids, -1, axis=1)
        corners = ids, right, numpy.roll(down, -1, axis=1), down
    a, b, c, d = (corner.ravel() for corner in corners)
    turned = draw.random(a.size) < 0.5
    first = numpy.stack([a, b, numpy.where(turned, d, c)], axis=1)
    second = numpy.stack([numpy.where(turned, b, a), c, d], axis=1)
    return xyz.astype(numpy.float32), numpy.concatenate([first, second])


class Ours:
    """Programs of this project, for a number of threads or "cuda". They return the flips."""

    def __init__(self, points, triangles):
        from delaunayflip import _arrays, _library, _options, _report, flip, triangulate
        self.mesh, self.points, self.triangles = _arrays.Mesh(points, triangles), points, triangles
        self.library, self.options, self.read_report = _library, _options, _report.read
        self.flip = flip
        self.from_points = triangulate
        self.result, self.filter = triangles.copy(), None

    def choose(self, threads):
        backend = "cuda" if threads == "cuda" else "threads"
        return {"backend": backend, "threads": 0 if threads == "cuda" else threads}

    def arrays(self, threads):
        import ctypes
        call, handle, running = self.library.call, ctypes.c_void_p(), ctypes.c_int32()
        options = self.options.make_options(**self.choose(threads))
        call("open", self.mesh.struct, options, None, ctypes.byref(handle))
        call("advance", handle, -1, None, ctypes.byref(running))
        call("store_triangles", handle, self.result.ctypes.data, self.library.TYPES["int64"])
        flips = self.read_report(handle).total_flips
        self.library.run("close", handle)
        return flips

    def numpy(self, threads):
        return self.flip(self.points, self.triangles, **self.choose(threads)).report.total_flips

    def triangulate(self, threads):
        return self.from_points(self.points, **self.choose(threads)).report.total_flips

    def update(self, threads):
        from delaunayflip import vtkDelaunayFlip
        from vtkmodules.vtkCommonCore import vtkObject
        from filter_times import make_poly_data
        if self.filter is None:
            vtkObject.GlobalWarningDisplayOff()
            self.filter = vtkDelaunayFlip()
            self.filter.SetInputData(make_poly_data(self.points, self.triangles))
        self.filter.SetBackend(1 if threads == "cuda" else 2)
        self.filter.SetNumberOfThreads(0 if threads == "cuda" else threads)
        self.filter.Modified()
        self.filter.Update()
        return self.filter.GetTotalFlips()


class Others:
    """Programs of other projects. Those with threads use as many as this process has cores."""

    def __init__(self, points, triangles):
        self.points, self.triangles = points, triangles.astype(numpy.int32)
        corners = points.astype(float)[triangles]
        self.places = None
        self.lengths = numpy.linalg.norm(corners[:, [1, 2, 0]] - corners[:, [2, 0, 1]], axis=2)

    def meshlib(self):
        from meshlib import mrmeshnumpy, mrmeshpy
        mesh = mrmeshnumpy.meshFromFacesVerts(self.triangles, self.points)
        return mrmeshpy.makeDeloneEdgeFlips(mesh, mrmeshpy.DeloneSettings(), 100)

    def libigl(self):
        import igl
        igl.intrinsic_delaunay_triangulation(self.lengths, self.triangles)

    def cgal(self):
        from CGAL.CGAL_Kernel import Point_2
        from CGAL.CGAL_Triangulation_2 import Delaunay_triangulation_2
        self.places = self.places or [Point_2(*point) for point in self.points[:, :2].tolist()]
        Delaunay_triangulation_2().insert(self.places)

    def scipy(self):
        from scipy.spatial import Delaunay
        Delaunay(self.points[:, :2])

    def triangle(self):
        import triangle
        triangle.triangulate({"vertices": self.points[:, :2]})


def add_numbers(count):
    total = 0
    for number in range(count):
        total += number & 1
    return total


def measure(function, *arguments):
    """Seconds of wall clock and of this process's processors, and what the function returns."""
    wall, processor = time.perf_counter(), time.process_time()
    result = function(*arguments)
    return time.perf_counter() - wall, time.process_time() - processor, result


def serve(path, cores):
    """Measures the other programs. Their names come from the standard input."""
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])
    mesh = numpy.load(path)
    programs = Others(mesh["points"], mesh["triangles"])
    for line in sys.stdin:
        try:
            print(json.dumps(measure(getattr(programs, line.strip()))), flush=True)
        except ImportError as error:
            print(json.dumps(str(error)), flush=True)


class Server:
    """A function that runs a program in another process."""

    def __init__(self, python, path, cores):
        command = [python, __file__, "--serve", path, str(cores)]
        pipe = subprocess.PIPE
        self.process = subprocess.Popen(command, stdin=pipe, stdout=pipe, text=True)

    def __call__(self, name):
        print(name, file=self.process.stdin, flush=True)
        answer = json.loads(self.process.stdout.readline())
        if isinstance(answer, str):
            raise ImportError(answer)
        return answer


def list_programs(ours, python, path, threads, has_cuda):
    """Functions that return what `measure` does, by program and threads."""
    programs = {}
    is_plane = numpy.ptp(ours.points[:, 2]) == 0
    for count in [*threads, "cuda"] if has_cuda else threads:
        for name in ("arrays", "update", "numpy", "triangulate")[:3 + is_plane]:
            programs[name, count] = functools.partial(measure, getattr(ours, name), count)
        if count != "cuda":
            pool = multiprocessing.Pool(count)
            programs["arithmetic", count] = functools.partial(
                measure, pool.map, add_numbers, [400_000] * count, 1)
    for count in threads if python else ():
        server = Server(python, path, count)
        alone = ["libigl", "cgal", "scipy", "triangle"][:4 if is_plane else 1]
        for name in ["meshlib", *(alone if count == 1 else [])]:
            programs[name, count] = functools.partial(server, name)
    return programs


def compare(name, arguments):
    points, triangles = read_mesh(name)
    ours = Ours(points, triangles)
    has_cuda = bool(ours.library.has_cuda_device())
    print(f"\n{name}: {len(points)} points, {len(triangles)} triangles")
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.npz")
        numpy.savez(path, points=points, triangles=triangles)
        programs = list_programs(ours, arguments.others, path, arguments.threads, has_cuda)
        times = {}
        for key, program in programs.items():
            try:
                program()  # warms up
                times[key] = []
            except ImportError as error:
                print(f"{key[0]}, {key[1]}: skipped, {error}")
        rounds, end = 0, time.monotonic() + arguments.seconds
        while rounds < 5 or time.monotonic() < end:
            rounds += 1
            for key in random.sample(list(times), len(times)):
                times[key].append(programs[key]())
    if not has_cuda:
        print("cuda: skipped, no GPU")
    walls = {key: [1e3 * wall for wall, _, _ in runs] for key, runs in times.items()}
    median = {key: statistics.median(values) for key, values in walls.items()}
    print(f"{rounds} rounds\n{'':12}{'threads':>8}{'ms':>9}{'quartiles':>17}{'processor':>11}"
          f"{'x arrays':>10}{'speed-up':>10}{'flips':>10}")
    for key, runs in times.items():
        program, count = key
        low, _, high = statistics.quantiles(walls[key], n=4)
        processor = 1e3 * statistics.median(run[1] for run in runs)
        speed_up = median.get((program, 1), numpy.nan) / median[key]
        flips = runs[0][2]
        if program == "arithmetic":
            speed_up, flips, processor = count * speed_up, None, numpy.nan
        print(f"{program:12}{count:>8}{median[key]:9.2f}{low:9.2f}{high:8.2f}{processor:11.2f}"
              f"{median[key] / median['arrays', count]:10.2f}{speed_up:10.2f}{flips or '':>10}",
              flush=True)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    cores = len(os.sched_getaffinity(0))
    parser.add_argument("meshes", nargs="*", default=["torus:100000", "lattice:100000"])
    parser.add_argument("--threads", type=lambda text: [int(word) for word in text.split(",")],
                        default=[count for count in (1, 2, 4, 8, 16) if count <= cores])
    parser.add_argument("--seconds", type=float, default=10.0, help="of a mesh")
    parser.add_argument("--others", help="the Python of an environment with the others")
    arguments = parser.parse_args()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = next((line for line in file if line.startswith("model name")), ": ?").split(": ")[1]
    print(f"{model.strip()}, {cores} cores; Python {sys.version.split()[0]}")
    for name in arguments.meshes:
        compare(name, arguments)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--serve"]:
        serve(sys.argv[2], int(sys.argv[3]))
    else:
        main()
