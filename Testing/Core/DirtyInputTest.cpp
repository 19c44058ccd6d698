// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactReference.h"
#include "FlipTestSupport.h"
#include "MeshAudit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace delaunayflip
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

constexpr GeometryKind Geometries[] = { GeometryKind::Auto, GeometryKind::Planar,
  GeometryKind::PlanarXY, GeometryKind::Surface };

/// Both NaN, or close.
void ExpectSameAngle(double expected, double angle)
{
  EXPECT_EQ(std::isnan(expected), std::isnan(angle)) << expected << " and " << angle;
  if (!std::isnan(expected))
  {
    EXPECT_NEAR(expected, angle, 1e-6);
  }
}

/// Flips the mesh in this geometry, and checks what must hold for any input.
FlipResult FlipDirty(const OwnedMesh<double>& mesh, GeometryKind geometry)
{
  FlipOptions options;
  options.Geometry = geometry;
  options.FeatureAngle = 180.0;
  const FlipResult result = Flip(mesh.View(), options);
  const TriangleMesh after = WithTriangles(mesh.View(), result.Triangles);
  EXPECT_TRUE(result.Report.Converged()) << ToString(geometry);
  EXPECT_EQ(CountNonDelaunayEdges(mesh.View(), options), result.Report.NonDelaunayBefore);
  EXPECT_EQ(CountNonDelaunayEdges(after, options), result.Report.NonDelaunayAfter);
  ExpectSameAngle(MinimumAngle(mesh.View(), geometry), result.Report.MinimumAngleBefore);
  ExpectSameAngle(MinimumAngle(after, geometry), result.Report.MinimumAngleAfter);
  ExpectSameTopology(mesh.View().Triangles, result.Triangles, result.Report);
  ExpectConsistentStatistics(result.Report);
  return result;
}

TEST(DirtyInput, EmptyMeshesAreDone)
{
  const OwnedMesh<double> empty[] = { {}, { { 1, 2, 3, 4, 5, 6 }, {} } };
  for (const OwnedMesh<double>& mesh : empty)
  {
    for (GeometryKind geometry : Geometries)
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(0, result.Report.TotalFlips);
      EXPECT_EQ(0, result.Report.Edges.Edges);
      EXPECT_TRUE(std::isnan(result.Report.MinimumAngleBefore));
      EXPECT_NE(GeometryKind::Auto, result.Report.GeometryUsed);
      EXPECT_TRUE(result.Report.Defects.empty());
    }
  }
}

TEST(DirtyInput, OneTriangleHasNothingToFlip)
{
  const OwnedMesh<double> mesh = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 2, 0, 1 } };
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_EQ(mesh.Triangles, result.Triangles);
    EXPECT_EQ(3, result.Report.Edges.Fixed);
    EXPECT_NEAR(45.0, result.Report.MinimumAngleAfter, 1e-9);
  }
}

TEST(DirtyInput, DelaunayMeshesComeBackBitForBit)
{
  const OwnedMesh<double> grid = MakeGridMesh(40, 30);
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(grid, geometry);
    EXPECT_EQ(grid.Triangles, result.Triangles);
    EXPECT_EQ(0, result.Report.TotalFlips);
    EXPECT_TRUE(result.Report.Iterations.empty() || result.Report.Iterations[0].Flipped == 0);
  }
}

/// Some points are NaN or infinite: no flip touches their triangles, and all others become
/// Delaunay.
TEST(DirtyInput, NonFinitePointsStayAndTheRestIsProcessed)
{
  for (double bad : { std::nan(""), Infinity, -Infinity })
  {
    OwnedMesh<double> mesh = MakeRandomBadMeshDouble(2000, 81);
    for (std::size_t point : { 100u, 500u, 501u, 1500u })
    {
      mesh.Points[3 * point + point % 2] = bad;
    }
    const std::vector<double> points = mesh.Points;
    for (GeometryKind geometry : { GeometryKind::Auto, GeometryKind::PlanarXY })
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(0, result.Report.NonDelaunayAfter);
      EXPECT_LT(1000, result.Report.TotalFlips);
      EXPECT_EQ(4, CountDefect(result.Report, "NaN"));
      EXPECT_EQ(1u, result.Report.Defects.size()) << DescribeDefects(result.Report.Defects);
      for (std::size_t corner = 0; corner < mesh.Triangles.size(); ++corner)
      {
        const std::int32_t id = mesh.Triangles[corner];
        const bool isBad = !std::isfinite(mesh.Points[3 * id] + mesh.Points[3 * id + 1]);
        EXPECT_TRUE(!isBad || result.FlipCounts[corner / 3] == 0);
      }
      EXPECT_EQ(0, std::memcmp(points.data(), mesh.Points.data(), points.size() * sizeof(double)));
    }
  }
}

TEST(DirtyInput, NonFinitePointsOfSurfacesAreLeftAlone)
{
  OwnedMesh<double> mesh = MakeBadSphere(40, 20, 82);
  mesh.Points[3 * 200 + 2] = std::nan("");
  mesh.Points[3 * 400 + 1] = Infinity;
  const FlipResult result = FlipDirty(mesh, GeometryKind::Auto);
  EXPECT_EQ(GeometryKind::Surface, result.Report.GeometryUsed);
  EXPECT_EQ(2, CountDefect(result.Report, "NaN"));
  EXPECT_LT(100, result.Report.TotalFlips);
}

TEST(DirtyInput, MeshesOfNothingButNaNEnd)
{
  OwnedMesh<double> mesh = MakeGridMesh(4, 4);
  std::fill(mesh.Points.begin(), mesh.Points.end(), std::nan(""));
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_EQ(mesh.Triangles, result.Triangles);
    EXPECT_TRUE(std::isnan(result.Report.MinimumAngleAfter));
  }
}

/// A cap whose apex lies exactly on the shared edge: its angle is pi, so the edge is bad.
TEST(DirtyInput, FlatCapsFlip)
{
  OwnedMesh<double> mesh = { { 0, 0, 0, 4, 0, 0, 2, 3, 0, 1, 0, 0 }, { 0, 1, 2, 1, 0, 3 } };
  for (int direction = 0; direction < 2; ++direction)
  {
    for (GeometryKind geometry : Geometries)
    {
      const FlipResult result = FlipDirty(mesh, geometry);
      EXPECT_EQ(1, result.Report.TotalFlips) << ToString(geometry);
      EXPECT_TRUE(HasEdge(result.Triangles, 2, 3));
      EXPECT_EQ(1, CountDefect(result.Report, "area"));
      EXPECT_EQ(0.0, result.Report.MinimumAngleBefore);
      EXPECT_LT(1.0, result.Report.MinimumAngleAfter);
    }
    ReverseTriangles(mesh.Triangles);
  }
}

/// The apex lies on the line of the shared edge, but outside it: no flip can improve that.
TEST(DirtyInput, FlatTrianglesThatOverhangStay)
{
  const OwnedMesh<double> mesh = { { 0, 0, 0, 4, 0, 0, 2, 3, 0, 5, 0, 0 }, { 0, 1, 2, 1, 0, 3 } };
  for (GeometryKind geometry : Geometries)
  {
    EXPECT_EQ(mesh.Triangles, FlipDirty(mesh, geometry).Triangles);
  }
}

TEST(DirtyInput, AllCollinearOrCoincidentPointsEnd)
{
  OwnedMesh<double> line = MakeRandomBadMeshDouble(300, 83);
  for (std::size_t i = 0; i < line.Points.size(); i += 3)
  {
    line.Points[i + 1] = line.Points[i];
  }
  OwnedMesh<double> spot = line;
  std::fill(spot.Points.begin(), spot.Points.end(), 7.0);
  for (GeometryKind geometry : Geometries)
  {
    EXPECT_EQ(line.NumberOfTriangles(), CountDefect(FlipDirty(line, geometry).Report, "area"));
    const FlipResult result = FlipDirty(spot, geometry);
    EXPECT_EQ(spot.Triangles, result.Triangles);
  }
}

/// Pairs of points at one place, with triangles between them.
TEST(DirtyInput, CoincidentPointsAreNotMerged)
{
  std::mt19937 random(84);
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 84);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 300)
  {
    const std::int32_t from = mesh.Triangles[t];
    const std::int32_t to = mesh.Triangles[t + 1];
    std::copy_n(&mesh.Points[3 * from], 3, &mesh.Points[3 * to]);
  }
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_LT(100, result.Report.TotalFlips);
    EXPECT_LT(0, CountDefect(result.Report, "area"));
  }
}

/// Lattice points moved onto each other: many zero-area and inverted triangles, and many ties.
TEST(DirtyInput, CrumpledLatticesEnd)
{
  for (std::uint32_t seed = 0; seed < 60 / Reduction; ++seed)
  {
    std::mt19937 random(seed);
    OwnedMesh<double> mesh = MakeGridMesh(9, 9);
    for (double& x : mesh.Points)
    {
      x += DrawIndex(random, 8) == 0 ? DrawIndex(random, 3) - 1 : 0;
    }
    FlipDirty(mesh, GeometryKind::PlanarXY);
    FlipDirty(mesh, GeometryKind::Surface);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(DirtyInput, TrianglesWithRepeatedIdsStay)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 85);
  for (std::size_t t = 0; t < 30; t += 3)
  {
    mesh.Triangles[30 * t + 1] = mesh.Triangles[30 * t];
  }
  for (GeometryKind geometry : Geometries)
  {
    const FlipResult result = FlipDirty(mesh, geometry);
    EXPECT_EQ(10, CountDefect(result.Report, "repeated"));
    for (std::size_t t = 0; t < 30; t += 3)
    {
      EXPECT_TRUE(std::equal(
        &mesh.Triangles[30 * t], &mesh.Triangles[30 * t] + 3, &result.Triangles[30 * t]));
    }
    EXPECT_LT(1000, result.Report.TotalFlips);
  }
}

/// Unused points, even NaN, change nothing.
TEST(DirtyInput, IsolatedPointsDoNotMatter)
{
  const OwnedMesh<double> clean = MakeRandomBadMeshDouble(500, 86);
  OwnedMesh<double> mesh = clean;
  mesh.Points.insert(mesh.Points.end(), { 5, 5, 5, std::nan(""), 0, 1e300, -7, 0, -1e9 });
  const FlipResult result = FlipDirty(mesh, GeometryKind::Auto);
  EXPECT_EQ(GeometryKind::Planar, result.Report.GeometryUsed);
  EXPECT_EQ(Flip(clean.View()).Triangles, result.Triangles);
  EXPECT_EQ(503, result.Report.Points);
  EXPECT_TRUE(result.Report.Defects.empty());
}

/// A hub of very many triangles, placed so that nearly all of its edges are bad.
TEST(DirtyInput, HugeFansAreProcessed)
{
  const int count = 20000 / static_cast<int>(Reduction);
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 0, 0 };
  for (std::int32_t i = 0; i < count; ++i)
  {
    const double x = 1.8 * i / (count - 1) - 0.9;
    mesh.Points.insert(mesh.Points.end(), { x, 3.0 + std::sqrt(1.0 - x * x), 0.0 });
    if (i > 0)
    {
      mesh.Triangles.insert(mesh.Triangles.end(), { 0, i + 1, i });
    }
  }
  for (GeometryKind geometry : { GeometryKind::Auto, GeometryKind::Surface })
  {
    EXPECT_LT(count / 2, FlipDirty(mesh, geometry).Report.TotalFlips);
  }
}

}
}
