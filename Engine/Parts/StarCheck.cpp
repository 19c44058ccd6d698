// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StarCheck.h"

#include "Atomics.h"
#include "ExactPredicates.h"
#include "MeshInParts.h"
#include "Records.h"
#include "StarSurvey.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
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
    PlanePoint p[3];
    bool isFinite = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      p[slot] = this->Plane.Project(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot));
      p[slot].W = 0.0;
      isFinite = isFinite && IsFinite(p[slot]);
    }
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
};

/// A corner with its sides in counterclockwise order, at a point that is shared or whose triangles
/// do not close around it.
struct Wedge
{
  std::int64_t Key; ///< Of the point.
  double Apex[2], First[2], Last[2];

  bool IsAt(const Wedge& other) const
  {
    return this->Apex[0] == other.Apex[0] && this->Apex[1] == other.Apex[1];
  }
  /// Whether the direction to a place lies in the wedge. That to First does, that to Last does not.
  bool Covers(const double (&place)[2]) const
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
  static PlanePoint Make(const double (&place)[2]) { return { place[0], place[1], 0.0 }; }
  int FindTurn(const double (&a)[2], const double (&b)[2]) const
  {
    return FindOrientation(Make(this->Apex), Make(a), Make(b));
  }
  bool IsUpper(const double (&place)[2]) const
  {
    return StarSurvey::IsUpper(Make(this->Apex), Make(place));
  }
};

/// The wedges of a rank: at shared points for the homes of these, the others for this rank.
/// @param side the one to which all triangles turn: 1 or -1.
RecordLists<Wedge> ListWedges(const TriangleMesh& mesh, const PlaneProjection& plane, int side,
  const PointKeys& keys, const ThreadBackend& threads, const PieceGroup& group)
{
  RecordLists<Wedge> toHome(group.GetSize());
  const auto isAtOpenPoint = [&](std::int64_t t)
  {
    return !keys.Closed[mesh.Triangles.Get(t, 0)] || !keys.Closed[mesh.Triangles.Get(t, 1)] ||
      !keys.Closed[mesh.Triangles.Get(t, 2)];
  };
  const Array<std::int64_t> triangles = ListNumbers(mesh.Triangles.Count, isAtOpenPoint, threads);
  for (std::size_t i = 0; i < triangles.Size(); ++i)
  {
    const std::int64_t t = triangles[i];
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t point = mesh.Triangles.Get(t, slot);
      if (keys.Closed[point])
      {
        continue;
      }
      Wedge wedge{ keys.Keys[point], {}, {}, {} };
      const int first = (slot + (side > 0 ? 1 : 2)) % 3;
      const auto place = [&](int corner, double(&at)[2])
      {
        const PlanePoint p = plane.Project(mesh.Points, mesh.Triangles.Get(t, corner));
        at[0] = p.U;
        at[1] = p.V;
      };
      place(slot, wedge.Apex);
      place(first, wedge.First);
      place(3 - slot - first, wedge.Last);
      const int home =
        keys.Shared[point] ? GetHome(ScatterBits(wedge.Key), group) : group.GetRank();
      toHome[home].push_back(wedge);
    }
  }
  return toHome;
}

/// Whether the wedges at a point cover no direction twice, and ranks agree about its coordinates.
bool AreApart(Wedge* begin, Wedge* end)
{
  if (!std::all_of(begin, end, [&](const Wedge& wedge) { return wedge.IsAt(*begin); }))
  {
    return false;
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
}

StarTurns SumStarTurns(const TriangleMesh& mesh, const PlaneProjection& plane,
  const PointKeys& keys, const ThreadBackend& threads, PieceGroup& group)
{
  StarTurns turns =
    threads.Sum<StarTurns>(mesh.Triangles.Count, TurnStep{ mesh, plane, keys.Closed.data() });
  turns.Covers -= std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  return SumOverRanks(group, turns);
}

bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const StarTurns& turns, const ThreadBackend& threads, PieceGroup& group)
{
  if (!turns.AreUniform() || turns.Covers != 0)
  {
    return false;
  }
  std::vector<Wedge> wedges;
  for (const std::vector<Wedge>& list :
    ExchangeRecords(group, ListWedges(mesh, plane, turns.GetSide(), keys, threads, group)))
  {
    wedges.insert(wedges.end(), list.begin(), list.end());
  }
  std::sort(
    wedges.begin(), wedges.end(), [](const Wedge& a, const Wedge& b) { return a.Key < b.Key; });
  bool areApart = true;
  ForEachRun(
    wedges, [](const Wedge& a, const Wedge& b) { return a.Key == b.Key; },
    [&](Wedge* begin, Wedge* end) { areApart = areApart && AreApart(begin, end); });
  return SumOverRanks(group, std::int64_t(areApart ? 0 : 1)) == 0;
}

void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane,
  const ThreadBackend& threads, WholeMesh& whole)
{
  PointKeys keys; // none is shared
  keys.Closed.resize(mesh.Points.Count);
  {
    Array<std::uint64_t> fans = threads.MakeArray<std::uint64_t>(mesh.Points.Count);
    threads.ForEach(mesh.Points.Count, [&](std::int64_t i) { fans[i] = 0; });
    threads.ForEach(mesh.Triangles.Count,
      [&](std::int64_t t)
      {
        std::int64_t ids[3];
        std::uint64_t bits[3];
        for (int slot = 0; slot < 3; ++slot)
        {
          ids[slot] = mesh.Triangles.Get(t, slot);
          bits[slot] = ScatterBits(ids[slot]);
        }
        for (int slot = 0; slot < 3; ++slot)
        {
          // Around a closed fan every neighbour is the next one once, and once the previous one.
          __atomic_fetch_add(
            &fans[ids[slot]], bits[(slot + 1) % 3] - bits[(slot + 2) % 3], __ATOMIC_RELAXED);
          AtomicStore<unsigned char>(&keys.Closed[ids[slot]], 1);
        }
      });
    threads.ForEach(mesh.Points.Count,
      [&](std::int64_t i)
      {
        if (fans[i] != 0)
        {
          keys.Closed[i] = 0;
        }
      });
  }
  keys.Shared.resize(mesh.Points.Count);
  keys.Keys.resize(mesh.Points.Count);
  std::iota(keys.Keys.begin(), keys.Keys.end(), 0);
  const std::unique_ptr<PieceGroup> group = MakeSingleGroup();
  const StarTurns turns = SumStarTurns(mesh, plane, keys, threads, *group);
  whole.Side = turns.GetSide();
  whole.StarsAreSimple = AreStarsSimple(mesh, plane, keys, turns, threads, *group);
}

}
