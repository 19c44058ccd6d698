// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include <nlohmann/json.hpp>

#include <iomanip>
#include <limits>
#include <sstream>

namespace delaunayflip
{

void WriteJson(const RunReport& run, std::ostream& stream)
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
  json["blocked_by_edge"] = flip.BlockedByEdge;
  json["min_angle_before_deg"] = flip.MinimumAngleBefore;
  json["min_angle_after_deg"] = flip.MinimumAngleAfter;
  json["converged"] = flip.Converged();
  json["stop_reason"] = ToString(flip.StopReason);
  json["seconds"] = { { "read", run.ReadSeconds }, { "build", flip.BuildSeconds },
    { "flip", flip.FlipSeconds }, { "write", run.WriteSeconds } };
  json["warnings"] = run.Warnings;
  stream << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

void WriteCsv(const FlipReport& flip, std::ostream& stream)
{
  stream << "Iteration,Tested,NonDelaunay,Flipped,Excluded,Blocked,MinimumAngle,Seconds\n"
         << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const IterationRecord& record : flip.Iterations)
  {
    stream << record.Iteration << ',' << record.Tested << ',' << record.NonDelaunay << ','
           << record.Flipped << ',' << record.Excluded << ',' << record.Blocked << ',';
    if (record.MinimumAngle == record.MinimumAngle)
    {
      stream << record.MinimumAngle;
    }
    else
    {
      stream << "nan"; // a stream may print it with a sign
    }
    stream << ',' << record.Seconds << '\n';
  }
}

namespace
{

std::string Seconds(double seconds)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << seconds << " s";
  return text.str();
}

}

void WriteSummary(const RunReport& run, std::ostream& stream)
{
  constexpr std::size_t Column = 16;
  std::istringstream lines(run.Summary);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t colon = line.find(": ");
    stream << std::left << std::setw(Column) << line.substr(0, colon) << line.substr(colon + 2)
           << '\n';
  }
  const FlipReport& flip = run.Flip;
  stream << "time            read " << Seconds(run.ReadSeconds) << ", edges "
         << Seconds(flip.BuildSeconds) << ", flips " << Seconds(flip.FlipSeconds) << ", write "
         << Seconds(run.WriteSeconds) << (flip.Backend.empty() ? "" : " (" + flip.Backend + ")")
         << '\n';
}

}
