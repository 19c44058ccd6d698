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
#include "SurfaceAngles.h"

#include <cstdint>

/// @file
/// What exact orientations tell of a planar mesh before the first flip.

namespace delaunayflip
{

struct PlanarSurvey
{
  /// 1 or -1 when every triangle strictly turns to that side; flips keep it so. Else 0.
  int UniformSide = 0;

  /// Whether the triangles around every vertex cover no direction twice. Then no two edges at a
  /// vertex point the same way, flips cannot make an edge that exists, and no guard is needed.
  /// Flips keep it so, for they keep the angle around a vertex.
  bool StarsAreSimple = false;

  Defect ZeroAreaTriangles;
  Defect InvertedTriangles; ///< Those that turn to the less common side.
};

struct OrientationSums
{
  IdSample Left, Right, None;
  std::int64_t Uncertain = 0; ///< A device cannot tell.

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

/// Sums over triangles with finite coordinates.
template <typename Backend>
OrientationSums SumOrientations(
  const EdgeMesh& mesh, const PackedPointsView& points, const Backend& backend)
{
  const TriangleRecord* triangles = mesh.Triangles.Data();
  return backend.template Sum<OrientationSums>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, OrientationSums & sums)
    {
      const VertexId* v = triangles[t].Vertices;
      const PlanePoint p = points.GetPlanePoint(v[0]);
      const PlanePoint q = points.GetPlanePoint(v[1]);
      const PlanePoint r = points.GetPlanePoint(v[2]);
      if (IsFinite(p) && IsFinite(q) && IsFinite(r))
      {
        sums.Note(FindOrientation(p, q, r), triangles[t].InputTriangle);
      }
    });
}

/// Triangles with a coordinate that is not finite, which never flip, do not count.
/// @param hasBrokenFans whether there are non-manifold or wrongly wound edges or such triangles;
/// then StarsAreSimple is not examined and false.
/// @param usedPoints vertices of triangles.
/// @throws BeyondDevice where a device cannot tell an orientation.
template <typename Backend>
PlanarSurvey SurveyPlane(EdgeMesh& mesh, const PackedPoints& points, bool hasBrokenFans,
  std::int64_t usedPoints, const Backend& backend)
{
  const OrientationSums sums = SumOrientations(mesh, points.View(), backend);
  if (sums.Uncertain > 0)
  {
    throw BeyondDevice();
  }
  PlanarSurvey survey;
  const bool mostlyLeft = sums.Left.Count >= sums.Right.Count;
  survey.InvertedTriangles =
    MakeDefect("triangles that turn the other way than most", mostlyLeft ? sums.Right : sums.Left);
  survey.ZeroAreaTriangles = MakeDefect("triangles without area", sums.None);
  if (survey.InvertedTriangles.Count == 0 && survey.ZeroAreaTriangles.Count == 0)
  {
    survey.UniformSide = mostlyLeft ? 1 : -1;
    survey.StarsAreSimple =
      !hasBrokenFans && AreStarsSimple(mesh, points, survey.UniformSide, usedPoints, backend);
  }
  return survey;
}

/// Triangles of a surface without area.
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
      const Vector3 area =
        AreaVector(points.GetPosition(v[0]), points.GetPosition(v[1]), points.GetPosition(v[2]));
      if (Length(area) == 0.0)
      {
        sum.Note(triangles[t].InputTriangle);
      }
    });
  return MakeDefect("triangles without area", sample);
}

}

#endif
