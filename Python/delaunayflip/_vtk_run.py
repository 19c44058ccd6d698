# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Flips the mesh of an input: all at once or, in a live update, a few iterations at a time."""
import dataclasses
import time
import typing

import numpy

from . import _vtk_arrays
from ._report import describe_trouble
from ._surface import Settings
from ._vtk_mesh import MeshInput
from ._vtk_plan import Plan
from ._vtk_report import Totals
from ._vtk_warm import keeps_geometry, make_start


@dataclasses.dataclass(frozen=True)
class Request:
    """The input and the options of an update."""

    mesh: typing.Any
    others: typing.Any  #: Constraints, or None.
    settings: Settings
    options: typing.Dict[str, typing.Any]  #: Keywords of a Session.
    is_live: bool
    observer: typing.Callable[[float], bool]  #: Called with the progress of this update.


class Run:
    """A run. A live update keeps it for the next update. `start`: what it begins with instead of
    the input's triangles."""

    def __init__(self, request, start=None):
        self._request = request
        self._start = start
        self._stamps = _stamp(request)
        self._plan = self._make_plan(request)
        self._input = MeshInput(request.mesh, request.others, request.settings, self._plan,
                                request.is_live)
        if start is not None and not keeps_geometry(
                start, self._input.get_session_arguments(), request.options):
            self._start = None
        self._time = request.mesh.GetMTime()
        self._current = self._input
        self._session = self._open()
        self.is_stopped = self._session.report.stop_reason == "aborted"
        self.warning = ""  #: What the last warning said.

    def _make_plan(self, request):
        return Plan(request.mesh, request.others, request.settings, request.observer)

    def _open(self):
        progress = self._plan.part("session")
        arguments, options = self._input.get_session_arguments(), self._request.options
        if self._start is not None:
            arguments = self._start.change_arguments(arguments)
            options = self._start.change_options(options)
        return self._input.open(progress=progress, **{**arguments, **options})

    def prepare(self, request):
        """The run for another update: this one if nothing that affects its result has changed; a
        warm start if only points were moved; else a new run."""
        old = self._request
        fits = (request.is_live and old.settings == request.settings
                and old.options == request.options and self._stamps == _stamp(request))
        if not fits:
            return Run(request)
        if not self._has_its_points(request.mesh):
            arguments = self._input.get_session_arguments()
            return Run(request, make_start(
                self._session, arguments, request.options, self.get_totals(), self._start))
        self._continue_for(request)
        return self

    def _has_its_points(self, mesh):
        """Compares the points bit by bit: many programs mark points as modified after reading."""
        points = _vtk_arrays.view_points(mesh)
        return points.dtype == self._input.points.dtype and numpy.array_equal(
            points.view(numpy.uint8), self._input.points.view(numpy.uint8))

    def _continue_for(self, request):
        self._request, self.is_stopped = request, False
        self._plan = self._make_plan(request)
        if self._time != request.mesh.GetMTime():
            self._current = MeshInput(request.mesh, request.others, request.settings, self._plan)
            self._time = request.mesh.GetMTime()

    def advance(self, iterations, on_iteration):
        """Makes at most so many iterations; 0: as many as fit into 50 ms; -1: all."""
        if iterations == 0:
            return self._advance_for(0.05, on_iteration)
        return self._session.advance(
            iterations, progress=self._plan.part("session"), on_iteration=on_iteration)

    def _advance_for(self, seconds, on_iteration):
        """Batches are faster than single iterations, but an iteration may take longer than those
        before. So batches grow slowly."""
        start, elapsed, batch, is_running = time.perf_counter(), 0.0, 1.0, True
        while is_running and batch >= 1.0:
            before = elapsed
            is_running = self.advance(int(batch), on_iteration)
            elapsed = time.perf_counter() - start
            batch = min((seconds - elapsed) * batch / (elapsed - before), 2.0 * batch)
        return is_running

    def store(self, output, counts, angles):
        """Writes the current mesh, with the requested cell arrays.

        Returns:
            False when the observer stopped it; then there are no angles.
        """
        self._current.store(self._session, output)
        is_whole = not angles or self._plan.part("output")(0.0)
        self._current.store_numbers(self._session, output, counts, angles and is_whole)
        return is_whole

    def get_totals(self):
        unmatched = self._input.constraints.unmatched
        totals = Totals.of_run(self._session.report, self._session.iterations, unmatched)
        return totals if self._start is None else self._start.change_totals(totals)

    def describe_trouble(self):
        """The text of a warning, or ""."""
        report = self._session.report
        defects = self._current.describe_defects(report.defects, self._start is not None)
        return describe_trouble(defects, report, self._request.options)


def _stamp(request):
    """Modification times and sizes of everything that decides which edges exist and are fixed."""
    meshes = [mesh for mesh in (request.mesh, request.others) if mesh is not None]
    stamps = [request.mesh.GetNumberOfPoints()]
    for mesh in meshes:
        for cells in (mesh.GetPolys(), mesh.GetStrips(), mesh.GetLines()):
            arrays = (cells.GetOffsetsArray(), cells.GetConnectivityArray())
            stamps += [cells.GetMTime(), *(array.GetMTime() for array in arrays),
                       *(array.GetNumberOfValues() for array in arrays)]
    if request.others is not None and request.others.GetPoints():
        stamps.append(request.others.GetPoints().GetMTime())
    data = request.mesh.GetCellData()
    for name in ("vtkGhostType", request.settings.region_array):
        array = data.GetAbstractArray(name)
        stamps.append(array.GetMTime() if array is not None else 0)
    return stamps
