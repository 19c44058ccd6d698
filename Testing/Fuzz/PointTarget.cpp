// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "FuzzTarget.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <set>

/// @file
/// Triangulations of points with segments as a target for fuzzers, judged by rational numbers.

namespace delaunayflip
{
namespace
{

struct PointCase
{
  Drawing Input;
  PointOptions Options;
};

/// Points on small grids or of a family of hard points, with exponents and defects; segments; one
/// ring in four cases.
PointCase MakePointCase(const std::uint8_t* bytes, std::size_t size)
{
  ByteSource source(bytes, size);
  PointCase drawn;
  Places& points = drawn.Input.Points;
  const std::uint32_t count = 1 + source.Draw(source.Once(8) ? 200 : 24);
  if (source.Once(2))
  {
    const std::uint32_t columns = 1 + source.Draw(12), rows = 1 + source.Draw(12);
    const int exponents[] = { 0, 0, 0, 40, -40, 600, -600 };
    const double scale = std::ldexp(1.0, exponents[source.Draw(7)]);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      points.push_back({ scale * source.Draw(columns), scale * source.Draw(rows) });
    }
  }
  else
  {
    std::mt19937 random = source.MakeRandom();
    const std::vector<PointFamily> families = ListPointFamilies();
    const PointFamily& family = families[source.Draw(static_cast<std::uint32_t>(families.size()))];
    while (points.size() < count)
    {
      for (const Point3& point : family.Draw(random))
      {
        points.push_back({ point[0], point[1] });
      }
    }
  }
  if (source.Once(8))
  {
    points[source.Draw(static_cast<std::uint32_t>(points.size()))][source.Draw(2)] = NAN;
  }
  const auto drawPoint = [&]()
  { return std::int64_t(source.Draw(static_cast<std::uint32_t>(points.size()))); };
  if (source.Once(4))
  {
    const std::int64_t corners[] = { drawPoint(), drawPoint(), drawPoint(), drawPoint() };
    for (int i = 0; i < 4; ++i)
    {
      drawn.Input.Segments.push_back({ corners[i], corners[(i + 1) % 4] });
    }
    drawn.Input.Rings.assign(4, 0);
  }
  for (std::uint32_t left = source.Draw(source.Once(8) ? 200 : 10); left > 0; --left)
  {
    drawn.Input.Segments.push_back({ drawPoint(), drawPoint() });
    drawn.Input.Rings.push_back(-1);
  }
  drawn.Options.SplitCrossings = source.Once(3);
  drawn.Options.RingRule = static_cast<RingRuleKind>(source.Draw(3));
  drawn.Input.FirstHole = source.Once(4) ? 0 : INT32_MAX;
  const double lengths[] = { 0.0, 0.0, 0.0, 1.0, 3.0 };
  drawn.Options.Alpha = lengths[source.Draw(5)];
  drawn.Options.LongestEdge = lengths[source.Draw(5)];
  drawn.Options.PointTolerance = source.Once(6) ? 1.5 : 0.0;
  return drawn;
}

/// Unless triangles were removed, none is left over or twice.
void ExpectRightNumber(const PointCase& drawn, const Places& points, const Triangulation& result)
{
  const PointCounts& counts = result.Report.FromPoints;
  std::set<Place> places;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool isUsed =
      i >= drawn.Input.Points.size() || result.UsedPoints[i] == static_cast<std::int64_t>(i);
    if (isUsed)
    {
      places.insert({ points[i][0] + 0.0, points[i][1] + 0.0 });
    }
  }
  if (counts.OutsideTriangles + counts.LargeTriangles == 0)
  {
    ExpectRightNumber(places, result);
  }
}

/// Reports a failure of GoogleTest for each promise that is broken: the result is the same on one
/// thread and on several; triangles turn left and are constrained Delaunay; their number is right.
/// An open ring, or one that crosses a segment, is an error.
void JudgePointCase(const PointCase& drawn)
{
  Triangulation result;
  try
  {
    result = Triangulate(drawn.Input, WithThreads(1, drawn.Options));
  }
  catch (const InvalidMesh&)
  {
    EXPECT_FALSE(drawn.Input.Rings.empty());
    EXPECT_EQ(0, drawn.Input.Rings.front());
    return;
  }
  const Triangulation other = Triangulate(drawn.Input, WithThreads(3, drawn.Options));
  EXPECT_EQ(result.Triangles, other.Triangles);
  EXPECT_EQ(result.Neighbors, other.Neighbors);
  EXPECT_EQ(result.UsedPoints, other.UsedPoints);
  EXPECT_EQ(result.Edges, other.Edges);
  ExpectSameStatistics(result.Report, other.Report);
  EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
  EXPECT_EQ(static_cast<std::int64_t>(result.Triangles.size()) / 3, result.Report.Triangles);
  Places points = drawn.Input.Points;
  for (const AddedPoint& added : result.Added)
  {
    points.push_back({ added.X, added.Y });
  }
  Triangulation kept = result;
  const EdgeMap edges = CollectEdges(ViewTriangles(result.Triangles));
  const bool mayLack = result.Report.FromPoints.OutsideTriangles > 0;
  kept.Edges.erase(
    std::remove_if(kept.Edges.begin(), kept.Edges.end(),
      [&](const auto& edge) { return mayLack && edges.count(Sorted(edge[0], edge[1])) == 0; }),
    kept.Edges.end());
  ExpectConstrainedDelaunay(points, kept);
  ExpectRightNumber(drawn, points, result);
}

}
}

using namespace delaunayflip;

void SetUpTarget(int* argc, char** argv)
{
  testing::InitGoogleTest(argc, argv);
  testing::GTEST_FLAG(throw_on_failure) = true;
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  JudgePointCase(MakePointCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const PointCase drawn = MakePointCase(bytes, size);
  std::cout.precision(17);
  for (const auto& point : drawn.Input.Points)
  {
    std::cout << "point " << point[0] << ' ' << point[1] << '\n';
  }
  for (std::size_t i = 0; i < drawn.Input.Segments.size(); ++i)
  {
    const auto& segment = drawn.Input.Segments[i];
    std::cout << "segment " << segment[0] << ' ' << segment[1] << " of ring "
              << drawn.Input.Rings[i] << '\n';
  }
  std::cout << "split " << drawn.Options.SplitCrossings << ", ring rule "
            << static_cast<int>(drawn.Options.RingRule) << ", first hole " << drawn.Input.FirstHole
            << ", alpha " << drawn.Options.Alpha << ", longest edge " << drawn.Options.LongestEdge
            << ", tolerance " << drawn.Options.PointTolerance << '\n';
}
