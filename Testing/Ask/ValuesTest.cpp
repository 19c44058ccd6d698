// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AskTestSupport.h"
#include "PointSets.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_2.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Values at places among the points of a triangulation, and outside of it.

namespace delaunayflip
{
namespace
{

double Linear(double x, double y) { return 3.0 * x - 2.0 * y + 1.0; }

/// How far interpolated values are from a linear function, relative to the largest coordinate.
/// There are two components, and a place has values where it is in a triangle.
double FindWorstError(const Asked& asked, const Places& places, InterpolationKind method)
{
  std::vector<double> values;
  double size = 1.0;
  for (const Place& point : asked.Points)
  {
    values.push_back(Linear(point[0], point[1]));
    values.push_back(point[0]);
    size = std::max({ size, std::fabs(point[0]), std::fabs(point[1]) });
  }
  const std::vector<std::int32_t> found = asked.Locate(places);
  const std::vector<double> results = asked.Interpolate(values, places, method);
  double worst = 0.0;
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double x = places[i][0], y = places[i][1];
    const double error =
      std::max(std::fabs(Linear(x, y) - results[2 * i]), std::fabs(x - results[2 * i + 1]));
    wrong += (found[i] < 0) != std::isnan(error) ? 1 : 0;
    worst = error > worst ? error : worst;
  }
  EXPECT_EQ(wrong, 0);
  return worst / size;
}

/// Places in the box of the points, and a little beside it.
Places DrawPlacesInBox(const Places& points, std::mt19937& random, std::int64_t count)
{
  Place low = points.front(), high = low;
  for (const Place& point : points)
  {
    low = { std::min(low[0], point[0]), std::min(low[1], point[1]) };
    high = { std::max(high[0], point[0]), std::max(high[1], point[1]) };
  }
  std::uniform_real_distribution<double> share(-0.01, 1.01);
  Places places;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double u = share(random), v = share(random);
    places.push_back({ low[0] + u * (high[0] - low[0]), low[1] + v * (high[1] - low[1]) });
  }
  return places;
}

/// With segments and removed triangles, and among points of each kind. DELAUNAYFLIP_PLACES is the
/// number of places there, 5000 by default.
TEST(Ask, LinearFunctionsAreReproduced)
{
  std::mt19937 random(8);
  const auto expectLinear = [&](const Asked& asked, const Places& places)
  {
    for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      const double worst = FindWorstError(asked, places, method);
      EXPECT_LT(worst, method == InterpolationKind::Linear ? 1e-12 : 1e-10);
    }
  };
  const Asked survey(DrawSurvey(random, 1000));
  expectLinear(survey, DrawPlaces(survey, random, 5000 / Reduction));
  const char* const wanted = std::getenv("DELAUNAYFLIP_PLACES");
  const std::int64_t count = wanted ? std::atoll(wanted) : 5000 / Reduction;
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    // On a circle all points are neighbors of every place.
    const bool isSlow = std::string(set.Name).find("circle") != std::string::npos;
    Drawing drawing;
    drawing.Points = MakePlaces(set, isSlow ? 50 : 1000 / Reduction);
    const Asked asked(drawing);
    expectLinear(asked, DrawPlaces(asked, random, 5000 / Reduction));
    expectLinear(asked, DrawPlacesInBox(drawing.Points, random, count));
  }
}

/// The products of coordinates have 80 bits, and 34 of them cancel.
TEST(Ask, SliversHaveExactWeights)
{
  constexpr std::int64_t Far = 1000000000001;
  Drawing drawing;
  drawing.Points = { { 0.0, 0.0 }, { Far, Far + 3 }, { Far / 3, Far / 3 + 41 } };
  const Asked asked(drawing);
  for (const std::int64_t x : { Far / 3 - 9, Far / 3 + 7, Far / 2 })
  {
    const std::int64_t y = x + 20;
    const auto ofThird = static_cast<double>(__int128(Far) * y - __int128(Far + 3) * x);
    const auto ofAll =
      static_cast<double>(__int128(Far) * (Far / 3 + 41) - __int128(Far + 3) * (Far / 3));
    const std::vector<double> weight = asked.Interpolate({ 0.0, 0.0, 1.0 },
      { { static_cast<double>(x), static_cast<double>(y) } }, InterpolationKind::Linear);
    EXPECT_NEAR(ofThird / ofAll, weight[0], 1e-15);
  }
}

/// Far beyond the range of the filters, areas come from scaled points, and cavities from exact
/// tests without a tour. The results are those of small places.
TEST(Ask, ThereIsNoScale)
{
  std::mt19937 random(15);
  const Drawing drawing = DrawSurvey(random, 1000);
  Drawing scaled = drawing;
  const auto enlarge = [](Places& places)
  {
    for (Place& place : places)
    {
      place = { std::ldexp(place[0], 600), std::ldexp(place[1], 600) };
    }
  };
  enlarge(scaled.Points);
  const Asked asked(drawing);
  const Asked large(scaled);
  std::vector<double> values;
  for (const Place& point : asked.Points)
  {
    values.push_back(std::sin(5.0 * point[0]) * point[1]);
  }
  const Places places = DrawPlaces(asked, random, 20000 / Reduction);
  Places placesOfLarge = places;
  enlarge(placesOfLarge);
  for (const InterpolationKind method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    const std::vector<double> expected = asked.Interpolate(values, places, method);
    const std::vector<double> found = large.Interpolate(values, placesOfLarge, method);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      ASSERT_EQ(std::isnan(expected[i]), std::isnan(found[i]));
      if (!std::isnan(expected[i]))
      {
        ASSERT_NEAR(expected[i], found[i], 1e-12) << places[i][0] << ' ' << places[i][1];
      }
    }
  }
}

TEST(Ask, NaturalNeighborsAreCgals)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Delaunay_triangulation_2<Kernel>;
  std::mt19937 random(9);
  Drawing drawing;
  std::map<Kernel::Point_2, double> valueAt;
  std::vector<double> values;
  for (int i = 0; i < 3000 / Reduction; ++i)
  {
    const double x = DrawIndex(random, 1 << 20) / 1048576.0;
    const double y = DrawIndex(random, 1 << 20) / 1048576.0;
    drawing.Points.push_back({ x, y });
    values.push_back(std::sin(7.0 * x) + y * y);
    valueAt[{ x, y }] = values.back();
  }
  const Asked asked(drawing);
  Triangulation reference;
  for (const auto& item : valueAt)
  {
    reference.insert(item.first);
  }
  const Places places = DrawPlaces(asked, random, 20000 / Reduction);
  const std::vector<double> results = asked.Interpolate(values, places, InterpolationKind::Natural);
  int compared = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    std::vector<std::pair<Kernel::Point_2, double>> weights;
    const auto found = CGAL::natural_neighbor_coordinates_2(
      reference, Kernel::Point_2(places[i][0], places[i][1]), std::back_inserter(weights));
    if (!found.third)
    {
      continue;
    }
    double expected = 0.0;
    for (const auto& [point, weight] : weights)
    {
      expected += weight / found.second * valueAt[point];
    }
    ++compared;
    ASSERT_NEAR(expected, results[i], 1e-9) << places[i][0] << ' ' << places[i][1];
  }
  EXPECT_LT(15000 / Reduction, compared);
  // Sums of large values do not overflow. Other values of the points keep their bits.
  std::vector<double> both;
  for (const double value : values)
  {
    both.insert(both.end(), { std::ldexp(value, 1022), value });
  }
  const std::vector<double> found = asked.Interpolate(both, places, InterpolationKind::Natural);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double large = std::ldexp(results[i], 1022);
    ASSERT_EQ(std::memcmp(&found[2 * i], &large, sizeof(large)), 0) << results[i];
    ASSERT_EQ(std::memcmp(&found[2 * i + 1], &results[i], sizeof(large)), 0) << results[i];
  }
}

/// By hand: over all edges that one triangle has.
TEST(Ask, NearestPlacesOnTheBoundary)
{
  std::mt19937 random(11);
  for (const int count : { 4, 40, 600 })
  {
    const Asked asked(DrawSurvey(random, count));
    const Places places = DrawPlaces(asked, random, 1000 / Reduction);
    std::vector<double> values;
    for (const Place& point : asked.Points)
    {
      values.push_back(point[0]);
      values.push_back(point[1]);
    }
    const std::vector<std::int32_t> found = asked.Locate(places);
    const std::vector<double> results =
      asked.Interpolate(values, places, InterpolationKind::Linear, OutsideKind::Nearest);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const double x = results[2 * i] - places[i][0], y = results[2 * i + 1] - places[i][1];
      const double expected = found[i] < 0 ? asked.FindDistance(places[i]) : 0.0;
      ASSERT_NEAR(expected, std::hypot(x, y), 1e-14) << places[i][0] << ' ' << places[i][1];
    }
    const std::vector<double> far = asked.Interpolate(values, { { 1e300, -1e300 }, { NAN, 0.0 } },
      InterpolationKind::Natural, OutsideKind::Nearest);
    EXPECT_TRUE(std::isfinite(far[0]) && std::isfinite(far[1]) && std::isnan(far[2]));
  }
}

/// The area of this sliver is lost in rounding, but for four digits.
TEST(Ask, SliversMayHaveNoMeasurableArea)
{
  Drawing drawing;
  drawing.Points = { { 1.2472210230301148e+35, -1.6615349947311447e+35 },
    { -1.247221023030115e+35, -1.6615349947311447e+35 }, { -34851913.0, 1.1805916207174112e+21 },
    { 34851913.0, 1.1805916207174112e+21 } };
  drawing.Segments = { { 1, 0 }, { 0, 3 }, { 1, 2 } };
  drawing.Rings = { -1, -1, -1 };
  const Asked asked(drawing);
  const Place place = { 6.2361051151505739e+34, -8.3076749736556643e+34 };
  std::vector<double> values;
  for (const Place& point : asked.Points)
  {
    values.push_back(point[0] / 1e35);
  }
  for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    EXPECT_NEAR(place[0] / 1e35, asked.Interpolate(values, { place }, method).front(), 1e-9);
  }
}

/// Two natural weights of 3e81 cancel in this sliver, and with them the sum.
TEST(Ask, NaturalWeightsMayCancel)
{
  constexpr double Unit = 0x1p-268;
  Drawing drawing;
  drawing.Points = { { 1.5 * Unit, 0.5 * Unit }, { Unit, 0.0 }, { Unit, 1.5 * Unit },
    { 1.5 * Unit, 0.0 }, { 0.0, 0.0 }, { 0.5 * Unit, 1.5 * Unit }, { 0x1p-537, 1.5 * 0x1p-536 },
    { 0x1p-537, 0.0 }, { 0.0, 1.5 * 0x1p-536 } };
  drawing.Segments = { { 8, 7 }, { 7, 5 } };
  drawing.Rings = { -1, -1 };
  const Asked asked(drawing);
  std::vector<double> values;
  for (const Place& point : asked.Points)
  {
    values.push_back(point[1] / Unit);
  }
  const Place place = { 0.375 * Unit, 1.125 * Unit };
  for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    EXPECT_NEAR(1.125, asked.Interpolate(values, { place }, method).front(), 1e-9);
  }
}

/// Far away the nearest place is the vertex that is the farthest in the direction of the place.
TEST(Ask, NearestPlacesOfFarPlaces)
{
  std::mt19937 random(14);
  for (const double size : { 1.0, 1e-290, 1e290 })
  {
    Drawing drawing;
    std::vector<double> values;
    for (int i = 0; i < 300; ++i)
    {
      drawing.Points.push_back(
        { size * (DrawIndex(random, 1025) / 1024.0), size * (DrawIndex(random, 1025) / 1024.0) });
      values.push_back(i);
    }
    const Asked asked(drawing);
    Places places;
    std::vector<double> expected;
    for (int i = 0; i < 1000; ++i)
    {
      const double angle = 0.0123 + 2.0 * 3.14159265358979 * DrawIndex(random, 4096) / 4096;
      const double u = std::cos(angle), v = std::sin(angle);
      const double distance = std::min(1e307, size * std::pow(10.0, 8 + i * 0.59));
      places.push_back({ u * distance, v * distance });
      const auto along = [&](const Place& p) { return u * (p[0] / size) + v * (p[1] / size); };
      const auto farthest = std::max_element(drawing.Points.begin(), drawing.Points.end(),
        [&](const Place& a, const Place& b) { return along(a) < along(b); });
      expected.push_back(static_cast<double>(farthest - drawing.Points.begin()));
    }
    for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      EXPECT_EQ(expected, asked.Interpolate(values, places, method, OutsideKind::Nearest)) << size;
    }
  }
}

/// Points outside of the outline do not matter, wherever they are.
TEST(Ask, NearestPlacesBesideFarPoints)
{
  for (const double far : { 10.0, 1e200, 1e300 })
  {
    Drawing drawing;
    drawing.AddRing({ { 1, 1 }, { 3, 1 }, { 3, 2 }, { 1, 2 } });
    drawing.Points.push_back({ far, 0.0 });
    const Asked asked(drawing);
    const Places places = { { 4, 1.5 }, { 0, 1.5 }, { 2.25, 5 } };
    EXPECT_EQ((std::vector<double>{ 3, 1, 2.25 }),
      asked.Interpolate({ 1, 3, 3, 1, 0 }, places, InterpolationKind::Linear, OutsideKind::Nearest))
      << far;
  }
}

/// Beside an edge that is straight up the nearest place is at the height of the place.
TEST(Ask, NearestPlacesBesideAnEdge)
{
  Drawing drawing;
  drawing.Points = { { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 2.0 }, { 4.0, 4.0 }, { 0.0, 4.0 } };
  const Asked asked(drawing);
  const std::vector<double> heights = { 0.0, 0.0, 2.0, 4.0, 4.0 };
  Places places;
  std::vector<double> expected;
  for (const double far : { 5.0, 1e6, 1e10, 1e20, 1e36, 1e155, 1e300, 1.7e308 })
  {
    for (const double height : { 0.0, 1.0, 2.0, 3.0, 4.0 })
    {
      places.push_back({ far, height });
      places.push_back({ -far, height });
      expected.insert(expected.end(), 2, height);
    }
    places.push_back({ far, -far });
    places.push_back({ far, far });
    expected.insert(expected.end(), { 0.0, 4.0 });
  }
  EXPECT_EQ(
    expected, asked.Interpolate(heights, places, InterpolationKind::Linear, OutsideKind::Nearest));
}

/// Far away in the direction of an edge's normal, products of coordinates cancel. From about 1e16
/// on the place itself has lost where the mesh is, and the nearest place is that of the origin.
TEST(Ask, NearestPlacesAlongANormal)
{
  Drawing drawing;
  drawing.Points = { { 4.0, -1.0 }, { 1.0, 5.0 }, { -6.0, 2.0 }, { -2.0, -5.0 } };
  const Asked asked(drawing);
  std::vector<double> values;
  for (const Place& point : drawing.Points)
  {
    values.insert(values.end(), { point[0], point[1] });
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Place& from = drawing.Points[i];
    const Place& to = drawing.Points[(i + 1) % 4];
    const double u = to[0] - from[0], v = to[1] - from[1];
    for (int exponent = 0; exponent < 980; exponent += exponent < 70 ? 1 : 50)
    {
      const double far = std::ldexp(1.0, exponent);
      // Exact, and then the sum with a corner is either exact or the multiple of the normal.
      const bool isCornerKept = exponent < 48;
      const double share = isCornerKept ? 0.25 : -(from[0] * u + from[1] * v) / (u * u + v * v);
      const Place foot = { from[0] + share * u, from[1] + share * v };
      Place place = { far * v, -far * u };
      if (isCornerKept)
      {
        place = { foot[0] + place[0], foot[1] + place[1] };
      }
      const std::vector<double> found =
        asked.Interpolate(values, { place }, InterpolationKind::Linear, OutsideKind::Nearest);
      EXPECT_NEAR(foot[0], found[0], 1e-14) << i << ' ' << exponent;
      EXPECT_NEAR(foot[1], found[1], 1e-14) << i << ' ' << exponent;
    }
  }
}

/// Places at both sides of edges: of triangles, of cavities and of segments.
TEST(Ask, NaturalNeighborsAreContinuous)
{
  std::mt19937 random(12);
  const Asked asked(DrawSurvey(random, 400));
  std::vector<double> values;
  for (const Place& point : asked.Points)
  {
    values.push_back(std::sin(9.0 * point[0]) + point[1] * point[1]);
  }
  constexpr double Step = 1e-7;
  Places places;
  for (std::size_t i = 0; i < asked.Triangles.size(); ++i)
  {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const Place& a = asked.Points[asked.Triangles[i]];
    const Place& b = asked.Points[asked.Triangles[next]];
    const Place on = { 0.3 * a[0] + 0.7 * b[0], 0.3 * a[1] + 0.7 * b[1] };
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double u = Step * (a[1] - b[1]) / length, v = Step * (b[0] - a[0]) / length;
    places.push_back({ on[0] + u, on[1] + v });
    places.push_back(on);
    places.push_back({ on[0] - u, on[1] - v });
  }
  const std::vector<double> results = asked.Interpolate(values, places, InterpolationKind::Natural);
  for (std::size_t i = 0; i < places.size(); i += 3)
  {
    for (const std::size_t side : { i, i + 2 })
    {
      if (!std::isnan(results[side]) && !std::isnan(results[i + 1]))
      {
        ASSERT_NEAR(results[i + 1], results[side], 1e-4) << places[i][0] << ' ' << places[i][1];
      }
    }
  }
}

}
}
