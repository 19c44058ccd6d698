// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonSplit.h"
#include "EarClipper.h"
#include "FlipTestSupport.h"
#include "Predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Random.h>
#include <CGAL/random_polygon_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

/// @file
/// Polygons as triangles: quads and fans, and the ears of large and of malformed polygons.

namespace delaunayflip
{
namespace
{

using Polygon = std::vector<PlaneVector>;
using Ids = std::vector<std::int64_t>;

/// Coordinates of a polygon, by default in the plane of x and y.
std::vector<double> Embed(const Polygon& polygon,
  const AffineMap& map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } })
{
  std::vector<double> points;
  for (const PlaneVector& vertex : polygon)
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
  std::iota(ids.begin(), ids.end(), 0);
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

//------------------------------------------------------------------------------
/// The order of cuts that ClipEars promises, in the obvious way: every vertex is looked at, and
/// for each all others.
class ObviousClipper
{
public:
  explicit ObviousClipper(const Polygon& polygon)
    : Points(polygon),
      Ring(polygon.size())
  {
    std::iota(this->Ring.begin(), this->Ring.end(), 0);
  }

  Triples Clip()
  {
    Triples cut;
    std::size_t at = 0;
    while (this->Ring.size() > 3)
    {
      std::size_t ear = at;
      std::size_t looks = 0;
      for (; looks < this->Ring.size() && !this->IsEar(ear); ++looks)
      {
        ear = (ear + 1) % this->Ring.size();
      }
      cut.push_back(this->GetTriangle(ear));
      this->Ring.erase(this->Ring.begin() + static_cast<std::ptrdiff_t>(ear));
      at = (ear + 1) % this->Ring.size();
    }
    cut.push_back(this->GetTriangle(at));
    return cut;
  }

private:
  std::array<std::int64_t, 3> GetTriangle(std::size_t i) const
  {
    const std::size_t size = this->Ring.size();
    return { this->Ring[(i + size - 1) % size], this->Ring[i], this->Ring[(i + 1) % size] };
  }

  int Turn(std::int64_t a, std::int64_t b, std::int64_t c) const
  {
    return Orientation(this->Points[a].data(), this->Points[b].data(), this->Points[c].data());
  }

  bool IsEar(std::size_t i) const
  {
    const auto [a, b, c] = this->GetTriangle(i);
    const auto blocks = [&, a = a, b = b, c = c](std::int64_t p)
    {
      const PlaneVector& x = this->Points[p];
      return x != this->Points[a] && x != this->Points[b] && x != this->Points[c] &&
        this->Turn(a, b, p) >= 0 && this->Turn(b, c, p) >= 0 && this->Turn(c, a, p) >= 0;
    };
    return this->Turn(a, b, c) > 0 && std::none_of(this->Ring.begin(), this->Ring.end(), blocks);
  }

  const Polygon& Points;
  std::vector<std::int64_t> Ring;
};

struct Family
{
  const char* Name;
  Polygon (*Make)(int size, std::mt19937& random);
};

PlaneVector OnCircle(double radius, double angle)
{
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

constexpr double FullTurn = 6.283185307179586;

/// Long teeth, askew.
Polygon MakeComb(int size, std::mt19937&)
{
  const double angle = 0.7;
  Polygon polygon = { { 0.0, -1.0 }, { size / 4.0, -1.0 } };
  for (int i = size / 4; i > 0; --i)
  {
    const double x = i, height = 100.0 * size;
    polygon.insert(
      polygon.end(), { { x, 0.0 }, { x, height }, { x - 0.5, height }, { x - 0.5, 0.0 } });
  }
  for (PlaneVector& p : polygon)
  {
    p = { std::cos(angle) * p[0] - std::sin(angle) * p[1],
      std::sin(angle) * p[0] + std::cos(angle) * p[1] };
  }
  return polygon;
}

/// A corridor of width 1/2 with right angles. Its triangles hold all that is inside of them.
Polygon MakeSquareSpiral(int size, std::mt19937&)
{
  Polygon outer, inner;
  const PlaneVector steps[] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  PlaneVector at = { 0, 0 };
  for (int i = 0; i < size / 2; ++i)
  {
    const PlaneVector& leaving = steps[i % 4];
    const PlaneVector& coming = steps[(i + 3) % 4];
    outer.push_back(at);
    inner.push_back({ at[0] - 0.5 * (leaving[1] + (i > 0 ? coming[1] : 0.0)),
      at[1] + 0.5 * (leaving[0] + (i > 0 ? coming[0] : 0.0)) });
    const double length = i / 2 * 2 + 2;
    at = { at[0] + length * leaving[0], at[1] + length * leaving[1] };
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

Polygon MakeStar(int size, std::mt19937& random)
{
  Polygon polygon;
  for (int i = 0; i < size; ++i)
  {
    polygon.push_back(OnCircle(0.001 + 1e-5 * DrawIndex(random, 100000), FullTurn * i / size));
  }
  return polygon;
}

Polygon Scale(Polygon polygon, double factor)
{
  for (PlaneVector& p : polygon)
  {
    p = { factor * p[0], factor * p[1] };
  }
  return polygon;
}

/// Points of a lattice in any order: crossing, touching, repeated and in line where it is small.
template <int Width>
Polygon DrawLattice(int size, std::mt19937& random)
{
  Polygon polygon;
  for (int i = 0; i < size; ++i)
  {
    polygon.push_back({ double(DrawIndex(random, Width)), double(DrawIndex(random, Width)) });
  }
  return polygon;
}

/// A ring of holes, each joined to the next by a bridge that the polygon runs through twice.
Polygon MakeKeyholes(int size, std::mt19937&)
{
  const int holes = size / 8 + 1;
  Polygon polygon = { { -10, -10 }, { 10.0 * holes, -10 }, { 10.0 * holes, 10 }, { -10, 10 },
    { -10, 0 } };
  for (int i = 0; i < holes; ++i)
  {
    polygon.insert(polygon.end(), { { 10.0 * i, 0 }, { 10.0 * i + 2, 3 }, { 10.0 * i + 4, 0 } });
  }
  for (int i = holes; i-- > 0;)
  {
    polygon.insert(polygon.end(), { { 10.0 * i + 4, 0 }, { 10.0 * i + 2, -3 }, { 10.0 * i, 0 } });
  }
  polygon.push_back({ -10, 0 });
  return polygon;
}

/// Fifty turns of one circle, as a helix looks from above.
Polygon MakeCoil(int size, std::mt19937&)
{
  Polygon polygon;
  for (int i = 0; i < size; ++i)
  {
    polygon.push_back(OnCircle(1.0, 50.0 * FullTurn * i / size));
  }
  return polygon;
}

/// Some points are NaN or infinite.
Polygon MakeBrokenStar(int size, std::mt19937& random)
{
  Polygon polygon = MakeStar(size, random);
  polygon[DrawIndex(random, size)][0] = std::numeric_limits<double>::quiet_NaN();
  polygon[DrawIndex(random, size)][1] = std::numeric_limits<double>::infinity();
  return polygon;
}

const Family Families[] = {
  { "Comb", MakeComb },
  { "SquareSpiral", MakeSquareSpiral },
  { "Star", MakeStar },
  { "TinyStar",
    [](int size, std::mt19937& random) { return Scale(MakeStar(size, random), 1e-305); } },
  { "HugeStar",
    [](int size, std::mt19937& random) { return Scale(MakeStar(size, random), 1e305); } },
  { "FewPlaces", DrawLattice<4> },
  { "SmallLattice", DrawLattice<30> },
  { "Crossing", DrawLattice<1000000> },
  { "Keyholes", MakeKeyholes },
  { "Coil", MakeCoil },
  { "BrokenStar", MakeBrokenStar },
  { "OnePlace",
    [](int size, std::mt19937&) {
      return Polygon(size, { 1, 1 });
    } },
};

class EarClipperTest : public testing::TestWithParam<Family>
{
};

TEST_P(EarClipperTest, CutsInTheOrderOfTheWalk)
{
  std::mt19937 random(5);
  for (int i = 0; i < 60 / Reduction; ++i)
  {
    Polygon polygon = GetParam().Make(5 + DrawIndex(random, 12 + 2 * i), random);
    std::rotate(polygon.begin(), polygon.begin() + DrawIndex(random, 5), polygon.end());
    if (i % 3 == 0)
    {
      std::reverse(polygon.begin(), polygon.end());
    }
    ASSERT_EQ(ObviousClipper(polygon).Clip(), ClipEars(polygon, {})) << "case " << i;
  }
}

/// The observer is asked once for so many steps: few, where every vertex would need all others a
/// hundred times as many. It can be stopped, however long it takes.
TEST_P(EarClipperTest, NeedsFewStepsForTenThousandCorners)
{
  std::mt19937 random(6);
  const Polygon polygon = GetParam().Make(10000, random);
  int calls = 0;
  const auto count = [&](double)
  {
    ++calls;
    return true;
  };
  const Triples triangles = ClipEars(polygon, count);
  EXPECT_EQ(polygon.size() - 2, triangles.size());
  EXPECT_GT(60, calls);
  if (calls > 0)
  {
    EXPECT_TRUE(ClipEars(polygon, [](double) { return false; }).empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EarClipperTest, testing::ValuesIn(Families), GetCaseName);

/// Simple polygons that are as crooked as chance makes them: CGAL's, with the middle of some sides.
Polygon DrawSimplePolygon(int size, std::mt19937& random)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  for (int i = 0; i < size; ++i)
  {
    const double x = 2.0 * DrawIndex(random, 1 << 20);
    points.emplace_back(x, 2.0 * DrawIndex(random, 1 << 20));
  }
  CGAL::Polygon_2<Kernel> polygon;
  CGAL::random_polygon_2(points.size(), std::back_inserter(polygon), points.begin());
  EXPECT_TRUE(polygon.is_simple());
  if (polygon.is_clockwise_oriented())
  {
    polygon.reverse_orientation();
  }
  Polygon result;
  for (auto side = polygon.edges_begin(); side != polygon.edges_end(); ++side)
  {
    const Kernel::Point_2 from = side->source(), to = side->target();
    result.push_back({ from.x(), from.y() });
    if (DrawIndex(random, 3) == 0)
    {
      result.push_back({ 0.5 * (from.x() + to.x()), 0.5 * (from.y() + to.y()) });
    }
  }
  return result;
}

TEST(SplitPolygon, TilesSimplePolygons)
{
  std::mt19937 random(7);
  CGAL::get_default_random() = CGAL::Random(7);
  for (int i = 0; i < 100 / Reduction && !testing::Test::HasFailure(); ++i)
  {
    SCOPED_TRACE(i);
    ExpectTilesEverywhere(DrawSimplePolygon(4 + i / 3, random));
  }
}

//------------------------------------------------------------------------------
TEST(SplitPolygon, CutsFromTheFirstVertexIfItCan)
{
  struct Case
  {
    Polygon Corners;
    Ids Triangles;
  };
  const Case cases[] = {
    { { { 0, 0 }, { 1, 0 }, { 0, 1 } }, { 0, 1, 2 } },
    { { { 0, 0 }, { 9, 0 }, { 9, 1 }, { 0, 1 } }, { 0, 1, 2, 0, 2, 3 } },
    { { { 0, 0 }, { 0, 1 }, { 9, 1 }, { 9, 0 } }, { 0, 1, 2, 0, 2, 3 } },
    { { { 0, 0 }, { 2, 0 }, { 3, 2 }, { 1, 3 }, { -1, 2 } }, { 0, 1, 2, 0, 2, 3, 0, 3, 4 } },
    // The reflex corner is vertex 1, then vertex 0.
    { { { 0, 0 }, { 2, 1 }, { 4, 0 }, { 2, 8 } }, { 0, 1, 3, 1, 2, 3 } },
    { { { 2, 1 }, { 4, 0 }, { 2, 8 }, { 0, 0 } }, { 0, 1, 2, 0, 2, 3 } },
  };
  for (const Case& one : cases)
  {
    for (double scale : { 1e-300, 1e-200, 1.0, 1e200, 1e306 })
    {
      EXPECT_EQ(one.Triangles, Split(Embed(one.Corners, ScaleAndMove(scale, 0.0)))) << scale;
    }
  }
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

TEST(SplitPolygon, UsesTheGivenIdsAndAppends)
{
  const std::vector<float> points = { 9, 9, 9, 0, 0, 0, 1, 0, 0, 9, 9, 9, 1, 1, 0, 0, 1, 0 };
  const Ids ids = { 1, 2, 4, 5 };
  Ids triangles = { 7 };
  SplitPolygon(PointArray(points.data(), 6), ids.data(), 4, triangles);
  EXPECT_EQ((Ids{ 7, 1, 2, 4, 1, 4, 5 }), triangles);
}

/// Triangles written as quads, and rings closed by their first point, have such corners.
TEST(SplitPolygon, DropsRepeatedCorners)
{
  const std::vector<double> points = { 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 0 };
  const PointArray view(points.data(), 5);
  const auto split = [&](const Ids& ids)
  {
    Ids triangles;
    EXPECT_TRUE(SplitPolygon(view, ids.data(), static_cast<std::int64_t>(ids.size()), triangles));
    return triangles;
  };
  for (const Ids& ids :
    { Ids{ 0, 1, 2, 2 }, Ids{ 0, 0, 1, 2 }, Ids{ 0, 1, 2, 0 }, Ids{ 0, 1, 1, 1, 2, 0, 0 } })
  {
    EXPECT_EQ((Ids{ 0, 1, 2 }), split(ids));
  }
  EXPECT_EQ((Ids{ 0, 1, 2, 0, 2, 3 }), split({ 0, 1, 2, 3, 0, 0 }));
  for (const Ids& ids : { Ids{ 3, 3, 3, 3 }, Ids{ 0, 1, 1, 0 }, Ids{ 0, 0, 1, 1, 0 },
         Ids{ 0, 1, 0, 1 }, Ids{ 1, 1, 0, 1, 0 } })
  {
    EXPECT_EQ(Ids(), split(ids));
  }
  EXPECT_EQ((Ids{ 0, 1, 1 }), split({ 0, 1, 1 })) << "a triangle given as such";
}

/// Clipping the ears of a large polygon takes long: its observer is called, and can stop it.
TEST(SplitPolygon, TellsOfLargePolygons)
{
  std::mt19937 random(8);
  const std::vector<double> points = Embed(MakeComb(10000, random));
  Ids ids(points.size() / 3);
  std::iota(ids.begin(), ids.end(), 0);
  const PointArray view(points.data(), static_cast<std::int64_t>(ids.size()));
  for (const bool stops : { false, true })
  {
    std::vector<double> told;
    const auto observer = [&](double share)
    {
      told.push_back(share);
      return !stops || told.size() < 2;
    };
    Ids triangles = { 7 };
    EXPECT_EQ(!stops, SplitPolygon(view, ids.data(), view.Count, triangles, observer));
    EXPECT_EQ(stops ? 1 : 1 + 3 * (ids.size() - 2), triangles.size());
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_GE(1.0, told.back());
    EXPECT_TRUE(stops ? told.size() == 2 : told.size() > 3);
  }
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
