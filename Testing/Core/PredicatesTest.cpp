// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates.h"
#include "ExactReference.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delaunayflip
{
namespace
{

using FourPoints = std::array<Point3, 4>;

double DrawUnit(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

/// Fills all twelve coordinates from draw().
template <typename Draw>
FourPoints FillPoints(const Draw& draw)
{
  FourPoints points;
  for (Point3& point : points)
  {
    point = { draw(), draw(), draw() };
  }
  return points;
}

FourPoints DrawUniform(std::mt19937& random)
{
  return FillPoints([&] { return DrawUnit(random) - 0.5; });
}

FourPoints DrawSmallGrid(std::mt19937& random)
{
  return FillPoints([&] { return double(DrawIndex(random, 4)); });
}

FourPoints DrawFloats(std::mt19937& random)
{
  return FillPoints([&] { return static_cast<float>(DrawUnit(random)); });
}

/// Lattice points on one circle: 5 * 13 * 17 has 14 Pythagorean triples.
FourPoints DrawCircle(std::mt19937& random)
{
  constexpr int Radius = 1105;
  const double center = DrawIndex(random, 2) * 1e7;
  FourPoints points;
  for (Point3& point : points)
  {
    int x = 0;
    int y = 1;
    while (x * x + y * y != Radius * Radius)
    {
      x = DrawIndex(random, 2 * Radius + 1) - Radius;
      y = static_cast<int>(std::lround(std::sqrt(double(Radius * Radius - x * x))));
    }
    point = { center + x, center + (DrawIndex(random, 2) ? y : -y), 0.0 };
  }
  return points;
}

/// One coordinate of one point a few steps of the last bit away.
FourPoints Nudge(FourPoints points, std::mt19937& random)
{
  double& x = points[DrawIndex(random, 4)][DrawIndex(random, 2)];
  const int steps = DrawIndex(random, 5) - 2;
  for (int i = 0; i < std::abs(steps); ++i)
  {
    x = std::nextafter(x, steps * std::numeric_limits<double>::infinity());
  }
  return points;
}

FourPoints DrawNudgedCircle(std::mt19937& random) { return Nudge(DrawCircle(random), random); }

FourPoints DrawNudgedLine(std::mt19937& random)
{
  const Point3 direction = { DrawUnit(random), DrawUnit(random), DrawUnit(random) };
  FourPoints points;
  for (Point3& point : points)
  {
    const double step = std::ldexp(1.0, DrawIndex(random, 8));
    point = { step * direction[0], step * direction[1], step * direction[2] };
  }
  return Nudge(points, random);
}

/// The neighbourhoods in which naive orientation tests show their noise: a few last bits about
/// (0.5, 0.5), beside two far points of the diagonal.
FourPoints DrawNearDiagonal(std::mt19937& random)
{
  const auto near = [&] { return 0.5 + std::ldexp(DrawIndex(random, 64), -53); };
  return { { { near(), near(), 0.0 }, { 12.0, 12.0, 0.0 }, { 24.0, 24.0, 0.0 },
    { near(), near(), near() } } };
}

FourPoints DrawTiny(std::mt19937& random)
{
  return FillPoints([&] { return 1e-300 * (DrawUnit(random) - 0.5); });
}

FourPoints DrawHuge(std::mt19937& random)
{
  return FillPoints([&] { return 3e300 * (DrawUnit(random) - 0.5); });
}

FourPoints DrawTinyGrid(std::mt19937& random)
{
  return FillPoints([&] { return std::ldexp(DrawIndex(random, 4), -1000); });
}

FourPoints DrawHugeGrid(std::mt19937& random)
{
  return FillPoints([&] { return std::ldexp(DrawIndex(random, 4), 1000); });
}

FourPoints DrawSubnormal(std::mt19937& random)
{
  return FillPoints(
    [&] { return std::numeric_limits<double>::denorm_min() * (DrawIndex(random, 9) - 4); });
}

FourPoints DrawMixedMagnitudes(std::mt19937& random)
{
  constexpr double Magnitudes[] = { 0.0, 1.0, 1e-300, 1e300, 1.7e308, 5e-324, 3e100, 1e-100 };
  return FillPoints(
    [&]
    {
      const double magnitude = Magnitudes[DrawIndex(random, 8)];
      return DrawIndex(random, 2) ? magnitude : -magnitude;
    });
}

FourPoints DrawAnyExponents(std::mt19937& random)
{
  return FillPoints(
    [&] { return std::ldexp(DrawUnit(random) - 0.5, DrawIndex(random, 2090) - 1070); });
}

/// Spreads about what expansions can hold.
FourPoints DrawWideExponents(std::mt19937& random)
{
  return FillPoints(
    [&] { return std::ldexp(DrawUnit(random) - 0.5, DrawIndex(random, 500) - 250); });
}

/// Coordinates far from double's limits whose products, of two or of four, are not.
FourPoints DrawVanishingProducts(std::mt19937& random)
{
  const int exponent = DrawIndex(random, 2) ? -269 : -538;
  return FillPoints([&] { return std::ldexp(DrawIndex(random, 4), exponent); });
}

FourPoints DrawWithOffset(std::mt19937& random)
{
  return FillPoints([&] { return 1e7 + std::ldexp(DrawIndex(random, 16), -20); });
}

struct Family
{
  const char* Name;
  FourPoints (*Draw)(std::mt19937&);
};

void PrintTo(const Family& family, std::ostream* stream) { *stream << family.Name; }

class PredicatesTest : public testing::TestWithParam<Family>
{
protected:
  /// Calls check(points) for many cases of the family.
  template <typename Check>
  void ForCases(const Check& check) const
  {
    std::mt19937 random(20130712);
    for (int i = 0; i < 2000 / Reduction && !this->HasFailure(); ++i)
    {
      check(GetParam().Draw(random));
    }
  }
};

std::string Describe(const FourPoints& points)
{
  std::string text;
  for (const Point3& point : points)
  {
    char line[120];
    std::snprintf(line, sizeof line, "(%a, %a, %a) ", point[0], point[1], point[2]);
    text += line;
  }
  return text;
}

TEST_P(PredicatesTest, OrientationIsExact)
{
  this->ForCases(
    [](const FourPoints& p)
    {
      const int expected = RationalTurn(p[0], p[1], p[2]);
      EXPECT_EQ(expected, Orientation(p[0].data(), p[1].data(), p[2].data())) << Describe(p);
      EXPECT_EQ(expected, Orientation(p[1].data(), p[2].data(), p[0].data())) << Describe(p);
      EXPECT_EQ(-expected, Orientation(p[1].data(), p[0].data(), p[2].data())) << Describe(p);
    });
}

TEST_P(PredicatesTest, InCircleIsExact)
{
  this->ForCases(
    [](const FourPoints& p)
    {
      const int expected = RationalInCircle(p[0], p[1], p[2], p[3]);
      EXPECT_EQ(expected, InCircle(p[0].data(), p[1].data(), p[2].data(), p[3].data()))
        << Describe(p);
      EXPECT_EQ(-expected, InCircle(p[1].data(), p[0].data(), p[2].data(), p[3].data()))
        << Describe(p);
      EXPECT_EQ(-expected, InCircle(p[3].data(), p[1].data(), p[2].data(), p[0].data()))
        << Describe(p);
    });
}

TEST_P(PredicatesTest, InCircleTiltedIsExact)
{
  this->ForCases(
    [](const FourPoints& p)
    {
      const int expected = RationalInCircle(p[0], p[1], p[2], p[3], true);
      EXPECT_EQ(expected, InCircleTilted(p[0].data(), p[1].data(), p[2].data(), p[3].data()))
        << Describe(p);
      EXPECT_EQ(-expected, InCircleTilted(p[0].data(), p[1].data(), p[3].data(), p[2].data()))
        << Describe(p);
    });
}

INSTANTIATE_TEST_SUITE_P(Families, PredicatesTest,
  testing::Values(Family{ "Uniform", DrawUniform }, Family{ "SmallGrid", DrawSmallGrid },
    Family{ "Floats", DrawFloats }, Family{ "Circle", DrawCircle },
    Family{ "NudgedCircle", DrawNudgedCircle }, Family{ "NudgedLine", DrawNudgedLine },
    Family{ "NearDiagonal", DrawNearDiagonal }, Family{ "Tiny", DrawTiny },
    Family{ "Huge", DrawHuge }, Family{ "TinyGrid", DrawTinyGrid },
    Family{ "HugeGrid", DrawHugeGrid }, Family{ "Subnormal", DrawSubnormal },
    Family{ "MixedMagnitudes", DrawMixedMagnitudes }, Family{ "AnyExponents", DrawAnyExponents },
    Family{ "WideExponents", DrawWideExponents },
    Family{ "VanishingProducts", DrawVanishingProducts }, Family{ "Offset", DrawWithOffset }),
  [](const auto& test) { return std::string(test.param.Name); });

/// (x, y) -> (3 x, 5 y, 4 x) is a similarity onto a tilted plane, exact on a lattice.
TEST(TiltedPredicate, IsInCircleOnAPlane)
{
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i)
  {
    const FourPoints flat = i % 2 ? DrawSmallGrid(random) : DrawCircle(random);
    FourPoints tilted;
    for (int k = 0; k < 4; ++k)
    {
      tilted[k] = { 3.0 * flat[k][0], 5.0 * flat[k][1], 4.0 * flat[k][0] };
    }
    ASSERT_EQ(InCircle(flat[0].data(), flat[1].data(), flat[2].data(), flat[3].data()),
      InCircleTilted(tilted[0].data(), tilted[1].data(), tilted[2].data(), tilted[3].data()))
      << Describe(flat);
  }
}

TEST(NonFiniteCoordinates, GiveZero)
{
  const FourPoints good = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.25, 0.25, 0 } } };
  ASSERT_EQ(1, InCircle(good[0].data(), good[1].data(), good[2].data(), good[3].data()));
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  for (double bad : { std::nan(""), Infinity, -Infinity })
  {
    for (int position = 0; position < 12; ++position)
    {
      FourPoints p = good;
      p[position / 3][position % 3] = bad;
      EXPECT_EQ(0, InCircleTilted(p[0].data(), p[1].data(), p[2].data(), p[3].data()));
      if (position % 3 < 2)
      {
        EXPECT_EQ(0, InCircle(p[0].data(), p[1].data(), p[2].data(), p[3].data()));
        const int expected = position < 9 ? 0 : 1;
        EXPECT_EQ(expected, Orientation(p[0].data(), p[1].data(), p[2].data()));
      }
    }
  }
}

}
}
