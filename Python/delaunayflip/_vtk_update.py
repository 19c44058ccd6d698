# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""One update of vtkDelaunayFlip: a mesh, or the blocks of a composite dataset one by one."""
import numpy
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataObjectTree, vtkPartitionedDataSet, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from . import _library
from ._options import CHOICES
from ._report import ITERATION, Totals, describe
from ._vtk_mesh import SETTINGS, MeshInput

#: vtkDelaunayFlip.FAILURE_...
FAILURES = ("NONE", "OPTIONS", "MESH", "BACKEND", "OTHER")
_FAILURES_OF = {_library.InvalidOptions: "OPTIONS", _library.BackendUnavailable: "BACKEND",
                _library.FlipError: "MESH", Exception: "OTHER"}  # the first that fits


class Update:
    """An update of `filter_` and its report. During the update `totals` is the report on the
    current mesh so far, afterwards the sum over all meshes."""

    def __init__(self, filter_):
        self._filter = filter_
        self._sum = self.totals = Totals()
        self.errors, self.warnings = [], []
        self._block = (0.0, 1.0)  # the share of the cells before the current block, and its own
        self.failure = 0

    @property
    def error_message(self):
        return describe(self.errors)

    def fail(self, error, where=""):
        failure = next(name for kind, name in _FAILURES_OF.items() if isinstance(error, kind))
        self.failure = self.failure or FAILURES.index(failure)
        message = "not enough memory" if isinstance(error, MemoryError) else str(error)
        self.errors.append((where, message or type(error).__name__))

    def flip(self, source, constraints, output):
        """Flips the input, a mesh or blocks."""
        self._filter._update = self  # observers read its totals
        if isinstance(source, vtkCompositeDataSet):
            self._flip_blocks(source, constraints, output)
        else:
            self._try_to_flip(source, constraints, output)
        self.totals = self._sum
        if self._filter.GetLiveUpdate():
            self.warnings.append(
                ("", "LiveUpdate needs the filter in C++; this one, in Python, makes all flips at once"))
        pieces = self._filter.GetOutputInformation(0).Get(
            vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES()) or 1
        if pieces > 1 and self._sum.report.number_of_triangles:
            self.warnings.append(("", "edges between pieces of the mesh stayed as they were"))

    def _flip_blocks(self, source, constraints, output):
        self._sum.change(stop_reason="converged")  # the result for an input without blocks
        blocks = _copy(source)  # observers may change the input meanwhile
        if _count_partitions(blocks, self._filter.kind) > 1:
            self._judge_partitions()
        output.CopyStructure(blocks)
        output.GetFieldData().ShallowCopy(blocks.GetFieldData())
        are_own = isinstance(constraints, vtkCompositeDataSet)
        edges = {leaf.GetCurrentFlatIndex(): leaf.GetCurrentDataObject()
                 for leaf in _iterate(constraints.NewIterator())} if are_own else {}
        before, total = 0, max(blocks.GetNumberOfElements(vtkDataObject.CELL), 1)
        for leaf in _iterate(blocks.NewIterator()):
            data, name = leaf.GetCurrentDataObject(), _name_leaf(leaf)
            cells = data.GetNumberOfElements(vtkDataObject.CELL)
            self._block = (before / total, cells / total)
            before += cells
            is_mesh, result = isinstance(data, self._filter.kind), _copy(data)
            if not is_mesh and cells:
                self.warnings.append((name, self._filter.no_mesh))
            if is_mesh and self._sum.report.stop_reason != "aborted":
                others = edges.get(leaf.GetCurrentFlatIndex()) if are_own else constraints
                result = vtkPolyData()
                self._try_to_flip(data, others if isinstance(others, vtkPolyData) else None, result, name)
            output.SetDataSet(leaf, result)

    def _judge_partitions(self):
        self.warnings.append(
            ("", "partitions were flipped one by one; edges between them stayed as they were"))

    def _try_to_flip(self, mesh, constraints, output, where=""):
        self.totals = Totals()
        try:
            if isinstance(constraints, vtkCompositeDataSet):
                raise _library.InvalidOptions(self._filter.no_composite)
            trouble = self._flip(mesh, constraints, output)
        except Exception as error:
            self.fail(error, where)
            output.Initialize()
            return
        except KeyboardInterrupt as stop:
            self._filter._interrupt = stop  # raised when VTK is left
            trouble = self._pass(mesh, output, "aborted")
        self._sum.add(self.totals)
        if trouble:
            self.warnings.append((where, trouble))

    def _pass(self, mesh, output, stop_reason):
        self.totals = Totals(stop_reason)
        output.ShallowCopy(mesh)
        return ""

    def _flip(self, mesh, constraints, output):
        """Returns the text of a warning, or ""."""
        if mesh.GetNumberOfPolys() == 0 and mesh.GetNumberOfStrips() == 0:
            return self._pass(mesh, output, "converged")
        if self._is_abort_requested():
            return self._pass(mesh, output, "aborted")
        filter_, options = self._filter, self._get_options()
        observe = self._observe_part(1.0)
        try:
            settings = {name: getattr(filter_, name) for name in SETTINGS}
            data = MeshInput(mesh, constraints, self._observe_part(0.02), **settings)
            session = data.open(progress=observe, **options)
        except _library.Stopped:
            return self._pass(mesh, output, "aborted")
        with session:
            self.totals = data.sum_up(session)
            if session.report.stop_reason != "aborted":
                session.advance(progress=observe, on_iteration=self._observe)
            angles = filter_.GetGenerateQuality()
            is_whole = not angles or observe(1.0)
            data.store(session, output, filter_.GetGenerateFlipCount(), angles and is_whole)
            self.totals = data.sum_up(session)
            if not is_whole:
                self.totals.change(stop_reason="aborted")
            return data.report(session, output, options, self.totals)

    def _get_options(self):
        filter_ = self._filter
        options = {name: words[getattr(filter_, name)] for name, words in CHOICES.items()}
        for name in ("tolerance", "feature_angle", "maximum_deviation", "maximum_iterations", "devices",
                     "track_quality"):
            options[name] = getattr(filter_, name)
        return {**options, "threads": filter_.GetNumberOfThreads(), "device": filter_.GetDeviceId(),
                "pieces": filter_.GetNumberOfPieces()}

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
        self.totals.change(total_flips=self.totals.report.total_flips + record["flipped"])

    def _observe_part(self, share):
        """An observer of a part of the current block's update, which takes this share of its time."""
        before, length = self._block

        def observe(done):
            progress = before + length * share * done
            self._filter.UpdateProgress(max(progress, self._filter.GetProgress()))
            return not self._is_abort_requested()

        return observe


def _iterate(iterator):
    """Yields an iterator of VTK at each of its places."""
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator
        iterator.GoToNextItem()


def _name_leaf(leaf):
    """"block 3 (wing)", by VTK's flat index."""
    about = leaf.GetCurrentMetaData() if leaf.HasCurrentMetaData() else None
    name = about.Get(vtkCompositeDataSet.NAME()) if about is not None else None
    return f"block {leaf.GetCurrentFlatIndex()}" + (f" ({name})" if name else "")


def _count_partitions(blocks, kind):
    """The most partitions, of this class and with points, that a dataset has."""
    datasets = [blocks]
    if isinstance(blocks, vtkDataObjectTree):
        nodes = blocks.NewTreeIterator()
        nodes.VisitOnlyLeavesOff()
        datasets += [node.GetCurrentDataObject() for node in _iterate(nodes)]
    most = 0
    for dataset in datasets:
        if isinstance(dataset, vtkPartitionedDataSet):
            parts = map(dataset.GetPartitionAsDataObject, range(dataset.GetNumberOfPartitions()))
            most = max(most, sum(isinstance(part, kind) and part.GetNumberOfPoints() > 0 for part in parts))
    return most


def _copy(source):
    """A shallow copy."""
    made = source.NewInstance()
    made.ShallowCopy(source)
    return made
