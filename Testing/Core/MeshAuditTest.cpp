// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "FlipTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace delaunayflip
{
namespace
{

/// Random triangles on a few points: every kind of edge, and triangles with repeated ids.
std::vector<std::int32_t> DrawSoup(std::mt19937& random, int points, int triangles)
{
  std::vector<std::int32_t> ids;
  for (int i = 0; i < 3 * triangles; ++i)
  {
    ids.push_back(DrawIndex(random, points));
  }
  return ids;
}

/// Counts edges by a search through all triangles for every pair of points.
EdgeCounts CountByBruteForce(const std::vector<std::int32_t>& triangles, int points)
{
  EdgeCounts counts;
  for (int p = 0; p < points; ++p)
  {
    for (int q = p + 1; q < points; ++q)
    {
      int forward = 0;
      int backward = 0;
      for (std::size_t corner = 0; corner < triangles.size(); ++corner)
      {
        const int from = triangles[corner];
        const int to = triangles[corner % 3 == 2 ? corner - 2 : corner + 1];
        forward += from == p && to == q;
        backward += from == q && to == p;
      }
      counts.Edges += forward + backward > 0;
      counts.Boundary += forward + backward == 1;
      counts.NonManifold += forward + backward > 2;
      counts.WronglyWound += forward + backward == 2 && forward != 1;
    }
  }
  return counts;
}

void ExpectSameCounts(const EdgeCounts& a, const EdgeCounts& b)
{
  EXPECT_EQ(a.Edges, b.Edges);
  EXPECT_EQ(a.Boundary, b.Boundary);
  EXPECT_EQ(a.NonManifold, b.NonManifold);
  EXPECT_EQ(a.WronglyWound, b.WronglyWound);
}

TEST(EdgeCounts, AgreeWithBruteForce)
{
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i)
  {
    const int points = 3 + DrawIndex(random, 12);
    const std::vector<std::int32_t> soup = DrawSoup(random, points, 1 + DrawIndex(random, 30));
    const EdgeCounts expected = CountByBruteForce(soup, points);
    ExpectSameCounts(expected, CountEdges(ViewTriangles(soup)));

    OwnedMesh<double> mesh;
    mesh.Triangles = soup;
    for (int k = 0; k < 3 * points; ++k)
    {
      mesh.Points.push_back(DrawIndex(random, 10));
    }
    const std::set<std::int32_t> used(soup.begin(), soup.end());
    const FlipReport report = MakeSession(mesh.View()).GetReport();
    ExpectSameCounts(expected, report.Edges);
    EXPECT_EQ(static_cast<std::int64_t>(used.size()) - expected.Edges + mesh.NumberOfTriangles(),
      report.EulerCharacteristic);
    ASSERT_FALSE(HasFailure()) << "soup " << i;
  }
}

TEST(EulerCharacteristic, TellsSurfacesApart)
{
  EXPECT_EQ(0, EulerCharacteristic(TriangleArray()));
  EXPECT_EQ(1, EulerCharacteristic(MakeGridMesh(4, 3).View().Triangles));
  EXPECT_EQ(2, EulerCharacteristic(MakeBadSphere(9, 5, 1).View().Triangles));
  EXPECT_EQ(0, EulerCharacteristic(MakeMoebiusStrip(9, 2, 1).View().Triangles));
  EXPECT_EQ(1, EulerCharacteristic(MakeRandomBadMesh(500, 1).View().Triangles));
}

TEST(GeneratedMeshes, AreWhatTheySay)
{
  const EdgeCounts sphere = CountEdges(MakeBadSphere(9, 5, 1).View().Triangles);
  EXPECT_EQ(0, sphere.Boundary + sphere.NonManifold + sphere.WronglyWound);
  const EdgeCounts strip = CountEdges(MakeMoebiusStrip(9, 2, 1).View().Triangles);
  EXPECT_EQ(18, strip.Boundary);
  EXPECT_EQ(0, strip.NonManifold);
  EXPECT_EQ(2, strip.WronglyWound);
  const OwnedMesh<float> bad = MakeRandomBadMesh(5000, 4);
  EXPECT_EQ(5000, bad.NumberOfPoints());
  EXPECT_EQ(2 * 5000 - 6, bad.NumberOfTriangles());
  const EdgeCounts square = CountEdges(bad.View().Triangles);
  EXPECT_EQ(4, square.Boundary);
  EXPECT_EQ(0, square.NonManifold + square.WronglyWound);
}

TEST(DuplicateEdgesGained, AreCountedWhereThreeTrianglesMeet)
{
  // The second mesh has a third triangle at 0-1. 2-3 is new as well, but has only two triangles.
  const std::vector<std::int32_t> before = { 0, 1, 2, 1, 0, 3, 4, 5, 6, 5, 4, 7 };
  const std::vector<std::int32_t> after = { 0, 1, 2, 1, 0, 3, 0, 1, 6, 2, 3, 7 };
  EXPECT_EQ(0, CountDuplicateEdgesGained(ViewTriangles(before), ViewTriangles(before)));
  EXPECT_EQ(1, CountDuplicateEdgesGained(ViewTriangles(before), ViewTriangles(after)));
  EXPECT_EQ(0, CountDuplicateEdgesGained(ViewTriangles(after), ViewTriangles(before)));
  EXPECT_EQ(0, CountDuplicateEdgesGained(ViewTriangles(after), ViewTriangles(after)));
}

/// Two triangles (0, 1, 2) and (0, 2, 3) on either side of edge 0-2.
OwnedMesh<double> MakePair(const std::vector<double>& points)
{
  return { points, { 0, 1, 2, 0, 2, 3 } };
}

/// A planar rhombus, divided along its long diagonal.
OwnedMesh<double> MakeBadPair() { return MakePair({ -2, 0, 0, 0, -1, 0, 2, 0, 0, 0, 1, 0 }); }

std::int64_t CountBad(const TriangleMesh& mesh, GeometryKind geometry = GeometryKind::Auto,
  CriterionKind criterion = CriterionKind::InCircle)
{
  FlipOptions options;
  options.Geometry = geometry;
  options.Criterion = criterion;
  return CountNonDelaunayEdges(mesh, options);
}

TEST(NonDelaunayEdges, AreCountedInEveryGeometry)
{
  OwnedMesh<double> mesh = MakeBadPair();
  for (int direction = 0; direction < 2; ++direction)
  {
    for (GeometryKind geometry :
      { GeometryKind::Auto, GeometryKind::Planar, GeometryKind::PlanarXY, GeometryKind::Surface })
    {
      EXPECT_EQ(1, CountBad(mesh.View(), geometry));
      EXPECT_EQ(1, CountBad(mesh.View(), geometry, CriterionKind::OppositeAngles));
    }
    ReverseTriangles(mesh.Triangles);
  }
  mesh.Triangles = { 0, 1, 3, 1, 2, 3 };
  EXPECT_EQ(0, CountBad(mesh.View()));
  EXPECT_EQ(0, CountBad(mesh.View(), GeometryKind::Surface));
}

TEST(NonDelaunayEdges, AreNotTiesInvertedPairsOrEdgesThatMustStay)
{
  EXPECT_EQ(0, CountBad(MakeGridMesh(1, 1).View()));
  EXPECT_EQ(0, CountBad(MakePair({ -2, 0, 0, 0, -1, 0, 2, 0, 0, 0, -0.5, 0 }).View()));

  const OwnedMesh<double> bad = MakeBadPair();
  TriangleMesh mesh = bad.View();
  const std::int64_t constraint[] = { 2, 0 };
  mesh.ConstraintEdges = constraint;
  mesh.NumberOfConstraintEdges = 1;
  EXPECT_EQ(0, CountBad(mesh));
  mesh = bad.View();
  const std::int32_t regions[] = { 4, 5 };
  mesh.Regions = regions;
  EXPECT_EQ(0, CountBad(mesh));
  mesh = bad.View();
  const unsigned char frozen[] = { 0, 1 };
  mesh.FrozenTriangles = frozen;
  EXPECT_EQ(0, CountBad(mesh));
}

TEST(NonDelaunayEdges, IncludeFlatCapsAndMayNotBeJudgedWithNaN)
{
  OwnedMesh<double> cap = MakePair({ -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0 });
  EXPECT_EQ(1, CountBad(cap.View()));
  EXPECT_EQ(1, CountBad(cap.View(), GeometryKind::Surface));
  cap.Points[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(0, CountBad(cap.View()));
  EXPECT_EQ(0, CountBad(cap.View(), GeometryKind::Surface));
}

TEST(NonDelaunayEdges, OfTerrainIgnoreHeight)
{
  OwnedMesh<double> terrain = MakeBadPair();
  terrain.Points[5] = 100.0;
  EXPECT_EQ(1, CountBad(terrain.View(), GeometryKind::PlanarXY));
  EXPECT_EQ(1, CountBad(terrain.View(), GeometryKind::PlanarXY, CriterionKind::OppositeAngles));
  EXPECT_EQ(0, CountBad(terrain.View(), GeometryKind::Surface));
}

TEST(NonDelaunayEdges, OfSurfacesObeyFeatureAngleAndTolerance)
{
  // Both triangles rise towards the bad edge; their normals differ by 2 atan(1/2) = 53 degrees.
  const OwnedMesh<double> roof = MakePair({ -2, 0, 0.5, 0, -1, 0, 2, 0, 0.5, 0, 1, 0 });
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 53.0;
  EXPECT_EQ(0, CountNonDelaunayEdges(roof.View(), options));
  options.FeatureAngle = 53.2;
  EXPECT_EQ(1, CountNonDelaunayEdges(roof.View(), options));
  // The angle at each apex is 2 atan(2 / sqrt(1.25)); the sum exceeds pi by this much:
  const double excess = 4.0 * std::atan(2.0 / std::sqrt(1.25)) - 3.14159265358979323846;
  options.Tolerance = excess - 1e-12;
  EXPECT_EQ(1, CountNonDelaunayEdges(roof.View(), options));
  options.Tolerance = excess + 1e-12;
  EXPECT_EQ(0, CountNonDelaunayEdges(roof.View(), options));
}

double SmallestAngle(const std::vector<double>& points, GeometryKind geometry = GeometryKind::Auto)
{
  OwnedMesh<double> mesh = { points, {} };
  for (std::int32_t i = 0; i < mesh.NumberOfPoints(); ++i)
  {
    mesh.Triangles.push_back(i);
  }
  return MinimumAngle(mesh.View(), geometry);
}

TEST(MinimumAngle, IsInDegreesAtAnyScale)
{
  for (double s : { 1.0, 1e-300, 1e-160, 1e160, 1e308 })
  {
    EXPECT_NEAR(45.0, SmallestAngle({ 0, 0, 0, s, 0, 0, 0, 0, s }), 1e-12) << s;
  }
  EXPECT_NEAR(60.0, SmallestAngle({ 1, 0, 0, 0, 1, 0, 0, 0, 1 }), 1e-12);
  EXPECT_NEAR(1e-10 * 57.29577951308232, SmallestAngle({ 0, 0, 0, 1, 0, 0, 1, 1e-10, 0 }), 1e-18);
  EXPECT_NEAR(30.0,
    SmallestAngle({ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, std::sqrt(3.0), 0, 0, 0, 1, 0 }), 1e-12);
}

TEST(MinimumAngle, KnowsDegenerateAndMissingTriangles)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(SmallestAngle({})));
  EXPECT_TRUE(std::isnan(SmallestAngle({ 0, 0, nan, 1, 0, 0, 0, 1, 0 })));
  EXPECT_EQ(0.0, SmallestAngle({ 0, 0, 0, 1, 0, 0, 3, 0, 0 }));
  EXPECT_EQ(0.0, SmallestAngle({ 0, 0, 0, 0, 0, 0, 3, 0, 0 }));
  EXPECT_EQ(0.0, SmallestAngle({ 1, 1, 1, 1, 1, 1, 1, 1, 1 }));
  EXPECT_NEAR(45.0, SmallestAngle({ 0, 0, 0, 1, 0, 50, 0, 1, nan }, GeometryKind::PlanarXY), 1e-12);
}

TEST(Report, AgreesWithTheAudit)
{
  const OwnedMesh<double> meshes[] = { MakeRandomBadMeshDouble(300, 1), MakeBadSphere(20, 9, 2),
    MakeMoebiusStrip(30, 4, 3), MakeGridMesh(5, 5) };
  for (const OwnedMesh<double>& mesh : meshes)
  {
    const FlipResult result = Flip(mesh.View());
    const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
    EXPECT_EQ(CountNonDelaunayEdges(mesh.View(), FlipOptions()), result.Report.NonDelaunayBefore);
    EXPECT_NEAR(
      MinimumAngle(mesh.View(), GeometryKind::Auto), result.Report.MinimumAngleBefore, 1e-9);
    EXPECT_NEAR(MinimumAngle(after, GeometryKind::Auto), result.Report.MinimumAngleAfter, 1e-9);
  }
}

/// b is off the line p-q by more than it looks like from a, half a unit away.
TEST(MeshAudit, SeesShortLegsBesideLongOnes)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.5, 0.5, 0.0, -0x1p-52, 0.0, 0.0, 0x1p-52, 0.0, 0.0, 0.0, -1e-17, 0.0 };
  mesh.Triangles = { 0, 1, 2, 3, 2, 1 };
  FlipOptions options;
  options.Geometry = GeometryKind::PlanarXY;
  options.Criterion = CriterionKind::OppositeAngles;
  options.Tolerance = 0.0;
  EXPECT_EQ(0, CountNonDelaunayEdges(mesh.View(), options));
  EXPECT_EQ(0, Flip(mesh.View(), options).Report.NonDelaunayAfter);
}

}
}
