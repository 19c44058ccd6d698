// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointReport.h"

#include "InputChecks.h"
#include "SmallestAngle.h"
#include "Strips.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace delaunayflip
{

namespace
{
/// A box around places.
struct CoordinateBox
{
  double Low[2] = { INFINITY, INFINITY };
  double High[2] = { -INFINITY, -INFINITY };

  void Add(double x, double y)
  {
    if (IsFinite(x) && IsFinite(y))
    {
      this->Low[0] = std::min(this->Low[0], x);
      this->Low[1] = std::min(this->Low[1], y);
      this->High[0] = std::max(this->High[0], x);
      this->High[1] = std::max(this->High[1], y);
    }
  }

  std::string Describe() const
  {
    constexpr int Digits = 10; // of a map's coordinates, down to millimetres
    const auto format = [](double value) { return FormatNumber(value, Digits); };
    return "x " + format(this->Low[0]) + " to " + format(this->High[0]) + ", y " +
      format(this->Low[1]) + " to " + format(this->High[1]);
  }
};

std::vector<std::int32_t> ListRingsWithoutArea(
  const PreparedPoints& points, const KeptTriangles& kept)
{
  std::vector<std::int32_t> numbers = points.GetLeftOutRings();
  numbers.insert(numbers.end(), kept.RingsWithoutArea.begin(), kept.RingsWithoutArea.end());
  return numbers;
}

/// Counts what was prepared, inserted and removed.
void AddCounts(FlipReport& report, const PreparedPoints& points, const PointResult& result)
{
  PointCounts& counts = report.FromPoints;
  const PointCounts& prepared = points.GetCounts();
  // The loaded mesh counts points that are removed or too near as not finite.
  const std::int64_t notFiniteOrRemoved = counts.NotFinite - prepared.TooNear;
  const std::int64_t repeated = counts.Repeated;
  const std::int64_t places = points.CountAll() - notFiniteOrRemoved - repeated - prepared.TooNear;
  counts = prepared;
  counts.Removed = SizeOf(points.GetRemoved());
  counts.NotFinite = notFiniteOrRemoved - counts.Removed;
  counts.Repeated = repeated;
  counts.MoveRounds = result.MoveRounds;
  std::int64_t inside = 0; // of these edges
  for (const SegmentEdge& edge : result.Edges)
  {
    counts.SegmentEdges += static_cast<std::int64_t>(edge.IsFirst);
    inside += static_cast<std::int64_t>(edge.IsFirst && !edge.IsOnBoundary);
  }
  counts.RefusedSegments = SizeOf(result.Refused);
  counts.RefinementPoints = points.CountRefined();
  counts.RefinementRounds = result.RefinementRounds;
  counts.UnrefinedTriangles = result.Unrefined.Count;
  counts.ReachedPointLimit = result.HasReachedLimit ? 1 : 0;
  if (report.Triangles > 0)
  {
    counts.Used = places;
  }
  counts.OutsideTriangles = result.Kept.Outside;
  counts.LargeTriangles = result.Kept.Large;
  counts.LeftOutRings =
    SizeOf(ListRingsWithoutArea(points, result.Kept)) + SizeOf(result.Kept.RepeatedRings);
  report.Points = points.GetCaller().Points.Count;
  report.InsertedConstraints = result.Inserted;
  report.UnmatchedConstraints = counts.RefusedSegments;
  report.ConstraintFlips = result.Flips;
  report.Edges.Constraint = counts.SegmentEdges;
  if (result.HasRemoved())
  {
    counts.Used = result.Kept.Used;
    report.Triangles = result.Kept.Count;
    report.Edges.Edges = result.Kept.Edges;
    report.Edges.Boundary = result.Kept.Boundary;
    report.EulerCharacteristic = result.Kept.EulerCharacteristic;
    KeepAnglesAfter(result.Kept.Angles, report);
  }
  report.Edges.Fixed = report.Edges.Boundary + inside;
}

/// Adds points that are not used, each kind with the ids of the first ones.
void AddUnusedPoints(FlipReport& report, const LoadedMesh& mesh, const PreparedPoints& points)
{
  constexpr std::int64_t Piece = 1 << 14; // as many results at a time come from a GPU
  const PointCounts& counts = report.FromPoints;
  const auto add = [&](DefectKind kind, std::int64_t count, const auto& isListed)
  {
    Defect defect(kind, count);
    const std::int64_t most = std::min(count, MostNamedIds);
    std::vector<std::int64_t> used(most > 0 ? std::min(Piece, report.Points) : 0);
    for (std::int64_t i = 0; SizeOf(defect.FirstIds) < most && i < report.Points; ++i)
    {
      if (i % Piece == 0)
      {
        mesh.StoreUsedPoints(i, std::min(Piece, report.Points - i), used.data());
      }
      if (isListed(i, used[i % Piece]))
      {
        defect.FirstIds.push_back(i);
      }
    }
    AddDefect(defect, report.Defects);
  };
  add(DefectKind::PointsNotFinite, counts.NotFinite,
    [&](std::int64_t i, std::int64_t used)
    { return used < 0 && !points.IsNear(i) && !points.IsRemoved(i); });
  add(DefectKind::PointsRepeated, counts.Repeated,
    [](std::int64_t i, std::int64_t used) { return used >= 0 && used != i; });
  add(DefectKind::PointsTooNear, counts.TooNear,
    [&](std::int64_t i, std::int64_t) { return points.IsNear(i); });
}
}

Defect NameRings(DefectKind kind, std::vector<std::int32_t> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  const std::int64_t count = SizeOf(numbers);
  numbers.resize(std::min<std::int64_t>(MostNamedIds, count));
  return Defect(kind, count, { numbers.begin(), numbers.end() });
}

bool IsLost(const PointInput& input, const KeptTriangles& kept)
{
  if (kept.Outside + kept.Large == 0)
  {
    return false;
  }
  return input.FirstAdded > 0 ? kept.UsedGiven == 0 : kept.Count == 0;
}

Defect DescribeLoss(const PreparedPoints& points, const KeptTriangles& kept)
{
  const PointInput& input = points.GetInput();
  const PointInput& caller = points.GetCaller();
  std::int64_t given = std::min(input.FirstAdded, caller.Points.Count);
  if (given == 0)
  {
    given = caller.Points.Count;
  }
  CoordinateBox places, segments, seeds;
  for (std::int64_t i = 0; i < given; ++i)
  {
    places.Add(input.Points.Get(i, 0), input.Points.Get(i, 1));
  }
  for (const Segment& segment : points.GetSegments())
  {
    segments.Add(input.Points.Get(segment.From, 0), input.Points.Get(segment.From, 1));
    segments.Add(input.Points.Get(segment.To, 0), input.Points.Get(segment.To, 1));
  }
  for (std::int64_t i = 0; i < caller.NumberOfHoleSeeds; ++i)
  {
    seeds.Add(caller.HoleSeeds[2 * i], caller.HoleSeeds[2 * i + 1]);
  }
  std::string removed = "all triangles";
  if (kept.Count > 0)
  {
    removed += " but those between points of segments";
  }
  std::string text = ", because " + removed + " were removed (" + std::to_string(kept.Outside) +
    " outside, " + std::to_string(kept.Large) + " too large); the points lie in " +
    places.Describe();
  if (!points.GetSegments().empty())
  {
    text += ", the segments in " + segments.Describe();
  }
  if (caller.NumberOfHoleSeeds > 0)
  {
    text += ", the hole seeds in " + seeds.Describe();
  }
  Defect loss(DefectKind::NothingLeft, given);
  loss.Detail = text;
  return loss;
}

void AddPointsTo(
  FlipReport& report, LoadedMesh& mesh, const PreparedPoints& points, const PointResult& result)
{
  const KeptTriangles& kept = result.Kept;
  AddCounts(report, points, result);
  AddUnusedPoints(report, mesh, points);
  AddDefects(result.Refused, points.GetCaller().Segments,
    GetRemedy(points.GetOptions().SplitCrossings), report.Defects);
  std::int64_t pointsWithoutMesh = 0;
  if (report.Triangles + kept.Outside + kept.Large == 0)
  {
    pointsWithoutMesh = report.Points;
  }
  for (const Defect& defect : { Defect(DefectKind::HoleSeedsOutside, kept.SeedsOutside),
         NameRings(DefectKind::RingsWithoutArea, ListRingsWithoutArea(points, kept)),
         NameRings(DefectKind::RingsRepeated, kept.RepeatedRings),
         NameRings(DefectKind::RingsRunAgain, kept.RingsRunAgain),
         Defect(DefectKind::HolePointsOutside, kept.HolePointsOutside),
         Defect(DefectKind::PointsWithoutTriangles, pointsWithoutMesh), result.Loss,
         result.Seeds.Outside, result.Seeds.Repeated, result.Unrefined })
  {
    AddDefect(defect, report.Defects);
  }
}

}
