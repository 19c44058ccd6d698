// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StarCheck.h"

#include "ExactPredicates.h"
#include "HostVector.h"
#include "Records.h"
#include "StarSurvey.h"

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
struct PlanePlace
{
  double U, V;

  bool IsEqual(const PlanePlace& other) const { return this->U == other.U && this->V == other.V; }

  PlanePoint Get() const { return { this->U, this->V, 0.0 }; }
};

/// The triangles that a rank has at a shared point.
struct SharedFan
{
  std::int64_t Key; ///< Of the point.
  /// Over its corners: the hash of the next neighbour minus that of the previous one. In a closed
  /// fan every neighbour is each of these once, so the sum over all ranks is 0.
  std::uint64_t Sum;
  PlanePlace At;
  std::int64_t Covers; ///< How many of its corners cover the direction +u.
};

using RankedFan = RankedRecord<SharedFan>;

/// A corner, its sides in counterclockwise order, at a point whose triangles do not close around
/// it in the whole mesh.
struct Wedge
{
  std::int64_t Key; ///< Of the point.
  PlanePlace Apex, First, Last;

  /// Whether the direction to a place lies in the wedge. That to First does, that to Last does not.
  bool Covers(const PlanePlace& place) const
  {
    const int afterFirst = this->FindTurn(this->First, place);
    return afterFirst == 0 ? this->IsUpper(this->First) == this->IsUpper(place)
                           : afterFirst > 0 && this->FindTurn(place, this->Last) > 0;
  }

  /// The order of wedges around a point, by their first directions.
  bool IsBefore(const Wedge& other) const
  {
    const bool isUpper = this->IsUpper(this->First);
    return isUpper == this->IsUpper(other.First) ? this->FindTurn(this->First, other.First) > 0
                                                 : isUpper;
  }

private:
  int FindTurn(const PlanePlace& a, const PlanePlace& b) const
  {
    return FindOrientation(this->Apex.Get(), a.Get(), b.Get());
  }
  bool IsUpper(const PlanePlace& place) const
  {
    return StarSurvey::IsUpper(this->Apex.Get(), place.Get());
  }
};

/// Lists what the ranks must know about the corners at points that are shared, or whose triangles
/// do not close around them.
class WedgeLister
{
public:
  WedgeLister(
    const TriangleMesh& mesh, const PlaneProjection& plane, int side, const PointKeys& keys)
    : Mesh(mesh),
      Plane(plane),
      Side(side),
      Keys(keys)
  {
    for (std::int64_t t = 0; t < mesh.Triangles.Count; ++t)
    {
      if (!this->IsClosed(t, 0) || !this->IsClosed(t, 1) || !this->IsClosed(t, 2))
      {
        this->Triangles.push_back(t);
      }
    }
  }

  /// The fans of shared points, for the homes of the points.
  RecordLists<SharedFan> ListFans(const PieceGroup& group) const
  {
    HostVector<std::int32_t> placeOf(this->Keys.Keys.size(), -1);
    std::vector<SharedFan> fans;
    this->ForEachCorner(
      [&](std::int64_t t, int slot, std::int64_t point)
      {
        if (!this->Keys.Shared[point])
        {
          return;
        }
        if (placeOf[point] < 0)
        {
          placeOf[point] = static_cast<std::int32_t>(fans.size());
          fans.push_back({ this->Keys.Keys[point], 0, this->FindPlace(t, slot), 0 });
        }
        this->AddCorner(t, slot, fans[placeOf[point]]);
      });
    RecordLists<SharedFan> toHome(group.GetSize());
    for (const SharedFan& fan : fans)
    {
      toHome[GetHome(ScatterBits(fan.Key), group)].push_back(fan);
    }
    return toHome;
  }

  /// Wedges at shared points go to the home of the point; the others stay on this rank.
  /// @param open the keys of the shared points that are not closed in the whole mesh.
  RecordLists<Wedge> ListWedges(
    const std::unordered_set<std::int64_t>& open, const PieceGroup& group) const
  {
    RecordLists<Wedge> toHome(group.GetSize());
    this->ForEachCorner(
      [&](std::int64_t t, int slot, std::int64_t point)
      {
        const std::int64_t key = this->Keys.Keys[point];
        const bool isShared = this->Keys.Shared[point] != 0;
        if (isShared ? open.count(key) > 0 : !this->Keys.Closed[point])
        {
          const int home = isShared ? GetHome(ScatterBits(key), group) : group.GetRank();
          toHome[home].push_back(this->MakeWedge(t, slot));
        }
      });
    return toHome;
  }

private:
  /// Calls visit(triangle, slot, point) for all corners of the triangles.
  template <typename Visit>
  void ForEachCorner(const Visit& visit) const
  {
    for (const std::int64_t t : this->Triangles)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        visit(t, slot, this->GetPoint(t, slot));
      }
    }
  }

  std::int64_t GetPoint(std::int64_t t, int slot) const
  {
    return this->Mesh.Triangles.Get(t, slot);
  }
  bool IsClosed(std::int64_t t, int slot) const
  {
    return this->Keys.Closed[this->GetPoint(t, slot)] != 0;
  }

  void AddCorner(std::int64_t t, int slot, SharedFan& fan) const
  {
    const int next = (slot + 1) % 3;
    const int previous = (slot + 2) % 3;
    fan.Sum += this->Scatter(t, next) - this->Scatter(t, previous);
    // Where a left turn covers +u, its first side goes down and its last up.
    const PlanePoint apex = this->Project(t, slot);
    const bool goesUp = StarSurvey::IsUpper(apex, this->Project(t, next));
    const bool returnsDown = StarSurvey::IsUpper(apex, this->Project(t, previous));
    fan.Covers += goesUp != returnsDown && returnsDown == (this->Side > 0) ? 1 : 0;
  }

  std::uint64_t Scatter(std::int64_t t, int slot) const
  {
    return ScatterBits(this->Keys.Keys[this->GetPoint(t, slot)]);
  }

  /// The corner at the first side of a wedge.
  int GetFirst(int slot) const { return (slot + (this->Side > 0 ? 1 : 2)) % 3; }

  PlanePoint Project(std::int64_t t, int slot) const
  {
    return this->Plane.Project(this->Mesh.Points, this->GetPoint(t, slot));
  }

  PlanePlace FindPlace(std::int64_t t, int slot) const
  {
    const PlanePoint at = this->Project(t, slot);
    return { at.U, at.V };
  }

  Wedge MakeWedge(std::int64_t t, int slot) const
  {
    const int first = this->GetFirst(slot);
    return { this->Keys.Keys[this->GetPoint(t, slot)], this->FindPlace(t, slot),
      this->FindPlace(t, first), this->FindPlace(t, 3 - slot - first) };
  }

  const TriangleMesh& Mesh;
  const PlaneProjection& Plane;
  int Side;
  const PointKeys& Keys;
  std::vector<std::int64_t> Triangles; ///< Those with a point that is not closed.
};

/// What a home finds out about shared points.
struct FanVerdict
{
  /// Whether the triangles at each closed point cover no direction twice, and ranks agree about
  /// the coordinates of points. Else flips need a guard.
  bool AreApart = true;
  RecordLists<std::int64_t> Open; ///< Keys of points that are not closed, for the ranks with them.
};

/// Judges the point of some fans, one per rank that has it.
void JudgeFans(const RankedFan* begin, const RankedFan* end, FanVerdict& verdict)
{
  SharedFan sum = begin->Value;
  for (const RankedFan* one = begin + 1; one != end; ++one)
  {
    sum.Sum += one->Value.Sum;
    sum.Covers += one->Value.Covers;
    verdict.AreApart = verdict.AreApart && one->Value.At.IsEqual(sum.At);
  }
  if (sum.Sum == 0)
  {
    verdict.AreApart = verdict.AreApart && sum.Covers == 1;
    return;
  }
  for (const RankedFan* one = begin; one != end; ++one)
  {
    verdict.Open[one->Rank].push_back(sum.Key);
  }
}

FanVerdict JudgeAllFans(const RecordLists<SharedFan>& lists)
{
  std::vector<RankedFan> all = JoinLists(lists);
  std::sort(all.begin(), all.end(),
    [](const RankedFan& a, const RankedFan& b) { return a.Value.Key < b.Value.Key; });
  FanVerdict verdict;
  verdict.Open.resize(lists.size());
  ForEachRun(
    all, [](const RankedFan& a, const RankedFan& b) { return a.Value.Key == b.Value.Key; },
    [&](const RankedFan* begin, const RankedFan* end) { JudgeFans(begin, end, verdict); });
  return verdict;
}

/// Whether the wedges at a point cover no direction twice.
bool AreApart(Wedge* begin, Wedge* end)
{
  const auto isElsewhere = [&](const Wedge& wedge) { return !wedge.Apex.IsEqual(begin->Apex); };
  if (std::any_of(begin, end, isElsewhere))
  {
    return false; // ranks disagree about the coordinates
  }
  std::sort(begin, end, [](const Wedge& a, const Wedge& b) { return a.IsBefore(b); });
  // A wedge that covers the first direction of any other also covers that of the next.
  for (const Wedge* one = begin; one + 1 < end; ++one)
  {
    if (one->Covers(one[1].First))
    {
      return false;
    }
  }
  return end - begin < 2 || !end[-1].Covers(begin->First);
}

bool AreAllApart(std::vector<Wedge> wedges)
{
  std::sort(
    wedges.begin(), wedges.end(), [](const Wedge& a, const Wedge& b) { return a.Key < b.Key; });
  bool areApart = true;
  ForEachRun(
    wedges, [](const Wedge& a, const Wedge& b) { return a.Key == b.Key; },
    [&](Wedge* begin, Wedge* end) { areApart = areApart && AreApart(begin, end); });
  return areApart;
}

struct TurnStep
{
  const TriangleMesh& Mesh;
  const PlaneProjection& Plane;
  const unsigned char* Closed;

  void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Mesh.Points.Prefetch(this->Mesh.Triangles.Get(t, slot));
    }
  }

  void operator()(std::int64_t t, StarTurns& sums) const
  {
    const PlanePoint p[3] = { this->Project(t, 0), this->Project(t, 1), this->Project(t, 2) };
    const bool isFinite = IsFinite(p[0]) && IsFinite(p[1]) && IsFinite(p[2]);
    const int side = isFinite ? FindOrientation(p[0], p[1], p[2]) : 0;
    sums.Left += side > 0 ? 1 : 0;
    sums.Right += side < 0 ? 1 : 0;
    sums.None += side == 0 ? 1 : 0;
    const int up = (StarSurvey::IsUpper(p[0], p[1]) ? 1 : 0) |
      (StarSurvey::IsUpper(p[1], p[2]) ? 2 : 0) | (StarSurvey::IsUpper(p[2], p[0]) ? 4 : 0);
    // Where a left turn covers +u, the edges to and from the corner go down; a right turn, up. No
    // branches, which would be mispredicted half of the time.
    constexpr int Corner[8] = { 0, 2, 0, 1, 1, 0, 2, 0 };
    constexpr int IsOneUp = 0b00010110, IsTwoUp = 0b01101000;
    const int covers = ((side > 0 ? IsOneUp : IsTwoUp) >> up) & 1;
    sums.Covers += covers & this->Closed[this->Mesh.Triangles.Get(t, Corner[up])];
  }

private:
  PlanePoint Project(std::int64_t t, int slot) const
  {
    PlanePoint point = this->Plane.Project(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot));
    point.W = 0.0;
    return point;
  }
};
}

StarTurns SumStarTurns(const TriangleMesh& mesh, const PlaneProjection& plane,
  const unsigned char* closed, const ThreadBackend& threads)
{
  return threads.Sum<StarTurns>(mesh.Triangles.Count, TurnStep{ mesh, plane, closed });
}

StarTurns SumStarTurns(const TriangleMesh& mesh, const PlaneProjection& plane,
  const PointKeys& keys, const ThreadBackend& threads, PieceGroup& group)
{
  StarTurns own = SumStarTurns(mesh, plane, keys.Closed.data(), threads);
  own.Covers -= std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  return SumOverRanks(group, own);
}

bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const StarTurns& all, PieceGroup& group)
{
  if (!all.AreUniform() || all.Covers != 0)
  {
    return false;
  }
  const WedgeLister lister(mesh, plane, all.Left > 0 ? 1 : -1, keys);
  const FanVerdict fans = JudgeAllFans(ExchangeRecords(group, lister.ListFans(group)));
  std::unordered_set<std::int64_t> open;
  for (const std::vector<std::int64_t>& list : ExchangeRecords(group, fans.Open))
  {
    open.insert(list.begin(), list.end());
  }
  std::vector<Wedge> wedges;
  for (const std::vector<Wedge>& list : ExchangeRecords(group, lister.ListWedges(open, group)))
  {
    wedges.insert(wedges.end(), list.begin(), list.end());
  }
  const bool areApart = fans.AreApart && AreAllApart(std::move(wedges));
  return SumOverRanks(group, std::int64_t(areApart ? 0 : 1)) == 0;
}

}
