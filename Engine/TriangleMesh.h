// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLEMESH_H
#define DELAUNAYFLIP_TRIANGLEMESH_H

#include "HostDevice.h"

#include <cstdint>

/// @file
/// A TriangleMesh is the input of the engine. It consists of views of arrays that belong to the
/// caller. Nothing here owns or copies.
///
///     const float xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int64_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     const std::int64_t stays[] = { 0, 2 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     mesh.ConstraintEdges = stays;
///     mesh.NumberOfConstraintEdges = 1;
///     FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, 2)).TotalFlips; // 0

namespace delaunayflip
{

/// Numbers of type float or double, for `Count` points.
struct CoordinateArray
{
  CoordinateArray() = default;
  CoordinateArray(const float* values, std::int64_t count)
    : Floats(values),
      Count(count)
  {
  }
  CoordinateArray(const double* values, std::int64_t count)
    : Doubles(values),
      Count(count)
  {
  }

  /// Number i of the array, of whichever type.
  DELAUNAYFLIP_HOST_DEVICE double GetNumber(std::int64_t i) const
  {
    return this->Floats ? static_cast<double>(this->Floats[i]) : this->Doubles[i];
  }
  /// Its address.
  DELAUNAYFLIP_HOST_DEVICE const void* GetAddress(std::int64_t i) const
  {
    return this->Floats ? static_cast<const void*>(this->Floats + i) : this->Doubles + i;
  }
  /// The array; null if there is none.
  const void* Data() const { return this->GetAddress(0); }

  const float* Floats = nullptr;
  const double* Doubles = nullptr; ///< If Floats is null.
  std::int64_t Count = 0;
};

/// Coordinates of points: x, y, z interleaved, 3 * Count numbers.
struct PointArray : CoordinateArray
{
  using CoordinateArray::CoordinateArray;

  /// Coordinate `axis` (0, 1, 2) of point `point` (0 .. Count - 1).
  DELAUNAYFLIP_HOST_DEVICE double Get(std::int64_t point, int axis) const
  {
    return this->GetNumber(3 * point + axis);
  }

  /// Prefetches the coordinates of a point.
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t point) const
  {
    delaunayflip::Prefetch(this->GetAddress(3 * point));
  }
};

/// Points in the plane: x and y are the first two of `Stride` numbers per point.
struct PlaneArray : CoordinateArray
{
  PlaneArray() = default;
  /// @param values floats or doubles.
  template <typename Real>
  PlaneArray(const Real* values, std::int64_t count, std::int64_t stride)
    : CoordinateArray(values, count),
      Stride(stride)
  {
  }

  std::int64_t Stride = 2;

  /// A coordinate, 0 (x) or 1 (y). -0.0 becomes 0.0, so that equal places have equal bits.
  DELAUNAYFLIP_HOST_DEVICE double Get(std::int64_t point, int axis) const
  {
    return this->GetNumber(this->Stride * point + axis) + 0.0;
  }
};

/// Vertex ids of triangles: three per triangle, interleaved, 3 * Count integers of 32 or 64 bits.
/// `Id32` and `Id64` are const types for an input, non-const for an output.
template <typename Id32, typename Id64>
struct BasicTriangleArray
{
  BasicTriangleArray() = default;
  BasicTriangleArray(Id32* ids, std::int64_t count)
    : Ids32(ids),
      Count(count)
  {
  }
  BasicTriangleArray(Id64* ids, std::int64_t count)
    : Ids64(ids),
      Count(count)
  {
  }

  /// Vertex id at `slot` (0, 1, 2) of `triangle` (0 .. Count - 1).
  DELAUNAYFLIP_HOST_DEVICE std::int64_t Get(std::int64_t triangle, int slot) const
  {
    const std::int64_t i = 3 * triangle + slot;
    return this->Ids32 ? static_cast<std::int64_t>(this->Ids32[i])
                       : static_cast<std::int64_t>(this->Ids64[i]);
  }

  /// Whether the three ids of a triangle differ. If not, it has no edges: it stays as it is, and
  /// other triangles are paired as if it were not there.
  DELAUNAYFLIP_HOST_DEVICE bool HasEdges(std::int64_t triangle) const
  {
    const std::int64_t a = this->Get(triangle, 0), b = this->Get(triangle, 1);
    const std::int64_t c = this->Get(triangle, 2);
    return a != b && b != c && c != a;
  }

  /// Prefetches the ids of a triangle.
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t triangle) const
  {
    delaunayflip::Prefetch(this->Ids32 ? static_cast<const void*>(this->Ids32 + 3 * triangle)
                                       : this->Ids64 + 3 * triangle);
  }

  DELAUNAYFLIP_HOST_DEVICE void Set(std::int64_t triangle, int slot, std::int64_t vertex) const
  {
    const std::int64_t i = 3 * triangle + slot;
    if (this->Ids32)
    {
      this->Ids32[i] = static_cast<Id32>(vertex);
    }
    else
    {
      this->Ids64[i] = static_cast<Id64>(vertex);
    }
  }

  /// The array, of whichever type; null if there is none.
  const void* Data() const
  {
    return this->Ids32 ? static_cast<const void*>(this->Ids32) : this->Ids64;
  }

  Id32* Ids32 = nullptr;
  Id64* Ids64 = nullptr;
  std::int64_t Count = 0;
};

using TriangleArray = BasicTriangleArray<const std::int32_t, const std::int64_t>;
using MutableTriangleArray = BasicTriangleArray<std::int32_t, std::int64_t>;

/// A place that labels the part of the mesh around it. Parts end at segments and at edges that
/// never flip.
struct RegionSeed
{
  double X = 0.0, Y = 0.0;
  std::int32_t Label = 0; ///< The label of all triangles of the part.
  double MaximumArea = 0.0; ///< The largest area of a triangle there; 0: no limit of its own.
};

/// What the caller knows about the edges of a mesh: which of them are fixed, i.e. never flip.
struct FixedEdges
{
  /// Edges that must stay: NumberOfConstraintEdges pairs of vertex ids, in any order and direction,
  /// or null.
  const std::int64_t* ConstraintEdges = nullptr;
  std::int64_t NumberOfConstraintEdges = 0;

  /// One flag per constraint edge, or null. In planar geometry, constraint edges with a non-zero
  /// flag that are not edges of the mesh are inserted before the first iteration: flips turn each
  /// into an edge, or into a chain of edges if it passes through vertices. Constraint edges that
  /// are edges already are fixed first; the others follow in their order. One that would cross an
  /// edge that stays, or leave the mesh, is not inserted.
  const unsigned char* ConstraintsToInsert = nullptr;

  /// One label per triangle, or null. Edges between triangles with different labels stay.
  const std::int32_t* Regions = nullptr;

  /// One flag per triangle, or null. The edges of triangles with a non-zero flag stay.
  const unsigned char* FrozenTriangles = nullptr;

  /// For refinement: the longest edge that triangles may have near each point, or null: no limit.
  /// Between points it is interpolated linearly. NaN: no limit near that point.
  const double* Sizes = nullptr;

  /// Places in x and y that label parts of the mesh (FlipSession::StoreRegions), and may limit the
  /// areas of triangles there; or null. Parts end at edges that never flip. If several places are
  /// in one part, the first one counts.
  const RegionSeed* RegionSeeds = nullptr;
  std::int64_t NumberOfRegionSeeds = 0;
};

/// A mesh that is a piece of a larger one has this information about the larger one (PieceFlip.h).
struct WholeMesh
{
  /// The plane of the larger mesh, for GeometryKind::Planar: the axis, 0 to 2, to which its normal
  /// is closest, and whether this coordinate varies. -1: the plane is found from the points.
  int PlaneAxis = -1;
  bool PlaneIsTilted = false;

  /// In planar geometry: whether all triangles have the same strict orientation, and those around
  /// every point cover no direction twice. Then flips cannot make an edge that exists.
  bool StarsAreSimple = false;

  /// In planar geometry: the orientation of most triangles of the larger mesh, 1
  /// (counter-clockwise) or -1. 0: that of most triangles of this mesh.
  int Side = 0;

  /// One set of bits per point, or null. Each bit stands for a part of the larger mesh outside of
  /// this piece, where the point may have edges. A flip that would join two points with a common
  /// bit is blocked, as by an edge that exists.
  const unsigned char* SharedPoints = nullptr;
};

/// A triangle mesh, and what the caller knows about its edges. Any mesh is accepted: non-manifold,
/// open, with mixed winding, with duplicate, degenerate or unused parts.
struct TriangleMesh : FixedEdges
{
  PointArray Points;
  TriangleArray Triangles;
  /// For GeometryKind::Sphere: the place from which triangles are seen, inside of the mesh.
  double Center[3] = { 0.0, 0.0, 0.0 };
  WholeMesh Whole; ///< Only for pieces of a larger mesh.
};

}

#endif
