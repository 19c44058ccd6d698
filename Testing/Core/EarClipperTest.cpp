// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EarClipper.h"
#include "FlipTestSupport.h"
#include "PolygonSplit.h"
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
#include <ostream>
#include <string>

/// @file
/// Ears of large and of malformed polygons.

namespace delaunayflip
{
namespace
{

using Polygon = std::vector<PlaneVector>;
using Triangles = Triples;

Triangles Clip(const Polygon& polygon, const ProgressObserver& progress = {})
{
  return ClipEars(polygon, progress);
}

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

  Triangles Clip()
  {
    Triangles cut;
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

void PrintTo(const Family& family, std::ostream* stream) { *stream << family.Name; }

PlaneVector OnCircle(double radius, double angle)
{
  return { radius * std::cos(angle), radius * std::sin(angle) };
}

constexpr double FullTurn = 6.283185307179586;

/// Long teeth, turned by an angle.
Polygon MakeComb(int size, double angle)
{
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

/// A corridor of width 1/2 with right angles, whose triangles hold all that is inside of them.
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

/// Two chains in line, askew, one unit apart.
Polygon MakeRails(int size, std::mt19937&)
{
  Polygon polygon;
  for (int i = 0; i < size / 2; ++i)
  {
    polygon.push_back({ 3.0 * i, 7.0 * i });
  }
  for (int i = size / 2; i > 0; --i)
  {
    polygon.push_back({ 3.0 * i - 1.0, 7.0 * i + (i % 2 ? 1.0 : 2.0) });
  }
  return polygon;
}

/// A square with many points in line on its sides, and a dent that touches the opposite side.
Polygon MakeDentedSquare(int size, std::mt19937&)
{
  const int side = size / 4;
  Polygon polygon;
  const PlaneVector steps[] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
  PlaneVector at = { 0, 0 };
  for (int i = 0; i < 4 * side; ++i)
  {
    polygon.push_back(at);
    at = { at[0] + steps[i / side][0], at[1] + steps[i / side][1] };
  }
  polygon.insert(polygon.begin() + 3 * side + side / 2, { double(side), double(side / 2) });
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
  { "Comb", [](int size, std::mt19937&) { return MakeComb(size, 0.0); } },
  { "AskewComb", [](int size, std::mt19937&) { return MakeComb(size, 0.7); } },
  { "SquareSpiral", MakeSquareSpiral },
  { "Star", MakeStar },
  { "TinyStar",
    [](int size, std::mt19937& random) { return Scale(MakeStar(size, random), 1e-305); } },
  { "HugeStar",
    [](int size, std::mt19937& random) { return Scale(MakeStar(size, random), 1e305); } },
  { "FewPlaces", DrawLattice<4> },
  { "SmallLattice", DrawLattice<30> },
  { "Crossing", DrawLattice<1000000> },
  { "Rails", MakeRails },
  { "DentedSquare", MakeDentedSquare },
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
    ASSERT_EQ(ObviousClipper(polygon).Clip(), Clip(polygon)) << "case " << i;
  }
}

/// The observer is asked once for so many steps: few, where every vertex would need all others a
/// hundred times as many. And however long it takes, it can be stopped.
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
  const Triangles triangles = Clip(polygon, count);
  EXPECT_EQ(polygon.size() - 2, triangles.size());
  EXPECT_GT(60, calls);
  if (calls > 0)
  {
    EXPECT_TRUE(Clip(polygon, [](double) { return false; }).empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Families, EarClipperTest, testing::ValuesIn(Families),
  [](const auto& test) { return std::string(test.param.Name); });

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

double DoubleArea(const PlaneVector& a, const PlaneVector& b, const PlaneVector& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// As many triangles as must be, all of them the right way round and none empty, with the polygon's
/// area: they tile it.
TEST(EarClipper, TilesSimplePolygons)
{
  std::mt19937 random(7);
  CGAL::get_default_random() = CGAL::Random(7);
  for (int i = 0; i < 200 / Reduction; ++i)
  {
    const Polygon polygon = DrawSimplePolygon(5 + i / 4, random);
    const Triangles triangles = Clip(polygon);
    ASSERT_EQ(polygon.size() - 2, triangles.size());
    double area = 0.0, sum = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    {
      area += DoubleArea(polygon[0], polygon[k], polygon[k + 1]);
    }
    for (const auto& [a, b, c] : triangles)
    {
      const double part = DoubleArea(polygon[a], polygon[b], polygon[c]);
      ASSERT_GT(part, 0.0) << "polygon " << i;
      sum += part;
    }
    ASSERT_EQ(area, sum) << "polygon " << i;
  }
}

}
}
