// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "InputChecks.h"
#include "PointPreparation.h"
#include "PointReport.h"
#include "RingDirections.h"
#include "SmallestAngle.h"
#include "SphereRings.h"
#include "SphereRun.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

/// @file
/// What a run on a sphere does with segments, rings and hole seeds.

namespace delaunayflip
{

namespace
{
constexpr const char* Remedy =
  ": segments on a sphere are not split where they cross, so give both a point there";
}

/// @throws InvalidOptions for hole seeds that are in no direction.
void SphereRun::CheckSeeds() const
{
  for (std::int64_t i = 0; i < this->Input.NumberOfHoleSeeds; ++i)
  {
    const double* seed = this->Input.HoleSeeds + 3 * i;
    if (seed[0] == 0.0 && seed[1] == 0.0 && seed[2] == 0.0)
    {
      throw InvalidOptions(
        "hole seed " + std::to_string(i) + " is at the center of the sphere, in no direction");
    }
  }
}

/// @throws InvalidMesh for a segment that could run anywhere.
void SphereRun::CheckOpposite() const
{
  constexpr double Units = 8.0; // of rounding, from angles to coordinates and to a unit length
  double rounding = Units * std::numeric_limits<double>::epsilon();
  if (this->Input.Points.Floats)
  {
    rounding = Units * std::numeric_limits<float>::epsilon();
  }
  for (std::int64_t i = 0; i < this->Input.NumberOfSegments; ++i)
  {
    const std::int64_t* ends = this->Input.Segments + 2 * i;
    if (AreOpposite(this->Points[ends[0]], this->Points[ends[1]], rounding))
    {
      throw InvalidMesh("segment " + std::to_string(i) + " from point " + std::to_string(ends[0]) +
          " to point " + std::to_string(ends[1]) +
          " has ends on opposite sides of the sphere, so it could run along any great circle "
          "through them: put a point between them",
        i, ends[0], GetRing(this->Input, i));
    }
  }
}

/// @throws InvalidOptions if segments cannot be inserted or seeds found, because the mesh does not
/// surround the origin: then great circles may leave it.
void SphereRun::RequireFacesOutside() const
{
  for (std::size_t first = 0; first < this->Triangles.size(); first += 3)
  {
    if (!FacesOutside(this->Points, &this->Triangles[first], Origin))
    {
      throw InvalidOptions(
        "segments and hole seeds on a sphere need points all around its center, but these are on "
        "one half of it: "
        "choose the open sphere, which leaves the triangles through the inside of the sphere out");
    }
  }
}

/// Takes the caller's segments, and turns those of each ring to one direction.
/// @throws InvalidMesh for a ring that is not closed.
void SphereRun::PrepareSegments()
{
  std::map<std::int32_t, std::vector<std::size_t>> rings; // by their numbers, indices of segments
  for (std::int64_t i = 0; i < this->Input.NumberOfSegments; ++i)
  {
    const std::int64_t* ends = this->Input.Segments + 2 * i;
    const std::int32_t ring = GetRing(this->Input, i);
    this->Segments.push_back({ ends[0], ends[1], ring, i });
    if (ring >= 0)
    {
      rings[ring].push_back(static_cast<std::size_t>(i));
    }
  }
  if (rings.empty())
  {
    return;
  }
  std::vector<std::int64_t> used(this->Points.size());
  this->StoreUsedPoints(used.data());
  for (const auto& [number, ring] : rings)
  {
    TurnSegments(ring, used, this->Segments);
  }
}

void SphereRun::InsertSegments()
{
  this->PrepareSegments();
  const bool isEmpty = this->Triangles.empty();
  SphereSegments inserted(this->Points, this->FindNeighborsOnce(), this->Triangles);
  for (const Segment& segment : this->Segments)
  {
    const std::int64_t from = this->FindUsed(segment.From), to = this->FindUsed(segment.To);
    if (!IsFinite(this->Points[segment.From]) || !IsFinite(this->Points[segment.To]))
    {
      this->Refuse(segment, RefusalKind::NotFinite, -1);
      continue;
    }
    if (isEmpty)
    {
      this->Refuse(segment, RefusalKind::NoTriangulation, -1);
      continue;
    }
    if (from < 0 || to < 0)
    {
      this->Refuse(segment, RefusalKind::EndInside, -1);
      continue;
    }
    using Outcome = SphereSegments::OutcomeKind;
    const Outcome outcome = inserted.Insert(static_cast<std::int32_t>(from),
      static_cast<std::int32_t>(to), static_cast<std::int32_t>(segment.Number));
    if (outcome == Outcome::Crosses)
    {
      this->Refuse(segment, RefusalKind::CrossesEarlier, inserted.GetCrossed());
    }
    if (outcome == Outcome::HasNoTriangle)
    {
      this->Refuse(segment, RefusalKind::EndInside, -1);
    }
  }
  this->Edges = inserted.GetEdges();
  this->Replaced = inserted.CountReplaced();
  this->ExplainRingRefused();
  if (this->Replaced > 0)
  {
    this->FlipAroundSegments();
  }
}

/// @param crossed the earlier segment that it crosses, or -1.
void SphereRun::Refuse(const Segment& segment, RefusalKind why, std::int32_t crossed)
{
  RefusedSegment refused{ segment, static_cast<std::uint32_t>(segment.Number), why, {} };
  if (crossed >= 0)
  {
    const std::int64_t* ends = this->Input.Segments + 2 * std::int64_t(crossed);
    refused.Crossed = { crossed, { ends[0], ends[1] } };
  }
  this->Refused.push_back(refused);
}

/// @throws InvalidMesh if a segment of a ring is refused: then the ring has no inside.
void SphereRun::ExplainRingRefused() const
{
  const auto ofRing = std::find_if(this->Refused.begin(), this->Refused.end(),
    [](const RefusedSegment& one) { return one.Refused.Ring >= 0; });
  if (ofRing != this->Refused.end() && !this->Triangles.empty())
  {
    const std::int64_t number = ofRing->Refused.Number;
    throw InvalidMesh(DescribeRefusal(*ofRing, this->Input.Segments, Remedy), number,
      this->Input.Segments[2 * number], ofRing->Refused.Ring);
  }
}

/// Flips until all edges but those of segments are convex. All triangles face away from the origin,
/// and all vertices are corners of the convex hull, so that none can be below the triangle of its
/// neighbours and block a flip.
void SphereRun::FlipAroundSegments()
{
  const FlipReport before = this->Report;
  const std::vector<std::int32_t> counts = this->FlipCounts;
  this->Center = Origin;
  this->Flip();
  std::transform(counts.begin(), counts.end(), this->FlipCounts.begin(), this->FlipCounts.begin(),
    std::plus<>());
  FlipReport& report = this->Report;
  std::vector<IterationRecord> all = before.Iterations;
  for (IterationRecord row : report.Iterations)
  {
    row.Iteration = SizeOf(all) + 1;
    all.push_back(row);
  }
  report.Iterations = all;
  report.TotalFlips += before.TotalFlips;
  report.TotalExcluded += before.TotalExcluded;
  report.TotalBlocked += before.TotalBlocked;
  report.BuildSeconds += before.BuildSeconds;
  report.FlipSeconds += before.FlipSeconds;
}

//------------------------------------------------------------------------------
void SphereRun::RemoveTriangles()
{
  if (this->Triangles.empty())
  {
    return;
  }
  this->FindNeighborsOnce();
  const SphereMeshView view{ this->Points, this->Triangles, this->Neighbors, this->Edges };
  std::vector<unsigned char> isRemoved(this->Triangles.size() / 3);
  if (this->Input.Rings)
  {
    std::vector<std::int32_t> rings;
    for (const Segment& segment : this->Segments)
    {
      rings.push_back(segment.Ring);
    }
    isRemoved = FindOutside(view, rings, this->Input.FirstHole, this->Options.RingRule, this->Kept);
  }
  std::vector<PlanePoint> seeds;
  for (std::int64_t i = 0; i < this->Input.NumberOfHoleSeeds; ++i)
  {
    const double* seed = this->Input.HoleSeeds + 3 * i;
    seeds.push_back({ seed[0], seed[1], seed[2] });
  }
  this->Kept.SeedsOutside = RemoveAround(view, seeds, isRemoved);
  this->Kept.Outside = std::count(isRemoved.begin(), isRemoved.end(), 1);
  if (this->Kept.Outside > 0)
  {
    this->WholeTriangles = this->Triangles;
    this->WholeNeighbors = this->Neighbors;
    std::int32_t kept = 0;
    for (const unsigned char isGone : isRemoved)
    {
      this->Numbers.push_back(isGone != 0 ? -1 : kept++);
    }
    this->DropTriangles(isRemoved);
  }
}

/// Drops triangles, and edges of segments that no other triangle has.
void SphereRun::DropTriangles(const std::vector<unsigned char>& isRemoved)
{
  std::size_t kept = 0;
  AngleSums angles;
  for (std::size_t t = 0; t < isRemoved.size(); ++t)
  {
    if (isRemoved[t] != 0)
    {
      continue;
    }
    std::copy_n(&this->Triangles[3 * t], 3, &this->Triangles[3 * kept]);
    angles.Add(MeasureTriangle(this->Points.data(), &this->Triangles[3 * kept]));
    this->FlipCounts[kept++] = this->FlipCounts[t];
  }
  this->Triangles.resize(3 * kept);
  this->FlipCounts.resize(kept);
  this->Neighbors.clear();
  KeepAnglesAfter(angles, this->Report);
  this->DropLostEdges();
}

/// Drops the edges that no triangle has any more.
void SphereRun::DropLostEdges()
{
  if (this->Edges.empty())
  {
    return;
  }
  std::vector<std::array<std::int32_t, 2>> sides;
  for (std::size_t corner = 0; corner < this->Triangles.size(); ++corner)
  {
    const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
    sides.push_back({ this->Triangles[corner], this->Triangles[next] });
  }
  std::sort(sides.begin(), sides.end());
  const auto isLost = [&](const SphereEdge& edge)
  {
    const std::array there{ edge.From, edge.To }, back{ edge.To, edge.From };
    return !std::binary_search(sides.begin(), sides.end(), there) &&
      !std::binary_search(sides.begin(), sides.end(), back);
  };
  this->Edges.erase(
    std::remove_if(this->Edges.begin(), this->Edges.end(), isLost), this->Edges.end());
}

//------------------------------------------------------------------------------
/// Counts and names what rings and seeds have removed, and those that could not remove anything.
void SphereRun::ListRemoved()
{
  FlipReport& report = this->Report;
  const KeptTriangles& kept = this->Kept;
  report.FromPoints.OutsideTriangles = kept.Outside;
  report.FromPoints.LeftOutRings = SizeOf(kept.RingsWithoutArea) + SizeOf(kept.RepeatedRings);
  Defect loss(DefectKind::NothingLeft, 0);
  const std::int64_t given = std::min(this->Input.FirstAdded, report.Points);
  const bool hasGiven = std::any_of(this->Triangles.begin(), this->Triangles.end(),
    [&](std::int32_t id) { return given == 0 || id < given; });
  if (kept.Outside > 0 && !hasGiven)
  {
    loss.Count = given == 0 ? report.Points : given;
    loss.Detail = ", because all triangles" +
      std::string(this->Triangles.empty() ? "" : " but those between points of segments") +
      " were removed (" + std::to_string(kept.Outside) + " outside)";
  }
  for (const Defect& defect : { Defect(DefectKind::HoleSeedsOutside, kept.SeedsOutside),
         NameRings(DefectKind::RingsWithoutArea, kept.RingsWithoutArea),
         NameRings(DefectKind::RingsRepeated, kept.RepeatedRings),
         NameRings(DefectKind::RingsRunAgain, kept.RingsRunAgain), loss })
  {
    AddDefect(defect, report.Defects);
  }
}

/// Counts the edges of segments, and names the segments that are refused.
void SphereRun::CountSegments()
{
  FlipReport& report = this->Report;
  PointCounts& counts = report.FromPoints;
  std::vector<std::array<std::int32_t, 2>> boundary;
  for (std::size_t corner = 0; corner < this->Triangles.size(); ++corner)
  {
    if (this->Neighbors[corner] < 0)
    {
      const std::size_t first = corner - corner % 3;
      boundary.push_back(
        { this->Triangles[first + (corner + 1) % 3], this->Triangles[first + (corner + 2) % 3] });
    }
  }
  std::sort(boundary.begin(), boundary.end());
  const auto isOnBoundary = [&](std::int32_t from, std::int32_t to) {
    return std::binary_search(boundary.begin(), boundary.end(), std::array{ from, to });
  };
  for (const SphereEdge& edge : this->Edges)
  {
    const bool isInside = !isOnBoundary(edge.From, edge.To) && !isOnBoundary(edge.To, edge.From);
    counts.SegmentEdges += static_cast<std::int64_t>(edge.IsFirst);
    report.Edges.Fixed += static_cast<std::int64_t>(edge.IsFirst && isInside);
  }
  counts.RefusedSegments = SizeOf(this->Refused);
  report.InsertedConstraints = this->Input.NumberOfSegments - counts.RefusedSegments;
  report.UnmatchedConstraints = counts.RefusedSegments;
  report.ConstraintFlips = this->Replaced;
  report.Edges.Constraint = counts.SegmentEdges;
  AddDefects(this->Refused, this->Input.Segments, Remedy, report.Defects);
}

std::vector<std::int64_t> SphereRun::ListSegmentEdges()
{
  std::vector<std::int64_t> pairs;
  for (const SphereEdge& edge : this->Edges)
  {
    if (edge.IsFirst)
    {
      pairs.insert(pairs.end(), { edge.From, edge.To });
    }
  }
  return pairs;
}

std::vector<std::int64_t> SphereRun::ListSegmentsOfEdges()
{
  std::vector<std::int64_t> segments;
  for (const SphereEdge& edge : this->Edges)
  {
    if (edge.IsFirst)
    {
      segments.push_back(edge.Segment);
    }
  }
  return segments;
}

}
