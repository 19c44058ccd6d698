# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What the filters for every VTK with Python have in common, and the one that flips: the interfaces of
the C++ classes, on libdelaunayflip. They take a dataset, or the blocks of a composite one, one by one."""
import numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkObject, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkDataObject, vtkPointSet, vtkPolyData, vtkTable)
from vtkmodules.vtkCommonExecutionModel import (
    vtkAlgorithm, vtkDemandDrivenPipeline, vtkStreamingDemandDrivenPipeline)

from . import _library
from ._options import CHOICES, GOALS, OPTION_KINDS
from ._report import (
    FIELD_PREFIX, GEOMETRIES, ITERATION, MAIN_NUMBERS, POINT_NUMBERS, Totals, describe, to_camel_case)
from ._vtk_blocks import choose_leaf, copy_data, find_leaves, iterate, list_blocks, name_leaf
from ._vtk_data import vtk_of
from ._vtk_mesh import CELL_ARRAYS, SETTINGS, MeshInput
from ._vtk_properties import (
    COMMON_OPTIONS, COMMON_PROPERTIES, FLIP_PROPERTIES, PROPERTY_OF, finish)

_UNKNOWN_ERROR = 20008  # vtkErrorCode::UnknownError
#: vtkDelaunayFlip.FAILURE_...
_FAILURES = ("NONE", "OPTIONS", "MESH", "BACKEND", "OTHER")
_FAILURES_OF = {_library.InvalidOptions: "OPTIONS", _library.BackendUnavailable: "BACKEND",
                _library.FlipError: "MESH", Exception: "OTHER"}  # the first that fits


class Filter(VTKPythonAlgorithmBase):
    """What the filters have in common.

    Properties can be given as keywords, in snake case: vtkDelaunayFlip(geometry=2).
    """

    name = "vtkDelaunayFlip"  #: The class in C++.
    kind = vtkPolyData  #: What is processed.
    no_mesh = "not a surface, passed unchanged"
    no_composite = "the constraints of a single mesh cannot be a composite dataset"
    others = (vtkPolyData,)  #: What the other inputs are; the last one is optional.
    keeps_type = False  #: Whether the output is of the first input's type, not a vtkPolyData.
    flips_partitions_alone = True  #: Whether each partition of a dataset is a mesh of its own.
    #: Whether blocks without cells or without points are empty, in the first and the second input.
    size_of_blocks = size_of_others = vtkDataObject.CELL
    properties = ()

    def __init__(self, **properties):
        super().__init__(
            nInputPorts=1 + len(self.others), nOutputPorts=2, inputType=self.kind.__name__)
        self._values = {item.name: item.default for item in self.properties}
        self._is_at_work = self._has_run = False
        self._forget()
        for name, value in properties.items():
            if not hasattr(type(self), name):
                raise TypeError(f"{self.name} has no property {name!r}")
            setattr(self, name, value)

    # Methods of every filter of VTK.

    def GetClassName(self):
        return self.name

    def __str__(self):
        lines = [f"  {name}: {int(value) if isinstance(value, bool) else value}"
                 for name, value in self._values.items()]
        lines += ["  Summary:", *self.GetSummary().splitlines()]
        return super().__str__().rstrip("\n") + "\n" + "\n".join(lines) + "\n"

    SetInputData = VTKPythonAlgorithmBase.SetInputDataObject
    AddInputData = VTKPythonAlgorithmBase.AddInputDataObject

    def GetInput(self, port=0):
        return self.GetInputDataObject(port, 0)

    def GetPolyDataInput(self, port=0):
        return vtkPolyData.SafeDownCast(self.GetInput(port))

    def GetOutput(self, port=0):
        """The mesh; None if the output is composite (see GetOutputDataObject)."""
        return vtkPolyData.SafeDownCast(self.GetOutputDataObject(port))

    def Update(self, *arguments):
        self._interrupt = None  # not that of an update for another filter
        self._has_run = False
        status = super().Update(*arguments)
        if not self._is_at_work:
            self.SetAbortExecute(0)  # an observer may ask for it at the end
            if not self._has_run:
                self._look_for_refused_input()
        interrupt, self._interrupt = self._interrupt, None
        if interrupt is not None:
            raise interrupt
        return status

    def _look_for_refused_input(self):
        """If there is no usable input, VTK has told of it, and has not asked for an update."""
        fault = next(filter(None, map(self._describe_fault, range(self.GetNumberOfInputPorts()))), "")
        if not fault:
            return
        self._forget()
        self._fail(_library.InvalidMesh(fault))
        for port in range(2):
            if self.GetOutputDataObject(port) is not None:
                self.GetOutputDataObject(port).Initialize()  # what an earlier update has made

    def _describe_fault(self, port):
        """What is wrong with the data of an input port; "" if nothing."""
        name = ("input", "second input", "third input")[port]
        connections = self.GetNumberOfInputConnections(port)
        if connections == 0:
            return "" if port == len(self.others) else f"there is no {name}"
        if connections > 1:
            return f"the {name} has {connections} connections; it takes one"
        data = self.GetInputDataObject(port, 0)
        if data is None or self.GetInputAlgorithm(port, 0).GetErrorCode():
            return f"the {name} was not made: see the errors of what makes it"
        types = ((self.kind, *self.others)[port].__name__, "vtkCompositeDataSet")
        if any(map(data.IsA, types)):
            return ""
        return f"the {name} is a {data.GetClassName()}; it must be a {' or '.join(types)}"

    def FillInputPortInformation(self, port, info):
        if port == len(self.others):
            info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), 1)
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), (self.kind, *self.others)[port].__name__)
        # Otherwise the executive would run the filter once per block, and it could not sum over them.
        info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        return 1

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), "vtkTable" if port == 1 else "vtkDataObject")
        return 1

    def ProcessRequest(self, request, inInfo, outInfo):
        if request.Has(vtkDemandDrivenPipeline.REQUEST_DATA_OBJECT()):
            return self.RequestDataObject(request, inInfo, outInfo)
        if request.Has(vtkDemandDrivenPipeline.REQUEST_DATA()) and self._is_at_work:
            self._tell("ErrorEvent", "An observer asked for an update within an update.")
            return 0
        return super().ProcessRequest(request, inInfo, outInfo)

    def RequestDataObject(self, request, inInfo, outInfo):
        """Port 0: a mesh, or data of the input's type."""
        given = vtkDataObject.GetData(inInfo[0], 0)
        keeps_type = given is not None and self.keeps_type or isinstance(given, vtkCompositeDataSet)
        made = given.NewInstance() if keeps_type else vtkPolyData()
        output = vtkDataObject.GetData(outInfo, 0)
        if output is None or output.GetClassName() != made.GetClassName():
            outInfo.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), made)
        if vtkDataObject.GetData(outInfo, 1) is None:
            outInfo.GetInformationObject(1).Set(vtkDataObject.DATA_OBJECT(), vtkTable())
        return 1

    def RequestInformation(self, request, inInfo, outInfo):
        """The outputs change whenever one of the inputs does. VTK passes on the times of the first alone."""
        asked = vtkStreamingDemandDrivenPipeline
        given = [info for info in (vector.GetInformationObject(0) for vector in inInfo) if info is not None]
        times = sorted({info.Get(asked.TIME_STEPS(), i) for info in given
                        for i in range(info.Length(asked.TIME_STEPS()))})
        ranges = [info.Get(asked.TIME_RANGE()) for info in given if info.Has(asked.TIME_RANGE())]
        for port in range(self.GetNumberOfOutputPorts()):
            info = outInfo.GetInformationObject(port)
            if times:
                info.Set(asked.TIME_STEPS(), times, len(times))
            if ranges:
                first, last = zip(*ranges)
                info.Set(asked.TIME_RANGE(), (min(first), max(last)), 2)
        return 1

    def RequestUpdateExtent(self, request, inInfo, outInfo):
        """Points are wanted whole, and a piece of a mesh may need any of the second input. But an
        algorithm upstream of both inputs cannot make a piece for one and all for the other."""
        asked, are_points = vtkStreamingDemandDrivenPipeline, self.kind is vtkPointSet
        for port in range(0 if are_points else 1, 2):
            info = inInfo[port].GetInformationObject(0)
            if info is not None and (are_points or _list_upstream(self.GetInputAlgorithm(0, 0)).isdisjoint(
                    _list_upstream(self.GetInputAlgorithm(1, 0)))):
                info.Set(asked.UPDATE_PIECE_NUMBER(), 0)
                info.Set(asked.UPDATE_NUMBER_OF_PIECES(), 1)
                info.Set(asked.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        return 1

    def RequestData(self, request, inInfo, outInfo):
        source, others, output = (vtkDataObject.GetData(vector, 0) for vector in (*inInfo[:2], outInfo))
        table = vtkDataObject.GetData(outInfo, 1)
        source = output.NewInstance() if source is None else source  # an observer may have removed it
        self._is_at_work = self._has_run = True
        self._forget()
        try:
            self._flip_all(source, None if others is None else copy_data(others), output)
        except Exception as error:
            self._forget()
            self._fail(error)
            output.Initialize()
        finally:
            self._is_at_work = False
        vtk_of(table).add_arrays(table.GetRowData(), "", self._totals.list_columns())
        for event, notes in (("ErrorEvent", self._errors), ("WarningEvent", self._warnings)):
            if notes:
                self._tell(event, describe(notes))
        self.SetAbortExecute(0)  # from VTK 9.3 on the executive keeps it for later updates
        return 1

    def _tell(self, event, text):
        """Like vtkErrorMacro and vtkWarningMacro."""
        if not vtkObject.GetGlobalWarningDisplay():
            return
        address = self.__this__.split("_")[1].lstrip("0")
        text = f"{self.name} (0x{address}): {text}\n"
        if self.HasObserver(event):
            self.InvokeEvent(event, text)
        elif event == "ErrorEvent":
            vtkOutputWindow.GetInstance().DisplayErrorText("ERROR: " + text)
        else:
            vtkOutputWindow.GetInstance().DisplayWarningText("Warning: " + text)

    # Methods of the C++ classes.

    def GetIterations(self):
        return self.GetOutputDataObject(1)

    def Restart(self):
        self.Modified()

    def ReleaseDeviceMemory(self):
        _library.release_cuda_memory()

    # An update.

    def _forget(self):
        """Forgets the last update. During an update `_totals` is the report on the current mesh so
        far, afterwards the sum over all meshes."""
        self._sum = self._totals = Totals()
        self._errors, self._warnings, self._failure = [], [], 0
        self._block = (0.0, 1.0)  # the share of the cells before the current block, and its own
        self._place, self._where = (), ""  # of the block; in messages

    def _fail(self, error, where=""):
        failure = next(name for kind, name in _FAILURES_OF.items() if isinstance(error, kind))
        self._failure = self._failure or _FAILURES.index(failure)
        message = "not enough memory" if isinstance(error, MemoryError) else str(error)
        self._errors.append((where, message or type(error).__name__))

    def _flip_all(self, source, constraints, output):
        """Flips the input, a mesh or blocks."""
        self._warn_of_misfits(source, constraints)
        if isinstance(source, vtkCompositeDataSet):
            self._flip_blocks(source, constraints, output)
        else:
            self._try_to_flip(source, constraints, output)
        self._totals = self._sum
        if self.GetLiveUpdate():
            self._warnings.append(
                ("", "LiveUpdate needs the filter in C++; this one, in Python, makes all flips at once"))
        pieces = self.GetOutputInformation(0).Get(
            vtkStreamingDemandDrivenPipeline.UPDATE_NUMBER_OF_PIECES()) or 1
        if pieces > 1 and self._sum.report.triangles and self.kind is vtkPolyData:
            self._warnings.append(("", "edges between pieces of the mesh stayed as they were"))

    def _warn_of_misfits(self, source, others, input_name="second input"):
        """Warns of what of another input is ignored."""
        places = list_blocks(source, self.size_of_blocks)
        for place, leaves in list_blocks(others, vtkDataObject.CELL).items():
            fits = not place or () in places or place in places
            for name, data in leaves:
                fault = ("ignored, because the first input has nothing at this place" if not fits
                         else "not a vtkPolyData, ignored" if not isinstance(data, vtkPolyData)
                         else "triangle strips ignored" if data.GetNumberOfStrips() else "")
                if fault and data.GetNumberOfElements(vtkDataObject.CELL):
                    self._warnings.append((name + " of the " * bool(name) + input_name, fault))

    def _flip_blocks(self, source, constraints, output):
        self._sum.change(stop_reason="converged")  # the result for an input without blocks
        blocks = copy_data(source)  # observers may change the input meanwhile
        output.CopyStructure(blocks)
        output.GetFieldData().ShallowCopy(blocks.GetFieldData())
        others = list_blocks(constraints, self.size_of_others)
        self._before, total, results = 0, max(blocks.GetNumberOfElements(vtkDataObject.CELL), 1), {}
        for self._place, leaves in list_blocks(blocks, self.size_of_blocks).items():
            given = find_leaves(others, self._place, self.others[0])
            results.update(self._flip_leaves(leaves, given, total))
        for leaf in iterate(blocks.NewIterator()):
            output.SetDataSet(leaf, results[name_leaf(leaf)])

    def _flip_leaves(self, leaves, given, total):
        """The results for the leaves of a block, by name."""
        results, errors = {}, len(self._errors)
        try:
            self._judge_partitions(leaves, given)
        except _library.FlipError as error:
            self._fail(error, leaves[0][0])
            return {name: self._make_result(data) for name, data in leaves}
        for number, (name, data) in enumerate(leaves):
            cells = data.GetNumberOfElements(vtkDataObject.CELL)
            self._block = (self._before / total, cells / total)
            self._before += cells
            results[name] = self._flip_leaf(data, choose_leaf(given, number), name)
            if len(self._errors) > errors and not self.flips_partitions_alone:
                return {name: self._make_result(data) for name, data in leaves}
        return results

    def _make_result(self, data):
        """An empty output for a mesh; for other data a copy."""
        if not isinstance(data, self.kind):
            return copy_data(data)
        return data.NewInstance() if self.keeps_type else vtkPolyData()

    def _flip_leaf(self, data, others, name):
        is_mesh = isinstance(data, self.kind)
        has_cells = data.GetNumberOfElements(vtkDataObject.CELL) > 0
        if not is_mesh and (has_cells or self.kind is not vtkPolyData):
            self._warnings.append((name, self.no_mesh))
        if not is_mesh or self._sum.report.stop_reason == "aborted":
            return copy_data(data)
        result = self._make_result(data)
        self._try_to_flip(data, others, result, name)
        return result

    def _judge_partitions(self, leaves, _):
        note = ("", "partitions were flipped one by one; edges between them stayed as they were")
        if sum(isinstance(data, self.kind) for _, data in leaves) > 1 and note not in self._warnings:
            self._warnings.append(note)

    def _try_to_flip(self, mesh, constraints, output, where=""):
        self._totals, self._where = Totals(), where
        try:
            if isinstance(constraints, vtkCompositeDataSet):
                raise _library.InvalidOptions(self.no_composite)
            trouble = self._flip(mesh if self.keeps_type else _drop_results(mesh), constraints, output)
        except Exception as error:
            self._fail(error, where)
            output.Initialize()
            return
        except BaseException as stop:  # KeyboardInterrupt, SystemExit, ...
            self._interrupt = stop  # raised when VTK is left
            trouble = self._pass(mesh, output, "aborted")
        self._sum.add(self._totals)
        if trouble:
            self._warnings.append((where, trouble))

    def _pass(self, mesh, output, stop_reason):
        self._totals = Totals(stop_reason)
        output.ShallowCopy(mesh)
        return ""

    def _is_abort_requested(self):
        """Whether an abort was requested: directly or, from VTK 9.3 on, through a filter upstream.
        After a direct request the filter keeps its output, which the executive would otherwise
        empty."""
        if not hasattr(self, "CheckAbort"):
            return bool(self.GetAbortExecute())
        aborted = self.CheckAbort()
        if self.GetAbortExecute():
            self.SetAbortOutput(False)
        return bool(aborted)

    def _get_options(self, *names):
        """These options of the engine, and those of every filter."""
        values = {name: getattr(self, PROPERTY_OF.get(name, name))
                  for name in (*names, *COMMON_OPTIONS)}
        return {name: CHOICES[name][value] if name in CHOICES else value
                for name, value in values.items()}

    def _observe(self, record):
        row = numpy.array([tuple(record[name] for name in ITERATION.names)], dtype=ITERATION)
        self._totals.iterations = numpy.concatenate([self._totals.iterations, row])
        self._totals.change(total_flips=self._totals.report.total_flips + record["flipped"])

    def _observe_part(self, share):
        """An observer of a part of the current block's update, which takes this share of its time."""
        before, length = self._block

        def observe(done):
            progress = before + length * share * done
            self.UpdateProgress(max(progress, self.GetProgress()))
            return not self._is_abort_requested()

        return observe


def _list_upstream(algorithm, known=frozenset()):
    """An algorithm, if there is one, all those upstream of it, and those that are known."""
    if algorithm is None or algorithm in known:
        return known
    known |= {algorithm}
    for port in range(algorithm.GetNumberOfInputPorts()):
        for i in range(algorithm.GetNumberOfInputConnections(port)):
            known = _list_upstream(algorithm.GetInputAlgorithm(port, i), known)
    return known


def _drop_results(mesh):
    """A shallow copy without arrays that an earlier update has added."""
    made = copy_data(mesh)
    for data in made.GetFieldData(), made.GetCellData():
        for name in [data.GetArrayName(i) or "" for i in range(data.GetNumberOfArrays())]:
            if name.startswith(FIELD_PREFIX) or name in CELL_ARRAYS:
                data.RemoveArray(name)
    return made


def count_answers(prefix, *names):
    """Methods that return counts of the last update's report, by their names in the field data."""
    fields = {to_camel_case(name): name for name in MAIN_NUMBERS + POINT_NUMBERS}
    return {f"Get{prefix}{name}": lambda self, field=fields[name]: getattr(self._totals.report, field)
            for name in names}


# What the last update did, and what only classes in C++ have: live updates.
_COMMON_ANSWERS = {
    **dict.fromkeys(("Advance", "Step", "GetNeedsUpdate"), lambda self: False),
    "GetNumberOfIterations": lambda self: len(self._totals.iterations),
    "GetConverged": lambda self: not self._failure and self._totals.report.converged,
    "GetStopReason": lambda self: len(_library.STOP_REASONS) if self._failure
    else _library.STOP_REASONS.index(self._totals.report.stop_reason),
    "GetStopReasonAsString": lambda self: "failed: " + self.GetErrorMessage() if self._failure
    else self._totals.report.stop_reason,
    "GetSummary": lambda self: f"failed: {self.GetErrorMessage()}\n" if self._failure
    else self._totals.summarize(),
    "GetBackendUsed": lambda self: self._totals.report.backend,
    "GetFailure": lambda self: self._failure,
    "GetErrorMessage": lambda self: describe(self._errors),
    "GetErrorCode": lambda self: _UNKNOWN_ERROR if self._failure else 0,
    **count_answers("", "TotalFlips", "NonDelaunayAfter"),
}


for _group, _names in (("STOP_REASON", (*_library.STOP_REASONS, "failed")),
                       ("FAILURE", _FAILURES)):
    for _value, _name in enumerate(_names):
        setattr(Filter, f"{_group}_{_name.replace(' ', '_')}".upper(), _value)
finish(Filter, COMMON_PROPERTIES, _COMMON_ANSWERS)


class Regions:
    """The region seeds of a filter."""

    _regions = ()

    def AddRegion(self, x, y, label, maximum_area):
        self._regions = (*self._regions, (x, y, label, maximum_area))
        self.Modified()

    def RemoveAllRegions(self):
        if self._regions:
            self._regions = ()
            self.Modified()

    def _list_regions(self):
        """(x, y, label, area) of each."""
        for number, (_, _, label, _) in enumerate(self._regions):
            if not (float(label).is_integer() and -2**31 <= label < 2**31):
                raise _library.InvalidOptions(f"the label of region {number} must be an integer from "
                                              f"{-2**31} to {2**31 - 1}, not {label:g}")
        return self._regions


class vtkDelaunayFlip(Regions, Filter):
    """Turns a triangle mesh into a Delaunay mesh by parallel edge flips.

    This class has the methods, outputs, warnings and progress of the C++ class vtkDelaunayFlip, for
    a VTK that it was not built for; vtkDelaunayFlip.h is its manual. It leaves out live updates, and
    with them warm starts: all flips are made at once, with a warning. Partitions of a dataset are
    flipped one by one, and so are the pieces of parallel ranks, which report on their own piece:
    edges between them stay, with a warning.

    Properties can be given as keywords, in snake case: vtkDelaunayFlip(geometry=2).
    """

    GEOMETRY_MIXED = 5

    def SetConstraintsConnection(self, port):
        self.SetInputConnection(1, port)

    def SetConstraintsData(self, constraints):
        self.SetInputDataObject(1, constraints)

    def _judge_partitions(self, leaves, constraints):
        options = self._get_options(*GOALS)
        is_refined = self.GetSizeArray() or self._regions or any(options[goal] for goal in GOALS)
        if is_refined and len(leaves) > 1:
            raise _library.InvalidOptions(
                "a mesh in several partitions cannot be refined or have regions; join them first, by "
                "vtkAppendPolyData, or Merge Blocks in ParaView")
        super()._judge_partitions(leaves, constraints)

    def _flip(self, mesh, constraints, output):
        """Returns the text of a warning, or ""."""
        if mesh.GetNumberOfPolys() == 0 and mesh.GetNumberOfStrips() == 0:
            return self._pass(mesh, output, "converged")
        if self._is_abort_requested():
            return self._pass(mesh, output, "aborted")
        observe = self._observe_part(1.0)
        try:
            settings = {name: getattr(self, name) for name in SETTINGS}
            data = MeshInput(mesh, constraints, self._observe_part(0.02), **settings,
                             region_seeds=self._list_regions())
            session = data.open(progress=observe, **self._get_options(*OPTION_KINDS))
        except _library.Stopped:
            return self._pass(mesh, output, "aborted")
        with session:
            self._totals = data.sum_up()
            if session.report.stop_reason != "aborted":
                session.advance(progress=observe, on_iteration=self._observe)
            angles = self.GetGenerateQuality()
            is_whole = not angles or observe(1.0)
            data.store(output, self.GetGenerateFlipCount(), angles and is_whole)
            self._totals = data.sum_up()
            if not is_whole:
                self._totals.change(stop_reason="aborted")
            return data.report(output, self._totals)


_ANSWERS = {
    "GetGeometryUsed": lambda self: GEOMETRIES.index(self._totals.report.geometry_used),
    "GetGeometryUsedAsString": lambda self: self._totals.report.geometry_used,
    "GetGeometryReason": lambda self: self._totals.report.geometry_reason,
    **count_answers("NumberOf", "ConstraintEdges", "UnmatchedConstraints",
                    "InsertedConstraints", "ConstraintFlips"),
    **count_answers("", "BlockedByShape", "BlockedByDeviation", "BlockedByEdge"),
}
finish(vtkDelaunayFlip, FLIP_PROPERTIES, _ANSWERS)
