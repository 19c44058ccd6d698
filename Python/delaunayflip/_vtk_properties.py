# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The properties of the filters of _vtk_filter, with the methods that VTK's macros make in C++."""
import collections
import operator
import re

from vtkmodules.vtkCommonCore import VTK_DOUBLE_MAX, VTK_ID_MAX

from ._options import OPTION_KINDS, OPTION_RANGES
from ._points import POINT_OPTIONS, POINT_RANGES, triangulate
from ._report import to_camel_case
from ._session import flip

#: The names here of options that the engine calls otherwise.
PROPERTY_OF = {"threads": "number_of_threads", "device": "device_id", "pieces": "number_of_pieces"}


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
            if not isinstance(value, (str, type(None))):  # str(value) may tell all of a dataset
                raise TypeError(f"{self.name} must be a str or None, not {type(value).__name__}")
            return value or ""
        if isinstance(self.default, bool):
            return bool(value)
        value = float(value) if isinstance(self.default, float) else operator.index(value)
        return value if self.low is None else min(max(value, self.low), self.high)


def make_properties(function, keywords, ranges):
    """The properties for keywords of a function, numbers and switches, with its defaults."""
    for keyword in keywords:
        default = function.__kwdefaults__[keyword]
        most = VTK_DOUBLE_MAX if isinstance(default, float) else VTK_ID_MAX  # as VTK's macros limit them
        name = to_camel_case(PROPERTY_OF.get(keyword, keyword))
        yield Property(name, *(min(value, most) for value in (default, *ranges.get(keyword, ()))))


#: The numbers and switches of the engine that every filter has, and those of vtkDelaunayFlip alone.
COMMON_OPTIONS = "device", "threads", "maximum_iterations"
_OWN_OPTIONS = [name for name, kind in OPTION_KINDS.items()
                if kind in (float, int, bool) and name not in COMMON_OPTIONS]

#: Those of every filter.
COMMON_PROPERTIES = (
    Property("Backend", 0, 0, 2, ("Auto", "CUDA", "Threads")),
    *make_properties(flip, COMMON_OPTIONS, OPTION_RANGES),
    Property("LiveUpdate", False),
    Property("IterationsPerUpdate", 1, 0, VTK_ID_MAX),
    Property("Paused", False),
)

FLIP_PROPERTIES = (
    Property("Geometry", 0, 0, 4, ("Auto", "Planar", "PlanarXY", "Surface", "Sphere")),
    Property("Criterion", 0, 0, 1, ("InCircle", "OppositeAngles")),
    Property("TieRule", 0, 0, 1, ("Keep", "Canonical")),
    *make_properties(flip, _OWN_OPTIONS, OPTION_RANGES),
    Property("RegionArray", ""),
    Property("SizeArray", ""),
    *(Property(name, True) for name in ("LinesAsConstraints", "InsertConstraints", "Triangulate")),
    Property("Devices", ""),
    *(Property(name, False) for name in ("InsertLines", "GenerateFlipCount", "GenerateQuality")),
)

POINT_PROPERTIES = (
    *make_properties(triangulate, POINT_OPTIONS, POINT_RANGES),
    Property("Projection", 0, 0, 3, ("XY", "BestFittingPlane", "Sphere", "OpenSphere")),
    Property("Degrees", False),
    Property("LinesAsSegments", False),
    Property("ClosedLinesAsRings", True),
    Property("PassSegments", False),
    Property("RingRule", 0, 0, 2, ("EvenOdd", "NonZero", "Orientation")),
    Property("FirstHole", -1, -1, VTK_ID_MAX),
    Property("SegmentHeights", 0, 0, 2, ("Auto", "Survey", "Own")),
    Property("KeepSession", 0, 0, 2, ("Auto", "On", "Off")),
    Property("SizeArray", ""),
)


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
                if item.name != "Paused":  # this changes no result
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
        setattr(cls, name, answer)
    methods = dict(vars(cls))
    for name in {name[3:] for name in methods if re.match("[GS]et[A-Z]", name)}:
        key = to_snake_case(name)
        if not hasattr(cls, key):
            setattr(cls, key, property(methods.get("Get" + name), methods.get("Set" + name)))
