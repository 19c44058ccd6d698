# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""One update of vtkDelaunayFlip."""
import enum

import numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkPolyData

from . import _errors, _library, _vtk_blocks
from ._session import ITERATION
from ._surface import Settings
from ._vtk_block_mesh import BlockMesh
from ._vtk_report import Totals, describe
from ._vtk_run import Request, Run


class Failure(enum.IntEnum):
    """vtkDelaunayFlip.FAILURE_..."""

    NONE = 0
    OPTIONS = 1
    MESH = 2
    BACKEND = 3
    OTHER = 4


def explain(error):
    """(Failure, message) of an exception."""
    for kind, failure in ((_errors.InvalidOptions, Failure.OPTIONS),
                          (_errors.BackendUnavailable, Failure.BACKEND),
                          (_errors.FlipError, Failure.MESH)):
        if isinstance(error, kind):
            return failure, str(error)
    is_memory = isinstance(error, MemoryError)
    return Failure.OTHER, "not enough memory" if is_memory else str(error) or type(error).__name__


class Update:
    """An update of `filter_` and its report. During the update `totals` is the report on the
    current mesh so far, afterwards the sum over all meshes."""

    def __init__(self, filter_, pieces=1):
        self._filter = filter_
        self._pieces = pieces
        self._sum = self.totals = Totals()
        self._errors, self._warnings = [], []
        self._part = (0.0, 1.0)
        self.failure = Failure.NONE

    @property
    def error_message(self):
        return describe(self._errors)

    def fail(self, explanation, where=""):
        failure, message = explanation
        self.failure = self.failure or failure
        self._errors.append((where, message))

    def flip(self, source, constraints, output):
        """Flips the input, a mesh or blocks."""
        self._filter._update = self  # observers read its totals
        is_composite = isinstance(source, vtkCompositeDataSet)
        if is_composite:
            self._flip_blocks(source, constraints, output)
        else:
            self._flip_mesh(source, constraints, output)
        self.totals = self._sum
        if self._filter.GetLiveUpdate() and (is_composite or self._pieces > 1):
            self._warnings.append(
                ("", "LiveUpdate is for one mesh in one piece; blocks and pieces are flipped at once"))
        if self._pieces > 1 and self._sum.has_triangles:
            self._warnings.append(("", "edges between pieces of the mesh stayed as they were"))

    def tell(self, tell):
        """Sends the error and the warning of the update, if there are any."""
        if self.failure:
            tell("ErrorEvent", self.error_message)
        if self._warnings:
            tell("WarningEvent", describe(self._warnings))

    def _flip_mesh(self, source, constraints, output):
        try:
            mesh = self._filter.get_mesh(source)
        except _errors.InvalidMesh as error:
            self.fail(explain(error))
            output.Initialize()
            return
        if mesh is None:
            self.fail((Failure.MESH, "the input is not a surface; apply Extract Surface first"))
        elif constraints is not None and not isinstance(constraints, vtkPolyData):
            self.fail((Failure.OPTIONS,
                       "the constraints of a single mesh cannot be a composite dataset"))
        else:
            is_live = self._filter.GetLiveUpdate() and self._pieces == 1
            self._try_to_flip((mesh, constraints, output), is_live)
            return
        output.Initialize()

    def _flip_blocks(self, source, constraints, output):
        self._sum.stop_reason = "converged"  # the result for an input without blocks
        blocks = _vtk_blocks.copy(source)  # observers may change the input meanwhile
        of_blocks = isinstance(constraints, vtkCompositeDataSet)
        edges = _vtk_blocks.list_meshes(constraints) if of_blocks else constraints
        results = {}
        for block in _vtk_blocks.list_blocks(blocks):
            self._flip_block(block, edges, results)
        _vtk_blocks.store(blocks, results, output)

    def _flip_block(self, block, constraints, results):
        """`results` receives the leaves of the output."""
        try:
            mesh = BlockMesh(block, self._filter.get_mesh, self._filter.GetRegionArray())
            edges = mesh.find_constraints(constraints)
        except Exception as error:
            self.fail(explain(error), block.name)
            results.update((leaf.number, vtkPolyData()) for leaf in block.leaves)
            return
        self._warnings += mesh.list_warnings()
        if mesh.mesh is None or self._sum.stop_reason == "aborted":
            mesh.store(None, results)
            return
        flipped = vtkPolyData()
        self._part = (block.before, block.share)
        self._try_to_flip((mesh.mesh, edges, flipped), False, block.name)
        mesh.store(flipped, results)

    def _try_to_flip(self, data, is_live, where=""):
        """`data`: (mesh, constraints or None, output)."""
        self.totals = Totals()
        try:
            trouble = self._flip(data, is_live)
        except Exception as error:
            self._filter._run, self._filter._can_continue = None, False
            self.fail(explain(error), where)
            data[2].Initialize()
            return
        self._sum.add(self.totals)
        if trouble:
            self._warnings.append((where, trouble))

    def _flip(self, data, is_live):
        """Returns the text of a warning, or ""."""
        mesh, _, output = data
        run, self._filter._run, self._filter._can_continue = self._filter._run, None, False
        if mesh.GetNumberOfPolys() == 0 and mesh.GetNumberOfStrips() == 0:
            self.totals = Totals("converged")
            output.ShallowCopy(mesh)
            return ""
        try:
            return self._flip_triangles(data, run, is_live)
        except (_errors.Stopped, KeyboardInterrupt) as stop:
            if isinstance(stop, KeyboardInterrupt):
                self._filter._interrupt = stop  # raised when VTK is left
            self.totals = Totals("aborted")
            output.ShallowCopy(mesh)
            self._filter._can_continue = is_live
            return ""

    def _flip_triangles(self, data, run, is_live):
        filter_, (mesh, others, output) = self._filter, data
        if self._is_abort_requested():
            raise _errors.Stopped("in another block")
        request = Request(mesh, others, self._get_settings(), self._get_options(), is_live,
                          self._observe_progress)
        run = Run(request) if run is None else run.prepare(request)
        self.totals = run.get_totals()
        if is_live:
            filter_._run = run
        iterations = filter_.GetIterationsPerUpdate() if is_live else -1
        is_running = not run.is_stopped and run.advance(iterations, self._observe)
        is_whole = run.store(output, filter_.GetGenerateFlipCount(), filter_.GetGenerateQuality())
        self.totals = run.get_totals()
        if not is_whole:
            self.totals.stop_reason = "aborted"
        self.totals.add_field_data(output.GetFieldData())
        filter_._can_continue = is_live and (is_running or self.totals.stop_reason == "aborted")
        trouble = run.describe_trouble()
        is_known, run.warning = trouble == run.warning, trouble
        return "" if is_known else trouble  # live updates give each warning once

    def _get_settings(self):
        filter_ = self._filter
        return Settings(filter_.GetTriangulate(), filter_.GetLinesAsConstraints(),
                        filter_.GetInsertLines(), filter_.GetInsertConstraints(),
                        filter_.GetRegionArray())

    def _get_options(self):
        filter_ = self._filter
        return {
            "geometry": _library.GEOMETRIES[filter_.GetGeometry()],
            "criterion": _library.CRITERIA[filter_.GetCriterion()],
            "tie_rule": _library.TIE_RULES[filter_.GetTieRule()],
            "backend": _library.BACKENDS[filter_.GetBackend()],
            "tolerance": filter_.GetTolerance(),
            "feature_angle": filter_.GetFeatureAngle(),
            "maximum_iterations": filter_.GetMaximumIterations(),
            "threads": filter_.GetNumberOfThreads(),
            "device": filter_.GetDeviceId(),
            "devices": filter_.GetDevices(),
            "pieces": filter_.GetNumberOfPieces(),
            "track_quality": filter_.GetTrackQuality(),
        }

    def _is_abort_requested(self):
        """Whether an abort was requested: directly or, from VTK 9.3 on, through a filter upstream.
        After a direct request the filter keeps its output, which the executive would otherwise
        empty."""
        filter_ = self._filter
        if not hasattr(filter_, "CheckAbort"):
            return bool(filter_.GetAbortExecute())
        aborted = filter_.CheckAbort()
        if filter_.GetAbortExecute():
            filter_.SetAbortOutput(False)
        return bool(aborted)

    def _observe(self, record):
        row = numpy.array([tuple(record[name] for name in ITERATION.names)], dtype=ITERATION)
        self.totals.iterations = numpy.concatenate([self.totals.iterations, row])
        self.totals.counts["total_flips"] += record["flipped"]

    def _observe_progress(self, share):
        """`share` is the progress of the current block."""
        before, length = self._part
        self._filter.UpdateProgress(max(before + length * share, self._filter.GetProgress()))
        return not self._is_abort_requested()
