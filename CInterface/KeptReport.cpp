// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "KeptReport.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{

std::int32_t ToC(StopReasonKind reason)
{
  switch (reason)
  {
    case StopReasonKind::Converged:
      return DELAUNAYFLIP_CONVERGED;
    case StopReasonKind::IterationLimit:
      return DELAUNAYFLIP_ITERATION_LIMIT;
    case StopReasonKind::Aborted:
      return DELAUNAYFLIP_ABORTED;
    case StopReasonKind::Running:
      return DELAUNAYFLIP_RUNNING;
    case StopReasonKind::NotStarted:
      break;
  }
  return DELAUNAYFLIP_NOT_STARTED;
}

void SetEdges(delaunayflip_report& c, const FlipReport& report)
{
  c.edges = report.Edges.Edges;
  c.boundary_edges = report.Edges.Boundary;
  c.non_manifold_edges = report.Edges.NonManifold;
  c.wrongly_wound_edges = report.Edges.WronglyWound;
  c.feature_edges = report.Edges.Feature;
  c.constraint_edges = report.Edges.Constraint;
  c.region_edges = report.Edges.Region;
  c.fixed_edges = report.Edges.Fixed;
  c.unmatched_constraints = report.UnmatchedConstraints;
  c.inserted_constraints = report.InsertedConstraints;
  c.constraint_flips = report.ConstraintFlips;
  c.euler_characteristic = report.EulerCharacteristic;
}

void SetFlips(delaunayflip_report& c, const FlipReport& report)
{
  c.stop_reason = ToC(report.StopReason);
  c.number_of_iterations = static_cast<std::int64_t>(report.Iterations.size());
  c.total_flips = report.TotalFlips;
  c.total_excluded = report.TotalExcluded;
  c.total_blocked = report.TotalBlocked;
  c.non_delaunay_before = report.NonDelaunayBefore;
  c.non_delaunay_after = report.NonDelaunayAfter;
  c.blocked_by_shape = report.BlockedByShape;
  c.blocked_by_edge = report.BlockedByEdge;
  c.minimum_angle_before = report.MinimumAngleBefore;
  c.minimum_angle_after = report.MinimumAngleAfter;
  c.build_seconds = report.BuildSeconds;
  c.flip_seconds = report.FlipSeconds;
}

/// Replaces the triangles of defects by their numbers. Triangles with the same number are named
/// once.
void NumberTriangles(std::vector<Defect>& defects, const std::int64_t* numbers)
{
  for (Defect& defect : defects)
  {
    if (defect.Ids == DefectIds::Triangles)
    {
      std::vector<std::int64_t>& ids = defect.FirstIds;
      std::transform(
        ids.begin(), ids.end(), ids.begin(), [numbers](std::int64_t id) { return numbers[id]; });
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    }
  }
}

}

delaunayflip_iteration ToC(const IterationRecord& record)
{
  delaunayflip_iteration c;
  c.iteration = record.Iteration;
  c.tested = record.Tested;
  c.non_delaunay = record.NonDelaunay;
  c.flipped = record.Flipped;
  c.excluded = record.Excluded;
  c.blocked = record.Blocked;
  c.minimum_angle = record.MinimumAngle;
  c.seconds = record.Seconds;
  return c;
}

KeptReport::KeptReport(FlipReport report, const std::int64_t* numbers)
  : Report(std::move(report))
{
  if (numbers)
  {
    NumberTriangles(this->Report.Defects, numbers);
  }
  this->Defects = DescribeDefects(this->Report.Defects);
}

void KeptReport::Fill(delaunayflip_report& target) const
{
  delaunayflip_report c;
  delaunayflip_report_init(&c);
  c.geometry_used = static_cast<std::int32_t>(this->Report.GeometryUsed);
  c.geometry_reason = this->Report.GeometryReason.c_str();
  c.backend = this->Report.Backend.c_str();
  c.fallback = this->Report.Fallback.c_str();
  c.tolerance = this->Report.Tolerance.c_str();
  c.defects = this->Defects.c_str();
  SetFlips(c, this->Report);
  SetEdges(c, this->Report);
  c.size = target.size;
  std::memcpy(&target, &c, std::min(sizeof(c), static_cast<std::size_t>(target.size)));
}

}
