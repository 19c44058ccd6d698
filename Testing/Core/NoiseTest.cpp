// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "LongVector.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

/// @file
/// The promise of the automatic tolerance: if an edge is bad, its angle sum exceeds pi wherever its
/// four points are within one unit in the last place of their coordinates.

namespace delaunayflip
{
namespace
{

/// Coordinates of a, p, q, b.
template <typename Real>
using QuadCoordinates = std::array<Real, 12>;

/// By how much the sum of the angles at a and b exceeds pi.
template <typename Real>
long double FindExcess(const QuadCoordinates<Real>& x)
{
  const auto get = [&](int i) { return LongVector{ x[3 * i], x[3 * i + 1], x[3 * i + 2] }; };
  return FindAngle(get(0), get(1), get(2)) + FindAngle(get(3), get(1), get(2)) - std::acos(-1.0L);
}

/// Judges the edge by the engine and by the audit.
struct Judgement
{
  bool IsBad, IsBadByAudit;
};

template <typename Real>
Judgement Judge(const QuadCoordinates<Real>& x)
{
  const OwnedMesh<Real> mesh = { { x.begin(), x.end() }, { 0, 1, 2, 3, 2, 1 } };
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  return { MakeSession(mesh.View(), options).GetReport().NonDelaunayBefore == 1,
    CountNonDelaunayEdges(mesh.View(), options) == 1 };
}

double DrawSigned(std::mt19937& random) { return random() / 2147483648.0 - 1.0; }

/// Four points almost on a circle somewhere in space, with an angle sum just below or above pi.
template <typename Real>
QuadCoordinates<Real> DrawQuad(std::mt19937& random)
{
  const double offset = 1000.0 * std::pow(0.5, random() % 20);
  const double spread = 20.0 * std::numeric_limits<Real>::epsilon() * (1.0 + offset);
  const double tilt = 3.0 * DrawSigned(random);
  const std::array<double, 3> origin = { offset * DrawSigned(random), offset * DrawSigned(random),
    offset * DrawSigned(random) };
  QuadCoordinates<Real> x;
  int i = 0;
  for (double turn : { 0.0, 1.5, 4.5, 3.0 }) // a, p, q, b
  {
    const double angle = turn + 0.7 * DrawSigned(random);
    const double radius = 1.0 + (turn == 0.0 ? spread * DrawSigned(random) : 0.0);
    const double u = radius * std::cos(angle), v = radius * std::sin(angle);
    x[i++] = static_cast<Real>(origin[0] + u);
    x[i++] = static_cast<Real>(origin[1] + std::cos(tilt) * v);
    x[i++] = static_cast<Real>(origin[2] + std::sin(tilt) * v + 0.1 * spread * DrawSigned(random));
  }
  return x;
}

/// Keeps each coordinate or moves it to a neighbouring number, whichever makes the sum smallest.
template <typename Real>
void LowerSum(QuadCoordinates<Real>& x)
{
  constexpr Real Infinity = std::numeric_limits<Real>::infinity();
  for (Real& coordinate : x)
  {
    const Real choices[] = { coordinate, std::nextafter(coordinate, -Infinity),
      std::nextafter(coordinate, Infinity) };
    long double least = std::numeric_limits<long double>::infinity();
    Real best = coordinate;
    for (Real choice : choices)
    {
      coordinate = choice;
      const long double excess = FindExcess(x);
      best = excess < least ? choice : best;
      least = std::min(excess, least);
    }
    coordinate = best;
  }
}

/// Keeps each coordinate or moves it to a neighbouring number, at random.
template <typename Real>
QuadCoordinates<Real> Perturb(QuadCoordinates<Real> x, std::mt19937& random)
{
  for (Real& coordinate : x)
  {
    const double direction = static_cast<double>(DrawIndex(random, 3)) - 1.0;
    coordinate = std::nextafter(coordinate, static_cast<Real>(coordinate + direction));
  }
  return x;
}

template <typename Real>
void ExpectBadEdgesAreBadWithinPrecision(std::uint32_t seed)
{
  std::mt19937 random(seed);
  int bad = 0, doubtful = 0, different = 0;
  for (int i = 0; i < 20000 / Reduction; ++i)
  {
    const QuadCoordinates<Real> x = DrawQuad<Real>(random);
    const Judgement judgement = Judge(x);
    const bool isBad = judgement.IsBad;
    QuadCoordinates<Real> lowest = x;
    LowerSum(lowest);
    bad += isBad;
    different += isBad != judgement.IsBadByAudit;
    doubtful += FindExcess(x) > 0 && FindExcess(lowest) <= 0;
    ASSERT_FALSE(isBad && FindExcess(lowest) <= 0) << "case " << i;
    for (int trial = 0; isBad && trial < 20; ++trial)
    {
      ASSERT_LT(0, FindExcess(Perturb(x, random))) << "case " << i;
    }
  }
  // Some sums are so close to pi + tolerance that rounding decides, differently in the two.
  EXPECT_LE(different, 40 / Reduction);
  // Many edges are bad, and without a tolerance many more would be.
  EXPECT_LT(2000 / Reduction, bad);
  EXPECT_LT(1000 / Reduction, doubtful);
}

TEST(AutomaticTolerance, BadEdgesOfFloatsAreBadWithinPrecision)
{
  ExpectBadEdgesAreBadWithinPrecision<float>(73);
}

TEST(AutomaticTolerance, BadEdgesOfDoublesAreBadWithinPrecision)
{
  ExpectBadEdgesAreBadWithinPrecision<double>(74);
}

}
}
