// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentTree.h"

#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace delaunayflip
{
namespace
{

PlanePoint Draw(std::mt19937& random, int size, double scale)
{
  const double u = scale * DrawIndex(random, size);
  return { u, scale * DrawIndex(random, size), 0.0 };
}

/// Of small whole multiples of a power of two.
double Turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  return (b.U - a.U) * (c.V - a.V) - (b.V - a.V) * (c.U - a.U);
}

bool IsBetween(double a, double b, double c) { return std::min(a, b) <= c && c <= std::max(a, b); }

bool IsOn(const SegmentTree::Segment& segment, const PlanePoint& point)
{
  return Turn(segment[0], segment[1], point) == 0 &&
    IsBetween(segment[0].U, segment[1].U, point.U) &&
    IsBetween(segment[0].V, segment[1].V, point.V);
}

bool Meet(const SegmentTree::Segment& a, const SegmentTree::Segment& b)
{
  const double first = Turn(a[0], a[1], b[0]) * Turn(a[0], a[1], b[1]);
  const double second = Turn(b[0], b[1], a[0]) * Turn(b[0], b[1], a[1]);
  return (first < 0 && second < 0) || IsOn(a, b[0]) || IsOn(a, b[1]) || IsOn(b, a[0]) ||
    IsOn(b, a[1]);
}

bool Holds(const SegmentTree::Triangle& triangle, const PlanePoint& point)
{
  const double turns[3] = { Turn(triangle[0], triangle[1], point),
    Turn(triangle[1], triangle[2], point), Turn(triangle[2], triangle[0], point) };
  return (turns[0] >= 0 && turns[1] >= 0 && turns[2] >= 0) ||
    (turns[0] <= 0 && turns[1] <= 0 && turns[2] <= 0);
}

/// Whether a triangle with an area and a segment have a point in common.
bool Touch(const SegmentTree::Triangle& triangle, const SegmentTree::Segment& segment)
{
  return Holds(triangle, segment[0]) || Meet({ triangle[0], triangle[1] }, segment) ||
    Meet({ triangle[1], triangle[2] }, segment) || Meet({ triangle[2], triangle[0] }, segment);
}

void ExpectAllFound(std::uint32_t seed, int size, double scale)
{
  std::mt19937 random(seed);
  std::vector<SegmentTree::Segment> segments(DrawIndex(random, 40));
  for (SegmentTree::Segment& segment : segments)
  {
    segment = { Draw(random, size, scale), Draw(random, size, scale) };
  }
  const SegmentTree tree(segments);
  std::vector<std::int32_t> found;
  for (int i = 0; i < 50; ++i)
  {
    const SegmentTree::Triangle triangle = { Draw(random, size, scale), Draw(random, size, scale),
      Draw(random, size, scale) };
    if (Turn(triangle[0], triangle[1], triangle[2]) == 0)
    {
      continue;
    }
    std::vector<std::int32_t> expected;
    for (std::size_t k = 0; k < segments.size(); ++k)
    {
      if (Touch(triangle, segments[k]))
      {
        expected.push_back(static_cast<std::int32_t>(k));
      }
    }
    tree.FindTouched(triangle, found);
    ASSERT_EQ(expected, found) << seed;
  }
}

TEST(SegmentTree, FindsWhatATriangleTouches)
{
  for (std::uint32_t seed = 0; seed < 300 / Reduction; ++seed)
  {
    ExpectAllFound(seed, 6, 1.0);
    ExpectAllFound(seed, 2000, 0x1p-60);
    ExpectAllFound(seed, 60, 0x1p200);
  }
}

/// Triangles with a corner on a segment, which rounding must not take away from it.
TEST(SegmentTree, FindsSegmentsByTrianglesThatOnlyTouchThem)
{
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i)
  {
    const double v = DrawIndex(random, 1000000) / 999983.0;
    std::vector<SegmentTree::Segment> segments(20, { { { 5, 0, 0 }, { 5, 0, 0 } } });
    segments[i % 20] = { { { 0.1, v, 0 }, { 0.9, v, 0 } } };
    const SegmentTree tree(segments);
    std::vector<std::int32_t> found;
    for (double u = 0.1; u < 0.9; u += 0.04)
    {
      tree.FindTouched(
        { { { u, v, 0 }, { u + 0.001, v - 1, 0 }, { u - 0.001, v - 1, 0 } } }, found);
      EXPECT_EQ(std::vector<std::int32_t>(1, i % 20), found);
      tree.FindTouched(
        { { { u, v, 0 }, { u + 0.001, v + 1, 0 }, { u - 0.001, v + 1, 0 } } }, found);
      EXPECT_EQ(std::vector<std::int32_t>(1, i % 20), found);
    }
  }
}

TEST(SegmentTree, FindsSegmentsByATriangleWithoutArea)
{
  const std::vector<SegmentTree::Segment> segments(1, { { { 0, 0, 0 }, { 4, 4, 0 } } });
  const SegmentTree tree(segments);
  std::vector<std::int32_t> found;
  tree.FindTouched({ { { 0, 4, 0 }, { 4, 0, 0 }, { 1, 3, 0 } } }, found);
  EXPECT_EQ(1u, found.size());
  tree.FindTouched({ { { 5, 4, 0 }, { 9, 0, 0 }, { 6, 3, 0 } } }, found);
  EXPECT_EQ(0u, found.size());
}

TEST(SegmentTree, TakesNumbersOfAnySize)
{
  constexpr double Most = std::numeric_limits<double>::max();
  const std::vector<SegmentTree::Segment> segments = {
    { { { -Most, -Most, 0 }, { Most, Most, 0 } } }, { { { NAN, 0, 0 }, { 1, 1, 0 } } },
    { { { 0, 0, 0 }, { INFINITY, 1, 0 } } }, { { { 2, 3, 0 }, { 2, 3, 0 } } },
    { { { -Most, Most, 0 }, { Most, -Most, 0 } } }
  };
  const SegmentTree tree(segments);
  std::vector<std::int32_t> found;
  tree.FindTouched({ { { 1, 2, 0 }, { 4, 2, 0 }, { 1, 5, 0 } } }, found);
  EXPECT_EQ((std::vector<std::int32_t>{ 0, 3 }), found);
}

}
}
