# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The Delaunay triangulation of points."""
from __future__ import annotations  # help() shows types by their names

import contextlib
import copy
import dataclasses
import functools
import math
import typing
import warnings
from ctypes import c_double, c_int32, c_int64, c_void_p
from typing import Any, Optional, Sequence, Tuple

import numpy

from . import _arrays, _library, _report
from ._arrays import address
from ._ask import Answers, Asked, require_same
from ._options import (
    Array, Backend, Numbers, OnIteration, Progress, choose, convert, list_ranges, make_options)
from ._report import Report, name_keywords
from ._rings import RING_RULES, RingRule, Rings, list_lines, list_rings
from ._session import LEFT_BY_REFINEMENT, Region, run

Heights = typing.Literal["survey", "own"]
UNSEEN = "unseen"  #: Heights where z does not matter: as "own", but nobody is told of points without.
Length = typing.Annotated[float, (0.0, math.inf)]
Angle = typing.Annotated[float, (0.0, 33.0)]
Count = typing.Annotated[int, (0, 2**63 - 1)]


class PointOptions(typing.TypedDict, total=False):
    """The numbers and switches of the engine among the keywords of `triangulate`. Interpolators and the VTK
    filter take them, too. Numbers have a range."""

    alpha: Length
    longest_edge: Length
    point_tolerance: Length
    split_crossings: bool
    minimum_angle: Angle
    maximum_area: Length
    maximum_edge: Length
    keep_boundary: bool
    point_limit: Count


POINT_OPTIONS = typing.get_type_hints(PointOptions)  #: The type of each.
POINT_RANGES = list_ranges(PointOptions)
#: delaunayflip_points.
Struct = _library.make_struct("Points", (
    (c_int64, "size"), (c_void_p, "points"), (c_int64, "number_of_points"),
    (c_int32, "point_type point_components"), (c_void_p, "segments"), (c_int64, "number_of_segments"),
    (c_void_p, "rings hole_seeds"), (c_int64, "number_of_hole_seeds"),
    (c_double, "point_tolerance alpha longest_edge"), (c_int32, "ring_rule split_crossings memory"),
    (c_void_p, "stream"), (c_int32, "first_hole"), (c_int64, "first_added"),
    (c_double, "minimum_angle maximum_area maximum_edge"), (c_int32, "keep_boundary"),
    (c_int64, "point_limit"), (c_void_p, "sizes regions"), (c_int64, "number_of_regions"),
    (c_int32, "projection reserved")))

# Kinds of defects that cause a warning: something that was given is not used as it is, or triangles do
# not reach the goals.
_WARNED_OF = ("segments cross", "segments not finite", "segments removed", "segments without triangles",
              "hole seeds outside", "rings without area", "rings repeated", "rings run again", "hole points outside",
              "points inside", "points in one plane", "segments inside", "nothing left",
              *LEFT_BY_REFINEMENT)


@dataclasses.dataclass(frozen=True, eq=False)
class Triangulation(Asked):
    """What `triangulate` returns. Only the same object is equal: compare the arrays.

    It can be asked about places. The first question makes the engine's triangulation anew, which then
    stays in memory as long as this object, and so do the first questions of copies. If many questions
    are known to come, `LinearInterpolator` and `NaturalNeighborInterpolator` triangulate only once.

    Without added points, `points` may be the caller's own array. If that changes, so do they, and a
    question is an error once the triangles are others.
    """

    #: (n, 2) or (n, 3): the points of the caller, then those of lines and rings that are given by
    #: coordinates, then those where segments cross, then those of refinement.
    points: Array
    triangles: Array  #: (m, 3) int32, counter-clockwise in x and y.
    #: (m, 3) int32: the triangle opposite each corner, -1 where there is none, as in SciPy.
    neighbors: Array
    #: (k, 2) int64: the edges that segments have become, in their order and direction, each once.
    segments: Array
    segment_numbers: Array  #: (k,) int64: the segment of each of these edges; of several, the first one.
    regions: Array  #: (m,) int32: the label of the region of each triangle, 0 where there is none.
    iterations: Array  #: A row per iteration, structured; see Session.iterations.
    report: Report
    _used: Optional[Array] = dataclasses.field(repr=False)  # None: each point is used
    #: Arguments and keywords, and the points that were inserted together.
    _made_from: Tuple[Any, Any, Tuple[Array, ...]] = dataclasses.field(repr=False)
    _added_segments: Array = dataclasses.field(repr=False)  # Those of the points that come last.

    @functools.cached_property
    def point_segments(self) -> Array:
        """(n,) int64: the segment on which refinement has put each point; -1: none."""
        others = numpy.full(len(self.points) - len(self._added_segments), -1)
        return numpy.concatenate([others, self._added_segments])

    @functools.cached_property
    def used_points(self) -> Array:
        """(n,) int64: the point that is used at the place of each point; -1: it is not finite. After
        an abort before there are triangles, each point itself."""
        return numpy.arange(len(self.points)) if self._used is None else self._used

    def insert(self, points: Numbers, *, progress: Optional[Progress] = None) -> Triangulation:
        """The triangulation of these points and more. Its triangles are those that `triangulate` would
        make of all points, perhaps in another order. This triangulation stays as it is, and so do
        interpolators.

        The engine's triangulation goes over to the new one, and grows. So insert many points at a time,
        such as 10,000, and go on with the new one: ``mesh = mesh.insert(points)``. If they are at most
        one in 32 of those that are there, all are in triangles, and none is on a segment, only the
        triangles around them are made anew, otherwise all.

        Args:
            points: (k, 2) or (k, 3), as many columns as the others. They are numbered after all others
                but those where segments cross, and get the precision of the others. Points at places of
                others, or that are not finite, are not used. Their z is kept; heights of rings and lines
                do not change. If the others are on a GPU, all arrays of the result are NumPy's. It warns as
                `triangulate` does, but of nothing that was the same before.
            progress: Called with the share of the work done, 0 to 1, if all is made anew; False stops it.

        Raises:
            ValueError: This triangulation was stopped before its end, the points do not fit it, or it
                has a `size` for each point, which new ones do not have.
            delaunayflip.Stopped: progress has returned False.
            InvalidMesh, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

        Example:
            >>> mesh = triangulate([[0, 0], [1, 0], [0, 1]])
            >>> mesh.insert([[0.25, 0.25]]).triangles.shape
            (3, 3)
        """
        result, trouble = self._insert(points, progress)
        new = [text for text in trouble if f"; {text};" not in f"; {self.report.defects};"]
        if new:
            warnings.warn("; ".join(new), stacklevel=2)
        return result

    def _insert(self, points, progress=None):
        """The triangulation with more points, and the texts of warnings."""
        answers = self.__dict__.pop("_answers", None)  # of two threads that insert one gets it
        if answers is None or answers.is_shared:
            answers = self._triangulate_again()
        try:
            more, batch = answers.given.append(points)
        except Exception:
            self.__dict__.setdefault("_answers", answers)
            raise
        try:
            answers = answers.insert(more, batch.struct, progress)
            result = answers.store((*self._made_from[:2], (*self._made_from[2], batch.points)))
        except _library.InvalidMesh as error:
            error.args = (more.explain(str(error), error.ring), *error.args[1:])
            raise
        result.__dict__["_answers"] = answers
        return result, more.trouble

    def _triangulate_again(self):
        if self.report.stop_reason == "aborted":
            raise ValueError("the triangulation was stopped before its end, so it cannot be asked, nor can "
                             "points be inserted")
        points, keywords, batches = self._made_from
        again, _ = run_points(points, keywords, keeps=True)
        for batch in batches:
            again, _ = again._insert(batch)
        require_same(again, self)
        return again._answers


def triangulate(
    points: Numbers, segments: Optional[Numbers] = None, *,
    outline: Optional[Rings] = None, holes: Optional[Rings] = None,
    hole_seeds: Optional[Numbers] = None, ring_rule: RingRule = "evenodd", alpha: float = 0.0,
    longest_edge: float = 0.0, point_tolerance: float = 0.0, split_crossings: bool = False,
    minimum_angle: float = 0.0, maximum_area: float = 0.0, maximum_edge: float = 0.0,
    size: Optional[Numbers] = None, regions: Sequence[Region] = (), keep_boundary: bool = False,
    point_limit: int = 0, heights: Optional[Heights] = None, backend: Backend = "auto",
    threads: int = 0, device: int = -1, maximum_iterations: int = -1, progress: Optional[Progress] = None,
    on_iteration: Optional[OnIteration] = None,
) -> Triangulation:
    """The Delaunay triangulation of points in x and y, constrained by segments if there are any.

    It is exact, and depends on the points alone: not on their order, the threads or the GPU. For
    points on one circle the same triangles are chosen as by `flip` with canonical ties. All
    triangles have an area; n places with h of them on the hull give 2 n - 2 - h triangles.

    Points may be an array of CuPy, PyTorch or Numba on a GPU. Then triangles and neighbors are arrays of
    that library. All other arrays are NumPy's; if rings are given by coordinates, all are.

    Args:
        points: (n, 2) or (n, 3) float32 or float64, used without a copy if contiguous. z is ignored.
            Pass (n, 3) as it is: the slice `points[:, :2]` is copied, which with a GPU takes longer
            than all the rest. If several points are at one place, the one with the lowest id is used.
            Points with NaN or infinite x or y are not used.
        segments: (k, 2) point ids: edges that the triangulation must have. One that passes through
            points is split there; one that crosses an earlier one is left out, with a warning. Or a list of
            lines, each an array of coordinates, (m, 2) or (m, 3), which become points as those of rings.
        outline: A ring, or a list of rings: only what is inside them is kept. A ring is a list of
            point ids, or of coordinates, which become points: (k, 2), or (k, 3) of floats; see heights. It
            may end with its first point. One without an area, or a second one with the same edges, is
            left out, with a warning.
        holes: A ring, or a list of rings, of the same kinds: what is inside them is removed.
        hole_seeds: (k, 2) places: what is reached from there without crossing a segment is removed.
        ring_rule: When a place is inside a set of rings. "evenodd": if a path to infinity crosses them
            an odd number of times. "nonzero": if their turns around the place do not add up to 0.
            "orientation": as "nonzero", but of the outline only counter-clockwise turns count as inside,
            as for vtkDelaunay2D. If the outline is clockwise only, what is outside of it is kept.
        alpha, longest_edge: Triangles with a larger circumradius, or a longer edge, are removed, unless
            they have a segment as an edge; 0: none.
        point_tolerance: Points nearer than this to one with a lower id are not used; 0: only those
            at equal places. Points where segments cross may be nearer.
        split_crossings: Split segments where they cross, instead of refusing the later one. The
            crossing is exact, rounded once; z is that of the earlier segment.
        minimum_angle, maximum_area, maximum_edge: Points are added until no angle is smaller, in degrees up
            to 33, and no triangle or edge is larger; 0: no limit. What cannot get better, because segments
            meet at a small angle, is left, and a warning counts it. z is linear between the points.
        size: (n,), the longest edge near each point, linear in between; NaN: no limit near that point.
        regions: (x, y, label[, area]): a place in what segments enclose, the label and largest area there.
        keep_boundary: Split no edge of the boundary. Triangles near it may then miss the goals.
        point_limit: Of the points that triangles use. 0: ten times as many as are given, at least a million.
        heights: z of points that lines and rings add. "survey": that of the points there, linear in
            their triangulation without segments, and beyond its hull that of the nearest place on it.
            "own": that of the lines and rings, 0 for those of two columns. None: "survey" for those
            without heights (two columns, z that is not finite, or all lines, the outline or the holes have
            z = 0 throughout) if other points have heights, with a warning that counts them; else "own".
        backend, threads, device: "cuda", "threads", or "auto": a GPU for many points if there is one. 0
            threads: as many as the machine has. Device: CUDA's number of the GPU; -1: the current one.
        maximum_iterations: -1: until done; 0: the triangulation that flips start from. Rounds count, too.
        progress, on_iteration: Called with the share of the work done, 0 to 1, also after each round of
            refinement, and after each iteration of flips with a dict of its numbers; False aborts.

    Returns:
        A `Triangulation`. It has no triangles if all places lie on one line, or progress aborts early.

    Raises:
        InvalidMesh: A segment names a point that does not exist, or a ring crosses a segment.
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError, ValueError.

    Example:
        >>> result = triangulate([[0, 0], [1, 0], [0, 1], [1, 1.1]])
        >>> sorted(sorted(ids) for ids in result.triangles.tolist())
        [[0, 1, 2], [1, 2, 3]]
    """
    keywords = dict(locals())
    del keywords["points"], keywords["progress"], keywords["on_iteration"]
    result, trouble = run_points(points, keywords, progress, on_iteration)
    if trouble:
        warnings.warn(trouble, stacklevel=2)
    return result


def run_points(points, keywords, progress=None, on_iteration=None, keeps=False):
    """The Triangulation of points, and the text of a warning, or "".

    Args:
        keywords: Those of `triangulate`.
        keeps: Whether the session is kept for questions.
    """
    given, options = _prepare(points, **keywords)
    start, count = given.points, given.struct.first_added
    if given is points:
        start = given
    elif count < len(start):
        start = start[:count]
    result = run_input(given, options, given.make_room,
                       lambda handle, room: given.store(handle, room, (start, keywords, ())),
                       progress, on_iteration, keeps)
    return result, "" if given is points else "; ".join(given.trouble)


def run_input(given, options, make_room, store, progress, on_iteration, keeps):
    """What store(handle, room) makes of the session of an Input. `keeps`: whether it can be asked."""
    with contextlib.ExitStack() as stack:
        try:
            handle, room = stack.enter_context(
                run("open_points", given.struct, options, make_room, progress, on_iteration))
            result = store(handle, room)
        except (_library.InvalidMesh, _library.InvalidOptions) as error:
            error.args = (given.explain(str(error), getattr(error, "ring", -1)), *error.args[1:])
            raise
        if keeps:
            result.__dict__["_answers"] = Answers(given, handle, stack.pop_all())
    return result


def _prepare(
        points, segments=None, *, heights=None, size=None, regions=(), backend="auto", threads=0,
        device=-1, maximum_iterations=-1, **others):
    """The Input with its struct, and the options, from the arguments of `triangulate`."""
    rings = {name: value for name, value in others.items() if name not in POINT_OPTIONS}
    given = points if isinstance(points, Input) else Input(points, segments, **rings)
    for name, kind in POINT_OPTIONS.items():
        if name in others:
            setattr(given.struct, name, convert(name, others[name], kind, POINT_RANGES.get(name)))
    given.backend = {"backend": backend, "threads": threads, "device": device}
    options = make_options(triangulate, maximum_iterations=maximum_iterations, **given.backend)
    if given is not points:
        given.take_heights(heights)
    given.take_sizes(size)
    given.take_regions(regions)
    return given, options


def interpolate_in_survey(points, values, places, backend, projection=0):
    """Values at places, (n, k), linear in the triangulation of points alone; outside of it, those of the
    nearest place on its boundary. None if there are no triangles.

    Args:
        backend: Keywords that say where it runs.
        projection: That of the struct.
    """
    given = Input(points)
    given.struct.projection = projection
    survey, _ = run_points(given, backend, keeps=True)
    if survey.report.triangles == 0:
        return None
    return survey.interpolate(values, places, outside="nearest")


#: What a message says of points without heights: why, what "own" keeps, and what becomes of the mesh; by
#: whether some have z = 0 and some a z that is not finite.
_HEIGHT_WORDS = {
    (True, False): ("z = 0 throughout", "z = 0", "the mesh goes to z = 0 there; if it should not"),
    (False, True): ("z is not finite", "their z", "the mesh has no heights there; if it should"),
    (True, True): ("z = 0 throughout, or not finite", "their z",
                   "the mesh goes to z = 0 there, or has no heights; if it should not"),
}
#: For each added point three ids, -1 where there are only two, and as many weights.
_NOTHING_ADDED = numpy.empty((0, 3), dtype=numpy.int64), numpy.empty((0, 3))


class Batch:
    """Points alone and their C struct, which takes a fraction of the time of an Input."""

    def __init__(self, points):
        self.points, self.struct = _arrays.as_plane(points), _library.make(Struct)
        _fill_points(self.struct, self.points)


def _fill_points(struct, points):
    struct.points, struct.point_type, struct.memory, struct.stream = _arrays.describe(points)
    struct.number_of_points, struct.point_components = points.shape


class Input:
    """The arrays of a call, which live as long, and their C struct."""

    triangle_order = "triangles"  #: Or "ordered_triangles", as the engine calls what it stores.
    are_properties = False  #: Whether the caller knows options by the names of VTK's properties.
    are_lifted = False  #: Whether points without heights have got some.

    def __init__(self, points, segments=None, *, ring_numbers=None, outline=None, holes=None,
                 hole_seeds=None, ring_rule="evenodd"):
        """`ring_numbers`: of the rings of the segments; -1: none."""
        self.struct, self.added, self.new_points = _library.make(Struct), _NOTHING_ADDED, []
        points = _arrays.as_plane(points)
        lines = list_lines(segments)
        self.segments = [_arrays.as_ids("segments", [] if segments is None or lines else segments, 2)]
        if ring_numbers is None:
            ring_numbers = numpy.full(len(self.segments[0]), -1)
        self.rings = [numpy.asarray(ring_numbers, dtype=numpy.int32)]
        self.flat_rings, self.trouble, given = [], [], len(points)
        self._ring_names = {}  # of the rings of outline and holes, by their numbers
        for line in lines:
            ids = self._add_places(line, points)
            self._add_segments(ids[:-1], ids[1:], -1)
        count = self.rings[0].max(initial=-1) + 1
        for name, rings in (("outline", outline), ("holes", holes)):
            self.struct.first_hole = count  # in the end where those of `holes` begin
            for number, ring in enumerate(list_rings(name, rings)):
                self._add_ring(ring, count, points)
                self._ring_names[count] = f"ring {number} of {name}"
                count += 1
        if self.new_points:
            points = numpy.concatenate([_arrays.to_host(points), *self.new_points])
        self.points = points
        seeds = numpy.empty((0, 2))
        if hole_seeds is not None:
            seeds = _arrays.to_host(_arrays.as_plane(hole_seeds, "hole_seeds"))[:, :2]
        self.all_segments = numpy.concatenate(self.segments).astype(numpy.int64, order="C")
        self.all_rings = numpy.concatenate(self.rings)
        self._fill_struct(count > 0, ring_rule)
        self.take_seeds(seeds)
        self.struct.first_added = given
        self.find_flat_points(given, self.all_segments, self.all_rings)

    def _fill_struct(self, has_rings, ring_rule):
        struct = self.struct
        _fill_points(struct, self.points)
        struct.segments, struct.number_of_segments = address(self.all_segments), len(self.all_segments)
        struct.rings = address(self.all_rings) if has_rings else None
        struct.ring_rule = choose("ring_rule", ring_rule, RING_RULES)

    def take_seeds(self, seeds):
        """Takes the places of hole seeds, two or, on a sphere, three coordinates each."""
        self.seeds = numpy.ascontiguousarray(seeds, dtype=numpy.float64)
        self.struct.hole_seeds, self.struct.number_of_hole_seeds = address(self.seeds), len(self.seeds)

    def take_projection(self, projection):
        """Takes that of the struct. On a sphere z is no height."""
        self.struct.projection = projection
        if projection:
            self._tell_of_heights(UNSEEN)

    def _add_ring(self, ring, number, points):
        if ring.ndim == 2:
            ids = self._add_places(ring, points)
        else:
            ids = ring if len(ring) or len(points) == 0 else numpy.zeros(1, int)  # so that it counts
        if len(ids) > 1 and ids[0] == ids[-1]:
            ids = ids[:-1]
        self._add_segments(ids, numpy.roll(ids, -1), number)

    def _add_places(self, coordinates, points):
        """The ids of new points. If the last one is at the first one, it has the same id."""
        is_closed = len(coordinates) > 2 and numpy.array_equal(coordinates[0], coordinates[-1])
        places = coordinates[:-1] if is_closed else coordinates
        added = numpy.zeros((len(places), points.shape[1]), dtype=_arrays.type_of(points))
        columns = min(places.shape[1], points.shape[1])
        added[:, :columns] = places[:, :columns]
        ids = len(points) + sum(map(len, self.new_points)) + numpy.arange(len(places))
        self.new_points.append(added)
        if places.shape[1] == 2:
            self.flat_rings.append(ids)
        return numpy.append(ids, ids[:1]) if is_closed else ids

    def _add_segments(self, starts, ends, ring):
        self.segments.append(numpy.stack([starts, ends], axis=1))
        self.rings.append(numpy.full(len(starts), ring, dtype=numpy.int32))

    def append(self, points):
        """The Input of all points with more of them, and the Input of these."""
        batch = Batch(numpy.array(_arrays.to_host(_arrays.as_plane(points))))
        columns = self.points.shape[1] if len(self.points) else batch.points.shape[1]
        if len(batch.points) and batch.points.shape[1] != columns:
            raise ValueError(f"points must have {columns} columns, as those of the triangulation, not "
                             f"{batch.points.shape[1]}")
        more = copy.copy(self)
        own = _arrays.to_host(self.points)
        own = own.reshape(-1, columns)
        more.points = numpy.concatenate([own, batch.points.reshape(-1, columns).astype(own.dtype)])
        more.struct = type(self.struct).from_buffer_copy(self.struct)
        more.struct.point_components = columns
        more.struct.first_added = len(more.points)  # The values of added points are needed.
        more.trouble, more.added = [], _NOTHING_ADDED
        return more, batch

    def explain(self, text, ring=-1):
        """A message of the engine, which may name a ring, in the caller's words."""
        text = text.replace(f"ring {ring}", self._name_ring(ring), 1)
        return text if self.are_properties else name_keywords(text, POINT_OPTIONS)

    def _name_ring(self, number):
        return self._ring_names.get(number, f"ring {number}")

    def describe_defects(self, handle):
        """The defects as one text. Notes those that are warned of."""
        texts = []
        for kind, ids, given in _report.list_defects(handle):
            text = self.explain(given)
            if kind in _WARNED_OF:
                if self._ring_names and kind.startswith("rings"):
                    named = ", ".join(map(self._name_ring, ids))
                    text = f"{text.partition(' (first: ')[0]} (first: {named})"
                self.trouble.append(text)
            texts.append(text)
        return "; ".join(texts)

    def describe_again(self, handle):
        """The defects of a session that goes on, as one text, and a list of those that are warned of."""
        self.trouble = []
        return self.describe_defects(handle), self.trouble

    def find_flat_points(self, given, segments, rings):
        """Finds the points behind the `given` ones without heights, where other heights are given: those
        that rings of two columns have, or that lines, outlines or holes have, each of the three by itself,
        if z = 0 wherever it is finite; and those with a z that is not finite."""
        self.flat_points = self.nan_points = numpy.empty(0, dtype=numpy.int64)
        if len(self.points) == given or self.points.shape[1] < 3:
            return
        if segments.min(initial=0) < 0 or segments.max(initial=0) >= len(self.points):
            return  # the engine refuses them
        heights = self.points[:, 2]
        is_finite = numpy.isfinite(heights)
        self.heights = heights[:given][is_finite[:given]]
        if len(self.heights) == 0:
            return
        ids = numpy.unique(segments)
        self.nan_points = ids[(ids >= given) & ~is_finite[ids]].astype(numpy.int64)
        if self.heights.any():
            kinds = numpy.where(rings < 0, -1, rings >= self.struct.first_hole)
            known = numpy.where(is_finite, heights, 0)
            flat = [kind for kind in (-1, 0, 1) if not known[segments[kinds == kind]].any()]
            ends = segments[numpy.isin(kinds, flat)].ravel()
            ids = numpy.unique(numpy.concatenate([ends, *self.flat_rings]))
            self.flat_points = ids[(ids >= given) & is_finite[ids]].astype(numpy.int64)

    def choose_lifted(self, heights, added):
        """The ids of the points that get heights of the others, ascending. Only those are told of that are
        without heights and not because it was asked for.

        Args:
            heights: As for `triangulate`, or UNSEEN.
            added: The ids of all that may get some.
        """
        if heights is not None and not (isinstance(heights, str) and heights == UNSEEN):
            choose("heights", heights, typing.get_args(Heights))
        lifted = added[:0]
        if heights is None:
            lifted = numpy.union1d(self.flat_points, self.nan_points)
        elif heights == "survey":
            lifted = added
        self._tell_of_heights(heights)
        return lifted

    def _tell_of_heights(self, heights):
        """Forgets points without heights of which nobody has to be told."""
        if heights is not None:
            self.flat_points = self.flat_points[:0]
        if heights in ("survey", UNSEEN):
            self.nan_points = self.nan_points[:0]

    def take_heights(self, heights):
        """Gives points of rings the heights of the caller's points. `heights`: as for `triangulate`."""
        first = self.struct.first_added
        lifted = self.choose_lifted(heights, numpy.arange(first, len(self.points)))
        if len(lifted) == 0 or self.points.shape[1] < 3:
            return
        survey = self.points[:first]
        found = interpolate_in_survey(survey, survey[:, 2:], self.points[lifted], self.backend)
        if found is None:
            return
        self.points[lifted, 2] = found[:, 0]
        self.are_lifted = True

    def take_sizes(self, sizes):
        """Takes the longest edges near points; None: no limit."""
        if sizes is None:
            return
        values, shape = _arrays.as_values(_arrays.to_host(sizes), "size")
        if shape:
            raise ValueError("size must have one number for each point, not the shape "
                             f"{tuple(numpy.shape(sizes))}")
        self.sizes = numpy.ascontiguousarray(self.complete_values(values, "size"))
        self.struct.sizes = address(self.sizes)

    def take_regions(self, regions):
        """Takes regions, as `triangulate` gets them."""
        self.regions = _arrays.as_regions("regions", regions)
        self.struct.regions, self.struct.number_of_regions = address(self.regions), len(self.regions)

    def _report_flat_points(self, report, triangles):
        """Adds the points without heights that are corners of triangles to the defects."""
        at_zero, not_finite = (
            len(ids) and numpy.count_nonzero(numpy.isin(ids, triangles))
            for ids in (self.flat_points, self.nan_points))
        count = at_zero + not_finite
        if count == 0:
            return report
        low, high = float(self.heights.min()), float(self.heights.max())
        what, kept, fate = _HEIGHT_WORDS[at_zero > 0, not_finite > 0]
        fate += ", give them heights, for example those of the nearest points"
        if self.are_lifted:
            own = "SegmentHeights Own" if self.are_properties else 'heights="own"'
            fate = f"they have got the heights of the given points there; {own} keeps {kept}"
        self.trouble.append(
            f"{count} {'point' if count == 1 else 'points'} of segments without heights ({what}; the given "
            f"points have z = {low:g} to {high:g}): {fate}")
        defects = "; ".join(filter(None, (report.defects, self.trouble[-1])))
        return dataclasses.replace(report, defects=defects)

    def own_points(self):
        """Copies the points, which the caller may change."""
        self.points = self.points.copy()
        self.struct.points = address(self.points)

    def share_segments(self, other):
        """Takes the arrays of another Input with the same segments, of which a session has views."""
        self.all_segments, self.all_rings = other.all_segments, other.all_rings
        self.struct.segments, self.struct.rings = other.struct.segments, other.struct.rings

    def make_room(self, report):
        """Arrays for the triangles that a report counts and for their neighbors."""
        shape = (report.triangles, 3)
        return [_arrays.make_empty(self.points, shape, "int32") for _ in range(2)]

    def store(self, handle, room, made_from):
        """The Triangulation of a session that has ended. `room`: from make_room."""
        report = _report.read(handle)
        if len(room[0]) != report.triangles:
            room = self.make_room(report)
        triangles, neighbors = room
        edges = numpy.empty((report.segment_edges, 2), dtype=numpy.int64)
        segments = numpy.empty(report.segment_edges, dtype=numpy.int64)
        regions = numpy.zeros(report.triangles, dtype=numpy.int32)
        _arrays.store(self.triangle_order, handle, triangles, _library.TYPES["int32"])
        _arrays.store("neighbors", handle, neighbors)
        _library.call("store_segment_edges", handle, address(edges))
        _library.call("store_segments_of_edges", handle, address(segments))
        if self.struct.number_of_regions:
            _library.call("store_regions", handle, address(regions))
        used = self.find_used_points(handle, report)
        points, added = self.points, numpy.empty(0, dtype=numpy.int64)
        if report.defects:
            report = dataclasses.replace(report, defects=self.describe_defects(handle))
        report = self._report_flat_points(report, triangles)
        if self._is_nothing_left(report, triangles):
            self.trouble = [report.defects]
        if report.crossings + report.refinement_points:
            points, added = self._append_added(handle, report.crossings + report.refinement_points)
            report = dataclasses.replace(report, points=len(points))
        iterations = _report.read_iterations(handle, report)
        first, keywords, batches = made_from
        if not isinstance(first, Input) and len(first) < len(points):
            first = points[:len(first)]  # the caller may change the other array, but this is a copy
        return Triangulation(
            points, triangles, neighbors, edges, segments, regions, iterations, report, used,
            (first, keywords, batches), added)

    def _is_nothing_left(self, report, triangles):
        """Whether triangles are removed, and none is left that has one of the caller's points."""
        if report.outside_triangles + report.large_triangles == 0:
            return False
        if len(triangles) == 0:
            return True
        first_added = self.struct.first_added
        if not 0 < first_added < len(self.points):
            return False  # all points are the caller's, which may be on a GPU
        return int(triangles.min()) >= first_added

    def find_used_points(self, handle, report):
        """The point that is used at the place of each one, also of added ones; None if that is always the
        point itself, so that nothing has to come from a GPU."""
        if not (report.points_not_finite or report.repeated_points or report.points_too_near
                or report.points_inside):
            return None
        count = len(self.points)
        used = numpy.arange(count + report.crossings + report.refinement_points)
        _library.call("store_used_points", handle, address(used))
        return used

    def _append_added(self, handle, count):
        """The points, with those that were made behind them, and the segments of these."""
        first, columns = self.points.shape
        points = numpy.empty((first + count, columns), dtype=_arrays.type_of(self.points))
        _arrays.copy_to_host(self.points, points[:first])
        places, weights = points[first:], numpy.empty((count, 3))
        is_in_place = columns == 2 and points.dtype == numpy.float64
        if not is_in_place:
            places = numpy.empty((count, 2))
        ids, segments = numpy.empty((count, 3), dtype=numpy.int64), numpy.empty(count, dtype=numpy.int64)
        _library.call("store_added_weights", handle, address(places), address(ids), address(weights),
                      address(segments))
        if not is_in_place:
            points[first:, :2] = places
        self.added = ids, weights
        if columns > 2:
            self.fill_added(points[:, 2:], first)
        return points, segments

    def fill_added(self, values, first):
        """Writes values of added points, from row `first` on: those of others, each times its weight. Some
        of these may be added ones themselves, before them."""
        ids, weights = self.added
        highest = numpy.maximum.accumulate(ids.max(axis=1, initial=-1))
        begin = 0
        while begin < len(ids):
            end = max(begin + 1, int(numpy.searchsorted(highest, first + begin)))
            near, share = ids[begin:end], weights[begin:end, :, None]
            some = share[:, 0] * values[near[:, 0]] + share[:, 1] * values[near[:, 1]]
            is_third = near[:, 2] >= 0
            some[is_third] += share[is_third, 2] * values[near[is_third, 2]]
            values[first + begin:first + end] = some
            begin = end

    def complete_values(self, values, name="values"):
        """Values of all the session's points from those of the caller's, of shape (n, k): at points of
        lines and rings from the caller's points, at added ones by their weights. Values of all points
        are returned as they are."""
        first, count = self.struct.first_added, len(self.points)
        total = count + len(self.added[0])
        if len(values) == total:
            return values
        if len(values) not in (first, count):
            more = f", or {total} with those that lines, rings, crossings and refinement have added"
            raise ValueError(f"{name} must have {first} rows, one for each point"
                             f"{more if total > first else ''}; there are {len(values)}")
        whole = numpy.empty((total, values.shape[1]))
        whole[:len(values)] = given = _arrays.to_host(values)
        if len(values) < count:
            points = _arrays.to_host(self.points)
            found = interpolate_in_survey(
                points[:first], given, points[first:], self.backend, self.struct.projection)
            if found is None:
                raise ValueError(f"{name} must have {count} rows, with those of the points of lines and rings, "
                                 f"because the {first} given points alone have no triangle; there are {len(values)}")
            whole[first:count] = found
        self.fill_added(whole, count)
        return _arrays.move(whole, values)
