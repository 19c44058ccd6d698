# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A mesh for the tests of arrays, on the CPU and on the GPU."""

import numpy


def sheared_lattice(side):
    """A lattice with rows pushed sideways: many bad edges, all in one plane."""
    row, column = numpy.divmod(numpy.arange(side * side), side)
    points = numpy.column_stack([column + 5.25 * row, row, 0 * row]).astype(float)
    corner = numpy.arange(side * side).reshape(side, side)[:-1, :-1].ravel()
    lower = numpy.column_stack([corner, corner + 1, corner + side + 1])
    upper = numpy.column_stack([corner, corner + side + 1, corner + side])
    return points, numpy.concatenate([lower, upper])
