# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Delaunay triangulation of points on a sphere."""
from __future__ import annotations  # help() shows types by their names

import dataclasses
import functools
import warnings
from typing import Optional

import numpy

from . import _arrays, _library, _report
from ._arrays import address
from ._options import Array, Backend, Numbers, OnIteration, Progress, make_options
from ._points import Struct
from ._report import Report
from ._session import run

#: The values of delaunayflip_projection.
PROJECTIONS = ("plane", "sphere", "open-sphere")
_ROUNDING = 1e-4  # in degrees; more than the rounding of latitudes given in radians in single precision


@dataclasses.dataclass(frozen=True, eq=False)
class SphereTriangulation:
    """What `triangulate_sphere` returns. Only the same object is equal: compare the arrays."""

    points: Array  #: (n, 3): x, y and z of the points, of length 1 if longitudes and latitudes were given.
    triangles: Array  #: (m, 3) int32, counter-clockwise seen from outside.
    #: (m, 3) int32: the triangle opposite each corner; -1 where there is none.
    neighbors: Array
    iterations: Array  #: A row per iteration, structured; see Session.iterations.
    report: Report
    #: (n,) int64: the point that is used at the place of each point; -1: it is not finite, or inside of
    #: the convex hull of the others.
    used_points: Array

    @functools.cached_property
    def voronoi_corners(self) -> Array:
        """(m, 3) float64: the center of the circumcircle of each triangle, on the unit sphere. The
        Voronoi cell of a point has as corners the centers of the triangles around it."""
        corners = self.points[self.triangles].astype(numpy.float64)
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        with numpy.errstate(invalid="ignore", divide="ignore"):  # triangles without area
            return normals / numpy.linalg.norm(normals, axis=1, keepdims=True)


def triangulate_sphere(
    points: Numbers, *, degrees: bool = True, open: bool = False, backend: Backend = "auto",
    threads: int = 0, device: int = -1, progress: Optional[Progress] = None,
    on_iteration: Optional[OnIteration] = None,
) -> SphereTriangulation:
    """The Delaunay triangulation of points on a sphere: the triangles of their convex hull.

    It is exact for the points as given, and depends on their places alone: not on their order, the
    threads or the GPU. n places have 2 n - 4 triangles. Segments and queries about places are not
    supported yet.

    Args:
        points: (n, 2) longitudes and latitudes, which become float64 places on the unit sphere. Multiples
            of 90 degrees are exact, so -180 and 180 are one longitude, and a pole is one place whatever its
            longitude. Or (n, 3) x, y and z, float32 or float64, on a sphere around the origin, used as
            they are. If several points are at one place, the one with the lowest id is used. Points that
            are not finite, or inside of the convex hull, are not used. Rounding to float32 puts points
            inside that are near to others. Warnings count points inside, and latitudes beyond 90 degrees.
        degrees: Whether longitudes and latitudes are in degrees, not radians.
        open: Leave out triangles whose circumcircle encloses half of the sphere or more, so that points
            on less than half of the sphere have an open mesh. Otherwise triangles close the mesh.
        backend, threads, device: As for `triangulate`. Arrays on a GPU are copied to the host.
        progress, on_iteration: Called with the share of the work done, 0 to 1, and at the end for each
            iteration with a dict of its numbers; returning False from `progress` aborts.

    Returns:
        A `SphereTriangulation`. It has no triangles if all places lie in one plane, or progress aborts.

    Raises:
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError, ValueError.

    Example:
        >>> globe = triangulate_sphere([[0, 0], [90, 0], [180, 0], [270, 0], [0, 90], [0, -90]])
        >>> globe.triangles.shape
        (8, 3)
    """
    struct = _library.make(Struct)
    places, misplaced = _place_on_sphere(_arrays.to_host(_arrays.as_plane(points)), degrees)
    struct.points, struct.number_of_points = address(places), len(places)
    struct.point_type, struct.point_components = _library.TYPES[_arrays.type_of(places)], 3
    struct.projection = PROJECTIONS.index("open-sphere" if open else "sphere")
    options = make_options(backend=backend, threads=threads, device=device)
    with run("open_points", struct, options, lambda _: (), progress, on_iteration) as (handle, _):
        result, trouble = _store(handle, places)
    for text in filter(None, (misplaced, trouble)):
        warnings.warn(text, stacklevel=2)
    return result


def _place_on_sphere(points, degrees):
    """x, y and z of points, given as these or as longitudes and latitudes, and the text of a warning, or
    ""."""
    if points.shape[1] == 3:
        return points, ""
    angles = numpy.ascontiguousarray(points if degrees else numpy.degrees(points), dtype=numpy.float64)
    places = numpy.empty((len(angles), 3))
    _library.call("place_on_sphere", address(angles), len(angles), address(places))
    return places, _describe_latitudes(angles[:, 1])


def _describe_latitudes(latitudes):
    """The text of a warning about latitudes beyond 90 degrees, or ""."""
    ids = numpy.flatnonzero(abs(latitudes) > 90 + _ROUNDING)
    if not len(ids):
        return ""
    first = ", ".join(map(str, ids[:3]))
    return (f"{len(ids):,} point{'s' * (len(ids) > 1)} with a latitude beyond 90 degrees (first: {first}); "
            "longitudes come first")


def _store(handle, places):
    """The SphereTriangulation of a session that has ended, and the text of a warning, or ""."""
    report = _report.read(handle)
    triangles = numpy.empty((report.triangles, 3), dtype=numpy.int32)
    neighbors = numpy.empty((report.triangles, 3), dtype=numpy.int32)
    used = numpy.arange(len(places))
    _arrays.store("triangles", handle, triangles, _library.TYPES["int32"])
    _arrays.store("neighbors", handle, neighbors)
    _library.call("store_used_points", handle, address(used))
    trouble = ""
    if report.points_inside:
        trouble = "; ".join(
            text for kind, _, text in _report.list_defects(handle) if kind == "points inside")
    iterations = _report.read_iterations(handle, report)
    return SphereTriangulation(places, triangles, neighbors, iterations, report, used), trouble
