# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Interpolation between points, called as in scipy.interpolate."""
from __future__ import annotations  # help() shows types by their names

import math
import typing
import warnings
from typing import Optional

from . import _arrays
from ._ask import METHODS, Field, Interpolator, Method, Outside, halve, require_triangles
from ._options import Array, Backend, Numbers, Progress, Unpack, choose, show_options
from ._points import POINT_OPTIONS, UNSEEN, PointOptions, run_points, triangulate
from ._rings import RingRule, Rings

Breaklines = typing.Literal["hard", "soft"]


class LinearInterpolator(Interpolator):
    """Interpolates values between points, linear in each triangle of their Delaunay triangulation.

    It is called with places, as SciPy's LinearNDInterpolator: `f(xy)` with an array of shape (..., 2),
    or `f(x, y)` with two arrays that are broadcast. The result, float64, has the shape of the places
    and, if there are several values per point, the shape of these. Neighbouring places one after the
    other are faster, and a raster is fastest. The result is the same on any threads or GPU.

    Values and places may be arrays of CuPy, PyTorch or Numba in the memory of a GPU, or of libraries
    with DLPack. The result is where the places are, an array of their library.

    Do not change the arrays of points and values as long as you use it: they may not be copied.

    Threads may share an interpolator; they take turns. A copy, or one that is unpickled, triangulates
    again at once. Its memory is freed with it.

    Args:
        points: (n, 2) or (n, 3), as for `triangulate`, or a pair of arrays, x and y.
        values: (n,) or (n, ...) real numbers: those of each point. Values of points that lines, rings
            and crossings add may follow. If they do not, those of lines and rings are linear between
            the points, in their triangulation without segments, or beyond their hull those of the
            nearest place on it. Those at crossings are linear along the earlier segment.
        segments, outline, holes, hole_seeds, ring_rule: As for `triangulate`. What is removed there is
            outside.
        fill_value: The value outside, instead of NaN.
        outside: "nan": fill_value. "nearest": the value at the nearest place on the boundary of the
            triangles. "error": a ValueError tells how many places are outside.
        breaklines: "hard": triangles, and natural neighbours, end at segments. "soft": segments, and
            the edges of rings, only say what is outside; the values inside come from the triangulation
            of the same points without them, and without crossings, also at the nearest places of
            outside="nearest".
        backend, threads, device, and all that follow progress: As for `triangulate`.
        progress: Called with the share of the triangulation done, 0 to 1; False stops it.

    Attributes:
        triangulation: The `Triangulation`.

    Raises:
        ValueError: The points have no triangles, because there are too few or all lie on one line; or
            values do not fit them.
        delaunayflip.Stopped: progress has returned False.
        InvalidMesh, InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

    Example:
        >>> f = LinearInterpolator([[0, 0], [1, 0], [0, 1], [1, 1]], [0.0, 1.0, 2.0, 3.0])
        >>> f([[0.5, 0.25], [2, 2]]).tolist()
        [1.0, nan]
        >>> f.raster(origin=(0.25, 0.75), step=(0.5, -0.5), shape=(2, 2)).tolist()
        [[1.75, 2.25], [0.75, 1.25]]
    """

    _method: Method = "linear"

    def __init__(
        self, points: Numbers, values: Numbers, *, segments: Optional[Numbers] = None,
        outline: Optional[Rings] = None, holes: Optional[Rings] = None,
        hole_seeds: Optional[Numbers] = None, ring_rule: RingRule = "evenodd",
        fill_value: float = math.nan, outside: Outside = "nan", breaklines: Breaklines = "hard",
        backend: Backend = "auto", threads: int = 0, device: int = -1,
        progress: Optional[Progress] = None, **options: Unpack[PointOptions],
    ) -> None:
        unknown = options.keys() - POINT_OPTIONS.keys()
        if unknown:
            raise TypeError(f"{min(unknown)!r} is not an option")
        if isinstance(points, tuple) and len(points) == 2:
            points = _arrays.join_columns(*points)
        keywords = {
            "segments": segments, "outline": outline, "holes": holes, "hole_seeds": hole_seeds,
            "ring_rule": ring_rule, "backend": backend, "threads": threads, "device": device, **options}
        how = {"fill_value": fill_value, "outside": outside}
        self._made_from = (points, values), {**keywords, **how, "breaklines": breaklines}
        is_soft = choose("breaklines", breaklines, typing.get_args(Breaklines)) == 1
        is_soft &= any(given is not None for given in (segments, outline, holes))
        first = halve(progress, 0.0) if is_soft else progress
        self.triangulation, trouble = _keep(points, {**keywords, "heights": UNSEEN}, first)
        if trouble:
            warnings.warn(trouble, stacklevel=2)
        self._answers, soft = self.triangulation._answers, None
        self._answers.is_shared = True
        if is_soft:
            given = self._answers.given
            keywords = {"point_tolerance": options.get("point_tolerance", 0.0), **given.backend}
            soft = _keep(given.points, keywords, halve(progress, 0.5))[0]._answers
        self._field = Field(self._answers, values, method=self._method, soft=soft, **how)


show_options(LinearInterpolator.__init__, triangulate, POINT_OPTIONS)


class NaturalNeighborInterpolator(LinearInterpolator):
    """Interpolates values between points by natural neighbours (Sibson): the value of each neighbour
    counts as much as the area that a new point at the place would take from its Voronoi cell.

    The result is smooth except at the points, where it has their values, and linear functions are
    reproduced. Neighbours behind a segment do not count; near a segment values approach what is linear
    along it. Everything else is as for `LinearInterpolator`.
    """

    _method: Method = "natural"


def griddata(
    points: Numbers, values: Numbers, xi: Numbers, method: Method = "linear",
    fill_value: float = math.nan,
) -> Array:
    """Interpolates values between points once, called as scipy.interpolate.griddata in two dimensions.

    Args:
        points, values, fill_value: As for `LinearInterpolator`.
        xi: The places: an array of shape (..., 2), or a pair of arrays, x and y.
        method: "linear", or "natural" for natural neighbours.

    Example:
        >>> griddata([[0, 0], [1, 0], [0, 1]], [0.0, 1.0, 2.0], [[0.25, 0.5]]).tolist()
        [1.25]
    """
    kinds = (LinearInterpolator, NaturalNeighborInterpolator)
    return kinds[choose("method", method, METHODS)](points, values, fill_value=fill_value)(xi)


def _keep(points, keywords, progress):
    """Does what run_points does, and requires triangles."""
    triangulation, trouble = run_points(points, keywords, progress, keeps=True)
    require_triangles(triangulation.report)
    return triangulation, trouble
