#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Interpolates between random points, beside other libraries, on one machine and in one run.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/interpolate.py \\
      [--points 1000000] [--cells 4000000] [--threads 1,2] [--rounds 3] [--all] [--processor-time]

The places are the centres of a square raster of about so many cells, row by row ("raster") and shuffled
("random"). A row has the median seconds from points to an interpolator, the median of a million places
per second for each question, and how many times as many as ours on the first number of threads. Each row
is printed as soon as it is measured, ours first. With --processor-time, seconds are those of all threads of
this process, for a machine with other work. If one of the numbers of threads is 1, the speed-ups of the
others are printed at the end, beside that of pure arithmetic: as many processes each add numbers.

threads: N  LinearInterpolator and NaturalNeighborInterpolator; rasters by raster()
cuda        the same on a GPU, from and to arrays of NumPy
cuda, cupy  the same with arrays of CuPy that stay on the GPU; torch likewise
scipy       LinearNDInterpolator
matplotlib  LinearTriInterpolator; above 100,000 points, where it takes minutes, only with --all
startinpy   interpolate(), TIN and NNI
cupyx       cupyx.scipy.interpolate.LinearNDInterpolator

A program begins no new round after 20 seconds. Others are asked about as many places as they find in two
seconds, and get a tenth of the points, which their row says, if all would take more than 20 seconds. What
is not installed is named and left out.
"""
import argparse
import functools
import importlib
import multiprocessing
import os
import statistics
import time

import numpy

import delaunayflip
from compare import add_numbers

QUESTIONS = ("linear raster", "linear random", "natural raster", "natural random")
MOST_OF_MATPLOTLIB = 100_000  # points
SECONDS = 20.0  # of a program, after which it begins no new round
SECONDS_OF_OTHERS = 2.0  # for one question
KINDS = {"linear": delaunayflip.LinearInterpolator, "natural": delaunayflip.NaturalNeighborInterpolator}


class Data:
    """Points with values, and places."""

    def __init__(self, points, cells):
        draw = numpy.random.default_rng(1)
        self.points = draw.random((points, 2))
        x, y = self.points.T
        self.values = numpy.sin(7 * x) * numpy.cos(5 * y) + x
        self.side = max(2, int(cells ** 0.5))
        centres = (numpy.arange(self.side) + 0.5) / self.side
        x, y = numpy.meshgrid(centres, centres)
        self.places = {"raster": numpy.c_[x.ravel(), y.ravel()]}
        self.places["random"] = draw.permutation(self.places["raster"])


class Ours:
    note = ""

    def __init__(self, data, move=numpy.asarray, wait=lambda: None, **options):
        self._data, self._options, self._wait = data, options, wait
        self._points, self._values = move(data.points), move(data.values)
        self._random = move(data.places["random"])

    def build(self):
        self._interpolators = {"linear": KINDS["linear"](self._points, self._values, **self._options)}
        self._wait()

    def ask(self, method, order):
        """A function that asks, and about how many places."""
        if method not in self._interpolators:
            self._interpolators[method] = KINDS[method](self._points, self._values, **self._options)
        return functools.partial(self._ask, self._interpolators[method], order), self._data.side ** 2

    def _ask(self, interpolator, order):
        side = self._data.side
        if order == "raster":
            interpolator.raster((0.5 / side, 0.5 / side), 1 / side, (side, side))
        else:
            interpolator(self._random)
        self._wait()


class Theirs:
    """Another library. `build` returns a function that interpolates linearly by places, and one that does
    it by natural neighbours or None."""

    def __init__(self, data, build, move=numpy.asarray, wait=lambda: None):
        self._make, self._wait, self.note = build, wait, ""
        self._places = {order: move(places) for order, places in data.places.items()}
        few = slice(len(data.points) // 10)
        self._points, self._values = move(data.points[few]), move(data.values[few])
        self.build()  # for the first time, with all that is imported and compiled
        if 10 * measure(self.build) < SECONDS:
            self._points, self._values = move(data.points), move(data.values)
        else:
            self.note = f" ({len(self._points):,} points)"

    def build(self):
        self._functions = self._make(self._points, self._values)
        self._wait()

    def ask(self, method, order):
        """Does what that of Ours does; None: it does not know the method."""
        function, places, count = self._functions[method == "natural"], self._places[order], 1000
        if function is None:
            return None

        def ask():
            function(places[:count])
            self._wait()

        ask()
        count = min(len(places), max(count, int(count * SECONDS_OF_OTHERS / measure(ask))))
        return ask, count


def build_scipy(points, values):
    return importlib.import_module("scipy.interpolate").LinearNDInterpolator(points, values), None


def build_matplotlib(points, values):
    tri = importlib.import_module("matplotlib.tri")
    found = tri.LinearTriInterpolator(tri.Triangulation(*points.T), values)
    found(*points[:1].T)  # prepares it
    return lambda places: found(*places.T), None


def build_startinpy(points, values):
    mesh = importlib.import_module("startinpy").DT()
    mesh.snap_tolerance = 1e-12
    mesh.insert(numpy.c_[points, values])
    return tuple(lambda places, method=method: mesh.interpolate({"method": method}, places)
                 for method in ("TIN", "NNI"))


def build_cupyx(points, values):
    return importlib.import_module("cupyx.scipy.interpolate").LinearNDInterpolator(points, values), None


def list_programs(data, threads, takes_all):
    """Pairs of a name and a function that makes a program, ours first, and the names of those that are left
    out."""
    programs = [(f"threads: {count}", functools.partial(Ours, data, backend="threads", threads=count))
                for count in threads]
    absent, others = [], []

    def find(name):
        try:
            return importlib.import_module(name)
        except ImportError:
            absent.append(f"{name} (not installed)")
            return None

    cupy, torch = find("cupy"), find("torch")
    if not delaunayflip.has_cuda_device():
        absent.append("cuda (no GPU)")
        cupy = torch = None
    else:
        programs.append(("cuda", functools.partial(Ours, data, backend="cuda")))
    if cupy:
        wait = cupy.cuda.runtime.deviceSynchronize
        programs.append(("cuda, cupy", functools.partial(Ours, data, cupy.asarray, wait)))
        others.append(("cupyx", functools.partial(Theirs, data, build_cupyx, cupy.asarray, wait)))
    if torch:
        programs.append(("cuda, torch", functools.partial(
            Ours, data, lambda one: torch.as_tensor(one, device="cuda"), torch.cuda.synchronize)))
    if find("scipy"):
        others.append(("scipy", functools.partial(Theirs, data, build_scipy)))
    if not takes_all and len(data.points) > MOST_OF_MATPLOTLIB:
        absent.append("matplotlib (too many points)")
    elif find("matplotlib"):
        others.append(("matplotlib", functools.partial(Theirs, data, build_matplotlib)))
    if find("startinpy"):
        others.append(("startinpy", functools.partial(Theirs, data, build_startinpy)))
    return programs + others, absent


def measure(function):
    begin = measure.clock()
    function()
    return measure.clock() - begin


measure.clock = time.perf_counter


def run(program, rounds):
    """Lists of seconds to build and of places per second for each question."""
    found, begin = {question: [] for question in ("build", *QUESTIONS)}, time.perf_counter()
    for number in range(rounds):
        if number and time.perf_counter() - begin > SECONDS:
            break
        found["build"].append(measure(program.build))
        for question in QUESTIONS:
            asked = program.ask(*question.split())
            if asked:
                found[question].append(asked[1] / measure(asked[0]))
    return found


def measure_arithmetic(count, rounds):
    """The speed-up of as many processes over one."""
    seconds = {}
    for processes in (1, count):
        with multiprocessing.Pool(processes) as pool:
            run = functools.partial(pool.map, add_numbers, [20_000_000] * processes, 1)
            pool.map(add_numbers, [1000] * processes, 1)  # starts the processes
            seconds[processes] = statistics.median(measure(run) for _ in range(rounds))
    return count * seconds[1] / seconds[count]


def print_speed_ups(found, rounds):
    """`found` is what `run` returns, by number of threads."""
    for count in sorted(set(found) - {1}):
        line = f"{f'speed-up of {count} threads':28}{'':10}"
        for question in QUESTIONS:
            ratio = statistics.median(found[count][question]) / statistics.median(found[1][question])
            line += f"{ratio:24.3g}"
        print(f"{line}   arithmetic: {measure_arithmetic(count, rounds):.3g}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--points", type=lambda text: int(float(text)), default=1_000_000)
    parser.add_argument("--cells", type=lambda text: int(float(text)), default=4_000_000)
    parser.add_argument("--threads", type=lambda text: list(map(int, text.split(","))), default=[1, 0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--all", action="store_true", help="also what takes minutes")
    parser.add_argument("--processor-time", action="store_true", help="instead of the time that passes")
    arguments = parser.parse_args()
    if arguments.processor_time:
        measure.clock = time.process_time
    data = Data(arguments.points, arguments.cells)
    programs, absent = list_programs(data, arguments.threads, arguments.all)
    print(f"{arguments.points:,} points, {data.side ** 2:,} places, {arguments.rounds} rounds; threads: 0 "
          "takes all")
    print(f"{'':28}{'seconds':>10}" + "".join(f"{question:>24}" for question in QUESTIONS), flush=True)
    first, of_threads = None, {}
    for name, make in programs:
        program = make()
        found = run(program, arguments.rounds)
        first = first or found
        if name.startswith("threads: "):
            count = int(name.removeprefix("threads: "))
            of_threads[count or len(os.sched_getaffinity(0))] = found
        line = f"{name + program.note:28}{statistics.median(found['build']):10.3f}"
        for question, rates in list(found.items())[1:]:
            rate = statistics.median(rates) if rates else 0.0
            ratio = rate / statistics.median(first[question])
            text = f"{rate / 1e6:.3g} M/s ({ratio:.3g} x)" if rates else "-"
            line += f"{text:>24}"
        print(line, flush=True)
    if 1 in of_threads and not arguments.processor_time:
        print_speed_ups(of_threads, arguments.rounds)
    for name in absent:
        print(f"left out: {name}")


if __name__ == "__main__":
    main()
