// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

/// @file
/// The automatic tolerance on whole meshes: rounding alone causes no flips, larger errors do.
/// NoiseTest.cpp tests single edges.

namespace delaunayflip
{
namespace
{

constexpr double Automatic = -1.0;
constexpr double Fixed = 1e-9;

FlipOptions OfSurfaces(double tolerance)
{
  FlipOptions options;
  options.Geometry = GeometryKind::Surface;
  options.FeatureAngle = 180.0;
  options.Tolerance = tolerance;
  return options;
}

template <typename Real>
void ExpectUnchanged(const OwnedMesh<Real>& mesh, const FlipOptions& options)
{
  const FlipResult result = Flip(mesh.View(), options);
  EXPECT_TRUE(mesh.Triangles == result.Triangles);
  EXPECT_EQ(0, result.Report.TotalFlips);
  EXPECT_EQ(0, result.Report.NonDelaunayBefore);
  EXPECT_TRUE(result.Report.Converged());
  EXPECT_EQ("automatic", result.Report.Tolerance);
  EXPECT_EQ(0, CountNonDelaunayEdges(mesh.View(), options));
}

/// A sphere of a hundred metres in UTM coordinates.
OwnedMesh<double> MakeFarSphere()
{
  return Transform(MakeLatLongSphere(300, 100),
    { { { 100, 0, 0, 5e5 }, { 0, 100, 0, 4.6e6 }, { 0, 0, 100, 0 } } });
}

TEST(AutomaticTolerance, LeavesASphereOfFloatsAsItIs)
{
  const OwnedMesh<float> sphere = RoundToFloat(MakeLatLongSphere(300, 100));
  ExpectUnchanged(sphere, OfSurfaces(Automatic));
  EXPECT_LT(5000, Flip(sphere.View(), OfSurfaces(Fixed)).Report.TotalFlips);
}

TEST(AutomaticTolerance, LeavesASphereOfDoublesAsItIs)
{
  const OwnedMesh<double> sphere = MakeLatLongSphere(300, 100);
  ExpectUnchanged(sphere, OfSurfaces(Automatic));
  EXPECT_LT(5000, Flip(sphere.View(), OfSurfaces(0.0)).Report.TotalFlips);
}

TEST(AutomaticTolerance, LeavesAFarSphereAsItIs)
{
  const OwnedMesh<double> sphere = MakeFarSphere();
  ExpectUnchanged(sphere, OfSurfaces(Automatic));
  ExpectUnchanged(RoundToFloat(sphere), OfSurfaces(Automatic));
  EXPECT_LT(5000, Flip(RoundToFloat(sphere).View(), OfSurfaces(Fixed)).Report.TotalFlips);
  // What rounding to float would explain is bad if the points are doubles.
  OwnedMesh<double> dented = sphere;
  dented.Points[3 * 15000] += 0.5;
  EXPECT_LT(0, Flip(dented.View(), OfSurfaces(Automatic)).Report.TotalFlips);
  ExpectUnchanged(RoundToFloat(dented), OfSurfaces(Automatic));
}

/// The engine packs the points of a plane as doubles; their precision is still float.
TEST(AutomaticTolerance, LeavesAPlaneOfFloatsAsItIs)
{
  const OwnedMesh<double> grid = Transform(
    MakeGridMesh(100, 80), { { { 0.3, -0.4, 0, 0 }, { 0.4, 0.3, 0, 0 }, { 0, 0, 0, 0 } } });
  FlipOptions options = OfSurfaces(Automatic);
  options.Criterion = CriterionKind::OppositeAngles;
  const OwnedMesh<float> floats = RoundToFloat(grid);
  const OwnedMesh<double> widened = Transform(floats, ScaleAndMove(1.0, 0.0));
  for (GeometryKind geometry : { GeometryKind::Planar, GeometryKind::PlanarXY })
  {
    options.Geometry = geometry;
    ExpectUnchanged(grid, options);
    ExpectUnchanged(floats, options);
    EXPECT_LT(1000, Flip(widened.View(), options).Report.TotalFlips);
  }
}

/// @param noise the most, in radians, by which the sum of an edge that is left may exceed pi.
template <typename Real>
void ExpectOnlyNoiseStays(const OwnedMesh<Real>& mesh, double noise)
{
  const FlipReport all = Flip(mesh.View(), OfSurfaces(Fixed)).Report;
  const FlipResult result = Flip(mesh.View(), OfSurfaces(Automatic));
  EXPECT_LT(mesh.NumberOfPoints() / 3, all.TotalFlips);
  EXPECT_NEAR(all.TotalFlips, result.Report.TotalFlips, 0.005 * all.TotalFlips);
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_EQ(0, CountNonDelaunayEdges(after, OfSurfaces(Automatic)));
  EXPECT_EQ(0, CountNonDelaunayEdges(after, OfSurfaces(noise)));
}

TEST(AutomaticTolerance, LetsABadSurfaceFlip)
{
  const OwnedMesh<double> sphere = MakeBadSphere(400, 200, 71);
  ExpectOnlyNoiseStays(sphere, 1e-9);
  ExpectOnlyNoiseStays(RoundToFloat(sphere), 0.02); // at the poles
}

/// The same lattice points moved further and further from the origin, without rounding: what is
/// noise at one distance is noise at larger ones.
TEST(AutomaticTolerance, GrowsWithTheDistanceFromTheOrigin)
{
  const AffineMap curved = { { { 1024, 0, 0, 0 }, { 0, 1024, 0, 0 }, { 0, 0, 1024, 0 } } };
  OwnedMesh<double> mesh = Transform(MakeLatLongSphere(200, 100), curved);
  for (double& coordinate : mesh.Points)
  {
    coordinate = std::nearbyint(0x1p12 * coordinate) * 0x1p-12;
  }
  std::int64_t before = mesh.NumberOfTriangles();
  for (double offset : { 0.0, 0x1p24, 0x1p30, 0x1p34, 0x1p40 })
  {
    const OwnedMesh<double> moved = Transform(mesh, ScaleAndMove(1.0, offset));
    const std::int64_t bad = CountNonDelaunayEdges(moved.View(), OfSurfaces(Automatic));
    EXPECT_EQ(bad, MakeSession(moved.View(), OfSurfaces(Automatic)).GetReport().NonDelaunayBefore);
    EXPECT_LT(bad, before) << offset;
    before = bad;
  }
  EXPECT_EQ(0, before);
}

TEST(AutomaticTolerance, GivesTheSameBitsOnAnyNumberOfThreads)
{
  const OwnedMesh<float> mesh =
    RoundToFloat(Transform(MakeBadSphere(300, 150, 72), ScaleAndMove(100.0, 1e5)));
  FlipOptions options = OfSurfaces(Automatic);
  options.Backend = BackendKind::Threads;
  options.NumberOfThreads = 1;
  const FlipResult expected = Flip(mesh.View(), options);
  EXPECT_LT(1000, expected.Report.TotalFlips);
  for (int threads : { 2, 5, 16 })
  {
    options.NumberOfThreads = threads;
    const FlipResult result = Flip(mesh.View(), options);
    EXPECT_TRUE(expected.Triangles == result.Triangles);
    ExpectSameStatistics(expected.Report, result.Report);
  }
}

TEST(Tolerance, IsReported)
{
  const OwnedMesh<double> grid = MakeGridMesh(3, 3);
  FlipOptions options;
  const auto describe = [&]() { return MakeSession(grid.View(), options).GetReport().Tolerance; };
  EXPECT_EQ(Automatic, options.Tolerance);
  EXPECT_EQ("none", describe()); // in-circle
  options.Criterion = CriterionKind::OppositeAngles;
  EXPECT_EQ("automatic", describe());
  options.Tolerance = 0.015;
  EXPECT_EQ("0.015", describe());
  options.Criterion = CriterionKind::InCircle;
  options.Geometry = GeometryKind::Surface;
  EXPECT_EQ("0.015", describe());
}

}
}
