# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Python functions as the engine's callbacks."""
import contextlib
import signal
import threading

import numpy

from . import _library


@contextlib.contextmanager
def _interrupt_as(note):
    """While the block runs, Ctrl-C calls `note` instead of raising KeyboardInterrupt, which ctypes
    would swallow in a callback. Only Python's own handler is replaced."""
    is_ours = (
        threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    )
    if not is_ours:
        yield
        return
    signal.signal(signal.SIGINT, lambda *_: note(KeyboardInterrupt()))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


class Observers:
    """Callbacks for one call of the engine. If one raises an exception, the run is aborted and the
    exception raised after it.

    There is always a progress callback, even without an observer: while Python runs in it, the
    interpreter handles signals, so Ctrl-C works.
    """

    def __init__(self, progress=None, on_iteration=None):
        for name, function in (("progress", progress), ("on_iteration", on_iteration)):
            if function is not None and not callable(function):
                raise TypeError(f"{name} must be a function, not {function!r}")
        self._progress = progress
        self._on_iteration = on_iteration
        self._raised = None
        self.struct = _library.Callbacks()
        _library.library().delaunayflip_callbacks_init(self.struct)
        self.struct.progress = _library.ProgressFunction(self._tell_progress)
        if on_iteration is not None:
            self.struct.iteration = _library.IterationFunction(self._tell_iteration)

    @contextlib.contextmanager
    def raising(self):
        """Raises, after the block, an exception of a callback in it, or KeyboardInterrupt."""
        with _interrupt_as(self._note):
            yield self.struct
        if self._raised is not None:
            raised, self._raised = self._raised, None
            raise raised

    def _tell_progress(self, share, _):
        return self._ask(self._progress, share)

    def _tell_iteration(self, record, _):
        values = record.contents
        return self._ask(self._on_iteration, {name: getattr(values, name) for name, _ in values._fields_})

    def _note(self, error):
        self._raised = error

    def _ask(self, function, value):
        """Returns 0, which aborts, if the function returned False or raised an exception."""
        try:
            answer = function(value) if function is not None else None
            if isinstance(answer, (bool, numpy.bool_)) and not answer:
                return 0
        except BaseException as error:
            self._note(error)
        return int(self._raised is None)
