// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "delaunayflip_c.h"

#include "CallerInput.h"
#include "PolygonSplit.h"
#include "Status.h"

#include <algorithm>
#include <vector>

using namespace delaunayflip;

namespace
{

/// The corners of one polygon.
struct Corners
{
  const std::int64_t* Ids;
  std::int64_t Count;
};

Corners GetCorners(const delaunayflip_polygons& polygons, std::int64_t polygon)
{
  const std::int64_t begin = polygons.offsets[polygon];
  const std::int64_t end = polygons.offsets[polygon + 1];
  Require(begin >= 0 && begin <= end, "offsets decrease, or are negative");
  return { polygons.corners + begin, end - begin };
}

void RequirePoints(const Corners& corners, std::int64_t points, std::int64_t polygon)
{
  const std::int64_t* end = corners.Ids + corners.Count;
  const std::int64_t* wrong =
    std::find_if(corners.Ids, end, [points](std::int64_t id) { return id < 0 || id >= points; });
  if (wrong != end)
  {
    throw InvalidMesh("polygon " + std::to_string(polygon) + " names point " +
        std::to_string(*wrong) + ", but there are " + std::to_string(points) +
        " points, numbered from 0",
      polygon, *wrong);
  }
}

/// Appends the triangles of all polygons.
std::vector<std::int64_t> Split(
  const PointArray& points, const delaunayflip_polygons& polygons, const ProgressObserver& progress)
{
  constexpr std::int64_t PolygonsBetweenCalls = 4096;
  std::vector<std::int64_t> triangles;
  const auto all = static_cast<double>(polygons.number_of_polygons);
  for (std::int64_t i = 0; i < polygons.number_of_polygons; ++i)
  {
    const Corners corners = GetCorners(polygons, i);
    RequirePoints(corners, points.Count, i);
    const auto part = [&](double share)
    { return !progress || progress((static_cast<double>(i) + share) / all); };
    const bool continues = (i % PolygonsBetweenCalls != 0 || part(0.0)) &&
      (corners.Count < 3 || SplitPolygon(points, corners.Ids, corners.Count, triangles, part));
    if (!continues)
    {
      throw RunAborted();
    }
  }
  return triangles;
}

}

extern "C"
{

  void delaunayflip_polygons_init(delaunayflip_polygons* polygons)
  {
    *polygons = MakeEmpty<delaunayflip_polygons>();
  }

  delaunayflip_status delaunayflip_split_polygons(const delaunayflip_mesh* mesh,
    const delaunayflip_polygons* polygons, const delaunayflip_callbacks* callbacks,
    std::int64_t* triangles)
  {
    return Try(
      [=]()
      {
        const TriangleMesh view = ToMesh(CompleteMesh(mesh));
        const delaunayflip_polygons complete = CompletePolygons(polygons);
        const std::vector<std::int64_t> ids =
          Split(view.Points, complete, Observers(callbacks).Progress);
        Require(triangles || ids.empty(), "triangles is null");
        std::copy(ids.begin(), ids.end(), triangles);
      });
  }
}
