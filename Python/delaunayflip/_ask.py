# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Queries about places: their triangles, and values between those of the points."""
from __future__ import annotations  # help() shows types by their names

import dataclasses
import functools
import math
import threading
import typing
from typing import Any, Optional, Tuple, Union

import numpy

from . import _arrays, _library, _report
from ._arrays import address
from ._options import Array, Numbers, Progress, check_integer, choose, show, to_number
from ._session import observe

Method = typing.Literal["linear", "natural"]
Outside = typing.Literal["nan", "nearest", "error"]
METHODS, OUTSIDES = typing.get_args(Method), typing.get_args(Outside)


@dataclasses.dataclass
class Places:
    """Places of a query."""

    members: dict  #: The fields of its struct.
    shape: tuple  #: Of the results, before that of a point's values.
    like: Array  #: An array in the memory of the results.
    columns: int = 2  #: How many columns of an array say where a place is.


def require_triangles(report):
    """Raises Stopped or ValueError if the triangulation of this report was stopped or is empty."""
    if report.stop_reason == "aborted":
        raise _library.Stopped("stopped by progress")
    if report.triangles == 0:
        why = report.defects or "there are no triangles"
        raise ValueError(f"nothing can be interpolated between {report.points} points: {why}")


def require_same(again, before):
    """Raises ValueError if a triangulation that was made again is another one than before."""
    for one, other in ((again.triangles, before.triangles), (again.points, before.points)):
        if one is not other and not numpy.array_equal(
                _arrays.to_host(one), _arrays.to_host(other), equal_nan=True):
            raise ValueError("the points or segments have been changed since they were triangulated; "
                             "triangulate them again")


def read_places(given):
    """One array of shape (..., 2) or (..., 3), or two arrays, x and y."""
    if len(given) == 1 and isinstance(given[0], tuple):
        given = given[0]
    if len(given) not in (1, 2):
        raise TypeError("places are one array of shape (..., 2), or two arrays, x and y; there are "
                        f"{len(given)}")
    if len(given) == 1:
        places, shape = _arrays.as_places(given[0])
    else:
        joined = _arrays.join_columns(*given)
        places, shape = _arrays.as_places(joined)[0], tuple(joined.shape[:-1])
    return Places({"places": address(places), "number_of_places": len(places),
                   "place_type": _library.TYPES[_arrays.type_of(places)],
                   "place_components": places.shape[1]}, shape, places)


def read_raster(origin, step, shape, like):
    """The centres of cells; `origin`: of the first one."""
    origin_x, origin_y = _read_pair("origin", origin, [(2,)], "two finite numbers, x and y")
    step_x, step_y = _read_pair("step", step, [(), (2,)], "one or two finite numbers other than 0")
    if step_x == 0 or step_y == 0:
        raise ValueError("step must not be 0")
    if not isinstance(shape, (tuple, list)) or len(shape) != 2:
        raise TypeError(f"shape must be (rows, columns), not {show(shape)}")
    most = 2**40
    rows, columns = (
        check_integer("rows and columns of shape", size, 0, most, f"integers from 0 to {most}") for size in shape)
    if rows * columns > most:
        raise ValueError(f"shape must have at most 2**40 cells, not {rows} rows of {columns}")
    return Places({"rows": rows, "columns": columns, "origin_x": origin_x, "origin_y": origin_y,
                   "step_x": step_x, "step_y": step_y}, (rows, columns), like)


def _read_pair(name, given, shapes, wanted):
    pair = _arrays.as_array(name, given)
    if pair.shape not in shapes or pair.dtype.kind not in "fiu" or not numpy.isfinite(pair).all():
        raise ValueError(f"{name} must be {wanted}; it is {show(given)}")
    return numpy.broadcast_to(pair, (2,)).astype(float).tolist()


def halve(progress, start):
    """An observer of a half of the work, which begins at the share `start`."""
    if not callable(progress):  # none, or what `observe` refuses
        return progress
    return lambda share: progress(start + 0.5 * share)


class Taken(Exception):
    """Another thread has inserted points, so the session belongs to another triangulation now."""


class Answers:
    """A session of points that has ended its run and is kept to be asked. It ends with this object."""

    def __init__(self, given, handle, opened):
        """`given`: the Input; the session reads its arrays. `opened`: closes the session."""
        self.given, self._handle, self._opened = given, handle, opened
        self.is_shared = False  #: Whether an interpolator uses it.
        self._lock, self._asker = threading.Lock(), None

    def _alone(self, act, *arguments):
        """What act(handle, *arguments) returns. Other threads wait. An observer gets an error, since it would
        wait for itself."""
        own = threading.get_ident()
        if self._asker == own:
            raise RuntimeError("an observer cannot ask the triangulation that it observes")
        with self._lock:
            try:
                self._asker = own
                if not self._handle:
                    raise Taken
                return act(self._handle, *arguments)
            finally:
                self._asker = None

    def ask(self, places, field=None, wants_triangles=True, progress=None):
        """The triangles at places, if wanted, and the values of a Field, in two dimensions.

        Raises:
            Stopped: An observer returned False.
        """
        struct, count = _library.make(_library.Query), math.prod(places.shape)
        triangles = results = None
        for name, value in places.members.items():
            setattr(struct, name, value)
        struct.memory, struct.stream = _arrays.find_memory(places.like)
        if wants_triangles:
            triangles = _arrays.make_empty(places.like, (count,), "int32")
            struct.triangles = address(triangles)
        if field:
            values = field.get_near(places.like)
            results = _arrays.make_empty(places.like, (count, values.shape[1]), "float64")
            struct.values, struct.value_components = address(values), values.shape[1]
            struct.results, struct.method = address(results), field.method
            struct.outside = int(field.outside == "nearest")
            if len(values) == 0:  # then the engine is asked for none
                results[:] = math.nan

        def act(handle, callbacks):
            if count:
                _library.call("ask", handle, struct, callbacks)
            if progress is not None:
                progress(1.0)

        self._alone(lambda handle: observe(functools.partial(act, handle), progress))
        return triangles, results

    def insert(self, more, batch, progress):
        """Inserts points, and gives the Answers for all of them. These can be asked no more.

        Args:
            more: The Input of all points.
            batch: The C struct of those that are new.
        """
        handle, opened = self._alone(self._take)
        observe(lambda callbacks: _library.call("insert_points", handle, batch, callbacks), progress)
        return Answers(more, handle, opened)

    def _take(self, handle):
        """The session, of which this object has no more."""
        opened, self._handle, self._opened = self._opened, None, None
        return handle, opened

    def move_to(self, given, keywords, progress):
        """The Triangulation of another Input, after the points have moved there. It has as many points,
        in the same precision, and the same segments.

        Raises:
            Stopped: The observer has returned False, and all points are where they were.
            InvalidMesh: A ring crosses a segment.
        """
        def act(handle, callbacks):
            _library.call("move_points", handle, given.struct, None, callbacks)
            given.share_segments(self.given)
            self.given = given

        try:
            self._alone(lambda handle: observe(functools.partial(act, handle), progress))
        except _library.InvalidMesh as error:
            error.args = (given.explain(str(error), error.ring), *error.args[1:])
            raise
        return self.store((given, keywords, ()))

    def store(self, made_from):
        """The Triangulation."""
        room = self.given.make_room(_report.read_struct(self._handle))
        return self.given.store(self._handle, room, made_from)

    def locate(self, places, progress=None):
        return self.ask(places, progress=progress)[0].reshape(places.shape)


class Field:
    """Values of the points of a session, and how they are interpolated."""

    def __init__(self, answers, values, *, method, outside, fill_value, soft=None):
        """`soft`: the Answers of the same points without segments, which have all values."""
        self._answers, self._soft, self._spots = answers, soft, None
        self.method = choose("method", method, METHODS)
        self.outside = OUTSIDES[choose("outside", outside, OUTSIDES)]
        self._fill_value = to_number("fill_value", fill_value)
        if outside != "nan" and not math.isnan(self._fill_value):
            raise ValueError(f"fill_value has no effect with outside={outside!r}; leave one of them out")
        flat, self._shape = _arrays.as_values(values)
        self.values = self._near = answers.given.complete_values(flat)
        if soft and outside == "nearest":  # interpolated there, coordinates are the nearest place
            corners = _arrays.to_host(answers.given.points)[:, :2]
            self._spots = Field(answers, corners, method="linear", outside=outside, fill_value=math.nan)

    def get_near(self, like):
        """The values in the memory of an array. The last copy is kept."""
        near = self._near = _arrays.move(self._near, like)
        return near

    def find(self, places, progress=None):
        """The values at places."""
        return self.find_both(places, progress, False)[1].reshape(places.shape + self._shape)

    def find_both(self, places, progress=None, wants_triangles=True):
        """The triangles, if they are wanted or needed, and the values, in two dimensions."""
        is_filled = not math.isnan(self._fill_value)
        wants_triangles |= is_filled or self.outside == "error"
        if self._soft:
            triangles, results = self._find_softly(places, progress)
        else:
            triangles, results = self._answers.ask(places, self, wants_triangles, progress)
        if self.outside == "error":
            _require_inside(_arrays.to_host(triangles) < 0, places)
        if is_filled:
            _arrays.put(results, triangles, self._fill_value)
        return triangles, results

    def _find_softly(self, places, progress):
        """Segments say what is outside, and the triangulation without them has the values."""
        triangles, spots = self._answers.ask(places, self._spots, True, halve(progress, 0.0))
        beyond = math.nan
        if spots is not None:
            beyond = self._soft.ask(read_places([spots]), self, False)[1]
        results = self._soft.ask(places, self, False, halve(progress, 0.5))[1]
        _arrays.put(results, triangles, beyond)
        return triangles, results


class Asked:
    """What triangulations that are asked about places have in common. They have `_triangulate_again`, which
    gives new Answers."""

    _read_places = staticmethod(read_places)
    _read_raster = staticmethod(read_raster)

    @functools.cached_property
    def _answers(self):
        return self._triangulate_again()

    def _ask(self, act):
        """What act(answers) returns. If another thread inserts points just now, which takes the session, the
        answers are new ones, of this call alone."""
        try:
            return act(self._answers)
        except Taken:
            return act(self._triangulate_again())

    def locate(self, *places: Numbers, progress: Optional[Progress] = None) -> Array:
        """The triangle of each place, int32; -1: outside. Where there are several, on edges and points,
        the one with the lowest number. Places are given as to the interpolators."""
        spots = self._read_places(places)
        return self._ask(lambda answers: answers.locate(spots, progress))

    def interpolate(
        self, values: Numbers, *places: Numbers, method: Method = "linear",
        fill_value: float = math.nan, outside: Outside = "nan", progress: Optional[Progress] = None,
    ) -> Array:
        """Values at places from values at the points, which are given as to the interpolators.

        Args:
            method: "linear", or "natural" for natural neighbours.
        """
        how = {"method": method, "fill_value": fill_value, "outside": outside}
        spots = self._read_places(places)
        return self._ask(lambda answers: Field(answers, values, **how).find(spots, progress))

    def raster(
        self, values: Numbers, origin: Numbers, step: Union[float, Numbers], shape: Tuple[int, int], *,
        method: Method = "linear", fill_value: float = math.nan, outside: Outside = "nan",
        progress: Optional[Progress] = None,
    ) -> Array:
        """Values at the centres of the cells of a raster; see the interpolators."""
        how = {"method": method, "fill_value": fill_value, "outside": outside}
        cells = self._read_raster(origin, step, shape, _arrays.as_values(values)[0])
        return self._ask(lambda answers: Field(answers, values, **how).find(cells, progress))

    def __getstate__(self):
        """Without the engine's memory, which cannot be copied."""
        return {name: value for name, value in self.__dict__.items() if name != "_answers"}


class Interpolator:
    """What interpolators have in common: `triangulation`, an Asked; its `_answers`, which it keeps where
    points are inserted into the triangulation; `_field`; and `_made_from`, arguments and keywords."""

    triangulation: Any

    def __call__(self, *places: Numbers, progress: Optional[Progress] = None) -> Array:
        """The values at places. `progress` is called with the share of the places done; if it returns
        False, delaunayflip.Stopped is raised."""
        return self._field.find(self.triangulation._read_places(places), progress)

    def locate(self, *places: Numbers, progress: Optional[Progress] = None) -> Array:
        """The triangle of each place, int32; -1: outside. Where there are several, on edges and points,
        the one with the lowest number."""
        return self._answers.locate(self.triangulation._read_places(places), progress)

    def raster(
        self, origin: Numbers, step: Union[float, Numbers], shape: Tuple[int, int], *,
        progress: Optional[Progress] = None,
    ) -> Array:
        """The values at the centres of the cells of a raster: where the values of the points are.

        Args:
            origin: x and y, or longitude and latitude, of the centre of the first cell.
            step: From one cell to the next, one number or one along a row and one from row to row, which
                may be negative: (2.0, -2.0) begins with the northern row if the origin is there.
            shape: (rows, columns); x or the longitude changes along a row.
        """
        places = self.triangulation._read_raster(origin, step, shape, self._field.values)
        return self._field.find(places, progress)

    def __reduce__(self) -> Any:
        places_and_values, keywords = self._made_from
        return functools.partial(type(self), **keywords), places_and_values


def _require_inside(is_outside, places):
    """Raises ValueError if places are in no triangle. If some are NaN or infinite, it names only those."""
    if not is_outside.any():
        return
    is_unusable = numpy.zeros_like(is_outside)
    if "places" in places.members:
        coordinates = _arrays.to_host(places.like)[:, :places.columns]
        is_unusable = is_outside & ~numpy.isfinite(coordinates).all(axis=1)
    which, what = is_outside, "outside of the triangulation"
    if is_unusable.any():
        which, what = is_unusable, "NaN or infinite"
    count = numpy.count_nonzero(which)
    index = ", ".join(map(str, numpy.unravel_index(numpy.argmax(which), places.shape)))
    first = f" (first: index {index})" if index else ""  # a single place has no index
    raise ValueError(f"{count} of {which.size} places {'is' if count == 1 else 'are'} {what}{first}")
