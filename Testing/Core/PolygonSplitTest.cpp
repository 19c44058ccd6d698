// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonSplit.h"
#include "ExactReference.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace delaunayflip
{
namespace
{

using Polygon = std::vector<std::array<double, 2>>;
using Ids = std::vector<std::int64_t>;

/// Coordinates of a polygon, by default in the plane of x and y.
std::vector<double> Embed(const Polygon& polygon,
  const AffineMap& map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } })
{
  std::vector<double> points;
  for (const std::array<double, 2>& vertex : polygon)
  {
    for (const AffineRow& row : map)
    {
      points.push_back(row.X * vertex[0] + row.Y * vertex[1] + row.Offset);
    }
  }
  return points;
}

Ids Split(const std::vector<double>& points)
{
  Ids ids(points.size() / 3);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ids[i] = static_cast<std::int64_t>(i);
  }
  Ids triangles;
  const auto count = static_cast<std::int64_t>(ids.size());
  SplitPolygon(PointArray(points.data(), count), ids.data(), count, triangles);
  return triangles;
}

double DoubleArea(const Polygon& polygon, const std::array<std::int64_t, 3>& t)
{
  const auto& a = polygon[t[0]];
  const auto& b = polygon[t[1]];
  const auto& c = polygon[t[2]];
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double DoubleArea(const Polygon& polygon)
{
  double area = 0.0;
  for (std::int64_t i = 1; i + 1 < static_cast<std::int64_t>(polygon.size()); ++i)
  {
    area += DoubleArea(polygon, { 0, i, i + 1 });
  }
  return area;
}

/// The triangles tile the polygon if there are count - 2 of them, all have its winding, and their
/// areas sum to its own (coordinates are small integers, so sums are exact).
void ExpectTiles(const Polygon& polygon, const Ids& triangles)
{
  ASSERT_EQ(3 * (polygon.size() - 2), triangles.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    const double area = DoubleArea(polygon, { triangles[i], triangles[i + 1], triangles[i + 2] });
    EXPECT_GT(area * DoubleArea(polygon), 0.0) << "triangle " << i / 3;
    sum += area;
  }
  EXPECT_EQ(DoubleArea(polygon), sum);
}

/// Checks every first vertex, both directions, and several planes.
void ExpectTilesEverywhere(Polygon polygon)
{
  const AffineMap maps[] = { { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 0, 3 } } },
    { { { 0, 0, 0, 1e7 }, { 1, 0, 0, 0 }, { 0, 1, 0, 0 } } },
    { { { 0, 1, 0, 0 }, { 0, 0, 0, -2 }, { 1, 0, 0, 0 } } },
    { { { 1, 2, 0, 0 }, { -3, 1, 0, 5 }, { 1, 1, 0, 0 } } } };
  for (int direction = 0; direction < 2; ++direction)
  {
    for (std::size_t start = 0; start < polygon.size(); ++start)
    {
      for (const AffineMap& map : maps)
      {
        ExpectTiles(polygon, Split(Embed(polygon, map)));
      }
      std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
    std::reverse(polygon.begin(), polygon.end());
  }
}

TEST(SplitPolygon, KeepsATriangle)
{
  EXPECT_EQ((Ids{ 0, 1, 2 }), Split(Embed({ { 0, 0 }, { 1, 0 }, { 0, 1 } })));
}

TEST(SplitPolygon, CutsAQuadFromItsFirstVertex)
{
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), Split(Embed({ { 0, 0 }, { 9, 0 }, { 9, 1 }, { 0, 1 } })));
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), Split(Embed({ { 0, 0 }, { 0, 1 }, { 9, 1 }, { 9, 0 } })));
}

TEST(SplitPolygon, CutsAConcaveQuadInside)
{
  // The reflex corner is vertex 1, then vertex 0.
  EXPECT_EQ((Ids{ 0, 1, 3, 1, 2, 3 }), Split(Embed({ { 0, 0 }, { 2, 1 }, { 4, 0 }, { 2, 8 } })));
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), Split(Embed({ { 2, 1 }, { 4, 0 }, { 2, 8 }, { 0, 0 } })));
  ExpectTilesEverywhere({ { 0, 0 }, { 2, 1 }, { 4, 0 }, { 2, 8 } });
}

/// A narrow gable of two slopes of 63 degrees along one diagonal; gentle along the other.
std::vector<double> MakeGable(double scale, double height = 2.0)
{
  std::vector<double> quad = { 0, 4, 0, -1, 0, height, 0, -4, 0, 1, 0, height };
  for (double& coordinate : quad)
  {
    coordinate *= scale;
  }
  return quad;
}

TEST(SplitPolygon, CutsAQuadWhereItDoesNotFold)
{
  for (const double scale : { 1.0, -1.0, 0x1p-1070, 1e-200, 1e200, 4e307 })
  {
    std::vector<double> quad = MakeGable(scale);
    EXPECT_EQ((Ids{ 0, 1, 3, 1, 2, 3 }), Split(quad)) << scale;
    std::rotate(quad.begin(), quad.begin() + 3, quad.end());
    EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), Split(quad)) << scale;
  }
  EXPECT_EQ((Ids{ 0, 1, 3, 1, 2, 3 }), Split(MakeGable(1.0, 1.0))) << "a right angle";
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), Split(MakeGable(1.0, 0.99)));
}

/// Both diagonals fold, or there are no normals to speak of.
TEST(SplitPolygon, CutsFromTheFirstVertexIfFoldsDecideNothing)
{
  const Ids first = { 0, 1, 2, 0, 2, 3 };
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double height : { 9.0, infinity, -infinity, std::nan("") })
  {
    EXPECT_EQ(first, Split(MakeGable(1.0, height))) << height;
  }
  EXPECT_EQ(first, Split({ 0, 0, 0, 1, 0, 0, 1, 1e-20, 0, 0, 1e-20, 1e-40 }));
}

TEST(SplitPolygon, CutsAQuadWithAStraightVertexWithoutEmptyTriangles)
{
  ExpectTilesEverywhere({ { 0, 0 }, { 2, 0 }, { 4, 0 }, { 2, 8 } });
}

TEST(SplitPolygon, MakesAFanOfAConvexPolygon)
{
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3, 0, 3, 4 }),
    Split(Embed({ { 0, 0 }, { 2, 0 }, { 3, 2 }, { 1, 3 }, { -1, 2 } })));
}

TEST(SplitPolygon, TilesConcavePolygons)
{
  ExpectTilesEverywhere({ { 0, 0 }, { 4, 0 }, { 4, 2 }, { 2, 2 }, { 2, 4 }, { 0, 4 } });
  ExpectTilesEverywhere({ { 0, 0 }, { 6, 0 }, { 6, 6 }, { 5, 6 }, { 5, 1 }, { 4, 1 }, { 4, 6 },
    { 2, 6 }, { 2, 1 }, { 1, 1 }, { 1, 6 }, { 0, 6 } });
  ExpectTilesEverywhere({ { 0, 0 }, { 9, 0 }, { 9, 9 }, { 2, 9 }, { 2, 4 }, { 5, 4 }, { 5, 6 },
    { 4, 6 }, { 4, 7 }, { 7, 7 }, { 7, 2 }, { 0, 2 } });
}

TEST(SplitPolygon, TilesPolygonsWithStraightVertices)
{
  ExpectTilesEverywhere(
    { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 0, 2 }, { 0, 1 } });
  ExpectTilesEverywhere({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 1, 5 } });
  ExpectTilesEverywhere(
    { { 0, 0 }, { 4, 0 }, { 4, 2 }, { 3, 2 }, { 2, 2 }, { 2, 3 }, { 2, 4 }, { 0, 4 }, { 0, 2 } });
}

TEST(SplitPolygon, TilesRandomStarShapes)
{
  std::mt19937 random(8);
  for (int i = 0; i < 50; ++i)
  {
    Polygon polygon;
    const int count = 5 + DrawIndex(random, 40);
    for (int k = 0; k < count; ++k)
    {
      const double radius = 1000.0 + DrawIndex(random, 100000);
      const double angle = 6.283185307179586 * k / count;
      polygon.push_back(
        { std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle)) });
    }
    ExpectTiles(polygon, Split(Embed(polygon)));
  }
}

TEST(SplitPolygon, DecidesExactlyAtAnyScale)
{
  const Polygon dented = { { 0, 0 }, { 2, 1 }, { 4, 0 }, { 2, 8 } };
  for (double scale : { 1e-300, 1e-200, 1e200, 1e306 })
  {
    const AffineMap map = ScaleAndMove(scale, 0.0);
    EXPECT_EQ((Ids{ 0, 1, 3, 1, 2, 3 }), Split(Embed(dented, map))) << scale;
  }
}

TEST(SplitPolygon, GivesAllTrianglesOfPolygonsWithoutInside)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Polygon degenerate[] = { Polygon(7, { 1, 1 }),
    { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 }, { 5, 5 } },
    { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 }, { -1, 1 } },
    { { 0, 3 }, { 2, -3 }, { -3, 1 }, { 3, 1 }, { -2, -3 } },
    { { 0, 0 }, { nan, 0 }, { 1, 1 }, { 0, 1 }, { -1, 0.5 } },
    { { 0, 0 }, { 1, 0 }, { 0, 0 }, { 1, 0 } } };
  for (const Polygon& polygon : degenerate)
  {
    const Ids triangles = Split(Embed(polygon));
    ASSERT_EQ(3 * (polygon.size() - 2), triangles.size());
    for (std::int64_t id = 0; id < static_cast<std::int64_t>(polygon.size()); ++id)
    {
      EXPECT_EQ(1, std::count(triangles.begin(), triangles.end(), id) > 0) << id;
    }
  }
}

TEST(SplitPolygon, UsesTheGivenIdsAndAppends)
{
  const std::vector<float> points = { 9, 9, 9, 0, 0, 0, 1, 0, 0, 9, 9, 9, 1, 1, 0, 0, 1, 0 };
  const Ids ids = { 1, 2, 4, 5 };
  Ids triangles = { 7 };
  SplitPolygon(PointArray(points.data(), 6), ids.data(), 4, triangles);
  EXPECT_EQ((Ids{ 7, 1, 2, 4, 1, 4, 5 }), triangles);
}

/// Clipping the ears of a large polygon takes long: its observer is called, and can stop it.
TEST(SplitPolygon, TellsOfLargePolygons)
{
  constexpr int Spikes = 3000;
  Polygon comb;
  for (int i = 0; i < Spikes; ++i)
  {
    comb.push_back({ 2.0 * i, 0.0 });
    comb.push_back({ 2.0 * i + 1.0, 5.0 });
  }
  comb.push_back({ 2.0 * Spikes, 9.0 });
  comb.push_back({ -1.0, 9.0 });
  const std::vector<double> points = Embed(comb);
  const PointArray view(points.data(), static_cast<std::int64_t>(comb.size()));
  Ids ids(comb.size());
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<double> told;
  const auto keep = [&told](double share)
  {
    told.push_back(share);
    return true;
  };
  Ids triangles;
  EXPECT_TRUE(SplitPolygon(view, ids.data(), view.Count, triangles, keep));
  EXPECT_EQ(Split(points), triangles);
  ASSERT_LT(3u, told.size());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(1.0, told.back());

  Ids stopped = { 7 };
  int calls = 0;
  const auto stop = [&calls](double) { return ++calls < 2; };
  EXPECT_FALSE(SplitPolygon(view, ids.data(), view.Count, stopped, stop));
  EXPECT_EQ(2, calls);
  EXPECT_EQ(Ids{ 7 }, stopped);
}

Point3 Normal(const std::vector<double>& points)
{
  const std::int64_t ids[3] = { 0, 1, 2 };
  Point3 normal;
  TriangleNormal(PointArray(points.data(), 3), ids, normal.data());
  return normal;
}

TEST(TriangleNormal, HasUnitLengthAtAnyScale)
{
  for (double s : { 1.0, 5e-324, 1e-300, 1e-160, 1e160, 1e308 })
  {
    EXPECT_EQ((Point3{ 0, 0, 1 }), Normal({ 0, 0, 0, s, 0, 0, 0, s, 0 })) << s;
    EXPECT_EQ((Point3{ 0, -1, 0 }), Normal({ 0, 7, 0, s, 7, 0, 0, 7, s })) << s;
  }
  const Point3 tilted = Normal({ 1, 0, 0, 0, 1, 0, 0, 0, 1 });
  for (double component : tilted)
  {
    EXPECT_NEAR(std::sqrt(1.0 / 3.0), component, 1e-15);
  }
  EXPECT_EQ((Point3{ 0, 0, -1 }), Normal({ 0, 0, 0, 0, 1e-200, 0, 1, 0, 0 }));
}

TEST(TriangleNormal, IsZeroWithoutArea)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Point3 zero = { 0, 0, 0 };
  EXPECT_EQ(zero, Normal({ 1, 2, 3, 1, 2, 3, 1, 2, 3 }));
  EXPECT_EQ(zero, Normal({ 0, 0, 0, 1, 2, 3, 2, 4, 6 }));
  EXPECT_EQ(zero, Normal({ 0, 0, nan, 1, 0, 0, 0, 1, 0 }));
  EXPECT_EQ(zero, Normal({ 0, 0, 0, infinity, 0, 0, 0, 1, 0 }));
}

}
}
