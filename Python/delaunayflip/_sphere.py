# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Delaunay triangulation of points on a sphere, and values between them."""
from __future__ import annotations  # help() shows types by their names

import dataclasses
import functools
import math
import warnings
from typing import Any, Dict, Optional, Tuple

import numpy

from . import _arrays, _library, _report
from ._arrays import address
from ._ask import (
    Asked, Field, Interpolator, Method, Outside, Places, read_places, read_raster, require_same, require_triangles)
from ._options import Array, Backend, Numbers, OnIteration, Progress, convert, make_options
from ._points import Input, run_input
from ._report import Report
from ._rings import RingRule, Rings, list_lines, list_rings

#: The values of delaunayflip_projection.
PROJECTIONS = ("plane", "sphere", "open-sphere")
_ROUNDING = 1e-4  # in degrees; more than the rounding of latitudes given in radians in single precision


@dataclasses.dataclass(frozen=True, eq=False)
class SphereTriangulation(Asked):
    """What `triangulate_sphere` returns. Only the same object is equal: compare the arrays.

    It can be asked about places. The first question makes the engine's triangulation anew, which then
    stays in memory as long as this object. If many questions are known to come, `SphereInterpolator`
    triangulates only once.
    """

    #: (n, 3): x, y and z of the points, of length 1 if longitudes and latitudes were given; then those
    #: of lines and rings that are given by coordinates.
    points: Array
    triangles: Array  #: (m, 3) int32, counter-clockwise seen from outside.
    #: (m, 3) int32: the triangle opposite each corner; -1 where there is none.
    neighbors: Array
    iterations: Array  #: A row per iteration, structured; see Session.iterations.
    report: Report
    #: (n,) int64: the point that is used at the place of each point; -1: it is not finite, or inside of
    #: the convex hull of the others, or there are no triangles because all are in one plane. After an
    #: abort, each point itself.
    used_points: Array
    #: (k, 2) int64: the edges that segments have become, in their order and direction, each once.
    segments: Array
    segment_numbers: Array  #: (k,) int64: the segment of each of these edges; of several, the first one.
    _keywords: Dict[str, Any] = dataclasses.field(repr=False)  # Those of _triangulate.
    _made_from: Tuple[Any, Dict[str, Any]] = dataclasses.field(repr=False)  # Its points and lines.

    @functools.cached_property
    def voronoi_corners(self) -> Array:
        """(m, 3) float64: the center of the circumcircle of each triangle, on the unit sphere. The
        Voronoi cell of a point has as corners the centers of the triangles around it."""
        corners = _arrays.to_host(self.points)[_arrays.to_host(self.triangles)].astype(numpy.float64)
        if len(corners):  # products must neither overflow nor vanish
            corners = numpy.ldexp(corners, -int(numpy.frexp(abs(corners).max())[1]))
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        with numpy.errstate(invalid="ignore", divide="ignore"):  # triangles without area
            return normals / numpy.linalg.norm(normals, axis=1, keepdims=True)

    def _read_places(self, given):
        places = _read_directions(given, self._keywords["degrees"])
        if "degrees" in places.members:
            self._warn_of_latitudes(_arrays.to_host(places.like)[:, 1], "place")
        return places

    def _read_raster(self, origin, step, shape, like):
        factor = 1.0 if self._keywords["degrees"] else 180.0 / math.pi
        places = read_raster(origin, step, shape, like)
        for name in ("origin_x", "origin_y", "step_x", "step_y"):
            places.members[name] *= factor
        rows = numpy.arange(places.members["rows"])
        self._warn_of_latitudes(places.members["origin_y"] + rows * places.members["step_y"], "row")
        return places

    @staticmethod
    def _warn_of_latitudes(latitudes, kind):
        trouble = _describe_latitudes(latitudes, kind)
        if trouble:
            warnings.warn(trouble, stacklevel=4)  # in the line that asks

    def _triangulate_again(self):
        if self.report.stop_reason == "aborted":
            raise ValueError("the triangulation was stopped before its end, so it cannot be asked")
        points, lines = self._made_from
        again, _ = _triangulate(points, self._keywords, keeps=True, lines=lines)
        require_same(again, self)
        return again._answers


def triangulate_sphere(
    points: Numbers, segments: Optional[Numbers] = None, *, outline: Optional[Rings] = None,
    holes: Optional[Rings] = None, hole_seeds: Optional[Numbers] = None, ring_rule: RingRule = "evenodd",
    degrees: bool = True, open: bool = False, backend: Backend = "auto", threads: int = 0,
    device: int = -1, progress: Optional[Progress] = None, on_iteration: Optional[OnIteration] = None,
) -> SphereTriangulation:
    """The Delaunay triangulation of points on a sphere: the triangles of their convex hull.

    It is exact for the points as given, and depends on their places alone: not on their order, the
    threads or the GPU. n places have 2 n - 4 triangles.

    Points may be an array of CuPy, PyTorch or Numba on a GPU. If they are x, y and z, triangles and
    neighbors are arrays of that library, and without lines, rings and ties the points never leave the
    GPU. All other arrays are NumPy's; if points are angles, or lines or rings have coordinates, all are.

    Args:
        points: (n, 2) longitudes and latitudes, which become float64 places on the unit sphere. Multiples
            of 90 degrees are exact, so -180 and 180 are one longitude, and a pole is one place whatever its
            longitude. Or (n, 3) x, y and z, float32 or float64, on a sphere around the origin, used as
            they are. If several points are at one place, the one with the lowest id is used. Points that
            are not finite, or inside of the convex hull, are not used. Rounding to float32 puts points
            inside that are near to others. Warnings count points inside, and latitudes beyond 90 degrees.
        segments: (k, 2) point ids: edges that the triangulation must have. They run along great circles,
            the shorter way around; ends on opposite sides of the sphere are an error. One that passes
            through points is split there; one that crosses an earlier one is left out, with a warning. Or a
            list of lines, each an array of coordinates, of either kind, which become points. Longitudes
            and latitudes beside points in x, y and z are put at their median distance from the origin.
        outline: A ring, or a list of rings: only what is inside them is kept. A ring is a list of point ids,
            or of coordinates of either kind, which become points. It may end with its first point.
        holes: A ring, or a list of rings, of the same kinds: what is inside them is removed.
        hole_seeds: (k, 2) or (k, 3) places: what is reached from there without crossing a segment is
            removed.
        ring_rule: What is inside a ring, and a set of rings. "evenodd": the smaller of the two sides of a
            ring, whatever its direction; what is inside an odd number of rings. "nonzero": the same; where
            the turns of the rings do not add up to 0. "orientation": of the outline, what is to the left of
            any of the rings, as GeoJSON has it; of the holes, as "nonzero".
        degrees: Whether longitudes and latitudes are in degrees, not radians, in all arguments.
        open: Leave out a triangle if its circumcircle encloses half of the sphere or more, so that points
            on less than half of the sphere, or on one parallel, have an open mesh. Otherwise triangles
            close the mesh. Segments need points on all sides of the center, or this.
        backend, threads, device: As for `triangulate`.
        progress, on_iteration: Called with the share of the work done, 0 to 1, and at the end for each
            iteration with a dict of its numbers; returning False from `progress` aborts.

    Returns:
        A `SphereTriangulation`. It has no triangles if all places lie in one plane, except for rounding,
        which is warned of, or if progress aborts.

    Raises:
        InvalidMesh: A segment names a point that does not exist, or has ends on opposite sides; or a ring
            crosses a segment.
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError, ValueError.

    Example:
        >>> globe = triangulate_sphere([[0, 0], [90, 0], [180, 0], [270, 0], [0, 90], [0, -90]])
        >>> globe.triangles.shape
        (8, 3)
    """
    keywords = {"degrees": degrees, "open": open, "backend": backend, "threads": threads, "device": device}
    lines = {"segments": segments, "outline": outline, "holes": holes, "hole_seeds": hole_seeds,
             "ring_rule": ring_rule}
    result, troubles = _triangulate(points, keywords, progress, on_iteration, lines=lines)
    for text in troubles:
        warnings.warn(text, stacklevel=2)
    return result


class SphereInterpolator(Interpolator):
    """Interpolates values between points on a sphere.

    It is called with places: `f(lonlat)` with longitudes and latitudes, an array of shape (..., 2);
    `f(xyz)` with x, y and z, of shape (..., 3) and any length; or `f(longitude, latitude)` with two
    arrays that are broadcast. The result, float64, has the shape of the places and, if there are several
    values per point, the shape of these. It is the same on any number of threads.

    A place is outside if no triangle that faces away from the center of the sphere has it: if all points
    are on less than half of the sphere, everything beyond them; and what outlines and holes remove. Values
    at poles and at 180 degrees are like all others.

    Values and places may be arrays in the memory of a GPU, as for `LinearInterpolator`. Do not change the
    arrays of points and values as long as you use it. Threads may share an interpolator; they take turns.

    Args:
        points: As for `triangulate_sphere`.
        values: (n,) or (n, ...) real numbers: those of each point. Values of points that lines and rings add
            may follow. Otherwise these points get values that are linear between the given points, as if
            there were no segments.
        method: "linear": by spherical barycentric coordinates, the volumes that the place spans with two
            corners of its triangle and the center, divided by their sum. "natural": Sibson's natural
            neighbours in the plane that touches the sphere at the place; smooth except at the points.
            The points are projected from the place's antipode, which keeps circles as circles, so the
            neighbours are those on the sphere. Neighbours behind a segment do not count.
        segments, outline, holes, hole_seeds, ring_rule, open: As for `triangulate_sphere`.
        degrees: Whether longitudes and latitudes, of points, places and rasters, are in degrees, not
            radians. A warning counts places, or rows of a raster, with latitudes beyond 90 degrees.
        fill_value, outside, backend, threads, device: As for `LinearInterpolator`. A GPU answers if it is the
            backend, but threads answer fewer than 20,000 places of the host at a time.
        progress: Called with the share of the triangulation done, 0 to 1; False stops it.

    Attributes:
        triangulation: The `SphereTriangulation`.

    Raises:
        ValueError: The points have no triangles, because there are too few or all lie in one plane; or
            values do not fit them.
        delaunayflip.Stopped: progress has returned False.
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

    Example:
        >>> stations = [[0, 0], [90, 0], [180, 0], [270, 0], [0, 90], [0, -90]]
        >>> f = SphereInterpolator(stations, [0.0, 1.0, 2.0, 1.0, 5.0, -5.0])
        >>> f([[45, 0], [-180, 0], [123, 90]]).round(9).tolist()
        [0.5, 2.0, 5.0]
        >>> f.raster(origin=(0, 90), step=(90, -90), shape=(2, 4)).tolist()
        [[5.0, 5.0, 5.0, 5.0], [0.0, 1.0, 2.0, 1.0]]
    """

    def __init__(
        self, points: Numbers, values: Numbers, method: Method = "linear", *,
        segments: Optional[Numbers] = None, outline: Optional[Rings] = None, holes: Optional[Rings] = None,
        hole_seeds: Optional[Numbers] = None, ring_rule: RingRule = "evenodd", degrees: bool = True,
        open: bool = False, fill_value: float = math.nan, outside: Outside = "nan", backend: Backend = "auto",
        threads: int = 0, device: int = -1, progress: Optional[Progress] = None,
    ) -> None:
        how = {"method": method, "fill_value": fill_value, "outside": outside}
        keywords = {"degrees": degrees, "open": open, "backend": backend, "threads": threads, "device": device}
        lines = {"segments": segments, "outline": outline, "holes": holes, "hole_seeds": hole_seeds,
                 "ring_rule": ring_rule}
        self._made_from = (points, values), {**keywords, **lines, **how}
        if isinstance(points, tuple) and len(points) == 2:
            points = _arrays.join_columns(*points)
        self.triangulation, troubles = _triangulate(points, keywords, progress, keeps=True, lines=lines)
        require_triangles(self.triangulation.report)
        for text in troubles:
            warnings.warn(text, stacklevel=2)
        self._answers = self.triangulation._answers
        self._field = Field(self._answers, values, **how)


def _triangulate(points, keywords, progress=None, on_iteration=None, keeps=False, lines=None):
    """The SphereTriangulation of points, and the texts of warnings.

    Args:
        keywords: Those of `triangulate_sphere`.
        keeps: Whether the session is kept for questions.
        lines: The keywords of segments, outlines and holes; None: there are none.
    """
    backend = {name: keywords[name] for name in ("backend", "threads", "device")}
    keywords = {**keywords, **{name: convert(name, keywords[name], bool, None) for name in ("degrees", "open")}}
    given, misplaced = _read(points, keywords["degrees"], **(lines or {}))
    given.take_projection(PROJECTIONS.index("open-sphere" if keywords["open"] else "sphere"))
    given.backend = backend
    own = given.points[:given.struct.first_added]  # a copy where angles were given
    result = run_input(given, make_options(**backend), lambda _: (),
                       lambda handle, _: _store(handle, given, keywords, (own, lines)), progress, on_iteration,
                       keeps)
    return result, list(filter(None, (misplaced, "; ".join(given.trouble), _describe_distances(result))))


def _read(points, degrees, segments=None, outline=None, holes=None, hole_seeds=None, ring_rule="evenodd"):
    """The Input of places on the sphere, and the text of a warning, or "". Coordinates of lines, rings and
    seeds are converted as those of points."""
    troubles = []

    @functools.lru_cache(maxsize=None)
    def find_radius():  # of the sphere of the points; lines in longitudes and latitudes lie on it, too
        return 1.0 if has_angles else find_distances(own)[1]

    def place(coordinates, name=""):
        if coordinates.shape[1] == 3:
            return coordinates
        trouble = _describe_latitudes(_to_degrees(coordinates[:, 1], degrees), "point")
        if trouble:
            troubles.append(name + trouble)
        directions, radius = place_on_sphere(coordinates, degrees=degrees), find_radius()
        return directions if abs(radius - 1.0) < 1e-6 else radius * directions

    own = _arrays.as_plane(points)
    has_angles = own.shape[1] == 2
    places = place(_arrays.to_host(own) if has_angles else own)
    lines = list_lines(segments)
    rings = {}
    for name, value in (("outline", outline), ("holes", holes)):
        rings[name] = [ring if ring.ndim == 1 else place(ring, f"{name}: ") for ring in list_rings(name, value)]
    if lines:
        segments = [place(line, "segments: ") for line in lines]
    given = Input(places, segments, **rings, ring_rule=ring_rule)
    if hole_seeds is not None:
        given.take_seeds(place(_arrays.to_host(_arrays.as_plane(hole_seeds, "hole_seeds")), "hole_seeds: "))
    return given, "; ".join(dict.fromkeys(troubles))


def find_distances(points):
    """The smallest, the median and the largest distance of points from the origin."""
    points = _arrays.to_host(points).astype(numpy.float64)
    points = points[numpy.isfinite(points).all(axis=1)]
    scale = abs(points).max(initial=0.0)
    if scale == 0.0:
        return 1.0, 1.0, 1.0
    lengths = numpy.linalg.norm(points / scale, axis=1)
    return scale * lengths.min(), scale * float(numpy.median(lengths)), scale * lengths.max()


def _describe_distances(result):
    """A hint if points in x, y and z are not on a sphere around the origin, or ""."""
    report = result.report
    is_usual = len(result.triangles) > 0 and report.points_inside == 0
    if is_usual or report.stop_reason == "aborted":
        return ""
    trouble = describe_distances(result.points, 1.0001)
    return trouble and trouble + "; longitudes and latitudes are two columns, without heights"


def describe_distances(points, ratio):
    """The text of a warning if the largest distance of points from the origin is more than `ratio` times the
    smallest, or ""."""
    least, _, most = find_distances(points)
    if most <= ratio * least:
        return ""
    return f"the points are {least:.3g} to {most:.3g} from the origin, so they are not on a sphere around it"


def _read_directions(given, degrees):
    """Places as read_places reads them; one of x, y and z needs no second axis. Angles become degrees."""
    if len(given) == 1 and not isinstance(given[0], tuple):
        one = _arrays.read_table("places", given[0])
        shape = _arrays.as_array("places", one).shape if isinstance(one, list) else getattr(one, "shape", None)
        if shape is not None and tuple(shape) == (3,):
            one = [one] if isinstance(one, list) else one[None]
        given = [one]
    places = read_places(given)
    if places.members["place_components"] == 3:
        places.columns = 3
        return places
    if not degrees:
        turned = read_places([places.like * (180.0 / math.pi)])
        places = Places(turned.members, places.shape, turned.like)
    places.members["degrees"] = 1
    return places


def place_on_sphere(lonlat: Numbers, *, degrees: bool = True) -> Array:
    """Puts longitudes and latitudes on the unit sphere, as `triangulate_sphere` does. So an existing mesh of
    a globe can be flipped with `geometry="sphere"`.

    Args:
        lonlat: (n, 2) longitudes and latitudes. Multiples of 90 degrees are exact.
        degrees: Whether they are in degrees, not radians.

    Returns:
        (n, 3) float64: x, y and z; NaN where an angle is not finite.

    Raises:
        ValueError, TypeError: They are no real numbers of this shape.

    Example:
        >>> place_on_sphere([[90, 0], [0, -90]]).tolist()
        [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
    """
    degrees = convert("degrees", degrees, bool, None)
    angles = _arrays.to_host(_arrays.as_plane(lonlat, "lonlat"))
    if angles.shape[1] != 2 and len(angles):
        raise ValueError(f"lonlat must have the shape (n, 2), not {angles.shape}")
    angles = numpy.ascontiguousarray(_to_degrees(angles, degrees), dtype=numpy.float64)
    places = numpy.empty((len(angles), 3))
    _library.call("place_on_sphere", address(angles), len(angles), address(places))
    return places


def _to_degrees(angles, degrees):
    """Angles in degrees. Radians become degrees in their own precision: half a turn in single precision is
    180 degrees, and not a little more."""
    return angles if degrees else numpy.degrees(angles)


def find_misplaced(latitudes):
    """The ids of latitudes beyond 90 degrees."""
    return numpy.flatnonzero(abs(latitudes) > 90 + _ROUNDING)


def _describe_latitudes(latitudes, kind):
    """The text of a warning about latitudes beyond 90 degrees, or "". `kind`: what has them."""
    ids = find_misplaced(latitudes)
    if not len(ids):
        return ""
    first = ", ".join(map(str, ids[:3]))
    return (f"{len(ids):,} {kind}{'s' * (len(ids) > 1)} with a latitude beyond 90 degrees (first: {first}); "
            "longitudes come first")


def _store(handle, given, keywords, made_from):
    """The SphereTriangulation of a session that has ended."""
    report = _report.read(handle)
    triangles, neighbors = given.make_room(report)
    edges = numpy.empty((report.segment_edges, 2), dtype=numpy.int64)
    numbers = numpy.empty(report.segment_edges, dtype=numpy.int64)
    _arrays.store("triangles", handle, triangles, _library.TYPES["int32"])
    _arrays.store("neighbors", handle, neighbors)
    _library.call("store_segment_edges", handle, address(edges))
    _library.call("store_segments_of_edges", handle, address(numbers))
    used = given.find_used_points(handle, report)
    if used is None:
        used = numpy.arange(len(given.points))
        if len(triangles) == 0:
            _library.call("store_used_points", handle, address(used))
    if report.defects:
        report = dataclasses.replace(report, defects=given.describe_defects(handle))
    iterations = _report.read_iterations(handle, report)
    return SphereTriangulation(
        given.points, triangles, neighbors, iterations, report, used, edges, numbers, keywords, made_from)
