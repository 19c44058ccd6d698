// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointMatching.h"

#include "Atomics.h"
#include "PartMesh.h"
#include "PlanarSurvey.h"

#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace delaunayflip
{

namespace
{
/// The place of a point: its global number, or the bits of its three coordinates. Points of
/// different ranks can be the same point only if their places are equal.
using Place = std::array<std::uint64_t, 3>;

std::uint64_t GetHash(const Place& place)
{
  return ScatterBits(place[0] + ScatterBits(place[1] + ScatterBits(place[2])));
}

bool Holds(const BoundingBox& box, const double (&x)[3])
{
  bool holds = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    holds = holds && box.Lower[axis] <= x[axis] && x[axis] <= box.Upper[axis];
  }
  return holds;
}

/// A point of one rank that another may have, too.
struct Candidate
{
  Place At;
  std::int64_t Key; ///< Its key if it is not shared.
  std::int32_t Rank;
  bool IsUnused; ///< It has no triangles.
  bool IsInside; ///< It has no number and is not at the border of its part.
};

/// The points of a part, and how its triangles surround them.
class PartPoints
{
public:
  /// @param haveNumbers whether all parts that have points give numbers.
  PartPoints(const MeshPiece& piece, bool haveNumbers, const ThreadBackend& threads)
    : Mesh(piece.Mesh),
      Used(Mesh.Points.Count, 0),
      Numbers(haveNumbers ? piece.PointNumbers : nullptr),
      Fans(threads.MakeArray<std::uint64_t>(Mesh.Points.Count))
  {
    threads.ForEach(this->Mesh.Points.Count, [&](std::int64_t i) { this->Fans[i] = 0; });
    threads.ForEach(this->Mesh.Triangles.Count,
      [&](std::int64_t t)
      {
        std::int64_t ids[3];
        std::uint64_t bits[3];
        for (int slot = 0; slot < 3; ++slot)
        {
          ids[slot] = this->Mesh.Triangles.Get(t, slot);
          bits[slot] = ScatterBits(ids[slot]);
        }
        for (int slot = 0; slot < 3; ++slot)
        {
          // Around a closed fan every neighbour is once the next one and once the previous one.
          __atomic_fetch_add(
            &this->Fans[ids[slot]], bits[(slot + 1) % 3] - bits[(slot + 2) % 3], __ATOMIC_RELAXED);
          AtomicStore<unsigned char>(&this->Used[ids[slot]], 1);
        }
      });
    for (std::int64_t i = 0; i < 2 * this->Mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t end = this->Mesh.ConstraintEdges[i];
      if (this->Used[end] == 0)
      {
        this->Fans[end] = 1;
      }
    }
  }

  /// Whether the triangles of a point form a closed fan.
  bool IsClosed(std::int64_t point) const
  {
    return this->Used[point] != 0 && this->Fans[point] == 0;
  }
  /// Whether a point is at the border of the part: its triangles do not form a closed fan, or it
  /// has none and is the end of a constraint. This is also true where triangles are not wound
  /// consistently.
  bool IsAtBorder(std::int64_t point) const { return this->Fans[point] != 0; }
  /// Whether a point must be matched with points of other ranks: a triangle has it, or it is the
  /// end of a constraint.
  bool IsWanted(std::int64_t point) const
  {
    return this->Used[point] != 0 || this->IsAtBorder(point);
  }

  /// Whether another rank must be asked for a point: it is at the border, or points have numbers.
  bool IsToAsk(std::int64_t point) const
  {
    if (this->Numbers)
    {
      return this->IsWanted(point);
    }
    return this->IsAtBorder(point);
  }

  /// @returns whether the coordinates are numbers.
  bool GetPosition(std::int64_t point, double (&x)[3]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = this->Mesh.Points.Get(point, axis) + 0.0; // -0 becomes 0
    }
    return !std::isnan(x[0]) && !std::isnan(x[1]) && !std::isnan(x[2]);
  }
  /// @returns whether a point has a place: a number, or coordinates without NaN.
  bool FindPlace(std::int64_t point, Place& place) const
  {
    if (this->Numbers)
    {
      place = { static_cast<std::uint64_t>(this->Numbers[point]), 0, 0 };
      return true;
    }
    double x[3];
    const bool isPlace = this->GetPosition(point, x);
    std::memcpy(place.data(), x, sizeof(x));
    return isPlace;
  }

  /// Calls add(candidate) for the wanted points for which isAsked(place) is true or that are at the
  /// border.
  /// @param firstKey the first key of the part.
  template <typename IsAsked, typename Add>
  void List(std::int64_t firstKey, int rank, const IsAsked& isAsked, const Add& add) const
  {
    for (std::int64_t i = 0; i < this->Mesh.Points.Count; ++i)
    {
      Place place{};
      if (this->IsWanted(i) && this->FindPlace(i, place) && (this->IsAtBorder(i) || isAsked(place)))
      {
        const bool isInside = !this->Numbers && !this->IsAtBorder(i);
        add({ place, firstKey + i, rank, this->Used[i] == 0, isInside });
      }
    }
  }

  const TriangleMesh& Mesh;
  std::vector<unsigned char> Used; ///< One flag per point: whether a triangle has it.

private:
  const std::int64_t* Numbers; ///< One per point, or null.
  /// One number per point: 0 if its triangles form a closed fan, or closed fans, or it has none and
  /// is not the end of a constraint.
  Array<std::uint64_t> Fans;
};

/// Calls visit(same) for the candidates at each place, if several ranks have it and one of them is
/// not inside its part: first those with triangles, then the others; each group by key, hence by
/// rank.
/// @returns how many are not visited because a rank has several at one place.
template <typename Visit>
std::int64_t ForEachShared(std::vector<Candidate> all, const Visit& visit)
{
  const auto order = [](const Candidate& a) { return std::tie(a.At, a.IsUnused, a.Key); };
  std::sort(all.begin(), all.end(),
    [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
  std::int64_t ambiguous = 0;
  const auto join = [&](const Candidate* begin, const Candidate* end)
  {
    // Only one point without triangles counts per rank, and none if it has one with triangles.
    std::vector<Candidate> list;
    bool isRepeated = false;
    for (const Candidate* one = begin; one != end; ++one)
    {
      const bool isKnown = std::any_of(
        list.begin(), list.end(), [=](const Candidate& other) { return other.Rank == one->Rank; });
      if (!one->IsUnused || !isKnown)
      {
        list.push_back(*one);
        isRepeated = isRepeated || isKnown;
      }
    }
    if (list.front().Rank == list.back().Rank ||
      std::all_of(list.begin(), list.end(), [](const Candidate& one) { return one.IsInside; }))
    {
      return;
    }
    if (isRepeated)
    {
      ambiguous += SizeOf(list);
      return;
    }
    visit(list);
  };
  ForEachRun(
    all, [](const Candidate& a, const Candidate& b) { return a.At == b.At; }, join);
  return ambiguous;
}

/// Asks other ranks whether they have a point of this one, if it is in their box. It is a border
/// point, or any point if points have numbers. It may be inside their part: where three sheets of a
/// non-manifold mesh meet, two may be on one rank. Sheets that lie on each other may also have the
/// same points.
/// @returns the hashes of the places, for each rank.
RecordLists<std::uint64_t> AskForPoints(const PartPoints& points, PieceGroup& group)
{
  if (group.GetSize() == 1)
  {
    return RecordLists<std::uint64_t>(1); // without a pass over all points
  }
  BoundingBox used;
  double x[3];
  for (std::int64_t i = 0; i < points.Mesh.Points.Count; ++i)
  {
    points.GetPosition(i, x);
    for (int axis = 0; axis < 3 && points.Used[i] != 0; ++axis)
    {
      used.Include(axis, x[axis], x[axis]);
    }
  }
  const RecordLists<BoundingBox> boxes = GatherRecords(group, std::vector<BoundingBox>{ used });
  RecordLists<std::uint64_t> questions(boxes.size());
  for (std::int64_t i = 0; i < points.Mesh.Points.Count; ++i)
  {
    Place place{};
    if (!points.IsToAsk(i) || !points.FindPlace(i, place))
    {
      continue;
    }
    const bool isSomewhere = points.GetPosition(i, x);
    for (int rank = 0; rank < group.GetSize(); ++rank)
    {
      if (rank != group.GetRank() && (!isSomewhere || Holds(boxes[rank].front(), x)))
      {
        questions[rank].push_back(GetHash(place));
      }
    }
  }
  return questions;
}
}

PointKeys MatchPoints(const MeshPiece& piece, PieceGroup& group, const ThreadBackend& threads)
{
  const std::int64_t count = piece.Mesh.Points.Count;
  const bool lacksNumbers = !piece.PointNumbers && count > 0;
  PartPoints points(piece, !IsOnAnyRank(group, lacksNumbers), threads);
  PointKeys keys;
  keys.Owners = RankNumbers(count, group);
  const std::int64_t first = keys.Owners.Firsts[group.GetRank()];
  std::vector<std::uint64_t> asked = Join(ExchangeRecords(group, AskForPoints(points, group)));
  std::sort(asked.begin(), asked.end());
  RecordLists<Candidate> toHome(group.GetSize());
  points.List(
    first, group.GetRank(), // another place with the same hash is only sent in vain
    [&](const Place& place)
    { return std::binary_search(asked.begin(), asked.end(), GetHash(place)); },
    [&](const Candidate& one) { toHome[GetHome(GetHash(one.At), group)].push_back(one); });
  // Now this rank is the home of places. An answer is the key that the rank has sent, and that of
  // the owner.
  RecordLists<PointPair> answers(group.GetSize());
  keys.UsedPoints = std::count(points.Used.begin(), points.Used.end(), 1);
  keys.Ambiguous = ForEachShared(Join(ExchangeRecords(group, toHome)),
    [&](const std::vector<Candidate>& same)
    {
      const Candidate& owner = same.front();
      for (const Candidate& one : same)
      {
        const bool isRepeated = one.Key != owner.Key;
        if (!owner.IsUnused)
        {
          keys.Repeated += isRepeated;
          keys.UsedPoints -= isRepeated && !one.IsUnused;
          answers[one.Rank].push_back({ one.Key, owner.Key });
        }
      }
    });
  keys.Keys.resize(count);
  keys.Shared.resize(count);
  keys.Closed.resize(count);
  for (std::int64_t i = 0; i < count; ++i)
  {
    keys.Keys[i] = first + i;
    keys.Closed[i] = points.IsClosed(i);
  }
  for (const auto& [own, key] : Join(ExchangeRecords(group, answers)))
  {
    keys.Keys[own - first] = key;
    keys.Shared[own - first] = 1;
    keys.Closed[own - first] = 0;
  }
  for (std::int64_t* sum : { &keys.Repeated, &keys.UsedPoints, &keys.Ambiguous })
  {
    *sum = SumOverRanks(group, *sum);
  }
  keys.Used = std::move(points.Used);
  return keys;
}

JoinedPoints JoinPoints(const std::vector<MeshPiece>& pieces)
{
  const bool haveNumbers = std::all_of(pieces.begin(), pieces.end(),
    [](const MeshPiece& piece) { return piece.PointNumbers || piece.Mesh.Points.Count == 0; });
  const ThreadBackend threads(1);
  JoinedPoints joined;
  std::vector<Candidate> all;
  for (std::size_t number = 0; number < pieces.size(); ++number)
  {
    const auto first = SizeOf(joined.Same);
    PartPoints(pieces[number], haveNumbers, threads)
      .List(
        first, static_cast<int>(number), [](const Place&) { return true; },
        [&](const Candidate& one) { all.push_back(one); });
    joined.Same.resize(joined.Same.size() + pieces[number].Mesh.Points.Count);
    std::iota(joined.Same.begin() + first, joined.Same.end(), first);
  }
  joined.Ambiguous = ForEachShared(std::move(all),
    [&](const std::vector<Candidate>& same)
    {
      std::int64_t least = same.front().Key;
      for (const Candidate& one : same)
      {
        least = std::min(least, one.Key);
      }
      for (const Candidate& one : same)
      {
        joined.Same[one.Key] = least;
      }
    });
  return joined;
}

}
