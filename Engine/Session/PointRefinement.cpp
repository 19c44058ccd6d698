// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "InputChecks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

/// @file
/// How the run of points refines its triangulation.

namespace delaunayflip
{
namespace
{

/// A subsegment on a side of the edge that it is a piece of.
struct Piece
{
  VertexId Start, End;
  EdgeId Edge;

  bool operator<(const Piece& other) const { return this->Start < other.Start; }
};

/// The subsegments that refinement has made of the edges of segments.
class PieceMap
{
public:
  explicit PieceMap(const std::vector<Subsegment>& subsegments)
    : Subsegments(subsegments),
      FirstOfOrigin(subsegments.size() + 1, 0),
      ByOrigin(subsegments.size())
  {
    // Those before refinement come first, ordered by edge, and each is its own origin.
    while (this->Before < subsegments.size() && subsegments[this->Before].Origin == this->Before)
    {
      ++this->Before;
    }
    for (const Subsegment& subsegment : subsegments)
    {
      ++this->FirstOfOrigin[subsegment.Origin + 1];
    }
    std::partial_sum(
      this->FirstOfOrigin.begin(), this->FirstOfOrigin.end(), this->FirstOfOrigin.begin());
    std::vector<std::uint32_t> next(this->FirstOfOrigin.begin(), this->FirstOfOrigin.end() - 1);
    for (std::size_t i = 0; i < subsegments.size(); ++i)
    {
      this->ByOrigin[next[subsegments[i].Origin]++] = static_cast<std::uint32_t>(i);
    }
  }

  /// The origin of an edge that was a subsegment before refinement. The first subsegments are
  /// these, and keep their edges.
  std::uint32_t FindOrigin(EdgeId edge) const
  {
    const auto begin = this->Subsegments.begin();
    const auto found = std::lower_bound(begin, begin + static_cast<std::ptrdiff_t>(this->Before),
      edge, [](const Subsegment& one, EdgeId other) { return one.Edge < other; });
    return found->Origin;
  }

  /// Appends the pieces of a segment's edge, in the direction of the segment.
  /// @param origin what FindOrigin returns for the edge.
  void AppendPieces(
    const SegmentEdge& before, std::uint32_t origin, std::vector<SegmentEdge>& edges)
  {
    const HalfEdgeId parity = before.Side & 1u; // 1: pieces run against their edges
    this->Pieces.clear();
    this->Ends.clear();
    for (std::uint32_t i = this->FirstOfOrigin[origin]; i < this->FirstOfOrigin[origin + 1]; ++i)
    {
      const Subsegment& one = this->Subsegments[this->ByOrigin[i]];
      const VertexId ends[2] = { one.Start, one.End };
      this->Pieces.push_back({ ends[parity], ends[1u - parity], one.Edge });
      this->Ends.push_back(ends[1u - parity]);
    }
    std::sort(this->Pieces.begin(), this->Pieces.end());
    std::sort(this->Ends.begin(), this->Ends.end());
    // The first piece starts where no other one ends; each next one starts where the last one ends.
    auto piece = std::find_if(this->Pieces.begin(), this->Pieces.end(),
      [&](const Piece& one)
      { return !std::binary_search(this->Ends.begin(), this->Ends.end(), one.Start); });
    const std::size_t begin = edges.size();
    while (piece != this->Pieces.end())
    {
      SegmentEdge edge = before;
      edge.Side = 2 * piece->Edge + parity;
      edges.push_back(edge);
      const Piece next = { piece->End, 0, 0 };
      piece = std::lower_bound(this->Pieces.begin(), this->Pieces.end(), next);
      if (piece != this->Pieces.end() && piece->Start != next.Start)
      {
        piece = this->Pieces.end();
      }
    }
    if (!before.IsOnLeft)
    {
      std::reverse(edges.begin() + static_cast<std::ptrdiff_t>(begin), edges.end());
    }
  }

private:
  const std::vector<Subsegment>& Subsegments;
  std::size_t Before = 0; ///< How many there were before refinement.
  std::vector<std::uint32_t> FirstOfOrigin, ByOrigin;
  std::vector<Piece> Pieces; ///< Those of the edge at hand, by start.
  std::vector<VertexId> Ends;
};

}

void PointRun::LabelRegions()
{
  this->OnBackend([this](LoadedMesh& mesh) { this->LabelRegions(mesh); });
  this->RecordChange(0);
}

void PointRun::LabelRegions(LoadedMesh& mesh)
{
  const PointInput& input = this->Points.GetCaller();
  PointResult& result = this->Result;
  mesh.ViewOnHost([&](const PointMeshView& view)
    { result.Regions = FindRegions(view, input, result.Kept, result.Seeds); });
}

RefinementPlan PointRun::PlanRefinement(LoadedMesh& mesh)
{
  const PointInput& input = this->Points.GetCaller();
  const FlipReport& report = mesh.GetInputReport();
  const std::int64_t unused = report.FromPoints.NotFinite + report.FromPoints.Repeated;
  const std::int64_t given = report.Points - unused;
  const bool hasRemoved = this->Result.HasRemoved();
  RefinementPlan plan = this->PlanGoals(mesh, given, hasRemoved ? this->Result.Kept.Used : given);
  this->Result.EdgesBefore = this->Result.Edges;
  plan.Regions = this->Result.Regions;
  if (plan.Regions.empty() && hasRemoved)
  {
    for (const std::int32_t number : this->Result.Kept.Numbers)
    {
      plan.Regions.push_back(number < 0 ? -1 : 0);
    }
  }
  if (!this->Result.Regions.empty())
  {
    plan.AreaOfRegion.assign(input.NumberOfRegions + 1, INFINITY);
    for (std::int64_t i = 0; i < input.NumberOfRegions; ++i)
    {
      const double area = input.Regions[i].MaximumArea;
      plan.AreaOfRegion[i + 1] = area > 0.0 ? area : INFINITY;
    }
  }
  if (input.Sizes)
  {
    plan.Sizes = this->Points.ListSizes();
  }
  return plan;
}

/// Takes over what the rounds have made so far.
void PointRun::TakeRefinement(LoadedMesh& mesh)
{
  PointResult& result = this->Result;
  const RefinementResult& made = mesh.FetchRefinement(this->IsRefinementOver());
  PieceMap pieces(made.Segments);
  std::vector<std::uint32_t> originOf; // by edge of EdgesBefore
  originOf.reserve(result.EdgesBefore.size());
  for (const SegmentEdge& edge : result.EdgesBefore)
  {
    originOf.push_back(pieces.FindOrigin(EdgeOf(edge.Side)));
  }
  this->CountRefinedPoints(made, originOf);
  const std::int64_t unrefined = this->HasEndedRefinement() ? made.Unrefined : 0;
  result.Unrefined = Defect(DefectKind::TrianglesNotRefined, unrefined);
  result.HasReachedLimit = made.HasReachedLimit;
  result.RefinementRounds = this->Rounds;
  if (!result.Regions.empty())
  {
    result.Regions = made.Regions;
  }
  result.Edges.clear();
  result.Edges.reserve(made.Segments.size());
  for (std::size_t i = 0; i < originOf.size(); ++i)
  {
    pieces.AppendPieces(result.EdgesBefore[i], originOf[i], result.Edges);
  }
  if (result.HasRemoved())
  {
    mesh.NumberKept(made.Regions, this->Points.GetInput().FirstAdded, result.Edges, result.Kept);
  }
  for (const TriangleId triangle : made.FirstUnrefined)
  {
    const std::int32_t number =
      result.HasRemoved() ? result.Kept.Numbers[triangle] : static_cast<std::int32_t>(triangle);
    result.Unrefined.FirstIds.push_back(number);
  }
  std::sort(result.Unrefined.FirstIds.begin(), result.Unrefined.FirstIds.end());
  this->Report.Triangles = mesh.GetInputReport().Triangles;
  if (result.HasRemoved())
  {
    this->Report.Triangles = result.Kept.Count;
  }
}

/// @param originOf the numbers of Result.EdgesBefore among the subsegments.
void PointRun::CountRefinedPoints(
  const RefinementResult& made, const std::vector<std::uint32_t>& originOf)
{
  std::vector<std::int64_t> segmentOf(made.Segments.size(), -1); // by number of an edge before
  for (std::size_t i = originOf.size(); i-- > 0;)
  {
    const SegmentEdge& edge = this->Result.EdgesBefore[i];
    segmentOf[originOf[i]] = this->Points.GetSegments()[edge.Segment].Number;
  }
  this->Points.SetRefined(made.Added, std::move(segmentOf));
  this->Added.clear();
}

/// Visits the points at crossings, and then those of refinement, on several threads.
void PointRun::VisitAdded(const std::function<void(std::int64_t, const AddedPoint&)>& visit)
{
  const std::vector<AddedPoint>& crossings = this->Points.GetAdded();
  for (std::int64_t i = 0; i < SizeOf(crossings); ++i)
  {
    visit(i, crossings[i]);
  }
  const std::int64_t refined = this->Points.CountRefined();
  const auto visitRefined = [&](std::int64_t i, const RefinedVertex& vertex)
  {
    if (i < refined) // else an exception has ended a round after these
    {
      visit(SizeOf(crossings) + i, this->Points.Describe(vertex));
    }
  };
  if (refined > 0)
  {
    this->TryOnBackend([&](LoadedMesh& mesh) { mesh.VisitRefined(visitRefined); });
  }
}

void PointRun::StoreAddedPoints(const AddedPointArrays& arrays)
{
  this->VisitAdded([&](std::int64_t i, const AddedPoint& point) { arrays.Set(i, point); });
}

/// Points of refinement are listed only if they are asked for, because the list is long.
const std::vector<AddedPoint>& PointRun::GetAddedPoints()
{
  const std::int64_t refined = this->Points.CountRefined();
  if (refined > 0 && this->Added.empty())
  {
    std::vector<AddedPoint> added(SizeOf(this->Points.GetAdded()) + refined);
    this->VisitAdded([&](std::int64_t i, const AddedPoint& point) { added[i] = point; });
    this->Added = std::move(added);
  }
  return this->Points.CountRefined() > 0 ? this->Added : this->Points.GetAdded();
}

//------------------------------------------------------------------------------
void PointRun::StoreRegions(std::int32_t* labels)
{
  const PointInput& input = this->Points.GetCaller();
  const PointResult& result = this->Result;
  std::fill_n(labels, this->Report.Triangles, 0);
  const bool isNumbered = result.HasRemoved();
  for (std::size_t t = 0; t < result.Regions.size(); ++t)
  {
    const std::int32_t region = result.Regions[t];
    if (region > 0)
    {
      const std::int64_t number = isNumbered ? result.Kept.Numbers[t] : std::int64_t(t);
      labels[number] = input.Regions[region - 1].Label;
    }
  }
}

std::vector<std::int64_t> PointRun::ListSegmentsOfEdges()
{
  std::vector<std::int64_t> numbers;
  for (const SegmentEdge& edge : this->Result.Edges)
  {
    if (edge.IsFirst)
    {
      numbers.push_back(this->Points.GetSegments()[edge.Segment].Number);
    }
  }
  return numbers;
}

}
