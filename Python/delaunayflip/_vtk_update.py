# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""One update of vtkDelaunayFlip: a mesh, or the blocks of a composite dataset one by one."""
import dataclasses
import enum
import typing

import numpy
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkDataObjectTree, vtkMultiBlockDataSet,
    vtkPartitionedDataSet, vtkPartitionedDataSetCollection, vtkPolyData, vtkUniformGridAMR)

from . import _library
from ._options import CHOICES
from ._report import ITERATION, Totals, describe
from ._surface import Settings
from ._vtk_mesh import MeshInput

#: The shares of a mesh's update after which polygons are split, and edges flipped.
_SPLIT, _FLIPPED = 0.02, 0.7


class Failure(enum.IntEnum):
    """vtkDelaunayFlip.FAILURE_..."""

    NONE = 0
    OPTIONS = 1
    MESH = 2
    BACKEND = 3
    OTHER = 4


def explain(error):
    """(Failure, message) of an exception."""
    kinds = {_library.InvalidOptions: Failure.OPTIONS, _library.BackendUnavailable: Failure.BACKEND,
             _library.FlipError: Failure.MESH, Exception: Failure.OTHER}
    failure = next(failure for kind, failure in kinds.items() if isinstance(error, kind))
    message = "not enough memory" if isinstance(error, MemoryError) else str(error)
    return failure, message or type(error).__name__


class Update:
    """An update of `filter_` and its report. During the update `totals` is the report on the
    current mesh so far, afterwards the sum over all meshes."""

    def __init__(self, filter_, pieces=1):
        self._filter = filter_
        self._pieces = pieces
        self._sum = self.totals = Totals()
        self._errors, self._warnings = [], []
        self._block = (0.0, 1.0)  # the share of the cells before the current block, and its own
        self.failure = Failure.NONE

    @property
    def error_message(self):
        return describe(self._errors)

    def fail(self, explanation, where=""):
        failure, message = explanation
        self.failure = self.failure or failure
        self._errors.append((where, message))

    def tell(self, tell):
        """Sends the error and the warning of the update, if there are any."""
        if self.failure:
            tell("ErrorEvent", self.error_message)
        if self._warnings:
            tell("WarningEvent", describe(self._warnings))

    def flip(self, source, constraints, output):
        """Flips the input, a mesh or blocks."""
        self._filter._update = self  # observers read its totals
        if isinstance(source, vtkCompositeDataSet):
            self._flip_blocks(source, constraints, output)
        else:
            self._flip_mesh(source, constraints, output)
        self.totals = self._sum
        if self._filter.GetLiveUpdate():
            self._warnings.append(
                ("", "LiveUpdate needs the filter in C++; this one, in Python, makes all flips at once"))
        if self._pieces > 1 and self._sum.report.number_of_triangles:
            self._warnings.append(("", "edges between pieces of the mesh stayed as they were"))

    def _flip_mesh(self, source, constraints, output):
        try:
            mesh = self._filter.get_mesh(source)
            if mesh is None:
                raise _library.InvalidMesh("the input is not a surface; apply Extract Surface first")
            if not isinstance(constraints, (vtkPolyData, type(None))):
                raise _library.InvalidOptions(self._filter.no_composite)
        except Exception as error:
            self.fail(explain(error))
            output.Initialize()
            return
        self._try_to_flip(mesh, constraints, output)

    def _flip_blocks(self, source, constraints, output):
        self._sum.change(stop_reason="converged")  # the result for an input without blocks
        blocks = _copy(source)  # observers may change the input meanwhile
        output.CopyStructure(blocks)
        output.GetFieldData().ShallowCopy(blocks.GetFieldData())
        edges = {}
        if isinstance(constraints, vtkCompositeDataSet):
            edges = {leaf.place: leaf.data for leaf in _list_leaves(constraints)
                     if isinstance(leaf.data, vtkPolyData)}
            constraints = None
        total = max(sum(leaf.cells for leaf in _list_leaves(blocks)), 1)
        before, of_partitions = 0, []
        for leaf in _list_leaves(blocks):
            self._block = (before / total, leaf.cells / total)
            before += leaf.cells
            result = self._flip_leaf(leaf, edges.get(leaf.place, constraints))
            if leaf.is_partition and self.totals.report.number_of_triangles:
                of_partitions.append(leaf.place[:-1])
            output.SetDataSet(leaf.iterator, result)
        if len(set(of_partitions)) < len(of_partitions):
            self._warnings.append(("", "partitions were flipped one by one; edges between them stayed "
                                       "as they were"))

    def _flip_leaf(self, leaf, constraints):
        """The leaf of the output."""
        self.totals, result = Totals(), vtkPolyData()
        try:
            mesh = self._filter.get_mesh(leaf.data) if leaf.may_be_mesh else None
        except Exception as error:
            self.fail(explain(error), leaf.name)
            return result
        if mesh is None and leaf.cells:
            self._warnings.append((leaf.name, self._filter.no_mesh))
        if mesh is None or self._sum.report.stop_reason == "aborted":
            return _copy(leaf.data)
        self._try_to_flip(mesh, constraints, result, leaf.name)
        return result

    def _try_to_flip(self, mesh, constraints, output, where=""):
        self.totals = Totals()
        try:
            trouble = self._flip(mesh, constraints, output)
        except Exception as error:
            self.fail(explain(error), where)
            output.Initialize()
            return
        except KeyboardInterrupt as stop:
            self._filter._interrupt = stop  # raised when VTK is left
            trouble = self._pass_after_abort(mesh, output)
        self._sum.add(self.totals)
        if trouble:
            self._warnings.append((where, trouble))

    def _pass_after_abort(self, mesh, output):
        self.totals = Totals("aborted")
        output.ShallowCopy(mesh)
        return ""

    def _flip(self, mesh, constraints, output):
        """Returns the text of a warning, or ""."""
        if mesh.GetNumberOfPolys() == 0 and mesh.GetNumberOfStrips() == 0:
            self.totals = Totals("converged")
            output.ShallowCopy(mesh)
            return ""
        if self._is_abort_requested():
            return self._pass_after_abort(mesh, output)
        filter_, options = self._filter, self._get_options()
        observe = self._observe_part(_SPLIT, _FLIPPED)
        try:
            settings = Settings(*(getattr(filter_, one.name) for one in dataclasses.fields(Settings)))
            data = MeshInput(mesh, constraints, settings, self._observe_part(0.0, _SPLIT))
            session = data.open(progress=observe, **options)
        except _library.Stopped:
            return self._pass_after_abort(mesh, output)
        with session:
            self.totals = data.sum_up(session)
            if session.report.stop_reason != "aborted":
                session.advance(progress=observe, on_iteration=self._observe)
            angles = filter_.GetGenerateQuality()
            is_whole = not angles or self._observe_part(_FLIPPED, 1.0)(0.0)
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

    def _observe_part(self, begin, end):
        """An observer of a part of the current block's update."""
        before, length = self._block

        def observe(share):
            progress = before + length * (begin + (end - begin) * share)
            self._filter.UpdateProgress(max(progress, self._filter.GetProgress()))
            return not self._is_abort_requested()

        return observe


@dataclasses.dataclass(frozen=True)
class _Leaf:
    """A leaf of a composite dataset. `place`: the numbers of children, from the root on."""

    data: typing.Any
    iterator: typing.Any
    name: str  #: "block 3 (wing)", by VTK's flat index
    place: typing.Tuple
    is_partition: bool
    may_be_mesh: bool

    @property
    def cells(self):
        return self.data.GetNumberOfElements(vtkDataObject.CELL)


def _list_leaves(blocks):
    """The leaves that are not None. Those of AMR, which is a tree from VTK 9.6 on, are grids."""
    may_be_mesh = isinstance(blocks, vtkDataObjectTree) and not isinstance(blocks, vtkUniformGridAMR)
    places, leaf = _list_places(blocks), blocks.NewIterator()
    leaf.InitTraversal()
    while not leaf.IsDoneWithTraversal():
        number = leaf.GetCurrentFlatIndex()
        place, is_partition = places[number] if number < len(places) else ((number,), False)
        about = leaf.GetCurrentMetaData() if leaf.HasCurrentMetaData() else None
        name = about.Get(vtkCompositeDataSet.NAME()) if about is not None else None
        name = f"block {number} ({name})" if name else f"block {number}"
        yield _Leaf(leaf.GetCurrentDataObject(), leaf, name, place, is_partition, may_be_mesh)
        leaf.GoToNextItem()


def _list_places(node, place=(), is_partition=False):
    """(place, is_partition) of a node and all below it, by VTK's flat index."""
    children = []
    if isinstance(node, vtkPartitionedDataSet):
        children = [node.GetPartitionAsDataObject(i) for i in range(node.GetNumberOfPartitions())]
    elif isinstance(node, vtkPartitionedDataSetCollection):
        children = [node.GetPartitionedDataSet(i) for i in range(node.GetNumberOfPartitionedDataSets())]
    elif isinstance(node, vtkMultiBlockDataSet):
        children = [node.GetBlock(i) for i in range(node.GetNumberOfBlocks())]
    places = [(place, is_partition)]
    for i, child in enumerate(children):
        places += _list_places(child, (*place, i), isinstance(node, vtkPartitionedDataSet))
    return places


def _copy(source):
    """A shallow copy."""
    made = source.NewInstance()
    made.ShallowCopy(source)
    return made
