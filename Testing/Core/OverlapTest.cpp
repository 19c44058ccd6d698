// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "Predicates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace delaunayflip
{
namespace
{

/// Planar meshes that overlap themselves: with either tie rule, flips must end and create no edge
/// twice.
std::int64_t FlipOverlapping(const OwnedMesh<double>& mesh)
{
  std::int64_t left = 0;
  for (TieRuleKind rule : { TieRuleKind::Keep, TieRuleKind::Canonical })
  {
    FlipOptions options;
    options.TieRule = rule;
    const FlipResult result = Flip(mesh.View(), options);
    EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
    EXPECT_TRUE(result.Report.Converged());
    ExpectSameTopology(mesh.View().Triangles, result.Triangles, result.Report);
    ExpectConsistentStatistics(result.Report);
    left += CountNonDelaunayEdges(WithTriangles(mesh.View(), result.Triangles), options);
  }
  return left;
}

/// A fan of `count` triangles that winds `turns` times around vertex 0; closed, or open like a
/// spiral staircase.
OwnedMesh<double> MakeWindingFan(int count, int turns, bool closed, std::uint32_t seed)
{
  std::mt19937 random(seed);
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0 };
  for (int i = 0; i <= count; ++i)
  {
    const double angle = 6.283185307179586 * turns * i / count;
    const double radius = 1.0 + DrawIndex(random, 1000) / 100.0;
    mesh.Points.insert(
      mesh.Points.end(), { radius * std::cos(angle), radius * std::sin(angle), 0.0 });
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    const std::int32_t next = closed && i + 1 == count ? 1 : i + 2;
    mesh.Triangles.insert(mesh.Triangles.end(), { 0, i + 1, next });
  }
  return mesh;
}

TEST(Overlap, FansThatWindTwiceGainNoEdgeTwice)
{
  for (std::uint32_t seed = 0; seed < 200 / Reduction; ++seed)
  {
    const int turns = 2 + static_cast<int>(seed % 2);
    const int count = 3 * turns + static_cast<int>(seed % 11);
    FlipOverlapping(MakeWindingFan(count, turns, true, seed));
    FlipOverlapping(MakeWindingFan(count, turns, false, seed));
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

/// Diamonds on top of each other that share only their lower and upper ends p and q: the bad edge
/// of each would become p-q.
TEST(Overlap, DiamondsThatShareTheirEndsGainNoEdgeTwice)
{
  for (std::int32_t layers = 2; layers < 6; ++layers)
  {
    OwnedMesh<double> mesh = { { 0, -1, 0, 0, 1, 0 }, {} };
    for (std::int32_t layer = 0; layer < layers; ++layer)
    {
      const double shift = 0.01 * layer;
      const std::int32_t left = 2 + 3 * layer;
      mesh.Points.insert(
        mesh.Points.end(), { -3 + shift, 0, 0, 0.5 + shift, 0, 0, 3 + shift, 0, 0 });
      mesh.Triangles.insert(mesh.Triangles.end(),
        { left, 0, left + 1, left, left + 1, 1, left + 2, left + 1, 0, left + 2, 1, left + 1 });
    }
    EXPECT_EQ(2 * (layers - 1), FlipOverlapping(mesh)) << layers;
  }
}

/// Two fans over the same polygon, back to back and joined along the border: flips on both sides
/// would make the same edges, and only one side may get each.
TEST(Overlap, FlatPillowsGainNoEdgeTwice)
{
  std::int64_t blocked = 0;
  for (std::int32_t count = 5; count < 60; ++count)
  {
    std::mt19937 random(static_cast<std::uint32_t>(count));
    OwnedMesh<double> mesh;
    for (std::int32_t i = 0; i < count; ++i)
    {
      const double angle = 6.283185307179586 * (i + DrawIndex(random, 80) / 100.0) / count;
      mesh.Points.insert(mesh.Points.end(), { 3.0 * std::cos(angle), std::sin(angle), 0.0 });
    }
    const std::int32_t other = count / 2;
    for (std::int32_t i = 1; i + 1 < count; ++i)
    {
      const std::int32_t far = (other + i) % count;
      mesh.Triangles.insert(mesh.Triangles.end(), { 0, i, i + 1, other, (far + 1) % count, far });
    }
    blocked += FlipOverlapping(mesh);
    ASSERT_FALSE(HasFailure()) << count << " points";
  }
  EXPECT_LT(0, blocked);
}

/// The slots of the triangles with this exact orientation: 1, -1, or 0 without area.
std::vector<std::int64_t> FindTurns(const OwnedMesh<double>& mesh, int side)
{
  std::vector<std::int64_t> slots;
  for (std::size_t corner = 0; corner < mesh.Triangles.size(); corner += 3)
  {
    const double* points[3];
    for (std::size_t i = 0; i < 3; ++i)
    {
      points[i] = &mesh.Points[3 * static_cast<std::size_t>(mesh.Triangles[corner + i])];
    }
    if (Orientation(points[0], points[1], points[2]) == side)
    {
      slots.push_back(static_cast<std::int64_t>(corner / 3));
    }
  }
  return slots;
}

/// A vertex that is moved out of its star inverts triangles. Triangles of opposite orientation
/// never flip with each other.
TEST(Overlap, InvertedTrianglesAreReportedAndSurvived)
{
  std::mt19937 random(7);
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 71);
  for (int i = 0; i < 20; ++i)
  {
    const std::int32_t point = 4 + DrawIndex(random, 1996);
    mesh.Points[3 * point] = DrawIndex(random, 1000) / 1000.0;
  }
  FlipOverlapping(mesh);
  std::vector<std::int64_t> inverted = FindTurns(mesh, -1);
  ASSERT_LT(20u, inverted.size());
  ASSERT_LT(inverted.size(), FindTurns(mesh, 1).size());
  ASSERT_TRUE(FindTurns(mesh, 0).empty());
  const std::vector<Defect> defects = MakeSession(mesh.View()).GetReport().Defects;
  ASSERT_EQ(1u, defects.size()) << DescribeDefects(defects);
  EXPECT_EQ("triangles that turn the other way than most", defects[0].What);
  EXPECT_EQ(static_cast<std::int64_t>(inverted.size()), defects[0].Count);
  EXPECT_EQ(DefectIds::Triangles, defects[0].Ids);
  inverted.resize(3);
  EXPECT_EQ(inverted, defects[0].FirstIds);
}

}
}
