# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A run in steps."""
import contextlib
import ctypes
import threading
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy

from . import _arrays, _device, _library, _report
from ._observers import Observers
from ._options import check_integer, make_options
from ._report import ITERATION
from ._types import Array, Numbers, OnIteration, Options, Progress

if TYPE_CHECKING:
    from typing_extensions import Unpack

class Session:
    """Flips a mesh step by step.

    Points, triangles and keywords are those of `flip`. Building finds the edges and tests them all;
    `advance` flips. The arrays must not change while the session lives. A session is a context
    manager; leaving it frees its memory. It does one thing at a time: while a call is at work, its
    observers and other threads get RuntimeError; it cannot be copied. With `triangle_numbers`, (m,) integers, reports name the
    triangles by these.

    Points and triangles may be arrays of CuPy, PyTorch or Numba in the memory of a GPU: float32 or
    float64, and int32 or int64. They are flipped there, after what is in the library's current
    stream, and results are arrays of the library of the triangles. Arrays of other libraries are
    viewed by DLPack, with CuPy or PyTorch, of which the results then are. Only to insert
    constraints, for `backend="threads"`, or if the GPU fails, the mesh is copied to the host.

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

    def __init__(
        self, points: Numbers, triangles: Numbers, *, constraints: Optional[Numbers] = None,
        insert_constraints: Union[bool, Numbers] = True, regions: Optional[Numbers] = None,
        frozen: Optional[Numbers] = None, triangle_numbers: Optional[Numbers] = None,
        progress: Optional[Progress] = None, **options: "Unpack[Options]",
    ) -> None:
        self._handle = ctypes.c_void_p()
        self._lock = threading.Lock()
        self._mesh = _device.make_mesh(points, triangles, constraints, regions, frozen,
                                       insert_constraints, triangle_numbers)
        chosen = make_options(**options)
        observers = Observers(progress)
        with observers.raising() as callbacks:
            _library.call("open", self._mesh.struct, chosen, callbacks, self._handle)

    def __enter__(self) -> "Session":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self.close()

    def close(self) -> None:
        """Frees the session's memory. It cannot be used afterwards; closing again is allowed."""
        with self._at_work():
            handle, self._handle = self._handle, None
            if handle:
                _library.library().delaunayflip_close(handle)

    def __reduce__(self) -> Any:
        raise TypeError("a session cannot be copied or pickled")

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
        observers = Observers(progress, on_iteration)
        with self._open() as handle, observers.raising() as callbacks:
            _library.call("advance", handle, iterations, callbacks, running)
        return bool(running.value)

    @property
    def report(self) -> _report.Report:
        """The `Report` on the run so far."""
        struct = _library.Report()
        _library.library().delaunayflip_report_init(struct)
        with self._open() as handle:
            _library.call("get_report", handle, struct)
            return _report.from_struct(struct)

    @property
    def iterations(self) -> Array:
        """A structured array with a row per iteration: iteration, tested, non_delaunay, flipped,
        excluded, blocked, minimum_angle (degrees; NaN where it was not computed) and seconds."""
        rows = numpy.empty(self.report.number_of_iterations, dtype=ITERATION)
        with self._open() as handle:
            _library.call("get_iterations", handle, 0, len(rows), _arrays.address(rows),
                          ITERATION.itemsize)
        return rows

    @property
    def triangles(self) -> Array:
        """The triangles so far in their input order, a new array of the input's integers, (m, 3)."""
        triangles = self._mesh.make_triangles()
        self.store_triangles(triangles)
        return triangles

    def store_triangles(self, target: Array) -> None:
        """Writes the triangles so far to `target`, contiguous int32 or int64 of shape (m, 3) that can
        be written, in the host's memory or on a GPU."""
        with self._open() as handle:
            _device.store_triangles(handle, target, self._mesh.struct.number_of_triangles)

    @property
    def flip_counts(self) -> Array:
        """How many flips each triangle was part of, (m,) int32."""
        counts = self._mesh.make_flip_counts()
        with self._open() as handle:
            _device.store_flip_counts(handle, counts)
        return counts

    @contextlib.contextmanager
    def _at_work(self):
        if not self._lock.acquire(blocking=False):
            raise RuntimeError("the session is at work: observers, and other threads, have to wait "
                               "until its call has returned")
        try:
            yield
        finally:
            self._lock.release()

    @contextlib.contextmanager
    def _open(self):
        """The handle, which nothing else uses meanwhile."""
        with self._at_work():
            if not self._handle:
                raise ValueError("the session is closed")
            yield self._handle
