// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHEREFRAME_H
#define DELAUNAYFLIP_SPHEREFRAME_H

#include "PlaceFrame.h"
#include "SphereMesh.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

/// How a sphere is drawn on the plane that touches it at a place.
enum class TangentKind
{
  /// Along the axis of the place. The triangle of the place and two points is as large as the
  /// volume that both and the place span with the origin, so weights by areas are those by volumes:
  /// spherical barycentric coordinates.
  Orthographic,
  /// From the place's antipode, which keeps circles as circles. So natural neighbours are the same
  /// as on the sphere, and the cells are those of the plane. A circumcircle of a triangle that can
  /// have places is smaller than half of the sphere. If the place is inside of it, the antipode is
  /// not, and the triangle is finite and counter-clockwise in the plane.
  Stereographic
};

/// A triangulation on a sphere and, by vertex, the directions of its points.
struct DirectedMesh
{
  SphereMesh Mesh;
  const Vector3* Directions;
};

/// A triangulation on a sphere as seen from a place, in the plane that touches the sphere there. It
/// has the functions of PlaceFrame. Points and the place count by their directions.
class SphereFrame
{
public:
  /// @param mesh has no triangles behind segments, as seen from the place.
  /// @param place its direction. @param triangle has the place.
  DELAUNAYFLIP_HOST_DEVICE SphereFrame(
    const DirectedMesh& mesh, const Vector3& place, TriangleId triangle, TangentKind tangent)
    : Mesh(mesh.Mesh),
      Directions(mesh.Directions),
      Axis(place),
      Across(place),
      Tangent(tangent)
  {
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const ScaledPoint point = this->GetPoint(this->GetVertex(MakeCorner(triangle, slot)));
      largest = std::max(largest, std::max(std::fabs(point.U), std::fabs(point.V)));
    }
    this->Scale = InvertPowerOfTwo(largest);
  }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPlace() const { return { 0.0, 0.0 }; }

  /// The difference from the place is computed first, so that points near it keep their precision.
  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(VertexId vertex) const
  {
    const Vector3 offset = this->Directions[vertex] - this->Axis;
    double factor = this->Scale;
    if (this->Tangent == TangentKind::Stereographic)
    {
      factor /= 1.0 - 0.25 * Dot(offset, offset);
    }
    return { factor * Dot(offset, this->Across.First), factor * Dot(offset, this->Across.Second) };
  }

  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(CornerId corner) const
  {
    return this->Mesh.GetVertex(corner);
  }
  DELAUNAYFLIP_HOST_DEVICE CornerId FindBeyond(CornerId corner) const
  {
    return this->Mesh.FindBeyond(corner);
  }

  /// Whether the place is in the circumcircle of the triangle of a corner, up to rounding. That is
  /// the same for all corners of the triangle, so the triangles with such circles have a boundary.
  DELAUNAYFLIP_HOST_DEVICE bool IsInCircle(CornerId corner) const
  {
    PlanePoint points[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      const ScaledPoint scaled =
        this->GetPoint(this->GetVertex(MakeCorner(TriangleOf(corner), slot)));
      points[slot] = { scaled.U, scaled.V, 0.0 };
    }
    return InCircleDeterminant(points[0], points[1], points[2], { 0.0, 0.0, 0.0 }).Value > 0.0;
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsInFilterRange() const { return true; }

private:
  const SphereMesh& Mesh;
  const Vector3* const Directions;
  const Vector3 Axis;
  const AcrossAxis Across;
  const TangentKind Tangent;
  double Scale = 1.0;
};

}

#endif
