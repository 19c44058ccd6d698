// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMesh.h"
#include "CornerPairing.h"
#include "EdgeMeshBuilder.h"
#include "GeneratedMeshes.h"
#include "MeshSurveyBuilder.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

/// @file
/// Compares the edge arrays with brute force: a map from vertex pairs to corners.

namespace
{
using namespace delaunayflip;

using Pair = std::pair<VertexId, VertexId>;

struct Built
{
  MeshSurvey Survey;
  SpatialOrder Order;
  EdgeMeshResult Result;
};

Built Build(const TriangleMesh& mesh, const ThreadBackend& backend,
  GeometryKind geometry = GeometryKind::Auto)
{
  Built built;
  const MeshInput input{ mesh, mesh };
  built.Survey = BuildMeshSurvey(input, geometry, backend);
  built.Order = OrderMesh(input, built.Survey, backend);
  const EdgeMeshInput edges{ input, built.Survey, built.Order, 180.0 };
  built.Result = BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend);
  return built;
}

std::map<Pair, std::vector<CornerId>> MapCorners(const EdgeMesh& mesh)
{
  std::map<Pair, std::vector<CornerId>> corners;
  for (TriangleId t = 0; t < mesh.NumberOfTriangles; ++t)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const VertexId a = mesh.Triangles[t].Vertices[NextSlot(slot)];
      const VertexId b = mesh.Triangles[t].Vertices[PreviousSlot(slot)];
      corners[std::minmax(a, b)].push_back(MakeCorner(t, slot));
    }
  }
  return corners;
}

/// The corners of every edge, in the order of the smallest corner, which edge ids must follow.
std::vector<std::vector<CornerId>> ExpectedRecords(const EdgeMesh& mesh)
{
  std::vector<std::vector<CornerId>> records;
  for (const auto& entry : MapCorners(mesh))
  {
    if (entry.second.size() <= 2)
    {
      records.push_back(entry.second);
      continue;
    }
    for (const CornerId corner : entry.second)
    {
      records.push_back({ corner });
    }
  }
  std::sort(records.begin(), records.end());
  return records;
}

void ExpectRecords(const EdgeMesh& mesh)
{
  const auto expected = ExpectedRecords(mesh);
  ASSERT_EQ(static_cast<std::int64_t>(expected.size()), mesh.NumberOfEdges);
  for (std::int64_t e = 0; e < mesh.NumberOfEdges; ++e)
  {
    const CornerId second = expected[e].size() == 2 ? expected[e][1] : NoCorner;
    ASSERT_EQ(expected[e][0], mesh.CornerOfHalfEdge[2 * e]) << "edge " << e;
    ASSERT_EQ(second, mesh.CornerOfHalfEdge[2 * e + 1]) << "edge " << e;
  }
}

/// Random triangles on few points: every kind of edge, degenerate triangles included.
OwnedMesh<float> MakeSoup(std::int32_t points, std::int32_t triangles, std::uint32_t seed)
{
  std::mt19937 random(seed);
  OwnedMesh<float> mesh;
  for (std::int32_t i = 0; i < 3 * points; ++i)
  {
    mesh.Points.push_back(static_cast<float>(random() % 1024));
  }
  for (std::int32_t i = 0; i < 3 * triangles; ++i)
  {
    mesh.Triangles.push_back(static_cast<std::int32_t>(random() % points));
  }
  return mesh;
}

/// A few vertices with very many edges fill one long stretch of the table.
TEST(EdgeTableTest, HubsLeaveRoomForAll)
{
  constexpr VertexId Hubs = 2000;
  constexpr VertexId EdgesOfHub = 30;
  const ThreadBackend backend(1);
  EdgeTable table(Hubs * EdgesOfHub, { 0, 4 * Hubs }, false, backend);
  const EdgeTableView view = table.View();
  for (VertexId other = 0; other < EdgesOfHub; ++other)
  {
    for (VertexId hub = 0; hub < Hubs; ++hub)
    {
      bool inserted = false;
      ASSERT_NE(EdgeTableView::NoSlot, view.FindOrInsert(EdgeKey(hub, Hubs + other), inserted));
      ASSERT_TRUE(inserted);
    }
  }
  for (VertexId hub = 0; hub < Hubs; ++hub)
  {
    EXPECT_NE(EdgeTableView::NoSlot, view.Find(EdgeKey(hub, Hubs)));
    EXPECT_EQ(EdgeTableView::NoSlot, view.Find(EdgeKey(hub, Hubs + EdgesOfHub)));
  }
}

/// A planar mesh needs the table of vertex pairs only for constraints. Edges are the same without.
TEST(EdgeMesh, PairsAlikeWithAndWithoutTheTable)
{
  const ThreadBackend backend(2);
  for (const std::int32_t points : { 3, 30, 9000 })
  {
    const OwnedMesh<float> mesh = MakeSoup(points, 3 * points, 7);
    const Built without = Build(mesh.View(), backend, GeometryKind::PlanarXY);
    ExpectRecords(without.Result.Edges);
    EXPECT_EQ(0, CountInconsistencies(without.Result.Edges, backend));
    const std::int64_t constraint[2] = { mesh.Triangles[0], mesh.Triangles[1] };
    TriangleMesh view = mesh.View();
    view.ConstraintEdges = constraint;
    view.NumberOfConstraintEdges = 1;
    const Built with = Build(view, backend, GeometryKind::PlanarXY);
    ExpectRecords(with.Result.Edges);
    EXPECT_TRUE(without.Result.Table.IsEmpty());
    EXPECT_FALSE(with.Result.Table.IsEmpty());
    EXPECT_EQ(with.Result.Counts.Edges, without.Result.Counts.Edges);
    EXPECT_EQ(with.Result.Counts.NonManifold, without.Result.Counts.NonManifold);
    EXPECT_EQ(with.Result.DuplicateTriangles.Count, without.Result.DuplicateTriangles.Count);
  }
}

/// The result of pairing that is stored in the triangles: other corners and roles.
std::vector<std::uint32_t> PairInSlices(
  const TriangleMesh& mesh, std::int64_t slices, EdgeCounts& counts, const ThreadBackend& backend)
{
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, GeometryKind::Auto, backend);
  const SpatialOrder order = OrderMesh(input, survey, backend);
  const EdgeMeshInput edges{ input, survey, order, 180.0 };
  EdgeMeshResult result;
  result.Edges = LoadTriangles(edges, backend);
  const ThreadNumbering numbering = PairByTable(edges, result, slices, backend);
  counts = result.Counts;
  std::vector<std::uint32_t> paired{ static_cast<std::uint32_t>(numbering.Total) };
  for (std::int64_t t = 0; t < result.Edges.NumberOfTriangles; ++t)
  {
    const TriangleRecord& triangle = result.Edges.Triangles[t];
    paired.insert(paired.end(), triangle.HalfEdges, triangle.HalfEdges + 3);
    paired.push_back(triangle.Flips);
  }
  return paired;
}

void ExpectSlicesAlike(const TriangleMesh& mesh)
{
  const ThreadBackend backend(2);
  EdgeCounts whole;
  const std::vector<std::uint32_t> expected = PairInSlices(mesh, 1, whole, backend);
  for (const std::int64_t slices : { 2, 3, 4, 7 })
  {
    EdgeCounts counts;
    EXPECT_TRUE(expected == PairInSlices(mesh, slices, counts, backend)) << slices << " slices";
    EXPECT_EQ(whole.Edges, counts.Edges) << slices << " slices";
    EXPECT_EQ(whole.NonManifold, counts.NonManifold) << slices << " slices";
  }
}

TEST(EdgeMesh, PairsAlikeInSlices)
{
  ExpectSlicesAlike(MakeRandomBadMesh(20000, 1).View());
  ExpectSlicesAlike(MakeSoup(300, 2000, 5).View());
}

/// The slice with the hub has half of the edges, more than its share of the table.
TEST(EdgeMesh, PairsUnevenSlicesTogether)
{
  OwnedMesh<float> fan;
  constexpr int Rim = 4000;
  fan.Points = { 0.0f, 0.0f, 0.0f };
  for (int i = 0; i < Rim; ++i)
  {
    const double angle = 6.283185307179586 * i / Rim;
    fan.Points.insert(fan.Points.end(),
      { static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0f });
    fan.Triangles.insert(fan.Triangles.end(), { 0, 1 + i, 1 + (i + 1) % Rim });
  }
  ExpectSlicesAlike(fan.View());
}

/// These triangles have no edges between different points, and still one repeats another.
TEST(EdgeMesh, FindsRepeatedTrianglesOfOnePoint)
{
  OwnedMesh<float> mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
  mesh.Triangles = { 0, 1, 2, 2, 2, 2, 1, 1, 1, 2, 2, 2 };
  const ThreadBackend backend(1);
  const Built built = Build(mesh.View(), backend, GeometryKind::PlanarXY);
  EXPECT_EQ(1, built.Result.DuplicateTriangles.Count);
}

/// One thread would pair all corners of a vertex that has most of the edges.
TEST(CornerPairing, KnowsWhetherBucketsAreEven)
{
  const ThreadBackend backend(2);
  const OwnedMesh<float> mesh = MakeRandomBadMesh(20000, 1);
  Built built = Build(mesh.View(), backend);
  const CornerPairing pairing(built.Result.Edges, mesh.NumberOfPoints(), backend);
  EXPECT_TRUE(pairing.IsEven());
  EXPECT_FALSE(pairing.IsEven(1000));
}

TEST(EdgeMesh, RandomMeshMatchesBruteForce)
{
  const ThreadBackend backend(2);
  const OwnedMesh<float> mesh = MakeRandomBadMesh(20000, 1); // large enough to be reordered
  const Built built = Build(mesh.View(), backend);
  ASSERT_GT(built.Order.VertexOfRank.Size(), 0u);
  ExpectRecords(built.Result.Edges);
  EXPECT_EQ(0, CountInconsistencies(built.Result.Edges, backend));
}

TEST(EdgeMesh, SoupMatchesBruteForce)
{
  const ThreadBackend backend(2);
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    const OwnedMesh<float> mesh = MakeSoup(12, 40, seed);
    const Built built = Build(mesh.View(), backend);
    ExpectRecords(built.Result.Edges);
  }
}

TEST(EdgeMesh, SeparateTrianglesFillTheTable)
{
  // Three edges per triangle, twice as many as in a closed mesh: the first table becomes full.
  const ThreadBackend backend(2);
  OwnedMesh<float> mesh;
  for (std::int32_t i = 0; i < 30000; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { float(i), float(i % 7), float(i % 3) });
    mesh.Triangles.push_back(i);
  }
  const Built built = Build(mesh.View(), backend);
  EXPECT_EQ(30000, built.Result.Counts.Edges);
  EXPECT_EQ(30000, built.Result.Counts.Boundary);
  ExpectRecords(built.Result.Edges);
}

TEST(EdgeMesh, HubOfManyTriangles)
{
  // One vertex is in every triangle. No cost may grow with the square of its degree.
  const ThreadBackend backend(2);
  constexpr std::int32_t Spokes = 300000;
  OwnedMesh<float> mesh;
  mesh.Points = { 0.0f, 0.0f, 0.0f };
  for (std::int32_t i = 0; i <= Spokes; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { float(i), 1.0f, 0.0f });
  }
  for (std::int32_t i = 1; i <= Spokes; ++i)
  {
    mesh.Triangles.insert(mesh.Triangles.end(), { 0, i + 1, i });
  }
  const Built built = Build(mesh.View(), backend);
  EXPECT_EQ(2 * Spokes + 1, built.Result.Counts.Edges);
  EXPECT_EQ(Spokes + 2, built.Result.Counts.Boundary);
}

TEST(EdgeMesh, AuditSeesBrokenWords)
{
  const ThreadBackend backend(1);
  Built built = Build(MakeRandomBadMesh(100, 1).View(), backend);
  EdgeMesh& mesh = built.Result.Edges;
  EXPECT_NO_THROW(RequireConsistent(mesh, backend));
  std::swap(mesh.CornerOfHalfEdge[0], mesh.CornerOfHalfEdge[20]);
  EXPECT_GT(CountInconsistencies(mesh, backend), 0);
  EXPECT_THROW(RequireConsistent(mesh, backend), std::logic_error);
}
}
