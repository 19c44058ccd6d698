// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRounds.h"

namespace delaunayflip
{

void CountState(EdgeState state, FlipReport& counts)
{
  counts.NonDelaunayAfter += state != EdgeState::Good;
  counts.BlockedByShape += state == EdgeState::BlockedByShape;
  counts.BlockedByDeviation += state == EdgeState::BlockedByDeviation;
  counts.BlockedByEdge += state == EdgeState::BlockedByEdge;
}

/// Brings the sides up to date.
void SeamTester::Update(PartMesh& mesh, const std::vector<std::int64_t>& changed, PieceGroup& group)
{
  // Changes go to the homes of the edges. An edge without a corner has lost its triangle here.
  constexpr std::int64_t HasNone = -1;
  RecordLists<SeamTriangle> toHome(group.GetSize());
  const auto tell = [&](const SeamTriangle& seam)
  { toHome[GetHome(PairHash()(seam.Ends), group)].push_back(seam); };
  for (const PointPair& ends : mesh.TakeLostSeams())
  {
    SeamTriangle lost{};
    lost.Ends = ends;
    lost.Corner = HasNone;
    lost.Rank = mesh.GetRank();
    tell(lost);
  }
  for (const std::int64_t t : changed)
  {
    for (int slot = 0; slot < 3 && !mesh.Triangles[t].HasLeft; ++slot)
    {
      if (mesh.Triangles[t].Has(SeamMark, slot))
      {
        tell(MakeSeamTriangle(mesh, t, slot));
      }
    }
  }
  for (const SeamTriangle& one : Join(ExchangeRecords(group, toHome)))
  {
    if (one.Corner == HasNone)
    {
      this->Sides.erase({ one.Ends, one.Rank });
    }
    else
    {
      this->Sides.insert_or_assign({ one.Ends, one.Rank }, one);
    }
  }
}

SeamTest SeamTester::Run(PartMesh& mesh, const std::vector<std::int64_t>& changed,
  const QuadJudge& judge, PieceGroup& group)
{
  this->Update(mesh, changed, group);
  RecordLists<BadSeam> toRank(group.GetSize());
  SeamTest result;
  std::int64_t countOfBad = 0;
  const auto test = [&](SeamTriangle& one, SeamTriangle& other)
  {
    const EdgeState state = judge.Judge(one, other);
    one.IsToTest = other.IsToTest = state != EdgeState::Good;
    CountState(state, result.Counts);
    if (state != EdgeState::Bad)
    {
      return;
    }
    ++countOfBad;
    BadSeam seam{ one.Corner / 3, one.Ends, MakePair(one.Opposite, other.Opposite), {},
      other.Rank };
    std::copy_n(one.Places[0], 3, seam.Place);
    toRank[one.Rank].push_back(seam);
    seam.Triangle = other.Corner / 3;
    seam.OtherRank = one.Rank;
    toRank[other.Rank].push_back(seam);
  };
  DoTogether(group,
    [&]()
    {
      SeamTriangle* last = nullptr;
      for (auto& [key, side] : this->Sides)
      {
        if (last && (last->IsToTest || side.IsToTest) && last->Ends == side.Ends &&
          last->Opposite != side.Opposite)
        {
          test(*last, side);
        }
        last = &side;
      }
    });
  result.Bad = Join(ExchangeRecords(group, toRank));
  result.BadOfAll = SumOverRanks(group, countOfBad);
  return result;
}

//------------------------------------------------------------------------------
namespace
{
/// Divides the bad seam edges between two ranks into two halves by their places.
struct SeamCut
{
  int Axis; ///< The axis along which the edges extend most.
  double Median;
};

/// A coordinate of the place of an edge; NaN counts as 0, because it has no order.
double GetPlace(const BadSeam* seam, int axis)
{
  return std::isnan(seam->Place[axis]) ? 0.0 : seam->Place[axis];
}

/// Finds a cut for each other rank. Both ranks find the same halves, because they have got the same
/// edges and places.
/// @param bad the bad seam edges of this rank.
std::unordered_map<int, SeamCut> CutSeams(const std::vector<BadSeam>& bad)
{
  std::unordered_map<int, std::vector<const BadSeam*>> seamsTo;
  for (const BadSeam& seam : bad)
  {
    seamsTo[seam.OtherRank].push_back(&seam);
  }
  std::unordered_map<int, SeamCut> cuts;
  for (auto& [rank, seams] : seamsTo)
  {
    const int axis = FindLongestAxis(seams.begin(), seams.end(), { 0, 1, 2 }, GetPlace);
    const auto middle = seams.begin() + static_cast<std::ptrdiff_t>(seams.size() / 2);
    std::nth_element(seams.begin(), middle, seams.end(),
      [=](const BadSeam* a, const BadSeam* b) { return GetPlace(a, axis) < GetPlace(b, axis); });
    cuts.emplace(rank, SeamCut{ axis, GetPlace(*middle, axis) });
  }
  return cuts;
}

int ChooseRank(int one, int other, bool isLower)
{
  return isLower ? std::min(one, other) : std::max(one, other);
}
}

std::vector<std::int64_t> MoveTriangles(PartMesh& mesh, const std::vector<BadSeam>& bad,
  const MoveRule& rule, PieceGroup& group, std::int64_t& moved)
{
  const int rank = group.GetRank();
  // In each round either rank gets the triangles of one half, so that usually both have edges to
  // flip.
  const std::unordered_map<int, SeamCut> cuts = CutSeams(bad);
  const auto isInSecond = [&](const BadSeam& seam)
  {
    const SeamCut& cut = cuts.at(seam.OtherRank);
    return GetPlace(&seam, cut.Axis) >= cut.Median;
  };
  std::map<std::int64_t, int> receivers; // by triangle
  for (const BadSeam& seam : bad)
  {
    const bool toLower = rule.ToLower != (rule.InHalves && isInSecond(seam));
    const int receiver = ChooseRank(rank, seam.OtherRank, toLower);
    int& best = receivers.emplace(seam.Triangle, receiver).first->second;
    best = ChooseRank(best, receiver, rule.ToLower);
  }
  std::vector<std::int64_t> toJudge, leaving;
  for (const auto& [triangle, receiver] : receivers)
  {
    std::vector<std::int64_t>& list = receiver == rank ? toJudge : leaving;
    list.push_back(triangle);
  }
  moved = SumOverRanks(group, SizeOf(leaving));

  // Their inner edges become seam edges, on both sides.
  for (const std::int64_t t : leaving)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const PartCorner mate = mesh.FindOpenMate({ t, slot });
      if (mate.Triangle >= 0) // else it is a boundary edge, fixed, or a seam edge
      {
        mesh.SetSeam({ t, slot });
        mesh.SetSeam(mate);
      }
    }
  }
  RecordLists<TravellingTriangle> toRank(group.GetSize());
  auto next = leaving.begin();
  for (const TravellingTriangle& triangle : mesh.Release(leaving))
  {
    toRank[receivers.at(*next++)].push_back(triangle);
  }
  for (const TravellingTriangle& triangle : Join(ExchangeRecords(group, toRank)))
  {
    const std::int64_t t = mesh.Receive(triangle);
    toJudge.push_back(t);
    for (int slot = 0; slot < 3; ++slot)
    {
      if (!mesh.Triangles[t].Has(SeamMark, slot))
      {
        continue;
      }
      const PartCorner mate = mesh.FindMate({ t, slot });
      if (mate.Triangle >= 0) // the edge is an inner edge again
      {
        mesh.ClearSeam({ t, slot });
        mesh.ClearSeam(mate);
      }
    }
  }
  return toJudge;
}

//------------------------------------------------------------------------------
void RoundFlips::Add(std::int64_t triangle)
{
  VisitState& visit = this->Mesh.Triangles[triangle].Visit;
  if (visit != VisitState::Next)
  {
    visit = VisitState::Next;
    this->Next.push_back(triangle);
  }
}

IterationRecord RoundFlips::Iterate()
{
  IterationRecord record;
  const std::vector<std::int64_t> listed = std::exchange(this->Next, {});
  for (const std::int64_t t : listed)
  {
    this->Mesh.Triangles[t].Visit = VisitState::Listed;
  }
  for (std::size_t i = 0; i < listed.size(); ++i)
  {
    constexpr std::size_t PrefetchDistance = 8;
    this->Mesh.PrefetchPoints(listed[std::min(i + PrefetchDistance, listed.size() - 1)]);
    this->Visit(listed[i], record);
  }
  for (const std::int64_t t : listed)
  {
    VisitState& visit = this->Mesh.Triangles[t].Visit;
    if (visit != VisitState::Next)
    {
      visit = VisitState::None;
    }
  }
  record.NonDelaunay = record.Flipped + record.Blocked;
  return record;
}

/// Judges the edges of a triangle but those that have been judged, or will be in the next
/// iteration.
void RoundFlips::Visit(std::int64_t t, IterationRecord& record)
{
  const PartTriangle& triangle = this->Mesh.Triangles[t];
  for (int slot = 0; slot < 3 && triangle.Visit == VisitState::Listed; ++slot)
  {
    const PartCorner one{ t, slot };
    const PartCorner other = this->Mesh.FindOpenMate(one);
    if (other.Triangle < 0 || this->Mesh.Triangles[other.Triangle].Visit >= VisitState::Visited)
    {
      continue;
    }
    const EdgeState state = this->Judge(one, other);
    ++record.Tested;
    record.Blocked += state != EdgeState::Good && state != EdgeState::Bad;
    if (state == EdgeState::Bad)
    {
      const PointPair edge{ triangle.GetStart(slot), triangle.GetEnd(slot) };
      this->Mesh.Flip(one, other);
      this->Add(t);
      this->Add(other.Triangle);
      if (this->NeedsGuard)
      {
        this->AddFreed(edge);
      }
      ++record.Flipped;
    }
  }
  if (triangle.Visit == VisitState::Listed)
  {
    this->Mesh.Triangles[t].Visit = VisitState::Visited;
  }
}

bool RoundFlips::HasBad()
{
  for (const std::int64_t t : this->Next)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const PartCorner other = this->Mesh.FindOpenMate({ t, slot });
      if (other.Triangle >= 0 && this->Judge({ t, slot }, other) == EdgeState::Bad)
      {
        return true;
      }
    }
  }
  return false;
}

EdgeState RoundFlips::Judge(const PartCorner& one, const PartCorner& other) const
{
  const EdgeState state = this->Rule.Judge(this->Mesh, one, other);
  if (!this->NeedsGuard || state != EdgeState::Bad)
  {
    return state;
  }
  const std::int32_t a = this->Mesh.Triangles[one.Triangle].Points[one.Slot];
  const std::int32_t b = this->Mesh.Triangles[other.Triangle].Points[other.Slot];
  if ((this->Mesh.IsShared(a) && this->Mesh.IsShared(b)) || this->Mesh.HasEdge(a, b))
  {
    return EdgeState::BlockedByEdge;
  }
  return state;
}

void RoundFlips::AddFreed(const PointPair& edge)
{
  this->Mesh.GetStars().ForEach(static_cast<std::int32_t>(edge[0]),
    [&](const PartCorner& corner)
    {
      const PartCorner mate = this->Mesh.FindOpenMate(corner);
      if (mate.Triangle >= 0 && this->Mesh.Triangles[mate.Triangle].Points[mate.Slot] == edge[1])
      {
        this->Add(corner.Triangle);
      }
    });
}

}
