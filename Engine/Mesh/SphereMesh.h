// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREMESH_H
#define DELAUNAYFLIP_SPHEREMESH_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// The center of a sphere. Triangles are seen from there.
constexpr PlanePoint Origin{ 0.0, 0.0, 0.0 };

/// The vector of length 1 in the direction of another one. Gives NaN for the zero vector. Divides
/// by the largest coordinate first, so that nothing overflows.
DELAUNAYFLIP_HOST_DEVICE inline Vector3 FindDirection(const Vector3& a)
{
  const double largest = std::max(std::max(std::fabs(a.X), std::fabs(a.Y)), std::fabs(a.Z));
  const Vector3 near = { a.X / largest, a.Y / largest, a.Z / largest };
  const double length = Length(near);
  return { near.X / length, near.Y / length, near.Z / length };
}
DELAUNAYFLIP_HOST_DEVICE inline Vector3 FindDirection(const PlanePoint& p)
{
  return FindDirection(Vector3{ p.U, p.V, p.W });
}

/// Two vectors of length 1 across an axis. Together with it they are right-handed, so triangles
/// that are counter-clockwise from the end of the axis are so in the coordinates along both.
struct AcrossAxis
{
  /// @param axis of length 1.
  explicit AcrossAxis(const Vector3& axis)
  {
    const double x = std::fabs(axis.X), y = std::fabs(axis.Y), z = std::fabs(axis.Z);
    Vector3 across = { 0.0, 0.0, 1.0 }; // along the coordinate axis that is farthest away
    if (x <= y && x <= z)
    {
      across = { 1.0, 0.0, 0.0 };
    }
    else if (y <= z)
    {
      across = { 0.0, 1.0, 0.0 };
    }
    this->First = FindDirection(Cross(across, axis));
    this->Second = Cross(axis, this->First);
  }

  Vector3 First, Second;
};

/// A triangulation on a sphere around the origin. A place is a direction: a triangle has it if the
/// ray from the origin passes through the triangle to the outside.
struct SphereMesh
{
  const PlanePoint* Points;
  const std::int32_t* Triangles; ///< Three ids each, counter-clockwise from outside.
  const std::int32_t* Neighbors; ///< By corner, the triangle across the opposite edge, or -1.
  std::int64_t NumberOfTriangles;

  /// The index of a corner in Triangles and Neighbors.
  static std::int64_t GetIndex(CornerId corner)
  {
    return 3 * std::int64_t(TriangleOf(corner)) + SlotOf(corner);
  }
  static CornerId Next(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), NextSlot(SlotOf(corner)));
  }
  static CornerId Previous(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), PreviousSlot(SlotOf(corner)));
  }

  VertexId GetVertex(CornerId corner) const
  {
    return static_cast<VertexId>(this->Triangles[GetIndex(corner)]);
  }
  const PlanePoint& GetPointAt(CornerId corner) const
  {
    return this->Points[this->GetVertex(corner)];
  }

  /// The corner on the other side of the edge opposite a corner, or NoCorner.
  CornerId FindBeyond(CornerId corner) const
  {
    const std::int32_t across = this->Neighbors[GetIndex(corner)];
    if (across < 0)
    {
      return NoCorner;
    }
    // The edge runs the other way there.
    const VertexId from = this->GetVertex(Next(corner));
    CornerId beyond = MakeCorner(static_cast<TriangleId>(across), 0);
    while (this->GetVertex(Previous(beyond)) != from)
    {
      beyond = Next(beyond);
    }
    return beyond;
  }
  /// The next corner of the same vertex, counter-clockwise; or NoCorner.
  CornerId FindNextAround(CornerId corner) const
  {
    const CornerId beyond = this->FindBeyond(Next(corner));
    return beyond == NoCorner ? NoCorner : Next(beyond);
  }
  /// The corner before it, or NoCorner.
  CornerId FindPreviousAround(CornerId corner) const
  {
    const CornerId beyond = this->FindBeyond(Previous(corner));
    return beyond == NoCorner ? NoCorner : Previous(beyond);
  }

  /// On which side of the great circle of the edge opposite a corner a place is, exactly: 1 for
  /// that of the corner's triangle, 0 on it, -1 beyond.
  int FindSide(const PlanePoint& place, CornerId opposite) const
  {
    return FindOrientation3D(
      this->GetPointAt(Next(opposite)), this->GetPointAt(Previous(opposite)), place, Origin);
  }

  /// Whether a triangle can have places: it has an area, and it is counter-clockwise when seen from
  /// outside.
  bool FacesOutside(TriangleId triangle) const
  {
    const CornerId corner = MakeCorner(triangle, 0);
    return this->FindSide(this->GetPointAt(corner), corner) > 0;
  }
};

}

#endif
