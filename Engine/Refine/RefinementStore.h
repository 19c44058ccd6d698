// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTSTORE_H
#define DELAUNAYFLIP_REFINEMENTSTORE_H

#include "Array.h"
#include "PlaceGrid.h"
#include "PlaceOffsets.h"
#include "RefinementItem.h"
#include "RefinementPlan.h"
#include "RefinementStep.h"
#include "RefinementView.h"
#include "TriangleSplit.h"

#include <cmath>
#include <cstdint>

/// @file
/// How a place is inserted into a mesh that grows: what it splits, between which points the new
/// vertex is interpolated, and which edges become subsegments.

namespace delaunayflip
{

/// A mesh with arrays that become larger.
template <typename Real>
struct GrowingMesh
{
  EdgeMesh* Mesh;
  Array<Real>* Coordinates; ///< x and y by vertex.
  Array<VertexId>* Ids; ///< By vertex, the number of its point.
  std::int64_t Vertices; ///< The number of vertices.
  std::int64_t FirstId; ///< The id of the first point that refinement adds.
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

/// Numbers of vertices, triangles, edges and subsegments.
struct RefinementNumbers
{
  std::int64_t Vertex, Triangle, Edge, Subsegment;
};

/// Finds between which points of the mesh before refinement a new vertex is interpolated.
struct VertexInterpolation
{
  PlaneMesh Old;
  const VertexId* Ends; ///< See RefinementView.

  /// Interpolates linearly along the segment that the vertex splits, or else in the triangle that
  /// it was in before refinement.
  DELAUNAYFLIP_HOST_DEVICE RefinedVertex Find(
    const PlanePoint& place, std::uint32_t origin, TriangleId triangle) const
  {
    RefinedVertex vertex{ place.U, place.V, origin, { 0, 0, 0 }, { 1.0, 0.0, 0.0 } };
    if (origin != NoOrigin)
    {
      const VertexId* ends = this->Ends + 2 * std::size_t(origin);
      const PlanePoint from = this->Old.GetPoint(ends[0]), to = this->Old.GetPoint(ends[1]);
      const double scale = InvertPowerOfTwo(FindLargestHalf(from, to));
      const double length = FindScaledLength(from, to, scale);
      vertex.Weights[1] = FindScaledLength(from, place, scale) / length;
      vertex.Weights[0] = 1.0 - vertex.Weights[1];
      vertex.Points[0] = ends[0];
      vertex.Points[1] = ends[1];
      vertex.Points[2] = ends[0];
      return vertex;
    }
    const VertexId* vertices = this->Old.Edges.Triangles[triangle].Vertices;
    PlaceOffset seen[3]; // from the place, halved so that no difference overflows
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint point = this->Old.GetPoint(vertices[slot]);
      seen[slot] = FindHalf(place, point);
      const double half = FindLargestHalf(place, point);
      largest = half > largest ? half : largest;
    }
    const double scale = InvertPowerOfTwo(largest);
    double sum = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlaceOffset &a = seen[NextSlot(slot)], &b = seen[PreviousSlot(slot)];
      const double area = (a.U * scale) * (b.V * scale) - (a.V * scale) * (b.U * scale);
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

private:
  /// Half of the vector from a place to another one.
  DELAUNAYFLIP_HOST_DEVICE static PlaceOffset FindHalf(const PlanePoint& from, const PlanePoint& to)
  {
    return { 0.5 * to.U - 0.5 * from.U, 0.5 * to.V - 0.5 * from.V };
  }
  /// Its largest component. Its inverse, as a power of two, scales vectors so that their products
  /// neither overflow nor underflow, with the same ratios.
  DELAUNAYFLIP_HOST_DEVICE static double FindLargestHalf(
    const PlanePoint& from, const PlanePoint& to)
  {
    const PlaceOffset half = FindHalf(from, to);
    const double u = std::fabs(half.U), v = std::fabs(half.V);
    return u > v ? u : v;
  }
  DELAUNAYFLIP_HOST_DEVICE static double FindScaledLength(
    const PlanePoint& from, const PlanePoint& to, double scale)
  {
    const PlaceOffset half = FindHalf(from, to);
    const double u = half.U * scale, v = half.V * scale;
    return std::sqrt(u * u + v * v);
  }
};

/// Describes the vertices that refinement has added. Each names the points, not the vertices,
/// between which it is interpolated.
struct VertexNaming
{
  VertexInterpolation Interpolation;
  PlaneMesh Mesh; ///< After refinement.
  std::int64_t FirstVertex; ///< The first one that was added.
  const std::uint32_t* Origins; ///< By vertex.
  const TriangleId* OldTriangles; ///< By added vertex, see RefinementStore::OldTriangleOf.
  const VertexId* Ids; ///< By vertex.

  /// Prefetches what Name will read for this vertex, and for an earlier one.
  void Prefetch(std::int64_t i) const
  {
    constexpr std::int64_t Second = 16;
    const TriangleRecord* triangles = this->Interpolation.Old.Edges.Triangles;
    if (this->OldTriangles[i] != NoTriangle)
    {
      delaunayflip::Prefetch(&triangles[this->OldTriangles[i]]);
    }
    if (i < Second || this->OldTriangles[i - Second] == NoTriangle)
    {
      return;
    }
    for (const VertexId vertex : triangles[this->OldTriangles[i - Second]].Vertices)
    {
      this->Interpolation.Old.PrefetchPoint(vertex);
      delaunayflip::Prefetch(&this->Ids[vertex]);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE RefinedVertex Name(std::int64_t i) const
  {
    const auto vertex = static_cast<VertexId>(this->FirstVertex + i);
    RefinedVertex named = this->Interpolation.Find(
      this->Mesh.GetPoint(vertex), this->Origins[vertex], this->OldTriangles[i]);
    for (VertexId& point : named.Points)
    {
      point = this->Ids[point];
    }
    return named;
  }
};

/// Tells a visitor on threads of an added vertex.
struct VisitVertex
{
  const VertexNaming& Naming;
  const RefinedVertexVisitor& Visit;

  void Prefetch(std::int64_t i) const { this->Naming.Prefetch(i); }
  void operator()(std::int64_t i) const { this->Visit(i, this->Naming.Name(i)); }
};

/// Inserts the places of items, and stores the data of new vertices, triangles and edges.
template <typename Real>
struct RefinementStore
{
  TriangleSplitter Splitter;
  RefinementNumbers Before; ///< How many there were before the round.
  Real* Coordinates;
  VertexId* Ids;
  std::int64_t FirstId, FirstVertex; ///< Id and number of the first vertex of refinement.
  std::uint32_t* Shapes;
  std::int32_t* Regions; ///< See RefinementView.
  double* Sizes;
  double* Features; ///< See RefinementView.
  std::uint64_t* Claims;
  EdgeId* Segments;
  std::uint8_t* Marks;
  std::uint32_t* Origins;
  std::uint32_t* SegmentOfEdge;
  std::uint32_t* OriginOfVertex;
  const VertexId* Ends;
  std::uint8_t* IsSharp;
  TriangleId* Splits; ///< By vertex of the round, a triangle that it splits.
  /// By added vertex: its triangle in the old mesh, or NoTriangle if it is on a segment.
  TriangleId* OldTriangleOf;
  PlaneMesh Old; ///< The mesh before refinement.
  std::int64_t OldTriangles; ///< How many it has.
  PlaceGridView Grid;
  bool IsOfCaller; ///< Whether the mesh is the caller's. Then RefinementItem::Old is known.

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
    TriangleId& oldTriangle = this->OldTriangleOf[vertex - this->FirstVertex];
    oldTriangle = origin == NoOrigin ? this->FindOldTriangle(item) : NoTriangle;
    if (this->Sizes)
    {
      const VertexInterpolation interpolation{ this->Old, this->Ends };
      this->Sizes[vertex] =
        this->InterpolateSize(interpolation.Find(item.Place, origin, oldTriangle));
    }
    if (this->Features)
    {
      const TriangleRecord& split = this->Splitter.GetMesh().Triangles[item.Found.Triangle];
      this->Features[vertex] = FindLeastFeature(this->Features, split);
    }
    const NewVertex added{ vertex, item.Found, triangle, edge };
    if (item.CutsSliver)
    {
      this->Splitter.SplitBeside(added);
    }
    else
    {
      this->Splitter.Split(added);
    }
  }

  // Threads prefetch what Split will read, for a place in a triangle, in four stages; see
  // RefinementView.
  void PrefetchTriangle(TriangleId triangle) const
  {
    Prefetch(&this->Splitter.GetMesh().Triangles[triangle]);
    Prefetch(&this->Shapes[triangle]);
    if (this->Regions)
    {
      Prefetch(&this->Regions[triangle]);
    }
  }
  void PrefetchEdges(TriangleId triangle) const
  {
    const EdgeMeshView& mesh = this->Splitter.GetMesh();
    for (const HalfEdgeId side : mesh.Triangles[triangle].HalfEdges)
    {
      Prefetch(&mesh.CornerOfHalfEdge[side]);
      Prefetch(&mesh.States[EdgeOf(side)]);
    }
    const std::int64_t newest = this->FindNewest(triangle);
    if (newest >= 0)
    {
      Prefetch(&this->OldTriangleOf[newest]);
    }
  }
  void PrefetchOldTriangle(TriangleId triangle) const
  {
    const TriangleId old = this->FindStart(triangle);
    if (old != NoTriangle)
    {
      Prefetch(&this->Old.Edges.Triangles[old]);
    }
  }
  void PrefetchOldPoints(TriangleId triangle) const
  {
    const TriangleId old = this->FindStart(triangle);
    if (old != NoTriangle)
    {
      const TriangleRecord& record = this->Old.Edges.Triangles[old];
      for (int slot = 0; slot < 3; ++slot)
      {
        this->Old.PrefetchPoint(record.Vertices[slot]);
        Prefetch(&this->Old.Edges.CornerOfHalfEdge[record.HalfEdges[slot] ^ 1u]);
      }
    }
  }

private:
  /// The number of the newest corner of a triangle among the added vertices, or -1.
  DELAUNAYFLIP_HOST_DEVICE std::int64_t FindNewest(TriangleId triangle) const
  {
    std::int64_t newest = -1;
    for (const VertexId vertex : this->Splitter.GetMesh().Triangles[triangle].Vertices)
    {
      const std::int64_t number = std::int64_t(vertex) - this->FirstVertex;
      newest = number > newest ? number : newest;
    }
    return newest;
  }

  /// The triangle that had the newest corner of a triangle before refinement, or NoTriangle.
  TriangleId FindStart(TriangleId triangle) const
  {
    const std::int64_t newest = this->FindNewest(triangle);
    return newest >= 0 ? this->OldTriangleOf[newest] : NoTriangle;
  }

  /// Puts a new triangle into the region of the split one, and lets both be judged again.
  DELAUNAYFLIP_HOST_DEVICE void TakeOver(TriangleId from, TriangleId to) const
  {
    if (this->Regions)
    {
      this->Regions[to] = this->Regions[from];
    }
    this->Claims[to] = RefinementKey::None;
    this->Shapes[from] = static_cast<std::uint32_t>(ShapeKind::Unknown);
    this->Shapes[to] = static_cast<std::uint32_t>(ShapeKind::Unknown);
  }

  /// Finds the triangle that a place was in before refinement. The walk begins where the newest
  /// corner of the split triangle was.
  DELAUNAYFLIP_HOST_DEVICE TriangleId FindOldTriangle(const RefinementItem& item) const
  {
    if (this->IsOfCaller)
    {
      return item.Old;
    }
    const std::int64_t newest = this->FindNewest(item.Found.Triangle);
    if (newest < 0 && this->IsInOld(item.Found))
    {
      return item.Found.Triangle;
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

  /// Whether a place is inside of a triangle that has not changed since before refinement.
  DELAUNAYFLIP_HOST_DEVICE bool IsInOld(const FoundPlace& found) const
  {
    if (found.OnEdges != 0 || found.Triangle >= this->OldTriangles)
    {
      return false;
    }
    const VertexId* now = this->Splitter.GetMesh().Triangles[found.Triangle].Vertices;
    const VertexId* before = this->Old.Edges.Triangles[found.Triangle].Vertices;
    return now[0] == before[0] && now[1] == before[1] && now[2] == before[2];
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
/// degrees, and counts the sectors between segments there.
struct SharpCornerStep
{
  PlaneMesh Mesh;
  const std::int32_t* Regions;
  std::uint8_t* IsSharp;
  std::uint32_t* Sectors; ///< By vertex.

  /// @param side a half-edge of a segment; the angle at its start is judged.
  DELAUNAYFLIP_HOST_DEVICE void operator()(HalfEdgeId side) const
  {
    CornerId corner =
      this->Mesh.Edges.CornerOfHalfEdge[side]; // opposite the edge that was turned over
    if (corner == NoCorner || this->Regions[TriangleOf(corner)] < 0)
    {
      return;
    }
    const VertexId vertex = this->Mesh.GetStart(side);
    AtomicAdd(&this->Sectors[vertex], 1);
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
        AtomicStore(&this->IsSharp[vertex], std::uint8_t(SharpCorner));
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

}

#endif
