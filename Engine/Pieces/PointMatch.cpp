// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointMatch.h"

#include "PlaceFinder.h"
#include "Records.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace delaunayflip
{

namespace
{
/// A point of one rank that another may have, too.
struct Candidate
{
  Place At;
  std::int64_t Key; ///< Its key if it is not shared.
  std::int64_t IsUnused; ///< 0 or 1.
};

struct SharedPoint
{
  std::int64_t Own; ///< The key that the rank sent.
  std::int64_t Key;
};

struct MatchCounts
{
  std::int64_t Used = 0, Repeated = 0, Ambiguous = 0;

  MatchCounts& operator+=(const MatchCounts& part)
  {
    this->Used += part.Used;
    this->Repeated += part.Repeated;
    this->Ambiguous += part.Ambiguous;
    return *this;
  }
};

std::vector<Box> GatherBoxes(const PlaceFinder& finder, PieceGroup& group)
{
  std::vector<Box> boxes;
  for (const std::vector<Box>& box : GatherRecords(group, std::vector<Box>{ finder.FindBox() }))
  {
    boxes.push_back(box.front());
  }
  return boxes;
}

/// Chooses the points of a rank that others may have, too.
class CandidateFinder
{
public:
  CandidateFinder(const MeshPiece& piece, const PlaceFinder& finder, PieceGroup& group)
    : Piece(piece),
      Finder(finder),
      Group(group),
      Boxes(GatherBoxes(finder, group), group.GetRank()),
      Asked(ExchangeRecords(group, this->AskForPlaces()))
  {
    const RecordLists<std::int64_t> near = this->ListNear();
    RecordLists<std::uint64_t> filters(group.GetSize());
    for (std::size_t rank = 0; rank < near.size(); ++rank)
    {
      filters[rank] = this->MakeFilter(near[rank]).GetWords();
    }
    filters = ExchangeRecords(group, filters);
    for (std::size_t rank = 0; rank < near.size(); ++rank)
    {
      this->NoteHits(near[rank], PlaceFilter(std::move(filters[rank])));
    }
  }

  RecordLists<Candidate> List(std::int64_t firstKey) const
  {
    RecordLists<Candidate> toHome(this->Group.GetSize());
    for (std::int64_t i = 0; i < this->Piece.Mesh.Points.Count; ++i)
    {
      Place place{};
      if (this->Finder.IsWanted(i) && this->Finder.FindPlace(i, place) &&
        this->MayBeShared(i, place))
      {
        toHome[GetHome(PlaceHash()(place), this->Group)].push_back(
          { place, firstKey + i, this->Finder.IsUsed(i) ? 0 : 1 });
      }
    }
    return toHome;
  }

private:
  /// Asks the ranks whose bounding box holds a border point of this one whether they have it, too.
  /// It may be inside their piece: where three sheets of a non-manifold mesh meet, two may be on
  /// one rank.
  RecordLists<Place> AskForPlaces() const
  {
    RecordLists<Place> questions(this->Group.GetSize());
    for (std::int64_t i = 0; i < this->Piece.Mesh.Points.Count; ++i)
    {
      Place place{};
      if (this->Finder.IsAtBorder(i) && this->Finder.FindPlace(i, place))
      {
        this->Finder.ForEachNear(
          i, this->Boxes, [&](int rank) { questions[rank].push_back(place); });
      }
    }
    return questions;
  }

  /// If points have numbers, those that lie in the bounding boxes of other ranks.
  RecordLists<std::int64_t> ListNear() const
  {
    RecordLists<std::int64_t> near(this->Group.GetSize());
    for (std::int64_t i = 0; this->Piece.PointNumbers && i < this->Piece.Mesh.Points.Count; ++i)
    {
      if (this->Finder.IsWanted(i))
      {
        this->Finder.ForEachNear(i, this->Boxes, [&](int rank) { near[rank].push_back(i); });
      }
    }
    return near;
  }

  PlaceFilter MakeFilter(const std::vector<std::int64_t>& points) const
  {
    PlaceFilter filter(points.size());
    for (const std::int64_t i : points)
    {
      Place place{};
      this->Finder.FindPlace(i, place);
      filter.Add(place);
    }
    return filter;
  }

  /// Notes the points that another rank may have, too, by their numbers. So points that are inside
  /// both pieces, where sheets lie on each other, are also found.
  /// @param filter of the points of another rank.
  void NoteHits(const std::vector<std::int64_t>& points, const PlaceFilter& filter)
  {
    for (const std::int64_t i : points)
    {
      Place place{};
      this->Finder.FindPlace(i, place);
      if (filter.MayHave(place))
      {
        this->Hits.resize(this->Piece.Mesh.Points.Count);
        this->Hits[i] = 1;
      }
    }
  }

  bool MayBeShared(std::int64_t point, const Place& place) const
  {
    return this->Finder.IsAtBorder(point) || (!this->Hits.empty() && this->Hits[point] != 0) ||
      this->Asked.Has(place);
  }

  const MeshPiece& Piece;
  const PlaceFinder& Finder;
  PieceGroup& Group;
  NearBoxes Boxes;
  PlaceSet Asked; ///< The places that others have asked for.
  /// One flag per point, or none: whether another rank may have a point with the same number.
  std::vector<unsigned char> Hits;
};

using RankedCandidate = RankedRecord<Candidate>;

/// The candidates of one place. Of points without triangles only one of a rank counts, and none if
/// the rank has one with triangles.
/// @param begin, end first those with triangles, then the others; each group by key, hence by rank.
std::vector<RankedCandidate> ListOfRanks(const RankedCandidate* begin, const RankedCandidate* end)
{
  std::vector<RankedCandidate> list;
  for (const RankedCandidate* one = begin; one != end; ++one)
  {
    const bool isKnown = std::any_of(list.begin(), list.end(),
      [=](const RankedCandidate& other) { return other.Rank == one->Rank; });
    if (one->Value.IsUnused == 0 || !isKnown)
    {
      list.push_back(*one);
    }
  }
  return list;
}

/// Answers the candidates of one place.
/// @param list by ListOfRanks.
void JoinPlace(
  const std::vector<RankedCandidate>& list, RecordLists<SharedPoint>& answers, MatchCounts& counts)
{
  const auto isSameRank = [](const RankedCandidate& a, const RankedCandidate& b)
  { return a.Rank == b.Rank; };
  if (list.front().Value.IsUnused != 0 || list.front().Rank == list.back().Rank)
  {
    return;
  }
  const auto size = static_cast<std::int64_t>(list.size());
  if (std::adjacent_find(list.begin(), list.end(), isSameRank) != list.end())
  {
    counts.Ambiguous += size;
    return;
  }
  counts.Repeated += size - 1;
  counts.Used -= std::count_if(list.begin() + 1, list.end(),
    [](const RankedCandidate& one) { return one.Value.IsUnused == 0; });
  for (const RankedCandidate& one : list)
  {
    answers[one.Rank].push_back({ one.Value.Key, list.front().Value.Key });
  }
}

/// @returns what each rank must know about its candidates that are shared.
RecordLists<SharedPoint> JoinCandidates(const RecordLists<Candidate>& lists, MatchCounts& counts)
{
  std::vector<RankedCandidate> all = JoinLists(lists);
  const auto order = [](const RankedCandidate& a)
  { return std::tie(a.Value.At, a.Value.IsUnused, a.Value.Key); };
  std::sort(all.begin(), all.end(),
    [&](const RankedCandidate& a, const RankedCandidate& b) { return order(a) < order(b); });
  RecordLists<SharedPoint> answers(lists.size());
  ForEachRun(
    all,
    [](const RankedCandidate& a, const RankedCandidate& b) { return a.Value.At == b.Value.At; },
    [&](const RankedCandidate* begin, const RankedCandidate* end)
    { JoinPlace(ListOfRanks(begin, end), answers, counts); });
  return answers;
}

PointKeys NumberPoints(const MeshPiece& piece, PieceGroup& group)
{
  PointKeys keys;
  const RecordLists<std::int64_t> counts =
    GatherRecords(group, std::vector<std::int64_t>{ piece.Mesh.Points.Count });
  keys.FirstKeys.push_back(0);
  for (const std::vector<std::int64_t>& count : counts)
  {
    keys.FirstKeys.push_back(keys.FirstKeys.back() + count.front());
  }
  keys.Keys.resize(piece.Mesh.Points.Count);
  keys.Shared.resize(piece.Mesh.Points.Count);
  for (std::int64_t i = 0; i < piece.Mesh.Points.Count; ++i)
  {
    keys.Keys[i] = keys.FirstKeys[group.GetRank()] + i;
  }
  return keys;
}

/// Numbers are used only if every rank that has points gives them.
bool HaveNumbers(const MeshPiece& piece, PieceGroup& group)
{
  const bool lacksThem = !piece.PointNumbers && piece.Mesh.Points.Count > 0;
  return SumOverRanks(group, std::int64_t(lacksThem ? 1 : 0)) == 0;
}
}

PieceOrigin PointKeys::FindOrigin(std::int64_t key) const
{
  const auto after = std::upper_bound(this->FirstKeys.begin(), this->FirstKeys.end(), key);
  const auto rank = static_cast<std::int32_t>(after - this->FirstKeys.begin() - 1);
  return { rank, key - this->FirstKeys[rank] };
}

PointKeys MatchPoints(const MeshPiece& given, PieceGroup& group)
{
  PointKeys keys = NumberPoints(given, group);
  MeshPiece piece = given;
  piece.PointNumbers = HaveNumbers(given, group) ? given.PointNumbers : nullptr;
  const std::int64_t firstKey = keys.FirstKeys[group.GetRank()];
  const PlaceFinder finder(piece);
  const CandidateFinder chosen(piece, finder, group);
  const RecordLists<Candidate> candidates = ExchangeRecords(group, chosen.List(firstKey));
  MatchCounts counts;
  counts.Used = finder.CountUsed();
  const RecordLists<SharedPoint> answers =
    ExchangeRecords(group, JoinCandidates(candidates, counts));
  keys.Closed = finder.FindClosed();
  keys.Used = finder.GetUsed();
  for (const std::vector<SharedPoint>& list : answers)
  {
    for (const SharedPoint& point : list)
    {
      keys.Keys[point.Own - firstKey] = point.Key;
      keys.Shared[point.Own - firstKey] = 1;
      keys.Closed[point.Own - firstKey] = 0;
    }
  }
  counts = SumOverRanks(group, counts);
  keys.Repeated = counts.Repeated;
  keys.UsedPoints = counts.Used;
  keys.Ambiguous = counts.Ambiguous;
  return keys;
}

}
