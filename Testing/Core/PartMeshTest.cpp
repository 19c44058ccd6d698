// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartMesh.h"

#include "FlipTestSupport.h"
#include "LoadedMesh.h"
#include "PartSurvey.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

/// @file
/// The stars of the points of a rank, and its smallest angle after rounds.

namespace delaunayflip
{
namespace
{

constexpr int Points = 50;

PartTriangle Draw(std::mt19937& random)
{
  PartTriangle triangle{};
  for (std::int32_t& point : triangle.Points)
  {
    point = DrawIndex(random, Points);
  }
  return triangle;
}

/// 3 * triangle + slot.
std::int64_t GetNumber(const PartCorner& corner) { return 3 * corner.Triangle + corner.Slot; }

/// The corners at a point.
std::vector<std::int64_t> FindAll(const PointStars& stars, std::int32_t point)
{
  std::vector<std::int64_t> found;
  stars.Find(point,
    [&](const PartCorner& corner)
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
  const PointStars& stars, const PartTriangles& triangles, const std::vector<bool>& isListed)
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

void AddAll(const PartTriangles& triangles, std::int64_t points, PointStars& stars)
{
  const auto count = static_cast<std::int64_t>(triangles.size());
  stars.Begin(count, count, points);
  for (std::int64_t corner = 0; corner < 3 * count; ++corner)
  {
    const int slot = static_cast<int>(corner % 3);
    stars.Add({ corner / 3, slot }, triangles[corner / 3].Points[slot]);
  }
}

PartTriangles DrawSome(std::mt19937& random, int size)
{
  PartTriangles triangles;
  for (int i = 0; i < size; ++i)
  {
    triangles.push_back(Draw(random));
  }
  return triangles;
}

TEST(PointStars, FollowCornersThatMove)
{
  std::mt19937 random(4);
  PartTriangles triangles = DrawSome(random, 30);
  PointStars stars;
  std::vector<bool> isListed(3 * triangles.size(), true);
  AddAll(triangles, Points / 2, stars); // the other points come later
  ExpectLists(stars, triangles, isListed);
  for (int step = 0; step < 60; ++step)
  {
    const PartCorner corner{ 7 * step % 30, step % 3 };
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
  const PartTriangles triangles = DrawSome(random, 100);
  PointStars stars;
  AddAll(triangles, Points, stars);
  for (std::int32_t point = 1; point < Points; ++point)
  {
    const std::size_t one = FindAll(stars, point - 1).size(), other = FindAll(stars, point).size();
    std::size_t visits = 0, stopped = 0;
    const auto visitAll = [&](const PartCorner&)
    {
      ++visits;
      return false;
    };
    stars.FindAtEither(point - 1, point, visitAll);
    const std::size_t untilOneIsSeen = one <= other ? 2 * one - 1 : 2 * other;
    EXPECT_EQ(one == 0 ? 0 : untilOneIsSeen, visits);
    stars.FindAtEither(point - 1, point, [&](const PartCorner&) { return ++stopped == 2; });
    EXPECT_EQ(std::min<std::size_t>(2, visits), stopped);
  }
}

//------------------------------------------------------------------------------
/// Two triangles with a common edge, one of them flat, and a third one beside them.
OwnedMesh<double> MakeThreeTriangles()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.5, 0.01, 0.0, 0.5, -1.0, 0.0, //
    2.0, 0.0, 0.0, 3.0, 0.0, 0.0, 2.5, 0.3, 0.0 };
  mesh.Triangles = { 0, 1, 2, 1, 0, 3, 4, 5, 6 };
  return mesh;
}

/// The triangles of a rank after its first flips.
class SmallestAngleTest : public testing::Test
{
protected:
  SmallestAngleTest()
  {
    this->Mesh.TakeTriangles(this->First->ViewHostTriangles(), MarkedEdges());
    this->Mesh.BeginRounds();
  }

  /// The corner at a point of one triangle, which it lists.
  PartCorner ListCorner(std::int32_t point)
  {
    for (std::int64_t corner = 0; corner < 9; ++corner)
    {
      std::int32_t points[3];
      this->Mesh.GetPoints(corner / 3, points);
      if (points[corner % 3] == point)
      {
        this->Mesh.List(corner / 3);
        return { corner / 3, static_cast<int>(corner % 3) };
      }
    }
    return { -1, 0 };
  }

  double Measure() const { return this->Mesh.FindSmallestAngle(this->Survey, 1); }
  /// The same of the listed triangles and those that the engine measures otherwise.
  double MeasureAll()
  {
    this->Mesh.ListAll();
    return this->Measure();
  }

  OwnedMesh<double> Triangles = MakeThreeTriangles();
  std::unique_ptr<PieceGroup> Alone = MakeSingleGroup();
  MeshPiece Piece{ Triangles.View() };
  PartSurvey Survey = SurveyParts(Piece, MatchPoints(Piece, *Alone), FlipOptions(), *Alone);
  std::unique_ptr<LoadedMesh> First =
    LoadOnThreads(Triangles.View(), FlipOptions(), BuildProgress());
  PartMesh Mesh{ Piece, MatchPoints(Piece, *Alone), 0, 0 };
};

TEST_F(SmallestAngleTest, NoTriangleIsListed)
{
  const double found = this->Measure();
  EXPECT_NEAR(1.1458, found, 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), found);
}

TEST_F(SmallestAngleTest, AnotherOneIsListed)
{
  this->ListCorner(4);
  const double found = this->Measure();
  EXPECT_NEAR(1.1458, found, 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), found);
}

TEST_F(SmallestAngleTest, TheFlattestHasChanged)
{
  const PartCorner corner = this->ListCorner(2);
  this->Mesh.Flip(corner, this->Mesh.FindOpenMate(corner));
  const double found = this->Measure();
  EXPECT_NEAR(26.5651, found, 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), found);
}

TEST_F(SmallestAngleTest, TheFlattestHasLeft)
{
  this->Mesh.Release({ this->ListCorner(2).Triangle });
  const double found = this->Measure();
  EXPECT_NEAR(30.9638, found, 1e-4);
  EXPECT_DOUBLE_EQ(this->MeasureAll(), found);
}

}
}
