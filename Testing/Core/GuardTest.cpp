// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeGuard.h"
#include "EdgeMeshBuilder.h"
#include "FlipSteps.h"
#include "GeneratedMeshes.h"
#include "MeshSurveyBuilder.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

/// @file
/// What keeps flips from making an edge twice, part by part: the table of edges, the claims of an
/// iteration, and the guard that renews the table.

namespace
{
using namespace delaunayflip;

EdgeMesh BuildEdges(const OwnedMesh<double>& owned, const ThreadBackend& backend)
{
  const TriangleMesh mesh = owned.View();
  const MeshInput input{ mesh, mesh };
  const MeshSurvey survey = BuildMeshSurvey(input, GeometryKind::Auto, backend);
  const SpatialOrder order = OrderMesh(input, survey, backend);
  const EdgeMeshInput edges{ input, survey, order, 180.0 };
  return std::move(BuildEdgeMesh(edges, LoadTriangles(edges, backend), backend).Edges);
}

TEST(EdgeTable, HoldsAsManyKeysAsItHasSlots)
{
  const ThreadBackend backend(1);
  EdgeTable table(0, { 0, 1000 }, false, backend);
  const EdgeTableView view = table.View();
  bool inserted = false;
  for (VertexId i = 0; i < view.Capacity; ++i)
  {
    // All at one vertex, so that the near slots do not suffice.
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

TEST(EdgeTable, TakesAKeyOnceAndForgetsIt)
{
  const ThreadBackend backend(1);
  EdgeTable table(0, { 0, 1000 }, false, backend);
  const EdgeTableView view = table.View();
  const std::uint64_t key = EdgeKey(3, 5);
  std::uint64_t* const end = view.Keys + view.Capacity;
  bool fresh = false;
  EXPECT_TRUE(view.InsertNew(key, fresh));
  EXPECT_TRUE(fresh);
  EXPECT_EQ(1, std::count(view.Keys, end, key));
  view.Remove(key);
  EXPECT_EQ(EdgeTableView::NoSlot, view.Find(key));
  EXPECT_EQ(0, std::count(view.Keys, end, key));
  EXPECT_TRUE(view.InsertNew(key, fresh));
  EXPECT_FALSE(fresh);
  EXPECT_NE(EdgeTableView::NoSlot, view.Find(key));
}

/// Words with room behind them that must stay as it is.
struct ClaimWords
{
  explicit ClaimWords(std::uint32_t size)
    : Words(4 * std::size_t(size), EdgeClaims::Empty),
      Claims{ this->Words.data(), size }
  {
  }

  bool IsEmpty() const
  {
    return std::all_of(this->Words.begin(), this->Words.end(),
      [](std::uint64_t word) { return word == EdgeClaims::Empty; });
  }
  bool IsWithinSize() const
  {
    return std::all_of(this->Words.begin() + this->Claims.Size, this->Words.end(),
      [](std::uint64_t word) { return word == EdgeClaims::Empty; });
  }

  std::vector<std::uint64_t> Words;
  EdgeClaims Claims;
};

TEST(EdgeClaims, GoToTheSmallestPriorityInAnyOrder)
{
  for (const bool smallestFirst : { false, true })
  {
    ClaimWords words(64);
    words.Claims.Claim(4, 9, smallestFirst ? 3 : 5);
    words.Claims.Claim(9, 4, smallestFirst ? 5 : 3);
    EXPECT_TRUE(words.Claims.Holds(4, 9, 3));
    EXPECT_FALSE(words.Claims.Holds(4, 9, 5));
    words.Claims.Release(4, 9, 3);
    EXPECT_TRUE(words.IsEmpty());
  }
}

TEST(EdgeClaims, FillTheirWordsAndNoOthers)
{
  constexpr std::uint32_t Size = 100;
  ClaimWords words(Size);
  for (VertexId i = 0; i < Size; ++i)
  {
    words.Claims.Claim(i, 1000 + i, i);
  }
  EXPECT_TRUE(words.IsWithinSize());
  for (VertexId i = 0; i < Size; ++i)
  {
    EXPECT_TRUE(words.Claims.Holds(i, 1000 + i, i));
    words.Claims.Release(i, 1000 + i, i);
  }
  EXPECT_TRUE(words.IsEmpty());
}

class EdgeGuardTest : public testing::Test
{
protected:
  EdgeGuardTest()
    : Backend(1),
      Edges(BuildEdges(MakeGridMesh(8, 8), this->Backend)),
      Guard(EdgeTable(this->Edges.NumberOfEdges, { 0, 81 }, false, this->Backend), {},
        this->Edges.NumberOfEdges, 81, this->Backend)
  {
    this->Guard.Rebuild(this->Edges, this->Backend);
    this->Key = this->GetKey(5);
  }

  std::uint64_t GetKey(EdgeId edge)
  {
    const Quad quad = this->Edges.View().GetQuad(edge);
    return EdgeKey(quad.P, quad.Q);
  }

  /// Takes a key out of the table; only a table made anew from the mesh has it again.
  void Spoil() { this->Guard.View().Edges.Table.Remove(this->Key); }
  bool IsRenewed()
  {
    return this->Guard.View().Edges.Table.Find(this->Key) != EdgeTableView::NoSlot;
  }

  ThreadBackend Backend;
  EdgeMesh Edges;
  EdgeGuard Guard;
  std::uint64_t Key = 0;
};

TEST_F(EdgeGuardTest, RenewsItsTableWhenAnEdgeFoundNoRoom)
{
  this->Spoil();
  this->Guard.Maintain(StepCounts(), this->Edges, this->Backend);
  EXPECT_FALSE(this->IsRenewed());
  StepCounts lost;
  lost.LostInserts = 1;
  this->Guard.Maintain(lost, this->Edges, this->Backend);
  EXPECT_TRUE(this->IsRenewed());
}

TEST_F(EdgeGuardTest, RenewsItsTableWhenTooManySlotsWereUsed)
{
  const std::int64_t left = this->Guard.GetFreshSlotsLeft();
  EXPECT_GT(left, 0);
  this->Spoil();
  StepCounts used;
  used.FreshSlots = left;
  this->Guard.Maintain(used, this->Edges, this->Backend);
  EXPECT_FALSE(this->IsRenewed());
  EXPECT_EQ(0, this->Guard.GetFreshSlotsLeft());
  used.FreshSlots = 1;
  this->Guard.Maintain(used, this->Edges, this->Backend);
  EXPECT_TRUE(this->IsRenewed());
  EXPECT_EQ(left, this->Guard.GetFreshSlotsLeft());
}

TEST_F(EdgeGuardTest, HearsOfFlips)
{
  EdgeId edge = 0; // one of two triangles
  while (this->Edges.View().CornerOfHalfEdge[2 * edge + 1] == NoCorner)
  {
    ++edge;
  }
  const Quad quad = this->Edges.View().GetQuad(edge);
  const EdgeGuardView guard = this->Guard.View();
  guard.Claims.Claim(quad.A, quad.B, Priority(edge));
  StepCounts counts;
  UpdateGuard(guard, edge, quad, counts);
  EXPECT_EQ(EdgeTableView::NoSlot, guard.Edges.Table.Find(EdgeKey(quad.P, quad.Q)));
  EXPECT_NE(EdgeTableView::NoSlot, guard.Edges.Table.Find(EdgeKey(quad.A, quad.B)));
  EXPECT_EQ(0, counts.LostInserts);
  EXPECT_EQ(EdgeState::BlockedByEdge, DecideByGuard(guard.Edges, quad));
  for (std::uint32_t i = 0; i < guard.Claims.Size; ++i)
  {
    EXPECT_EQ(EdgeClaims::Empty, guard.Claims.Words[i]);
  }
}

TEST_F(EdgeGuardTest, CountsTheSlotsThatFlipsUseFirst)
{
  const EdgeGuardView guard = this->Guard.View();
  const auto countEmpty = [&]
  {
    return std::count(guard.Edges.Table.Keys, guard.Edges.Table.Keys + guard.Edges.Table.Capacity,
      EdgeTableView::Empty);
  };
  const auto before = countEmpty();
  StepCounts counts;
  for (VertexId i = 0; i < 20; ++i)
  {
    // Edges that are not in the mesh, each in place of one that is not either.
    const Quad quad{ 0, 0, i, 60 + i, 1000 + i, 30 + i };
    guard.Claims.Claim(quad.A, quad.B, Priority(i));
    UpdateGuard(guard, i, quad, counts);
  }
  EXPECT_GT(counts.FreshSlots, 0);
  EXPECT_EQ(before - countEmpty(), counts.FreshSlots);
}

}
