// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointRun.h"

#include "Array.h"
#include "InputChecks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// How the run of points refines its triangulation.

namespace delaunayflip
{
namespace
{

/// A piece of an edge, and the vertex at which it begins.
struct Piece
{
  VertexId Start;
  HalfEdgeId Side;

  bool operator<(const Piece& other) const { return this->Start < other.Start; }
};

/// Appends the subsegments of a segment's edge, in the direction of the segment.
/// @param edgesOfPieces the edges into which refinement has split that edge.
void AppendPieces(const PointMeshView& view, const SegmentEdge& before,
  const std::vector<EdgeId>& edgesOfPieces, std::vector<SegmentEdge>& edges)
{
  std::vector<Piece> pieces; // by start
  std::vector<VertexId> ends;
  for (const EdgeId edge : edgesOfPieces)
  {
    const HalfEdgeId side = 2 * edge + (before.Side & 1u);
    pieces.push_back({ view.GetStart(side), side });
    ends.push_back(view.GetEnd(side));
  }
  std::sort(pieces.begin(), pieces.end());
  std::sort(ends.begin(), ends.end());
  auto piece = std::find_if(pieces.begin(), pieces.end(),
    [&](const Piece& one) { return !std::binary_search(ends.begin(), ends.end(), one.Start); });
  const std::size_t begin = edges.size();
  while (piece != pieces.end())
  {
    SegmentEdge edge = before;
    edge.Side = piece->Side;
    edges.push_back(edge);
    const Piece next = { view.GetEnd(piece->Side), 0 };
    piece = std::lower_bound(pieces.begin(), pieces.end(), next);
    if (piece != pieces.end() && piece->Start != next.Start)
    {
      piece = pieces.end();
    }
  }
  if (!before.IsOnLeft)
  {
    std::reverse(edges.begin() + static_cast<std::ptrdiff_t>(begin), edges.end());
  }
}

/// @param origins by edge that there was before, its number.
std::vector<SegmentEdge> SplitEdges(const PointMeshView& view,
  const std::vector<SegmentEdge>& before, const std::vector<Subsegment>& subsegments,
  const std::vector<std::uint32_t>& origins)
{
  std::vector<std::vector<EdgeId>> pieces(subsegments.size());
  for (const Subsegment& subsegment : subsegments)
  {
    pieces[subsegment.Origin].push_back(subsegment.Edge);
  }
  std::vector<SegmentEdge> edges;
  for (const SegmentEdge& edge : before)
  {
    AppendPieces(view, edge, pieces[origins[EdgeOf(edge.Side)]], edges);
  }
  return edges;
}

}

bool PointRun::WantsRefinement() const
{
  const PointInput& input = this->Points.GetCaller();
  return HasGoals(this->Options) || input.Sizes != nullptr ||
    HasAreas(input.Regions, input.NumberOfRegions);
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
    { result.Regions = FindRegions(view, input, result.Kept, result.RegionSeedsOutside); });
}

RefinementPlan PointRun::PlanRefinement(LoadedMesh& mesh)
{
  const PointInput& input = this->Points.GetCaller();
  const FlipReport& report = mesh.GetInputReport();
  const std::int64_t unused = report.FromPoints.NotFinite + report.FromPoints.Repeated;
  RefinementPlan plan = this->PlanGoals(report.Points - unused);
  this->Result.EdgesBefore = this->Result.Edges;
  plan.Regions = this->Result.Regions;
  if (plan.Regions.empty() && this->Result.HasRemoved())
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
  const RefinementResult made = mesh.FetchRefinement();
  std::vector<std::uint32_t> origins;
  for (const Subsegment& subsegment : made.Segments)
  {
    origins.resize(
      std::max<std::size_t>(origins.size(), subsegment.Edge + std::size_t(1)), NoOrigin);
    origins[subsegment.Edge] = subsegment.Origin;
  }
  this->AddRefinedPoints(made, origins);
  const std::int64_t unrefined = this->HasEndedRefinement() ? made.Unrefined : 0;
  result.Unrefined = Defect(DefectKind::TrianglesNotRefined, unrefined);
  result.HasReachedLimit = made.HasReachedLimit;
  result.RefinementRounds = this->Rounds;
  const auto countRegions = static_cast<std::int64_t>(result.Regions.size());
  if (countRegions > 0)
  {
    result.Regions = made.Regions;
  }
  if (result.HasRemoved() || !result.EdgesBefore.empty())
  {
    mesh.ViewOnHost(
      [&](const PointMeshView& view)
      {
        result.Edges = SplitEdges(view, result.EdgesBefore, made.Segments, origins);
        this->RenumberKept(view, made.Regions);
      });
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

/// @param regions by triangle, -1 where it is removed; empty if none is.
void PointRun::RenumberKept(const PointMeshView& view, const std::vector<std::int32_t>& regions)
{
  if (this->Result.HasRemoved())
  {
    std::vector<unsigned char> isRemoved;
    for (const std::int32_t region : regions)
    {
      isRemoved.push_back(region < 0 ? 1 : 0);
    }
    RenumberTriangles(view, std::move(isRemoved), this->Points.GetInput().FirstAdded,
      this->Result.Edges, this->Result.Kept);
  }
}

/// @param origins by edge on a segment, the number of the edge before refinement of which it is a
/// piece.
void PointRun::AddRefinedPoints(
  const RefinementResult& made, const std::vector<std::uint32_t>& origins)
{
  std::vector<std::int64_t> segmentOf(made.Segments.size(), -1); // by number of an edge before
  for (auto edge = this->Result.EdgesBefore.rbegin(); edge != this->Result.EdgesBefore.rend();
       ++edge)
  {
    segmentOf[origins[EdgeOf(edge->Side)]] = this->Points.GetSegments()[edge->Segment].Number;
  }
  std::vector<AddedPoint> points;
  points.reserve(made.Vertices.size());
  for (const RefinedVertex& vertex : made.Vertices)
  {
    AddedPoint point;
    point.X = vertex.U;
    point.Y = vertex.V;
    point.From = vertex.Points[0];
    point.To = vertex.Points[1];
    point.Share = vertex.Weights[1];
    if (vertex.Origin == NoOrigin)
    {
      point.Third = vertex.Points[2];
      point.ThirdShare = vertex.Weights[2];
    }
    else
    {
      point.Segment = segmentOf[vertex.Origin];
    }
    points.push_back(point);
  }
  this->Points.SetRefined(points);
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
