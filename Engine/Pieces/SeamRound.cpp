// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRound.h"

#include "QuadSoup.h"
#include "SeamTriangle.h"

#include <algorithm>
#include <map>
#include <utility>

namespace delaunayflip
{

namespace
{
RecordLists<SeamTriangle> ListSeams(const PieceMesh& mesh, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    for (int slot = 0; slot < 3 && mesh.Triangles[t].HasSeam(); ++slot)
    {
      if (mesh.Triangles[t].Has(SeamMark, slot))
      {
        const SeamTriangle seam = MakeSeamTriangle(mesh, static_cast<std::int64_t>(t), slot);
        toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam);
      }
    }
  }
  return toHome;
}

void TellBad(const RankedTriangle& one, const RankedTriangle& other, RecordLists<BadSeam>& toRank)
{
  toRank[one.Rank].push_back({ one.Seam.GetTriangle(), one.Seam.Ends,
    MakePair(one.Seam.Opposite, other.Seam.Opposite), other.Rank });
}

/// The edges whose home this rank is.
struct HomeTest
{
  RecordLists<BadSeam> ToRank;
  std::int64_t Bad = 0;
  std::int64_t Blocked = 0;

  void Run(const std::vector<RankedTriangle>& seams, QuadSoup soup)
  {
    std::vector<std::size_t> firsts;
    for (std::size_t i = 1; i < seams.size(); ++i)
    {
      const bool isQuad = seams[i].Seam.Ends == seams[i - 1].Seam.Ends &&
        seams[i].Seam.Opposite != seams[i - 1].Seam.Opposite;
      if (isQuad)
      {
        soup.Add(seams[i - 1].Seam.Side, seams[i].Seam.Side);
        firsts.push_back(i - 1);
      }
    }
    const std::vector<unsigned char> bad = soup.FindBad(this->Blocked);
    for (std::size_t i = 0; i < bad.size(); ++i)
    {
      if (bad[i] != 0)
      {
        TellBad(seams[firsts[i]], seams[firsts[i] + 1], this->ToRank);
        TellBad(seams[firsts[i] + 1], seams[firsts[i]], this->ToRank);
        ++this->Bad;
      }
    }
  }
};
}

SeamTest TestSeams(
  const PieceMesh& mesh, const PieceSurvey& survey, const FlipOptions& options, PieceGroup& group)
{
  const std::vector<RankedTriangle> seams =
    SortByEdge(ExchangeRecords(group, ListSeams(mesh, group)));
  HomeTest home;
  home.ToRank.resize(group.GetSize());
  DoTogether(group, [&]() { home.Run(seams, QuadSoup(survey, options)); });
  SeamTest test;
  for (const std::vector<BadSeam>& list : ExchangeRecords(group, home.ToRank))
  {
    test.Bad.insert(test.Bad.end(), list.begin(), list.end());
  }
  test.BadOfAll = SumOverRanks(group, home.Bad);
  test.BlockedOfAll = SumOverRanks(group, home.Blocked);
  return test;
}

namespace
{
/// A triangle of this rank and the rank that shall have it.
using Receivers = std::map<std::int64_t, int>;

/// A triangle that several ranks shall have goes to the lowest of them, or to the highest.
Receivers ChooseReceivers(const std::vector<BadSeam>& bad, bool toLower, int rank)
{
  Receivers receivers;
  for (const BadSeam& seam : bad)
  {
    const int receiver = toLower ? std::min(rank, seam.OtherRank) : std::max(rank, seam.OtherRank);
    const auto [place, isNew] = receivers.emplace(seam.Triangle, receiver);
    place->second = isNew
      ? receiver
      : (toLower ? std::min(place->second, receiver) : std::max(place->second, receiver));
  }
  return receivers;
}

/// Marks the inner edges of triangles that will move as edges between ranks, on both sides.
void MarkSeams(PieceMesh& mesh, const Receivers& leaving)
{
  PairMap<int> edges;
  PointFlags flags;
  for (const auto& [t, receiver] : leaving)
  {
    const PieceTriangle& triangle = mesh.Triangles[t];
    for (int slot = 0; slot < 3; ++slot)
    {
      flags.Set(triangle.Points[slot]);
      mesh.Shared[triangle.Points[slot]] = 1;
      if (!triangle.Has(FixedMark, slot) && !triangle.Has(SeamMark, slot))
      {
        edges.emplace(triangle.GetEdge(slot), 0);
      }
    }
  }
  const auto forEachCorner = [&](const auto& visit)
  {
    for (PieceTriangle& triangle : mesh.Triangles)
    {
      for (int slot = 0; slot < 3 && flags.Count(triangle) > 1; ++slot)
      {
        const auto edge = edges.find(triangle.GetEdge(slot));
        if (edge != edges.end())
        {
          visit(triangle, slot, edge->second);
        }
      }
    }
  };
  forEachCorner([](PieceTriangle&, int, int& count) { ++count; });
  forEachCorner(
    [](PieceTriangle& triangle, int slot, int count)
    {
      if (count == 2) // else the edge is at the boundary
      {
        triangle.Set(SeamMark, slot);
      }
    });
}

/// Takes the marks from edges that are inner ones again.
void ClearSeams(PieceMesh& mesh)
{
  PairMap<std::pair<std::int64_t, int>> first; // a triangle and its slot
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    PieceTriangle& triangle = mesh.Triangles[t];
    for (int slot = 0; slot < 3 && triangle.HasSeam(); ++slot)
    {
      if (!triangle.Has(SeamMark, slot))
      {
        continue;
      }
      const auto [place, isNew] =
        first.emplace(triangle.GetEdge(slot), std::make_pair(static_cast<std::int64_t>(t), slot));
      if (!isNew)
      {
        triangle.Clear(SeamMark, slot);
        mesh.Triangles[place->second.first].Clear(SeamMark, place->second.second);
      }
    }
  }
}

/// Removes the triangles that leave. @returns them, by their receivers.
RecordLists<TravellingTriangle> TakeAway(PieceMesh& mesh, const Receivers& leaving, int ranks)
{
  RecordLists<TravellingTriangle> toRank(ranks);
  std::size_t kept = 0;
  auto next = leaving.begin();
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    if (next != leaving.end() && next->first == static_cast<std::int64_t>(t))
    {
      toRank[next->second].push_back(mesh.Pack(mesh.Triangles[t]));
      ++next;
    }
    else
    {
      mesh.Triangles[kept++] = mesh.Triangles[t];
    }
  }
  mesh.Triangles.resize(kept);
  return toRank;
}

void AddPoints(const PieceTriangle& triangle, std::vector<std::int32_t>& points)
{
  points.insert(points.end(), triangle.Points, triangle.Points + 3);
}
}

std::vector<std::int32_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  bool toLower, PieceGroup& group, std::int64_t& moved)
{
  Receivers leaving = ChooseReceivers(bad, toLower, group.GetRank());
  std::vector<std::int32_t> points;
  for (auto one = leaving.begin(); one != leaving.end();)
  {
    const bool stays = one->second == group.GetRank();
    if (stays)
    {
      AddPoints(mesh.Triangles[one->first], points);
    }
    one = stays ? leaving.erase(one) : std::next(one);
  }
  if (!leaving.empty())
  {
    MarkSeams(mesh, leaving);
  }
  moved = SumOverRanks(group, static_cast<std::int64_t>(leaving.size()));
  const RecordLists<TravellingTriangle> arriving =
    ExchangeRecords(group, TakeAway(mesh, leaving, group.GetSize()));
  for (const std::vector<TravellingTriangle>& list : arriving)
  {
    for (const TravellingTriangle& triangle : list)
    {
      mesh.Triangles.push_back(mesh.Unpack(triangle));
      AddPoints(mesh.Triangles.back(), points);
    }
  }
  ClearSeams(mesh);
  return points;
}

}
