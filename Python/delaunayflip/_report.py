# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a run did, and what an update of several meshes did."""
import ctypes
import dataclasses
import re
import typing

import numpy
import numpy.typing

from . import _arrays, _library
from ._options import CHOICES

#: The columns of an iteration, as a NumPy structure.
ITERATION = numpy.dtype(
    [(name, "f8" if kind is ctypes.c_double else "i8") for name, kind in _library.Iteration._fields_]
)
# What VTK's field data tells, by their names.
FIELD_PREFIX = "DelaunayFlip:"
TEXTS = {"GeometryReason": "geometry_reason", "Tolerance": "tolerance", "Backend": "backend"}

#: In the order of the header.
GEOMETRIES = (*CHOICES["geometry"], "mixed")
_FROM_BEST_TO_WORST = ("not started", "converged", "running", "iteration limit", "aborted")
_MOST = 3  # places named per text, and texts


@dataclasses.dataclass(frozen=True)
class Report:
    """What a run did, and what it found in the mesh.

    An edge is bad if it is not Delaunay. Fixed edges (boundary, non-manifold, feature, constraint,
    ...) never flip and are never counted as bad.
    """

    stop_reason: str  #: "converged", "iteration limit", "aborted", "running" or "not started".
    geometry_used: str  #: "planar", "planar-xy", "surface" or "sphere".
    geometry_reason: str  #: Why.
    backend: str  #: E.g. ``"Threads: 8"`` or ``"CUDA: NVIDIA H200"``.
    fallback: str  #: Why the CPU replaced a GPU; "" if it did not.
    tolerance: str  #: "automatic", the requested value, or "none".
    defects: str  #: What was wrong with the mesh, as a sentence; "" if nothing.
    number_of_iterations: int
    total_flips: int
    total_excluded: int
    total_blocked: int
    non_delaunay_before: int  #: Bad edges of the input; -1 if the run was aborted before the test.
    non_delaunay_after: int  #: Bad edges left, flippable or blocked; -1 as before.
    blocked_by_shape: int  #: Bad edges left: their flip would fold the mesh over.
    blocked_by_edge: int  #: Bad edges left: their flip would repeat an edge.
    edges: int
    boundary_edges: int
    non_manifold_edges: int
    wrongly_wound_edges: int
    feature_edges: int
    constraint_edges: int
    region_edges: int
    fixed_edges: int
    unmatched_constraints: int  #: Constraint edges that the mesh does not have.
    inserted_constraints: int  #: Constraint edges that flips made before the iterations.
    constraint_flips: int  #: How many flips that took; not in total_flips.
    euler_characteristic: int  #: Used points - edges + triangles; flips keep it.
    minimum_angle_before: float  #: Degrees; NaN without triangles, and from points.
    minimum_angle_after: float
    build_seconds: float
    flip_seconds: float
    points: int = 0
    triangles: int = 0
    points_not_finite: int = 0  #: Points left out of a triangulation: NaN or infinity.
    repeated_points: int = 0  #: Points at the place of one with a lower id.
    points_too_near: int = 0  #: Points within the tolerance of one with a lower id.
    segment_edges: int = 0  #: Edges of the mesh that segments have become.
    refused_segments: int = 0  #: They cross earlier ones, or an end is not finite or removed.
    crossings: int = 0  #: Points added where segments cross.
    largest_shift: float = 0.0  #: How far rounding has moved one of these at most.
    outside_triangles: int = 0  #: Removed outside the outline and in holes.
    large_triangles: int = 0  #: Removed by alpha, longest_edge and open spheres.
    keeps_sliver: int = 0  #: 1 if features or constraints keep one of the ten worst slivers.
    blocked_by_deviation: int = 0  #: Bad edges left: the bound on deviation blocks them.
    duplicate_triangles: int = 0  #: Triangles with the three points of an earlier one.
    hidden_by_winding: int = 0  #: Edges that are wrongly wound and would else be bad.
    #: Angles above 90 degrees opposite to non-manifold edges at first: bad edges may hide there.
    obtuse_at_non_manifold: int = 0
    used_points: int = 0  #: How many points the triangles of a triangulation have.
    triangles_below_10_before: int = 0  #: With an angle below 10 degrees; 0 from points, as below.
    triangles_below_10_after: int = 0
    triangles_below_20_before: int = 0
    triangles_below_20_after: int = 0
    triangles_below_30_before: int = 0
    triangles_below_30_after: int = 0
    left_out_rings: int = 0  #: They have no area, or the edges of an earlier one.
    refinement_points: int = 0  #: Points added by refinement.
    refinement_rounds: int = 0  #: How often it has added points.
    unrefined_triangles: int = 0  #: With an angle too small, or too large: they could not get better.
    reached_point_limit: int = 0  #: 1 if point_limit has ended refinement.
    removed_points: int = 0  #: Points that were removed from a triangulation of moving points.
    #: The number of rounds of the last move, removal or insertion; 0: there was none, or all was made anew.
    move_rounds: int = 0
    points_inside: int = 0  #: On a sphere: points inside of the convex hull, which are not used.

    @property
    def converged(self) -> bool:
        """Whether the run ended because no edge could flip any more."""
        return self.stop_reason == "converged"


# Numbers that VTK's field data has, with their names in upper camel case: those of every mesh, and those
# of a triangulation of points.
MAIN_NUMBERS = ("total_flips", "non_delaunay_after", "blocked_by_shape", "blocked_by_edge", "non_manifold_edges",
                "constraint_edges", "fixed_edges", "unmatched_constraints", "inserted_constraints",
                "constraint_flips", "blocked_by_deviation",
                *(field.name for field in dataclasses.fields(Report) if field.name.startswith("triangles_below_")),
                "refinement_points", "refinement_rounds", "unrefined_triangles", "reached_point_limit")
POINT_NUMBERS = ("points_not_finite", "repeated_points", "points_too_near", "segment_edges",
                 "refused_segments", "crossings", "largest_shift", "outside_triangles", "large_triangles",
                 "used_points", "left_out_rings", "move_rounds", "points_inside")
_TYPES = {int: ctypes.c_int64, float: ctypes.c_double, str: ctypes.c_char_p}
_NAMES = tuple(field.name for field in dataclasses.fields(Report))
_TEXTS = [field.name for field in dataclasses.fields(Report)[2:] if field.type is str]
#: delaunayflip_report: the members of Report, of which the first two are numbers there.
Struct = _library.make_struct("Report", (
    (ctypes.c_int64, "size"), (ctypes.c_int32, "stop_reason geometry_used"),
    *((_TYPES[field.type], field.name) for field in dataclasses.fields(Report)[2:])))


def read_struct(handle: ctypes.c_void_p) -> typing.Any:
    """The report of a session as the C interface gives it, which takes less time."""
    struct = _library.make(Struct)
    _library.call("get_report", handle, struct)
    return struct


def is_aborted(struct: typing.Any) -> bool:
    return _library.STOP_REASONS[struct.stop_reason] == "aborted"


def read(handle: ctypes.c_void_p) -> Report:
    """The Report of a session."""
    return _from_struct(read_struct(handle))


def list_defects(handle: ctypes.c_void_p) -> typing.List[typing.Tuple[str, typing.List[int], str]]:
    """(kind, first ids, text) of each defect that the last read(handle) has found."""
    defects = (_library.Defect * _library.run("count_defects", handle))()
    size = ctypes.sizeof(_library.Defect)
    _library.call("get_defects", handle, 0, len(defects), ctypes.addressof(defects), size)
    listed = []
    for one in defects:
        count = one.number_of_ids
        ids = list((ctypes.c_int64 * count).from_address(one.first_ids)) if count else []
        listed.append((_library.DEFECT_KINDS[one.kind], ids, one.text.decode()))
    return listed


def read_iterations(handle: ctypes.c_void_p, report: Report) -> numpy.typing.NDArray[typing.Any]:
    """The rows of a session's iterations. `report`: what read(handle) gives now."""
    rows = numpy.empty(report.number_of_iterations, dtype=ITERATION)
    _library.call("get_iterations", handle, 0, len(rows), _arrays.address(rows), ITERATION.itemsize)
    return rows


def _from_struct(struct: ctypes.Structure) -> Report:
    values = {name: getattr(struct, name) for name in _NAMES}
    for name in _TEXTS:
        values[name] = values[name].decode(errors="replace")
    values["stop_reason"] = _library.STOP_REASONS[struct.stop_reason]
    values["geometry_used"] = CHOICES["geometry"][struct.geometry_used]
    if values["stop_reason"] == "aborted" and struct.edges == 0:  # while they were being found
        values["non_delaunay_before"] = values["non_delaunay_after"] = -1
    report = Report.__new__(Report)
    vars(report).update(values)  # a third of the time of Report(**values), which is frozen
    return report


class Totals:
    """The report on one mesh, or the sum over several, of which `report.geometry_used` may be
    "mixed"; and the rows of its iterations."""

    def __init__(self, stop_reason="not started"):
        self.report = dataclasses.replace(_from_struct(_library.make(Struct)), stop_reason=stop_reason,
                                          minimum_angle_before=numpy.nan, minimum_angle_after=numpy.nan)
        self.iterations = numpy.empty(0, dtype=ITERATION)

    @classmethod
    def of_run(cls, report, iterations, unmatched=0):
        """The totals of a run. `unmatched` more constraints than it knows have no edge."""
        totals = cls()
        totals.iterations = iterations
        if not report.triangles:  # all were removed, but some had angles
            report = dataclasses.replace(
                report, minimum_angle_before=numpy.nan, minimum_angle_after=numpy.nan)
        totals.report = dataclasses.replace(
            report, non_delaunay_before=max(report.non_delaunay_before, 0),
            non_delaunay_after=max(report.non_delaunay_after, 0),
            unmatched_constraints=report.unmatched_constraints + unmatched)
        return totals

    def change(self, **values):
        self.report = dataclasses.replace(self.report, **values)

    def add(self, other):
        """Adds the report on another mesh. Keeps the smaller angles and the worse stop reason."""
        self.iterations = _join_iterations(self, other)
        values = {}
        for field in dataclasses.fields(Report):
            own, more = getattr(self.report, field.name), getattr(other.report, field.name)
            if isinstance(own, str):
                values[field.name] = own if more in own else ", ".join(filter(None, (own, more)))
            else:
                values[field.name] = own + more if isinstance(own, int) else numpy.fmin(own, more)
        reasons = self.report.stop_reason, other.report.stop_reason
        values["stop_reason"] = max(reasons, key=_FROM_BEST_TO_WORST.index)
        kinds = {self.report.geometry_used, other.report.geometry_used} - {"auto"}
        values["geometry_used"] = "mixed" if len(kinds) > 1 else "".join(kinds) or "auto"
        self.change(**values)

    def summarize(self):
        """What was done, in lines of a title, ": " and a text; "" without triangles."""
        struct, text = _library.make(Struct), ctypes.c_char_p()
        for name, _ in Struct._fields_[3:]:
            value = getattr(self.report, name)
            setattr(struct, name, value.encode() if name in _TEXTS else value)
        struct.stop_reason = _library.STOP_REASONS.index(self.report.stop_reason)
        struct.geometry_used = GEOMETRIES.index(self.report.geometry_used)
        struct.number_of_iterations = len(self.iterations)
        _library.call("summarize", struct, ctypes.byref(text))
        return text.value.decode()

    def list_columns(self):
        """(name, values) of VTK's arrays with a value per iteration. VTK 9.1 cannot read NaN in a .vtk of
        text, so that -1 is in its place."""
        for name in ITERATION.names:
            values = self.iterations[name]
            yield to_camel_case(name), numpy.ascontiguousarray(numpy.where(numpy.isnan(values), -1, values))

    def list_numbers(self, names):
        """(name, number) of VTK's field data."""
        for name in names:
            yield to_camel_case(name), getattr(self.report, name)

    def list_fields(self):
        """(name, value) of VTK's field data: numbers, texts, then columns; None: not an array. ParaView
        lists no field data when the first array is empty."""
        yield "Converged", numpy.int32(self.report.converged)
        yield "StopReason", self.report.stop_reason
        yield "Summary", self.summarize()
        yield from self.list_numbers(MAIN_NUMBERS)
        yield "GeometryUsed", self.report.geometry_used
        for name, text in TEXTS.items():
            yield name, getattr(self.report, text)
        for name, values in self.list_columns():
            yield name, values if len(values) else None


def to_camel_case(name):
    return name.title().replace("_", "")


def name_keywords(text, names):
    """A message of the engine with Python's keywords in place of the engine's names of options."""
    for name in names:
        text = re.sub(rf"\b{to_camel_case(name)}\b", name, text)
    return text


def _join_iterations(a, b):
    """Adds row by row. A mesh that made fewer iterations keeps its last angle; one without angles
    does not count."""
    rows = numpy.zeros(max(len(a.iterations), len(b.iterations)), dtype=ITERATION)
    meshes = [one for one in (a, b) if not numpy.isnan(one.report.minimum_angle_after)]
    rows["minimum_angle"] = numpy.inf if meshes else numpy.nan
    for one in (a, b):
        known = len(one.iterations)
        if one in meshes:
            angles = numpy.full(len(rows), one.report.minimum_angle_after)
            angles[:known] = one.iterations["minimum_angle"]
            rows["minimum_angle"] = numpy.minimum(rows["minimum_angle"], angles)
        for name in set(ITERATION.names) - {"iteration", "minimum_angle"}:
            rows[name][:known] += one.iterations[name]
    rows["iteration"] = numpy.arange(1, len(rows) + 1)
    return rows


def describe_trouble(report, maximum_iterations=-1, tolerance=-1.0, **_):
    """Texts of a warning about a run with these options. Reaching a limit that the user has set gives
    no warning."""
    texts = []
    if report.stop_reason == "iteration limit" and maximum_iterations < 0:
        texts.append(f"stopped by the safety limit of {report.number_of_iterations} iterations "
                     f"with {report.non_delaunay_after} edges left that are not Delaunay")
    if tolerance >= 0 and report.tolerance == "none":
        texts.append("Tolerance has no effect on the in-circle criterion, which is exact; it is for "
                     "opposite angles")
    if report.fallback:
        texts.append(f"the GPU could not be used, the CPU did the work: {report.fallback}")
    return texts


def describe(notes):
    """Joins pairs (place, text) to one text. Each text appears once, with its first places."""
    places = {}
    for where, text in notes:
        places.setdefault(text, []).append(where)
    texts = []
    for text, where in places.items():
        named = join(where, ", ")
        texts.append(f"{named}: {text}" if named else text)
    return join(texts, "; ")


def join(items, separator):
    more = [f"and {len(items) - _MOST} more"] if len(items) > _MOST else []
    return separator.join(items[:_MOST] + more)
