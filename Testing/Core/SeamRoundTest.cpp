// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRound.h"

#include "DividedMesh.h"
#include "GeneratedMeshes.h"
#include "PieceGroup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// Which rank gets the triangles at bad seam edges in a round.

namespace delaunayflip
{
namespace
{

/// What a rank has after triangles have moved.
struct RankState
{
  std::size_t Bad = 0; ///< Seam edges before.
  std::int64_t Moved = 0;
  std::size_t Whole = 0; ///< Of these seam edges, those with both triangles on this rank.
};

/// The edges that a rank shares with the other of two, all of them taken as bad.
std::vector<BadSeam> ListSeams(PieceMesh& mesh, int rank)
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

std::size_t CountWhole(PieceMesh& mesh, const std::vector<BadSeam>& seams)
{
  const auto isWhole = [&](const BadSeam& seam)
  {
    const std::int64_t start = mesh.FindPoint(seam.Ends[0]);
    int count = 0;
    mesh.ForEachAt(static_cast<std::int32_t>(start),
      [&](const PieceCorner& corner)
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
      PieceMesh own(piece, MatchPoints(piece, group), rank, rank * mesh.NumberOfTriangles());
      own.ListAll();
      own.BeginRounds(false);
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
