// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipRules.h"
#include "FilteredPredicates.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

/// @file
/// The rules on single quads, and the numbers that their proofs rest on.

namespace delaunayflip
{
namespace
{

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

/// A quad a, p, q, b with p at the left and q at the right, and its mirror image.
void ExpectConvex(EdgeState expected, const PlanePoint (&apqb)[4])
{
  const int side = ExactOrientation(apqb[0], apqb[1], apqb[2]);
  ASSERT_EQ(side, ExactOrientation(apqb[3], apqb[2], apqb[1]));
  EXPECT_EQ(expected, CheckConvex<ExactSigns>(apqb, side));
  PlanePoint mirrored[4];
  std::transform(apqb, apqb + 4, mirrored,
    [](const PlanePoint& p) {
      return PlanePoint{ -p.U, p.V, p.W };
    });
  EXPECT_EQ(expected, CheckConvex<ExactSigns>(mirrored, -side));
}

TEST(CheckConvex, LooksAtBothEnds)
{
  ExpectConvex(EdgeState::Bad, { { 0, 1, 0 }, { -2, 0, 0 }, { 2, 0, 0 }, { 0, -1, 0 } });
  // Dented at p, then at q; then straight there.
  ExpectConvex(
    EdgeState::BlockedByShape, { { -3, 1, 0 }, { -2, 0, 0 }, { 2, 0, 0 }, { -3, -1, 0 } });
  ExpectConvex(EdgeState::BlockedByShape, { { 3, 1, 0 }, { -2, 0, 0 }, { 2, 0, 0 }, { 3, -1, 0 } });
  ExpectConvex(
    EdgeState::BlockedByShape, { { -2, 1, 0 }, { -2, 0, 0 }, { 2, 0, 0 }, { -2, -1, 0 } });
  ExpectConvex(EdgeState::BlockedByShape, { { 2, 1, 0 }, { -2, 0, 0 }, { 2, 0, 0 }, { 2, -1, 0 } });
}

bool Spans(double a, double p, double q, double b)
{
  const PlanePoint apqb[4] = { { 3 * a, a, 0 }, { 3 * p, p, 0 }, { 3 * q, q, 0 }, { 3 * b, b, 0 } };
  const PlanePoint turned[4] = { apqb[3], apqb[2], apqb[1], apqb[0] };
  const PlanePoint upright[4] = { { 1, a, 0 }, { 1, p, 0 }, { 1, q, 0 }, { 1, b, 0 } };
  EXPECT_EQ(SpansOpposite(apqb), SpansOpposite(turned));
  EXPECT_EQ(SpansOpposite(apqb), SpansOpposite(upright));
  return SpansOpposite(apqb);
}

TEST(SpansOpposite, HoldsWhereTheFlipShortensTheEdge)
{
  EXPECT_TRUE(Spans(1, 0, 3, 2));
  EXPECT_TRUE(Spans(2, 0, 3, 1));
  EXPECT_TRUE(Spans(1, 0, 3, 1));
  EXPECT_TRUE(Spans(0, 0, 3, 2));
  EXPECT_TRUE(Spans(3, 0, 3, 2));
  EXPECT_TRUE(Spans(0, 0, 3, 0));
  EXPECT_FALSE(Spans(0, 0, 3, 3));
  EXPECT_FALSE(Spans(3, 0, 3, 0));
  EXPECT_FALSE(Spans(1, 0, 3, 4));
  EXPECT_FALSE(Spans(-1, 0, 3, 2));
  EXPECT_FALSE(Spans(-1, 0, 3, 4));
  EXPECT_FALSE(Spans(1, 0, 0, 2));
  EXPECT_FALSE(Spans(0, 0, 0, 0));
}

/// A kite whose angles at a and b are obtuse, so small and so near to the origin that the product
/// of its lengths is far below the smallest number; beside it a mesh of usual size may lie.
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

}
}
