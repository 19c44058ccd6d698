# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A triangulation of points that move, come and go."""
from __future__ import annotations  # help() shows types by their names

import contextlib
import ctypes
import dataclasses
import functools
import warnings
from typing import Optional

import numpy

from . import _arrays, _library, _report
from ._arrays import address
from ._options import Array, Backend, Numbers, Progress, make_options
from ._points import Batch, Input, triangulate
from ._report import Report
from ._rings import Rings
from ._session import Handle, call, observe


#: Part of a message that is for `triangulate` alone.
_ADVICE = ": with split_crossings both get a point where they cross"


class MovingTriangulation(Handle):
    """The Delaunay triangulation of points that move, come and go.

    After each call the triangles are those that `triangulate` makes of the points where they are now,
    perhaps in another order. If points move a little, up to about a tenth of the distance between
    neighbours, the engine keeps its mesh and flips edges. Otherwise it triangulates the points anew, and
    `report.move_rounds` is 0. Both ways give the same triangles.

    Segments, outlines and holes move with their points. As long as no point goes through a segment, the
    mesh is kept. While a segment crosses an earlier one, it is left out, with a warning, and `report` names
    it. It is back once it fits again.

    Points may be arrays of CuPy, PyTorch or Numba on a GPU, here and in `move`. Then `triangles` and
    `neighbors` are arrays of that library, and nothing goes through the host. These two are made when they
    are first read after a change. An array that was read before does not change.

    It does one thing at a time: during a call, observers and other threads that use it get RuntimeError.
    It is a context manager; leaving it frees the engine's memory. Warnings come when a change is
    complete. So if they are turned into errors, the change stays nevertheless.

    Args:
        points: (n, 2) or (n, 3) float32 or float64; z is ignored. They are copied, except on a GPU, where
            they must stay unchanged until the next `move`.
        segments, outline, holes: As for `triangulate`. Lines and rings that are given by coordinates add
            points behind the others; a `move` without ids must place these, too.
        backend, threads, device: As for `triangulate`.
        progress: Called with the share of the work done, 0 to 1; returning False stops it.

    Raises:
        delaunayflip.Stopped: progress has returned False.
        InvalidMesh: As for `triangulate`.
        InvalidOptions, MeshTooLarge, BackendUnavailable, MemoryError, TypeError, ValueError.

    Example:
        >>> import numpy
        >>> points = numpy.array([[0, 0], [1, 0], [0, 1], [1, 1.1]])
        >>> with MovingTriangulation(points) as mesh:
        ...     points[3] = [0.3, 0.3]
        ...     mesh.move(points)
        ...     mesh.triangles.shape
        (3, 3)
    """

    _what = "triangulation"  # in messages

    def __init__(
        self, points: Numbers, segments: Optional[Numbers] = None, *, outline: Optional[Rings] = None,
        holes: Optional[Rings] = None, backend: Backend = "auto", threads: int = 0, device: int = -1,
        progress: Optional[Progress] = None,
    ) -> None:
        super().__init__()
        self._stored, self._count, self._trouble = {}, 0, []
        self._first = Input(self._own(points), segments, outline=outline, holes=holes)
        self._given = self._first
        options = make_options(triangulate, backend=backend, threads=threads, device=device)
        try:
            call("open_points", self._given.struct, options, ctypes.byref(self._handle), progress)
            self._count = len(self._given.points)
            if not _report.is_aborted(_report.read_struct(self._handle)):
                call("advance", self._handle, -1, None, progress)
        except _library.InvalidMesh as error:
            self._explain(error)
            raise
        if _report.is_aborted(_report.read_struct(self._handle)):
            raise _library.Stopped("progress has stopped the triangulation")
        trouble = self._find_trouble(self._handle)
        if trouble:
            warnings.warn(trouble, stacklevel=2)

    @staticmethod
    def _own(points):
        """A copy of the points, unless they are on a GPU."""
        points = _arrays.as_plane(points)
        return points.copy() if isinstance(points, numpy.ndarray) else points

    def _explain(self, error):
        """Puts the names of rings into an InvalidMesh of the engine."""
        text = self._first.explain(str(error), error.ring).replace(_ADVICE, "")
        error.args = (text, *error.args[1:])

    def _describe(self, handle):
        """The defects as one text, and a list of those that are warned of."""
        text, trouble = self._first.describe_again(handle)
        return text.replace(_ADVICE, ""), [warning.replace(_ADVICE, "") for warning in trouble]

    def _find_trouble(self, handle):
        """The text of a warning of what is not used of segments and rings; "" if that was the same before."""
        if self._first.struct.number_of_segments == 0:
            return ""
        _report.read_struct(handle)  # the defects are those of the last report
        before, self._trouble = self._trouble, self._describe(handle)[1]
        return "" if self._trouble == before else "; ".join(self._trouble)

    def __len__(self) -> int:
        """The number of points, removed ones included."""
        return self._count

    def move(
        self, points: Numbers, ids: Optional[Numbers] = None, *, progress: Optional[Progress] = None,
    ) -> None:
        """Moves all points, or those with these ids.

        Args:
            points: The new places, (n, 2) or (n, 3), or as many as ids. They are copied, in the precision
                of the first points. On a GPU they must have that precision and stay unchanged until the
                next `move`; if points were removed, call `compact` before.
            ids: (k,) integers, with points in the host's memory, or a mask of all points, (n,) booleans. If
                an id is given twice, its last place counts.
            progress: Called first, during long flips, and while points are triangulated anew; returning
                False stops it.

        Raises:
            delaunayflip.Stopped: progress has returned False. All points are where they were.
            InvalidMesh: A ring crosses a segment. All points are where they were.
            InvalidOptions, BackendUnavailable, MemoryError, TypeError, ValueError.
        """
        given = Batch(points)
        wanted = len(self)
        if ids is not None:
            given = Batch(_arrays.to_host(given.points))
            ids = self._read_ids(ids)
            wanted = len(ids)
        if len(given.points) != wanted:
            raise ValueError(f"there must be {wanted} points, not {len(given.points)}")
        if ids is not None and wanted == 0:
            return  # the address of an empty array may be null, which means all points
        number = None if ids is None else address(ids)

        def act(handle, callbacks):
            _library.call("move_points", handle, given.struct, number, callbacks)
            if ids is None:
                self._given = given  # keeps arrays on a GPU

        self._change(act, progress)

    def insert(self, points: Numbers, *, progress: Optional[Progress] = None) -> Array:
        """Inserts points, (k, 2) or (k, 3). Returns their ids, (k,) int64, which follow the others.

        Raises:
            As for `move`. If the points have to be triangulated anew and that is stopped or fails, the
            new points count as removed.
        """
        batch = Batch(_arrays.to_host(_arrays.as_plane(points)))

        def act(handle, callbacks):
            before = self._count
            try:
                _library.call("insert_points", handle, batch.struct, callbacks)
            except Exception:
                self._remove_from(before, handle)
                raise
            self._count = before + len(batch.points)
            return numpy.arange(before, self._count)

        return self._change(act, progress)

    def _remove_from(self, first, handle):
        """Removes the points from the id `first` on, which an insertion that failed has added."""
        self._count = _report.read_struct(handle).points
        ids = numpy.arange(first, self._count)
        _library.call("remove_points", handle, address(ids), len(ids), None)

    def remove(self, ids: Numbers, *, progress: Optional[Progress] = None) -> None:
        """Removes points. The others keep their ids. A removed point is no longer used, and later moves do
        not bring it back. It counts among all points until `compact`.

        Args:
            ids: (k,) integers, or a mask of all points, (n,) booleans.

        Raises:
            As for `move`.
        """
        ids = self._read_ids(ids)
        self._change(lambda handle, callbacks: _library.call(
            "remove_points", handle, address(ids), len(ids), callbacks), progress)

    def compact(self, *, progress: Optional[Progress] = None) -> None:
        """Numbers the points anew, without the removed ones and in the same order. It is an error with
        segments, which name points by their numbers.

        Raises:
            As for `move`.
        """
        def act(handle, callbacks):
            removed = _report.read_struct(handle).removed_points
            _library.call("compact_points", handle, callbacks)
            self._count -= removed

        self._change(act, progress)

    @property
    def triangles(self) -> Array:
        """(m, 3) int32, counter-clockwise in x and y."""
        return self._store("triangles", _library.TYPES["int32"])

    @property
    def neighbors(self) -> Array:
        """(m, 3) int32: the triangle opposite each corner, -1 where there is none."""
        return self._store("neighbors")

    @property
    def segments(self) -> Array:
        """(k, 2) int64: the edges that segments have become, in their order and direction, each once."""
        def read(handle):
            edges = numpy.empty((_report.read_struct(handle).segment_edges, 2), dtype=numpy.int64)
            _library.call("store_segment_edges", handle, address(edges))
            return edges

        return self._alone(read)

    @property
    def used_points(self) -> Array:
        """(n,) int64: the point that is used at the place of each point; -1: it is removed or not
        finite."""
        def read(handle):
            used = numpy.empty(self._count, dtype=numpy.int64)
            _library.call("store_used_points", handle, address(used))
            return used

        return self._alone(read)

    @property
    def report(self) -> Report:
        """The `Report` on the last change. Reading it measures all angles."""
        def read(handle):
            report = _report.read(handle)
            if report.defects:
                report = dataclasses.replace(report, defects=self._describe(handle)[0])
            return report

        return self._alone(read)

    def _read_ids(self, ids):
        """The ids of points as the engine takes them, (k,) int64."""
        ids = _arrays.as_array("ids", _arrays.to_host(ids))
        if ids.dtype == object and ids.size and all(isinstance(id_, (bool, numpy.bool_)) for id_ in ids.flat):
            ids = ids.astype(bool)
        if ids.dtype.kind == "b" and ids.size:
            if ids.shape != (len(self),):
                raise ValueError(f"a mask of all points must have the shape ({len(self)},), not {ids.shape}")
            ids = numpy.flatnonzero(ids)
        are_integers = ids.dtype.kind in "iu" or all(
            isinstance(id_, int) and not isinstance(id_, bool) for id_ in ids.flat)
        if ids.ndim != 1 or not are_integers:
            raise ValueError(
                f"ids must be integers of shape (k,), or booleans of shape ({len(self)},), not {ids.dtype} of "
                f"shape {ids.shape}")
        if ids.dtype.kind in "uO":  # some may not fit int64
            wrong = ids[(ids < 0) | (ids >= len(self))]
            if wrong.size:
                raise _library.InvalidOptions(
                    f"point {wrong[0]} does not exist; there are {len(self):,} points")
        return numpy.ascontiguousarray(ids, dtype=numpy.int64)

    def _change(self, act, progress):
        """What act(handle, callbacks) returns, which changes the points. Warns where that was asked for."""
        def change(handle, callbacks):
            self._stored = {}
            try:
                return act(handle, callbacks)
            except Exception:  # all points are where they were, but the mesh may have to be made anew
                with contextlib.suppress(Exception):
                    _library.call("advance", handle, -1, None, None)
                raise

        def change_and_look(handle):
            result = observe(functools.partial(change, handle), progress)
            return result, self._find_trouble(handle)

        try:
            result, trouble = self._alone(change_and_look)
        except _library.InvalidMesh as error:
            self._explain(error)
            raise
        if trouble:
            warnings.warn(trouble, stacklevel=3)
        return result

    def _store(self, name, *more):
        """An array of the current triangulation; the second time it is the same object."""
        def read(handle):
            if name not in self._stored:
                count = _library.run("count_triangles", handle)
                room = _arrays.make_empty(self._given.points, (count, 3), "int32")
                _arrays.store(name, handle, room, *more)
                self._stored[name] = room
            return self._stored[name]

        return self._alone(read)
