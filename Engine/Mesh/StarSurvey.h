// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARSURVEY_H
#define DELAUNAYFLIP_STARSURVEY_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "HostDevice.h"
#include "PackedPoints.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

/// The counts at vertices.
struct StarSums
{
  std::int64_t SeveralFans = 0;
  std::int64_t Covers = 0; ///< Corners that cover their vertex's direction.
  std::int64_t Uncertain = 0; ///< A device cannot tell.

  DELAUNAYFLIP_HOST_DEVICE StarSums& operator+=(const StarSums& part)
  {
    this->SeveralFans += part.SeveralFans;
    this->Covers += part.Covers;
    this->Uncertain += part.Uncertain;
    return *this;
  }
};

/// Three points and their vertex ids.
struct CornerPoints
{
  const VertexId* Vertices;
  PlanePoint Points[3];
};

/// Finds whether the stars of a mesh whose triangles all turn to one side cover no direction twice.
///
/// Around an inner vertex the triangles turn a whole number of times: as often as they cross the
/// direction +u, which comparisons of coordinates decide. At the boundary, the direction of the
/// fan's first edge must be covered only once. So every used vertex has at least one corner that
/// covers its direction. It is exactly one for each if there are as many such corners as vertices.
struct StarSurvey
{
  static constexpr VertexId NoVertex = 0xFFFFFFFFu;

  EdgeMeshView Mesh;
  PackedPointsView Points;
  VertexId* FanStarts; ///< At the boundary, the end of the fan's first edge.

  /// Notes where a fan starts, if the edge is a boundary edge.
  DELAUNAYFLIP_HOST_DEVICE void NoteFan(EdgeId edge, StarSums& sums) const
  {
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    if (this->Mesh.CornerOfHalfEdge[2 * edge + 1] != NoCorner)
    {
      return;
    }
    const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
    const VertexId from = triangle.Vertices[NextSlot(SlotOf(corner))];
    const VertexId to = triangle.Vertices[PreviousSlot(SlotOf(corner))];
    sums.SeveralFans += AtomicExchange(&this->FanStarts[from], to) == NoVertex ? 0 : 1;
  }

  /// @param side the side to which the triangle turns, not 0.
  DELAUNAYFLIP_HOST_DEVICE void NoteTriangle(
    const CornerPoints& corners, int side, StarSums& sums) const
  {
    const VertexId* v = corners.Vertices;
    const bool inner = this->FanStarts[v[0]] == NoVertex && this->FanStarts[v[1]] == NoVertex &&
      this->FanStarts[v[2]] == NoVertex;
    if (inner)
    {
      sums.Covers += CoverPositiveU(corners.Points, side) ? 1 : 0;
      return;
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      sums.Covers += this->Covers(corners, slot, side, sums) ? 1 : 0;
    }
  }

  /// Whether direction v-p lies in the half plane v > 0, or on its border with u > 0.
  DELAUNAYFLIP_HOST_DEVICE static bool IsUpper(const PlanePoint& v, const PlanePoint& p)
  {
    // Without branches, which would be mispredicted half of the time.
    return ((p.V > v.V) | ((p.V == v.V) & (p.U > v.U))) != 0;
  }

private:
  /// Whether the corner at v from `first` (included) to `last` (not) covers +u.
  DELAUNAYFLIP_HOST_DEVICE static bool CoversPositiveU(
    const PlanePoint& v, const PlanePoint& first, const PlanePoint& last, int side)
  {
    const bool firstUpper = IsUpper(v, first);
    const bool lastUpper = IsUpper(v, last);
    return side > 0 ? !firstUpper && lastUpper : firstUpper && !lastUpper;
  }

  /// Whether a corner of a triangle covers +u. At most one of them does: of its three directed
  /// edges, two go up or two go down.
  DELAUNAYFLIP_HOST_DEVICE static bool CoverPositiveU(const PlanePoint (&p)[3], int side)
  {
    const int up =
      (IsUpper(p[0], p[1]) ? 1 : 0) + (IsUpper(p[1], p[2]) ? 1 : 0) + (IsUpper(p[2], p[0]) ? 1 : 0);
    return up == (side > 0 ? 1 : 2);
  }

  /// Whether the corner at a slot covers where the fan starts.
  DELAUNAYFLIP_HOST_DEVICE bool Covers(
    const CornerPoints& corners, int slot, int side, StarSums& sums) const
  {
    const PlanePoint& v = corners.Points[slot];
    const PlanePoint& first = corners.Points[NextSlot(slot)];
    const PlanePoint& last = corners.Points[PreviousSlot(slot)];
    const VertexId start = this->FanStarts[corners.Vertices[slot]];
    if (start == NoVertex)
    {
      return CoversPositiveU(v, first, last, side);
    }
    if (start == corners.Vertices[NextSlot(slot)])
    {
      return true;
    }
    const PlanePoint t = this->Points.GetPlanePoint(start);
    const int afterFirst = FindOrientation(v, first, t);
    const int beforeLast = FindOrientation(v, t, last);
    sums.Uncertain += afterFirst == UncertainSign || beforeLast == UncertainSign ? 1 : 0;
    if (afterFirst == 0)
    {
      return IsUpper(v, first) == IsUpper(v, t);
    }
    return side * afterFirst > 0 && side * beforeLast > 0;
  }
};

}

#endif
