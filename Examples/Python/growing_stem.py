#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A young stem grows: it becomes longer near its tip, winds and bends to the light. No point is added, so
its triangles become slivers, unless their edges are flipped after each step. It needs NumPy, not VTK.

    growing_stem.py [POINTS] [STEPS]
"""
import sys

import delaunayflip
import numpy


def make_stem(count):
    """The angles and heights of points on a tube of height 1, and its triangles."""
    around = max(8, round(numpy.sqrt(count)))  # about as far apart along the stem as around it
    rows = max(4, round(count / around))
    row, column = numpy.divmod(numpy.arange(rows * around), around)
    shake = numpy.random.default_rng(3).uniform(-0.3, 0.3, (2, len(row)))
    inner = (row > 0) & (row < rows - 1)
    angles = 2 * numpy.pi * (column + shake[0] + 0.5 * (row % 2)) / around
    heights = (row + inner * shake[1]) / (rows - 1)
    first = numpy.arange((rows - 1) * around)
    second = first - first % around + (first + 1) % around
    # Rows are shifted by half a column, so the diagonal changes its side.
    odd = (first // around % 2 == 1)[:, None]
    below, above = numpy.c_[first, second], numpy.c_[first, second] + around
    even = numpy.c_[below, above[:, 0], below[:, 1], above[:, 1], above[:, 0]]
    shifted = numpy.c_[below, above[:, 1], below[:, 0], above[:, 1], above[:, 0]]
    return angles, heights, numpy.where(odd, shifted, even).reshape(-1, 3)


def grow(angles, heights, time):
    """The places of the points at a time from 0 to 1."""
    stretched = heights + 1.5 * time * heights**3  # most near the tip
    wound = angles + 4.0 * time * heights**2
    bend = 1.2 * time * heights**2  # the angle of the stem's axis, in radians
    radius = 0.16 * (1 - 0.6 * heights) * (1 + 0.3 * time)
    order = numpy.argsort(heights, kind="stable")
    lengths = numpy.diff(stretched[order], prepend=0.0)
    axis = numpy.empty((len(heights), 2))
    axis[order] = numpy.cumsum(lengths[:, None] * numpy.c_[numpy.sin(bend), numpy.cos(bend)][order], axis=0)
    outwards = radius * numpy.cos(wound)
    return numpy.c_[axis[:, 0] + outwards * numpy.cos(bend), radius * numpy.sin(wound),
                    axis[:, 1] - outwards * numpy.sin(bend)]


def run(count, steps):
    """Yields the places, the flipped triangles, those of the beginning, and the report of each step."""
    angles, heights, triangles = make_stem(count)
    before = triangles
    for step in range(steps + 1):
        places = grow(angles, heights, step / steps)
        result = delaunayflip.flip(places, triangles, geometry="surface", feature_angle=180)
        triangles = result.triangles
        yield places, triangles, before, result.report


def main():
    count, steps = (int(number) for number in (*sys.argv[1:3], 4000, 30)[:2])
    flips = 0
    for places, triangles, before, report in run(count, steps):
        flips += report.total_flips
    kept, flipped = (delaunayflip.smallest_angles(places, mesh) for mesh in (before, triangles))
    print(f"{steps} steps of {len(places)} points, {flips} flips; triangles below 20 degrees:",
          f"{(flipped < 20).sum()} of {len(flipped)}, without flips {(kept < 20).sum()}")


if __name__ == "__main__":
    main()
