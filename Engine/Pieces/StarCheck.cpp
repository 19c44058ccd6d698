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

  /// How often the corners at closed points cover the direction +u, around which their triangles
  /// turn a whole number of times: once each, if their stars are simple.
  std::int64_t CountCovers() const
  {
    std::int64_t covers = 0;
    for (std::int64_t t = 0; t < this->Mesh.Triangles.Count; ++t)
    {
      const PlanePoint p[3] = { this->Project(t, 0), this->Project(t, 1), this->Project(t, 2) };
      for (int slot = 0; slot < 3; ++slot)
      {
        const int first = this->GetFirst(slot);
        const bool isCovered = !StarSurvey::IsUpper(p[slot], p[first]) &&
          StarSurvey::IsUpper(p[slot], p[3 - slot - first]);
        covers += isCovered ? this->Keys.Closed[this->Mesh.Triangles.Get(t, slot)] : 0;
      }
    }
    return covers;
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

struct StarCounts
{
  std::int64_t Unclosed = 0; ///< How often closed points are covered more than once.
  std::int64_t Overlapping = 0; ///< Ranks that have found wedges that overlap.

  StarCounts& operator+=(const StarCounts& part)
  {
    this->Unclosed += part.Unclosed;
    this->Overlapping += part.Overlapping;
    return *this;
  }
};
}

bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, int side,
  const PointKeys& keys, PieceGroup& group)
{
  const WedgeLister lister(mesh, plane, side, keys);
  std::vector<Wedge> wedges;
  for (const std::vector<Wedge>& list : ExchangeRecords(group, lister.List(group)))
  {
    wedges.insert(wedges.end(), list.begin(), list.end());
  }
  StarCounts own;
  own.Unclosed = lister.CountCovers() - std::count(keys.Closed.begin(), keys.Closed.end(), 1);
  own.Overlapping = AreAllApart(std::move(wedges)) ? 0 : 1;
  const StarCounts all = SumOverRanks(group, own);
  return all.Unclosed == 0 && all.Overlapping == 0;
}

}
