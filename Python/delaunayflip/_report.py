# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What a run did."""
import dataclasses
import typing

from . import _library

# What VTK's field data and tables tell, by their names.
FIELD_PREFIX = "DelaunayFlip:"
COLUMNS = {"Iteration": "iteration", "Tested": "tested", "NonDelaunay": "non_delaunay",
           "Flipped": "flipped", "Excluded": "excluded", "Blocked": "blocked",
           "MinimumAngle": "minimum_angle", "Seconds": "seconds"}
COUNTS = {"TotalFlips": "total_flips", "NonDelaunayEdges": "non_delaunay_after",
          "BlockedByShape": "blocked_by_shape", "BlockedByEdge": "blocked_by_edge",
          "FixedEdges": "fixed_edges", "NonManifoldEdges": "non_manifold_edges",
          "ConstraintEdges": "constraint_edges",
          "UnmatchedConstraintEdges": "unmatched_constraints",
          "InsertedConstraintEdges": "inserted_constraints", "ConstraintFlips": "constraint_flips"}
TEXTS = {"GeometryReason": "geometry_reason", "Tolerance": "tolerance", "Backend": "backend"}


@dataclasses.dataclass(frozen=True)
class Report:
    """What a run did, and what it found in the mesh.

    An edge is bad if it is not Delaunay. Fixed edges (boundary, non-manifold, feature, constraint,
    ...) never flip and are never counted as bad.
    """

    stop_reason: str  #: "converged", "iteration limit", "aborted", "running" or "not started".
    geometry_used: str  #: "planar", "planar-xy" or "surface".
    geometry_reason: str  #: Why.
    backend: str  #: E.g. "Threads: 8" or "CUDA: NVIDIA H200".
    fallback: str  #: Why the CPU replaced a GPU; "" if it did not.
    tolerance: str  #: "automatic", the requested value, or "none".
    defects: str  #: What was wrong with the mesh, as a sentence; "" if nothing.
    number_of_iterations: int
    total_flips: int
    total_excluded: int
    total_blocked: int
    non_delaunay_before: int  #: Bad edges of the input; -1 if the run was aborted before the test.
    non_delaunay_after: int  #: Bad edges left, flippable or blocked; -1 as before.
    blocked_by_shape: int  #: Of these, those whose flip would fold the mesh over.
    blocked_by_edge: int  #: And those whose flip would create an edge that exists.
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
    minimum_angle_before: float  #: Degrees; NaN without triangles.
    minimum_angle_after: float
    build_seconds: float
    flip_seconds: float

    @property
    def converged(self) -> bool:
        """Whether the run ended because no edge could flip any more."""
        return self.stop_reason == "converged"


def from_struct(struct: _library.Report) -> Report:
    """The Report for a _library.Report."""
    values: typing.Dict[str, typing.Any] = {}
    for name, _ in struct._fields_[1:]:
        value = getattr(struct, name)
        values[name] = value.decode(errors="replace") if isinstance(value, bytes) else value
    values["stop_reason"] = _library.STOP_REASONS[struct.stop_reason]
    values["geometry_used"] = _library.GEOMETRIES[struct.geometry_used]
    if values["stop_reason"] == "aborted" and struct.edges == 0:  # while they were being found
        values["non_delaunay_before"] = values["non_delaunay_after"] = -1
    return Report(**values)


def describe_trouble(defects, report, options):
    """The text of a warning, or "". Reaching a limit that the user has set gives no warning."""
    texts = [defects] if defects else []
    if report.stop_reason == "iteration limit" and options["maximum_iterations"] < 0:
        texts.append(f"stopped by the safety limit of {report.number_of_iterations} iterations "
                     f"with {report.non_delaunay_after} edges left that are not Delaunay")
    if options["tolerance"] >= 0 and report.tolerance == "none":
        texts.append("Tolerance has no effect on the in-circle criterion, which is exact; it is for "
                     "opposite angles")
    if report.fallback:
        texts.append(f"the GPU could not be used, the CPU did the work: {report.fallback}")
    return "; ".join(texts)
