// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PartSurvey.h"
#include "Records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

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

/// If it holds no point, Lower exceeds Upper.
struct Box
{
  static constexpr double Inf = std::numeric_limits<double>::infinity();
  double Lower[3] = { Inf, Inf, Inf }, Upper[3] = { -Inf, -Inf, -Inf };

  void Add(const double (&x)[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = std::min(this->Lower[axis], x[axis]);
      this->Upper[axis] = std::max(this->Upper[axis], x[axis]);
    }
  }
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

/// A point of one rank that another may have, too.
struct Candidate
{
  Place At;
  std::int64_t Key; ///< Its key if it is not shared.
  std::int32_t Rank;
  std::int32_t IsUnused; ///< 0 or 1.
};

struct SharedPoint
{
  std::int64_t Own; ///< The key that the rank sent.
  std::int64_t Key;
};

class PointMatcher
{
public:
  PointMatcher(const MeshPiece& piece, PieceGroup& group)
    : Mesh(piece.Mesh),
      Group(group),
      Ends(Mesh.Points.Count, 0)
  {
    // Numbers are used only if every rank that has points gives them.
    const bool lacksThem = !piece.PointNumbers && this->Mesh.Points.Count > 0;
    const bool haveNumbers = SumOverRanks(group, std::int64_t(lacksThem ? 1 : 0)) == 0;
    this->Numbers = haveNumbers ? piece.PointNumbers : nullptr;
    this->Keys.Used.resize(this->Mesh.Points.Count);
    this->Fans = SumFans(this->Mesh, this->Threads, this->Keys.Used.data());
    for (std::int64_t i = 0; i < 2 * this->Mesh.NumberOfConstraintEdges; ++i)
    {
      this->Ends[this->Mesh.ConstraintEdges[i]] = 1;
    }
  }

  PointKeys Run()
  {
    PointKeys& keys = this->Keys;
    const std::int64_t count = this->Mesh.Points.Count;
    keys.Owners = RankNumbers(count, this->Group);
    const std::int64_t first = keys.Owners.Firsts[this->Group.GetRank()];
    std::vector<std::uint64_t> asked = Join(ExchangeRecords(this->Group, this->Ask()));
    std::sort(asked.begin(), asked.end());
    const RecordLists<Candidate> candidates =
      ExchangeRecords(this->Group, this->List(first, asked));
    keys.UsedPoints = std::count(keys.Used.begin(), keys.Used.end(), 1);
    const RecordLists<SharedPoint> answers =
      ExchangeRecords(this->Group, this->JoinCandidates(Join(candidates)));
    keys.Keys.resize(count);
    keys.Shared.resize(count);
    keys.Closed.resize(count);
    for (std::int64_t i = 0; i < count; ++i)
    {
      keys.Keys[i] = first + i;
      keys.Closed[i] = keys.Used[i] != 0 && this->Fans[i] == 0 ? 1 : 0;
    }
    for (const SharedPoint& point : Join(answers))
    {
      keys.Keys[point.Own - first] = point.Key;
      keys.Shared[point.Own - first] = 1;
      keys.Closed[point.Own - first] = 0;
    }
    for (std::int64_t* sum : { &keys.Repeated, &keys.UsedPoints, &keys.Ambiguous })
    {
      *sum = SumOverRanks(this->Group, *sum);
    }
    return std::move(keys);
  }

private:
  /// Whether a point must be matched with points of other ranks: a triangle has it, or it is the
  /// end of a constraint.
  bool IsWanted(std::int64_t point) const
  {
    return this->Keys.Used[point] != 0 || this->Ends[point] != 0;
  }
  /// Whether a point is at the border of the part: its triangles do not form a closed fan, or it
  /// has none and is the end of a constraint. Also true where triangles are not wound consistently.
  bool IsAtBorder(std::int64_t point) const
  {
    return this->Fans[point] != 0 || (this->Keys.Used[point] == 0 && this->Ends[point] != 0);
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

  /// Asks the ranks whose box holds a point of this one whether they have it, too: a border point,
  /// or any point if points have numbers. It may be inside their part: where three sheets of a
  /// non-manifold mesh meet, two may be on one rank; and sheets that lie on each other may have the
  /// same points.
  RecordLists<std::uint64_t> Ask() const
  {
    Box used; // NaN changes nothing
    double x[3];
    for (std::int64_t i = 0; i < this->Mesh.Points.Count; ++i)
    {
      if (this->Keys.Used[i] != 0)
      {
        this->GetPosition(i, x);
        used.Add(x);
      }
    }
    const RecordLists<Box> boxes = GatherRecords(this->Group, std::vector<Box>{ used });
    RecordLists<std::uint64_t> questions(boxes.size());
    for (std::int64_t i = 0; i < this->Mesh.Points.Count; ++i)
    {
      Place place{};
      if (!(this->Numbers ? this->IsWanted(i) : this->IsAtBorder(i)) || !this->FindPlace(i, place))
      {
        continue;
      }
      const bool isSomewhere = this->GetPosition(i, x);
      for (int rank = 0; rank < this->Group.GetSize(); ++rank)
      {
        if (rank != this->Group.GetRank() && (!isSomewhere || boxes[rank].front().Holds(x)))
        {
          questions[rank].push_back(GetHash(place));
        }
      }
    }
    return questions;
  }

  /// The points that others may have, too, for the homes of their places.
  /// @param asked the hashes of places that other ranks have asked for, sorted. Another place with
  /// the same hash is only sent in vain.
  RecordLists<Candidate> List(std::int64_t firstKey, const std::vector<std::uint64_t>& asked) const
  {
    RecordLists<Candidate> toHome(this->Group.GetSize());
    for (std::int64_t i = 0; i < this->Mesh.Points.Count; ++i)
    {
      Place place{};
      if (this->IsWanted(i) && this->FindPlace(i, place) &&
        (this->IsAtBorder(i) || std::binary_search(asked.begin(), asked.end(), GetHash(place))))
      {
        toHome[GetHome(GetHash(place), this->Group)].push_back(
          { place, firstKey + i, this->Group.GetRank(), this->Keys.Used[i] != 0 ? 0 : 1 });
      }
    }
    return toHome;
  }

  /// @returns what each rank must know about its candidates that are shared. Counts as the home of
  /// their places.
  RecordLists<SharedPoint> JoinCandidates(std::vector<Candidate> all)
  {
    const auto order = [](const Candidate& a) { return std::tie(a.At, a.IsUnused, a.Key); };
    std::sort(all.begin(), all.end(),
      [&](const Candidate& a, const Candidate& b) { return order(a) < order(b); });
    RecordLists<SharedPoint> answers(this->Group.GetSize());
    ForEachRun(
      all, [](const Candidate& a, const Candidate& b) { return a.At == b.At; },
      [&](const Candidate* begin, const Candidate* end) { this->JoinPlace(begin, end, answers); });
    return answers;
  }

  /// Answers the candidates of one place: first those with triangles, then the others; each group
  /// by key, hence by rank.
  void JoinPlace(const Candidate* begin, const Candidate* end, RecordLists<SharedPoint>& answers)
  {
    // Of points without triangles only one of a rank counts, and none if it has one with triangles.
    std::vector<Candidate> list;
    for (const Candidate* one = begin; one != end; ++one)
    {
      const bool isKnown = std::any_of(
        list.begin(), list.end(), [=](const Candidate& other) { return other.Rank == one->Rank; });
      if (one->IsUnused == 0 || !isKnown)
      {
        list.push_back(*one);
      }
    }
    if (list.front().IsUnused != 0 || list.front().Rank == list.back().Rank)
    {
      return;
    }
    const auto isSameRank = [](const Candidate& a, const Candidate& b) { return a.Rank == b.Rank; };
    if (std::adjacent_find(list.begin(), list.end(), isSameRank) != list.end())
    {
      this->Keys.Ambiguous += static_cast<std::int64_t>(list.size());
      return;
    }
    for (const Candidate& one : list)
    {
      const bool isFirst = one.Key == list.front().Key;
      this->Keys.Repeated += isFirst ? 0 : 1;
      this->Keys.UsedPoints -= isFirst || one.IsUnused != 0 ? 0 : 1;
      answers[one.Rank].push_back({ one.Key, list.front().Key });
    }
  }

  const TriangleMesh& Mesh;
  PieceGroup& Group;
  const std::int64_t* Numbers = nullptr; ///< Of the points, or null.
  const ThreadBackend Threads{ 1 }; ///< Whose memory Fans has.
  Array<std::uint64_t> Fans; ///< SumFans.
  std::vector<unsigned char> Ends; ///< Of constraints.
  PointKeys Keys;
};
}

PointKeys MatchPoints(const MeshPiece& piece, PieceGroup& group)
{
  return PointMatcher(piece, group).Run();
}

}
