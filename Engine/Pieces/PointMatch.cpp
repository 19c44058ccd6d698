// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointMatch.h"

#include "FlipError.h"
#include "Records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <unordered_set>

namespace delaunayflip
{

namespace
{
/// What makes two points the same: a number, or the bits of three coordinates.
using Place = std::array<std::uint64_t, 3>;

struct PlaceHash
{
  std::size_t operator()(const Place& place) const
  {
    return ScatterBits(place[0] + ScatterBits(place[1] + ScatterBits(place[2])));
  }
};
using PlaceSet = std::unordered_set<Place, PlaceHash>; // never iterated over: its order varies

struct Box
{
  double Lower[3], Upper[3];

  bool Holds(const double (&x)[3]) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && this->Lower[axis] <= x[axis] && x[axis] <= this->Upper[axis];
    }
    return holds;
  }
};

/// A point that a rank and another one may have.
struct Candidate
{
  Place At;
  std::int64_t Key; ///< The one it has if it is not shared.
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

/// Finds the candidates of one rank.
class PlaceFinder
{
public:
  explicit PlaceFinder(const MeshPiece& piece)
    : Piece(piece),
      Fans(piece.Mesh.Points.Count, 0),
      Used(piece.Mesh.Points.Count, 0),
      Ends(piece.Mesh.Points.Count, 0)
  {
    for (std::int64_t t = 0; t < piece.Mesh.Triangles.Count; ++t)
    {
      this->NoteTriangle(t);
    }
    for (std::int64_t i = 0; i < 2 * piece.Mesh.NumberOfConstraintEdges; ++i)
    {
      this->Ends[piece.Mesh.ConstraintEdges[i]] = 1;
    }
  }

  bool IsUsed(std::int64_t point) const { return this->Used[point] != 0; }
  /// Whether it matters that other ranks have the point, too.
  bool IsWanted(std::int64_t point) const
  {
    return this->Used[point] != 0 || this->Ends[point] != 0;
  }

  /// Whether the triangles around a point do not close around it, so that it is at the border of
  /// the piece. Also true where they are wound in different ways.
  bool IsAtBorder(std::int64_t point) const
  {
    return this->Fans[point] != 0 || (!this->IsUsed(point) && this->IsWanted(point));
  }

  std::int64_t CountUsed() const
  {
    return std::count(this->Used.begin(), this->Used.end(), static_cast<unsigned char>(1));
  }

  /// One flag per point: whether it is used and not at the border.
  std::vector<unsigned char> FindClosed() const
  {
    std::vector<unsigned char> closed(this->Used.size());
    for (std::size_t i = 0; i < closed.size(); ++i)
    {
      closed[i] = this->Used[i] != 0 && this->Fans[i] == 0 ? 1 : 0;
    }
    return closed;
  }

  /// @returns whether the point has a place: no coordinate is NaN.
  bool FindPlace(std::int64_t point, Place& place) const
  {
    if (this->Piece.PointNumbers)
    {
      place = { static_cast<std::uint64_t>(this->Piece.PointNumbers[point]), 0, 0 };
      return true;
    }
    bool isPlace = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = this->Piece.Mesh.Points.Get(point, axis) + 0.0; // -0 becomes 0
      isPlace = isPlace && !std::isnan(x);
      std::memcpy(&place[axis], &x, sizeof(x));
    }
    return isPlace;
  }

  /// Of the used points; upside down if there are none.
  Box FindBox() const
  {
    constexpr double Inf = std::numeric_limits<double>::infinity();
    Box box{ { Inf, Inf, Inf }, { -Inf, -Inf, -Inf } };
    for (std::int64_t i = 0; i < this->Piece.Mesh.Points.Count; ++i)
    {
      for (int axis = 0; axis < 3 && this->IsUsed(i); ++axis)
      {
        const double x = this->Piece.Mesh.Points.Get(i, axis);
        box.Lower[axis] = std::min(box.Lower[axis], x);
        box.Upper[axis] = std::max(box.Upper[axis], x);
      }
    }
    return box;
  }

  /// Whether the point may be in the box: it is, or a coordinate is NaN.
  bool MayBeIn(const Box& box, std::int64_t point) const
  {
    const PointArray& points = this->Piece.Mesh.Points;
    const double x[3] = { points.Get(point, 0), points.Get(point, 1), points.Get(point, 2) };
    return box.Holds(x) || std::isnan(x[0]) || std::isnan(x[1]) || std::isnan(x[2]);
  }

private:
  void NoteTriangle(std::int64_t t)
  {
    const TriangleArray& triangles = this->Piece.Mesh.Triangles;
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t p = triangles.Get(t, slot);
      this->Used[p] = 1;
      // Around a closed fan every neighbour is the next one once, and once the previous one.
      this->Fans[p] += ScatterBits(triangles.Get(t, (slot + 1) % 3));
      this->Fans[p] -= ScatterBits(triangles.Get(t, (slot + 2) % 3));
    }
  }

  const MeshPiece& Piece;
  std::vector<std::uint64_t> Fans;
  std::vector<unsigned char> Used;
  std::vector<unsigned char> Ends; ///< Of constraints.
};

/// Asks the ranks whose bounding box holds a border point of this one whether they have it, too.
/// It may be inside their piece: where three sheets of a non-manifold mesh meet, two may be on one
/// rank. @returns the places that were asked for by others.
PlaceSet AskForPlaces(const MeshPiece& piece, const PlaceFinder& finder, PieceGroup& group)
{
  const RecordLists<Box> boxes = GatherRecords(group, std::vector<Box>{ finder.FindBox() });
  RecordLists<Place> questions(group.GetSize());
  for (std::int64_t i = 0; i < piece.Mesh.Points.Count; ++i)
  {
    Place place{};
    if (!finder.IsAtBorder(i) || !finder.FindPlace(i, place))
    {
      continue;
    }
    for (int rank = 0; rank < group.GetSize(); ++rank)
    {
      if (rank != group.GetRank() && finder.MayBeIn(boxes[rank].front(), i))
      {
        questions[rank].push_back(place);
      }
    }
  }
  PlaceSet places;
  for (const std::vector<Place>& list : ExchangeRecords(group, questions))
  {
    places.insert(list.begin(), list.end());
  }
  return places;
}

RecordLists<Candidate> ListCandidates(const MeshPiece& piece, const PlaceFinder& finder,
  const PlaceSet& asked, std::int64_t firstKey, const PieceGroup& group)
{
  RecordLists<Candidate> toHome(group.GetSize());
  for (std::int64_t i = 0; i < piece.Mesh.Points.Count; ++i)
  {
    Place place{};
    const bool isCandidate = finder.IsWanted(i) && finder.FindPlace(i, place) &&
      (finder.IsAtBorder(i) || asked.count(place) > 0);
    if (isCandidate)
    {
      toHome[GetHome(PlaceHash()(place), group)].push_back(
        { place, firstKey + i, finder.IsUsed(i) ? 0 : 1 });
    }
  }
  return toHome;
}

struct RankedCandidate
{
  Candidate Point;
  int Rank;
};

/// The candidates of one place. Of points without triangles only one of a rank counts, and none if
/// the rank has others.
/// @param begin, end those with triangles first, both by key and so by rank.
std::vector<RankedCandidate> ListOfRanks(const RankedCandidate* begin, const RankedCandidate* end)
{
  std::vector<RankedCandidate> list;
  for (const RankedCandidate* one = begin; one != end; ++one)
  {
    const bool isKnown = std::any_of(list.begin(), list.end(),
      [=](const RankedCandidate& other) { return other.Rank == one->Rank; });
    if (one->Point.IsUnused == 0 || !isKnown)
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
  if (list.front().Point.IsUnused != 0 || list.front().Rank == list.back().Rank)
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
    [](const RankedCandidate& one) { return one.Point.IsUnused == 0; });
  for (const RankedCandidate& one : list)
  {
    answers[one.Rank].push_back({ one.Point.Key, list.front().Point.Key });
  }
}

/// @returns what each rank must know about its candidates that are shared.
RecordLists<SharedPoint> JoinCandidates(const RecordLists<Candidate>& lists, MatchCounts& counts)
{
  std::vector<RankedCandidate> all;
  for (std::size_t rank = 0; rank < lists.size(); ++rank)
  {
    for (const Candidate& candidate : lists[rank])
    {
      all.push_back({ candidate, static_cast<int>(rank) });
    }
  }
  const auto order = [](const RankedCandidate& a)
  { return std::tie(a.Point.At, a.Point.IsUnused, a.Point.Key); };
  std::sort(all.begin(), all.end(),
    [&](const RankedCandidate& a, const RankedCandidate& b) { return order(a) < order(b); });
  RecordLists<SharedPoint> answers(lists.size());
  for (std::size_t begin = 0; begin < all.size();)
  {
    std::size_t end = begin + 1;
    while (end < all.size() && all[end].Point.At == all[begin].Point.At)
    {
      ++end;
    }
    JoinPlace(ListOfRanks(all.data() + begin, all.data() + end), answers, counts);
    begin = end;
  }
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

/// Without numbers on one of the ranks that have points, nobody's numbers mean anything.
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
  const PlaceSet asked = AskForPlaces(piece, finder, group);
  const RecordLists<Candidate> candidates =
    ExchangeRecords(group, ListCandidates(piece, finder, asked, firstKey, group));
  MatchCounts counts;
  counts.Used = finder.CountUsed();
  const RecordLists<SharedPoint> answers =
    ExchangeRecords(group, JoinCandidates(candidates, counts));
  keys.Closed = finder.FindClosed();
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
