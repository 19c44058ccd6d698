// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HIDDENEDGES_H
#define DELAUNAYFLIP_HIDDENEDGES_H

#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "HostDevice.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "WideAngles.h"

#include <cstdint>

/// @file
/// Edges that would be bad if defects of the mesh did not keep them. They are counted for hints
/// alone, so only clear cases are: by more than a thousandth of a radian.

namespace delaunayflip
{

struct HiddenSums
{
  std::int64_t WronglyWound = 0; ///< Edges that are wrongly wound, and else bad.
  /// Corners opposite to non-manifold edges with more than 90 degrees. A bad edge has such a
  /// corner. This is right before the first flip only: a flip does not move the roles of corners.
  std::int64_t ObtuseCorners = 0;

  DELAUNAYFLIP_HOST_DEVICE HiddenSums& operator+=(const HiddenSums& part)
  {
    this->WronglyWound += part.WronglyWound;
    this->ObtuseCorners += part.ObtuseCorners;
    return *this;
  }
};

/// Adds an edge.
struct HiddenEdgeSurvey
{
  EdgeMeshView Mesh;
  PackedPointsView Points;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t e, HiddenSums& sums) const
  {
    const CornerPair corners = this->Mesh.GetCorners(static_cast<EdgeId>(e));
    const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corners.A)];
    const int slot = SlotOf(corners.A);
    if (this->Mesh.States[e] != EdgeState::Fixed || !HasEdges(triangle))
    {
      return;
    }
    if (corners.B != NoCorner)
    {
      sums.WronglyWound += int(this->IsWronglyWoundAndBad(corners));
    }
    else if (GetRole(triangle, slot) == CornerRole::OneOfMany)
    {
      sums.ObtuseCorners += int(this->IsObtuse(triangle, slot));
    }
  }

private:
  static constexpr double Clear = 1e-3; ///< Radians.

  DELAUNAYFLIP_HOST_DEVICE bool IsObtuse(const TriangleRecord& triangle, int slot) const
  {
    const Vector3 at = this->Points.GetPosition(triangle.Vertices[slot]);
    const WideVector next =
      Subtract(this->Points.GetPosition(GetAt(triangle.Vertices, NextSlot(slot))), at);
    const WideVector last =
      Subtract(this->Points.GetPosition(GetAt(triangle.Vertices, PreviousSlot(slot))), at);
    return Dot(next.Vector, last.Vector) < -Clear * next.GetLength() * last.GetLength();
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsWronglyWoundAndBad(const CornerPair& corners) const
  {
    const Quad quad = this->Mesh.GetQuad(corners);
    const TriangleRecord& other = this->Mesh.Triangles[TriangleOf(corners.B)];
    if (GetAt(other.Vertices, NextSlot(SlotOf(corners.B))) == quad.Q || quad.A == quad.B)
    {
      return false;
    }
    const QuadPoints points = { this->Points.GetPosition(quad.A), this->Points.GetPosition(quad.P),
      this->Points.GetPosition(quad.Q), this->Points.GetPosition(quad.B) };
    const bool areFinite =
      IsFinite(points.A) && IsFinite(points.P) && IsFinite(points.Q) && IsFinite(points.B);
    AngleTolerance tolerance;
    tolerance.Sine = Clear; // to more digits than matter here
    return areFinite && SumWide(WideLegs(points)).ExceedsPi(tolerance);
  }
};

}

#endif
