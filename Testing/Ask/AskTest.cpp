// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AskTestSupport.h"
#include "PointSets.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

/// @file
/// What a triangulation of points answers: the triangles of places, rasters, and what it refuses.

namespace delaunayflip
{
namespace
{

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

/// On a hull that refinement has split, places are found also where products would overflow.
TEST(Ask, LocateFindsPlacesOnALargeSplitHull)
{
  std::mt19937 random(6);
  for (int round = 0; round < 40; ++round)
  {
    Drawing drawing;
    for (int i = 0; i < 12; ++i)
    {
      drawing.Points.push_back({ std::ldexp(DrawIndex(random, 1000) / 997.0, 995),
        std::ldexp(DrawIndex(random, 1000) / 991.0, 995) });
    }
    PointOptions options;
    options.MinimumAngle = 25.0;
    const Asked asked(drawing, options);
    const std::vector<std::int32_t> found = asked.Locate(asked.Points);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_EQ(found[i], asked.FindByHand(asked.Points[i])) << "round " << round << ", " << i;
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
