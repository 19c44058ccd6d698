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

}
}
