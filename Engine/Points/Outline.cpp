// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Outline.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Sums the turns at each edge. A spike, there and back, has none. A ring that runs more than once
/// along its loop runs once. @returns whether it did so.
bool Simplify(std::vector<RingEdge>& ring)
{
  std::sort(
    ring.begin(), ring.end(), [](const RingEdge& a, const RingEdge& b) { return a.Edge < b.Edge; });
  std::vector<RingEdge> sums;
  for (const RingEdge& edge : ring)
  {
    if (sums.empty() || sums.back().Edge != edge.Edge)
    {
      sums.push_back({ edge.Edge, 0 });
    }
    sums.back().Turns += edge.Turns;
  }
  sums.erase(
    std::remove_if(sums.begin(), sums.end(), [](const RingEdge& edge) { return edge.Turns == 0; }),
    sums.end());
  std::int64_t rounds = 0;
  for (const RingEdge& edge : sums)
  {
    rounds = std::gcd(rounds, edge.Turns);
  }
  for (RingEdge& edge : sums)
  {
    edge.Turns /= rounds;
  }
  ring = std::move(sums);
  return rounds > 1;
}

}

RingMap ListRings(
  const std::vector<SegmentEdge>& segments, std::int32_t firstHole, KeptTriangles& kept)
{
  RingMap rings;
  for (const SegmentEdge& segment : segments)
  {
    if (segment.Ring >= 0)
    {
      const bool isEven = segment.Side % 2 == 0;
      rings[segment.Ring].push_back({ EdgeOf(segment.Side), segment.IsOnLeft == isEven ? 1 : -1 });
    }
  }
  using Turn = std::pair<EdgeId, std::int64_t>;
  std::set<std::pair<bool, std::vector<Turn>>> known;
  for (auto ring = rings.begin(); ring != rings.end();)
  {
    auto& [number, edges] = *ring;
    const bool hasRepeated = Simplify(edges);
    std::vector<Turn> turns;
    for (const RingEdge& edge : edges)
    {
      const std::int64_t direction = edges.front().Turns > 0 ? 1 : -1;
      turns.emplace_back(edge.Edge, direction * edge.Turns);
    }
    const bool isNew = edges.empty() || known.emplace(number >= firstHole, std::move(turns)).second;
    if (!isNew)
    {
      kept.RepeatedRings.push_back(number);
      ring = rings.erase(ring);
      continue;
    }
    if (hasRepeated)
    {
      kept.RingsRunAgain.push_back(number);
    }
    ++ring;
  }
  return rings;
}

namespace
{
/// Goes from component to component, and back, and counts how often each ring winds around them.
/// What it finds does not depend on the way, since rings are closed.
class RingWalk
{
public:
  RingWalk(const ComponentMap& map, const RingMap& rings, std::int32_t firstHole)
    : Components(map),
      FirstHole(firstHole),
      Last(map.Walls.size(), None)
  {
    for (const auto& [number, edges] : rings)
    {
      this->Rings[number];
      for (const RingEdge& edge : edges)
      {
        const auto found = std::lower_bound(map.Walls.begin(), map.Walls.end(), edge.Edge,
          [](const ComponentWall& one, EdgeId other) { return one.Edge < other; });
        std::int64_t& last = this->Last[found - map.Walls.begin()];
        this->Turns.push_back({ number, edge.Turns, last });
        last = SizeOf(this->Turns) - 1;
      }
    }
  }

  bool HasRings() const { return !this->Rings.empty(); }

  /// @returns 1 for every component that is inside the holes or not inside the outline, else 0.
  std::vector<std::uint8_t> FindOutside(RingRuleKind rule)
  {
    std::vector<std::uint8_t> fates(this->Components.Count, Unknown);
    std::vector<std::size_t> path; // the sides of walls through which components were entered
    const auto enter = [&](std::size_t side)
    {
      const std::uint32_t component = this->GetComponent(side);
      const bool isNew = component != ComponentWall::NoComponent && fates[component] == Unknown;
      if (isNew)
      {
        this->Cross(side);
        this->LookAround(side);
        fates[component] = this->Judge(rule);
        path.push_back(side);
      }
      return isNew;
    };
    const std::size_t sides = 2 * this->Components.Walls.size();
    for (std::size_t side = 0; path.empty() && side < sides; ++side)
    {
      if (this->GetComponent(side ^ 1u) == ComponentWall::NoComponent)
      {
        enter(side);
      }
    }
    const std::vector<std::size_t> firsts = this->CountSides();
    const std::vector<std::size_t> listed = this->ListSides(firsts);
    std::vector<std::size_t> next(firsts.begin(), firsts.end() - 1);
    while (!path.empty())
    {
      const std::uint32_t component = this->GetComponent(path.back());
      std::size_t& own = next[component];
      if (own < firsts[component + 1])
      {
        enter(listed[own++] ^ 1u);
        continue;
      }
      this->Cross(path.back() ^ 1u);
      path.pop_back();
    }
    const bool hasOutline = this->HasOutline();
    for (std::uint8_t& fate : fates)
    {
      const bool isOutside = fate == Outside || (fate == InNoRing && this->AnyIsCounterClockwise);
      const bool isRemoved = fate == InHole || (hasOutline && isOutside);
      fate = isRemoved ? 1 : 0;
    }
    return fates;
  }

  /// Whether a ring with an area is not a hole.
  bool HasOutline() const
  {
    return std::any_of(this->Rings.begin(), this->Rings.end(),
      [this](const auto& item) { return item.first < this->FirstHole && item.second.HasArea; });
  }

  /// The numbers of the rings that enclose nothing.
  std::vector<std::int32_t> ListRingsWithoutArea() const
  {
    std::vector<std::int32_t> numbers;
    for (const auto& [number, ring] : this->Rings)
    {
      if (!ring.HasArea)
      {
        numbers.push_back(number);
      }
    }
    return numbers;
  }

private:
  struct Ring
  {
    std::int64_t Winding = 0; ///< Around the component at hand.
    bool HasArea = false;
  };

  /// An edge of a ring.
  struct Turn
  {
    std::int32_t Ring;
    std::int64_t Turns; ///< See RingEdge.
    std::int64_t Before; ///< The one before it at the same wall.
  };

  enum FateKind : std::uint8_t
  {
    Inside,
    InHole,
    Outside, ///< Outside of the outline.
    InNoRing, ///< In no ring of the outline, where the orientation of rings decides.
    Unknown
  };

  /// The component at a side of a wall, 2 i or 2 i + 1 for that with the number i.
  std::uint32_t GetComponent(std::size_t side) const
  {
    return this->Components.Walls[side / 2].Components[side % 2];
  }

  /// How many sides of walls the components before each one have, and all.
  std::vector<std::size_t> CountSides() const
  {
    std::vector<std::size_t> firsts(this->Components.Count + 1, 0);
    for (const ComponentWall& wall : this->Components.Walls)
    {
      for (const std::uint32_t component : wall.Components)
      {
        if (component != ComponentWall::NoComponent)
        {
          ++firsts[component + std::size_t(1)];
        }
      }
    }
    std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
    return firsts;
  }

  /// The sides of walls by their components. @param firsts what CountSides returns.
  std::vector<std::size_t> ListSides(const std::vector<std::size_t>& firsts) const
  {
    std::vector<std::size_t> listed(firsts.back());
    std::vector<std::size_t> next(firsts.begin(), firsts.end() - 1);
    for (std::size_t side = 0; side < 2 * this->Components.Walls.size(); ++side)
    {
      const std::uint32_t component = this->GetComponent(side);
      if (component != ComponentWall::NoComponent)
      {
        listed[next[component]++] = side;
      }
    }
    return listed;
  }

  /// Goes to this side of its wall.
  void Cross(std::size_t side)
  {
    const std::int64_t direction = side % 2 == 0 ? 1 : -1;
    for (std::int64_t i = this->Last[side / 2]; i != None; i = this->Turns[i].Before)
    {
      const Turn& turn = this->Turns[i];
      const std::int64_t change = direction * turn.Turns;
      this->Rings[turn.Ring].Winding += change;
      if (turn.Ring >= this->FirstHole)
      {
        this->HoleWinding += change;
      }
      else
      {
        this->OutlineWinding += change;
      }
    }
  }

  /// Notes what the rings at a wall that was crossed enclose. A component around which a ring winds
  /// is entered from one around which it does not, or from one for which that was noted.
  void LookAround(std::size_t side)
  {
    for (std::int64_t i = this->Last[side / 2]; i != None; i = this->Turns[i].Before)
    {
      const std::int32_t number = this->Turns[i].Ring;
      Ring& ring = this->Rings[number];
      ring.HasArea |= ring.Winding != 0;
      this->AnyIsCounterClockwise |= ring.Winding > 0 && number < this->FirstHole;
    }
  }

  FateKind Judge(RingRuleKind rule) const
  {
    const bool isEvenOdd = rule == RingRuleKind::EvenOdd;
    const auto isInside = [=](std::int64_t winding)
    { return winding != 0 && (!isEvenOdd || winding % 2 != 0); };
    if (isInside(this->HoleWinding))
    {
      return InHole;
    }
    if (rule == RingRuleKind::Orientation && this->OutlineWinding < 0)
    {
      return Outside;
    }
    if (rule == RingRuleKind::Orientation && this->OutlineWinding == 0)
    {
      return InNoRing;
    }
    return isInside(this->OutlineWinding) ? Inside : Outside;
  }

  static constexpr std::int64_t None = -1;

  const ComponentMap& Components;
  const std::int32_t FirstHole;
  std::map<std::int32_t, Ring> Rings; ///< By their numbers.
  std::vector<Turn> Turns;
  std::vector<std::int64_t> Last; ///< By wall: its last turn.
  /// How often the rings of a set wind around the component at hand, all together.
  std::int64_t OutlineWinding = 0, HoleWinding = 0;
  bool AnyIsCounterClockwise = false; ///< Whether an outline is.
};

using Corners = std::array<PlanePoint, 3>;

Corners GetCorners(const PointMeshView& mesh, std::int64_t triangle)
{
  Corners corners;
  for (int slot = 0; slot < 3; ++slot)
  {
    corners[slot] = mesh.GetPoint(mesh.Edges.Triangles[triangle].Vertices[slot]);
  }
  return corners;
}

/// Whether the corners of a triangle come before those of another one, both sorted by x and y. This
/// depends on the places alone, not on the order of triangles or points.
bool Precede(const Corners& one, const Corners& other)
{
  const auto sort = [](const Corners& corners)
  {
    std::array<std::pair<double, double>, 3> sorted;
    std::transform(corners.begin(), corners.end(), sorted.begin(),
      [](const PlanePoint& corner) { return std::make_pair(corner.U, corner.V); });
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  return sort(one) < sort(other);
}

/// Finds the triangle that each seed is in, or NoTriangle if there is none. If several have the
/// seed, on an edge or a corner, it is the one that precedes the others. @param getSeed returns a
/// seed's place. @param side the orientation of triangles, 1 or -1.
/// @param counts whether a triangle may have seeds.
template <typename GetSeed, typename Counts>
std::vector<TriangleId> FindTriangles(const PointMeshView& mesh, std::int64_t count,
  const GetSeed& getSeed, int side, const Counts& counts)
{
  std::vector<std::int64_t> order(count); // by x
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](std::int64_t a, std::int64_t b) { return getSeed(a).U < getSeed(b).U; });
  std::vector<TriangleId> found(count, NoTriangle);
  for (std::int64_t t = 0; t < mesh.NumberOfTriangles; ++t)
  {
    if (!counts(t))
    {
      continue;
    }
    const Corners corners = GetCorners(mesh, t);
    const auto [left, right] = std::minmax({ corners[0].U, corners[1].U, corners[2].U });
    auto next = std::lower_bound(order.begin(), order.end(), left,
      [&](std::int64_t seed, double x) { return getSeed(seed).U < x; });
    for (; next != order.end() && getSeed(*next).U <= right; ++next)
    {
      TriangleId& triangle = found[*next];
      bool isInside = true;
      for (int slot = 0; slot < 3 && isInside; ++slot)
      {
        const PlanePoint &from = corners[slot], &to = corners[NextSlot(slot)];
        isInside = side * FindOrientation(from, to, getSeed(*next)) >= 0;
      }
      if (isInside && (triangle == NoTriangle || Precede(corners, GetCorners(mesh, triangle))))
      {
        triangle = static_cast<TriangleId>(t);
      }
    }
  }
  return found;
}

}

std::int64_t CountHolePointsOutside(
  const PointMeshView& mesh, const PointInput& input, const std::vector<SegmentEdge>& segments)
{
  std::vector<unsigned char> isOfHole(mesh.NumberOfPlaces, 0);
  for (const SegmentEdge& segment : segments)
  {
    for (const VertexId place : { mesh.GetStart(segment.Side), mesh.GetEnd(segment.Side) })
    {
      const bool isAdded = static_cast<std::int64_t>(mesh.Ids[place]) >= input.FirstAdded;
      const bool isMark = isAdded && segment.Ring >= input.FirstHole;
      isOfHole[place] |= isMark ? 1 : 0;
    }
  }
  std::map<VertexId, VertexId> next; // along the hull, from place to place
  for (HalfEdgeId side = 0; side < 2 * mesh.NumberOfEdges; ++side)
  {
    if (mesh.Edges.CornerOfHalfEdge[side ^ 1u] == NoCorner)
    {
      next[mesh.GetStart(side)] = mesh.GetEnd(side);
    }
  }
  std::int64_t count = 0;
  for (const auto& [start, place] : next)
  {
    const auto after = next.find(place);
    const bool isBend = after != next.end() && isOfHole[place] != 0 &&
      FindOrientation(mesh.GetPoint(start), mesh.GetPoint(place), mesh.GetPoint(after->second)) !=
        0;
    count += isBend ? 1 : 0;
  }
  return count;
}

std::vector<TriangleId> FindHoleSeeds(const PointMeshView& mesh, const PointInput& input)
{
  const double* seeds = input.HoleSeeds;
  const auto getSeed = [=](std::int64_t i) {
    return PlanePoint{ seeds[2 * i], seeds[2 * i + 1], 0.0 };
  };
  return FindTriangles(
    mesh, input.NumberOfHoleSeeds, getSeed, 1, [](std::int64_t) { return true; });
}

//------------------------------------------------------------------------------
void ComponentJudge::RemoveOutside(RingRuleKind rule, KeptTriangles& kept)
{
  const RingMap rings = ListRings(this->Segments, this->Input.FirstHole, kept);
  RingWalk walk(this->Map, rings, this->Input.FirstHole);
  if (walk.HasRings())
  {
    this->IsRemoved = walk.FindOutside(rule);
    const bool haveOwnPoints = this->Input.FirstAdded < this->Input.Points.Count;
    this->HolesAlone = !walk.HasOutline() && haveOwnPoints;
  }
  kept.RingsWithoutArea = walk.ListRingsWithoutArea();
}

std::int64_t ComponentJudge::RemoveHoles(const std::vector<std::uint32_t>& components)
{
  std::int64_t outside = 0;
  for (const std::uint32_t component : components)
  {
    if (component == ComponentWall::NoComponent)
    {
      ++outside;
      continue;
    }
    this->IsRemoved.resize(this->Map.Count, 0);
    this->IsRemoved[component] = 1;
  }
  return outside;
}

bool MayRemove(const PointInput& input, const PointOptions& options)
{
  return input.Rings || input.NumberOfHoleSeeds > 0 || options.Alpha > 0.0 ||
    options.LongestEdge > 0.0;
}

namespace
{
/// Counts a seed as a defect, and names it if it is one of the first.
void AddSeed(std::int64_t number, Defect& defect)
{
  ++defect.Count;
  if (SizeOf(defect.FirstIds) < MostNamedIds)
  {
    defect.FirstIds.push_back(number);
  }
}
}

UnusedSeeds SpreadSeeds(const PointMeshView& mesh, const RegionSeed* seeds, std::int64_t count,
  int side, std::vector<std::int32_t>& regions)
{
  const auto getSeed = [&](std::int64_t i) { return PlanePoint{ seeds[i].X, seeds[i].Y, 0.0 }; };
  const std::vector<TriangleId> starts =
    FindTriangles(mesh, count, getSeed, side, [&](std::int64_t t) { return regions[t] >= 0; });
  UnusedSeeds unused;
  std::vector<TriangleId> stack;
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    if (starts[i] == NoTriangle)
    {
      AddSeed(static_cast<std::int64_t>(i), unused.Outside);
      continue;
    }
    const std::int32_t before = regions[starts[i]];
    const auto enter = [&](TriangleId triangle)
    {
      if (regions[triangle] == 0)
      {
        regions[triangle] = static_cast<std::int32_t>(i + 1);
        stack.push_back(triangle);
      }
    };
    const bool isRepeated = before > 0 &&
      (seeds[i].Label != seeds[before - 1].Label ||
        seeds[i].MaximumArea != seeds[before - 1].MaximumArea);
    if (isRepeated)
    {
      AddSeed(static_cast<std::int64_t>(i), unused.Repeated);
    }
    enter(starts[i]);
    while (!stack.empty())
    {
      const TriangleRecord& triangle = mesh.Edges.Triangles[stack.back()];
      stack.pop_back();
      for (const HalfEdgeId half : triangle.HalfEdges)
      {
        if (!mesh.IsFixed(half))
        {
          enter(TriangleOf(mesh.Edges.CornerOfHalfEdge[half ^ 1u]));
        }
      }
    }
  }
  return unused;
}

std::vector<std::int32_t> FindRegions(const PointMeshView& mesh, const PointInput& input,
  const KeptTriangles& kept, UnusedSeeds& unused)
{
  std::vector<std::int32_t> regions(mesh.NumberOfTriangles, 0);
  for (std::size_t t = 0; t < kept.Numbers.size(); ++t)
  {
    const TriangleId slot = mesh.Edges.Triangles[t].InputTriangle;
    regions[t] = kept.Numbers[slot] < 0 ? -1 : 0;
  }
  unused = SpreadSeeds(mesh, input.Regions, input.NumberOfRegions, 1, regions);
  return regions;
}

}
