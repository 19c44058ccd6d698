// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshAudit.h"
#include "PartTestSupport.h"
#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

/// @file
/// Which geometry GeometryKind::Auto chooses, why, and when a run gives a warning.

namespace delaunayflip
{
namespace
{

using HeightOf = std::function<double(double, double)>;

/// A lattice of columns x rows squares with heights.
OwnedMesh<double> MakeHeights(std::int32_t columns, std::int32_t rows, const HeightOf& height)
{
  return Lift(MakeGridMesh(columns, rows), height);
}

double Wave(double x, double y) { return 2.0 * std::sin(0.3 * x) + std::cos(0.4 * y); }

/// Checks the report before the first flip.
FlipReport Survey(const OwnedMesh<double>& mesh, GeometryKind geometry = GeometryKind::Auto)
{
  return MakeSession(mesh.View(), With(&FlipOptions::Geometry, geometry)).GetReport();
}

void ExpectChoice(const OwnedMesh<double>& mesh, GeometryKind geometry, const std::string& reason)
{
  const FlipReport report = Survey(mesh);
  EXPECT_EQ(geometry, report.GeometryUsed);
  EXPECT_NE(std::string::npos, report.GeometryReason.find(reason)) << report.GeometryReason;
  EXPECT_EQ(geometry != GeometryKind::Surface,
    report.GeometryReason.find("the feature angle has no effect") != std::string::npos)
    << report.GeometryReason;
  EXPECT_EQ(geometry, FindGeometry(mesh.View(), FlipOptions()));
}

/// Expects no warning, neither at the beginning nor at the end.
void ExpectNoDefects(const OwnedMesh<double>& mesh)
{
  EXPECT_EQ("", DescribeDefects(Flip(mesh.View()).Report.Defects));
}

/// Triangles that turn right in x and y.
std::int64_t CountRight(const OwnedMesh<double>& mesh, const std::vector<std::int32_t>& triangles)
{
  return CountTurns(WithTriangles(mesh.View(), triangles)).Right;
}

/// One point stands off the plane of the others by a share of the bounding box's diagonal.
TEST(GeometryChoice, APlaneHoldsPointsWithinAMillionthOfTheDiagonal)
{
  const double diagonal = std::hypot(10.0, 10.0);
  const auto makeBumped = [&](double share, double offset)
  {
    OwnedMesh<double> mesh = MakeHeights(
      10, 10, [=](double x, double y) { return x == 4.0 && y == 5.0 ? share * diagonal : 0.0; });
    return Transform(mesh, { { { 1, 0, 0, offset }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } });
  };
  for (const double offset : { 0.0, 1000.0 })
  {
    const OwnedMesh<double> plane = makeBumped(0.99e-6, offset),
                            bumped = makeBumped(1.01e-6, offset);
    EXPECT_EQ(GeometryKind::Planar, Survey(plane, GeometryKind::Planar).GeometryUsed);
    ExpectChoice(plane, GeometryKind::Planar, "all points lie in one plane");
    ExpectChoice(bumped, GeometryKind::PlanarXY, "a height field");
    EXPECT_THROW(Survey(bumped, GeometryKind::Planar), InvalidOptions);
  }
}

TEST(GeometryChoice, ARequestIsHonoured)
{
  const OwnedMesh<double> mesh = MakeGridMesh(5, 5);
  for (GeometryKind geometry :
    { GeometryKind::Planar, GeometryKind::PlanarXY, GeometryKind::Surface })
  {
    const FlipReport report = Survey(mesh, geometry);
    EXPECT_EQ(geometry, report.GeometryUsed);
    EXPECT_EQ(0u, report.GeometryReason.find("as requested")) << report.GeometryReason;
    EXPECT_EQ(geometry, FindGeometry(mesh.View(), With(&FlipOptions::Geometry, geometry)));
  }
}

/// In metres, far from the origin, of either winding.
TEST(GeometryChoice, UtmTerrainIsPlanarXY)
{
  OwnedMesh<double> mesh = Transform(MakeHeights(60, 40, Wave),
    { { { 10, 0, 0, 581311 }, { 0, 10, 0, 4785270 }, { 0, 0, 10, 900 } } });
  for (int winding = 0; winding < 2; ++winding)
  {
    ExpectChoice(mesh, GeometryKind::PlanarXY,
      "a height field over x and y, and 100 % of its area slopes below 45 degrees");
    ExpectNoDefects(mesh);
    ReverseTriangles(mesh.Triangles);
  }
}

/// Even rough terrain: in degrees and metres slopes mean nothing.
OwnedMesh<double> MakeDegreesAndMetres()
{
  const AffineMap map = { { { 70, 0, 0, 156 }, { 0, 40, 0, 40 }, { 0, 0, 0, 0 } } };
  return Lift(Transform(MakeRandomBadMeshDouble(5000, 31), map),
    [](double x, double y) { return 100.0 * Wave(x, y); });
}

TEST(GeometryChoice, DegreesAndMetresArePlanarXY)
{
  const OwnedMesh<double> mesh = MakeDegreesAndMetres();
  ExpectChoice(mesh, GeometryKind::PlanarXY,
    "a height field over x and y, and z extends further than x and y");
  const FlipResult result = Flip(mesh.View());
  EXPECT_EQ(0, CountRight(mesh, result.Triangles));
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ("", DescribeDefects(result.Report.Defects));
}

/// Random points in a square around the origin, badly triangulated: slivers, with heights.
OwnedMesh<double> MakeSlivers(const HeightOf& height)
{
  return Lift(Transform(MakeRandomBadMeshDouble(5000, 34), ScaleAndMove(2.0, -1.0)), height);
}

/// The planes of slivers are steep where no edge is.
TEST(GeometryChoice, GentleTerrainMayBeFullOfSlivers)
{
  const OwnedMesh<double> hills =
    MakeSlivers([](double x, double y) { return 0.1 * std::sin(8.0 * x) * std::cos(6.0 * y); });
  ExpectChoice(hills, GeometryKind::PlanarXY, "97 % of its area slopes below 45 degrees");
  const FlipResult result = Flip(hills.View());
  EXPECT_EQ(0, result.Report.NonDelaunayAfter);
  EXPECT_EQ(0, CountRight(hills, result.Triangles));
}

struct SteepScan
{
  HeightOf Height;
  const char* Share; ///< What counts as gentle: level parts, and slivers that run across the slope.
};

/// A dome, a box with tapered sides, and a roof of 53 degrees.
TEST(GeometryChoice, SteepScansFullOfSliversAreSurfaces)
{
  const SteepScan scans[] = {
    { [](double x, double y) { return std::sqrt(2.01 - x * x - y * y); }, "but only 34 %" },
    { [](double x, double y)
      { return std::clamp(20.0 * (0.6 - std::max(std::fabs(x), std::fabs(y))), 0.0, 0.8); },
      "but only 15 %" },
    { [](double x, double) { return 1.35 * std::fabs(x); }, "but only 6 %" },
  };
  for (const SteepScan& scan : scans)
  {
    ExpectChoice(MakeSlivers(scan.Height), GeometryKind::Surface, scan.Share);
  }
}

/// Only slivers are judged by their edges: none of these slopes by more than 40 degrees, and the
/// planes of the triangles by 60.
TEST(GeometryChoice, WellShapedTrianglesAreJudgedByTheirPlanes)
{
  const double height = std::sqrt(3.0);
  const OwnedMesh<double> roof = { { -2, 0, 0, 2, 0, 0, 0, -1, -height, 0, 1, -height },
    { 0, 2, 1, 0, 1, 3 } };
  ExpectChoice(roof, GeometryKind::Surface, "but only 0 % of its area slopes below 45 degrees");
}

TEST(GeometryChoice, AnOpenCylinderIsASurface)
{
  OwnedMesh<double> cylinder = MakeGridMesh(60, 30);
  for (std::size_t i = 0; i < cylinder.Points.size(); i += 3)
  {
    const double angle = 0.1 * cylinder.Points[i];
    cylinder.Points[i] = std::cos(angle);
    cylinder.Points[i + 2] = cylinder.Points[i + 1];
    cylinder.Points[i + 1] = std::sin(angle);
  }
  ExpectChoice(cylinder, GeometryKind::Surface, "no triangle has area in x and y");
  ExpectNoDefects(cylinder);
  Append(cylinder, MakeGridMesh(4, 4)); // an end
  ExpectChoice(cylinder, GeometryKind::Surface,
    "not a height field: seen from above, 3600 of 3632 triangles have no area");
  ExpectNoDefects(cylinder);
}

/// A roof. If its slopes are gentle, it is judged by x and y, where its ridge is an ordinary edge.
TEST(GeometryChoice, ACreasedPlateIsPlanarXYWhereItSlopesGently)
{
  const auto plate = [](double slope)
  { return MakeHeights(20, 20, [=](double x, double) { return slope * std::fabs(x - 10.0); }); };
  ExpectChoice(plate(0.9), GeometryKind::PlanarXY, "100 % of its area slopes below 45 degrees");
  EXPECT_EQ(0, Survey(plate(0.9)).Edges.Feature);
  ExpectChoice(plate(1.5), GeometryKind::Surface, "only 0 % of its area slopes below 45 degrees");
  EXPECT_EQ(20, Survey(plate(1.5)).Edges.Feature);
}

TEST(GeometryChoice, TwoStackedHorizonsArePlanarXY)
{
  OwnedMesh<double> horizons = MakeHeights(30, 30, Wave);
  Append(horizons, MakeHeights(30, 30, [](double x, double y) { return 5.0 + Wave(y, x); }));
  ExpectChoice(horizons, GeometryKind::PlanarXY, "a height field over x and y, and ");
  ExpectNoDefects(horizons);
}

/// A globe in degrees and metres. Its last column of triangles spans the whole map backwards.
OwnedMesh<double> MakeGlobe(std::int32_t columns, std::int32_t rows)
{
  OwnedMesh<double> globe =
    MakeHeights(columns, rows, [](double x, double y) { return 1000.0 * Wave(x, y); });
  for (std::size_t i = 0; i < globe.Points.size(); i += 3)
  {
    const double longitude = 360.0 * (globe.Points[i] + 0.5) / columns - 180.0;
    globe.Points[i] = longitude > 180.0 ? longitude - 360.0 : longitude;
    globe.Points[i + 1] = 120.0 * globe.Points[i + 1] / rows - 60.0;
  }
  return globe;
}

/// Its depths extend over ten times as far as its longitudes, so it is no scan.
TEST(GeometryChoice, AnOceanMayCrossTheAntimeridian)
{
  for (const std::int32_t columns : { 1000, 200, 101, 100 })
  {
    const OwnedMesh<double> globe = MakeGlobe(columns, 20);
    const std::string turned =
      "40 of " + std::to_string(40 * columns) + " triangles face the other way";
    ExpectChoice(globe, GeometryKind::PlanarXY,
      "a height field over x and y, although " + turned + " there, and z extends further than");
    const FlipResult result = Flip(globe.View());
    EXPECT_EQ(40, CountRight(globe, result.Triangles));
    EXPECT_EQ(40, CountDefect(result.Report, "face the other way"));
    EXPECT_EQ(1u, result.Report.Defects.size()) << DescribeDefects(result.Report.Defects);
  }
  ExpectChoice(MakeGlobe(99, 20), GeometryKind::Surface,
    "not a height field: seen from above, 40 of 3960 triangles face the other way");
}

TEST(GeometryChoice, IsTheSameInParts)
{
  const OwnedMesh<double> globe = MakeGlobe(200, 20);
  const FlipReport whole = Flip(globe.View()).Report;
  const auto expectSame = [&](const FlipReport& report)
  {
    EXPECT_EQ(whole.GeometryReason, report.GeometryReason);
    EXPECT_EQ("40 triangles that face the other way than most", DescribeDefects(report.Defects));
  };
  FlipOptions options = OnBackend(BackendKind::Threads);
  for (const int parts : { 2, 5 })
  {
    expectSame(FlipDivided(globe.View(), DivideMesh(globe.View(), parts), options).Report);
    options.NumberOfPieces = parts;
    expectSame(Flip(globe.View(), options).Report);
  }
  Owners turned(globe.NumberOfTriangles()); // a rank has all of them, and nothing else
  for (std::int64_t t = 0; t < globe.NumberOfTriangles(); ++t)
  {
    turned[t] = CountRight(globe, { &globe.Triangles[3 * t], &globe.Triangles[3 * t] + 3 }) > 0;
  }
  expectSame(FlipDivided(globe.View(), DivideMesh(globe.View(), turned, 2), options).Report);
}

/// In units in which depths extend hardly ten times as far.
TEST(GeometryChoice, TheAntimeridianIsWarnedOfOnce)
{
  const OwnedMesh<double> globe =
    Transform(MakeGlobe(200, 20), { { { 2, 0, 0, 0 }, { 0, 2, 0, 0 }, { 0, 0, 1, 0 } } });
  ExpectChoice(globe, GeometryKind::Surface,
    "not a height field: seen from above, 40 of 8000 triangles face the other way; if it is "
    "terrain, use planar-xy");
  const FlipReport report = Survey(globe);
  ASSERT_EQ(1u, report.Defects.size()) << DescribeDefects(report.Defects);
  EXPECT_EQ(40, report.Defects[0].Count);
  EXPECT_EQ((std::vector<std::int64_t>{ 398, 399, 798 }), report.Defects[0].FirstIds);
  EXPECT_NE(std::string::npos, report.Defects[0].Detail.find("nearly a height field"));
  EXPECT_TRUE(Survey(globe, GeometryKind::Surface).Defects.empty());
}

/// Separate triangles, of which the first ones are turned over.
OwnedMesh<double> MakeScatter(std::int32_t count, std::int32_t turned)
{
  OwnedMesh<double> mesh;
  for (std::int32_t t = 0; t < count; ++t)
  {
    Append(mesh, { { 2.0 * t, 0, 0, 2.0 * t + 1, 0, 0.1, 2.0 * t, 1, 0 }, { 0, 1, 2 } });
    if (t < turned)
    {
      std::swap(mesh.Triangles[3 * t], mesh.Triangles[3 * t + 1]);
    }
  }
  return mesh;
}

/// Terrain from a laser scanner is such a mesh: some points have the same x and y.
TEST(GeometryChoice, TrianglesWithoutAreaAreCountedApart)
{
  OwnedMesh<double> mesh = MakeScatter(1000, 7);
  const auto flatten = [&](std::int32_t first, std::int32_t last)
  {
    for (std::int32_t t = first; t < last; ++t)
    {
      mesh.Points[9 * t + 7] = 0.0;
    }
  };
  flatten(100, 219);
  ExpectChoice(mesh, GeometryKind::Surface,
    "not a height field: seen from above, 7 of 1000 triangles face the other way and 119 have no "
    "area; if it is terrain, use "
    "planar-xy");
  const FlipReport report = Survey(mesh);
  ASSERT_EQ(3u, report.Defects.size()) << DescribeDefects(report.Defects); // area, no shared edges
  EXPECT_EQ(DefectKind::TurnedFromAbove, report.Defects[0].Kind);
  EXPECT_EQ(
    ", and 119 that have no area there, so the mesh, nearly a height field, is flipped as a "
    "surface; if it is terrain, use planar-xy",
    report.Defects[0].Detail);
  EXPECT_EQ(7, report.Defects[0].Count);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 2 }), report.Defects[0].FirstIds);
  mesh.Points[2] = 50000.0;
  ExpectChoice(mesh, GeometryKind::PlanarXY,
    "although 7 of 1000 triangles face the other way and 119 have no area there, and z");
  mesh.Points[2] = 0.0;
  flatten(219, 300);
  EXPECT_EQ(3u, Survey(mesh).Defects.size());
  flatten(300, 301); // more than one in five
  EXPECT_EQ(2u, Survey(mesh).Defects.size());
}

/// Too steep for Auto, and one point lies so far aside that a few triangles are turned over: more
/// than one in 1,000 of the first mesh, fewer of the second.
TEST(GeometryChoice, SteepTerrainWithAFewTrianglesTurnedIsWarnedOf)
{
  for (const std::int32_t size : { 20, 60 })
  {
    OwnedMesh<double> mesh =
      MakeHeights(size, size, [=](double x, double) { return 1.5 * std::fabs(x - 0.5 * size); });
    EXPECT_TRUE(Survey(mesh).Defects.empty());
    mesh.Points[3 * (5 * (size + 1) + 5)] += 1.25;
    ExpectChoice(mesh, GeometryKind::Surface, "if it is terrain, use planar-xy");
    const FlipReport report = Survey(mesh);
    ASSERT_EQ(1u, report.Defects.size()) << DescribeDefects(report.Defects);
    EXPECT_NE(std::string::npos, report.Defects[0].Detail.find("nearly a height field"));
    EXPECT_LT(0, report.Defects[0].Count);
    EXPECT_EQ(size == 20, 1000 * report.Defects[0].Count > report.Triangles);
  }
}

TEST(GeometryChoice, OneTriangleInAThousandMayStray)
{
  ExpectChoice(MakeScatter(1000, 1), GeometryKind::PlanarXY,
    "although 1 of 1000 triangles face the other way there, and 100");
  ExpectChoice(MakeScatter(999, 1), GeometryKind::Surface, "1 of 999 triangles face");
  // One more than these: the triangles share no edges.
  EXPECT_EQ(2u, Survey(MakeScatter(999, 1)).Defects.size());
  EXPECT_EQ(2u, Survey(MakeScatter(1000, 10)).Defects.size());
  EXPECT_EQ(1u, Survey(MakeScatter(999, 10)).Defects.size());
}

/// A floor, and a ramp with slope 4 : 3 and area 5.
TEST(GeometryChoice, NinetyFivePercentMustSlopeGently)
{
  const auto plate = [](double length)
  {
    return OwnedMesh<double>{ { 0, 0, 0, length, 0, 0, length, 1, 0, 0, 1, 0, length + 3, 0, 4,
                                length + 3, 1, 4 },
      { 0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2 } };
  };
  ExpectChoice(plate(95.0), GeometryKind::PlanarXY, "95 % of its area slopes below 45 degrees");
  ExpectChoice(plate(94.5), GeometryKind::Surface, "only 94 % of its area slopes below 45 degrees");
}

/// A fan that rises a little.
OwnedMesh<double> MakeStaircase(int count, double turns, bool closed)
{
  OwnedMesh<double> mesh = MakeWindingFan(count, turns, closed);
  for (std::size_t i = 6; i < mesh.Points.size(); i += 6)
  {
    mesh.Points[i + 2] = 0.001;
  }
  return mesh;
}

TEST(GeometryChoice, StarsThatOverlapMakeASurface)
{
  const char* const overlap =
    "not a height field: seen from above, triangles overlap around 1 point";
  ExpectChoice(MakeStaircase(24, 2.0, true), GeometryKind::Surface, overlap);
  ExpectChoice(MakeStaircase(24, 3.0, true), GeometryKind::Surface, overlap);
  ExpectChoice(MakeStaircase(24, 1.01, false), GeometryKind::Surface, overlap);
  // Four steps of half a turn each, up to rounding.
  OwnedMesh<double> thin = MakeStaircase(4, 2.0 - 0x1p-36, false);
  Append(thin, MakeStaircase(8, 1.0, true));
  ExpectChoice(thin, GeometryKind::Surface, overlap);
  const FlipReport report = Survey(MakeStaircase(24, 1.01, false));
  ASSERT_EQ(1u, report.Defects.size());
  EXPECT_EQ(std::vector<std::int64_t>{ 0 }, report.Defects[0].FirstIds);
  EXPECT_EQ(DefectIds::Points, report.Defects[0].Ids);
  for (double turns : { 0.3, 0.99, 1.0 })
  {
    ExpectChoice(MakeStaircase(24, turns, false), GeometryKind::PlanarXY, "a height field");
  }
  ExpectChoice(MakeStaircase(24, 1.0, true), GeometryKind::PlanarXY, "a height field");
}

/// Each triangle has a point almost on its opposite edge: angles are 0 and pi up to rounding.
TEST(GeometryChoice, ThinTrianglesDoNotAddUpToMoreThanATurn)
{
  OwnedMesh<double> mesh = MakeHeights(40, 40, [](double x, double y) { return 0.1 * Wave(x, y); });
  const std::vector<std::int32_t> triangles = mesh.Triangles;
  mesh.Triangles.clear();
  for (std::size_t t = 0; t < triangles.size(); t += 3)
  {
    const auto inserted = static_cast<std::int32_t>(mesh.NumberOfPoints());
    const std::int32_t* corners = &triangles[t];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = mesh.Points[3 * corners[0] + axis];
      const double b = mesh.Points[3 * corners[1] + axis];
      const double c = mesh.Points[3 * corners[2] + axis];
      mesh.Points.push_back(0.5 * (a + b) + 0x1p-40 * (c - a));
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      mesh.Triangles.insert(
        mesh.Triangles.end(), { corners[slot], corners[(slot + 1) % 3], inserted });
    }
  }
  ExpectChoice(mesh, GeometryKind::PlanarXY, "a height field over x and y, and 100 % of its area");
}

/// The choice must not depend on the order of triangles, on threads or on scale.
TEST(GeometryChoice, IsTheSameWhateverTheOrder)
{
  OwnedMesh<double> mesh =
    MakeHeights(150, 150, [](double x, double y) { return Wave(3 * x, 2 * y); });
  const std::string expected = Survey(mesh).GeometryReason;
  EXPECT_NE(std::string::npos, expected.find("but only")) << expected;
  std::mt19937 random(5);
  for (int threads = 1; threads < 5; ++threads)
  {
    for (std::int64_t t = mesh.NumberOfTriangles() - 1; t > 0; --t)
    {
      const std::int64_t other = DrawIndex(random, t + 1);
      std::swap_ranges(
        &mesh.Triangles[3 * t], &mesh.Triangles[3 * t] + 3, &mesh.Triangles[3 * other]);
    }
    EXPECT_EQ(expected, MakeSession(mesh.View(), WithThreads(threads)).GetReport().GeometryReason);
  }
  for (double scale : { 0x1p-900, 0x1p-40, 0x1p40, 0x1p900 })
  {
    const OwnedMesh<double> scaled = Transform(mesh, ScaleAndMove(scale, 0.0));
    EXPECT_EQ(expected, Survey(scaled).GeometryReason) << scale;
  }
}

/// If x and y decide, a height that is NaN does no harm.
TEST(GeometryChoice, HeightsNeedNotBeFinite)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(3000, 32);
  for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] = i == 302 ? std::numeric_limits<double>::quiet_NaN() : 1e-6 * (i % 7);
  }
  const FlipResult result = Flip(mesh.View());
  EXPECT_EQ(GeometryKind::PlanarXY, result.Report.GeometryUsed) << result.Report.GeometryReason;
  EXPECT_EQ("", DescribeDefects(result.Report.Defects));
  EXPECT_EQ(Flip(mesh.View(), InPlane()).Triangles, result.Triangles);
}

/// How many triangles the report says were turned over in x and y.
std::int64_t CountTurnedOver(const FlipReport& report)
{
  EXPECT_GE(1u, report.Defects.size()) << DescribeDefects(report.Defects);
  return CountDefect(report, "have turned over");
}

TEST(GeometryChoice, FlipsInSpaceThatTurnTerrainOverAreCounted)
{
  OwnedMesh<double> mesh = MakeDegreesAndMetres();
  const FlipOptions options = OnSurface(30.0);
  for (int winding = 0; winding < 2; ++winding)
  {
    const FlipResult result = Flip(mesh.View(), options);
    const std::int64_t right = CountRight(mesh, result.Triangles);
    const std::int64_t turned = winding == 0 ? right : mesh.NumberOfTriangles() - right;
    EXPECT_LT(20, turned);
    EXPECT_EQ(turned, CountTurnedOver(result.Report));
    EXPECT_EQ(3u, result.Report.Defects.back().FirstIds.size());
    ReverseTriangles(mesh.Triangles);
  }
}

/// Only once, even if the run is divided into several calls, and not before it has ended.
TEST(GeometryChoice, TurnedTrianglesAreToldOfAtTheEnd)
{
  const OwnedMesh<double> mesh = MakeDegreesAndMetres();
  const FlipOptions options = OnSurface(30.0);
  const std::int64_t expected = CountTurnedOver(Flip(mesh.View(), options).Report);
  FlipSession session = MakeSession(mesh.View(), options);
  session.Advance(-1, [](const IterationRecord&) { return false; });
  EXPECT_LT(0, CountTurnedOver(session.GetReport())); // an abort is an end, too
  while (session.Advance(1))
  {
    EXPECT_EQ(0, CountTurnedOver(session.GetReport()));
  }
  EXPECT_EQ(expected, CountTurnedOver(session.GetReport()));
  session.Advance();
  EXPECT_EQ(expected, CountTurnedOver(session.GetReport()));
}

/// Most programs for pictures and games write such heights; a dome, a sphere and a tube are no
/// terrain.
TEST(GeometryChoice, NamesTheHeightsOfTerrainWhereTheyAreNotZ)
{
  const std::string advice = " looks like the height of terrain: if it is, exchange ";
  const OwnedMesh<double> terrain = MakeHeights(60, 40, Wave);
  ExpectChoice(terrain, GeometryKind::PlanarXY, "a height field over x and y, and");
  ExpectChoice(Transform(terrain, { { { 1, 0, 0, 0 }, { 0, 0, 1, 0 }, { 0, -1, 0, 0 } } }),
    GeometryKind::Surface, "; y" + advice + "y and z");
  ExpectChoice(Transform(terrain, { { { 0, 0, 1, 0 }, { 0, 1, 0, 0 }, { 1, 0, 0, 0 } } }),
    GeometryKind::Surface, "; x" + advice + "x and z");
  const OwnedMesh<double> sphere = MakeBadSphere(60, 30, 33);
  EXPECT_EQ(std::string::npos, Survey(sphere).GeometryReason.find("looks like"));
}

TEST(GeometryChoice, NobodyWarnsOfClosedSurfaces)
{
  const OwnedMesh<double> sphere = MakeBadSphere(60, 30, 33);
  ExpectChoice(sphere, GeometryKind::Surface, "of 3600 triangles face the other way");
  ExpectNoDefects(sphere);
}

}
}
