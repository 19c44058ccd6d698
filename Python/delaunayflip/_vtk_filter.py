# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""vtkDelaunayFlip for every VTK with Python: the interface of the C++ class, on libdelaunayflip."""
import collections
import operator
import re

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import (
    VTK_DOUBLE_MAX, VTK_ID_MAX, VTK_INT_MAX, vtkObject, vtkOutputWindow)
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkDataObject, vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkDemandDrivenPipeline

from . import _library
from ._report import GEOMETRIES, describe
from ._vtk_mesh import vtk_of
from ._vtk_update import FAILURES, Update

_USER_ERROR = 40000  # vtkErrorCode::UserError


def to_snake_case(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


class Property(
        collections.namedtuple("Property", "name default low high choices", defaults=(None, None, ()))):
    """One property. The meaning of each is documented in the headers of the classes in C++.

    Numbers are clamped to low .. high; None: no limit. For `choices` there are SetXTo... methods and
    X_... constants.
    """

    def convert(self, value):
        """The value that a setter stores."""
        if isinstance(self.default, str):
            return "" if value is None else str(value)
        if isinstance(self.default, bool):
            return bool(value)
        value = float(value) if isinstance(self.default, float) else operator.index(value)
        return value if self.low is None else min(max(value, self.low), self.high)


#: Those of every filter.
COMMON_PROPERTIES = (
    Property("Backend", 0, 0, 2, ("Auto", "CUDA", "Threads")),
    Property("DeviceId", -1, -1, VTK_INT_MAX),
    Property("NumberOfThreads", 0, 0, VTK_INT_MAX),
    Property("MaximumIterations", -1, -1, VTK_ID_MAX),
    Property("LiveUpdate", False),
    Property("IterationsPerUpdate", 1, 0, VTK_ID_MAX),
    Property("Paused", False),
)

_PROPERTIES = (
    Property("Geometry", 0, 0, 3, ("Auto", "Planar", "PlanarXY", "Surface")),
    Property("Criterion", 0, 0, 1, ("InCircle", "OppositeAngles")),
    Property("Tolerance", -1.0),
    Property("TieRule", 0, 0, 1, ("Keep", "Canonical")),
    Property("FeatureAngle", 30.0, 0.0, 180.0),
    Property("MaximumDeviation", VTK_DOUBLE_MAX),
    Property("RegionArray", ""),
    *(Property(name, True) for name in ("LinesAsConstraints", "InsertConstraints", "Triangulate")),
    Property("Devices", ""),
    Property("NumberOfPieces", 0, 0, 255),
    *(Property(name, False) for name in (
        "InsertLines", "TrackQuality", "GenerateFlipCount", "GenerateQuality")),
)


class Filter(VTKPythonAlgorithmBase):
    """What the filters have in common.

    Properties can be given as keywords, in snake case: vtkDelaunayFlip(geometry=2).
    """

    name = "vtkDelaunayFlip"  #: The class in C++.
    kind = vtkPolyData  #: What is processed.
    no_mesh = "not a surface, passed unchanged"
    no_composite = "the constraints of a single mesh cannot be a composite dataset"
    properties = ()
    update_type = Update

    def __init__(self, **properties):
        super().__init__(nInputPorts=2, nOutputPorts=2, inputType=self.kind.__name__)
        self._values = {item.name: item.default for item in self.properties}
        self._is_at_work = False
        self._interrupt = None
        self._update = self.update_type(self)
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
        status = super().Update(*arguments)
        interrupt, self._interrupt = self._interrupt, None
        if interrupt is not None:
            raise interrupt
        return status

    def FillInputPortInformation(self, port, info):
        if port == 1:
            info.Set(vtkAlgorithm.INPUT_IS_OPTIONAL(), 1)
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(),
                 self.kind.__name__ if port == 0 else "vtkPolyData")
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
        """Port 0: composite data of the input's type, or a mesh."""
        blocks = vtkDataObject.GetData(inInfo[0], 0)
        is_composite = isinstance(blocks, vtkCompositeDataSet)
        wanted = blocks.GetClassName() if is_composite else "vtkPolyData"
        output = vtkDataObject.GetData(outInfo, 0)
        if output is None or output.GetClassName() != wanted:
            made = blocks.NewInstance() if is_composite else vtkPolyData()
            outInfo.GetInformationObject(0).Set(vtkDataObject.DATA_OBJECT(), made)
        if vtkDataObject.GetData(outInfo, 1) is None:
            outInfo.GetInformationObject(1).Set(vtkDataObject.DATA_OBJECT(), vtkTable())
        return 1

    def RequestData(self, request, inInfo, outInfo):
        data = [vtkDataObject.GetData(vector, 0) for vector in (*inInfo, outInfo)]
        table = vtkDataObject.GetData(outInfo, 1)
        self._is_at_work = True
        update = self.update_type(self)
        try:
            update.flip(*data)
        except Exception as error:
            update = self.update_type(self)
            update.fail(error)
            data[-1].Initialize()
        finally:
            self._is_at_work = False
        self._update = update
        vtk_of(table).add_arrays(table.GetRowData(), "", update.totals.list_columns())
        for event, notes in (("ErrorEvent", update.errors), ("WarningEvent", update.warnings)):
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


def count_answers(**names):
    """Methods that return counts of the update's report."""
    return {"Get" + name: lambda update, count=count: getattr(update.totals.report, count)
            for name, count in names.items()}


# What the last update did, and what only classes in C++ have: live updates.
_COMMON_ANSWERS = {
    "Advance": lambda update: False,
    "Step": lambda update: False,
    "GetNeedsUpdate": lambda update: False,
    "GetNumberOfIterations": lambda update: len(update.totals.iterations),
    "GetConverged": lambda update: not update.failure and update.totals.report.converged,
    "GetStopReason": lambda update: len(_library.STOP_REASONS) if update.failure
    else _library.STOP_REASONS.index(update.totals.report.stop_reason),
    "GetStopReasonAsString": lambda update: "failed: " + update.error_message if update.failure
    else update.totals.report.stop_reason,
    "GetSummary": lambda update: f"failed: {update.error_message}\n" if update.failure
    else update.totals.summarize(),
    "GetBackendUsed": lambda update: update.totals.report.backend,
    "GetFailure": lambda update: update.failure,
    "GetErrorMessage": lambda update: update.error_message,
    "GetErrorCode": lambda update: update.failure and _USER_ERROR + update.failure,
    **count_answers(TotalFlips="total_flips", NumberOfNonDelaunayEdges="non_delaunay_after"),
}


def finish(cls, properties, answers):
    """Adds to a class, for each property, its constants and the methods that VTK's macros make; its
    answers about the last update; and, as VTK 9.6 does, a Python property for every getter and
    setter."""
    cls.properties = (*cls.properties, *properties)
    for item in properties:
        def set_(self, value, item=item):
            value = item.convert(value)
            if value != self._values[item.name]:
                self._values[item.name] = value
                self.Modified()

        setattr(cls, "Get" + item.name, lambda self, item=item: self._values[item.name])
        setattr(cls, "Set" + item.name, set_)
        if item.low is not None:
            for limit, value in (("Min", item.low), ("Max", item.high)):
                setattr(cls, f"Get{item.name}{limit}Value", lambda self, value=value: value)
        if isinstance(item.default, bool):
            setattr(cls, item.name + "On", lambda self, set_=set_: set_(self, True))
            setattr(cls, item.name + "Off", lambda self, set_=set_: set_(self, False))
        for value, choice in enumerate(item.choices):
            setattr(cls, to_snake_case(f"{item.name}_{choice}").upper(), value)
            setattr(cls, f"Set{item.name}To{choice}",
                    lambda self, set_=set_, value=value: set_(self, value))
    for name, answer in answers.items():
        setattr(cls, name, lambda self, answer=answer: answer(self._update))
    methods = dict(vars(cls))
    for name in {name[3:] for name in methods if re.match("[GS]et[A-Z]", name)}:
        key = to_snake_case(name)
        if not hasattr(cls, key):
            setattr(cls, key, property(methods.get("Get" + name), methods.get("Set" + name)))


for _group, _names in (("STOP_REASON", (*_library.STOP_REASONS, "failed")),
                       ("FAILURE", FAILURES)):
    for _value, _name in enumerate(_names):
        setattr(Filter, f"{_group}_{_name.replace(' ', '_')}".upper(), _value)
finish(Filter, COMMON_PROPERTIES, _COMMON_ANSWERS)


class vtkDelaunayFlip(Filter):
    """Turns a triangle mesh into a Delaunay mesh by parallel edge flips.

    This class has the methods, outputs, warnings and progress of the C++ class vtkDelaunayFlip, for
    a VTK that it was not built for; vtkDelaunayFlip.h is its manual. It leaves out live updates, and
    with them warm starts: all flips are made at once, with a warning. Partitions of a dataset are
    flipped one by one, and so are the pieces of parallel ranks, which report on their own piece:
    edges between them stay, with a warning.

    Properties can be given as keywords, in snake case: vtkDelaunayFlip(geometry=2).
    """

    GEOMETRY_MIXED = 4

    def SetConstraintsConnection(self, port):
        self.SetInputConnection(1, port)

    def SetConstraintsData(self, constraints):
        self.SetInputDataObject(1, constraints)


_ANSWERS = {
    "GetGeometryUsed": lambda update: GEOMETRIES.index(update.totals.report.geometry_used),
    "GetGeometryUsedAsString": lambda update: update.totals.report.geometry_used,
    "GetGeometryReason": lambda update: update.totals.report.geometry_reason,
    **count_answers(NumberOfConstraintEdges="constraint_edges",
                    NumberOfUnmatchedConstraintEdges="unmatched_constraints",
                    NumberOfInsertedConstraintEdges="inserted_constraints",
                    NumberOfConstraintFlips="constraint_flips",
                    NumberOfEdgesBlockedByShape="blocked_by_shape",
                    NumberOfEdgesBlockedByDeviation="blocked_by_deviation",
                    NumberOfEdgesBlockedByEdge="blocked_by_edge"),
}
finish(vtkDelaunayFlip, _PROPERTIES, _ANSWERS)
