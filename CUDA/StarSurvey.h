// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARSURVEY_H
#define DELAUNAYFLIP_STARSURVEY_H

#include "Array.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "HostDevice.h"
#include "PackedPoints.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

DELAUNAYFLIP_HOST_DEVICE inline bool IsFinite(const PlanePoint& point)
{
  // A difference with itself is 0 for finite numbers only.
  return point.U - point.U == 0.0 && point.V - point.V == 0.0;
}

DELAUNAYFLIP_HOST_DEVICE inline bool IsInFilterRange(const PlanePoint& point)
{
  constexpr double Half = LargestFilteredDifference / 2;
  return std::fabs(point.U) <= Half && std::fabs(point.V) <= Half;
}

/// Turn of a, b, c. UncertainSign only on a device.
DELAUNAYFLIP_HOST_DEVICE inline int FindOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FilteredOrientation(a, b, c);
  const bool certain =
    sign != UncertainSign && IsInFilterRange(a) && IsInFilterRange(b) && IsInFilterRange(c);
  return certain ? sign : ExactOrientation(a, b, c);
}

/// What is found at vertices.
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

/// Whether the stars of a mesh of uniform side cover no direction twice.
///
/// Around an inner vertex the triangles turn a whole number of times: as often as the direction +u
/// is crossed, which comparisons of coordinates tell. At the boundary the direction of the fan's
/// first edge must be covered once only. So every vertex of a triangle has one corner or more that
/// cover its direction, and one each when there are as many such corners as vertices.
struct StarSurvey
{
  static constexpr VertexId NoVertex = 0xFFFFFFFFu;

  EdgeMeshView Mesh;
  PackedPointsView Points;
  int Side;
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

  DELAUNAYFLIP_HOST_DEVICE void NoteTriangle(std::int64_t t, StarSums& sums) const
  {
    const VertexId* v = this->Mesh.Triangles[t].Vertices;
    const bool inner = this->FanStarts[v[0]] == NoVertex && this->FanStarts[v[1]] == NoVertex &&
      this->FanStarts[v[2]] == NoVertex;
    if (inner)
    {
      sums.Covers += this->CoverPositiveU(v) ? 1 : 0;
      return;
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      sums.Covers += this->Covers(v[slot], v[NextSlot(slot)], v[PreviousSlot(slot)], sums) ? 1 : 0;
    }
  }

private:
  /// Whether direction v-p lies in the half plane v > 0, or on its border with u > 0.
  DELAUNAYFLIP_HOST_DEVICE static bool IsUpper(const PlanePoint& v, const PlanePoint& p)
  {
    // Without branches, which would be coin tosses.
    return ((p.V > v.V) | ((p.V == v.V) & (p.U > v.U))) != 0;
  }

  DELAUNAYFLIP_HOST_DEVICE bool CoversPositiveU(
    VertexId vertex, VertexId first, VertexId last) const
  {
    const PlanePoint v = this->Points.GetPlanePoint(vertex);
    const bool firstUpper = IsUpper(v, this->Points.GetPlanePoint(first));
    const bool lastUpper = IsUpper(v, this->Points.GetPlanePoint(last));
    return this->Side > 0 ? !firstUpper && lastUpper : firstUpper && !lastUpper;
  }

  /// Whether a corner of a triangle covers +u, which one of them does at most: two of three edges
  /// that go round it go up, or two go down.
  DELAUNAYFLIP_HOST_DEVICE bool CoverPositiveU(const VertexId* v) const
  {
    const PlanePoint p = this->Points.GetPlanePoint(v[0]);
    const PlanePoint q = this->Points.GetPlanePoint(v[1]);
    const PlanePoint r = this->Points.GetPlanePoint(v[2]);
    const int up = (IsUpper(p, q) ? 1 : 0) + (IsUpper(q, r) ? 1 : 0) + (IsUpper(r, p) ? 1 : 0);
    return up == (this->Side > 0 ? 1 : 2);
  }

  /// Whether the corner from `first` (included) to `last` (not) covers where the fan starts.
  DELAUNAYFLIP_HOST_DEVICE bool Covers(
    VertexId vertex, VertexId first, VertexId last, StarSums& sums) const
  {
    const VertexId start = this->FanStarts[vertex];
    if (start == NoVertex)
    {
      return this->CoversPositiveU(vertex, first, last);
    }
    if (start == first)
    {
      return true;
    }
    const PlanePoint v = this->Points.GetPlanePoint(vertex);
    const PlanePoint f = this->Points.GetPlanePoint(first);
    const PlanePoint t = this->Points.GetPlanePoint(start);
    const int afterFirst = FindOrientation(v, f, t);
    const int beforeLast = FindOrientation(v, t, this->Points.GetPlanePoint(last));
    sums.Uncertain += afterFirst == UncertainSign || beforeLast == UncertainSign ? 1 : 0;
    if (afterFirst == 0)
    {
      return IsUpper(v, f) == IsUpper(v, t);
    }
    return this->Side * afterFirst > 0 && this->Side * beforeLast > 0;
  }
};

/// @param usedPoints vertices of triangles.
/// @throws BeyondDevice where a device cannot tell.
template <typename Backend>
bool AreStarsSimple(EdgeMesh& mesh, const PackedPoints& points, int side, std::int64_t usedPoints,
  const Backend& backend)
{
  Array<VertexId> fanStarts = backend.template MakeArray<VertexId>(points.Count);
  const StarSurvey survey{ mesh.View(), points.View(), side, fanStarts.Data() };
  backend.ForEach(points.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t v) { survey.FanStarts[v] = StarSurvey::NoVertex; });
  StarSums sums = backend.template Sum<StarSums>(mesh.NumberOfEdges,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, StarSums & part)
    { survey.NoteFan(static_cast<EdgeId>(e), part); });
  if (sums.SeveralFans > 0)
  {
    return false;
  }
  sums = backend.template Sum<StarSums>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, StarSums & part)
    { survey.NoteTriangle(t, part); });
  if (sums.Uncertain > 0)
  {
    throw BeyondDevice();
  }
  return sums.Covers == usedPoints;
}

}

#endif
