// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointFamilies.h"

#include "FlipTestSupport.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{
namespace
{

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

}

FourPoints DrawSmallGrid(std::mt19937& random)
{
  return FillPoints([&] { return double(DrawIndex(random, 4)); });
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

namespace
{

FourPoints DrawUniform(std::mt19937& random)
{
  return FillPoints([&] { return DrawUnit(random) - 0.5; });
}

FourPoints DrawFloats(std::mt19937& random)
{
  return FillPoints([&] { return static_cast<float>(DrawUnit(random)); });
}

/// Moves one coordinate of one point by a few units in the last place.
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

/// Where naive orientation tests fail: points a few units in the last place from (0.5, 0.5), with
/// two distant points of the diagonal.
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

/// Subnormal numbers around zero, and numbers around the smallest normal one.
FourPoints DrawSubnormal(std::mt19937& random)
{
  return FillPoints(
    [&]
    {
      const double multiple = std::ldexp(DrawIndex(random, 2), 52) + DrawIndex(random, 9) - 4;
      return std::numeric_limits<double>::denorm_min() * multiple;
    });
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

/// Ranges of exponents around what the narrow fixed-point integers can hold.
FourPoints DrawWideExponents(std::mt19937& random)
{
  return FillPoints([&] { return std::ldexp(DrawUnit(random) - 0.5, DrawIndex(random, 30) - 15); });
}

/// Coordinates that are far from the limits of double, although products of two or four of them are
/// not.
FourPoints DrawVanishingProducts(std::mt19937& random)
{
  const int exponent = DrawIndex(random, 2) ? -269 : -538;
  return FillPoints([&] { return std::ldexp(DrawIndex(random, 4), exponent); });
}

FourPoints DrawWithOffset(std::mt19937& random)
{
  return FillPoints([&] { return 1e7 + std::ldexp(DrawIndex(random, 16), -20); });
}

/// Integers of any size up to 2^61, so that differences and sums reach 2^62.
FourPoints DrawLargestOffsets(std::mt19937& random)
{
  return FillPoints(
    [&]
    {
      const int bits = DrawIndex(random, 62);
      const double power = std::ldexp(1.0, DrawIndex(random, 2) ? 61 : bits);
      const double noise = std::floor(std::ldexp(DrawUnit(random), bits - 9));
      return (DrawIndex(random, 2) ? 1 : -1) * (power - (DrawIndex(random, 2) ? noise : 0.0));
    });
}

/// Offsets in x that are the next double above 2^62, beside units of 1: these need wide integers.
FourPoints DrawOffsetsAbove62Bits(std::mt19937& random)
{
  FourPoints points = FillPoints([&] { return 2.0 * DrawIndex(random, 100) - 99.0; });
  for (Point3& point : points)
  {
    point[0] = -std::ldexp(1.0, 61);
  }
  points[0][0] = std::ldexp(1.0, 61) + 512.0;
  return points;
}

/// A quad of an O-grid about the origin, on two circles. On the axes, coordinates that should be
/// zero are rounding noise of 6e-17.
FourPoints DrawGridAboutOrigin(std::mt19937& random)
{
  const int steps = 4 << DrawIndex(random, 6);
  const int first = DrawIndex(random, steps + 1);
  const double radius = 0.5 + DrawIndex(random, 8);
  FourPoints points;
  for (int i = 0; i < 4; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * (first + i % 2) / steps;
    const double r = radius * (i < 2 ? 1.0 : 1.1);
    points[i] = { r * std::cos(angle), r * std::sin(angle), r * std::cos(3.0 * angle) };
  }
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

/// An isosceles trapezoid about the y axis is exactly on one circle, whatever its numbers are. Its
/// z is constant on each of the parallel sides, which keeps the tie.
template <typename Draw>
FourPoints DrawTrapezoidOf(std::mt19937& random, const Draw& draw)
{
  const Point3 low = { draw(), draw(), draw() };
  const Point3 high = { draw(), draw(), draw() };
  FourPoints points = { { low, { -low[0], low[1], low[2] }, high,
    { -high[0], high[1], high[2] } } };
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

/// A trapezoid with rounding noise as some of its numbers.
FourPoints DrawNoisyTrapezoid(std::mt19937& random)
{
  return DrawTrapezoidOf(
    random, [&] { return (1.0 + DrawUnit(random)) * (DrawIndex(random, 2) ? 1.0 : 6e-17); });
}

FourPoints DrawNudgedTrapezoid(std::mt19937& random)
{
  return Nudge(DrawNoisyTrapezoid(random), random);
}

/// An integer below 2^bits in magnitude, often the largest, that uses all bits of a double if it
/// can.
double DrawInteger(std::mt19937& random, int bits)
{
  const int used = DrawIndex(random, 2) ? bits : 1 + DrawIndex(random, bits);
  const double fraction = DrawIndex(random, 4) == 0
    ? std::nextafter(1.0, 0.0)
    : 0.5 * (1.0 + DrawUnit(random) + std::ldexp(random() >> 12, -52));
  const double integer = std::floor(std::ldexp(fraction, used));
  return DrawIndex(random, 2) ? integer : -integer;
}

/// Integers with any number of bits up to the most that the wide integers can hold.
FourPoints DrawLongIntegers(std::mt19937& random)
{
  const int bits = 62 + DrawIndex(random, 64);
  return FillPoints([&] { return DrawInteger(random, bits); });
}

FourPoints DrawLongTrapezoid(std::mt19937& random)
{
  const int bits = 62 + DrawIndex(random, 64);
  return DrawTrapezoidOf(random, [&] { return DrawInteger(random, bits); });
}

/// Near ties. If a small number is moved by a unit in the last place, it may no longer fit.
FourPoints DrawNudgedLongTrapezoid(std::mt19937& random)
{
  return Nudge(DrawLongTrapezoid(random), random);
}

/// One coordinate has one bit too many.
FourPoints DrawTooLongIntegers(std::mt19937& random)
{
  FourPoints points = DrawLongIntegers(random);
  const int large = DrawIndex(random, 3);
  points[large][DrawIndex(random, 2)] = std::ldexp(DrawIndex(random, 2) ? 1.0 : -1.0, 125);
  points[(large + 1) % 3][DrawIndex(random, 2)] = 2.0 * DrawIndex(random, 100) + 1.0;
  return points;
}

FourPoints DrawExtremes(std::mt19937& random)
{
  FourPoints points = FillPoints([&] { return DrawIndex(random, 2) ? 1e-300 : -1e300; });
  points[0] = { 1e-300, 1e300, 0.0 };
  return points;
}

/// Axis-aligned rectangles whose sides are not multiples of a convenient power of two.
FourPoints DrawRectangle(std::mt19937& random)
{
  const auto draw = [&] { return 0.1 * DrawIndex(random, 300); };
  const double x[] = { draw(), draw() };
  const double y[] = { draw(), draw() };
  return { { { x[0], y[0], draw() }, { x[1], y[0], draw() }, { x[1], y[1], draw() },
    { x[0], y[1], draw() } } };
}

}

std::vector<PointFamily> ListPointFamilies()
{
  return {
    { "Uniform", DrawUniform, Fit::Always },
    { "SmallGrid", DrawSmallGrid, Fit::Always },
    { "Floats", DrawFloats, Fit::Always },
    { "Circle", DrawCircle, Fit::Always },
    { "NudgedCircle", DrawNudgedCircle, Fit::Sometimes },
    { "NudgedLine", DrawNudgedLine, Fit::Sometimes },
    { "NearDiagonal", DrawNearDiagonal, Fit::Always },
    { "Tiny", DrawTiny, Fit::Always },
    { "Huge", DrawHuge, Fit::Always },
    { "TinyGrid", DrawTinyGrid, Fit::Always },
    { "HugeGrid", DrawHugeGrid, Fit::Always },
    { "Subnormal", DrawSubnormal, Fit::Always },
    { "MixedMagnitudes", DrawMixedMagnitudes, Fit::Sometimes },
    { "AnyExponents", DrawAnyExponents, Fit::Sometimes },
    { "WideExponents", DrawWideExponents, Fit::Always },
    { "VanishingProducts", DrawVanishingProducts, Fit::Always },
    { "Offset", DrawWithOffset, Fit::Always },
    { "LargestOffsets", DrawLargestOffsets, Fit::Always },
    { "OffsetsAbove62Bits", DrawOffsetsAbove62Bits, Fit::Always },
    { "GridAboutOrigin", DrawGridAboutOrigin, Fit::Always },
    { "NoisyTrapezoid", DrawNoisyTrapezoid, Fit::Always },
    { "NudgedTrapezoid", DrawNudgedTrapezoid, Fit::Always },
    { "LongIntegers", DrawLongIntegers, Fit::Always },
    { "LongTrapezoid", DrawLongTrapezoid, Fit::Always },
    { "NudgedLongTrapezoid", DrawNudgedLongTrapezoid, Fit::Sometimes },
    { "TooLongIntegers", DrawTooLongIntegers, Fit::Never },
    { "Extremes", DrawExtremes, Fit::Never },
    { "Rectangle", DrawRectangle, Fit::Always },
  };
}

}
