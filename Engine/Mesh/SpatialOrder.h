// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPATIALORDER_H
#define DELAUNAYFLIP_SPATIALORDER_H

#include "Array.h"
#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "FlipOptions.h"
#include "MeshSurvey.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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
    if (count == 0)
    {
      return;
    }
    this->VertexOfRank = backend.template MakeArray<VertexId>(count);
    InvertPermutation(this->RankOfVertex.Data(), count, this->VertexOfRank.Data(), backend);
  }
};

//------------------------------------------------------------------------------
// Hilbert curves.

/// Moves bit i to bit Axes * i.
template <int Axes>
DELAUNAYFLIP_HOST_DEVICE std::uint32_t SpreadBits(std::uint32_t x)
{
  static_assert(Axes == 2 || Axes == 3, "bits move by 1 or 2 times 8, 4, 2 and 1");
  if constexpr (Axes == 2)
  {
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
  }
  else
  {
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
  }
}

/// Position along the Hilbert curve of a cell, each coordinate of `bits` bits (Skilling,
/// Programming the Hilbert curve, 2004), level after level.
template <int Axes>
DELAUNAYFLIP_HOST_DEVICE std::uint32_t HilbertIndex(std::uint32_t (&cell)[Axes], int bits)
{
  for (int level = bits - 1; level > 0; --level)
  {
    const std::uint32_t lower = (1u << level) - 1;
    for (std::uint32_t& x : cell)
    {
      // All ones where the bit of this level is set: invert the first axis, else exchange with it.
      const std::uint32_t invert = 0u - ((x >> level) & 1u);
      const std::uint32_t exchange = (cell[0] ^ x) & lower & ~invert;
      cell[0] ^= (lower & invert) | exchange;
      x ^= exchange;
    }
  }
  std::uint32_t index = 0;
  for (const std::uint32_t x : cell)
  {
    index = (index << 1) | SpreadBits<Axes>(x);
  }
  // Every bit becomes the parity of itself and all above it.
  for (int distance = 1; distance < 32; distance *= 2)
  {
    index ^= index >> distance;
  }
  return index;
}

/// How the plane's Hilbert curve is oriented from level to level, for all levels at once: bit i of
/// every word belongs to level i. An orientation has two bits: E, whether the axes are exchanged,
/// and I, whether both are inverted. Each level maps the orientation that it finds by an affine map
/// over the field of two elements:
///
///     E' = EE E + EI I + E0,  I' = IE E + II I + I0
struct HilbertOrientations
{
  std::uint32_t EE, EI, E0, IE, II, I0;

  /// Composes every level's map with that of the level `distance` above it, so that maps span twice
  /// the distance.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE HilbertOrientations Follow(int distance) const
  {
    // Levels above the first leave the orientation as it is.
    const std::uint32_t ee = ~(~this->EE >> distance), ii = ~(~this->II >> distance);
    const std::uint32_t ei = this->EI >> distance, ie = this->IE >> distance;
    const std::uint32_t e0 = this->E0 >> distance, i0 = this->I0 >> distance;
    return { (this->EE & ee) ^ (this->EI & ie), (this->EE & ei) ^ (this->EI & ii),
      (this->EE & e0) ^ (this->EI & i0) ^ this->E0, (this->IE & ee) ^ (this->II & ie),
      (this->IE & ei) ^ (this->II & ii), (this->IE & e0) ^ (this->II & i0) ^ this->I0 };
  }
};

/// The index in the plane. It doubles the distance over which orientations are known, which takes a
/// third of the time.
/// @param u, v of at most 16 bits.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t HilbertIndex(
  std::uint32_t u, std::uint32_t v, int bits)
{
  const std::uint32_t levels = (std::uint32_t(1) << bits) - 1;
  // A cell in the lower half of the second axis, once this is oriented, exchanges the axes; in the
  // upper half of the first, too, it also inverts both.
  const std::uint32_t differ = u ^ v;
  HilbertOrientations all{ ~differ, levels, ~v & levels, differ, ~differ, differ & ~v };
  for (int distance = 1; distance < bits; distance *= 2)
  {
    all = all.Follow(distance);
  }
  const std::uint32_t exchanged = all.E0 >> 1;
  const std::uint32_t inverted = all.I0 >> 1;
  const std::uint32_t orientedU = u ^ inverted ^ (exchanged & differ);
  return (SpreadBits<2>(orientedU) << 1) | SpreadBits<2>(differ);
}

/// The cell, of 2^bits, of a coordinate in [lower, lower + width]; 0 if it is not in it or NaN.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t CellOf(double x, double lower, double width, int bits)
{
  const double cells = static_cast<double>(1u << bits);
  const double position = (x - lower) / width * cells;
  if (width > 0.0 && position > 0.0)
  {
    return static_cast<std::uint32_t>(std::min(position, cells - 1.0));
  }
  return 0;
}

//------------------------------------------------------------------------------

/// How keys are computed.
struct OrderingFrame
{
  BoundingBox Box;
  GeometryKind Geometry;
  PlaneProjection Projection;

  /// Cell of a point along an axis. All numbers are halved, so that a box as wide as the range of
  /// double does not overflow.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetCell(
    const PointArray& points, std::int64_t point, int axis, int bits) const
  {
    return CellOf(0.5 * points.Get(point, axis), 0.5 * this->Box.Lower[axis],
      0.5 * this->Box.Upper[axis] - 0.5 * this->Box.Lower[axis], bits);
  }

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetKey(const PointArray& points, std::int64_t i) const
  {
    if (this->Geometry == GeometryKind::Surface || this->Geometry == GeometryKind::Sphere)
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
/// planar geometry, 128^3 on surfaces and spheres) and the triangles by the rank of their first
/// vertex. So the triangles of a star are together: iterations within chunks then do 51 instead of
/// 43 of 100 flips of the random bad mesh of 5 M points (Documentation/notebook/performance.md).
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

//------------------------------------------------------------------------------
// The coordinates that rules read, in the engine's order of vertices and in the caller's
// precision.

/// Plain pointers to PackedPoints, for functions of both backends.
struct PackedPointsView : CoordinateArray
{
  int Components;

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE double Get(
    VertexId vertex, int component) const
  {
    return this->GetNumber(std::int64_t(this->Components) * vertex + component);
  }
  DELAUNAYFLIP_HOST_DEVICE const void* Address(VertexId vertex) const
  {
    return this->GetAddress(std::int64_t(this->Components) * vertex);
  }
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE PlanePoint GetPlanePoint(
    VertexId vertex) const
  {
    return { this->Get(vertex, 0), this->Get(vertex, 1), 0.0 };
  }
  /// All points, if they have three components.
  PointArray GetPoints() const
  {
    if (this->Floats)
    {
      return { this->Floats, this->Count };
    }
    return { this->Doubles, this->Count };
  }
  /// In the plane z is 0.
  DELAUNAYFLIP_HOST_DEVICE Vector3 GetPosition(VertexId vertex) const
  {
    return { this->Get(vertex, 0), this->Get(vertex, 1),
      this->Components == 3 ? this->Get(vertex, 2) : 0.0 };
  }
};

/// Components numbers per vertex: (u, v) in the plane, (u, v, w) in a tilted one, (x, y, z) on
/// surfaces.
struct PackedPoints
{
  int Components = 2;
  std::int64_t Count = 0;
  Array<float> Floats;
  Array<double> Doubles;

  bool IsFloat() const { return this->Floats.Size() > 0; }

  void Take(Array<float> values) { this->Floats = std::move(values); }
  void Take(Array<double> values) { this->Doubles = std::move(values); }

  PackedPointsView View() const
  {
    if (this->IsFloat())
    {
      return { CoordinateArray(this->Floats.Data(), this->Count), this->Components };
    }
    return { CoordinateArray(this->Doubles.Data(), this->Count), this->Components };
  }
};

/// Which coordinates to pack.
struct PackingPlan
{
  int Axes[3];
  int Components;
  bool AsFloat;
  bool Flat; ///< The third component is 0.
  bool MarksNonFinite; ///< A point gets NaN if a coordinate that is not packed is not finite.

  DELAUNAYFLIP_HOST_DEVICE double GetValue(
    const PointArray& points, std::int64_t point, int component) const
  {
    if (this->MarksNonFinite && !IsFinitePoint(points, point, GeometryKind::Planar))
    {
      return NAN;
    }
    if (this->Flat && component == 2)
    {
      return 0.0;
    }
    return points.Get(point, this->Axes[component]);
  }
};

/// The coordinates by which a mesh is judged. For terrain judged by angles, those of the
/// projection.
/// @param asFloat whether the caller's coordinates are of type float.
inline PackingPlan PlanPacking(const MeshSurvey& survey, CriterionKind criterion, bool asFloat)
{
  if (survey.Geometry == GeometryKind::Surface || survey.Geometry == GeometryKind::Sphere)
  {
    return { { 0, 1, 2 }, 3, asFloat, false, false };
  }
  const PlaneProjection& plane = survey.Projection;
  const bool byAngles = criterion == CriterionKind::OppositeAngles;
  const int components = 2 + int(byAngles || plane.Tilted);
  return { { plane.AxisU, plane.AxisV, plane.AxisW }, components, asFloat && components == 2,
    byAngles && survey.Geometry == GeometryKind::PlanarXY,
    survey.Geometry == GeometryKind::Planar && survey.NonFinitePoints.Count > 0 };
}

/// Packs the point of a rank.
template <typename Real>
struct PackStep
{
  PointArray Points;
  SpatialOrderView Order;
  PackingPlan Plan;
  Real* Packed;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t rank) const
  {
    this->Points.Prefetch(this->Order.GetVertex(rank));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t rank) const
  {
    const VertexId point = this->Order.GetVertex(rank);
    for (int k = 0; k < this->Plan.Components; ++k)
    {
      this->Packed[this->Plan.Components * rank + k] =
        static_cast<Real>(this->Plan.GetValue(this->Points, point, k));
    }
  }
};

/// Packs all points, including unused and non-finite ones, which no rule reads.
template <typename Backend>
PackedPoints PackPoints(const PointArray& points, const SpatialOrderView& order,
  const PackingPlan& plan, const Backend& backend)
{
  PackedPoints packed;
  packed.Components = plan.Components;
  packed.Count = points.Count;
  const auto pack = [&](auto& array)
  {
    using Real = std::decay_t<decltype(array[0])>;
    array = backend.template MakeArray<Real>(plan.Components * points.Count);
    backend.ForEach(points.Count, PackStep<Real>{ points, order, plan, array.Data() });
  };
  if (plan.AsFloat)
  {
    pack(packed.Floats);
  }
  else
  {
    pack(packed.Doubles);
  }
  return packed;
}

}

#endif
