// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DividedSquare.h"
#include "GpuTestSupport.h"
#include "PointSets.h"
#include "PointTestSupport.h"

#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

/// @file
/// Refinement on a GPU, with the bits of the CPU.

namespace delaunayflip
{
namespace
{

/// Expects arrays with the same bits.
void ExpectSamePoints(
  const std::vector<AddedPoint>& expected, const std::vector<AddedPoint>& points)
{
  ASSERT_EQ(expected.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const AddedPoint& own = points[i];
    const AddedPoint& other = expected[i];
    const double numbers[] = { own.X, own.Y, own.Z, own.Share, own.ThirdShare };
    const double others[] = { other.X, other.Y, other.Z, other.Share, other.ThirdShare };
    ASSERT_EQ(0, std::memcmp(numbers, others, sizeof numbers)) << i;
    ASSERT_EQ(other.From, own.From);
    ASSERT_EQ(other.To, own.To);
    ASSERT_EQ(other.Third, own.Third);
    ASSERT_EQ(other.Segment, own.Segment);
  }
}

/// Refines on both backends, and expects the same.
void ExpectSameRefinement(const PointInput& input, const PointOptions& options)
{
  const auto refine = [&](BackendKind backend)
  {
    PointOptions own = options;
    own.Backend = backend;
    FlipSession session(input, own);
    session.Advance();
    return session;
  };
  const FlipSession expected = refine(BackendKind::Threads), session = refine(BackendKind::CUDA);
  EXPECT_TRUE(IsOnGpu(session.GetReport())) << session.GetReport().Backend;
  ExpectSameStatistics(expected.GetReport(), session.GetReport());
  EXPECT_LT(0, session.GetReport().FromPoints.RefinementPoints);
  EXPECT_EQ(StoreTriangles(expected), StoreTriangles(session));
  EXPECT_EQ(expected.ListSegmentEdges(), session.ListSegmentEdges());
  EXPECT_EQ(expected.ListSegmentsOfEdges(), session.ListSegmentsOfEdges());
  std::vector<std::int32_t> labels(session.GetReport().Triangles);
  std::vector<std::int32_t> expectedLabels(expected.GetReport().Triangles);
  session.StoreRegions(labels.data());
  expected.StoreRegions(expectedLabels.data());
  EXPECT_EQ(expectedLabels, labels);
  ExpectSamePoints(expected.GetAddedPoints(), session.GetAddedPoints());
}

/// A star with sharp corners around points, and a wall in it.
Drawing MakeStar(int corners, int inside)
{
  Drawing star;
  Places ring;
  for (int i = 0; i < corners; ++i)
  {
    const double radius = i % 2 == 0 ? 3.0 : 1.7, angle = i * 2 * M_PI / corners;
    ring.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  star.AddRing(ring);
  for (int i = 0; i < inside; ++i)
  {
    const double radius = 1.6 * std::sqrt(double(i) / inside), angle = 2.4 * i;
    star.Points.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  star.Segments.push_back({ 0, corners / 2 });
  star.Rings.push_back(-1);
  return star;
}

class RefineTest : public GpuTest
{
};

TEST_F(RefineTest, PointSets)
{
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    const Places points = MakePlaces(set, 2000);
    PointInput input;
    input.Points = View(points);
    PointOptions options;
    options.MinimumAngle = 28.0;
    options.PointLimit = 100000;
    ExpectSameRefinement(input, options);
  }
}

TEST_F(RefineTest, SegmentsRegionsAndSizes)
{
  const Drawing star = MakeStar(60, 20000);
  const RegionSeed seeds[] = { { 0.0, 0.5, 4, 0.0 }, { 0.0, -0.5, 9, 0.0002 } };
  std::vector<double> sizes(star.Points.size(), 0.5);
  sizes[70] = 0.001;
  PointInput input = star.View();
  input.Regions = seeds;
  input.NumberOfRegions = 2;
  input.Sizes = sizes.data();
  PointOptions options;
  options.MinimumAngle = 30.0;
  options.SplitCrossings = true;
  ExpectSameRefinement(input, options);
  options.KeepBoundary = true;
  options.MaximumEdge = 0.2;
  ExpectSameRefinement(input, options);
}

TEST_F(RefineTest, OutlinesWithinRoundingOfTheHull)
{
  PointOptions options;
  options.MinimumAngle = 25.0;
  options.MaximumEdge = 0.01;
  for (const double angle : { 0.013, 0.4, 0.7, 1.1 })
  {
    SCOPED_TRACE(angle);
    Drawing square;
    square.AddRing(MakeDividedSquare(angle, 3));
    ExpectSameRefinement(square.View(), options);
  }
}

TEST_F(RefineTest, SmallAndSinglePrecision)
{
  const Drawing star = MakeStar(12, 40);
  std::vector<float> xy;
  for (const Place& point : star.Points)
  {
    xy.push_back(static_cast<float>(point[0]));
    xy.push_back(static_cast<float>(point[1]));
  }
  PointInput input = star.View();
  input.Points = PlaneArray(xy.data(), static_cast<std::int64_t>(star.Points.size()), 2);
  PointOptions options;
  options.MinimumAngle = 25.0;
  ExpectSameRefinement(input, options);
}

/// Refines a mesh on both backends, and expects the same places, sources and data.
/// @returns how many points are added.
std::int64_t ExpectSameRefinedMesh(const TriangleMesh& mesh, const FlipOptions& options)
{
  const auto refine = [&](BackendKind backend)
  {
    FlipSession session(mesh, OnBackend(backend, options));
    session.Advance();
    return session;
  };
  const FlipSession expected = refine(BackendKind::Threads), session = refine(BackendKind::CUDA);
  EXPECT_TRUE(IsOnGpu(session.GetReport())) << session.GetReport().Backend;
  ExpectSameStatistics(expected.GetReport(), session.GetReport());
  EXPECT_EQ(StoreTriangles(expected), StoreTriangles(session));
  std::vector<std::int32_t> sources(session.GetReport().Triangles);
  std::vector<std::int32_t> expectedSources(expected.GetReport().Triangles);
  session.StoreSources(sources.data());
  expected.StoreSources(expectedSources.data());
  EXPECT_EQ(expectedSources, sources);
  ExpectSamePoints(expected.GetAddedPoints(), session.GetAddedPoints());
  return session.GetReport().FromPoints.RefinementPoints;
}

TEST_F(RefineTest, Meshes)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(20000, 5);
  std::vector<double> sizes(mesh.Points.size() / 3, 0.02);
  TriangleMesh view = mesh.View();
  view.Sizes = sizes.data();
  FlipOptions options = InPlane();
  options.MinimumAngle = 25.0;
  EXPECT_LT(1000, ExpectSameRefinedMesh(view, options));
}

/// Triangles that overlap, are turned over or meet only at a point need a guard, and leave edges
/// that are bad but cannot flip.
TEST_F(RefineTest, MeshesWithBlockedEdges)
{
  FlipOptions options = InPlane();
  options.MinimumAngle = 25.0;
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(20000, 5);
  for (std::size_t t = 0; t < mesh.Triangles.size(); t += 3 * 997)
  {
    std::swap(mesh.Triangles[t], mesh.Triangles[t + 1]);
  }
  EXPECT_LT(1000, ExpectSameRefinedMesh(mesh.View(), options));
  options.MinimumAngle = 20.0;
  options.PointLimit = 2000;
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    const OwnedMesh<double> soup = MakeSoup(30, 60, seed);
    ExpectSameRefinedMesh(soup.View(), options);
  }
}

}
}
