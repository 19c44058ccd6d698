// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "AskTestSupport.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Values where coordinates or distances have very different sizes.

namespace delaunayflip
{
namespace
{

double Linear(double x, double y) { return 3.0 * x - 2.0 * y + 1.0; }

/// Where y has another unit than x, areas are small beside squares of lengths, but have all digits.
TEST(Ask, UnitsMayDiffer)
{
  std::mt19937 random(16);
  const Asked survey(DrawSurvey(random, 100));
  for (const int exponent : { 0, 30, -60, -80, -140, -500, -900, 200 })
  {
    Drawing drawing;
    std::vector<double> values;
    for (const Place& point : survey.Points)
    {
      drawing.Points.push_back({ point[0], std::ldexp(point[1], exponent) });
      values.push_back(Linear(point[0], point[1]));
    }
    const Asked asked(drawing);
    const Places places = DrawPlaces(survey, random, 2000);
    Places scaled = places;
    for (Place& place : scaled)
    {
      place[1] = std::ldexp(place[1], exponent);
    }
    const std::vector<std::int32_t> found = asked.Locate(scaled);
    for (const auto method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      const std::vector<double> results = asked.Interpolate(values, scaled, method);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        ASSERT_EQ(found[i] < 0, std::isnan(results[i]));
        if (found[i] >= 0)
        {
          ASSERT_NEAR(Linear(places[i][0], places[i][1]), results[i], 1e-9)
            << exponent << ' ' << places[i][0] << ' ' << places[i][1];
        }
      }
    }
  }
}

/// Random points around (0.5, 0.5), and one that is very far away.
Drawing DrawWithFarPoint(double distance)
{
  std::mt19937 random(17);
  Drawing drawing;
  for (int i = 0; i < 40; ++i)
  {
    const double x = DrawIndex(random, 1 << 20), y = DrawIndex(random, 1 << 20);
    drawing.Points.push_back({ std::ldexp(x, -20), std::ldexp(y, -20) });
  }
  drawing.Points.push_back({ distance, -0.75 * distance });
  return drawing;
}

/// Places beside the points in the direction of the far one, and a few between them.
Places ListPlacesTowardsFarPoint()
{
  Places places;
  for (int i = 0; i < 30; ++i)
  {
    for (int k = 0; k < 30; ++k)
    {
      places.push_back({ 0.71 + 0.037 * i, 0.29 - 0.043 * k });
    }
  }
  return places;
}

/// Centres are as far away as the far point, and areas cancel. The farther that is, the less the
/// values change. Among linear ones they would be others.
TEST(Ask, FarPointsLeaveNaturalNeighbors)
{
  const Places places = ListPlacesTowardsFarPoint();
  std::vector<double> values;
  for (int i = 0; i < 41; ++i)
  {
    values.push_back(i % 7);
  }
  const auto interpolate = [&](double distance, InterpolationKind method)
  { return Asked(DrawWithFarPoint(distance)).Interpolate(values, places, method); };
  const std::vector<double> expected = interpolate(2e4, InterpolationKind::Natural);
  const std::vector<double> linear = interpolate(2e4, InterpolationKind::Linear);
  for (const double distance : { 1e5, 5136000.0, 1e8, 1e12, 1e16, 1e30, 1e60 })
  {
    const std::vector<double> found = interpolate(distance, InterpolationKind::Natural);
    int compared = 0, different = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (!std::isnan(expected[i]))
      {
        ASSERT_NEAR(expected[i], found[i], 2e-3)
          << distance << ' ' << places[i][0] << ' ' << places[i][1];
        ++compared;
        different += std::fabs(linear[i] - found[i]) > 0.1 ? 1 : 0;
      }
    }
    EXPECT_LT(400, compared);
    EXPECT_LT(200, different);
  }
}

/// Also the weight of the far point is right, by which this function is large there.
TEST(Ask, FarPointsLeaveLinearFunctions)
{
  const Places places = ListPlacesTowardsFarPoint();
  for (const double distance : { 1e5, 1e7, 1e9 })
  {
    const Asked asked(DrawWithFarPoint(distance));
    std::vector<double> values;
    for (const Place& point : asked.Points)
    {
      values.push_back(Linear(point[0], point[1]));
    }
    const std::vector<double> found = asked.Interpolate(values, places, InterpolationKind::Natural);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      if (!std::isnan(found[i]))
      {
        ASSERT_NEAR(Linear(places[i][0], places[i][1]), found[i], 1e-14 * distance);
      }
    }
  }
}

}
}
