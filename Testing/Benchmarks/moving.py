#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Moves random points frame by frame, beside a triangulation from scratch, on one machine and in one run.

    PYTHONPATH=build/lib/python3/dist-packages python3 Testing/Benchmarks/moving.py \\
      [--points 1000000] [--steps 0.001,0.01,0.03,0.1,0.3,1] [--changes 100,10000,50000] [--frames 5] \\
      [--threads 1,2]

Steps are the standard deviations of normal ones, in units of the distance of points. A row has the median
milliseconds of a frame, from places to triangles; those of `triangulate` for the same places; in how many
frames the mesh has followed the points; and the rounds of the last frame. All frames are counted but the
first, which makes the arrays that are kept.

Then so many points as --changes says are removed at a time, and as many inserted, beside a triangulation of
what is there then. For insertions `in place` is not known.

threads: N  arrays of NumPy
cuda        the same on a GPU
cuda, cupy  arrays of CuPy that stay on the GPU
"""
import argparse
import importlib.util
import statistics
import time

import numpy

import delaunayflip


def list_programs(threads):
    """Yields for each backend its name, a function that moves an array there, one that waits, and options."""
    for number in threads:
        yield f"threads: {number}", numpy.asarray, lambda: None, {"backend": "threads", "threads": number}
    if not delaunayflip.has_cuda_device():
        print("cuda: there is no GPU")
        return
    yield "cuda", numpy.asarray, lambda: None, {"backend": "cuda"}
    if importlib.util.find_spec("cupy"):
        import cupy
        yield "cuda, cupy", cupy.asarray, cupy.cuda.Device().synchronize, {"backend": "cuda"}
    else:
        print("cuda, cupy: not installed")


def measure(wait, work):
    """The milliseconds that the work takes."""
    wait()
    start = time.perf_counter()
    work()
    wait()
    return 1000 * (time.perf_counter() - start)


def run(points, step, frames, bring, wait, options):
    """A row: the median times of a frame and from scratch, the frames in place, the rounds of the last one."""
    draw = numpy.random.default_rng(2)
    size = step / numpy.sqrt(len(points))
    moved, scratch, rounds = [], [], []
    with delaunayflip.MovingTriangulation(bring(points), **options) as mesh:
        for _ in range(frames + 1):
            points = points + draw.normal(0, size, points.shape)
            places = bring(points)

            def move():
                mesh.move(places)
                mesh.triangles

            moved.append(measure(wait, move))
            rounds.append(mesh.report.move_rounds)
            scratch.append(measure(wait, lambda: delaunayflip.triangulate(places, **options)))
    in_place = sum(number > 0 for number in rounds[1:])
    return statistics.median(moved[1:]), statistics.median(scratch[1:]), in_place, rounds[-1]


def change(points, count, frames, bring, wait, options):
    """Two rows, of removals and of insertions: the median times, those from scratch, and how many in place."""
    draw = numpy.random.default_rng(3)
    removals, insertions, in_place = [], [], 0
    with delaunayflip.MovingTriangulation(bring(points), **options) as mesh:
        for frame in range(frames + 1):
            ids = draw.choice(len(points), count, replace=False)
            more = 0.001 + 0.998 * draw.random((count, 2))  # in the hull

            def remove():
                mesh.remove(ids)
                mesh.triangles

            def insert():
                mesh.insert(more)
                mesh.triangles

            for work, times in ((remove, removals), (insert, insertions)):
                changed = measure(wait, work)
                if work is remove:
                    in_place += frame > 0 and mesh.report.move_rounds > 0
                    points = numpy.delete(points, ids, axis=0)
                    mesh.compact()
                else:
                    points = numpy.concatenate([points, more])
                places = bring(points)
                times.append((changed, measure(wait, lambda: delaunayflip.triangulate(places, **options))))
    for times, number in ((removals, in_place), (insertions, "")):
        yield [statistics.median(column) for column in zip(*times[1:])] + [number]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--steps", default="0.001,0.01,0.03,0.1,0.3,1")
    parser.add_argument("--changes", default="100,10000,50000")
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--threads", default="1,2")
    given = parser.parse_args()
    points = numpy.random.default_rng(1).random((given.points, 2))
    print(f"{given.points} points, medians of {given.frames} frames")
    print(f"{'':12} {'step':>6} {'frame ms':>9} {'scratch ms':>10} {'in place':>8} {'rounds':>6}")
    for name, bring, wait, options in list_programs(given.threads.split(",")):
        options = {key: int(value) if key == "threads" else value for key, value in options.items()}
        for step in map(float, filter(None, given.steps.split(","))):
            frame, scratch, in_place, rounds = run(points, step, given.frames, bring, wait, options)
            print(f"{name:12} {step:6g} {frame:9.2f} {scratch:10.2f} {in_place:8} {rounds:6}", flush=True)
        for count in map(int, filter(None, given.changes.split(","))):
            rows = change(points, count, given.frames, bring, wait, options)
            for what, (changed, scratch, in_place) in zip(("remove", "insert"), rows):
                print(f"{name:12} {what} {count} {changed:9.2f} {scratch:10.2f} {in_place:8}", flush=True)


if __name__ == "__main__":
    main()
