// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointStars.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
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

/// Expects that the lists have these triangles.
/// @param isListed one flag per triangle.
void ExpectLists(
  const PointStars& stars, const PieceTriangles& triangles, const std::vector<bool>& isListed)
{
  std::vector<std::int64_t> fromAll, together;
  std::vector<std::int32_t> all(Points);
  std::iota(all.begin(), all.end(), 0);
  stars.ForEachOf(all, [&](std::int64_t t) { together.push_back(t); });
  for (std::int32_t point = 0; point < Points; ++point)
  {
    std::vector<std::int64_t> expected, found;
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const std::int32_t(&points)[3] = triangles[t].Points;
      const auto corners = isListed[t] ? std::count(points, points + 3, point) : 0;
      expected.insert(expected.end(), corners, static_cast<std::int64_t>(t));
    }
    stars.ForEach(point, [&](std::int64_t t) { found.push_back(t); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(expected, found) << "point " << point;
    fromAll.insert(fromAll.end(), expected.begin(), expected.end());
  }
  std::sort(fromAll.begin(), fromAll.end());
  std::sort(together.begin(), together.end());
  EXPECT_EQ(fromAll, together);
}

TEST(PointStars, FollowTrianglesThatChange)
{
  std::mt19937 random(4);
  PieceTriangles triangles;
  for (int i = 0; i < 30; ++i)
  {
    triangles.push_back(Draw(random));
  }
  PointStars stars;
  std::vector<bool> isListed(triangles.size(), true);
  stars.AddAll(triangles, Points / 2); // the other points come later
  ExpectLists(stars, triangles, isListed);
  for (int step = 0; step < 40; ++step)
  {
    const std::vector<std::int64_t> changed{ step % 30, (7 * step + 1) % 30, (11 * step + 2) % 30 };
    stars.Remove(triangles, changed);
    for (const std::int64_t t : changed)
    {
      isListed[t] = false;
    }
    ExpectLists(stars, triangles, isListed);
    for (const std::int64_t t : changed)
    {
      if (!isListed[t] && t != step % 5) // some stay away
      {
        isListed[t] = true;
        triangles[t] = Draw(random);
        stars.Add(triangles, t);
      }
    }
    triangles.push_back(Draw(random));
    isListed.push_back(true);
    stars.Add(triangles, static_cast<std::int64_t>(triangles.size()) - 1);
    ExpectLists(stars, triangles, isListed);
  }
}

}
}
