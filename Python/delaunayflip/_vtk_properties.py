# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The properties of vtkDelaunayFlip in Python: names, defaults and limits of the C++ class."""
import dataclasses
import operator
import re
import typing

from vtkmodules.vtkCommonCore import VTK_ID_MAX, VTK_INT_MAX


def _to_snake_case(name):
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()


@dataclasses.dataclass(frozen=True)
class Property:
    """One property. The meaning of each is documented in vtkDelaunayFlip.h."""

    name: str
    default: typing.Any
    low: typing.Any = None  #: Numbers are clamped to low .. high; None: no limit.
    high: typing.Any = None
    choices: typing.Tuple[str, ...] = ()  #: SetXTo... methods and X_... constants.
    modifies: bool = True

    @property
    def key(self):
        return _to_snake_case(self.name)

    def convert(self, value):
        """The value that a setter stores."""
        if isinstance(self.default, str):
            return "" if value is None else str(value)
        if isinstance(self.default, bool):
            return bool(value)
        value = float(value) if isinstance(self.default, float) else operator.index(value)
        return value if self.low is None else min(max(value, self.low), self.high)


PROPERTIES = (
    Property("Geometry", 0, 0, 3, ("Auto", "Planar", "PlanarXY", "Surface")),
    Property("Criterion", 0, 0, 1, ("InCircle", "OppositeAngles")),
    Property("Tolerance", -1.0),
    Property("TieRule", 0, 0, 1, ("Keep", "Canonical")),
    Property("FeatureAngle", 30.0, 0.0, 180.0),
    Property("RegionArray", ""),
    Property("LinesAsConstraints", True),
    Property("InsertLines", False),
    Property("InsertConstraints", True),
    Property("Triangulate", True),
    Property("Backend", 0, 0, 2, ("Auto", "CUDA", "Threads")),
    Property("DeviceId", -1, -1, VTK_INT_MAX),
    Property("Devices", ""),
    Property("NumberOfPieces", 0, 0, 255),
    Property("NumberOfThreads", 0, 0, VTK_INT_MAX),
    Property("MaximumIterations", -1, -1, VTK_ID_MAX),
    Property("TrackQuality", False),
    Property("GenerateFlipCount", False),
    Property("GenerateQuality", False),
    Property("LiveUpdate", False),
    Property("IterationsPerUpdate", 1, 0, VTK_ID_MAX),
    Property("Paused", False, modifies=False),
)

CONSTANTS = {
    "GEOMETRY": ("AUTO", "PLANAR", "PLANAR_XY", "SURFACE", "MIXED"),
    "CRITERION": ("IN_CIRCLE", "OPPOSITE_ANGLES"),
    "TIE_RULE": ("KEEP", "CANONICAL"),
    "BACKEND": ("AUTO", "CUDA", "THREADS"),
    "STOP_REASON": ("NOT_STARTED", "CONVERGED", "ITERATION_LIMIT", "ABORTED", "RUNNING", "FAILED"),
    "FAILURE": ("NONE", "OPTIONS", "MESH", "BACKEND", "OTHER"),
}


def _accessors(item):
    def get(self):
        return self._values[item.name]

    def set_(self, value):
        value = item.convert(value)
        if value != self._values[item.name]:
            self._values[item.name] = value
            if item.modifies:
                self.Modified()

    return get, set_


def add_properties(cls):
    """Adds the constants to a class, and for each property the methods that VTK's macros make."""
    for group, names in CONSTANTS.items():
        for value, name in enumerate(names):
            setattr(cls, f"{group}_{name}", value)
    for item in PROPERTIES:
        get, set_ = _accessors(item)
        setattr(cls, "Get" + item.name, get)
        setattr(cls, "Set" + item.name, set_)
        setattr(cls, item.key, property(get, set_))
        if item.low is not None:
            for limit, value in (("Min", item.low), ("Max", item.high)):
                setattr(cls, f"Get{item.name}{limit}Value", lambda self, value=value: value)
        if isinstance(item.default, bool):
            setattr(cls, item.name + "On", lambda self, set_=set_: set_(self, True))
            setattr(cls, item.name + "Off", lambda self, set_=set_: set_(self, False))
        for value, choice in enumerate(item.choices):
            setattr(cls, f"Set{item.name}To{choice}",
                    lambda self, set_=set_, value=value: set_(self, value))
    return cls


def add_snake_case(cls):
    """Adds a property for every getter and setter of the class itself, as VTK 9.6 does."""
    methods = dict(vars(cls))
    for name in {name[3:] for name in methods if re.match("[GS]et[A-Z]", name)}:
        key = _to_snake_case(name)
        if not hasattr(cls, key):
            setattr(cls, key, property(methods.get("Get" + name), methods.get("Set" + name)))
