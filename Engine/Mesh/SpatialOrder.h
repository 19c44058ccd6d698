// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPATIALORDER_H
#define DELAUNAYFLIP_SPATIALORDER_H

#include "Array.h"
#include "EdgeMesh.h"
#include "HilbertCurve.h"
#include "MeshSurvey.h"
#include "TriangleMesh.h"

/// @file
/// The order in which the engine stores vertices and triangles: along a Hilbert curve, so that
/// neighbours in the mesh are neighbours in memory. The order is part of the algorithm on every
/// backend: edge ids, and so the choice among competing flips, depend on it.

namespace delaunayflip
{

/// Smaller meshes fit into a second-level cache in any order.
constexpr std::int64_t SmallestOrderedMesh = 1 << 14; // triangles

/// The number of bits of the keys by which vertices and triangles are sorted.
constexpr int SortKeyBits = 22;

/// Plain pointers to a SpatialOrder, for functions of both backends.
struct SpatialOrderView
{
  const VertexId* RankOfVertex;
  const VertexId* VertexOfRank;
  const TriangleId* TriangleOfRank;

  DELAUNAYFLIP_HOST_DEVICE VertexId GetRank(std::int64_t vertex) const
  {
    return this->RankOfVertex ? this->RankOfVertex[vertex] : static_cast<VertexId>(vertex);
  }
  /// Prefetches the rank of a vertex.
  DELAUNAYFLIP_HOST_DEVICE void PrefetchRank(std::int64_t vertex) const
  {
    if (this->RankOfVertex)
    {
      Prefetch(&this->RankOfVertex[vertex]);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(std::int64_t rank) const
  {
    return this->VertexOfRank ? this->VertexOfRank[rank] : static_cast<VertexId>(rank);
  }
  DELAUNAYFLIP_HOST_DEVICE TriangleId GetTriangle(std::int64_t rank) const
  {
    return this->TriangleOfRank ? this->TriangleOfRank[rank] : static_cast<TriangleId>(rank);
  }
};

/// inverse[permutation[i]] = i.
template <typename Backend>
void InvertPermutation(
  const VertexId* permutation, std::int64_t count, VertexId* inverse, const Backend& backend)
{
  backend.ForEach(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { inverse[permutation[i]] = static_cast<VertexId>(i); });
}

/// Permutations between the caller's ids and ranks; empty for meshes small enough for the caches,
/// which keep the caller's order.
struct SpatialOrder
{
  Array<VertexId> RankOfVertex;
  Array<VertexId> VertexOfRank;
  Array<TriangleId> TriangleOfRank;

  SpatialOrderView View() const
  {
    return { this->RankOfVertex.Data(), this->VertexOfRank.Data(), this->TriangleOfRank.Data() };
  }

  /// Frees VertexOfRank until RestoreVertices recomputes it from RankOfVertex.
  void DropVertices() { this->VertexOfRank = Array<VertexId>(); }

  template <typename Backend>
  void RestoreVertices(const Backend& backend)
  {
    const auto count = static_cast<std::int64_t>(this->RankOfVertex.Size());
    this->VertexOfRank =
      count > 0 ? backend.template MakeArray<VertexId>(count) : Array<VertexId>();
    InvertPermutation(this->RankOfVertex.Data(), count, this->VertexOfRank.Data(), backend);
  }
};

/// How keys are computed.
struct OrderingFrame
{
  BoundingBox Box;
  GeometryKind Geometry;
  PlaneProjection Projection;

  /// Cell of a point along an axis. Half of each number, so that a box as wide as the range of
  /// double does not overflow.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetCell(
    const PointArray& points, std::int64_t point, int axis, int bits) const
  {
    return CellOf(0.5 * points.Get(point, axis), 0.5 * this->Box.Lower[axis],
      0.5 * this->Box.Upper[axis] - 0.5 * this->Box.Lower[axis], bits);
  }

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetKey(const PointArray& points, std::int64_t i) const
  {
    if (this->Geometry == GeometryKind::Surface)
    {
      constexpr int Bits = SortKeyBits / 3;
      std::uint32_t cell[3] = { this->GetCell(points, i, 0, Bits),
        this->GetCell(points, i, 1, Bits), this->GetCell(points, i, 2, Bits) };
      return HilbertIndex(cell, Bits);
    }
    constexpr int Bits = SortKeyBits / 2;
    return HilbertIndex(this->GetCell(points, i, this->Projection.AxisU, Bits),
      this->GetCell(points, i, this->Projection.AxisV, Bits), Bits);
  }
};

/// The key of a triangle: the smallest rank of its vertices.
struct TriangleKey
{
  TriangleArray Triangles;
  const VertexId* RankOfVertex;
  std::int64_t NumberOfPoints;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      delaunayflip::Prefetch(&this->RankOfVertex[this->Triangles.Get(t, slot)]);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t operator()(std::int64_t t) const
  {
    std::uint64_t first = ~std::uint64_t(0);
    for (int slot = 0; slot < 3; ++slot)
    {
      first = std::min<std::uint64_t>(first, this->RankOfVertex[this->Triangles.Get(t, slot)]);
    }
    return static_cast<std::uint32_t>((first << SortKeyBits) / this->NumberOfPoints);
  }
};

/// Sorts the vertices by their cell of a Hilbert curve through the bounding box (2048^2 cells in
/// planar geometry, 128^3 on surfaces) and the triangles by the rank of their first vertex. So the
/// triangles of a star are together: iterations within chunks then do 51 instead of 43 of 100 flips
/// of the random bad mesh of 5 M points (Documentation/notebook/performance.md).
template <typename Backend>
SpatialOrder OrderMesh(const MeshInput& input, const MeshSurvey& survey, const Backend& backend)
{
  const TriangleArray triangles = input.Local.Triangles;
  const PointArray points = input.Local.Points;
  SpatialOrder order;
  if (triangles.Count < SmallestOrderedMesh)
  {
    return order;
  }
  const OrderingFrame frame{ survey.Box, survey.Geometry, survey.Projection };
  order.VertexOfRank = backend.template SortIndices<SortKeyBits>(
    points.Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return frame.GetKey(points, i); });
  order.RankOfVertex = backend.template MakeArray<VertexId>(points.Count);
  InvertPermutation(order.VertexOfRank.Data(), points.Count, order.RankOfVertex.Data(), backend);
  order.TriangleOfRank = backend.template SortIndices<SortKeyBits>(
    triangles.Count, TriangleKey{ triangles, order.RankOfVertex.Data(), points.Count });
  return order;
}

}

#endif
