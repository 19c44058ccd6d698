# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A run in steps, the whole run in one call, and Python functions as the engine's callbacks."""
from __future__ import annotations  # help() shows types by their names

import contextlib
import ctypes
import dataclasses
import functools
import signal
import threading
import warnings
from typing import Any, Optional, Sequence, Tuple, TypeVar, Union

import numpy

from . import _arrays, _library, _report
from ._options import (
    GOALS, Array, Backend, Criterion, Devices, Geometry, Numbers, OnIteration, Options, Progress, TieRule, Unpack,
    check_integer, choose, has_goal, make_options, show)
from ._report import Report, name_keywords

try:  # these do not convert numbers to enumerations, which would take most of the time of a small call
    from _signal import getsignal as _get_handler, signal as _set_handler
except ImportError:
    from signal import getsignal as _get_handler, signal as _set_handler

_SIGNALS = tuple(map(int, signal.Signals))
#: The kinds of defects that tell what refinement has left, and what it could not use.
LEFT_BY_REFINEMENT = ("triangles not refined", "point limit reached", "region seeds outside",
                      "region seeds repeated", "options without goal", "triangles not judged")
#: x, y, label and perhaps the largest area of a triangle.
Region = Tuple[float, ...]
_REFINEMENT = (*GOALS, "keep_boundary", "point_limit", "maximum_iterations")


def _raise_after(raised, act, *arguments):
    """What act(*arguments) returns. After it, the exception in `raised` is raised, if there is one. Until
    then, what handlers of signals raise, such as that of Ctrl-C, goes there too: ctypes would swallow it in
    a callback, and it cannot interrupt what `act` does. Only the main thread has handlers."""
    own, is_over = {}, False

    def handle(number, frame):
        try:
            own[number](number, frame)
        except BaseException as error:
            if is_over:  # exceptions have kept this handler from being put back
                raise
            raised[:] = [error]  # the others would keep memory

    try:
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                handler = _get_handler(number)
                if callable(handler):
                    own[number] = handler
                    _set_handler(number, handle)
        return act(*arguments)
    finally:
        try:
            _put_back(own, handle)
        except BaseException as error:  # it came from a handler that was put back already
            raised[:] = [error]
            _put_back(own, handle)
        finally:
            is_over = True
        if raised:
            raise raised.pop()


def _put_back(own, handle):
    """Sets the handlers of signals again in place of `handle`, unless a callback has set another one."""
    for number, handler in own.items():
        if _get_handler(number) is handle:
            _set_handler(number, handler)


def observe(act, progress=None, on_iteration=None):
    """What act(callbacks) returns, with these observers as callbacks for the engine. If one raises an
    exception, the run is aborted and the exception raised after `act`.

    There is always a progress callback, even without an observer: while Python runs in it, the
    interpreter handles signals, so Ctrl-C works.
    """
    for word, function in (("progress", progress), ("on_iteration", on_iteration)):
        if function is not None and not callable(function):
            raise TypeError(f"{word} must be a function, not {show(function)}")
    raised = []

    def ask(function, value):
        """Returns 0, which aborts, if the function returned False or raised an exception."""
        try:
            # Not again after an exception, of which one is raised: the others would keep memory.
            answer = function(value) if function is not None and not raised else None
            if isinstance(answer, (bool, numpy.bool_)) and not answer:
                return 0
        except BaseException as error:
            raised.append(error)
        return int(not raised)

    def tell_iteration(record, _):
        values = record.contents
        return ask(on_iteration, {name: getattr(values, name) for name, _ in values._fields_})

    callbacks = _library.make(_library.Callbacks)
    callbacks.progress = _library.ProgressFunction(lambda share, _: ask(progress, share))
    if on_iteration is not None:
        callbacks.iteration = _library.IterationFunction(tell_iteration)
    return _raise_after(raised, act, callbacks)


def call(name, first, second, last, progress=None, on_iteration=None):
    """Calls a function of the engine, with these observers as its third argument."""
    observe(lambda callbacks: _library.call(name, first, second, callbacks, last), progress, on_iteration)


@contextlib.contextmanager
def run(name, struct, options, make_room, progress, on_iteration):
    """A whole run: gives the handle of its session and the room for its results, which
    `make_room` makes when the report of the opened session is known."""
    handle = ctypes.c_void_p()

    def act(callbacks):
        _library.call(name, struct, options, callbacks, ctypes.byref(handle))
        report = _report.read_struct(handle)
        room = make_room(report)
        if not _report.is_aborted(report):
            _arrays.expect(handle, *room)
            _library.call("advance", handle, -1, callbacks, None)
        return room

    try:
        yield handle, observe(act, progress, on_iteration)
    finally:
        _library.run("close", handle)


@contextlib.contextmanager
def _with_keywords(names=_REFINEMENT):
    """Puts these keywords into messages of the engine, in place of its own names of options."""
    try:
        yield
    except _library.InvalidOptions as error:
        error.args = (name_keywords(str(error), names), *error.args[1:])
        raise


def _read_report(handle, names=_REFINEMENT):
    report = _report.read(handle)
    if report.defects:
        report = dataclasses.replace(report, defects=name_keywords(report.defects, names))
    return report


_Self = TypeVar("_Self", bound="Handle")


class Handle:
    """What the engine keeps for an object: it does one thing at a time, and is freed at last."""

    _what = "session"  # in messages
    _user = None  #: What stands for the call that is at work.

    def __init__(self):
        self._handle = ctypes.c_void_p()

    def __enter__(self: _Self) -> _Self:
        self._alone(lambda _: None)
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self.close()

    def __reduce__(self) -> Any:
        raise TypeError(f"a {self._what} cannot be copied or pickled")

    def close(self) -> None:
        """Frees the memory of the engine. Nothing else can be called afterwards; closing again is
        allowed."""
        self._alone(self._free, may_be_closed=True)

    def _free(self, handle):
        self._handle = None
        if handle:
            _library.run("close", handle)

    def _alone(self, act, *arguments, may_be_closed=False):
        """What act(handle, *arguments) returns; meanwhile nothing else can use the handle.

        The handler of a signal may raise an exception after any call, also after one that has just locked
        something. So the lock is a member that is set within `try`, and removed without a call.
        """
        own = object()
        try:
            if self.__dict__.setdefault("_user", own) is not own:
                raise RuntimeError(f"the {self._what} is at work: observers and other threads have to wait "
                                   "until its call has returned")
            if not self._handle and not may_be_closed:
                raise ValueError(f"the {self._what} is closed")
            return act(self._handle, *arguments)
        finally:
            if self._user is own:
                del self._user


class Session(Handle):
    """Flips a mesh step by step.

    Points, triangles and keywords are those of `flip`. Building finds the edges and tests them all;
    `advance` flips. The arrays must not change while the session lives. A session is a context
    manager; leaving it frees its memory. It does one thing at a time: while a call is at work, its
    observers and other threads get RuntimeError; it cannot be copied. With `triangle_numbers`, (m,)
    integers, reports name the triangles by these.

    Points and triangles may be arrays of CuPy, PyTorch or Numba in the memory of a GPU: float32 or
    float64, and int32 or int64. They are flipped there, after what is in the library's current
    stream, and results are arrays of the library of the triangles. Arrays of other libraries are
    viewed by DLPack, with CuPy or PyTorch, of which the results then are. Only to insert
    constraints, for `backend="threads"`, or if the GPU fails, the mesh is copied to the host.

    With goals of refinement, a round counts as an iteration, and adds points and triangles.

    Example:
        >>> import numpy
        >>> points = numpy.array([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]], dtype=float)
        >>> triangles = numpy.array([[0, 1, 2], [0, 2, 3]])
        >>> with Session(points, triangles) as session:
        ...     print(session.report.non_delaunay_before, "bad edge")
        ...     while session.advance(1):
        ...         print(session.report.total_flips, "flips so far")
        ...     print(session.report.stop_reason)
        1 bad edge
        converged
    """

    _keywords = _REFINEMENT  # these appear in messages

    def __init__(
        self, points: Numbers, triangles: Numbers, *, constraints: Optional[Numbers] = None,
        insert_constraints: Union[bool, Numbers] = True, regions: Optional[Numbers] = None,
        frozen: Optional[Numbers] = None, triangle_numbers: Optional[Numbers] = None,
        size: Optional[Numbers] = None, region_seeds: Sequence[Region] = (),
        progress: Optional[Progress] = None, **options: Unpack[Options],
    ) -> None:
        super().__init__()
        self._mesh = _arrays.Mesh(points, triangles, constraints, regions, frozen,
                                  insert_constraints, triangle_numbers, size, region_seeds)
        _require_xyz(points, options.get("geometry"))
        self._refines = self._mesh.has_goals or any(has_goal(options, goal) for goal in GOALS)
        with _with_keywords(self._keywords):
            call("open", self._mesh.struct, make_options(**options), ctypes.byref(self._handle), progress)

    def advance(
        self, iterations: int = -1, *, progress: Optional[Progress] = None,
        on_iteration: Optional[OnIteration] = None,
    ) -> bool:
        """Runs at most so many more iterations; -1: until nothing is left to flip.

        Args:
            iterations: How many, or -1.
            progress: Called with the share of the work that is done, 0 to 1; False aborts.
            on_iteration: Called after each iteration with a dict of its numbers; False aborts.

        Returns:
            Whether there is more to do and the run was not aborted.
        """
        iterations = check_integer("iterations", iterations, -1, 2**63 - 1)
        running = ctypes.c_int32()
        self._alone(lambda handle: call("advance", handle, iterations, ctypes.byref(running), progress,
                                        on_iteration))
        return bool(running.value)

    def move(self, points: Numbers, *, progress: Optional[Progress] = None) -> None:
        """Moves all points. The triangles are at first those that flips have made, and `advance` goes on
        with them, which takes few flips if the points have moved a little. Edges that have stayed so far
        stay, also if they are no longer sharp. The report, iterations and flips are counted anew.

        It is for the CPU: with a GPU choose ``backend="threads"``.

        Args:
            points: (n, 3) or (n, 2), as many as there are. They are copied, in the precision of the first.
            progress: Called first; if it returns False, all points stay where they are.

        Raises:
            delaunayflip.Stopped: progress has returned False.
            InvalidOptions: The mesh is on a GPU, is refined, or has seeds of regions; points are not finite;
                or geometry="auto" would choose another geometry now. Nothing has changed; begin another
                session.
            MemoryError, TypeError, ValueError.

        Example:
            >>> import numpy
            >>> points = numpy.array([[0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]], dtype=float)
            >>> with Session(points, [[0, 1, 2], [0, 2, 3]], backend="threads") as session:
            ...     running = session.advance()
            ...     points[1], points[3] = [2, -3, 0], [2, 3, 0]
            ...     session.move(points)
            ...     running = session.advance()
            ...     print(session.report.total_flips, "flip")
            1 flip
        """
        from ._points import Batch  # which needs this file
        places = _arrays.as_points(_arrays.to_host(points)).astype(_arrays.type_of(self._mesh.points))
        given = Batch(places)

        def act(handle, callbacks):
            _library.call("move_points", handle, given.struct, None, callbacks)
            self._mesh.points = places

        self._alone(lambda handle: observe(functools.partial(act, handle), progress))

    @property
    def report(self) -> Report:
        """The `Report` on the run so far."""
        return self._alone(_read_report, self._keywords)

    @property
    def iterations(self) -> Array:
        """A structured array with a row per iteration: iteration, tested, non_delaunay, flipped,
        excluded, blocked, minimum_angle (degrees; NaN where it was not computed) and seconds."""
        return self._alone(lambda handle: _report.read_iterations(handle, _report.read(handle)))

    @property
    def triangles(self) -> Array:
        """The triangles so far in their input order, a new array of the input's integers, (m, 3). Those
        that refinement has added follow."""
        triangles = self._mesh.make_triangles(self._count_triangles())
        self.store_triangles(triangles)
        return triangles

    @property
    def points(self) -> Array:
        """The points, followed by those that refinement has added so far."""
        return self._read_points()[0]

    @property
    def sources(self) -> Array:
        """(m,) int32: for each triangle its source, the triangle before refinement that contains its
        centroid. The triangle gets the data of its source."""
        count = self._count_triangles()
        return self._alone(self._mesh.read_sources, count)

    @property
    def regions(self) -> Array:
        """(m,) int32: the label of the region of each triangle, 0 where no seed names one."""
        count = self._count_triangles()
        return self._alone(self._mesh.read_regions, count)

    def _read_points(self):
        """The points, and for each added one the ids of three points and their weights."""
        return self._alone(lambda handle: self._mesh.read_points(
            handle, _report.read_struct(handle).refinement_points))

    def _count_triangles(self):
        if not self._refines:
            return self._mesh.struct.number_of_triangles
        return self._alone(_report.read_struct).triangles

    def store_triangles(self, target: Array) -> None:
        """Writes the triangles so far to `target`, contiguous int32 or int64 of shape (m, 3) that can
        be written, in the host's memory or on a GPU."""
        count = self._count_triangles()
        self._alone(_arrays.store_triangles, target, count)

    @property
    def flip_counts(self) -> Array:
        """How many flips each triangle was part of, (m,) int32."""
        counts = self._mesh.make_flip_counts(self._count_triangles())
        self._alone(lambda handle: _arrays.store("flip_counts", handle, counts))
        return counts


@dataclasses.dataclass(frozen=True, eq=False)
class Result:
    """What `flip` returns. Only the same object is equal: compare the arrays."""

    #: (m, 3), in the input's order and of its integers; those that refinement has added follow.
    triangles: Array
    flip_counts: Array  #: (m,) int32: how many flips each triangle was part of.
    iterations: Array  #: Structured, a row per iteration; see Session.iterations.
    report: Report
    points: Array  #: (n, 3) unless on a GPU: those of the input, then those that refinement has added.
    #: After refinement: the sources, and for each added point the ids of three points and their weights.
    _added: Any = dataclasses.field(default=None, repr=False)
    _regions: Optional[Array] = dataclasses.field(default=None, repr=False)

    @property
    def regions(self) -> Array:
        """(m,) int32: the label of the region of each triangle, 0 where no seed names one."""
        if self._regions is None:
            return numpy.zeros(len(self.triangles), dtype=numpy.int32)
        return self._regions

    @property
    def sources(self) -> Array:
        """(m,) int32: for each triangle its source, the triangle before refinement that contains its
        centroid. The triangle has the source's data, and exactly its region. Without refinement each
        triangle is its own source."""
        if self._added is None:
            return numpy.arange(len(self.triangles), dtype=numpy.int32)
        return self._added[0]

    def at_points(self, values: Numbers) -> Array:
        """Values at all points, as float64, from values at the points of the input: (n,) or (n, ...).
        Values at points that refinement has added are linear in the mesh before."""
        given, shape = _arrays.as_values(_arrays.to_host(values))
        added = 0 if self._added is None else len(self._added[1])
        if len(given) != len(self.points) - added:
            raise ValueError(f"values must have {len(self.points) - added} rows, one for each point of the "
                             f"input; there are {len(given)}")
        if added:
            _, ids, weights = self._added
            weights = numpy.where(ids < 0, 0.0, weights)  # id -1 would read the last point
            near = given[ids]
            near[weights == 0.0] = 0.0  # a value may be NaN
            given = numpy.concatenate([given, numpy.einsum("ij,ijk->ik", weights, near)])
        return given.reshape((-1, *shape))


def flip(
    points: Numbers, triangles: Numbers, *, geometry: Geometry = "auto", criterion: Criterion = "in-circle",
    tie_rule: TieRule = "keep", tolerance: float = -1.0, feature_angle: float = 30.0,
    maximum_deviation: float = float("inf"), constraints: Optional[Numbers] = None,
    insert_constraints: Union[bool, Numbers] = True, regions: Optional[Numbers] = None,
    frozen: Optional[Numbers] = None, minimum_angle: float = 0.0, maximum_area: float = 0.0,
    maximum_edge: float = 0.0, size: Optional[Numbers] = None, region_seeds: Sequence[Region] = (),
    keep_boundary: bool = False, point_limit: int = 0, maximum_iterations: int = -1, backend: Backend = "auto",
    threads: int = 0, device: int = -1, devices: Devices = (), pieces: int = 0, track_quality: bool = False,
    progress: Optional[Progress] = None, on_iteration: Optional[OnIteration] = None,
) -> Result:
    """Makes a triangle mesh Delaunay by flipping edges, and on request refines it by adding points.

    Any mesh is accepted: open, non-manifold, of mixed winding, degenerate. Edges that cannot flip
    safely stay and are counted. The result is identical on any threads or GPUs.

    Args:
        points: (n, 3) float32 or float64, used without a copy if contiguous; (n, 2) gets z = 0.
        triangles: (m, 3) int32 or int64, used without a copy if contiguous; never written.
        geometry: "planar": edges are judged in the plane of the points; "planar-xy": by x and y
            (terrain); "surface": in space; "sphere": exactly, on a globe around the origin, towards
            the convex hull; "auto": whichever of the first three fits.
        criterion: "in-circle" (exact; surfaces ignore it) or "opposite-angles".
        tie_rule: For points on one circle: "keep" edges or "canonical" triangles; not on surfaces.
        tolerance: Radians by which opposite angles must exceed pi to be bad, 0 to below 1; -1:
            automatic, from the precision of the points. For "opposite-angles" and surfaces.
        feature_angle: On surfaces, edges sharper than this many degrees stay; 180 turns it off.
        maximum_deviation: On surfaces, an edge stays if its flip would move the surface by more than
            this length, 0 or more. It holds per flip: many flips can add up.
        constraints: (k, 2) pairs of point ids: edges that must stay.
        insert_constraints: In the plane, flips turn missing constraints into edges; or (k,) flags.
        regions: (m,) integers: edges between triangles of different labels stay.
        frozen: (m,) flags: the edges of these triangles stay.
        minimum_angle, maximum_area, maximum_edge: In the plane and on terrain, once no edge is bad,
            points are added until no angle is smaller, in degrees up to 33, and no triangle or edge is
            larger; 0: no limit. Boundary edges and edges that stay are split, but never crossed. What
            cannot get better, because such edges meet at a small angle, is left and counted.
        size: (n,), the longest edge near each point, linear in between; NaN: no limit near that point.
        region_seeds: (x, y, label[, area]): a place in a part that kept edges enclose, its label and area.
        keep_boundary: Split no edge of the boundary. Triangles near it may then miss the goals.
        point_limit: The most points in the end. 0: ten times as many as are given, at least a million.
        maximum_iterations: -1: until done; 0: only test. Rounds of refinement count, too.
        backend: "cuda", "threads", or "auto": a GPU for large meshes if there is one.
        threads: 0: as many as the machine has.
        device: CUDA's number of the GPU; -1: that of arrays on a GPU (see Session), or the current.
        devices: GPUs, connected by NVLink, that share the mesh: [0, 1] or "all"; (): device.
        pieces: 1 to 255, flipped in turn where a GPU is too small for the mesh; 0: the fewest.
        track_quality: Compute the smallest angle after every iteration; not with several pieces.
        progress: Called with the share of the work done, 0 to 1, also after each round; False aborts.
        on_iteration: Called after each iteration, but not after rounds, with its numbers; False aborts.

    Returns:
        A `Result`. After an abort it holds the valid mesh of the last whole iteration.

    Raises:
        InvalidMesh, InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError.

    Example:
        >>> points = [[0, 0], [2, -1], [4, 0], [2, 1]]
        >>> result = flip(points, [[0, 1, 2], [0, 2, 3]])
        >>> result.report.total_flips, sorted(sorted(ids) for ids in result.triangles.tolist())
        (1, [[0, 1, 3], [1, 2, 3]])
    """
    result, trouble = flip_arrays(**locals())
    for text in trouble:
        warnings.warn(text, stacklevel=2)
    return result


def flip_arrays(
    points, triangles, *, geometry="auto", constraints=None, insert_constraints=True, regions=None, frozen=None,
    size=None, region_seeds=(), progress=None, on_iteration=None, **options,
):
    """The Result of `flip` with these arguments, and the texts of warnings."""
    mesh = _arrays.Mesh(points, triangles, constraints, regions, frozen, insert_constraints, None, size, region_seeds)
    _require_xyz(points, geometry)
    wanted = make_options(flip, geometry=geometry, **options)
    refines = mesh.has_goals or any(has_goal(options, goal) for goal in GOALS)

    def make_room(_):
        return () if refines else (mesh.make_triangles(), mesh.make_flip_counts())

    with _with_keywords(), run("open", mesh.struct, wanted, make_room, progress, on_iteration) as (handle, room):
        result = _store(mesh, handle, room)
        return result, _list_trouble(handle, mesh.points, result, geometry)


def _require_xyz(points, geometry):
    """Refuses longitudes and latitudes, which would be taken for x and y."""
    is_sphere = isinstance(geometry, str) and geometry == "sphere"
    if is_sphere and _arrays.as_plane(points).shape[1] == 2:
        raise ValueError('geometry="sphere" needs x, y and z; place_on_sphere makes them of longitudes and '
                         "latitudes")


def _list_trouble(handle, points, result, geometry):
    """The texts of warnings of what refinement has left or could not use, and of points that are not on a
    sphere, but have to be."""
    left = [text for kind, _, text in _report.list_defects(handle) if kind in LEFT_BY_REFINEMENT]
    trouble = [name_keywords("; ".join(left), _REFINEMENT)]
    if geometry == "sphere":
        trouble.append(_describe_distances(points, result.triangles))
    return list(filter(None, trouble))


def _describe_distances(points, triangles):
    """The text of a warning if the points of these triangles are on no sphere around the origin, or "". The
    Earth's ellipsoid counts as one."""
    from ._sphere import describe_distances  # which needs this file
    most = 1.01  # times the smallest distance; on the ellipsoid it is 1.0034
    if not describe_distances(points, most):
        return ""
    used = numpy.unique(_arrays.to_host(triangles))
    trouble = describe_distances(_arrays.to_host(points)[used], most)
    return trouble and trouble + ', as geometry="sphere" needs'


def _store(mesh, handle, room):
    """The Result of a session that has ended. `room`: arrays for triangles and flip counts, or empty if
    refinement may have added triangles."""
    added, points = None, mesh.points
    if not room:
        report = _report.read_struct(handle)
        room = mesh.make_triangles(report.triangles), mesh.make_flip_counts(report.triangles)
        points, *between = mesh.read_points(handle, report.refinement_points)
        added = (mesh.read_sources(handle, report.triangles), *between)
    _arrays.store_triangles(handle, room[0], len(room[0]))
    _arrays.store("flip_counts", handle, room[1])
    report = _read_report(handle)
    regions = mesh.read_regions(handle, len(room[0])) if len(mesh.region_seeds) else None
    return Result(*room, _report.read_iterations(handle, report), report, points, added, regions)


def smallest_angles(
    points: Numbers, triangles: Numbers, *, geometry: Geometry = "surface"
) -> Array:
    """The smallest angle of each triangle.

    Args:
        points: Points as `flip` takes them. What is on a GPU is copied to the host.
        triangles: Triangles as `flip` takes them.
        geometry: "planar-xy" measures by x and y, every other in space.

    Returns:
        (m,) float64 in degrees, 0 to 60; NaN for a triangle with a coordinate that is not finite.

    Raises:
        InvalidMesh: A triangle names a point that does not exist.

    Example:
        >>> smallest_angles([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
        array([45.])
    """
    number = choose("geometry", geometry)
    mesh = _arrays.Mesh(_arrays.to_host(points), _arrays.to_host(triangles))
    angles = numpy.empty(len(mesh.triangles))
    _library.call("triangle_angles", mesh.struct, number, _arrays.address(angles))
    return angles
