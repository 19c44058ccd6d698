// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRounds.h"

#include "DividedMesh.h"
#include "GeneratedMeshes.h"
#include "PieceGroup.h"
#include "PieceTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

/// @file
/// The flips of a rank in a round, and the triangles that move between ranks.

namespace delaunayflip
{
namespace
{

/// A mesh as a round finds it.
class RoundMesh
{
public:
  /// @param shared points that other ranks may have, too.
  RoundMesh(OwnedMesh<double> mesh, const FlipOptions& options,
    const std::vector<std::int64_t>& shared = {})
    : Mesh(std::move(mesh)),
      Piece{ this->Mesh.View() },
      Survey(
        SurveyParts(this->Piece, MatchPoints(this->Piece, *this->Alone), options, *this->Alone)),
      Rule(this->Survey, options),
      Triangles(this->Piece, MakeKeys(shared), 0, 0)
  {
    this->Triangles.ListAll();
    this->Triangles.BeginRounds();
  }

  TriangleSet GetSet() const
  {
    std::vector<std::int32_t> ids;
    for (const PartTriangle& triangle : this->Triangles.Triangles)
    {
      ids.insert(ids.end(), triangle.Points, triangle.Points + 3);
    }
    return ToTriangleSet(ids);
  }

  std::int64_t CountFlips() const
  {
    std::int64_t flips = 0;
    for (const PartTriangle& triangle : this->Triangles.Triangles)
    {
      flips += triangle.Flips;
    }
    return flips / 2; // each counts for two triangles
  }

private:
  PointKeys MakeKeys(const std::vector<std::int64_t>& shared) const
  {
    PointKeys keys = MatchPoints(this->Piece, *this->Alone);
    std::for_each(shared.begin(), shared.end(), [&](std::int64_t id) { keys.Shared[id] = 1; });
    return keys;
  }

  std::unique_ptr<PieceGroup> Alone = MakeSingleGroup();
  OwnedMesh<double> Mesh;
  MeshPiece Piece;
  PartSurvey Survey;

public:
  QuadJudge Rule;
  PartMesh Triangles;
};

/// Iterates to the end and checks the rows. @returns their sum.
IterationRecord RunAll(RoundFlips& flips, std::int64_t triangles)
{
  IterationRecord sum;
  while (!flips.AreDone())
  {
    const bool hasBad = flips.HasBad();
    const IterationRecord row = flips.Iterate();
    EXPECT_EQ(hasBad, row.Flipped > 0);
    EXPECT_EQ(row.NonDelaunay, row.Flipped + row.Blocked);
    EXPECT_LE(row.NonDelaunay, row.Tested);
    EXPECT_LE(2 * row.Flipped, triangles);
    sum.Tested += row.Tested;
    sum.Flipped += row.Flipped;
    sum.Blocked += row.Blocked;
  }
  return sum;
}

TEST(RoundFlips, MakeTheTrianglesOfASession)
{
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(300, 5);
  RoundMesh round(mesh, MakeCanonical());
  RoundFlips flips(round.Triangles, round.Rule, false);
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    flips.Add(t);
    flips.Add(t); // once is enough
  }
  EXPECT_EQ(static_cast<std::size_t>(mesh.NumberOfTriangles()), flips.GetNext().size());
  const IterationRecord sum = RunAll(flips, mesh.NumberOfTriangles());
  EXPECT_EQ(ToTriangleSet(Flip(mesh.View(), MakeCanonical()).Triangles), round.GetSet());
  EXPECT_LT(0, sum.Flipped);
  EXPECT_EQ(0, sum.Blocked);
  EXPECT_EQ(round.CountFlips(), sum.Flipped);
}

/// Whether the quad around an edge is strictly convex in the plane.
bool IsConvex(const PartMesh& mesh, const PartCorner& one, const PartCorner& other)
{
  const PartTriangle& triangle = mesh.Triangles[one.Triangle];
  double a[3], b[3], p[3], q[3];
  mesh.GetPosition(triangle.Points[one.Slot], a);
  mesh.GetPosition(mesh.Triangles[other.Triangle].Points[other.Slot], b);
  mesh.GetPosition(triangle.GetStart(one.Slot), p);
  mesh.GetPosition(triangle.GetEnd(one.Slot), q);
  const auto side = [&](const double(&x)[3])
  { return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]); };
  return side(p) * side(q) < 0.0;
}

/// Flips some edges of a Delaunay mesh that may flip, no two of them in one triangle.
/// @returns the triangles that have changed.
std::vector<std::int64_t> Spoil(RoundMesh& round)
{
  std::vector<std::int64_t> changed;
  PartMesh& mesh = round.Triangles;
  for (std::int64_t t = 20; t < 300; t += 60)
  {
    const PartCorner one{ t, 0 };
    const PartCorner other = mesh.FindOpenMate(one);
    if (other.Triangle >= 0 && mesh.Triangles[t].Flips == 0 &&
      mesh.Triangles[other.Triangle].Flips == 0 && IsConvex(mesh, one, other))
    {
      mesh.Flip(one, other);
      changed.insert(changed.end(), { t, other.Triangle });
    }
  }
  return changed;
}

TEST(RoundFlips, ReachOnlyAsFarAsFlipsDo)
{
  OwnedMesh<double> mesh = MakeRandomBadMeshDouble(300, 6);
  mesh.Triangles = Flip(mesh.View(), MakeCanonical()).Triangles;
  RoundMesh round(mesh, MakeCanonical());
  const TriangleSet delaunay = round.GetSet();
  const std::vector<std::int64_t> changed = Spoil(round);
  ASSERT_LT(2u, changed.size());
  ASSERT_NE(delaunay, round.GetSet());
  RoundFlips flips(round.Triangles, round.Rule, false);
  for (std::size_t i = 0; i < changed.size(); i += 2)
  {
    flips.Add(changed[i]);
  }
  const IterationRecord sum = RunAll(flips, mesh.NumberOfTriangles());
  EXPECT_EQ(delaunay, round.GetSet());
  EXPECT_LT(sum.Tested, 20 * static_cast<std::int64_t>(changed.size()));
}

/// Two quads on a surface, at a right angle: the edge 1-2 is bad, and its flip would make the edge
/// 0-3, which the other quad has and which is bad, too.
OwnedMesh<double> MakeWaitingEdge()
{
  OwnedMesh<double> mesh;
  mesh.Points = { 0, 1, 0, -3, 0, 0, 3, 0, 0, 0, -1, 0, 0, 0, 0.3, 0, 0, -0.3 };
  mesh.Triangles = { 0, 1, 2, 3, 2, 1, 4, 0, 3, 5, 3, 0 };
  return mesh;
}

TEST(RoundFlips, EdgesWaitUntilTheirPlaceIsFree)
{
  RoundMesh round(MakeWaitingEdge(), MakeOnSurface());
  RoundFlips flips(round.Triangles, round.Rule, true);
  flips.Add(0);
  EXPECT_FALSE(flips.HasBad());
  const IterationRecord waiting = RunAll(flips, 4);
  EXPECT_EQ(0, waiting.Flipped);
  EXPECT_EQ(1, waiting.Blocked);
  flips.Add(2); // frees the place of the edge that waits
  EXPECT_EQ(2, RunAll(flips, 4).Flipped);
  EXPECT_EQ(
    ToTriangleSet(std::vector<std::int32_t>{ 0, 1, 3, 3, 2, 0, 4, 0, 5, 5, 3, 4 }), round.GetSet());
}

TEST(RoundFlips, FreedEdgesAreJudgedAgain)
{
  RoundMesh round(MakeWaitingEdge(), MakeOnSurface());
  RoundFlips flips(round.Triangles, round.Rule, true);
  flips.AddFreed({ 1, 2 }); // no edge waits for this one
  EXPECT_TRUE(flips.AreDone());
  flips.AddFreed({ 3, 0 });
  EXPECT_EQ(std::vector<std::int64_t>{ 1 }, flips.GetNext());
}

TEST(RoundFlips, DoNotMakeEdgesThatOtherRanksMayHave)
{
  OwnedMesh<double> mesh = MakeWaitingEdge();
  mesh.Triangles.resize(6); // the first quad
  RoundMesh shared(mesh, MakeOnSurface(), { 0, 3 });
  RoundFlips guarded(shared.Triangles, shared.Rule, true);
  guarded.Add(0);
  EXPECT_EQ(1, RunAll(guarded, 2).Blocked);
  RoundFlips unguarded(shared.Triangles, shared.Rule, false);
  unguarded.Add(0);
  EXPECT_EQ(1, RunAll(unguarded, 2).Flipped);
}

//------------------------------------------------------------------------------
/// What a rank has after triangles have moved.
struct RankState
{
  std::size_t Bad = 0; ///< Seam edges before.
  std::int64_t Moved = 0;
  std::size_t Whole = 0; ///< Of these seam edges, those with both triangles on this rank.
};

/// The edges that a rank shares with the other of two, all of them taken as bad.
std::vector<BadSeam> ListSeams(PartMesh& mesh, int rank)
{
  std::vector<BadSeam> bad;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const auto t = static_cast<std::int64_t>(i);
    for (int slot = 0; slot < 3; ++slot)
    {
      const PointPair edge = mesh.GetEdge(t, slot);
      if (mesh.IsShared(edge[0]) && mesh.IsShared(edge[1]))
      {
        mesh.SetSeam({ t, slot });
        const PointPair keys = mesh.GetKeys(edge);
        bad.push_back({ t, keys, {}, {}, 1 - rank });
        mesh.GetPosition(mesh.FindPoint(keys[0]), bad.back().Place);
      }
    }
  }
  return bad;
}

std::size_t CountWhole(PartMesh& mesh, const std::vector<BadSeam>& seams)
{
  const auto isWhole = [&](const BadSeam& seam)
  {
    const std::int64_t start = mesh.FindPoint(seam.Ends[0]);
    int count = 0;
    mesh.ForEachAt(static_cast<std::int32_t>(start),
      [&](const PartCorner& corner)
      {
        const std::int32_t* p = mesh.Triangles[corner.Triangle].Points;
        count += std::count(p, p + 3, mesh.FindPoint(seam.Ends[1])) > 0 ? 1 : 0;
      });
    return count == 2;
  };
  return static_cast<std::size_t>(std::count_if(seams.begin(), seams.end(), isWhole));
}

/// A grid of which one rank has the left half and the other one the right half.
std::vector<RankState> MoveOnce(const MoveRule& rule)
{
  const OwnedMesh<double> mesh = MakeGridMesh(20, 30);
  Owners owners;
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const std::int32_t* p = &mesh.Triangles[3 * t];
    owners.push_back(std::max({ p[0] % 21, p[1] % 21, p[2] % 21 }) <= 10 ? 0 : 1);
  }
  const std::vector<OwnedPiece> pieces = Divide(mesh.View(), owners, 2);
  std::vector<RankState> states(2);
  RunInThreads(2,
    [&](PieceGroup& group)
    {
      const int rank = group.GetRank();
      const MeshPiece piece = pieces[rank].View(true);
      PartMesh own(piece, MatchPoints(piece, group), rank, rank * mesh.NumberOfTriangles());
      own.ListAll();
      own.BeginRounds();
      const std::vector<BadSeam> bad = ListSeams(own, rank);
      states[rank].Bad = bad.size();
      MoveTriangles(own, bad, rule, group, states[rank].Moved);
      states[rank].Whole = CountWhole(own, bad);
    });
  return states;
}

TEST(SeamRound, AllTrianglesGoToOneRank)
{
  for (const bool toLower : { false, true })
  {
    const std::vector<RankState> states = MoveOnce({ toLower, false });
    EXPECT_EQ(30u, states[0].Bad);
    EXPECT_EQ(30, states[0].Moved);
    EXPECT_EQ(toLower ? 30u : 0u, states[0].Whole);
    EXPECT_EQ(toLower ? 0u : 30u, states[1].Whole);
  }
}

TEST(SeamRound, EachRankGetsAHalf)
{
  for (const bool toLower : { false, true })
  {
    const std::vector<RankState> states = MoveOnce({ toLower, true });
    EXPECT_EQ(30, states[0].Moved);
    EXPECT_EQ(15u, states[0].Whole);
    EXPECT_EQ(15u, states[1].Whole);
  }
}

}
}
