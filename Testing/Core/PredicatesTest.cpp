// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates.h"
#include "ExactPredicates.h"
#include "FilteredPredicates.h"
#include "FlipRules.h"
#include "RandomInputs.h"
#include "References.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{
namespace
{

class PredicatesTest : public testing::TestWithParam<PointFamily>
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

TEST_P(PredicatesTest, AreExact)
{
  this->ForCases(
    [](const FourPoints& p)
    {
      const double *a = p[0].data(), *b = p[1].data(), *c = p[2].data(), *d = p[3].data();
      const int turn = RationalTurn(p[0], p[1], p[2]);
      EXPECT_EQ(turn, Orientation(a, b, c)) << Describe(p);
      EXPECT_EQ(turn, Orientation(b, c, a)) << Describe(p);
      EXPECT_EQ(-turn, Orientation(b, a, c)) << Describe(p);
      const int inCircle = RationalInCircle(p[0], p[1], p[2], p[3]);
      EXPECT_EQ(inCircle, InCircle(a, b, c, d)) << Describe(p);
      EXPECT_EQ(-inCircle, InCircle(b, a, c, d)) << Describe(p);
      EXPECT_EQ(-inCircle, InCircle(d, b, c, a)) << Describe(p);
      const int tilted = RationalInCircle(p[0], p[1], p[2], p[3], true);
      EXPECT_EQ(tilted, InCircleTilted(a, b, c, d)) << Describe(p);
      EXPECT_EQ(-tilted, InCircleTilted(a, b, d, c)) << Describe(p);
      const int inSpace = RationalOrientation3D(p[0], p[1], p[2], p[3]);
      EXPECT_EQ(inSpace, Orientation3D(a, b, c, d)) << Describe(p);
      EXPECT_EQ(-inSpace, Orientation3D(b, a, c, d)) << Describe(p);
      EXPECT_EQ(-inSpace, Orientation3D(d, b, c, a)) << Describe(p);
    });
}

/// Reports a failure unless `sign` is right, or says that points do not fit where that is allowed.
void ExpectFixedPointSign(int expected, int sign, Fit fit, const FourPoints& points)
{
  EXPECT_NE(sign == UncertainSign ? Fit::Always : Fit::Never, fit) << Describe(points);
  if (sign != UncertainSign)
  {
    EXPECT_EQ(expected, sign) << Describe(points);
  }
}

/// Tested without the filters, which would leave few cases to fixed-point integers.
TEST_P(PredicatesTest, FixedPointIsExact)
{
  const Fit fit = GetParam().FixedPoint;
  this->ForCases(
    [fit](const FourPoints& p)
    {
      PlanePoint points[4];
      std::transform(p.begin(), p.end(), points,
        [](const Point3& x) {
          return PlanePoint{ x[0], x[1], x[2] };
        });
      const int turn = RationalTurn(p[0], p[1], p[2]);
      const int fixedTurn = FixedPointOrientation(points[0], points[1], points[2]);
      ExpectFixedPointSign(turn, fixedTurn, fit, p);
      EXPECT_EQ(turn, ExactOrientation(points[0], points[1], points[2])) << Describe(p);
      const int inSpace = RationalOrientation3D(p[0], p[1], p[2], p[3]);
      const int fixedInSpace = FixedPointOrientation3D(points[0], points[1], points[2], points[3]);
      ExpectFixedPointSign(inSpace, fixedInSpace, fit, p);
      EXPECT_EQ(inSpace, ExactOrientation3D(points[0], points[1], points[2], points[3]))
        << Describe(p);
      for (const bool tilted : { false, true })
      {
        const int expected = RationalInCircle(p[0], p[1], p[2], p[3], tilted);
        ExpectFixedPointSign(expected, FixedPointInCircle(points, tilted), fit, p);
        EXPECT_EQ(expected, ExactInCircle(points, tilted)) << Describe(p);
      }
    });
}

INSTANTIATE_TEST_SUITE_P(
  Families, PredicatesTest, testing::ValuesIn(ListPointFamilies()), GetCaseName);

/// Tests the bound that the proof for 64 bits assumes.
TEST(FixedPointPredicate, HoldsOffsetsOfAtMost2To62In64Bits)
{
  const double half = std::ldexp(1.0, 61);
  const PlanePoint a{ half, 0, 0 }, b{ 0, 1, 0 }, c{ 0, -1, 0 }, d{ -half, 0, 0 };
  EXPECT_EQ(-1, FixedPointInCircleIn<std::int64_t>(a, b, c, d, false));
  const PlanePoint next{ std::nextafter(half, 2 * half), 0, 0 };
  EXPECT_EQ(UncertainSign, FixedPointInCircleIn<std::int64_t>(next, b, c, d, false));
  EXPECT_EQ(-1, FixedPointInCircleIn<Integer128>(next, b, c, d, false));
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

//------------------------------------------------------------------------------
// The rules on single quads, and the numbers that their proofs rest on.

/// What the proofs of FilteredPredicates.h ask for; no sample of points comes near to it.
TEST(FilterBounds, AreThoseOfTheProofs)
{
  constexpr double Unit = std::numeric_limits<double>::epsilon() / 2.0;
  EXPECT_GE(OrientationBound, (3.0 + 16.0 * Unit) * Unit);
  EXPECT_GE(InCircleBound, (10.0 + 96.0 * Unit) * Unit);
  EXPECT_GE(TiltedInCircleBound, (12.0 + 128.0 * Unit) * Unit);
  // Lifts are sums of three products of differences, the sum of W doubling one of them.
  const double lift = 4.0 * LargestFilteredDifference * LargestFilteredDifference;
  EXPECT_LE(lift, 0x1p502);
  // Six products may underflow; each loses 2^-1074 at most.
  EXPECT_GE(SmallestCertifiable, 6.0 * 0x1p-1074 * lift);
  EXPECT_LE(2.0 * LargestFilteredCoordinate, LargestFilteredDifference);
}

/// A kite with obtuse angles at a and b, so small and so near to the origin that the product of its
/// lengths is far below the smallest number; beside it a mesh of usual size may lie.
TEST(SurfaceRule, JudgesQuadsOfAnySize)
{
  for (const double size : { 1.0, 0x1p-200, 0x1p-300, 0x1p-600, 0x1p-1060 })
  {
    const double points[] = { 0, size, 0, -3 * size, 0, 0, 3 * size, 0, 0, 0, -size, 0, 0, 9 * size,
      0 };
    for (const AngleTolerance tolerance :
      { AngleTolerance{ 0.0, 1.0, DoublePrecision }, AngleTolerance{ 1e-9, 1.0, 0.0 } })
    {
      const SurfaceRule<double> rule{ { points, tolerance, CoordinateRange::Usual } };
      EXPECT_EQ(EdgeState::Bad, rule.Judge({ 0, 0, 0, 1, 2, 3 })) << size;
      EXPECT_EQ(EdgeState::Good, rule.Judge({ 0, 0, 1, 3, 0, 2 })) << size;
      EXPECT_EQ(EdgeState::Good, rule.Judge({ 0, 0, 4, 1, 2, 3 })) << size;
    }
  }
}

/// A new triangle that stands upright on the quad's vector area, exactly, would be the first step
/// of a fold.
TEST(SurfaceRule, SetsNoTriangleUpright)
{
  const Vector3 origin = { 0, 0, 0 };
  EXPECT_TRUE(FoldsOver({ { 0, -3, -2 }, origin, { 3, -3, -3 }, { -1, -3, -1 } }));
  EXPECT_TRUE(FoldsOver({ { 3, 2, 2 }, origin, { 3, 1, 2 }, { 1, 1, 1 } }));
  EXPECT_FALSE(FoldsOver({ { 1, 2, 0 }, origin, { 3, 0, 0 }, { 1, -2, 0 } }));
}

/// The curve visits every cell of a square or cube, and each is next to the one before it.
TEST(HilbertCurve, FillsSquaresAndCubes)
{
  for (const int axes : { 2, 3 })
  {
    for (int bits = 1; bits <= 12 / axes; ++bits)
    {
      std::vector<int> cells(std::size_t(1) << (axes * bits), -1);
      const int side = 1 << bits;
      for (int cell = 0; cell < static_cast<int>(cells.size()); ++cell)
      {
        std::uint32_t place[3] = {};
        for (int axis = 0; axis < axes; ++axis)
        {
          place[axis] = cell >> (axis * bits) & (side - 1);
        }
        std::uint32_t square[2] = { place[0], place[1] };
        const std::uint32_t index =
          axes == 3 ? HilbertIndex(place, bits) : HilbertIndex(place[0], place[1], bits);
        EXPECT_TRUE(axes == 3 || index == HilbertIndex(square, bits));
        cells.at(index) = cell;
      }
      for (std::size_t i = 1; i < cells.size(); ++i)
      {
        int distance = 0;
        for (int axis = 0; axis < axes; ++axis)
        {
          distance += std::abs((cells[i] >> (axis * bits) & (side - 1)) -
            (cells[i - 1] >> (axis * bits) & (side - 1)));
        }
        ASSERT_EQ(1, distance) << "at " << i << " of " << cells.size();
      }
    }
  }
}

}
}
