// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "UpdateReport.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace delaunayflip
{

std::string MakeJson(const RunReport& run)
{
  const FlipReport& flip = run.Flip;
  nlohmann::ordered_json json;
  json["points"] = flip.Points;
  json["triangles"] = flip.Triangles;
  json["edges"] = flip.Edges.Edges;
  json["boundary_edges"] = flip.Edges.Boundary;
  json["fixed_edges"] = flip.Edges.Fixed;
  json["non_manifold_edges"] = flip.Edges.NonManifold;
  json["feature_edges"] = flip.Edges.Feature;
  json["region_edges"] = flip.Edges.Region;
  json["constraint_edges"] = flip.Edges.Constraint;
  json["unmatched_constraint_edges"] = flip.UnmatchedConstraints;
  json["inserted_constraint_edges"] = flip.InsertedConstraints;
  json["constraint_flips"] = flip.ConstraintFlips;
  if (run.IsFromPoints)
  {
    const PointCounts& counts = flip.FromPoints;
    json["from_points"] = { { "not_finite", counts.NotFinite }, { "repeated", counts.Repeated },
      { "too_near", counts.TooNear }, { "segment_edges", counts.SegmentEdges },
      { "refused_segments", counts.RefusedSegments }, { "crossings", counts.Crossings },
      { "largest_shift", counts.LargestShift }, { "outside_triangles", counts.OutsideTriangles },
      { "large_triangles", counts.LargeTriangles } };
  }
  json["geometry"] = ToString(flip.GeometryUsed);
  json["geometry_reason"] = flip.GeometryReason;
  json["tolerance"] = flip.Tolerance;
  json["backend"] = flip.Backend;
  if (!flip.Fallback.empty())
  {
    json["fallback"] = flip.Fallback;
  }
  json["iterations"] = flip.Iterations.size();
  json["total_flips"] = flip.TotalFlips;
  json["total_excluded"] = flip.TotalExcluded;
  json["total_blocked"] = flip.TotalBlocked;
  json["non_delaunay_before"] = flip.NonDelaunayBefore;
  json["non_delaunay_after"] = flip.NonDelaunayAfter;
  json["blocked_by_shape"] = flip.BlockedByShape;
  json["blocked_by_deviation"] = flip.BlockedByDeviation;
  json["blocked_by_edge"] = flip.BlockedByEdge;
  json["min_angle_before_deg"] = flip.MinimumAngleBefore;
  json["min_angle_after_deg"] = flip.MinimumAngleAfter;
  json["converged"] = flip.Converged();
  json["stop_reason"] = ToString(flip.StopReason);
  json["seconds"] = { { "read", run.ReadSeconds }, { "build", flip.BuildSeconds },
    { "flip", flip.FlipSeconds }, { "write", run.WriteSeconds } };
  json["warnings"] = run.Warnings;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string MakeCsv(const FlipReport& flip)
{
  std::ostringstream text;
  text << "Iteration,Tested,NonDelaunay,Flipped,Excluded,Blocked,MinimumAngle,Seconds\n"
       << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const IterationRecord& record : flip.Iterations)
  {
    text << record.Iteration << ',' << record.Tested << ',' << record.NonDelaunay << ','
         << record.Flipped << ',' << record.Excluded << ',' << record.Blocked << ','
         << std::abs(record.MinimumAngle) // a NaN may have a sign
         << ',' << record.Seconds << '\n';
  }
  return text.str();
}

namespace
{

/// The lines of the summary that only a mesh from points has.
std::string DescribePoints(const FlipReport& flip)
{
  const PointCounts& counts = flip.FromPoints;
  const auto add = [](const std::string& text, std::int64_t count, const std::string& what)
  { return count > 0 ? text + ", " + Count(count) + " " + what : text; };
  const std::int64_t unused = counts.NotFinite + counts.Repeated + counts.TooNear;
  std::string points = Count(flip.Points - unused) + " used";
  points = add(points, counts.Repeated, "repeated");
  points = add(points, counts.TooNear, "too near to another");
  points = add(points, counts.NotFinite, "not finite");
  std::string text = "points          " + points + '\n';
  if (counts.SegmentEdges + counts.RefusedSegments > 0)
  {
    std::string segments = Count(counts.SegmentEdges, "edge");
    segments = add(segments, counts.RefusedSegments, "refused");
    text += "segments        " + segments +
      (counts.Crossings > 0 ? ", " + Count(counts.Crossings, "crossing") + " added" : "") + '\n';
  }
  if (counts.OutsideTriangles + counts.LargeTriangles > 0)
  {
    text += "removed         " + Count(counts.OutsideTriangles, "triangle") + " outside, " +
      Count(counts.LargeTriangles) + " too large\n";
  }
  return text;
}

}

std::string MakeSummary(const RunReport& run)
{
  constexpr std::size_t Column = 16;
  std::ostringstream text;
  std::istringstream lines(run.Summary);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t colon = line.find(": ");
    const std::string title = line.substr(0, colon);
    // Points have lines of their own, and the triangles that flips begin with are not the user's.
    if (!run.IsFromPoints ||
      (title != "geometry" && title != "constraints" && title != "bad edges"))
    {
      text << std::left << std::setw(Column) << title << line.substr(colon + 2) << '\n';
    }
    if (run.IsFromPoints && title == "mesh")
    {
      text << DescribePoints(run.Flip);
    }
  }
  const FlipReport& flip = run.Flip;
  text << std::fixed << std::setprecision(3) << "time            read " << run.ReadSeconds
       << " s, edges " << flip.BuildSeconds << " s, flips " << flip.FlipSeconds << " s, write "
       << run.WriteSeconds << " s" << (flip.Backend.empty() ? "" : " (" + flip.Backend + ")")
       << '\n';
  return text.str();
}

}
