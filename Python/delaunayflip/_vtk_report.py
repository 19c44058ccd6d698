# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What an update did to all of its meshes, and its messages."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkStringArray

from . import _library
from ._report import COLUMNS, COUNTS, FIELD_PREFIX, TEXTS
from ._session import ITERATION

_FROM_BEST_TO_WORST = ("not started", "converged", "running", "iteration limit", "aborted")
_MOST = 3  # places named per text, and texts


class Totals:
    """The report on one mesh, or the sum over several. Attributes that are not counts have the
    names of those of `Report`; `geometry_used` may be "mixed"."""

    def __init__(self, stop_reason="not started"):
        self.stop_reason = stop_reason
        self.counts = dict.fromkeys(COUNTS.values(), 0)
        self.texts = dict.fromkeys(TEXTS.values(), "")
        self.geometry_used = "auto"
        self.iterations = numpy.empty(0, dtype=ITERATION)
        self.minimum_angle_after = numpy.inf
        self.has_triangles = False
        self.has_angles = False  #: Some triangle has no coordinate that is NaN.

    @classmethod
    def of_run(cls, session, data):
        """Of a session for `data`, a FlipInput with triangles."""
        report = session.report
        totals = cls(report.stop_reason)
        totals.counts = {name: max(getattr(report, name), 0) for name in totals.counts}
        totals.counts["unmatched_constraints"] += data.constraints.unmatched
        totals.texts = {name: getattr(report, name) for name in totals.texts}
        totals.geometry_used = report.geometry_used
        totals.iterations = session.iterations
        totals.minimum_angle_after = report.minimum_angle_after
        totals.has_triangles = True
        totals.has_angles = not numpy.isnan(report.minimum_angle_before)
        return totals

    @property
    def converged(self):
        return self.stop_reason == "converged"

    def add(self, other):
        """Adds the report on another mesh. Keeps the smaller angles and the worse stop reason."""
        self.iterations = _join_iterations(self, other)
        for name, count in other.counts.items():
            self.counts[name] += count
        for name, text in other.texts.items():
            if text not in self.texts[name]:
                self.texts[name] += (", " if self.texts[name] else "") + text
        if self.geometry_used == "auto":
            self.geometry_used = other.geometry_used
        elif other.geometry_used not in ("auto", self.geometry_used):
            self.geometry_used = "mixed"
        if other.has_angles:
            self.minimum_angle_after = numpy.minimum(
                self.minimum_angle_after, other.minimum_angle_after)
        self.has_triangles = self.has_triangles or other.has_triangles
        self.has_angles = self.has_angles or other.has_angles
        self.stop_reason = max(self.stop_reason, other.stop_reason, key=_FROM_BEST_TO_WORST.index)

    def get_geometry(self):
        """The number of the geometry, as vtkDelaunayFlip.GEOMETRY_... have it."""
        return (*_library.GEOMETRIES, "mixed").index(self.geometry_used)

    def get_stop_reason(self):
        return _library.STOP_REASONS.index(self.stop_reason)

    def add_columns(self, prefix, data):
        """One array per column, with a value per iteration."""
        for name, field in COLUMNS.items():
            values = numpy.ascontiguousarray(self.iterations[field])
            kind = VTK_ID_TYPE if values.dtype.kind == "i" else None
            _add(data, prefix + name, numpy_to_vtk(values, deep=True, array_type=kind))

    def add_field_data(self, data):
        """The totals first: ParaView lists no field data when the first array is empty."""
        _add_number(data, "Converged", numpy.int32(self.converged))
        _add_text(data, "StopReason", self.stop_reason)
        for name, count in COUNTS.items():
            _add_number(data, name, self.counts[count], VTK_ID_TYPE)
        _add_text(data, "GeometryUsed", self.geometry_used)
        for name, text in TEXTS.items():
            _add_text(data, name, self.texts[text])
        self.add_columns(FIELD_PREFIX, data)


def _add(data, name, array):
    array.SetName(name)
    data.AddArray(array)


def _add_number(data, name, value, kind=None):
    array = numpy_to_vtk(numpy.array([value]), deep=True, array_type=kind)
    _add(data, FIELD_PREFIX + name, array)


def _add_text(data, name, text):
    array = vtkStringArray()
    array.InsertNextValue(text)
    _add(data, FIELD_PREFIX + name, array)


def _join_iterations(a, b):
    """Adds row by row. A mesh that made fewer iterations keeps its last angle; one without angles
    does not count."""
    rows = numpy.zeros(max(len(a.iterations), len(b.iterations)), dtype=ITERATION)
    rows["minimum_angle"] = numpy.inf if a.has_angles or b.has_angles else numpy.nan
    for totals in (a, b):
        known = len(totals.iterations)
        if totals.has_angles:
            angles = numpy.full(len(rows), totals.minimum_angle_after)
            angles[:known] = totals.iterations["minimum_angle"]
            rows["minimum_angle"] = numpy.minimum(rows["minimum_angle"], angles)
        for name in set(ITERATION.names) - {"iteration", "minimum_angle"}:
            rows[name][:known] += totals.iterations[name]
    rows["iteration"] = numpy.arange(1, len(rows) + 1)
    return rows


def describe(notes):
    """Joins pairs (place, text) to one text. Each text appears once, with its first places."""
    places = {}
    for where, text in notes:
        places.setdefault(text, []).append(where)
    texts = []
    for text, where in places.items():
        named = _join(where, ", ")
        texts.append(f"{named}: {text}" if named else text)
    return _join(texts, "; ")


def _join(items, separator):
    more = [f"and {len(items) - _MOST} more"] if len(items) > _MOST else []
    return separator.join(items[:_MOST] + more)
