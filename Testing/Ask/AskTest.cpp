// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointSets.h"
#include "PointTestSupport.h"
#include "Predicates.h"
#include "RandomInputs.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

/// @file
/// What a triangulation of points answers: the triangles of places, and values there.

namespace delaunayflip
{
namespace
{

double Linear(double x, double y) { return 3.0 * x - 2.0 * y + 1.0; }

/// A session, what it makes, and answers to queries.
class Asked
{
public:
  explicit Asked(const Drawing& drawing, const PointOptions& options = {})
    : Points(drawing.Points),
      Session(FlipPoints(drawing.View(), options)),
      Triangles(3 * Session.GetReport().Triangles)
  {
    this->Session.StoreTriangles(
      MutableTriangleArray(this->Triangles.data(), this->Session.GetReport().Triangles));
    for (const AddedPoint& point : this->Session.GetAddedPoints())
    {
      this->Points.push_back({ point.X, point.Y });
    }
  }

  std::vector<std::int32_t> Locate(const Places& places) const
  {
    std::vector<std::int32_t> found(places.size(), -2);
    PlaceQuery query;
    query.Places = View(places);
    query.Triangles = found.data();
    EXPECT_TRUE(this->Session.Ask(query));
    return found;
  }

  std::vector<double> Interpolate(const std::vector<double>& values, const Places& places,
    InterpolationKind method, OutsideKind outside = OutsideKind::NotANumber) const
  {
    std::vector<double> results(places.size() * values.size() / this->Points.size(), -1e99);
    PlaceQuery query;
    query.Places = View(places);
    query.Values = values.data();
    query.Components = static_cast<int>(values.size() / this->Points.size());
    query.Method = method;
    query.Outside = outside;
    query.Results = results.data();
    EXPECT_TRUE(this->Session.Ask(query));
    return results;
  }

  /// By exact orientation, of all triangles the first that has the place.
  std::int32_t FindByHand(const Place& place) const
  {
    for (std::size_t t = 0; t < this->Triangles.size() / 3; ++t)
    {
      bool isInside = true;
      for (int i = 0; i < 3 && isInside; ++i)
      {
        const Place& a = this->Points[this->Triangles[3 * t + i]];
        const Place& b = this->Points[this->Triangles[3 * t + (i + 1) % 3]];
        isInside = Orientation(a.data(), b.data(), place.data()) >= 0;
      }
      if (isInside)
      {
        return static_cast<std::int32_t>(t);
      }
    }
    return -1;
  }

  /// From the edges that one triangle has.
  double FindDistance(const Place& place) const
  {
    std::map<std::pair<std::int32_t, std::int32_t>, int> triangles;
    for (std::size_t i = 0; i < this->Triangles.size(); ++i)
    {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      ++triangles[std::minmax(this->Triangles[i], this->Triangles[next])];
    }
    double distance = INFINITY;
    for (const auto& [edge, count] : triangles)
    {
      if (count == 1)
      {
        distance = std::min(
          distance, this->FindDistance(place, this->Points[edge.first], this->Points[edge.second]));
      }
    }
    return distance;
  }

  static double FindDistance(const Place& place, const Place& a, const Place& b)
  {
    const double u = b[0] - a[0], v = b[1] - a[1];
    const double along = ((place[0] - a[0]) * u + (place[1] - a[1]) * v) / (u * u + v * v);
    const double share = std::clamp(along, 0.0, 1.0);
    return std::hypot(a[0] + share * u - place[0], a[1] + share * v - place[1]);
  }

  Places Points;
  FlipSession Session;
  std::vector<std::int32_t> Triangles;
};

/// Places of every kind: in triangles, on edges, on vertices, in removed triangles, outside.
Places DrawPlaces(const Asked& asked, std::mt19937& random, int count)
{
  const auto draw = [&] { return DrawIndex(random, 1025) / 1024.0; };
  const auto pick = [&] { return asked.Points[DrawIndex(random, asked.Points.size())]; };
  Places places;
  for (int i = 0; i < count; ++i)
  {
    const Place a = pick(), b = pick();
    switch (i % 5)
    {
      case 0:
        places.push_back(a);
        break;
      case 1: // often on an edge, or exactly between two points of a lattice
        places.push_back({ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]) });
        break;
      case 2:
        places.push_back({ a[0], b[1] });
        break;
      case 3:
        places.push_back({ a[0] + 0.01 * (draw() - 0.5), a[1] + 0.01 * (draw() - 0.5) });
        break;
      default:
        places.push_back({ 1.2 * draw() - 0.1, 1.2 * draw() - 0.1 });
    }
  }
  return places;
}

/// Random points, some on a lattice, with an outline, a hole and a breakline.
Drawing DrawSurvey(std::mt19937& random, int count)
{
  Drawing drawing;
  for (int i = 0; i < count; ++i)
  {
    const double x = DrawIndex(random, 1025) / 1024.0, y = DrawIndex(random, 1025) / 1024.0;
    const bool isOnLattice = i % 3 == 0;
    drawing.Points.push_back(
      isOnLattice ? Place{ std::floor(8 * x) / 8, std::floor(8 * y) / 8 } : Place{ x, y });
  }
  drawing.AddRing({ { 0.0625, 0.0625 }, { 1.0, 0.125 }, { 0.9375, 0.9375 }, { 0.125, 1.0 } });
  drawing.FirstHole = 1;
  drawing.AddRing({ { 0.375, 0.375 }, { 0.625, 0.375 }, { 0.5, 0.625 } });
  const auto first = static_cast<std::int64_t>(drawing.Points.size());
  drawing.Points.push_back({ 0.25, 0.25 });
  drawing.Points.push_back({ 0.25, 0.875 });
  drawing.Segments.push_back({ first, first + 1 });
  drawing.Rings.push_back(-1);
  return drawing;
}

TEST(Ask, LocateFindsTheLowestTriangle)
{
  std::mt19937 random(7);
  for (const int count : { 3, 5, 20, 100, 400 })
  {
    const Asked asked(DrawSurvey(random, count));
    const Places places = DrawPlaces(asked, random, 2000 / Reduction);
    const std::vector<std::int32_t> found = asked.Locate(places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      ASSERT_EQ(asked.FindByHand(places[i]), found[i]) << places[i][0] << ' ' << places[i][1];
    }
  }
}

/// Refinement puts rounded points on the hull, which is then a little concave.
TEST(Ask, LocateFindsPlacesOnASplitHull)
{
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round)
  {
    Drawing drawing;
    const int corners = 3 + round % 40;
    for (int i = 0; i < corners; ++i)
    {
      drawing.Points.push_back(
        { DrawIndex(random, 1000) / 997.0, DrawIndex(random, 1000) / 991.0 });
    }
    PointOptions options;
    options.MinimumAngle = 25.0;
    options.MaximumEdge = round % 3 == 0 ? 0.07 : 0.0;
    const Asked asked(drawing, options);
    Places places = asked.Points;
    for (std::size_t i = 0; i + 2 < asked.Triangles.size(); i += 3) // also the middles of edges
    {
      const Place& a = asked.Points[asked.Triangles[i]];
      const Place& b = asked.Points[asked.Triangles[i + 1]];
      places.push_back({ (a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0 });
    }
    const std::vector<std::int32_t> found = asked.Locate(places);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      ASSERT_EQ(found[i], asked.FindByHand(places[i])) << "round " << round << ", place " << i;
    }
  }
}

TEST(Ask, NothingIsThere)
{
  const Place notFinite = { NAN, 0.0 };
  const Asked empty(Drawing{});
  EXPECT_EQ(std::vector<std::int32_t>({ -1 }), empty.Locate({ { 0.0, 0.0 } }));
  Drawing one;
  one.Points = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  const Asked asked(one);
  EXPECT_EQ(std::vector<std::int32_t>({ -1, -1, 0 }),
    asked.Locate({ notFinite, { INFINITY, 0.0 }, { 0.0, 0.0 } }));
  const std::vector<double> values = asked.Interpolate(
    { 1.0, 2.0, 3.0 }, { notFinite, { 1.0, 1.0 }, { 0.25, 0.25 } }, InterpolationKind::Natural);
  EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[1]));
  EXPECT_DOUBLE_EQ(1.75, values[2]);
}

/// Several components, with segments and removed triangles, and on points of all kinds.
TEST(Ask, LinearFunctionsAreReproduced)
{
  std::mt19937 random(8);
  const auto expectLinear = [&](const Asked& asked, double size)
  {
    std::vector<double> values;
    for (const Place& point : asked.Points)
    {
      values.push_back(Linear(point[0], point[1]));
      values.push_back(point[0]);
    }
    const Places places = DrawPlaces(asked, random, 5000 / Reduction);
    const std::vector<std::int32_t> found = asked.Locate(places);
    for (const InterpolationKind method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      const double tolerance = method == InterpolationKind::Linear ? 1e-12 : 1e-9;
      const std::vector<double> results = asked.Interpolate(values, places, method);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        const double x = places[i][0], y = places[i][1];
        ASSERT_EQ(found[i] < 0, std::isnan(results[2 * i]));
        if (found[i] >= 0)
        {
          ASSERT_NEAR(Linear(x, y), results[2 * i], tolerance * size) << x << ' ' << y;
          ASSERT_NEAR(x, results[2 * i + 1], tolerance * size) << x << ' ' << y;
        }
      }
    }
  };
  expectLinear(Asked(DrawSurvey(random, 1000)), 1.0);
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    Drawing drawing;
    drawing.Points = MakePlaces(set, 1000 / Reduction);
    double size = 1.0;
    for (const Place& point : drawing.Points)
    {
      size = std::max({ size, std::fabs(point[0]), std::fabs(point[1]) });
    }
    expectLinear(Asked(drawing), size);
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

TEST(Ask, RastersAreTheirCentres)
{
  std::mt19937 random(10);
  const Asked asked(DrawSurvey(random, 500));
  std::vector<double> values;
  for (const Place& point : asked.Points)
  {
    values.push_back(std::sin(5.0 * point[0]) * point[1]);
  }
  PlaceQuery query;
  query.Raster.Columns = 61;
  query.Raster.Rows = 47;
  query.Raster.Origin[0] = -0.05;
  query.Raster.Origin[1] = 1.03;
  query.Raster.Step[0] = 0.019;
  query.Raster.Step[1] = -0.023;
  Places centres;
  for (int row = 0; row < 47; ++row)
  {
    for (int column = 0; column < 61; ++column)
    {
      centres.push_back({ -0.05 + column * 0.019, 1.03 + row * -0.023 });
    }
  }
  PlaceQuery withoutCells = query;
  withoutCells.Raster.Rows = 0;
  const Places reversed(centres.rbegin(), centres.rend());
  withoutCells.Places = View(reversed);
  std::vector<std::int32_t> atPlaces(centres.size());
  withoutCells.Triangles = atPlaces.data();
  EXPECT_TRUE(asked.Session.Ask(withoutCells));
  EXPECT_EQ(asked.Locate(reversed), atPlaces);
  for (const InterpolationKind method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    std::vector<double> results(centres.size());
    std::vector<std::int32_t> triangles(centres.size());
    query.Values = values.data();
    query.Results = results.data();
    query.Triangles = triangles.data();
    query.Method = method;
    EXPECT_TRUE(asked.Session.Ask(query));
    EXPECT_EQ(asked.Locate(centres), triangles);
    const std::vector<double> expected = asked.Interpolate(values, centres, method);
    EXPECT_EQ(0, std::memcmp(expected.data(), results.data(), 8 * results.size()));
    // For few places, values are not sorted first, and no walk begins where another one ended.
    for (std::size_t i = 0; i < centres.size(); i += 101)
    {
      const std::vector<double> alone = asked.Interpolate(values, { centres[i] }, method);
      EXPECT_EQ(0, std::memcmp(alone.data(), &results[i], 8)) << i;
    }
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

TEST(Ask, QueriesThatCannotBeAnswered)
{
  std::mt19937 random(13);
  Drawing drawing;
  drawing.Points = MakePlaces(ListPointSets().front(), 1000);
  const FlipSession session(drawing.View(), PointOptions());
  const std::vector<double> values(drawing.Points.size());
  double result = 0.0;
  PlaceQuery query;
  query.Places = PlaneArray(drawing.Points.front().data(), 1, 2);
  query.Values = values.data();
  query.Results = &result;
  query.Method = InterpolationKind::Natural;
  EXPECT_THROW(session.Ask(query), InvalidOptions) << "bad edges";
  query.Method = InterpolationKind::Linear;
  EXPECT_TRUE(session.Ask(query));
  query.Components = 0;
  EXPECT_THROW(session.Ask(query), InvalidOptions);
  query.Components = 1;
  query.Raster.Columns = query.Raster.Rows = std::int64_t(1) << 40;
  EXPECT_THROW(session.Ask(query), InvalidOptions);
  query.Raster.Columns = -1;
  EXPECT_THROW(session.Ask(query), InvalidOptions);
}

TEST(Ask, AnObserverMayStop)
{
  Drawing drawing;
  drawing.Points = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  const Asked asked(drawing);
  const Places places(10, { 0.25, 0.25 });
  std::vector<std::int32_t> found(places.size());
  PlaceQuery query;
  query.Places = View(places);
  query.Triangles = found.data();
  EXPECT_FALSE(asked.Session.Ask(query, [](double) { return false; }));
  EXPECT_TRUE(asked.Session.Ask(query, [](double) { return true; }));
  EXPECT_EQ(std::vector<std::int32_t>(10, 0), found);

  found.resize(1000000);
  query.Raster.Columns = query.Raster.Rows = 1000;
  query.Raster.Step[0] = query.Raster.Step[1] = 0.5;
  query.Triangles = found.data();
  std::vector<double> shares;
  EXPECT_TRUE(asked.Session.Ask(query,
    [&](double share)
    {
      shares.push_back(share);
      return true;
    }));
  EXPECT_GE(shares.size(), 10u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()) && shares.back() < 1.0);
  EXPECT_FALSE(asked.Session.Ask(query, [](double share) { return share < 0.1; }));
}

}
}
