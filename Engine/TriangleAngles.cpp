// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleAngles.h"

#include "MeshSurvey.h"
#include "MeshSurveyBuilder.h"
#include "ScaledOffsets.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delaunayflip
{

namespace
{

using Corners = std::array<std::int64_t, 3>;

Corners GetCorners(const TriangleMesh& mesh, std::int64_t t)
{
  return { mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1), mesh.Triangles.Get(t, 2) };
}

/// The angle between two edges from a corner, in degrees.
double ToDegrees(const Vector3& first, const Vector3& second)
{
  return std::atan2(Length(Cross(first, second)), Dot(first, second)) / DegreesToRadians;
}

double SmallestAngle(const PointArray& points, const Corners& ids, int axes)
{
  std::array<std::array<double, 3>, 3> x{};
  LoadScaledOffsets(points, ids.data(), 3, axes, x);
  const Vector3 a = { x[0][0], x[0][1], x[0][2] };
  const Vector3 b = { x[1][0], x[1][1], x[1][2] };
  const Vector3 c = { x[2][0], x[2][1], x[2][2] };
  // Products of edges are cotangents times twice the area: the largest is at the smallest angle.
  const double atA = Dot(b - a, c - a), atB = Dot(c - b, a - b), atC = Dot(a - c, b - c);
  if (atA >= atB && atA >= atC)
  {
    return ToDegrees(b - a, c - a);
  }
  return atB >= atC ? ToDegrees(c - b, a - b) : ToDegrees(a - c, b - c);
}

double FindSmallestAngle(const TriangleMesh& mesh, GeometryKind geometry, std::int64_t t)
{
  const int axes = geometry == GeometryKind::PlanarXY ? 2 : 3;
  const Corners ids = GetCorners(mesh, t);
  const bool isFinite = std::all_of(ids.begin(), ids.end(),
    [&](std::int64_t id) { return IsFinitePoint(mesh.Points, id, geometry); });
  return isFinite ? SmallestAngle(mesh.Points, ids, axes)
                  : std::numeric_limits<double>::quiet_NaN();
}

}

void RequireValidIds(const TriangleMesh& mesh)
{
  const std::int64_t points = mesh.Points.Count;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const Corners ids = GetCorners(mesh, t);
    if (!std::all_of(
          ids.begin(), ids.end(), [points](std::int64_t id) { return id >= 0 && id < points; }))
    {
      ThrowInvalidId(ids, t, points);
    }
  }
}

void FindSmallestAngles(const TriangleMesh& mesh, GeometryKind geometry, int threads,
  double* degrees, const ProgressObserver& progress)
{
  constexpr std::int64_t TrianglesBetweenCalls = 131072; // tens of milliseconds on one thread
  RequireValidIds(mesh);
  const std::int64_t count = mesh.Triangles.Count;
  const ThreadBackend backend(threads);
  for (std::int64_t first = 0; first < count; first += TrianglesBetweenCalls)
  {
    if (progress && !progress(static_cast<double>(first) / static_cast<double>(count)))
    {
      throw RunAborted();
    }
    backend.ForEach(std::min(TrianglesBetweenCalls, count - first),
      [&](std::int64_t i) { degrees[first + i] = FindSmallestAngle(mesh, geometry, first + i); });
  }
}

}
