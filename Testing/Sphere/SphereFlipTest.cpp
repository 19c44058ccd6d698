// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipError.h"
#include "MeshAudit.h"
#include "PieceFlip.h"
#include "SphereTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>

/// @file
/// Flips of meshes of a globe.

namespace delaunayflip
{
namespace
{

class SphereFlipTest : public testing::TestWithParam<SphereFamily>
{
};

/// Lists the sets in which all triangles face the origin with the same side.
std::vector<SphereFamily> ListWholeFamilies()
{
  std::vector<SphereFamily> families;
  for (const SphereFamily& family : ListSphereFamilies())
  {
    if (!family.IsPart)
    {
      families.push_back(family);
    }
  }
  return families;
}

TEST_P(SphereFlipTest, EndsAtTheConvexHullFromEveryStart)
{
  const OwnedMesh<double> hull = MakeHull(GetParam().Make());
  const FlipResult straight = Flip(hull.View(), OnSphere());
  EXPECT_TRUE(straight.Report.Defects.empty());
  EXPECT_EQ(0, straight.Report.NonDelaunayAfter);
  if (!GetParam().HasTies)
  {
    EXPECT_EQ(0, straight.Report.TotalFlips);
  }
  for (std::uint32_t seed = 1; seed < 4; ++seed)
  {
    OwnedMesh<double> start = hull;
    Scramble(start, 20000, seed);
    const FlipResult result = FlipAndAudit(start.View(), OnSphere());
    EXPECT_LT(100, result.Report.TotalFlips);
    EXPECT_EQ(0, result.Report.NonDelaunayAfter);
    EXPECT_EQ(ToTriangleSet(straight.Triangles), ToTriangleSet(result.Triangles));
    for (const int threads : { 2, 16 })
    {
      EXPECT_EQ(result.Triangles, Flip(start.View(), WithThreads(threads, OnSphere())).Triangles);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SphereFlipTest, testing::ValuesIn(ListWholeFamilies()),
  [](const auto& each) { return std::string(each.param.Name); });

OwnedMesh<double> MakeScrambledLattice()
{
  OwnedMesh<double> mesh = MakeHull(MakeLatticePoints(1001));
  Scramble(mesh, 20000, 5);
  return mesh;
}

TEST(SphereFlip, KeepsTies)
{
  const OwnedMesh<double> hull = MakeHull(MakeLatticePoints(1001));
  const FlipResult kept = FlipAndAudit(hull.View(), OnSphere(TieRuleKind::Keep));
  EXPECT_EQ(0, kept.Report.TotalFlips);
  EXPECT_LT(0, Flip(hull.View(), OnSphere()).Report.TotalFlips);
}

TEST(SphereFlip, DoesNotDependOnTheNumbersOfPoints)
{
  const OwnedMesh<double> mesh = MakeScrambledLattice();
  OwnedMesh<double> reversed = mesh;
  const auto last = static_cast<std::int32_t>(mesh.NumberOfPoints() - 1);
  for (std::int64_t i = 0; i <= last; ++i)
  {
    std::copy_n(&mesh.Points[3 * i], 3, &reversed.Points[3 * (last - i)]);
  }
  for (std::int32_t& id : reversed.Triangles)
  {
    id = last - id;
  }
  std::vector<std::int32_t> renamed = Flip(reversed.View(), OnSphere()).Triangles;
  for (std::int32_t& id : renamed)
  {
    id = last - id;
  }
  EXPECT_EQ(ToTriangleSet(Flip(mesh.View(), OnSphere()).Triangles), ToTriangleSet(renamed));
}

/// Scaling by a power of two does not change the signs, also where the filters do not apply.
TEST(SphereFlip, DoesNotDependOnTheUnit)
{
  const OwnedMesh<double> mesh = MakeScrambledLattice();
  const std::vector<std::int32_t> expected = Flip(mesh.View(), OnSphere()).Triangles;
  for (const double unit : { 0x1p-400, 0x1p400 })
  {
    OwnedMesh<double> scaled = mesh;
    std::for_each(scaled.Points.begin(), scaled.Points.end(), [=](double& x) { x *= unit; });
    EXPECT_EQ(expected, Flip(scaled.View(), OnSphere()).Triangles);
  }
}

TEST(SphereFlip, LeavesHolesAndFixedEdges)
{
  OwnedMesh<double> mesh = MakeScrambledLattice();
  mesh.Triangles.resize(mesh.Triangles.size() - 300); // an open mesh
  const FlipResult open = FlipAndAudit(mesh.View(), OnSphere());
  EXPECT_LT(0, open.Report.Edges.Boundary);
  EXPECT_EQ(0, open.Report.NonDelaunayAfter);
  const std::vector<unsigned char> frozen(mesh.NumberOfTriangles(), 1);
  TriangleMesh view = mesh.View();
  view.FrozenTriangles = frozen.data();
  EXPECT_EQ(0, Flip(view, OnSphere()).Report.TotalFlips);
}

TEST(SphereFlip, TakesMeshesTurnedInside)
{
  OwnedMesh<double> mesh = MakeScrambledLattice();
  const TriangleSet expected = ToTriangleSet(Flip(mesh.View(), OnSphere()).Triangles);
  for (std::size_t i = 0; i < mesh.Triangles.size(); i += 3)
  {
    std::swap(mesh.Triangles[i], mesh.Triangles[i + 1]);
  }
  std::vector<std::int32_t> turned = FlipAndAudit(mesh.View(), OnSphere()).Triangles;
  for (std::size_t i = 0; i < turned.size(); i += 3)
  {
    std::swap(turned[i], turned[i + 1]);
  }
  EXPECT_EQ(expected, ToTriangleSet(turned));
}

/// The edges of a point inside of the hull stay, and are counted.
TEST(SphereFlip, CountsEdgesOfPointsInside)
{
  const double xyz[] = { 0, 0, -1.2, 4, 0, -1, -2, 3, -1, -2, -3, -1, 0, 0, -4 };
  const std::int32_t ids[] = { 0, 1, 2, 0, 2, 3, 0, 3, 1, 4, 2, 1, 4, 3, 2, 4, 1, 3 };
  TriangleMesh mesh;
  mesh.Points = PointArray(xyz, 5);
  mesh.Triangles = TriangleArray(ids, 6);
  mesh.Center[2] = -2.0;
  const FlipResult result = FlipAndAudit(mesh, OnSphere());
  EXPECT_EQ(3, result.Report.BlockedByShape);
  EXPECT_EQ(0, result.Report.TotalFlips);
}

TEST(SphereFlip, NamesTrianglesThatFaceTheCenter)
{
  OwnedMesh<double> mesh = MakeScrambledLattice();
  std::swap(mesh.Triangles[30], mesh.Triangles[31]);
  const FlipReport report = Flip(mesh.View(), OnSphere()).Report;
  ASSERT_EQ(1u, report.Defects.size());
  EXPECT_EQ(DefectKind::TurnedFromMost, report.Defects[0].Kind);
  EXPECT_EQ(std::vector<std::int64_t>{ 10 }, report.Defects[0].FirstIds);
}

TEST(SphereFlip, RefusesWhatHasNoMeaning)
{
  const OwnedMesh<double> mesh = MakeScrambledLattice();
  EXPECT_THROW(
    Flip(mesh.View(), With(&FlipOptions::Criterion, CriterionKind::OppositeAngles, OnSphere())),
    InvalidOptions);
  EXPECT_THROW(
    Flip(mesh.View(), With(&FlipOptions::NumberOfPieces, 2, OnSphere())), InvalidOptions);
}

}
}
