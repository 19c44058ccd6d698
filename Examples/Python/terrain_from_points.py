#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the mesh of a terrain from scattered points and two breaklines, the edges of a slope, within
an outline and without a pond. It needs NumPy, not VTK.
"""
import delaunayflip
import numpy

HALF_WIDTH = 0.02  # of the slope


def get_middle(x):
    """The middle of the slope."""
    return 0.5 + 0.15 * numpy.sin(6 * x)


def add_heights(x, y):
    """Points on hills that a steep slope divides."""
    slope = numpy.clip((y - get_middle(x)) / HALF_WIDTH, -1, 1)
    return numpy.c_[x, y, 0.08 * slope + 0.02 * numpy.sin(9 * x) * numpy.cos(7 * y)]


def make_circle(x, y, radius, count):
    angles = 2 * numpy.pi * numpy.arange(count) / count
    return add_heights(x + radius * numpy.cos(angles), y + radius * numpy.sin(angles))


survey = add_heights(*numpy.random.default_rng(3).random((2, 600)))
along = numpy.linspace(0.08, 0.92, 43)
edges = [add_heights(along, get_middle(along) + side * HALF_WIDTH) for side in (-1, 1)]
points = numpy.concatenate([survey, *edges])
# Each breakline joins its points one after the other.
first = len(survey) + numpy.arange(len(along) - 1)
segments = numpy.concatenate([numpy.c_[start, start + 1] for start in (first, first + len(along))])

terrain = delaunayflip.triangulate(
    points, segments, outline=make_circle(0.5, 0.5, 0.5, 60), holes=[make_circle(0.5, 0.2, 0.08, 20)])
print(f"{len(terrain.triangles)} triangles, {len(terrain.segments)} edges along segments,",
      f"{terrain.report.outside_triangles} triangles outside removed")
