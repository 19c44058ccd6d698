// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: FlipArrays
///
/// The engine without VTK: flips a mesh in plain arrays. The mesh is the worst case of the
/// literature: two rows of points, one far to the right of the other, joined by slivers. Then makes
/// triangles from its points alone.
#include <DelaunayFlip.h>

#include <cstdint>
#include <iostream>
#include <vector>

namespace
{

constexpr std::int64_t PointsPerRow = 200;

/// Three coordinates per point: the lower row, then the upper one.
std::vector<double> MakePoints()
{
  std::vector<double> xyz;
  for (std::int64_t i = 0; i < PointsPerRow; ++i)
  {
    xyz.insert(xyz.end(), { static_cast<double>(i), -1.0, 0.0 });
  }
  for (std::int64_t i = 0; i < PointsPerRow; ++i)
  {
    xyz.insert(xyz.end(), { static_cast<double>(PointsPerRow + 1 + i), 1.0, 0.0 });
  }
  return xyz;
}

/// Three point ids per triangle: the lower row joined to the last point of the upper one, which is
/// joined to the first point of the lower one.
std::vector<std::int64_t> MakeTriangles()
{
  const std::int64_t upper = PointsPerRow; // the first point of the upper row
  std::vector<std::int64_t> ids;
  for (std::int64_t i = 0; i + 1 < PointsPerRow; ++i)
  {
    ids.insert(ids.end(), { i, i + 1, 2 * PointsPerRow - 1 });
    ids.insert(ids.end(), { upper + i + 1, upper + i, 0 });
  }
  return ids;
}

}

int main()
{
  const std::vector<double> xyz = MakePoints();
  std::vector<std::int64_t> ids = MakeTriangles();
  const auto numberOfPoints = static_cast<std::int64_t>(xyz.size() / 3);
  const auto numberOfTriangles = static_cast<std::int64_t>(ids.size() / 3);
  try
  {
    delaunayflip::TriangleMesh mesh;
    mesh.Points = delaunayflip::PointArray(xyz.data(), numberOfPoints);
    mesh.Triangles = delaunayflip::TriangleArray(ids.data(), numberOfTriangles);
    const delaunayflip::FlipReport report = delaunayflip::FlipToDelaunay(
      mesh, {}, delaunayflip::MutableTriangleArray(ids.data(), numberOfTriangles));

    std::cout << report.TotalFlips << " flips in " << report.Iterations.size() << " iterations, "
              << report.NonDelaunayAfter << " bad edges left\n";

    delaunayflip::PointInput input;
    input.Points = delaunayflip::PlaneArray(xyz.data(), numberOfPoints, 3); // x, y, z: 3 numbers
    delaunayflip::FlipSession session(input, {});
    session.Advance();
    std::vector<std::int32_t> made(3 * session.GetReport().Triangles);
    session.StoreTriangles(
      delaunayflip::MutableTriangleArray(made.data(), session.GetReport().Triangles));

    std::cout << made.size() / 3 << " triangles from the points alone\n";
    return report.Converged() ? 0 : 1;
  }
  catch (const std::exception& error) // see FlipError.h
  {
    std::cerr << "error: " << error.what() << "\n";
    return 3;
  }
}
