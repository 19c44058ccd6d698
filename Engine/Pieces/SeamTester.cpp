// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamTester.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

namespace
{
constexpr std::int64_t HasNone = -1; // of a side that the rank has no longer

RecordLists<SeamTriangle> ListNews(PieceMesh& mesh, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  const auto add = [&](const SeamTriangle& seam)
  { toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam); };
  for (const PointPair& ends : mesh.TakeLostSeams())
  {
    SeamTriangle lost{};
    lost.Ends = ends;
    lost.Corner = HasNone;
    add(lost);
  }
  for (const PieceCorner& corner : mesh.TakeNewSeams())
  {
    add(MakeSeamTriangle(mesh, corner.Triangle, corner.Slot));
  }
  return toHome;
}
}

/// @param news by edge and rank. One with a corner follows one without.
void SeamTester::Update(const std::vector<RankedTriangle>& news)
{
  std::vector<Side> sides;
  sides.reserve(this->Sides.size() + news.size());
  auto side = this->Sides.begin();
  for (const RankedTriangle& one : news)
  {
    for (; side != this->Sides.end() && IsBefore(*side, one); ++side)
    {
      sides.push_back(*side);
    }
    for (; side != this->Sides.end() && !IsBefore(one, *side); ++side)
    {
      this->Free.push_back(side->Place); // what the rank has said before
    }
    if (one.Seam->Corner != HasNone)
    {
      sides.push_back({ one.Ends, one.Rank, this->Keep(*one.Seam), true });
    }
  }
  sides.insert(sides.end(), side, this->Sides.end());
  this->Sides = std::move(sides);
}

/// @returns its place.
std::uint32_t SeamTester::Keep(const SeamTriangle& seam)
{
  if (this->Free.empty())
  {
    this->Seams.push_back(seam);
    return static_cast<std::uint32_t>(this->Seams.size() - 1);
  }
  const std::uint32_t place = this->Free.back();
  this->Free.pop_back();
  this->Seams[place] = seam;
  return place;
}

/// The first sides of the edges to be tested, which have two triangles.
std::vector<std::size_t> SeamTester::ListToTest() const
{
  std::vector<std::size_t> firsts;
  for (std::size_t i = 1; i < this->Sides.size(); ++i)
  {
    const bool isToTest = this->Sides[i - 1].IsToTest || this->Sides[i].IsToTest;
    if (isToTest && this->Sides[i - 1].Ends == this->Sides[i].Ends &&
      this->GetSeam(i - 1).Opposite != this->GetSeam(i).Opposite)
    {
      firsts.push_back(i - 1);
    }
  }
  return firsts;
}

void SeamTester::TellBad(std::size_t one, std::size_t other, RecordLists<BadSeam>& toRank) const
{
  const SeamTriangle& seam = this->GetSeam(one);
  BadSeam bad{ seam.GetTriangle(), seam.Ends,
    MakePair(seam.Opposite, this->GetSeam(other).Opposite), {}, this->Sides[other].Rank };
  std::copy_n(this->GetSeam(std::min(one, other)).Side.Ends[0], 3, bad.Place);
  toRank[this->Sides[one].Rank].push_back(bad);
}

SeamTester::Found SeamTester::Judge(const QuadJudge& judge, int ranks)
{
  Found found;
  found.ToRank.resize(ranks);
  for (const std::size_t i : this->ListToTest())
  {
    const EdgeState state = judge.Judge(this->GetSeam(i).Side, this->GetSeam(i + 1).Side);
    this->Sides[i].IsToTest = this->Sides[i + 1].IsToTest = state != EdgeState::Good;
    if (state == EdgeState::Bad)
    {
      this->TellBad(i, i + 1, found.ToRank);
      this->TellBad(i + 1, i, found.ToRank);
      ++found.Bad;
    }
    found.Blocked += state == EdgeState::BlockedByShape ? 1 : 0;
  }
  return found;
}

SeamTest SeamTester::Run(PieceMesh& mesh, const QuadJudge& judge, PieceGroup& group)
{
  const RecordLists<SeamTriangle> news = ExchangeRecords(group, ListNews(mesh, group));
  this->Update(SortByEdge(news));
  Found found;
  DoTogether(group, [&]() { found = this->Judge(judge, group.GetSize()); });
  SeamTest test;
  for (const std::vector<BadSeam>& list : ExchangeRecords(group, found.ToRank))
  {
    test.Bad.insert(test.Bad.end(), list.begin(), list.end());
  }
  test.BadOfAll = SumOverRanks(group, found.Bad);
  test.BlockedOfAll = SumOverRanks(group, found.Blocked);
  return test;
}

}
