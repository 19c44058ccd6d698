// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANARSURVEY_H
#define DELAUNAYFLIP_PLANARSURVEY_H

#include "Defects.h"
#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipReport.h"
#include "PackedPoints.h"
#include "StarSurvey.h"
#include "WideAngles.h"

#include <cstdint>

/// @file
/// Properties of a planar mesh before the first flip, from exact orientations.

namespace delaunayflip
{

struct PlanarSurvey
{
  /// 1 or -1 if every triangle strictly turns to that side, which flips do not change; else 0.
  int UniformSide = 0;

  /// Whether the triangles around every vertex cover no direction twice. Then no two edges at a
  /// vertex point the same way, flips cannot make an edge that exists, and no guard is needed.
  /// Flips do not change this, because they keep the angle around a vertex.
  bool StarsAreSimple = false;

  Defect ZeroAreaTriangles;
  Defect LeftTriangles, RightTriangles; ///< By the side to which they turn.

  /// The triangles that turn to the less common side, unless `side` says which side is common.
  const Defect& GetInverted(int side) const
  {
    const bool areMostlyLeft =
      side == 0 ? this->LeftTriangles.Count >= this->RightTriangles.Count : side > 0;
    return areMostlyLeft ? this->RightTriangles : this->LeftTriangles;
  }
};

struct OrientationSums
{
  IdSample Left, Right, None;
  std::int64_t Uncertain = 0; ///< Orientations that a device cannot decide.

  DELAUNAYFLIP_HOST_DEVICE OrientationSums& operator+=(const OrientationSums& part)
  {
    this->Left += part.Left;
    this->Right += part.Right;
    this->None += part.None;
    this->Uncertain += part.Uncertain;
    return *this;
  }

  DELAUNAYFLIP_HOST_DEVICE void Note(int sign, TriangleId inputTriangle)
  {
    if (sign == UncertainSign)
    {
      ++this->Uncertain;
      return;
    }
    (sign == 0 ? this->None : (sign > 0 ? this->Left : this->Right)).Note(inputTriangle);
  }
};

struct PlaneSums
{
  OrientationSums Turns;
  StarSums Stars;

  DELAUNAYFLIP_HOST_DEVICE PlaneSums& operator+=(const PlaneSums& part)
  {
    this->Turns += part.Turns;
    this->Stars += part.Stars;
    return *this;
  }
};

/// Examines a triangle with finite coordinates.
struct PlaneStep
{
  StarSurvey Survey;
  bool ExamineStars;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const VertexId vertex : this->Survey.Mesh.Triangles[t].Vertices)
    {
      delaunayflip::Prefetch(this->Survey.Points.Address(vertex));
      if (this->ExamineStars)
      {
        delaunayflip::Prefetch(&this->Survey.FanStarts[vertex]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, PlaneSums& sums) const
  {
    const TriangleRecord& triangle = this->Survey.Mesh.Triangles[t];
    const VertexId* v = triangle.Vertices;
    const PackedPointsView& points = this->Survey.Points;
    const CornerPoints corners{ v,
      { points.GetPlanePoint(v[0]), points.GetPlanePoint(v[1]), points.GetPlanePoint(v[2]) } };
    const PlanePoint(&p)[3] = corners.Points;
    const bool usual = IsInFilterRange(p[0]) && IsInFilterRange(p[1]) && IsInFilterRange(p[2]);
    if (!usual && !(IsFinite(p[0]) && IsFinite(p[1]) && IsFinite(p[2])))
    {
      return;
    }
    const int side = FindOrientation(p[0], p[1], p[2]);
    sums.Turns.Note(side, triangle.InputTriangle);
    if (this->ExamineStars && (side == 1 || side == -1))
    {
      this->Survey.NoteTriangle(corners, side, sums.Stars);
    }
  }
};

/// Triangles with a non-finite coordinate, which never flip, do not count.
/// @param examineStars if false, the sums of stars mean nothing.
template <typename Backend>
PlaneSums SumPlane(
  EdgeMesh& mesh, const PackedPoints& points, bool examineStars, const Backend& backend)
{
  Array<VertexId> fanStarts = backend.template MakeArray<VertexId>(examineStars ? points.Count : 0);
  const StarSurvey survey{ mesh.View(), points.View(), fanStarts.Data() };
  StarSums fans;
  if (examineStars)
  {
    backend.ForEach(points.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t v) { survey.FanStarts[v] = StarSurvey::NoVertex; });
    fans = backend.template Sum<StarSums>(mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, StarSums & part)
      { survey.NoteFan(static_cast<EdgeId>(e), part); });
  }
  PlaneSums sums = backend.template Sum<PlaneSums>(
    mesh.NumberOfTriangles, PlaneStep{ survey, examineStars && fans.SeveralFans == 0 });
  sums.Stars += fans;
  return sums;
}

/// @param skipStars whether there are non-manifold or wrongly wound edges, or triangles with a
/// non-finite coordinate; then StarsAreSimple is false without examination.
/// @param usedPoints the number of vertices of triangles.
/// @throws BeyondDevice if a device cannot decide an orientation.
template <typename Backend>
PlanarSurvey SurveyPlane(EdgeMesh& mesh, const PackedPoints& points, bool skipStars,
  std::int64_t usedPoints, const Backend& backend)
{
  const PlaneSums sums = SumPlane(mesh, points, !skipStars, backend);
  const OrientationSums& turns = sums.Turns;
  const bool uniform = turns.None.Count == 0 && (turns.Left.Count == 0 || turns.Right.Count == 0);
  if (turns.Uncertain > 0 || (uniform && sums.Stars.Uncertain > 0))
  {
    throw BeyondDevice();
  }
  PlanarSurvey survey;
  const char* what = "triangles that turn the other way than most";
  survey.LeftTriangles = MakeDefect(what, turns.Left);
  survey.RightTriangles = MakeDefect(what, turns.Right);
  survey.ZeroAreaTriangles = MakeDefect("triangles without area", turns.None);
  if (uniform)
  {
    survey.UniformSide = turns.Right.Count == 0 ? 1 : -1;
    survey.StarsAreSimple =
      !skipStars && sums.Stars.SeveralFans == 0 && sums.Stars.Covers == usedPoints;
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
  return MakeDefect("triangles without area", sample);
}

}

#endif
