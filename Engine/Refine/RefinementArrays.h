// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTARRAYS_H
#define DELAUNAYFLIP_REFINEMENTARRAYS_H

#include "Array.h"
#include "MeshRoom.h"
#include "PlaceGrid.h"
#include "RefinementItem.h"
#include "RefinementPlan.h"
#include "RefinementStep.h"
#include "RefinementView.h"
#include "TriangleSplit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// What refinement keeps beside a mesh: by triangle, edge and vertex, and the mesh before it, in
/// which what belongs to new vertices is interpolated.

namespace delaunayflip
{

/// The arrays of a mesh that become larger.
template <typename Real>
struct GrowingMesh
{
  EdgeMesh* Mesh;
  Array<Real>* Coordinates; ///< x and y by vertex.
  Array<VertexId>* Ids; ///< By vertex, the number of its point.
  std::int64_t Vertices; ///< How many there are.
  std::int64_t FirstId; ///< The number of the first point that is added.
  bool IsInFilterRange; ///< Whether the filters may be used for all places.

  PlaneMesh View() const
  {
    PlaneMesh plane{ this->Mesh->View(),
      PlaneArray(static_cast<const Real*>(this->Coordinates->Data()), this->Vertices, 2) };
    plane.IsTriangulation = true;
    plane.IsInFilterRange = this->IsInFilterRange;
    return plane;
  }
};

/// The numbers of what an item adds, kind by kind.
struct RefinementNumbers
{
  std::int64_t Vertex, Triangle, Edge, Subsegment;
};

/// Splits what items split, and stores what belongs to it.
template <typename Real>
struct RefinementStore
{
  TriangleSplitter Splitter;
  RefinementNumbers Before; ///< How much there was.
  Real* Coordinates;
  VertexId* Ids;
  std::int64_t FirstId, FirstVertex; ///< Those of the first vertex that refinement has added.
  std::uint32_t* Shapes;
  std::int32_t* Regions;
  double* Sizes;
  std::uint64_t* Claims;
  EdgeId* Segments;
  std::uint8_t* Marks;
  std::uint32_t* Origins;
  std::uint32_t* SegmentOfEdge;
  std::uint32_t* OriginOfVertex;
  const VertexId* Ends;
  std::uint8_t* IsSharp;
  TriangleId* Splits; ///< By vertex that the round adds, a triangle that it splits.
  RefinedVertex* Added; ///< From the first one on that refinement has added.
  /// Of the old mesh, that of each of these vertices; NoTriangle for those on segments.
  TriangleId* OldTriangleOf;
  PlaneMesh Old; ///< The mesh before refinement.
  PlaceGridView Grid;

  DELAUNAYFLIP_HOST_DEVICE void Split(
    const RefinementItem& item, const RefinementNumbers& own) const
  {
    const auto vertex = static_cast<VertexId>(this->Before.Vertex + own.Vertex);
    const auto triangle = static_cast<TriangleId>(this->Before.Triangle + own.Triangle);
    const auto edge = static_cast<EdgeId>(this->Before.Edge + own.Edge);
    this->Coordinates[2 * std::size_t(vertex)] = static_cast<Real>(item.Place.U);
    this->Coordinates[2 * std::size_t(vertex) + 1] = static_cast<Real>(item.Place.V);
    this->Ids[vertex] = static_cast<VertexId>(this->FirstId + (vertex - this->FirstVertex));
    this->IsSharp[vertex] = 0;
    const CornerId across =
      item.Found.FindEdgeSlot() >= 0 ? this->Splitter.FindAcross(item.Found) : NoCorner;
    this->TakeOver(item.Found.Triangle, triangle);
    if (item.Found.FindEdgeSlot() < 0)
    {
      this->TakeOver(item.Found.Triangle, triangle + 1);
    }
    else if (across != NoCorner)
    {
      this->TakeOver(TriangleOf(across), triangle + 1);
    }
    std::uint32_t origin = NoOrigin;
    if (item.IsOnSegment)
    {
      const auto added = static_cast<std::uint32_t>(this->Before.Subsegment + own.Subsegment);
      origin = this->Origins[item.Source];
      this->Origins[added] = origin;
      this->Marks[item.Source] = 0;
      this->Marks[added] = 0;
      this->Segments[added] = edge;
      this->SegmentOfEdge[edge] = added;
    }
    this->OriginOfVertex[vertex] = origin;
    this->Splits[own.Vertex] = item.Found.Triangle;
    RefinedVertex& added = this->Added[vertex - this->FirstVertex];
    TriangleId& oldTriangle = this->OldTriangleOf[vertex - this->FirstVertex];
    oldTriangle = origin == NoOrigin ? this->FindOldTriangle(item) : NoTriangle;
    added = this->Interpolate(item, origin, oldTriangle);
    if (this->Sizes)
    {
      this->Sizes[vertex] = this->InterpolateSize(added);
    }
    this->Splitter.Split({ vertex, item.Found, triangle, edge });
  }

private:
  /// A new triangle is in the region of the one that is split, and both are judged again.
  DELAUNAYFLIP_HOST_DEVICE void TakeOver(TriangleId from, TriangleId to) const
  {
    this->Regions[to] = this->Regions[from];
    this->Claims[to] = RefinementKey::None;
    this->Shapes[from] = static_cast<std::uint32_t>(ShapeKind::Unknown);
    this->Shapes[to] = static_cast<std::uint32_t>(ShapeKind::Unknown);
  }

  /// What belongs to a vertex is linear along the segment that it splits, and else in the triangle
  /// that it was in at first.
  DELAUNAYFLIP_HOST_DEVICE RefinedVertex Interpolate(
    const RefinementItem& item, std::uint32_t origin, TriangleId triangle) const
  {
    RefinedVertex vertex{ item.Place.U, item.Place.V, origin, { 0, 0, 0 }, { 1.0, 0.0, 0.0 } };
    if (origin != NoOrigin)
    {
      const VertexId* ends = this->Ends + 2 * std::size_t(origin);
      const PlanePoint from = this->Old.GetPoint(ends[0]), to = this->Old.GetPoint(ends[1]);
      const double length = std::sqrt(TriangleShape::GetSquaredDistance(from, to));
      vertex.Weights[1] = std::sqrt(TriangleShape::GetSquaredDistance(from, item.Place)) / length;
      vertex.Weights[0] = 1.0 - vertex.Weights[1];
      vertex.Points[0] = ends[0];
      vertex.Points[1] = ends[1];
      vertex.Points[2] = ends[0];
      return vertex;
    }
    double sum = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const VertexId* vertices = this->Old.Edges.Triangles[triangle].Vertices;
      const PlanePoint a = this->Old.GetPoint(vertices[NextSlot(slot)]);
      const PlanePoint b = this->Old.GetPoint(vertices[PreviousSlot(slot)]);
      const double area =
        (a.U - item.Place.U) * (b.V - item.Place.V) - (a.V - item.Place.V) * (b.U - item.Place.U);
      vertex.Points[slot] = vertices[slot];
      vertex.Weights[slot] = area > 0.0 ? area : 0.0;
      sum += vertex.Weights[slot];
    }
    for (double& weight : vertex.Weights)
    {
      weight = sum > 0.0 ? weight / sum : 1.0 / 3.0;
    }
    return vertex;
  }

  /// The walk begins where the newest corner of the triangle that is split was at first.
  DELAUNAYFLIP_HOST_DEVICE TriangleId FindOldTriangle(const RefinementItem& item) const
  {
    std::int64_t newest = -1;
    for (const VertexId vertex : this->Splitter.GetMesh().Triangles[item.Found.Triangle].Vertices)
    {
      const std::int64_t number = std::int64_t(vertex) - this->FirstVertex;
      newest = number > newest ? number : newest;
    }
    TriangleId start = newest >= 0 ? this->OldTriangleOf[newest] : NoTriangle;
    if (start == NoTriangle)
    {
      start = this->Grid.FindStart(item.Place);
    }
    PlaneMesh old = this->Old;
    old.IsInFilterRange = old.IsInFilterRange && IsInFilterRange(item.Place);
    const FoundPlace found = WalkToPlace(old, item.Place, start);
    return found.IsOutside() ? start : found.Triangle; // outside by rounding
  }

  DELAUNAYFLIP_HOST_DEVICE double InterpolateSize(const RefinedVertex& vertex) const
  {
    double size = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      if (vertex.Weights[k] != 0.0)
      {
        size += vertex.Weights[k] * this->Sizes[vertex.Points[k]];
      }
    }
    return size;
  }
};

/// Marks a vertex where a kept triangle's edge meets the next segment around it at less than 60
/// degrees.
struct SharpCornerStep
{
  PlaneMesh Mesh;
  const std::int32_t* Regions;
  std::uint8_t* IsSharp;

  /// @param side of a segment; the corner at its start is judged.
  DELAUNAYFLIP_HOST_DEVICE void operator()(HalfEdgeId side) const
  {
    CornerId corner =
      this->Mesh.Edges.CornerOfHalfEdge[side]; // opposite the edge that was turned over
    if (corner == NoCorner || this->Regions[TriangleOf(corner)] < 0)
    {
      return;
    }
    const VertexId vertex = this->Mesh.GetStart(side);
    const PlanePoint place = this->Mesh.GetPoint(vertex),
                     end = this->Mesh.GetPoint(this->Mesh.GetEnd(side));
    const double u = end.U - place.U, v = end.V - place.V;
    for (;;)
    {
      const PlanePoint other = this->Mesh.GetPoint(this->Mesh.GetVertex(corner));
      const double s = other.U - place.U, t = other.V - place.V;
      const double dot = u * s + v * t;
      const bool isSmall = dot > 0.0 && 4.0 * dot * dot > (u * u + v * v) * (s * s + t * t);
      if (!isSmall)
      {
        return;
      }
      const HalfEdgeId next = this->Mesh.GetHalfEdge(PlaneMesh::Previous(corner));
      if (this->Mesh.IsFixed(next))
      {
        AtomicStore(&this->IsSharp[vertex], std::uint8_t(1));
        return;
      }
      corner = this->Mesh.Edges.CornerOfHalfEdge[next ^ 1u];
    }
  }
};

/// Whether an edge is a subsegment of a kept triangle, as 1 or 0.
struct SegmentTest
{
  EdgeMeshView Mesh;
  const std::int32_t* Regions;

  DELAUNAYFLIP_HOST_DEVICE int CountKept(std::int64_t e) const
  {
    const CornerPair corners = this->Mesh.GetCorners(static_cast<EdgeId>(e));
    const bool hasA = corners.A != NoCorner && this->Regions[TriangleOf(corners.A)] >= 0;
    const bool hasB = corners.B != NoCorner && this->Regions[TriangleOf(corners.B)] >= 0;
    return int(hasA) + int(hasB);
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t e) const
  {
    return this->Mesh.States[e] == EdgeState::Fixed && this->CountKept(e) > 0 ? 1 : 0;
  }
};

/// A triangle with the cotangent of its smallest angle.
struct GradedTriangle
{
  double Cotangent;
  TriangleId Triangle;

  bool operator<(const GradedTriangle& other) const
  {
    const bool isSame = this->Cotangent == other.Cotangent;
    return isSame ? this->Triangle < other.Triangle : this->Cotangent > other.Cotangent;
  }
};

/// Whether a triangle does not reach the goals, as 1 or 0.
struct UnrefinedTest
{
  RefinementView View;

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t t) const
  {
    return this->View.FindShape(static_cast<TriangleId>(t)) >= ShapeKind::Bad ? 1 : 0;
  }
};

/// The arrays, owned.
template <typename Real, typename Backend>
class RefinementArrays
{
public:
  RefinementArrays(
    const GrowingMesh<Real>& grown, const RefinementPlan& plan, const Backend& backend)
    : Device(backend),
      Goals(plan.Goals),
      FirstVertex(grown.Vertices),
      FirstId(grown.FirstId),
      HasRegions(!plan.Regions.empty())
  {
    this->KeepOldMesh(grown);
    this->MakeTriangleArrays(grown, plan);
    this->FixBorders(grown);
    this->ListSegments(grown, plan.KeepsBoundary);
    this->MakeVertexArrays(grown, plan);
  }

  RefinementView View(const GrowingMesh<Real>& grown, std::int32_t* failed)
  {
    PlaneMesh plane = grown.View();
    plane.Failed = failed;
    return { plane, this->Goals, std::is_same<Real, float>::value, this->Smallest,
      this->Shapes.Data(), this->Regions.Data(), this->AreaOfRegion.Data(), this->Sizes.Data(),
      this->Segments.Data(), this->Marks.Data(), this->Origins.Data(), this->SegmentOfEdge.Data(),
      this->OriginOfVertex.Data(), this->Ends.Data(), this->IsSharp.Data() };
  }

  std::int64_t CountSegments() const { return this->NumberOfSegments; }
  std::uint64_t* GetClaims() { return this->Claims.Data(); }

  /// By vertex that the last round has added, a triangle that it has split.
  const TriangleId* GetSplits() const { return this->Splits.Data(); }

  /// Makes room for what a round adds.
  RefinementStore<Real> MakeRoom(
    GrowingMesh<Real>& grown, const RefinementNumbers& added, std::int32_t* failed)
  {
    const RefinementNumbers before = { grown.Vertices, grown.Mesh->NumberOfTriangles,
      grown.Mesh->NumberOfEdges, this->NumberOfSegments };
    const Backend& backend = this->Device;
    Reserve(*grown.Coordinates, 2 * before.Vertex, 2 * (before.Vertex + added.Vertex), backend);
    Reserve(*grown.Ids, before.Vertex, before.Vertex + added.Vertex, backend);
    Reserve(this->OriginOfVertex, before.Vertex, before.Vertex + added.Vertex, backend);
    Reserve(this->IsSharp, before.Vertex, before.Vertex + added.Vertex, backend);
    if (this->Sizes.Size() > 0)
    {
      Reserve(this->Sizes, before.Vertex, before.Vertex + added.Vertex, backend);
    }
    const std::int64_t vertices = before.Vertex - this->FirstVertex;
    Reserve(this->AddedVertices, vertices, vertices + added.Vertex, backend);
    Reserve(this->OldTriangleOf, vertices, vertices + added.Vertex, backend);
    Reserve(this->Shapes, before.Triangle, before.Triangle + added.Triangle, backend);
    Reserve(this->Regions, before.Triangle, before.Triangle + added.Triangle, backend);
    Reserve(this->Claims, before.Triangle, before.Triangle + added.Triangle, backend);
    Reserve(this->SegmentOfEdge, before.Edge, before.Edge + added.Edge, backend);
    Reserve(this->Segments, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Marks, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Origins, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Splits, 0, added.Vertex, backend);
    PlaneMesh old = grown.View();
    old.Edges = { this->OldTriangles.Data(), this->OldCorners.Data(), nullptr };
    old.Failed = failed;
    return { TriangleSplitter(grown.Mesh->View()), before, grown.Coordinates->Data(),
      grown.Ids->Data(), this->FirstId, this->FirstVertex, this->Shapes.Data(),
      this->Regions.Data(), this->Sizes.Data(), this->Claims.Data(), this->Segments.Data(),
      this->Marks.Data(), this->Origins.Data(), this->SegmentOfEdge.Data(),
      this->OriginOfVertex.Data(), this->Ends.Data(), this->IsSharp.Data(), this->Splits.Data(),
      this->AddedVertices.Data(), this->OldTriangleOf.Data(), old, this->Grid.View() };
  }

  /// Notes what a round has added.
  void Added(GrowingMesh<Real>& grown, std::int64_t vertices, std::int64_t subsegments)
  {
    grown.Vertices += vertices;
    this->NumberOfSegments += subsegments;
  }

  RefinementResult Fetch(const GrowingMesh<Real>& grown)
  {
    RefinementResult result;
    const std::int64_t added = grown.Vertices - this->FirstVertex;
    result.Vertices.resize(added);
    const Array<RefinedVertex> vertices = this->NameVertices(grown);
    this->Device.Download(vertices.Data(), added, result.Vertices.data());
    if (this->HasRegions)
    {
      result.Regions.resize(grown.Mesh->NumberOfTriangles);
      this->Device.Download(
        this->Regions.Data(), grown.Mesh->NumberOfTriangles, result.Regions.data());
    }
    result.Segments.resize(this->NumberOfSegments);
    const Array<Subsegment> segments = this->NameSegments();
    this->Device.Download(segments.Data(), this->NumberOfSegments, result.Segments.data());
    this->FindUnrefined(grown, result);
    return result;
  }

  // Public for nvcc.

  void KeepOldMesh(const GrowingMesh<Real>& grown)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    const std::int64_t halfEdges = 2 * grown.Mesh->NumberOfEdges;
    this->Grid = BuildPlaceGrid(grown.View(), triangles, this->Device);
    // Exact arithmetic on a device needs coordinates of similar magnitudes.
    constexpr double Share = 0x1p-60;
    this->Smallest = Share / this->Grid.Frame.GetScale();
    this->OldTriangles = this->Device.template MakeArray<TriangleRecord>(triangles);
    this->OldCorners = this->Device.template MakeArray<CornerId>(halfEdges);
    const EdgeMeshView mesh = grown.Mesh->View();
    TriangleRecord* oldTriangles = this->OldTriangles.Data();
    CornerId* oldCorners = this->OldCorners.Data();
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { oldTriangles[t] = mesh.Triangles[t]; });
    this->Device.ForEach(halfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { oldCorners[i] = mesh.CornerOfHalfEdge[i]; });
  }

  void MakeTriangleArrays(const GrowingMesh<Real>& grown, const RefinementPlan& plan)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    this->Shapes = this->Device.template MakeArray<std::uint32_t>(triangles);
    this->Regions = this->Device.template MakeArray<std::int32_t>(triangles);
    this->Claims = this->Device.template MakeArray<std::uint64_t>(triangles);
    std::uint32_t* shapes = this->Shapes.Data();
    std::int32_t* regions = this->Regions.Data();
    std::uint64_t* claims = this->Claims.Data();
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        shapes[t] = static_cast<std::uint32_t>(ShapeKind::Unknown);
        regions[t] = 0;
        claims[t] = RefinementKey::None;
      });
    if (this->HasRegions)
    {
      this->Device.Upload(plan.Regions.data(), triangles, regions);
    }
    const auto areas = static_cast<std::int64_t>(plan.AreaOfRegion.size());
    if (areas > 0)
    {
      this->AreaOfRegion = this->Device.template MakeArray<double>(areas);
      this->Device.Upload(plan.AreaOfRegion.data(), areas, this->AreaOfRegion.Data());
    }
  }

  /// Edges between triangles that are kept and others stay.
  void FixBorders(const GrowingMesh<Real>& grown)
  {
    const EdgeMeshView mesh = grown.Mesh->View();
    const std::int32_t* regions = this->Regions.Data();
    this->Device.ForEach(this->HasRegions ? grown.Mesh->NumberOfEdges : 0,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
      {
        const CornerPair corners = mesh.GetCorners(static_cast<EdgeId>(e));
        const bool isBorder = corners.A != NoCorner && corners.B != NoCorner &&
          (regions[TriangleOf(corners.A)] < 0) != (regions[TriangleOf(corners.B)] < 0);
        if (isBorder)
        {
          mesh.States[e] = EdgeState::Fixed;
        }
      });
  }

  void ListSegments(const GrowingMesh<Real>& grown, bool keepsBoundary)
  {
    const std::int64_t edges = grown.Mesh->NumberOfEdges;
    const PlaneMesh plane = grown.View();
    const SegmentTest isSegment{ plane.Edges, this->Regions.Data() };
    const typename Backend::Numbering numbering = this->Device.Count(edges, isSegment);
    this->NumberOfSegments = numbering.Total;
    this->Segments = this->Device.template MakeArray<EdgeId>(numbering.Total);
    this->Marks = this->Device.template MakeArray<std::uint8_t>(numbering.Total);
    this->Origins = this->Device.template MakeArray<std::uint32_t>(numbering.Total);
    this->SegmentOfEdge = this->Device.template MakeArray<std::uint32_t>(edges);
    this->Ends = this->Device.template MakeArray<VertexId>(2 * numbering.Total);
    std::uint8_t* marks = this->Marks.Data();
    std::uint32_t* origins = this->Origins.Data();
    std::uint32_t* segmentOfEdge = this->SegmentOfEdge.Data();
    EdgeId* segments = this->Segments.Data();
    VertexId* ends = this->Ends.Data();
    this->Device.ForEachNumbered(numbering, edges, isSegment,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t number)
      {
        if (isSegment(e) == 0)
        {
          return;
        }
        const bool isBoundary = isSegment.CountKept(e) == 1;
        marks[number] = keepsBoundary && isBoundary ? CannotSplit : 0;
        origins[number] = static_cast<std::uint32_t>(number);
        segmentOfEdge[e] = static_cast<std::uint32_t>(number);
        segments[number] = static_cast<EdgeId>(e);
        const CornerPair corners = plane.Edges.GetCorners(static_cast<EdgeId>(e));
        const auto side = static_cast<HalfEdgeId>(2 * e + (corners.A == NoCorner ? 1 : 0));
        ends[2 * number] = plane.GetStart(side);
        ends[2 * number + 1] = plane.GetEnd(side);
      });
  }

  void MakeVertexArrays(const GrowingMesh<Real>& grown, const RefinementPlan& plan)
  {
    const std::int64_t vertices = grown.Vertices;
    this->OriginOfVertex = this->Device.template MakeArray<std::uint32_t>(vertices);
    this->IsSharp = this->Device.template MakeArray<std::uint8_t>(vertices);
    std::uint32_t* origins = this->OriginOfVertex.Data();
    std::uint8_t* isSharp = this->IsSharp.Data();
    this->Device.ForEach(vertices,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        origins[i] = NoOrigin;
        isSharp[i] = 0;
      });
    const SharpCornerStep step{ grown.View(), this->Regions.Data(), isSharp };
    const EdgeId* segments = this->Segments.Data();
    this->Device.ForEach(2 * this->NumberOfSegments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { step(2 * segments[i / 2] + static_cast<HalfEdgeId>(i % 2)); });
    const auto points = static_cast<std::int64_t>(plan.Sizes.size());
    if (points > 0)
    {
      Array<double> byPoint = this->Device.template MakeArray<double>(points);
      this->Device.Upload(plan.Sizes.data(), points, byPoint.Data());
      this->Sizes = this->Device.template MakeArray<double>(vertices);
      const double* from = byPoint.Data();
      double* sizes = this->Sizes.Data();
      const VertexId* ids = grown.Ids->Data();
      this->Device.ForEach(
        vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { sizes[i] = from[ids[i]]; });
    }
  }

  /// The new vertices, with the points in place of the vertices between which they interpolate.
  Array<RefinedVertex> NameVertices(const GrowingMesh<Real>& grown) const
  {
    const std::int64_t added = grown.Vertices - this->FirstVertex;
    Array<RefinedVertex> named = this->Device.template MakeArray<RefinedVertex>(added);
    RefinedVertex* to = named.Data();
    const RefinedVertex* from = this->AddedVertices.Data();
    const VertexId* ids = grown.Ids->Data();
    this->Device.ForEach(added,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        to[i] = from[i];
        for (VertexId& point : to[i].Points)
        {
          point = ids[point];
        }
      });
    return named;
  }

  Array<Subsegment> NameSegments() const
  {
    Array<Subsegment> named = this->Device.template MakeArray<Subsegment>(this->NumberOfSegments);
    Subsegment* to = named.Data();
    const EdgeId* segments = this->Segments.Data();
    const std::uint32_t* origins = this->Origins.Data();
    this->Device.ForEach(this->NumberOfSegments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        to[i] = { segments[i], origins[i] };
      });
    return named;
  }

  /// Lists the triangles that are left, or that the limit has left.
  void FindUnrefined(const GrowingMesh<Real>& grown, RefinementResult& result)
  {
    const RefinementView view = this->View(grown, nullptr);
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    const UnrefinedTest isUnrefined{ view };
    const typename Backend::Numbering numbering = this->Device.Count(triangles, isUnrefined);
    result.Unrefined = numbering.Total;
    Array<GradedTriangle> left = this->Device.template MakeArray<GradedTriangle>(numbering.Total);
    GradedTriangle* to = left.Data();
    this->Device.ForEachNumbered(numbering, triangles, isUnrefined,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        if (isUnrefined(t) != 0)
        {
          const TriangleShape shape(view.Mesh, static_cast<TriangleId>(t));
          to[number] = { shape.Dot / shape.Cross, static_cast<TriangleId>(t) };
        }
      });
    std::vector<GradedTriangle> onHost(numbering.Total);
    this->Device.Download(left.Data(), numbering.Total, onHost.data());
    const std::size_t named = std::min<std::size_t>(onHost.size(), 3);
    std::partial_sort(
      onHost.begin(), onHost.begin() + static_cast<std::ptrdiff_t>(named), onHost.end());
    for (std::size_t i = 0; i < named; ++i)
    {
      result.FirstUnrefined.push_back(onHost[i].Triangle);
    }
  }

private:
  const Backend& Device;
  RefinementGoals Goals;
  double Smallest = 0.0; ///< See RefinementView.
  std::int64_t FirstVertex, FirstId;
  bool HasRegions;
  std::int64_t NumberOfSegments = 0;

  Array<std::uint32_t> Shapes; ///< See RefinementView for this one and the next.
  Array<std::int32_t> Regions;
  Array<double> AreaOfRegion, Sizes;
  Array<EdgeId> Segments;
  Array<std::uint8_t> Marks;
  Array<std::uint32_t> Origins, SegmentOfEdge, OriginOfVertex;
  Array<VertexId> Ends;
  Array<std::uint8_t> IsSharp;
  Array<std::uint64_t> Claims; ///< See RefinementStep.
  Array<TriangleId> Splits;
  Array<RefinedVertex> AddedVertices;
  Array<TriangleId> OldTriangleOf; ///< See RefinementStore.

  PlaceGrid Grid; ///< Of the mesh before.
  Array<TriangleRecord> OldTriangles;
  Array<CornerId> OldCorners;
};

}

#endif
