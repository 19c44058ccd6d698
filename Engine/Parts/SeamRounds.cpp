// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SeamRounds.h"

#include "Records.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
constexpr std::int64_t HasNone = -1; // of a side that the rank has no longer

RecordLists<SeamTriangle> ListNews(PartMesh& mesh, const PieceGroup& group)
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
  for (const PartCorner& corner : mesh.TakeNewSeams())
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

SeamTest SeamTester::Run(PartMesh& mesh, const QuadJudge& judge, PieceGroup& group)
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

//------------------------------------------------------------------------------
namespace
{
/// The bad seam edges between every two ranks, divided into two halves by their places. In each
/// round either rank gets the triangles of one half, so that usually both have edges to flip.
///
/// Both ranks find the same halves, because they have got the same edges and places.
class SeamHalves
{
public:
  /// @param bad the bad seam edges of this rank.
  explicit SeamHalves(const std::vector<BadSeam>& bad)
  {
    std::unordered_map<int, std::vector<const BadSeam*>> seamsTo;
    for (const BadSeam& seam : bad)
    {
      seamsTo[seam.OtherRank].push_back(&seam);
    }
    for (auto& [rank, seams] : seamsTo)
    {
      this->Cuts.emplace(rank, FindCut(std::move(seams)));
    }
  }

  bool IsInSecond(const BadSeam& seam) const
  {
    const Cut& cut = this->Cuts.at(seam.OtherRank);
    return GetPlace(seam, cut.Axis) >= cut.Median;
  }

private:
  struct Cut
  {
    int Axis; ///< Along which the edges extend most.
    double Median;
  };

  /// A coordinate of the place of an edge; NaN counts as 0, because it has no order.
  static double GetPlace(const BadSeam& seam, int axis)
  {
    return std::isnan(seam.Place[axis]) ? 0.0 : seam.Place[axis];
  }

  /// @param seams the edges to one other rank.
  static Cut FindCut(std::vector<const BadSeam*> seams)
  {
    const auto compare = [](int axis)
    {
      return [axis](const BadSeam* a, const BadSeam* b)
      { return GetPlace(*a, axis) < GetPlace(*b, axis); };
    };
    int longest = 0;
    double most = -1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto [least, greatest] = std::minmax_element(seams.begin(), seams.end(), compare(axis));
      const double extent = GetPlace(**greatest, axis) - GetPlace(**least, axis);
      if (extent > most)
      {
        most = extent;
        longest = axis;
      }
    }
    const auto middle = seams.begin() + static_cast<std::ptrdiff_t>(seams.size() / 2);
    std::nth_element(seams.begin(), middle, seams.end(), compare(longest));
    return { longest, GetPlace(**middle, longest) };
  }

  std::unordered_map<int, Cut> Cuts; ///< By the other rank.
};

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
void MarkSeams(PartMesh& mesh, const std::vector<std::int64_t>& leaving)
{
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
}

/// Clears the seam marks of edges of a triangle that are inner edges again.
void ClearSeams(PartMesh& mesh, std::int64_t t)
{
  for (int slot = 0; slot < 3; ++slot)
  {
    const bool isSeam = mesh.Triangles[t].Has(SeamMark, slot);
    const PartCorner mate = isSeam ? mesh.FindMate({ t, slot }) : PartCorner{ -1, 0 };
    if (mate.Triangle >= 0)
    {
      mesh.ClearSeam({ t, slot });
      mesh.ClearSeam(mate);
    }
  }
}

/// Removes the triangles that leave. @returns them, by their receivers.
RecordLists<TravellingTriangle> TakeAway(
  PartMesh& mesh, const std::vector<Move>& leaving, int ranks)
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
void TakeIn(PartMesh& mesh, const RecordLists<TravellingTriangle>& arriving,
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

std::vector<std::int64_t> MoveTriangles(PartMesh& mesh, const std::vector<BadSeam>& bad,
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

//------------------------------------------------------------------------------
void RoundFlips::Add(std::int64_t triangle)
{
  TriangleStep& step = this->Mesh.Triangles[triangle].Step;
  if (step != TriangleStep::Next)
  {
    step = TriangleStep::Next;
    this->Next.push_back(triangle);
  }
}

IterationRecord RoundFlips::Iterate()
{
  IterationRecord record;
  const std::vector<std::int64_t> listed = std::exchange(this->Next, {});
  for (const std::int64_t t : listed)
  {
    this->Mesh.Triangles[t].Step = TriangleStep::Listed;
  }
  for (std::size_t i = 0; i < listed.size(); ++i)
  {
    constexpr std::size_t PrefetchDistance = 8;
    this->Mesh.PrefetchPoints(listed[std::min(i + PrefetchDistance, listed.size() - 1)]);
    this->Visit(listed[i], record);
  }
  for (const std::int64_t t : listed)
  {
    TriangleStep& step = this->Mesh.Triangles[t].Step;
    step = step == TriangleStep::Next ? step : TriangleStep::None;
  }
  record.NonDelaunay = record.Flipped + record.Blocked;
  return record;
}

/// Judges the edges of a triangle but those that have been judged, or will be in the next
/// iteration.
void RoundFlips::Visit(std::int64_t t, IterationRecord& record)
{
  const PartTriangle& triangle = this->Mesh.Triangles[t];
  for (int slot = 0; slot < 3 && triangle.Step == TriangleStep::Listed; ++slot)
  {
    const PartCorner one{ t, slot };
    const PartCorner other = this->Mesh.FindOpenMate(one);
    if (other.Triangle < 0 || this->Mesh.Triangles[other.Triangle].Step >= TriangleStep::Visited)
    {
      continue;
    }
    const EdgeState state = this->Judge(one, other);
    ++record.Tested;
    record.Blocked += state != EdgeState::Good && state != EdgeState::Bad ? 1 : 0;
    if (state == EdgeState::Bad)
    {
      this->Flip(one, other);
      ++record.Flipped;
    }
  }
  if (triangle.Step == TriangleStep::Listed)
  {
    this->Mesh.Triangles[t].Step = TriangleStep::Visited;
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
  const bool isForbidden = this->NeedsGuard && state == EdgeState::Bad &&
    this->IsForbidden(this->Mesh.Triangles[one.Triangle].Points[one.Slot],
      this->Mesh.Triangles[other.Triangle].Points[other.Slot]);
  return isForbidden ? EdgeState::BlockedByEdge : state;
}

/// Whether the edge between two points exists, or may exist on another rank.
bool RoundFlips::IsForbidden(std::int32_t a, std::int32_t b) const
{
  return (this->Mesh.IsShared(a) && this->Mesh.IsShared(b)) || this->Mesh.HasEdge({ a, b });
}

void RoundFlips::Flip(const PartCorner& one, const PartCorner& other)
{
  const std::int32_t from = this->Mesh.Triangles[one.Triangle].GetStart(one.Slot);
  const std::int32_t to = this->Mesh.Triangles[one.Triangle].GetEnd(one.Slot);
  this->Mesh.Flip(one, other);
  this->Add(one.Triangle);
  this->Add(other.Triangle);
  if (this->NeedsGuard)
  {
    this->AddFreed(from, to);
  }
}

void RoundFlips::AddFreed(std::int32_t from, std::int32_t to)
{
  this->Mesh.ForEachAt(from,
    [&](const PartCorner& corner)
    {
      const PartCorner mate = this->Mesh.FindOpenMate(corner);
      if (mate.Triangle >= 0 && this->Mesh.Triangles[mate.Triangle].Points[mate.Slot] == to)
      {
        this->Add(corner.Triangle);
      }
    });
}

//------------------------------------------------------------------------------
namespace
{
/// An edge to flip, and the edge that this would make.
struct Question
{
  PointPair Ends; ///< Keys, as all here.
  PointPair Opposite;
  bool IsSeam; ///< Between ranks, so that it cannot flip now.
};

/// Triangles at shared points, more than once.
std::vector<std::int64_t> FindTrianglesAtShared(const PartMesh& mesh)
{
  std::vector<std::int64_t> triangles;
  for (const std::int32_t point : mesh.GetSharedPoints())
  {
    mesh.ForEachAt(point, [&](const PartCorner& corner) { triangles.push_back(corner.Triangle); });
  }
  return triangles;
}

/// The inner edges of some triangles whose two opposite points are both shared, in the order of the
/// later of their triangles.
std::vector<InnerQuad> ListWaiting(PartMesh& mesh, std::vector<std::int64_t> triangles)
{
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  std::vector<InnerQuad> quads;
  for (const std::int64_t t : triangles)
  {
    const PartTriangle& triangle = mesh.Triangles[t];
    for (int slot = 0; slot < 3 && !triangle.HasLeft; ++slot)
    {
      const PartCorner corner{ t, slot };
      const PartCorner mate =
        mesh.IsShared(triangle.Points[slot]) ? mesh.FindOpenMate(corner) : PartCorner{ -1, 0 };
      if (mate.Triangle >= 0 && mesh.IsShared(mesh.Triangles[mate.Triangle].Points[mate.Slot]))
      {
        const bool isFirst = t < mate.Triangle;
        quads.push_back({ isFirst ? corner : mate, isFirst ? mate : corner });
      }
    }
  }
  const auto place = [](const InnerQuad& quad)
  { return 3 * quad.Other.Triangle + quad.Other.Slot; };
  std::sort(quads.begin(), quads.end(),
    [&](const InnerQuad& a, const InnerQuad& b) { return place(a) < place(b); });
  quads.erase(std::unique(quads.begin(), quads.end(),
                [&](const InnerQuad& a, const InnerQuad& b) { return place(a) == place(b); }),
    quads.end());
  return quads;
}

/// Those of the waiting edges that are bad and whose flip would not fold the mesh over.
std::vector<InnerQuad> FindBadQuads(
  PartMesh& mesh, const std::vector<std::int64_t>& triangles, const QuadJudge& judge)
{
  std::vector<InnerQuad> quads = ListWaiting(mesh, triangles);
  const auto isGood = [&](const InnerQuad& quad)
  { return judge.Judge(mesh, quad.One, quad.Other) != EdgeState::Bad; };
  quads.erase(std::remove_if(quads.begin(), quads.end(), isGood), quads.end());
  return quads;
}

Question MakeQuestion(const PartMesh& mesh, const InnerQuad& quad)
{
  const PartTriangle& one = mesh.Triangles[quad.One.Triangle];
  const PartTriangle& other = mesh.Triangles[quad.Other.Triangle];
  return { mesh.GetKeys(one.GetEdge(quad.One.Slot)),
    mesh.GetKeys({ one.Points[quad.One.Slot], other.Points[quad.Other.Slot] }), false };
}

/// One flag per question: whether this rank has the edge that the flip would make.
std::vector<unsigned char> FindExisting(
  const PartMesh& mesh, const std::vector<Question>& questions)
{
  std::vector<unsigned char> answers;
  for (const Question& question : questions)
  {
    const std::int64_t a = mesh.FindPoint(question.Opposite[0]);
    const std::int64_t b = mesh.FindPoint(question.Opposite[1]);
    answers.push_back(a >= 0 && b >= 0 && mesh.HasEdge({ a, b }) ? 1 : 0);
  }
  return answers;
}

/// The edges that may be made, and by the flip of which edge: of those that can flip now, or else
/// of the others, the first that asked. All ranks come to the same answers.
PairMap<PointPair> GrantFlips(
  const PartMesh& mesh, const std::vector<Question>& own, PieceGroup& group)
{
  std::vector<Question> all;
  for (const std::vector<Question>& list : GatherRecords(group, own))
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  std::stable_partition(all.begin(), all.end(), [](const Question& one) { return !one.IsSeam; });
  std::vector<unsigned char> exists(all.size());
  for (const std::vector<unsigned char>& answers : GatherRecords(group, FindExisting(mesh, all)))
  {
    std::transform(answers.begin(), answers.end(), exists.begin(), exists.begin(),
      [](unsigned char a, unsigned char b) { return static_cast<unsigned char>(a | b); });
  }
  PairMap<PointPair> granted;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (exists[i] == 0)
    {
      granted.emplace(all[i].Opposite, all[i].Ends);
    }
  }
  return granted;
}

bool IsGranted(const PairMap<PointPair>& granted, const PointPair& ends, const PointPair& opposite)
{
  const auto found = granted.find(opposite);
  return found != granted.end() && found->second == ends;
}

/// Flips the granted ones of some edges, no two of the same triangle.
/// @returns the triangles that have changed.
std::unordered_set<std::int64_t> FlipGranted(PartMesh& mesh, const std::vector<InnerQuad>& quads,
  const PairMap<PointPair>& granted, GuardRound& round)
{
  std::unordered_set<std::int64_t> busy;
  for (const InnerQuad& quad : quads)
  {
    const bool isFree = busy.count(quad.One.Triangle) == 0 && busy.count(quad.Other.Triangle) == 0;
    const Question question = MakeQuestion(mesh, quad);
    if (!isFree || !IsGranted(granted, question.Ends, question.Opposite))
    {
      continue;
    }
    round.Gone.push_back(mesh.Triangles[quad.One.Triangle].GetEdge(quad.One.Slot));
    mesh.Flip(quad.One, quad.Other);
    ++round.Flipped;
    for (const std::int64_t t : { quad.One.Triangle, quad.Other.Triangle })
    {
      busy.insert(t);
      round.Changed.push_back(t);
    }
  }
  return busy;
}
}

void WaitingEdges::Find(PartMesh& mesh, const QuadJudge& judge)
{
  const std::vector<std::int64_t> changed = mesh.TakeChanged();
  this->Triangles.insert(this->Triangles.end(), changed.begin(), changed.end());
  this->Bad =
    FindBadQuads(mesh, this->IsFirst ? FindTrianglesAtShared(mesh) : this->Triangles, judge);
  this->IsFirst = false;
  this->Triangles.clear();
  for (const InnerQuad& quad : this->Bad)
  {
    this->Triangles.insert(this->Triangles.end(), { quad.One.Triangle, quad.Other.Triangle });
  }
}

GuardRound WaitingEdges::Flip(
  PartMesh& mesh, const QuadJudge& judge, SeamTest& test, PieceGroup& group, bool mayFlip)
{
  DoTogether(group, [&]() { this->Find(mesh, judge); });
  std::vector<Question> questions;
  for (const InnerQuad& quad : this->Bad)
  {
    questions.push_back(MakeQuestion(mesh, quad));
  }
  for (const BadSeam& seam : test.Bad)
  {
    questions.push_back({ seam.Ends, seam.Opposite, true });
  }
  const PairMap<PointPair> granted = GrantFlips(mesh, questions, group);
  GuardRound round;
  round.FreeOfAll = static_cast<std::int64_t>(granted.size());
  if (!mayFlip)
  {
    return round;
  }
  const std::unordered_set<std::int64_t> changed = FlipGranted(mesh, this->Bad, granted, round);
  // A changed triangle may have lost its bad edge to its neighbour; the next round will tell.
  const auto mustStay = [&](const BadSeam& seam)
  { return changed.count(seam.Triangle) > 0 || !IsGranted(granted, seam.Ends, seam.Opposite); };
  test.Bad.erase(std::remove_if(test.Bad.begin(), test.Bad.end(), mustStay), test.Bad.end());
  return round;
}

}
