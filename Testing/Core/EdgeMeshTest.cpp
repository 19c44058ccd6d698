// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMesh.h"
#include "CornerPairing.h"
#include "EdgeGuard.h"
#include "EdgeMeshBuilder.h"
#include "EdgePasses.h"
#include "FlipTestSupport.h"
#include "MeshSurveyBuilder.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

/// @file
/// The edge arrays against brute force, and what keeps flips from making an edge twice: the table
/// of edges, the claims of an iteration, and the guard that renews the table.

namespace delaunayflip
{
namespace
{

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

/// The result of pairing that is stored in the triangles, where the table is filled several times.
std::vector<std::uint32_t> PairInSlices(
  const TriangleMesh& mesh, std::int64_t slices, const ThreadBackend& backend)
{
  const MeshInput input{ mesh, mesh };
  const Built built = Build(mesh, backend);
  const EdgeMeshInput edges{ input, built.Survey, built.Order, 180.0 };
  EdgeMeshResult result;
  result.Edges = LoadTriangles(edges, backend);
  std::vector<std::uint32_t> paired;
  for (const std::int64_t count : { std::int64_t(PairByTable(edges, result, slices, backend).Total),
         result.Counts.Edges, result.Counts.NonManifold })
  {
    paired.push_back(static_cast<std::uint32_t>(count));
  }
  for (std::int64_t t = 0; t < result.Edges.NumberOfTriangles; ++t)
  {
    const TriangleRecord& triangle = result.Edges.Triangles[t];
    paired.insert(paired.end(), triangle.HalfEdges, triangle.HalfEdges + 3);
    paired.push_back(triangle.Flips);
  }
  return paired;
}

/// The corners of every edge, in the order of the smallest corner, which edge ids must follow.
/// Those of a triangle that names a vertex twice are alone.
std::vector<std::vector<CornerId>> ExpectedRecords(const EdgeMesh& mesh)
{
  std::map<std::pair<VertexId, VertexId>, std::vector<CornerId>> corners;
  std::vector<std::vector<CornerId>> records;
  for (TriangleId t = 0; t < mesh.NumberOfTriangles; ++t)
  {
    const VertexId* v = mesh.Triangles[t].Vertices;
    const bool isCollapsed = std::set<VertexId>(v, v + 3).size() < 3;
    for (int slot = 0; slot < 3; ++slot)
    {
      if (isCollapsed)
      {
        records.push_back({ MakeCorner(t, slot) });
        continue;
      }
      const VertexId a = v[NextSlot(slot)], b = v[PreviousSlot(slot)];
      corners[std::minmax(a, b)].push_back(MakeCorner(t, slot));
    }
  }
  for (const auto& entry : corners)
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

/// One vertex is in every triangle.
OwnedMesh<float> MakeHub(std::int32_t spokes)
{
  OwnedMesh<float> mesh;
  mesh.Points = { 0.0f, 0.0f, 0.0f };
  for (std::int32_t i = 0; i <= spokes; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { float(i), 1.0f, 0.0f });
  }
  for (std::int32_t i = 1; i <= spokes; ++i)
  {
    mesh.Triangles.insert(mesh.Triangles.end(), { 0, i + 1, i });
  }
  return mesh;
}

/// Three edges per triangle, twice as many as in a closed mesh: the first table becomes full.
OwnedMesh<float> MakeSeparateTriangles(std::int32_t corners)
{
  OwnedMesh<float> mesh;
  for (std::int32_t i = 0; i < corners; ++i)
  {
    mesh.Points.insert(mesh.Points.end(), { float(i), float(i % 7), float(i % 3) });
    mesh.Triangles.push_back(i);
  }
  return mesh;
}

/// A planar mesh needs the table of vertex pairs only for constraints; edges are the same without,
/// and in slices.
TEST(EdgeMesh, MatchesBruteForce)
{
  const ThreadBackend backend(2);
  std::vector<OwnedMesh<float>> meshes;
  for (std::uint32_t seed = 0; seed < 20; ++seed)
  {
    meshes.push_back(RoundToFloat(MakeSoup(12, 40, seed)));
  }
  meshes.push_back(RoundToFloat(MakeSoup(3, 9, 7)));
  meshes.push_back(RoundToFloat(MakeSoup(9000, 27000, 7)));
  meshes.push_back(MakeRandomBadMesh(20000, 1)); // large enough to be reordered
  meshes.push_back(MakeSeparateTriangles(30000));
  meshes.push_back(MakeHub(4000)); // in slices, one has half of the edges
  for (const OwnedMesh<float>& mesh : meshes)
  {
    SCOPED_TRACE(&mesh - meshes.data());
    const std::vector<std::int64_t> edge{ mesh.Triangles[0], mesh.Triangles[1] };
    for (const TriangleMesh& view : { mesh.View(), WithConstraints(mesh.View(), edge) })
    {
      const Built built = Build(view, backend, GeometryKind::PlanarXY);
      ExpectRecords(built.Result.Edges);
      EXPECT_EQ(0, CountInconsistencies(built.Result.Edges, backend));
      EXPECT_EQ(view.NumberOfConstraintEdges == 0, built.Result.Table.GetCapacity() == 0);
    }
    ExpectRecords(Build(mesh.View(), backend, GeometryKind::Surface).Result.Edges);
    const std::vector<std::uint32_t> whole = PairInSlices(mesh.View(), 1, backend);
    for (const std::int64_t slices : { 2, 3, 7 })
    {
      EXPECT_TRUE(whole == PairInSlices(mesh.View(), slices, backend)) << slices << " slices";
    }
  }
}

/// No cost may grow with the square of the degree of a vertex.
TEST(EdgeMesh, HubOfManyTriangles)
{
  constexpr std::int32_t Spokes = 300000;
  const OwnedMesh<float> mesh = MakeHub(Spokes);
  const ThreadBackend backend(2);
  const Built built = Build(mesh.View(), backend);
  EXPECT_EQ(2 * Spokes + 1, built.Result.Counts.Edges);
  EXPECT_EQ(Spokes + 2, built.Result.Counts.Boundary);
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

TEST(EdgeMesh, AuditSeesBrokenWords)
{
  const ThreadBackend backend(1);
  Built built = Build(MakeRandomBadMesh(100, 1).View(), backend);
  EdgeMesh& mesh = built.Result.Edges;
  EXPECT_NO_THROW(RequireConsistent(mesh, backend));
  std::swap(mesh.CornerOfHalfEdge[0], mesh.CornerOfHalfEdge[20]);
  EXPECT_THROW(RequireConsistent(mesh, backend), std::logic_error);
}

//------------------------------------------------------------------------------
/// All keys are at one vertex, so that the near slots do not suffice.
TEST(EdgeTable, HoldsAsManyKeysAsItHasSlots)
{
  const ThreadBackend backend(1);
  EdgeTable table(0, { 0, 1000 }, backend);
  const EdgeTableView view = table.View();
  bool inserted = false;
  for (VertexId i = 0; i < view.Capacity; ++i)
  {
    EXPECT_NE(EdgeTableView::NoSlot, view.FindOrInsert(EdgeKey(7, 100 + i), inserted));
    EXPECT_TRUE(inserted);
  }
  EXPECT_EQ(EdgeTableView::NoSlot, view.FindOrInsert(EdgeKey(7, 8), inserted));
  for (VertexId i = 0; i < view.Capacity; ++i)
  {
    const std::uint32_t slot = view.Find(EdgeKey(100 + i, 7));
    ASSERT_LT(slot, view.Capacity);
    EXPECT_EQ(EdgeKey(7, 100 + i), view.Keys[slot]);
  }
}

/// A guard of a mesh, and its table.
struct Guarded
{
  explicit Guarded(const TriangleMesh& mesh)
    : Edges(std::move(Build(mesh, Backend).Result.Edges)),
      Guard(Edges, mesh.Points.Count, Backend)
  {
  }

  GuardTableView Table() { return this->Guard.View().Edges.Table; }
  bool Has(EdgeId edge)
  {
    const Quad quad = this->Edges.View().GetQuad(edge);
    return this->Table().Has(this->Edges.View(), quad.Q, quad.P);
  }
  int Remove(EdgeId edge)
  {
    const Quad quad = this->Edges.View().GetQuad(edge);
    const GuardTableView table = this->Table();
    return table.Remove(edge, table.Find(quad.P, quad.Q));
  }

  const ThreadBackend Backend{ 1 };
  EdgeMesh Edges;
  EdgeGuard Guard;
};

/// Two vertices have most edges, so that the groups near them do not suffice.
TEST(EdgeGuard, FindsEdgesAlsoAfterOthersHaveGone)
{
  Guarded mesh(MakeWorstCaseMesh(2000).View());
  const auto edges = static_cast<EdgeId>(mesh.Edges.NumberOfEdges);
  int emptied = 0, removed = 0;
  for (EdgeId edge = 0; edge < edges; edge += 2)
  {
    if (mesh.Edges.States[edge] != EdgeState::Fixed)
    {
      EXPECT_TRUE(mesh.Has(edge));
      emptied += mesh.Remove(edge);
      ++removed;
      EXPECT_FALSE(mesh.Has(edge));
    }
  }
  EXPECT_GT(emptied, 0);
  EXPECT_LT(emptied, removed); // some groups had no empty slot
  for (EdgeId edge = 1; edge < edges; edge += 2)
  {
    if (mesh.Edges.States[edge] != EdgeState::Fixed)
    {
      const EdgeMeshView view = mesh.Edges.View();
      const Quad quad = view.GetQuad(edge);
      EXPECT_TRUE(mesh.Has(edge));
      EXPECT_FALSE(mesh.Table().Has(view, quad.A, quad.B));
    }
  }
}

TEST(EdgeGuard, HoldsAsManyEdgesAsItHasSlots)
{
  Guarded mesh(RoundToFloat(MakeGridMesh(8, 8)).View());
  const GuardTableView table = mesh.Table();
  const std::int64_t slots = std::int64_t(8) * table.Groups;
  VertexId other = 1000;
  for (std::int64_t i = mesh.Edges.NumberOfEdges; i < slots; ++i)
  {
    EXPECT_EQ(1, table.Insert(0, table.Find(7, ++other)));
  }
  EXPECT_EQ(-1, table.Insert(0, table.Find(7, 8000)));
  EXPECT_EQ(0, mesh.Remove(5)); // its group has no empty slot
  EXPECT_EQ(0, table.Insert(0, table.Find(7, 8000))); // uses it again
}

TEST(EdgeGuard, RenewsItsTableInTime)
{
  Guarded mesh(RoundToFloat(MakeGridMesh(8, 8)).View());
  EdgeGuard& guard = mesh.Guard;
  // Only a table made anew from the mesh has the edge again.
  const auto isRenewedAfter = [&](const StepCounts& counts)
  {
    mesh.Remove(5);
    guard.Maintain(counts, mesh.Edges, mesh.Backend);
    return mesh.Has(5);
  };
  EXPECT_FALSE(isRenewedAfter(StepCounts()));
  StepCounts lost;
  lost.LostInserts = 1; // an edge found no room
  EXPECT_TRUE(isRenewedAfter(lost));
  const std::int64_t left = guard.GetFreshSlotsLeft();
  EXPECT_GT(left, 0);
  StepCounts used;
  used.FreshSlots = left + 1;
  used.FreedSlots = 1;
  EXPECT_FALSE(isRenewedAfter(used));
  used.FreshSlots = 2; // too many slots are used
  EXPECT_TRUE(isRenewedAfter(used));
  EXPECT_EQ(left, guard.GetFreshSlotsLeft());
}

}
}
