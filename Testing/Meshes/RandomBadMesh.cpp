// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "SplitHistory.h"

#include <random>

namespace delaunayflip
{
namespace
{

/// A point strictly inside the square, so that the boundary keeps its four edges.
std::int32_t DrawCoordinate(std::mt19937& random)
{
  std::int32_t coordinate = 0;
  while (coordinate == 0)
  {
    coordinate = static_cast<std::int32_t>(random() >> 8);
  }
  return coordinate;
}

template <typename Real>
OwnedMesh<Real> MakeRandomBad(std::int64_t points, std::uint32_t seed)
{
  std::mt19937 random(seed);
  SplitHistory history(points, LatticeSize);
  while (static_cast<std::int64_t>(history.Points.size()) < points)
  {
    const std::int32_t x = DrawCoordinate(random);
    const std::int32_t y = DrawCoordinate(random);
    history.Insert({ x, y });
  }
  OwnedMesh<Real> mesh;
  mesh.Points.reserve(3 * history.Points.size());
  for (const LatticePoint& point : history.Points)
  {
    const Real step = Real(1) / static_cast<Real>(LatticeSize);
    mesh.Points.insert(mesh.Points.end(), { Real(point.X) * step, Real(point.Y) * step, Real(0) });
  }
  mesh.Triangles.reserve(6 * history.Points.size());
  history.ForEachTriangle([&](const std::array<std::int32_t, 3>& ids)
    { mesh.Triangles.insert(mesh.Triangles.end(), ids.begin(), ids.end()); });
  return mesh;
}

}

OwnedMesh<float> MakeRandomBadMesh(std::int64_t points, std::uint32_t seed)
{
  return MakeRandomBad<float>(points, seed);
}

OwnedMesh<double> MakeRandomBadMeshDouble(std::int64_t points, std::uint32_t seed)
{
  return MakeRandomBad<double>(points, seed);
}

}
