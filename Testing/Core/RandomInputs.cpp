// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomInputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

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

template <double (*DrawCoordinate)(std::mt19937&)>
FourPoints Fill(std::mt19937& random)
{
  return FillPoints([&] { return DrawCoordinate(random); });
}

double DrawUniform(std::mt19937& random) { return DrawUnit(random) - 0.5; }
double DrawFloat(std::mt19937& random) { return static_cast<float>(DrawUnit(random)); }
double DrawTiny(std::mt19937& random) { return 1e-300 * DrawUniform(random); }
double DrawHuge(std::mt19937& random) { return 3e300 * DrawUniform(random); }
double DrawOnGrid(std::mt19937& random) { return DrawIndex(random, 4); } ///< Most are ties.
double DrawOnTinyGrid(std::mt19937& random) { return std::ldexp(DrawOnGrid(random), -1000); }
double DrawOnHugeGrid(std::mt19937& random) { return std::ldexp(DrawOnGrid(random), 1000); }
double DrawFar(std::mt19937& random) { return 1e7 + std::ldexp(DrawIndex(random, 16), -20); }

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

/// Subnormal numbers around zero, and numbers around the smallest normal one.
double DrawSubnormal(std::mt19937& random)
{
  const double multiple = std::ldexp(DrawIndex(random, 2), 52) + DrawIndex(random, 9) - 4;
  return std::numeric_limits<double>::denorm_min() * multiple;
}

double DrawMixedMagnitudes(std::mt19937& random)
{
  constexpr double Magnitudes[] = { 0.0, 1.0, 1e-300, 1e300, 1.7e308, 5e-324, 3e100, 1e-100 };
  const double magnitude = Magnitudes[DrawIndex(random, 8)];
  return DrawIndex(random, 2) ? magnitude : -magnitude;
}

double DrawAnyExponent(std::mt19937& random)
{
  return std::ldexp(DrawUniform(random), DrawIndex(random, 2090) - 1070);
}

/// Ranges of exponents around what the narrow fixed-point integers can hold.
double DrawWideExponent(std::mt19937& random)
{
  return std::ldexp(DrawUniform(random), DrawIndex(random, 30) - 15);
}

/// Coordinates that are far from the limits of double, although products of two or four of them are
/// not.
FourPoints DrawVanishingProducts(std::mt19937& random)
{
  const int exponent = DrawIndex(random, 2) ? -269 : -538;
  return FillPoints([&] { return std::ldexp(DrawIndex(random, 4), exponent); });
}

/// Integers of any size up to 2^61, so that differences and sums reach 2^62.
double DrawLargestOffset(std::mt19937& random)
{
  const int bits = DrawIndex(random, 62);
  const double power = std::ldexp(1.0, DrawIndex(random, 2) ? 61 : bits);
  const double noise = std::floor(std::ldexp(DrawUnit(random), bits - 9));
  return (DrawIndex(random, 2) ? 1 : -1) * (power - (DrawIndex(random, 2) ? noise : 0.0));
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

/// Axis-aligned rectangles with sides that are no multiples of a convenient power of two.
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
    { "Uniform", Fill<DrawUniform>, Fit::Always },
    { "SmallGrid", Fill<DrawOnGrid>, Fit::Always },
    { "Floats", Fill<DrawFloat>, Fit::Always },
    { "Circle", DrawCircle, Fit::Always },
    { "NudgedCircle", DrawNudgedCircle, Fit::Sometimes },
    { "NudgedLine", DrawNudgedLine, Fit::Sometimes },
    { "NearDiagonal", DrawNearDiagonal, Fit::Always },
    { "Tiny", Fill<DrawTiny>, Fit::Always },
    { "Huge", Fill<DrawHuge>, Fit::Always },
    { "TinyGrid", Fill<DrawOnTinyGrid>, Fit::Always },
    { "HugeGrid", Fill<DrawOnHugeGrid>, Fit::Always },
    { "Subnormal", Fill<DrawSubnormal>, Fit::Always },
    { "MixedMagnitudes", Fill<DrawMixedMagnitudes>, Fit::Sometimes },
    { "AnyExponents", Fill<DrawAnyExponent>, Fit::Sometimes },
    { "WideExponents", Fill<DrawWideExponent>, Fit::Always },
    { "VanishingProducts", DrawVanishingProducts, Fit::Always },
    { "Offset", Fill<DrawFar>, Fit::Always },
    { "LargestOffsets", Fill<DrawLargestOffset>, Fit::Always },
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

//------------------------------------------------------------------------------
namespace
{

/// Random triangles on a small lattice: every kind of edge and degenerate triangle.
OwnedMesh<double> MakeSoup(std::mt19937& random)
{
  constexpr double Scales[] = { 1.0, 1e-3, 1e6 };
  const double scale = Scales[random() % 3];
  const std::uint32_t points = 3 + random() % 60;
  OwnedMesh<double> mesh;
  for (std::uint32_t i = 0; i < points; ++i)
  {
    mesh.Points.push_back(scale * (random() % 16));
    mesh.Points.push_back(scale * (random() % 16));
    mesh.Points.push_back(random() % 3 == 0 ? scale * (random() % 16) : 0.0);
  }
  for (std::uint32_t i = 3 * (1 + random() % 150); i > 0; --i)
  {
    mesh.Triangles.push_back(static_cast<std::int32_t>(random() % points));
  }
  return mesh;
}

void SpoilPoints(OwnedMesh<double>& mesh, std::mt19937& random)
{
  for (std::uint32_t i = random() % 3; i > 0; --i)
  {
    const double moved = (random() % 8) / 8.0;
    const bool isNaN = random() % 4 == 0;
    mesh.Points[random() % mesh.Points.size()] =
      isNaN ? std::numeric_limits<double>::quiet_NaN() : moved;
  }
  const double roughness = (random() % 2) * 0.01;
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += roughness * (random() % 100);
  }
}

/// Turns some triangles over and repeats some.
void SpoilTriangles(OwnedMesh<double>& mesh, std::mt19937& random)
{
  for (std::uint32_t i = random() % 4; i > 0; --i)
  {
    const std::size_t t = random() % (mesh.Triangles.size() / 3);
    std::swap(mesh.Triangles[3 * t + random() % 3], mesh.Triangles[3 * t + random() % 3]);
  }
  for (std::uint32_t i = random() % 3; i > 0; --i)
  {
    const std::size_t t = random() % (mesh.Triangles.size() / 3);
    for (std::size_t slot = 0; slot < 3; ++slot)
    {
      mesh.Triangles.push_back(mesh.Triangles[3 * t + slot]);
    }
  }
}

OwnedMesh<double> MakeMesh(std::mt19937& random)
{
  if (random() % 2 == 0)
  {
    return MakeSoup(random);
  }
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(4 + random() % 80, random());
  SpoilPoints(mesh, random);
  SpoilTriangles(mesh, random);
  return mesh;
}

/// Options that are valid for any mesh: not Planar, which needs a plane, nor Canonical, which is
/// not for surfaces.
FlipOptions MakeOptions(std::mt19937& random)
{
  constexpr GeometryKind Geometries[] = { GeometryKind::Auto, GeometryKind::PlanarXY,
    GeometryKind::Surface };
  FlipOptions options;
  options.Geometry = Geometries[random() % 3];
  options.Criterion = random() % 4 == 0 ? CriterionKind::OppositeAngles : CriterionKind::InCircle;
  options.FeatureAngle = random() % 2 == 0 ? 180.0 : 30.0;
  options.MaximumDeviation = random() % 4 == 0 ? 0.05 : options.MaximumDeviation;
  options.NumberOfThreads = 1 + static_cast<int>(random() % 2);
  if (options.Geometry == GeometryKind::PlanarXY && options.Criterion == CriterionKind::InCircle)
  {
    options.TieRule = random() % 2 == 0 ? TieRuleKind::Canonical : TieRuleKind::Keep;
  }
  return options;
}

}

RandomMess MakeRandomMess(std::uint32_t seed)
{
  std::mt19937 random(seed);
  RandomMess mess;
  mess.Mesh = MakeMesh(random);
  for (std::uint32_t i = 2 * (random() % 5); i > 0; --i)
  {
    mess.Constraints.push_back(static_cast<std::int64_t>(random() % mess.Mesh.NumberOfPoints()));
  }
  mess.Options = MakeOptions(random);
  return mess;
}

}
