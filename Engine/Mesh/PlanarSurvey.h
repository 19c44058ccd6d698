// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANARSURVEY_H
#define DELAUNAYFLIP_PLANARSURVEY_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "FlipReport.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "WideAngles.h"

#include <cstdint>
#include <vector>

/// @file
/// Properties of a planar mesh before the first flip, from exact orientations.

namespace delaunayflip
{

/// What is counted in a planar mesh.
struct PlaneSums
{
  OrientationSample Orientations;
  std::int64_t UncertainOrientations = 0; ///< A device cannot tell.
  std::int64_t SeveralFans = 0; ///< Fans at vertices that have another one.
  std::int64_t Covers = 0; ///< Corners that cover their vertex's direction.
  std::int64_t UncertainCovers = 0; ///< A device cannot tell.

  DELAUNAYFLIP_HOST_DEVICE PlaneSums& operator+=(const PlaneSums& part)
  {
    this->Orientations += part.Orientations;
    this->UncertainOrientations += part.UncertainOrientations;
    this->SeveralFans += part.SeveralFans;
    this->Covers += part.Covers;
    this->UncertainCovers += part.UncertainCovers;
    return *this;
  }
};

/// Examines the orientation of triangles and, if all have the same one, whether the stars cover no
/// direction twice.
///
/// The triangles around an inner vertex wind around it a whole number of times: as often as they
/// cross the direction +u, which comparisons of coordinates decide. At the boundary, the direction
/// of the fan's first edge must be covered only once. So every used vertex has at least one corner
/// that covers its direction. It is exactly one for each if there are as many such corners as
/// vertices.
struct StarSurvey
{
  EdgeMeshView Mesh;
  PackedPointsView Points;
  VertexId* FanStarts; ///< At the boundary, the end of the fan's first edge.
  bool ExaminesStars; ///< False: it examines orientations only.

  /// Notes where a fan starts, if the edge is a boundary edge.
  DELAUNAYFLIP_HOST_DEVICE void NoteFan(EdgeId edge, PlaneSums& sums) const
  {
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    if (this->Mesh.CornerOfHalfEdge[2 * edge + 1] == NoCorner)
    {
      const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
      const VertexId from = triangle.Vertices[NextSlot(SlotOf(corner))];
      const VertexId to = triangle.Vertices[PreviousSlot(SlotOf(corner))];
      sums.SeveralFans += int(AtomicExchange(&this->FanStarts[from], to) != NoVertex);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const VertexId vertex : this->Mesh.Triangles[t].Vertices)
    {
      delaunayflip::Prefetch(this->Points.Address(vertex));
      if (this->ExaminesStars)
      {
        delaunayflip::Prefetch(&this->FanStarts[vertex]);
      }
    }
  }

  /// Examines a triangle, if its coordinates are finite.
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, PlaneSums& sums) const
  {
    const TriangleRecord& triangle = this->Mesh.Triangles[t];
    const VertexId* v = triangle.Vertices;
    const PlanePoint p[3] = { this->Points.GetPlanePoint(v[0]), this->Points.GetPlanePoint(v[1]),
      this->Points.GetPlanePoint(v[2]) };
    const bool usual = IsInFilterRange(p[0]) && IsInFilterRange(p[1]) && IsInFilterRange(p[2]);
    if (!usual && !(IsFinite(p[0]) && IsFinite(p[1]) && IsFinite(p[2])))
    {
      return;
    }
    const int side = FindOrientation(p[0], p[1], p[2]);
    if (side == UncertainSign)
    {
      ++sums.UncertainOrientations;
      return;
    }
    sums.Orientations.Note(side, triangle.InputTriangle);
    if (!this->ExaminesStars || side == 0)
    {
      return;
    }
    const bool isInner = this->FanStarts[v[0]] == NoVertex && this->FanStarts[v[1]] == NoVertex &&
      this->FanStarts[v[2]] == NoVertex;
    if (isInner)
    {
      sums.Covers += int(CoverPositiveU(p, side));
      return;
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      sums.Covers += int(this->Covers(v, p, slot, side, sums));
    }
  }

  /// Whether direction v-p lies in the half plane v > 0, or on its border with u > 0.
  DELAUNAYFLIP_HOST_DEVICE static bool IsUpper(const PlanePoint& v, const PlanePoint& p)
  {
    // There are no branches, because they would be mispredicted half of the time.
    return ((p.V > v.V) | ((p.V == v.V) & (p.U > v.U))) != 0;
  }

private:
  /// Whether a corner of a triangle covers +u. At most one of them does: of its three directed
  /// edges, two go up or two go down.
  DELAUNAYFLIP_HOST_DEVICE static bool CoverPositiveU(const PlanePoint (&p)[3], int side)
  {
    const int up = int(IsUpper(p[0], p[1])) + int(IsUpper(p[1], p[2])) + int(IsUpper(p[2], p[0]));
    const int wanted = side > 0 ? 1 : 2;
    return up == wanted;
  }

  /// Whether the corner at a slot covers where the fan starts; at an inner vertex, whether it
  /// covers +u from its first side (included) to its last (not).
  DELAUNAYFLIP_HOST_DEVICE bool Covers(
    const VertexId* vertices, const PlanePoint (&p)[3], int slot, int side, PlaneSums& sums) const
  {
    const PlanePoint& v = p[slot];
    const PlanePoint& first = p[NextSlot(slot)];
    const PlanePoint& last = p[PreviousSlot(slot)];
    const VertexId start = this->FanStarts[vertices[slot]];
    if (start == NoVertex)
    {
      const bool firstUpper = IsUpper(v, first);
      const bool lastUpper = IsUpper(v, last);
      return firstUpper != lastUpper && lastUpper == (side > 0);
    }
    if (start == vertices[NextSlot(slot)])
    {
      return true;
    }
    const PlanePoint t = this->Points.GetPlanePoint(start);
    const int afterFirst = FindOrientation(v, first, t);
    const int beforeLast = FindOrientation(v, t, last);
    sums.UncertainCovers += int(afterFirst == UncertainSign || beforeLast == UncertainSign);
    if (afterFirst == 0)
    {
      return IsUpper(v, first) == IsUpper(v, t);
    }
    return side * afterFirst > 0 && side * beforeLast > 0;
  }
};

struct PlanarSurvey
{
  /// 1 or -1 if every triangle has that orientation, which flips do not change; else 0.
  int UniformSide = 0;

  /// Whether the triangles around every vertex cover no direction twice. Then no two edges at a
  /// vertex point the same way, flips cannot make an edge that exists, and no guard is needed.
  /// Flips do not change this, because they keep the angle around a vertex.
  bool StarsAreSimple = false;

  OrientationSample Orientations;

  /// Lists the triangles without area, and those with another orientation than most.
  /// @param side the orientation of most triangles; 0: it is found here.
  std::vector<Defect> ListDefects(int side) const
  {
    if (side == 0)
    {
      side = this->Orientations.GetSide();
    }
    return { MakeDefect(DefectKind::TrianglesWithoutArea, this->Orientations.Flat),
      MakeDefect(DefectKind::TurnedFromMost, this->Orientations.GetOthers(side)) };
  }
};

/// Triangles with a non-finite coordinate, which never flip, do not count.
/// @param skipStars whether there are non-manifold or wrongly wound edges, or triangles with a
/// non-finite coordinate; then StarsAreSimple is false without examination.
/// @param usedPoints the number of vertices of triangles.
/// @throws BeyondDevice if a device cannot decide an orientation.
template <typename Backend>
PlanarSurvey SurveyPlane(EdgeMesh& mesh, const PackedPoints& points, bool skipStars,
  std::int64_t usedPoints, const Backend& backend)
{
  Array<VertexId> fanStarts;
  StarSurvey step{ mesh.View(), points.View(), nullptr, !skipStars };
  PlaneSums fans;
  if (!skipStars)
  {
    fanStarts = backend.template MakeArray<VertexId>(points.Count);
    step.FanStarts = fanStarts.Data();
    backend.ForEach(
      points.Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t v) { step.FanStarts[v] = NoVertex; });
    fans = backend.template Sum<PlaneSums>(mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, PlaneSums & part)
      { step.NoteFan(static_cast<EdgeId>(e), part); });
  }
  step.ExaminesStars = !skipStars && fans.SeveralFans == 0;
  const PlaneSums sums = backend.template Sum<PlaneSums>(mesh.NumberOfTriangles, step);
  const OrientationSample& orientations = sums.Orientations;
  const bool uniform =
    orientations.Flat.Count == 0 && (orientations.Left.Count == 0 || orientations.Right.Count == 0);
  if (sums.UncertainOrientations > 0 || (uniform && sums.UncertainCovers > 0))
  {
    throw BeyondDevice();
  }
  PlanarSurvey survey;
  survey.Orientations = orientations;
  if (uniform)
  {
    survey.UniformSide = orientations.Right.Count == 0 ? 1 : -1;
    survey.StarsAreSimple = step.ExaminesStars && sums.Covers == usedPoints;
  }
  return survey;
}

/// Finds the triangles of a surface that have no area.
template <typename Backend>
Defect FindZeroAreaTriangles(
  const EdgeMesh& mesh, const PackedPoints& packed, const Backend& backend)
{
  const TriangleRecord* triangles = mesh.Triangles.Data();
  const PackedPointsView points = packed.View();
  const IdSample sample = backend.template Sum<IdSample>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, IdSample & sum)
    {
      const VertexId* v = triangles[t].Vertices;
      if (HasNoArea(points.GetPosition(v[0]), points.GetPosition(v[1]), points.GetPosition(v[2])))
      {
        sum.Note(triangles[t].InputTriangle);
      }
    });
  return MakeDefect(DefectKind::TrianglesWithoutArea, sample);
}

}

#endif
