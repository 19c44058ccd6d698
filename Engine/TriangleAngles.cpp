// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleAngles.h"

#include "MeshSurveyBuilder.h"
#include "SmallestAngle.h"
#include "ThreadBackend.h"

#include <algorithm>

namespace delaunayflip
{

void RequireValidIds(const TriangleMesh& mesh)
{
  const std::int64_t points = mesh.Points.Count;
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    const PointIds ids{ mesh.Triangles.Get(t, 0), mesh.Triangles.Get(t, 1),
      mesh.Triangles.Get(t, 2) };
    const auto isValid = [points](std::int64_t id) { return id >= 0 && id < points; };
    if (!std::all_of(ids.begin(), ids.end(), isValid))
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
