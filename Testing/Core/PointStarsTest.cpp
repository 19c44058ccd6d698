// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointStars.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace delaunayflip
{
namespace
{

constexpr int Points = 50;

PieceTriangle Draw(std::mt19937& random)
{
  PieceTriangle triangle{};
  for (std::int32_t& point : triangle.Points)
  {
    point = DrawIndex(random, Points);
  }
  return triangle;
}

/// 3 * triangle + slot.
std::int64_t GetNumber(const PieceCorner& corner) { return 3 * corner.Triangle + corner.Slot; }

/// The corners at a point.
std::vector<std::int64_t> FindAll(const PointStars& stars, std::int32_t point)
{
  std::vector<std::int64_t> found;
  stars.Find(point,
    [&](const PieceCorner& corner)
    {
      found.push_back(GetNumber(corner));
      return false;
    });
  std::sort(found.begin(), found.end());
  return found;
}

/// Expects that the lists have these triangles.
/// @param isListed one flag per corner.
void ExpectLists(
  const PointStars& stars, const PieceTriangles& triangles, const std::vector<bool>& isListed)
{
  for (std::int32_t point = 0; point < Points; ++point)
  {
    std::vector<std::int64_t> expected;
    for (std::size_t i = 0; i < isListed.size(); ++i)
    {
      if (isListed[i] && triangles[i / 3].Points[i % 3] == point)
      {
        expected.push_back(static_cast<std::int64_t>(i));
      }
    }
    EXPECT_EQ(expected, FindAll(stars, point)) << "point " << point;
  }
}

void AddAll(const PieceTriangles& triangles, std::int64_t points, PointStars& stars)
{
  const auto count = static_cast<std::int64_t>(triangles.size());
  stars.Begin(count, count, points);
  for (std::int64_t corner = 0; corner < 3 * count; ++corner)
  {
    const int slot = static_cast<int>(corner % 3);
    stars.Add({ corner / 3, slot }, triangles[corner / 3].Points[slot]);
  }
}

PieceTriangles DrawSome(std::mt19937& random, int size)
{
  PieceTriangles triangles;
  for (int i = 0; i < size; ++i)
  {
    triangles.push_back(Draw(random));
  }
  return triangles;
}

TEST(PointStars, FollowCornersThatMove)
{
  std::mt19937 random(4);
  PieceTriangles triangles = DrawSome(random, 30);
  PointStars stars;
  std::vector<bool> isListed(3 * triangles.size(), true);
  AddAll(triangles, Points / 2, stars); // the other points come later
  ExpectLists(stars, triangles, isListed);
  for (int step = 0; step < 60; ++step)
  {
    const PieceCorner corner{ 7 * step % 30, step % 3 };
    std::int32_t& point = triangles[corner.Triangle].Points[corner.Slot];
    if (isListed[GetNumber(corner)])
    {
      stars.Remove(corner, point);
    }
    point = DrawIndex(random, Points);
    isListed[GetNumber(corner)] = step % 5 > 0; // some stay away
    if (isListed[GetNumber(corner)])
    {
      stars.Add(corner, point);
    }
    ExpectLists(stars, triangles, isListed);
  }
}

/// Of two points whose corners are visited in turn, one without corners ends the search: an edge
/// between them has triangles at both.
TEST(PointStars, FindAtEitherOfTwoPoints)
{
  std::mt19937 random(5);
  const PieceTriangles triangles = DrawSome(random, 100);
  PointStars stars;
  AddAll(triangles, Points, stars);
  for (std::int32_t point = 1; point < Points; ++point)
  {
    const std::size_t one = FindAll(stars, point - 1).size(), other = FindAll(stars, point).size();
    std::size_t visits = 0, stopped = 0;
    const auto visitAll = [&](const PieceCorner&)
    {
      ++visits;
      return false;
    };
    stars.FindAtEither(point - 1, point, visitAll);
    const std::size_t untilOneIsSeen = one <= other ? 2 * one - 1 : 2 * other;
    EXPECT_EQ(one == 0 ? 0 : untilOneIsSeen, visits);
    stars.FindAtEither(point - 1, point, [&](const PieceCorner&) { return ++stopped == 2; });
    EXPECT_EQ(std::min<std::size_t>(2, visits), stopped);
  }
}

}
}
