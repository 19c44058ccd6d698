// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "References.h"
#include "TriangleAngles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>

namespace delaunayflip
{
namespace
{

/// Whether a triangle names no point twice. Otherwise it has no edges.
bool HasEdges(const std::vector<std::int32_t>& triangles, std::size_t triangle)
{
  const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(3 * triangle);
  return std::set<std::int32_t>(first, first + 3).size() == 3;
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
        forward += from == p && to == q && HasEdges(triangles, corner / 3);
        backward += from == q && to == p && HasEdges(triangles, corner / 3);
      }
      counts.Edges += forward + backward > 0;
      counts.Boundary += forward + backward == 1;
      counts.NonManifold += forward + backward > 2;
      counts.WronglyWound += forward + backward == 2 && forward != 1;
    }
  }
  return counts;
}

TEST(EdgeCounts, AgreeWithBruteForce)
{
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i)
  {
    const int points = 3 + DrawIndex(random, 12);
    const OwnedMesh<double> mesh = MakeSoup(points, 1 + DrawIndex(random, 30), i);
    const EdgeCounts expected = CountByBruteForce(mesh.Triangles, points);
    const std::set<std::int32_t> used(mesh.Triangles.begin(), mesh.Triangles.end());
    const FlipReport report = MakeSession(mesh.View()).GetReport();
    for (const EdgeCounts& found : { CountEdges(mesh.View().Triangles), report.Edges })
    {
      EXPECT_EQ(expected.Edges, found.Edges);
      EXPECT_EQ(expected.Boundary, found.Boundary);
      EXPECT_EQ(expected.NonManifold, found.NonManifold);
      EXPECT_EQ(expected.WronglyWound, found.WronglyWound);
    }
    std::int64_t euler = static_cast<std::int64_t>(used.size()) - expected.Edges;
    for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
    {
      euler += HasEdges(mesh.Triangles, t);
    }
    EXPECT_EQ(euler, EulerCharacteristic(mesh.View().Triangles));
    EXPECT_EQ(euler, report.EulerCharacteristic);
    ASSERT_FALSE(HasFailure()) << "soup " << i;
  }
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

TEST(NonDelaunayEdges, DependOnTheGeometry)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const struct
  {
    const char* Name;
    std::vector<double> Points;
    int InPlane, OnSurface; ///< Bad edges by x and y, and in space.
  } cases[] = { { "tie", { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, 0, 0 },
    { "inverted pair", { -2, 0, 0, 0, -1, 0, 2, 0, 0, 0, -0.5, 0 }, 0, 0 },
    { "flat cap", { -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 1, 0 }, 1, 1 },
    { "not a number", { -2, 0, 0, nan, 0, 0, 2, 0, 0, 0, 1, 0 }, 0, 0 },
    { "terrain", { -2, 0, 0, 0, -1, 100, 2, 0, 0, 0, 1, 0 }, 1, 0 } };
  for (const auto& one : cases)
  {
    SCOPED_TRACE(one.Name);
    const OwnedMesh<double> mesh = MakePair(one.Points);
    EXPECT_EQ(one.InPlane, CountBad(mesh.View(), GeometryKind::PlanarXY));
    EXPECT_EQ(one.OnSurface, CountBad(mesh.View(), GeometryKind::Surface));
  }
}

TEST(NonDelaunayEdges, AreNotEdgesThatMustStay)
{
  const OwnedMesh<double> bad = MakeBadPair();
  EXPECT_EQ(0, CountBad(WithConstraints(bad.View(), { 2, 0 })));
  TriangleMesh mesh = bad.View();
  const std::int32_t regions[] = { 4, 5 };
  mesh.Regions = regions;
  EXPECT_EQ(0, CountBad(mesh));
  mesh = bad.View();
  const unsigned char frozen[] = { 0, 1 };
  mesh.FrozenTriangles = frozen;
  EXPECT_EQ(0, CountBad(mesh));
}

TEST(NonDelaunayEdges, OfSurfacesObeyFeatureAngleAndTolerance)
{
  // Both triangles rise towards the bad edge; their normals differ by 2 atan(1/2) = 53 degrees.
  const OwnedMesh<double> roof = MakePair({ -2, 0, 0.5, 0, -1, 0, 2, 0, 0.5, 0, 1, 0 });
  FlipOptions options = OnSurface(53.0);
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

/// b is off the line p-q by more than it looks like from a, half a unit away.
TEST(MeshAudit, SeesShortLegsBesideLongOnes)
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0.5, 0.5, 0.0, -0x1p-52, 0.0, 0.0, 0x1p-52, 0.0, 0.0, 0.0, -1e-17, 0.0 };
  mesh.Triangles = { 0, 1, 2, 3, 2, 1 };
  FlipOptions options = With(&FlipOptions::Criterion, CriterionKind::OppositeAngles, InPlane());
  options.Tolerance = 0.0;
  EXPECT_EQ(0, CountNonDelaunayEdges(mesh.View(), options));
  EXPECT_EQ(0, Flip(mesh.View(), options).Report.NonDelaunayAfter);
}

//------------------------------------------------------------------------------
std::vector<double> FindAngles(const TriangleMesh& mesh, GeometryKind geometry, int threads = 2)
{
  std::vector<double> angles(mesh.Triangles.Count, -1.0);
  FindSmallestAngles(mesh, geometry, threads, angles.data());
  return angles;
}

void ExpectLongAngles(const TriangleMesh& mesh, GeometryKind geometry)
{
  const std::vector<double> angles = FindAngles(mesh, geometry);
  for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
  {
    LongVector corners[3] = {};
    for (int i = 0; i < 6 + (geometry == GeometryKind::PlanarXY ? 0 : 3); ++i)
    {
      corners[i % 3][i / 3] = mesh.Points.Get(mesh.Triangles.Get(t, i % 3), i / 3);
    }
    const auto& [a, b, c] = corners;
    const long double smallest =
      std::min({ FindAngle(a, b, c), FindAngle(b, c, a), FindAngle(c, a, b) });
    ASSERT_NEAR(static_cast<double>(smallest * 180.0L / std::acos(-1.0L)), angles[t], 1e-9) << t;
  }
}

TEST(TriangleAngles, AreThoseOfInverseTrigonometry)
{
  for (const GeometryKind geometry :
    { GeometryKind::Planar, GeometryKind::Surface, GeometryKind::PlanarXY })
  {
    ExpectLongAngles(MakeRandomBadMesh(3000, 5).View(), geometry);
    ExpectLongAngles(MakeRandomBadMeshDouble(3000, 6).View(), geometry);
    ExpectLongAngles(MakeBadSphere(40, 21, 7).View(), geometry);
  }
}

TEST(TriangleAngles, DoNotDependOnThreadsOrIds)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(30000, 8);
  const std::vector<std::int64_t> ids(mesh.Triangles.begin(), mesh.Triangles.end());
  TriangleMesh wide = mesh.View();
  wide.Triangles = TriangleArray(ids.data(), mesh.NumberOfTriangles());
  const std::vector<double> expected = FindAngles(mesh.View(), GeometryKind::Planar, 1);
  for (const int threads : { 0, 2, 7 })
  {
    EXPECT_EQ(expected, FindAngles(wide, GeometryKind::Planar, threads));
  }
}

/// The smallest angle of one triangle, which the audit finds, too.
double MeasureOne(const std::vector<double>& points, GeometryKind geometry = GeometryKind::Surface)
{
  const OwnedMesh<double> mesh = { points, { 0, 1, 2 } };
  const double angle = FindAngles(mesh.View(), geometry)[0];
  const double audited = MinimumAngle(mesh.View(), geometry);
  EXPECT_TRUE(std::isnan(angle) ? std::isnan(audited) : std::fabs(audited - angle) <= 1e-12);
  return angle;
}

TEST(TriangleAngles, AtAnyScaleAndCorner)
{
  for (double s : { 1.0, 1e-300, 1e-160, 1e160, 1e308 })
  {
    EXPECT_NEAR(30.0, MeasureOne({ 0, 0, 0, s, 0, 0, 0, s * std::sqrt(1.0 / 3.0), 0 }), 1e-12) << s;
    EXPECT_NEAR(45.0, MeasureOne({ 0, 0, 0, s, 0, 0, 0, 0, s }), 1e-12) << s;
  }
  EXPECT_NEAR(60.0, MeasureOne({ 1, 0, 0, 0, 1, 0, 0, 0, 1 }), 1e-12);
  std::vector<double> needle = { 0, 0, 0, 1, 0, 0, 1, 1e-10, 0 };
  for (int turn = 0; turn < 3; ++turn)
  {
    EXPECT_NEAR(1e-10 * 57.29577951308232, MeasureOne(needle, GeometryKind::Planar), 1e-24);
    std::rotate(needle.begin(), needle.begin() + 3, needle.end());
  }
  EXPECT_TRUE(std::isnan(MinimumAngle(TriangleMesh(), GeometryKind::Auto)));
}

TEST(TriangleAngles, WithoutAreaTheyAreZero)
{
  for (const std::vector<double>& points :
    std::vector<std::vector<double>>{
      { 0, 0, 0, 1, 0, 0, 3, 0, 0 }, { 0, 0, 0, 0, 0, 0, 3, 0, 0 }, { 1, 1, 1, 1, 1, 1, 1, 1, 1 } })
  {
    EXPECT_EQ(0.0, MeasureOne(points));
    EXPECT_EQ(0.0, MeasureOne(points, GeometryKind::PlanarXY));
  }
  EXPECT_EQ(0.0, MeasureOne({ 0, 0, 0, 1, 0, 1, 2, 0, 0 }, GeometryKind::PlanarXY));
  EXPECT_NEAR(45.0, MeasureOne({ 0, 0, 0, 1, 0, 1, 2, 0, 0 }), 1e-12);
}

TEST(TriangleAngles, NaNWhereACoordinateThatMattersIsNotFinite)
{
  for (const double x : std::initializer_list<double>{ std::nan(""), -INFINITY })
  {
    EXPECT_TRUE(std::isnan(MeasureOne({ 0, 0, 0, 1, x, 0, 0, 1, 0 }, GeometryKind::PlanarXY)));
    EXPECT_TRUE(std::isnan(MeasureOne({ 0, 0, 0, 1, 0, 0, 0, 1, x })));
    EXPECT_NEAR(45.0, MeasureOne({ 0, 0, 0, 1, 0, 0, 0, 1, x }, GeometryKind::PlanarXY), 1e-12);
  }
}

TEST(TriangleAngles, NameATriangleWithoutItsPoint)
{
  const std::vector<double> points{ 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  const std::vector<std::int64_t> triangles{ 0, 1, 2, 0, 3, 2, 0, 1, -1 };
  TriangleMesh mesh;
  mesh.Points = PointArray(points.data(), 3);
  mesh.Triangles = TriangleArray(triangles.data(), 3);
  ExpectInvalidMesh(1, 3, [&] { FindAngles(mesh, GeometryKind::Planar); });
}

}
}
