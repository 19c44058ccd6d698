// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREMESH_H
#define DELAUNAYFLIP_SPHEREMESH_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "SineAndCosine.h"

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

/// Finds the sine and the cosine of an angle in degrees. They are exact at multiples of 90, because
/// the angle is first reduced by such multiples, without rounding: fmod and floor are exact.
DELAUNAYFLIP_HOST_DEVICE inline void TurnByDegrees(double degrees, double& sine, double& cosine)
{
  constexpr double RadiansPerDegree = 3.14159265358979323846 / 180.0;
  const double turned = std::fmod(degrees, 360.0);
  const double quarters = std::floor(turned / 90.0 + 0.5);
  double first = 0.0, second = 0.0;
  FindSineAndCosine((turned - 90.0 * quarters) * RadiansPerDegree, first, second);
  switch (static_cast<int>(quarters) & 3)
  {
    case 0:
      sine = first;
      cosine = second;
      break;
    case 1:
      sine = second;
      cosine = -first;
      break;
    case 2:
      sine = -first;
      cosine = -second;
      break;
    default:
      sine = -second;
      cosine = first;
  }
}

/// PlaceOnSphere (PointTriangulation.h), on both backends.
DELAUNAYFLIP_HOST_DEVICE inline PlanePoint FindPlaceOnSphere(double longitude, double latitude)
{
  double sine = 0.0, cosine = 0.0, ofEast = 0.0, toPole = 0.0;
  TurnByDegrees(longitude, sine, cosine);
  TurnByDegrees(latitude, toPole, ofEast);
  return { ofEast * cosine + 0.0, ofEast * sine + 0.0, toPole + 0.0 }; // never -0.0
}

/// Two vectors of length 1 across an axis. Together with it they are right-handed, so triangles
/// that are counter-clockwise from the end of the axis are so in the coordinates along both.
struct AcrossAxis
{
  /// @param axis of length 1.
  DELAUNAYFLIP_HOST_DEVICE explicit AcrossAxis(const Vector3& axis)
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
  DELAUNAYFLIP_HOST_DEVICE static std::int64_t GetIndex(CornerId corner)
  {
    return 3 * std::int64_t(TriangleOf(corner)) + SlotOf(corner);
  }
  DELAUNAYFLIP_HOST_DEVICE static CornerId Next(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), NextSlot(SlotOf(corner)));
  }
  DELAUNAYFLIP_HOST_DEVICE static CornerId Previous(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), PreviousSlot(SlotOf(corner)));
  }

  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(CornerId corner) const
  {
    return static_cast<VertexId>(this->Triangles[GetIndex(corner)]);
  }
  DELAUNAYFLIP_HOST_DEVICE const PlanePoint& GetPointAt(CornerId corner) const
  {
    return this->Points[this->GetVertex(corner)];
  }

  /// The corner on the other side of the edge opposite a corner, or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindBeyond(CornerId corner) const
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
  DELAUNAYFLIP_HOST_DEVICE CornerId FindNextAround(CornerId corner) const
  {
    const CornerId beyond = this->FindBeyond(Next(corner));
    return beyond == NoCorner ? NoCorner : Next(beyond);
  }
  /// The corner before it, or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindPreviousAround(CornerId corner) const
  {
    const CornerId beyond = this->FindBeyond(Previous(corner));
    return beyond == NoCorner ? NoCorner : Previous(beyond);
  }

  /// On which side of the great circle of the edge opposite a corner a place is, exactly: 1 for
  /// that of the corner's triangle, 0 on it, -1 beyond. A device may return UncertainSign.
  DELAUNAYFLIP_HOST_DEVICE int FindSide(const PlanePoint& place, CornerId opposite) const
  {
    const PlanePoint origin{ 0.0, 0.0, 0.0 }; // a device has no constants of the host
    return FindOrientation3D(
      this->GetPointAt(Next(opposite)), this->GetPointAt(Previous(opposite)), place, origin);
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
