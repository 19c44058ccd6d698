// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESURVEY_H
#define DELAUNAYFLIP_SPHERESURVEY_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "FlipError.h"
#include "FlipReport.h"
#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Properties of a mesh on a sphere before the first flip, and whether points are on one.

namespace delaunayflip
{

/// Whether points are those of a globe, which decides whether users are told of the sphere.
struct GlobeSurvey
{
  std::int64_t Points = 0;
  double Nearest = INFINITY, Farthest = -INFINITY; ///< From the origin.
  BoundingBox Box;

  DELAUNAYFLIP_HOST_DEVICE void Include(const Vector3& point)
  {
    const double distance = Length(point);
    ++this->Points;
    this->Nearest = std::min(this->Nearest, distance);
    this->Farthest = std::max(this->Farthest, distance);
    this->Box.Include(0, point.X, point.X);
    this->Box.Include(1, point.Y, point.Y);
    this->Box.Include(2, point.Z, point.Z);
  }
  DELAUNAYFLIP_HOST_DEVICE GlobeSurvey& operator+=(const GlobeSurvey& part)
  {
    this->Points += part.Points;
    this->Nearest = std::min(this->Nearest, part.Nearest);
    this->Farthest = std::max(this->Farthest, part.Farthest);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Box.Include(axis, part.Box.Lower[axis], part.Box.Upper[axis]);
    }
    return *this;
  }

  /// Whether there are enough points, all on one sphere, and on so much of it that they are far
  /// from one plane. Coordinates may be rounded to six digits.
  bool IsGlobe() const
  {
    constexpr std::int64_t Fewest = 50; // fewer are corners of a box or a prism
    constexpr double Rounding = 1e-4, SmallestPart = 0.02, Thinnest = 1e-3;
    const double x = this->Box.Upper[0] - this->Box.Lower[0];
    const double y = this->Box.Upper[1] - this->Box.Lower[1];
    const double z = this->Box.Upper[2] - this->Box.Lower[2];
    const double diagonal = Length({ x, y, z });
    return this->Points >= Fewest && this->Farthest - this->Nearest <= Rounding * diagonal &&
      diagonal >= SmallestPart * this->Farthest && std::min({ x, y, z }) >= Thinnest * diagonal;
  }
};

struct SphereSums
{
  OrientationSample Orientations; ///< Seen from outside: Left is counter-clockwise.
  std::int64_t Uncertain = 0; ///< Triangles that a device cannot decide.

  DELAUNAYFLIP_HOST_DEVICE SphereSums& operator+=(const SphereSums& part)
  {
    this->Orientations += part.Orientations;
    this->Uncertain += part.Uncertain;
    return *this;
  }
};

struct SphereSurvey
{
  /// 1 or -1 if all triangles face the center strictly with the same side, which flips keep; else
  /// 0.
  int UniformSide = 0;

  std::vector<Defect> Defects;
};

/// Finds the orientations of all triangles, seen from the center. Triangles with a non-finite
/// coordinate, which never flip, do not count.
/// @param center TriangleMesh::Center.
/// @throws BeyondDevice if a device cannot decide an orientation.
template <typename Backend>
SphereSurvey SurveySphere(const EdgeMesh& mesh, const PackedPoints& packed,
  const PlanePoint& center, const Backend& backend)
{
  const TriangleRecord* triangles = mesh.Triangles.Data();
  const PackedPointsView points = packed.View();
  const PlanePoint from = center;
  const SphereSums sums = backend.template Sum<SphereSums>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, SphereSums & sum)
    {
      const VertexId* v = triangles[t].Vertices;
      PlanePoint corners[3];
      for (int slot = 0; slot < 3; ++slot)
      {
        const Vector3 p = points.GetPosition(v[slot]);
        corners[slot] = { p.X, p.Y, p.Z };
        if (!IsFinite(corners[slot]))
        {
          return;
        }
      }
      const int side = FindOrientation3D(corners[0], corners[1], corners[2], from);
      if (side == UncertainSign)
      {
        ++sum.Uncertain;
        return;
      }
      sum.Orientations.Note(side, triangles[t].InputTriangle);
    });
  if (sums.Uncertain > 0)
  {
    throw BeyondDevice();
  }
  const OrientationSample& orientations = sums.Orientations;
  SphereSurvey survey;
  survey.Defects = { MakeDefect(DefectKind::TrianglesWithoutArea, orientations.Flat),
    MakeDefect(DefectKind::TurnedFromMost, orientations.GetOthers()) };
  for (Defect& defect : survey.Defects)
  {
    defect.Detail = ", seen from the center of the sphere";
  }
  if (orientations.CountStrays() == 0)
  {
    survey.UniformSide = orientations.GetSide();
  }
  return survey;
}

}

#endif
