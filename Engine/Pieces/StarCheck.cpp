// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "StarCheck.h"

#include "ExactPredicates.h"
#include "Records.h"
#include "StarSurvey.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
struct PlanePlace
{
  double U, V;

  PlanePoint Get() const { return { this->U, this->V, 0.0 }; }
};

/// A corner of a triangle that turns left, at a point whose triangles do not close around it on
/// this rank.
struct Wedge
{
  std::int64_t Key; ///< Of the point.
  PlanePlace Apex, First, Last;

  /// Whether it has the direction to a place; that to First it has, that to Last not.
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
  }

  /// Those at shared points go to the home of the point; the others stay on this rank.
  RecordLists<Wedge> List(const PieceGroup& group) const
  {
    RecordLists<Wedge> toHome(group.GetSize());
    for (std::int64_t t = 0; t < this->Mesh.Triangles.Count; ++t)
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        const std::int64_t point = this->Mesh.Triangles.Get(t, slot);
        if (!this->Keys.Closed[point])
        {
          const Wedge wedge = this->MakeWedge(t, slot);
          const int home =
            this->Keys.Shared[point] ? GetHome(ScatterBits(wedge.Key), group) : group.GetRank();
          toHome[home].push_back(wedge);
        }
      }
    }
    return toHome;
  }

private:
  /// The corner at the first side of a wedge.
  int GetFirst(int slot) const { return (slot + (this->Side > 0 ? 1 : 2)) % 3; }

  PlanePoint Project(std::int64_t t, int slot) const
  {
    return this->Plane.Project(this->Mesh.Points, this->Mesh.Triangles.Get(t, slot));
  }

  PlanePlace FindPlace(std::int64_t t, int slot) const
  {
    const PlanePoint at = this->Project(t, slot);
    return { at.U, at.V };
  }

  Wedge MakeWedge(std::int64_t t, int slot) const
  {
    const int first = this->GetFirst(slot);
    return { this->Keys.Keys[this->Mesh.Triangles.Get(t, slot)], this->FindPlace(t, slot),
      this->FindPlace(t, first), this->FindPlace(t, 3 - slot - first) };
  }

  const TriangleMesh& Mesh;
  const PlaneProjection& Plane;
  int Side;
  const PointKeys& Keys;
};

/// Whether the wedges at a point cover no direction twice.
bool AreApart(Wedge* begin, Wedge* end)
{
  const auto isElsewhere = [&](const Wedge& wedge)
  { return wedge.Apex.U != begin->Apex.U || wedge.Apex.V != begin->Apex.V; };
  if (std::any_of(begin, end, isElsewhere))
  {
    return false; // ranks disagree about the coordinates
  }
  std::sort(begin, end, [](const Wedge& a, const Wedge& b) { return a.IsBefore(b); });
  // One that covers the first direction of any other covers that of the next.
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
  for (std::size_t begin = 0; begin < wedges.size() && areApart;)
  {
    std::size_t end = begin + 1;
    while (end < wedges.size() && wedges[end].Key == wedges[begin].Key)
    {
      ++end;
    }
    areApart = AreApart(wedges.data() + begin, wedges.data() + end);
    begin = end;
  }
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

bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const ThreadBackend& threads, PieceGroup& group)
{
  StarTurns own = SumStarTurns(mesh, plane, keys.Closed.data(), threads);
  own.Covers -= std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  const StarTurns all = SumOverRanks(group, own);
  if (!all.AreUniform() || all.Covers != 0)
  {
    return false;
  }
  const WedgeLister lister(mesh, plane, all.Left > 0 ? 1 : -1, keys);
  std::vector<Wedge> wedges;
  for (const std::vector<Wedge>& list : ExchangeRecords(group, lister.List(group)))
  {
    wedges.insert(wedges.end(), list.begin(), list.end());
  }
  return SumOverRanks(group, std::int64_t(AreAllApart(std::move(wedges)) ? 0 : 1)) == 0;
}

}
