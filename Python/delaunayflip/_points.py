# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Delaunay triangulation of points."""
import ctypes
import dataclasses
from typing import Optional

import numpy

from . import _arrays, _library, _report
from ._device import to_host
from ._options import Array, Backend, Numbers, OnIteration, Progress, make_options
from ._report import Report
from ._session import Observers


@dataclasses.dataclass(frozen=True, eq=False)
class Triangulation:
    """What `triangulate` returns. Only the same object is equal: compare the arrays."""

    points: Array  #: The points of the caller, (n, 2) or (n, 3).
    triangles: Array  #: (m, 3) int32, counter-clockwise in x and y.
    #: (m, 3) int32: the triangle opposite each corner, -1 where there is none, as in SciPy.
    neighbors: Array
    #: (n,) int64: the point that is used at the place of each point; -1: it is not finite.
    used_points: Array
    report: Report


def triangulate(
    points: Numbers, *, backend: Backend = "auto", threads: int = 0, device: int = -1,
    maximum_iterations: int = -1, progress: Optional[Progress] = None,
    on_iteration: Optional[OnIteration] = None,
) -> Triangulation:
    """The Delaunay triangulation of points in x and y.

    It is exact, and depends on the points alone: not on their order, the threads or the GPU. For
    points on one circle the same triangles are chosen as by `flip` with canonical ties. All
    triangles have an area; n places with h of them on the hull give 2 n - 2 - h triangles.

    Args:
        points: (n, 2) or (n, 3) float32 or float64, used without a copy if contiguous; z does not
            matter. Of points at equal places that with the lowest id is used. Points with NaN or
            infinite x or y are not used.
        backend: "cuda", "threads", or "auto": a GPU for many points if there is one.
        threads: 0: as many as the machine has.
        device: CUDA's number of the GPU; -1: the current one.
        maximum_iterations: -1: until done; 0 gives the valid triangulation that flips start from.
        progress: Called with the share of the work done, 0 to 1; returning False aborts.
        on_iteration: Called after each iteration with a dict of its numbers; False aborts.

    Returns:
        A `Triangulation`. Without triangles if fewer than three places are given, or all lie on one
        line, or if progress aborts before there are any.

    Raises:
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

    Example:
        >>> result = triangulate([[0, 0], [1, 0], [0, 1], [1, 1.1]])
        >>> sorted(sorted(ids) for ids in result.triangles.tolist())
        [[0, 1, 2], [1, 2, 3]]
    """
    points = _arrays.as_plane(to_host(points))
    struct = _library.make(_library.Mesh)
    struct.points, struct.number_of_points = _arrays.address(points), len(points)
    struct.point_type = _library.TYPES[points.dtype.name]
    struct.point_components = points.shape[1]
    options = make_options(backend=backend, threads=threads, device=device,
                           maximum_iterations=maximum_iterations)
    handle = ctypes.c_void_p()
    with Observers(progress).raising() as callbacks:
        _library.call("open_points", struct, options, callbacks, handle)
    try:
        report = _read_report(handle)
        if report.stop_reason != "aborted":
            with Observers(progress, on_iteration).raising() as callbacks:
                _library.call("advance", handle, -1, callbacks, None)
            report = _read_report(handle)
        triangles = numpy.empty((report.number_of_triangles, 3), dtype=numpy.int32)
        neighbors = numpy.empty_like(triangles)
        used = numpy.full(len(points), -1)
        _library.call("store_triangles", handle, _arrays.address(triangles), _library.TYPES["int32"])
        _library.call("store_neighbors", handle, _arrays.address(neighbors))
        _library.call("store_used_points", handle, _arrays.address(used))
        return Triangulation(points, triangles, neighbors, used, report)
    finally:
        _library.library().delaunayflip_close(handle)


def _read_report(handle):
    struct = _library.make(_library.Report)
    _library.call("get_report", handle, struct)
    return _report.from_struct(struct)
