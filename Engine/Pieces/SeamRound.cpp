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
RecordLists<SeamTriangle> ListSeams(PieceMesh& mesh, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  for (const PieceCorner& corner : mesh.FindSeams())
  {
    const SeamTriangle seam = MakeSeamTriangle(mesh, corner.Triangle, corner.Slot);
    toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam);
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
  PieceMesh& mesh, const PieceSurvey& survey, const FlipOptions& options, PieceGroup& group)
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
void MarkSeams(PieceMesh& mesh, const std::vector<std::int64_t>& leaving)
{
  for (const std::int64_t t : leaving)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const PieceCorner mate = mesh.FindOpenMate({ t, slot });
      if (mate.Triangle >= 0) // else the edge is at the boundary
      {
        mesh.SetSeam({ t, slot });
        mesh.SetSeam(mate);
      }
    }
  }
}

/// Takes the marks from edges of a triangle that are inner ones again.
void ClearSeams(PieceMesh& mesh, std::int64_t t)
{
  for (int slot = 0; slot < 3; ++slot)
  {
    PieceTriangle& triangle = mesh.Triangles[t];
    const PieceCorner mate =
      triangle.Has(SeamMark, slot) ? mesh.FindMate({ t, slot }) : PieceCorner{ -1, 0 };
    if (mate.Triangle >= 0)
    {
      triangle.Clear(SeamMark, slot);
      mesh.Triangles[mate.Triangle].Clear(SeamMark, mate.Slot);
    }
  }
}

/// Removes the triangles that leave. @returns them, by their receivers.
RecordLists<TravellingTriangle> TakeAway(PieceMesh& mesh, const Receivers& leaving, int ranks)
{
  std::vector<std::int64_t> triangles;
  for (const auto& [t, receiver] : leaving)
  {
    triangles.push_back(t);
  }
  MarkSeams(mesh, triangles);
  RecordLists<TravellingTriangle> toRank(ranks);
  auto next = leaving.begin();
  for (const TravellingTriangle& triangle : mesh.Release(triangles))
  {
    toRank[next->second].push_back(triangle);
    ++next;
  }
  return toRank;
}

void AddPoints(const PieceTriangle& triangle, std::vector<std::int32_t>& points)
{
  points.insert(points.end(), triangle.Points, triangle.Points + 3);
}

/// Adds the triangles that have come, and their points to `points`.
void TakeIn(PieceMesh& mesh, const RecordLists<TravellingTriangle>& arriving,
  std::vector<std::int32_t>& points)
{
  for (const std::vector<TravellingTriangle>& list : arriving)
  {
    for (const TravellingTriangle& triangle : list)
    {
      const std::int64_t t = mesh.Receive(triangle);
      ClearSeams(mesh, t);
      AddPoints(mesh.Triangles[t], points);
    }
  }
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
  moved = SumOverRanks(group, static_cast<std::int64_t>(leaving.size()));
  TakeIn(mesh, ExchangeRecords(group, TakeAway(mesh, leaving, group.GetSize())), points);
  return points;
}

}
