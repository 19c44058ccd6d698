// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRound.h"

#include "Records.h"
#include "SeamHalves.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace delaunayflip
{

namespace
{
/// A triangle of this rank and the rank that gets it.
struct Move
{
  std::int64_t Triangle;
  int Receiver;
};

/// Each triangle once, ascending.
std::vector<Move> ChooseReceivers(const std::vector<BadSeam>& bad, const MoveRule& rule, int rank)
{
  std::optional<SeamHalves> halves;
  if (rule.InHalves)
  {
    halves.emplace(bad);
  }
  std::vector<Move> moves;
  moves.reserve(bad.size());
  for (const BadSeam& seam : bad)
  {
    const int other = seam.OtherRank;
    const bool toLower = rule.ToLower != (halves && halves->IsInSecond(seam));
    moves.push_back({ seam.Triangle, toLower ? std::min(rank, other) : std::max(rank, other) });
  }
  const auto place = [&](const Move& move)
  { return std::make_pair(move.Triangle, rule.ToLower ? move.Receiver : -move.Receiver); };
  std::sort(
    moves.begin(), moves.end(), [&](const Move& a, const Move& b) { return place(a) < place(b); });
  moves.erase(std::unique(moves.begin(), moves.end(),
                [](const Move& a, const Move& b) { return a.Triangle == b.Triangle; }),
    moves.end());
  return moves;
}

/// Marks the inner edges of triangles that will move as edges between ranks, on both sides.
void MarkSeams(PieceMesh& mesh, const std::vector<std::int64_t>& leaving)
{
  for (const std::int64_t t : leaving)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const PieceCorner mate = mesh.FindOpenMate({ t, slot });
      if (mate.Triangle >= 0) // else it is a boundary edge, fixed, or a seam edge
      {
        mesh.SetSeam({ t, slot });
        mesh.SetSeam(mate);
      }
    }
  }
}

/// Clears the seam marks of edges of a triangle that are inner edges again.
void ClearSeams(PieceMesh& mesh, std::int64_t t)
{
  for (int slot = 0; slot < 3; ++slot)
  {
    const bool isSeam = mesh.Triangles[t].Has(SeamMark, slot);
    const PieceCorner mate = isSeam ? mesh.FindMate({ t, slot }) : PieceCorner{ -1, 0 };
    if (mate.Triangle >= 0)
    {
      mesh.ClearSeam({ t, slot });
      mesh.ClearSeam(mate);
    }
  }
}

/// Removes the triangles that leave. @returns them, by their receivers.
RecordLists<TravellingTriangle> TakeAway(
  PieceMesh& mesh, const std::vector<Move>& leaving, int ranks)
{
  std::vector<std::int64_t> triangles;
  triangles.reserve(leaving.size());
  for (const Move& move : leaving)
  {
    triangles.push_back(move.Triangle);
  }
  MarkSeams(mesh, triangles);
  RecordLists<TravellingTriangle> toRank(ranks);
  auto next = leaving.begin();
  for (const TravellingTriangle& triangle : mesh.Release(triangles))
  {
    toRank[next->Receiver].push_back(triangle);
    ++next;
  }
  return toRank;
}

/// Adds the triangles that have come, and their numbers to `toJudge`.
void TakeIn(PieceMesh& mesh, const RecordLists<TravellingTriangle>& arriving,
  std::vector<std::int64_t>& toJudge)
{
  for (const std::vector<TravellingTriangle>& list : arriving)
  {
    for (const TravellingTriangle& triangle : list)
    {
      const std::int64_t t = mesh.Receive(triangle);
      ClearSeams(mesh, t);
      toJudge.push_back(t);
    }
  }
}
}

std::vector<std::int64_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  const MoveRule& rule, PieceGroup& group, std::int64_t& moved)
{
  std::vector<std::int64_t> toJudge;
  std::vector<Move> leaving;
  for (const Move& move : ChooseReceivers(bad, rule, group.GetRank()))
  {
    if (move.Receiver == group.GetRank())
    {
      toJudge.push_back(move.Triangle);
    }
    else
    {
      leaving.push_back(move);
    }
  }
  moved = SumOverRanks(group, static_cast<std::int64_t>(leaving.size()));
  TakeIn(mesh, ExchangeRecords(group, TakeAway(mesh, leaving, group.GetSize())), toJudge);
  return toJudge;
}

}
