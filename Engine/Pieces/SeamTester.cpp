// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamTester.h"

#include "QuadSoup.h"

#include <algorithm>
#include <tuple>

namespace delaunayflip
{

namespace
{
constexpr std::int64_t NoCorner = -1; // of a side that the rank has no longer

bool IsBefore(const RankedTriangle& a, const RankedTriangle& b)
{
  return std::tie(a.Seam.Ends, a.Rank) < std::tie(b.Seam.Ends, b.Rank);
}

RecordLists<SeamTriangle> ListNews(PieceMesh& mesh, const PieceGroup& group)
{
  RecordLists<SeamTriangle> toHome(group.GetSize());
  const auto add = [&](const SeamTriangle& seam)
  { toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam); };
  for (const PointPair& ends : mesh.TakeLostSeams())
  {
    SeamTriangle lost{};
    lost.Ends = ends;
    lost.Corner = NoCorner;
    add(lost);
  }
  for (const PieceCorner& corner : mesh.TakeNewSeams())
  {
    add(MakeSeamTriangle(mesh, corner.Triangle, corner.Slot));
  }
  return toHome;
}

void TellBad(const RankedTriangle& one, const RankedTriangle& other, RecordLists<BadSeam>& toRank)
{
  toRank[one.Rank].push_back({ one.Seam.GetTriangle(), one.Seam.Ends,
    MakePair(one.Seam.Opposite, other.Seam.Opposite), other.Rank });
}
}

/// @param news by edge and rank. One with a corner follows one without.
void SeamTester::Update(const std::vector<RankedTriangle>& news)
{
  const auto isReplaced = [&](const Side& side)
  { return std::binary_search(news.begin(), news.end(), side.Triangle, IsBefore); };
  if (!news.empty())
  {
    this->Sides.erase(
      std::remove_if(this->Sides.begin(), this->Sides.end(), isReplaced), this->Sides.end());
  }
  const auto kept = static_cast<std::ptrdiff_t>(this->Sides.size());
  for (const RankedTriangle& one : news)
  {
    if (one.Seam.Corner != NoCorner)
    {
      this->Sides.push_back({ one, true });
    }
  }
  std::inplace_merge(this->Sides.begin(), this->Sides.begin() + kept, this->Sides.end(),
    [](const Side& a, const Side& b) { return IsBefore(a.Triangle, b.Triangle); });
}

/// The first sides of the edges to be tested, which have two triangles.
std::vector<std::size_t> SeamTester::ListToTest() const
{
  std::vector<std::size_t> firsts;
  for (std::size_t i = 1; i < this->Sides.size(); ++i)
  {
    const SeamTriangle& one = this->Sides[i - 1].Triangle.Seam;
    const SeamTriangle& other = this->Sides[i].Triangle.Seam;
    const bool isToTest = this->Sides[i - 1].IsToTest || this->Sides[i].IsToTest;
    if (isToTest && one.Ends == other.Ends && one.Opposite != other.Opposite)
    {
      firsts.push_back(i - 1);
    }
  }
  return firsts;
}

SeamTester::Found SeamTester::Judge(
  const PieceSurvey& survey, const FlipOptions& options, int ranks)
{
  Found found;
  found.ToRank.resize(ranks);
  const std::vector<std::size_t> firsts = this->ListToTest();
  QuadSoup soup(survey, options);
  for (const std::size_t i : firsts)
  {
    soup.Add(this->Sides[i].Triangle.Seam.Side, this->Sides[i + 1].Triangle.Seam.Side);
  }
  const std::vector<unsigned char> bad = soup.FindBad(found.Blocked);
  for (std::size_t k = 0; k < firsts.size(); ++k)
  {
    Side& one = this->Sides[firsts[k]];
    Side& other = this->Sides[firsts[k] + 1];
    // Which edges are blocked is not known. So that they are counted again, none is left out.
    one.IsToTest = other.IsToTest = bad[k] != 0 || found.Blocked > 0;
    if (bad[k] != 0)
    {
      TellBad(one.Triangle, other.Triangle, found.ToRank);
      TellBad(other.Triangle, one.Triangle, found.ToRank);
      ++found.Bad;
    }
  }
  return found;
}

SeamTest SeamTester::Run(
  PieceMesh& mesh, const PieceSurvey& survey, const FlipOptions& options, PieceGroup& group)
{
  this->Update(SortByEdge(ExchangeRecords(group, ListNews(mesh, group))));
  Found found;
  DoTogether(group, [&]() { found = this->Judge(survey, options, group.GetSize()); });
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
