// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GeneratedMeshes.h"
#include "PartSurvey.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

/// @file
/// Whether stars are simple that are divided among ranks, so that flips need no guard.

namespace delaunayflip
{
namespace
{

/// Whether all ranks find that no guard is needed.
/// @param change changes the pieces before.
bool AreSimple(const OwnedMesh<double>& mesh, const Owners& owners, int ranks,
  const std::function<void(std::vector<OwnedPiece>&)>& change = {})
{
  std::vector<OwnedPiece> pieces = Divide(mesh.View(), owners, ranks);
  if (change)
  {
    change(pieces);
  }
  FlipOptions options = MakeCanonical();
  options.Geometry = GeometryKind::PlanarXY;
  std::vector<unsigned char> simple(ranks);
  RunInThreads(ranks,
    [&](PieceGroup& group)
    {
      const MeshPiece piece = pieces[group.GetRank()].View(true);
      const PointKeys keys = MatchPoints(piece, group);
      simple[group.GetRank()] = SurveyParts(piece, keys, options, group).NeedsGuard() ? 0 : 1;
    });
  EXPECT_EQ(1u, std::set<unsigned char>(simple.begin(), simple.end()).size());
  return simple.front() != 0;
}

/// Triangle i to rank i % ranks.
Owners Deal(const OwnedMesh<double>& mesh, int ranks)
{
  Owners owners;
  for (int t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    owners.push_back(t % ranks);
  }
  return owners;
}

TEST(StarCheck, FansOfLessThanATurnAreSimple)
{
  for (int start = 0; start < 8; ++start)
  {
    for (int count = 1; count <= 8; ++count)
    {
      for (const bool clockwise : { false, true })
      {
        const OwnedMesh<double> mesh = MakeFan(start, count, clockwise);
        EXPECT_TRUE(AreSimple(mesh, Deal(mesh, 1), 1)) << start << " " << count << " " << clockwise;
        EXPECT_TRUE(AreSimple(mesh, Deal(mesh, 3), 3)) << start << " " << count << " " << clockwise;
      }
    }
  }
}

TEST(StarCheck, FansOfMoreThanATurnAreNot)
{
  for (int start = 0; start < 8; ++start)
  {
    for (int count = 9; count < 16; count += 2)
    {
      for (const bool clockwise : { false, true })
      {
        const OwnedMesh<double> mesh = MakeFan(start, count, clockwise);
        EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 1), 1))
          << start << " " << count << " " << clockwise;
        EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 2), 2))
          << start << " " << count << " " << clockwise;
      }
    }
  }
}

TEST(StarCheck, TouchingCornersAreSimple)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0 };
  mesh.Triangles = { 0, 1, 2, 0, 3, 4 };
  EXPECT_TRUE(AreSimple(mesh, { 0, 0 }, 2));
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points[10] = 0.0; // point 3 at (-1, 0): still apart
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, 1, 0.9, 0, -1, 1, 0 };
  EXPECT_FALSE(AreSimple(mesh, { 0, 0 }, 2));
  EXPECT_FALSE(AreSimple(mesh, { 0, 1 }, 2));
  mesh.Points[10] = 1.0; // point 3 where point 2 is: they only touch
  EXPECT_TRUE(AreSimple(mesh, { 0, 1 }, 2));
}

TEST(StarCheck, AStarThatClosesAfterTwoTurnsIsNotSimple)
{
  OwnedMesh<double> mesh = MakeFan(0, 16, false);
  mesh.Triangles.back() = 1;
  EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 1), 1));
  EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 2), 2));
}

/// Two ranks have the star of an inner point, and one of them has the point elsewhere.
TEST(StarCheck, RanksMustAgreeAboutCoordinates)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0 };
  mesh.Triangles = { 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1 };
  EXPECT_TRUE(AreSimple(mesh, { 0, 0, 1, 1 }, 2));
  EXPECT_FALSE(AreSimple(mesh, { 0, 0, 1, 1 }, 2,
    [](std::vector<OwnedPiece>& pieces)
    {
      const std::vector<std::int64_t>& points = pieces[1].PointOf;
      const auto center = std::find(points.begin(), points.end(), 0) - points.begin();
      pieces[1].Doubles[3 * center] += 0.125; // along the seam
      pieces[1].Doubles[3 * center + 1] -= 0.125;
    }));
}

TEST(StarCheck, FlatAndTurnedTrianglesNeedAGuard)
{
  OwnedMesh<double> mesh = MakeGridMesh(4, 4);
  EXPECT_TRUE(AreSimple(mesh, Deal(mesh, 3), 3));
  std::swap(mesh.Triangles[9], mesh.Triangles[10]);
  EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 3), 3));
  std::swap(mesh.Triangles[9], mesh.Triangles[10]);
  mesh.Triangles.insert(mesh.Triangles.end(), { 0, 1, 2 });
  EXPECT_FALSE(AreSimple(mesh, Deal(mesh, 3), 3));
}

TEST(StarCheck, RandomMeshesNeedNoGuard)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(400, 3);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3)
  {
    const auto first = mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(t);
    std::rotate(first, first + t % 5 % 3, first + 3); // triangles may begin with any corner
  }
  for (const bool clockwise : { false, true })
  {
    for (const int ranks : { 1, 2, 5 })
    {
      EXPECT_TRUE(AreSimple(mesh, DivideBySpace(mesh.View(), ranks), ranks)) << clockwise;
      EXPECT_TRUE(AreSimple(mesh, DivideAtRandom(mesh.View(), ranks, 4), ranks)) << clockwise;
    }
    std::reverse(mesh.Triangles.begin(), mesh.Triangles.end());
  }
}

}
}
