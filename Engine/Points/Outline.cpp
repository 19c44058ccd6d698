// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Outline.h"

#include "PortableMath.h"
#include "SmallestAngle.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <array>
#include <cmath>
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
/// Goes from triangle to triangle, and back, and counts how often each ring winds around them.
class RingWalk
{
public:
  RingWalk(const PointMeshView& mesh, const RingMap& rings, std::int32_t firstHole)
    : Mesh(mesh),
      FirstHole(firstHole),
      Last(mesh.NumberOfEdges, None)
  {
    for (const auto& [number, edges] : rings)
    {
      this->Rings[number];
      for (const RingEdge& edge : edges)
      {
        const auto wall = static_cast<std::int64_t>(this->Walls.size());
        this->Walls.push_back({ number, edge.Turns, this->Last[edge.Edge] });
        this->Last[edge.Edge] = wall;
      }
    }
  }

  bool HasRings() const { return !this->Rings.empty(); }

  /// @returns 1 for every triangle that is inside the holes or not inside the outline, else 0.
  std::vector<unsigned char> FindOutside(RingRuleKind rule)
  {
    std::vector<unsigned char> fates(this->Mesh.NumberOfTriangles, Unknown);
    std::vector<HalfEdgeId> path; // the sides through which triangles were entered
    const auto enter = [&](HalfEdgeId side)
    {
      const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[side];
      const bool isNew = corner != NoCorner && fates[TriangleOf(corner)] == Unknown;
      if (isNew)
      {
        this->Cross(side);
        this->LookAround(side);
        fates[TriangleOf(corner)] = this->Judge(rule);
        path.push_back(side);
      }
      return isNew;
    };
    for (HalfEdgeId side = 0; path.empty() && side < 2 * this->Mesh.NumberOfEdges; ++side)
    {
      if (this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u] == NoCorner)
      {
        enter(side);
      }
    }
    while (!path.empty())
    {
      const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[path.back()];
      const TriangleRecord& triangle = this->Mesh.Edges.Triangles[TriangleOf(corner)];
      if (std::none_of(std::begin(triangle.HalfEdges), std::end(triangle.HalfEdges),
            [&](HalfEdgeId side) { return enter(side ^ 1u); }))
      {
        this->Cross(path.back() ^ 1u);
        path.pop_back();
      }
    }
    const bool hasOutline = this->HasOutline();
    for (unsigned char& fate : fates)
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
    std::int64_t Winding = 0; ///< Around the triangle at hand.
    bool HasArea = false;
  };

  /// An edge of a ring.
  struct Wall
  {
    std::int32_t Ring;
    std::int64_t Turns; ///< See RingEdge.
    std::int64_t Before; ///< The one before it at the same edge.
  };

  enum FateKind : unsigned char
  {
    Inside,
    InHole,
    Outside, ///< Outside of the outline.
    InNoRing, ///< In no ring of the outline, where the orientation of rings decides.
    Unknown
  };

  /// Goes to this side of its edge.
  void Cross(HalfEdgeId side)
  {
    const std::int64_t direction = side % 2 == 0 ? 1 : -1;
    for (std::int64_t i = this->Last[EdgeOf(side)]; i != None; i = this->Walls[i].Before)
    {
      const Wall& wall = this->Walls[i];
      const std::int64_t change = direction * wall.Turns;
      this->Rings[wall.Ring].Winding += change;
      if (wall.Ring >= this->FirstHole)
      {
        this->HoleWinding += change;
      }
      else
      {
        this->OutlineWinding += change;
      }
    }
  }

  /// Notes what the rings at an edge that was crossed enclose.
  void LookAround(HalfEdgeId side)
  {
    for (std::int64_t i = this->Last[EdgeOf(side)]; i != None; i = this->Walls[i].Before)
    {
      const std::int32_t number = this->Walls[i].Ring;
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

  const PointMeshView& Mesh;
  const std::int32_t FirstHole;
  std::map<std::int32_t, Ring> Rings; ///< By their numbers.
  std::vector<Wall> Walls;
  std::vector<std::int64_t> Last; ///< By edge: its last wall.
  /// How often the rings of a set wind around the triangle at hand, all together.
  std::int64_t OutlineWinding = 0, HoleWinding = 0;
  bool AnyIsCounterClockwise = false; ///< Whether an outline is.
};

/// Finds the triangle that each seed is in. It is the first of several, and NoTriangle if there is
/// none. @param getSeed returns a seed's place. @param side the orientation of triangles, 1 or -1.
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
    PlanePoint corners[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      corners[slot] = mesh.GetPoint(mesh.Edges.Triangles[t].Vertices[slot]);
    }
    const auto [left, right] = std::minmax({ corners[0].U, corners[1].U, corners[2].U });
    auto next = std::lower_bound(order.begin(), order.end(), left,
      [&](std::int64_t seed, double x) { return getSeed(seed).U < x; });
    for (; next != order.end() && getSeed(*next).U <= right; ++next)
    {
      bool isInside = found[*next] == NoTriangle;
      for (int slot = 0; slot < 3 && isInside; ++slot)
      {
        const PlanePoint &from = corners[slot], &to = corners[NextSlot(slot)];
        isInside = side * FindOrientation(from, to, getSeed(*next)) >= 0;
      }
      if (isInside)
      {
        found[*next] = static_cast<TriangleId>(t);
      }
    }
  }
  return found;
}

class Remover
{
public:
  Remover(const PointMeshView& mesh, const std::vector<SegmentEdge>& segments)
    : Remover(mesh, segments, std::vector<unsigned char>(mesh.NumberOfTriangles, 0))
  {
  }
  Remover(const PointMeshView& mesh, const std::vector<SegmentEdge>& segments,
    std::vector<unsigned char> isRemoved)
    : Mesh(mesh),
      Segments(segments),
      IsRemoved(std::move(isRemoved))
  {
  }

  /// Also tells which rings are left out.
  void RemoveOutside(const PointInput& input, RingRuleKind rule, KeptTriangles& kept)
  {
    const RingMap rings = ListRings(this->Segments, input.FirstHole, kept);
    RingWalk walk(this->Mesh, rings, input.FirstHole);
    if (walk.HasRings())
    {
      this->IsRemoved = walk.FindOutside(rule);
    }
    kept.RingsWithoutArea = walk.ListRingsWithoutArea();
    if (walk.HasRings() && !walk.HasOutline())
    {
      kept.HolePointsOutside = this->CountHolePointsOutside(input);
    }
  }

  /// Removes what can be reached from the seeds without crossing a segment. @returns how many seeds
  /// are in no triangle.
  std::int64_t RemoveHoles(const double* seeds, std::int64_t count)
  {
    const auto getSeed = [=](std::int64_t i) {
      return PlanePoint{ seeds[2 * i], seeds[2 * i + 1], 0.0 };
    };
    std::vector<TriangleId> stack =
      FindTriangles(this->Mesh, count, getSeed, 1, [](std::int64_t) { return true; });
    const std::int64_t outside = std::count(stack.begin(), stack.end(), NoTriangle);
    stack.erase(std::remove(stack.begin(), stack.end(), NoTriangle), stack.end());
    while (!stack.empty())
    {
      const TriangleId triangle = stack.back();
      stack.pop_back();
      this->IsRemoved[triangle] = 1;
      for (const HalfEdgeId side : this->Mesh.Edges.Triangles[triangle].HalfEdges)
      {
        const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
        if (!this->Mesh.IsFixed(side) && this->IsRemoved[TriangleOf(across)] == 0)
        {
          stack.push_back(TriangleOf(across));
        }
      }
    }
    return outside;
  }

  /// Removes large triangles without segments.
  void RemoveLarge(double alpha, double longestEdge)
  {
    std::vector<unsigned char> isSegment(this->Mesh.NumberOfEdges, 0);
    for (const SegmentEdge& segment : this->Segments)
    {
      isSegment[EdgeOf(segment.Side)] = 1;
    }
    for (std::int64_t t = 0; t < this->Mesh.NumberOfTriangles; ++t)
    {
      const TriangleRecord& triangle = this->Mesh.Edges.Triangles[t];
      const bool stays = std::any_of(std::begin(triangle.HalfEdges), std::end(triangle.HalfEdges),
        [&](HalfEdgeId side) { return isSegment[EdgeOf(side)] != 0; });
      if (!stays && this->IsLarge(triangle, alpha, longestEdge))
      {
        this->IsRemoved[t] = 1;
      }
    }
  }

  std::int64_t CountRemoved() const
  {
    return std::count(this->IsRemoved.begin(), this->IsRemoved.end(), 1);
  }

  /// Numbers what is left in the order of the slots, and measures it.
  /// @param firstAdded see PointInput.
  void Number(std::int64_t firstAdded, KeptTriangles& kept) const
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    kept.Numbers.assign(triangles, 0);
    std::vector<unsigned char> isUsed(this->Mesh.NumberOfPlaces, 0);
    for (std::int64_t t = 0; t < triangles; ++t)
    {
      const TriangleRecord& triangle = this->Mesh.Edges.Triangles[t];
      kept.Numbers[triangle.InputTriangle] = this->IsRemoved[t];
      if (this->IsRemoved[t] == 0)
      {
        const std::array<Vector3, 3> corners = this->GetCorners(triangle);
        kept.Angles.Add(
          MeasureSquaredCotangent(corners[0], corners[1], corners[2], this->Mesh.Range));
        for (const VertexId vertex : triangle.Vertices)
        {
          isUsed[vertex] = 1;
        }
      }
    }
    for (std::int32_t& number : kept.Numbers)
    {
      const bool isRemoved = number != 0;
      number = -1;
      if (!isRemoved)
      {
        number = static_cast<std::int32_t>(kept.Count++);
      }
    }
    for (std::int64_t e = 0; e < this->Mesh.NumberOfEdges; ++e)
    {
      const int sides = this->CountKept(static_cast<EdgeId>(e));
      kept.Edges += sides > 0 ? 1 : 0;
      kept.Boundary += sides == 1 ? 1 : 0;
    }
    for (std::int64_t place = 0; place < this->Mesh.NumberOfPlaces; ++place)
    {
      kept.Used += isUsed[place];
      if (static_cast<std::int64_t>(this->Mesh.Ids[place]) < firstAdded)
      {
        kept.UsedGiven += isUsed[place];
      }
    }
    kept.EulerCharacteristic = kept.Used - kept.Edges + kept.Count;
  }

  /// Drops the segments that are no edges of what is left.
  std::vector<SegmentEdge> ListKeptSegments() const
  {
    std::vector<SegmentEdge> kept;
    for (SegmentEdge segment : this->Segments)
    {
      const int triangles = this->CountKept(EdgeOf(segment.Side));
      segment.IsOnBoundary = triangles == 1;
      if (triangles > 0)
      {
        kept.push_back(segment);
      }
    }
    return kept;
  }

private:
  /// How many corners of the hull belong to holes alone. Without them the hull would be smaller.
  std::int64_t CountHolePointsOutside(const PointInput& input) const
  {
    std::vector<unsigned char> isOfHole(this->Mesh.NumberOfPlaces, 0);
    for (const SegmentEdge& segment : this->Segments)
    {
      for (const VertexId place :
        { this->Mesh.GetStart(segment.Side), this->Mesh.GetEnd(segment.Side) })
      {
        const bool isAdded = static_cast<std::int64_t>(this->Mesh.Ids[place]) >= input.FirstAdded;
        const bool isMark = isAdded && segment.Ring >= input.FirstHole;
        isOfHole[place] |= isMark ? 1 : 0;
      }
    }
    std::map<VertexId, VertexId> next; // along the hull, from place to place
    for (HalfEdgeId side = 0; side < 2 * this->Mesh.NumberOfEdges; ++side)
    {
      if (this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u] == NoCorner)
      {
        next[this->Mesh.GetStart(side)] = this->Mesh.GetEnd(side);
      }
    }
    std::int64_t count = 0;
    for (const auto& [start, place] : next)
    {
      const auto after = next.find(place);
      const bool isBend = after != next.end() && isOfHole[place] != 0 &&
        FindOrientation(this->Mesh.GetPoint(start), this->Mesh.GetPoint(place),
          this->Mesh.GetPoint(after->second)) != 0;
      count += isBend ? 1 : 0;
    }
    return count;
  }

  /// How many triangles of an edge are kept.
  int CountKept(EdgeId edge) const
  {
    const CornerId* corners =
      this->Mesh.Edges.CornerOfHalfEdge + 2 * static_cast<std::size_t>(edge);
    return static_cast<int>(std::count_if(corners, corners + 2,
      [this](CornerId corner)
      { return corner != NoCorner && this->IsRemoved[TriangleOf(corner)] == 0; }));
  }

  std::array<Vector3, 3> GetCorners(const TriangleRecord& triangle) const
  {
    std::array<Vector3, 3> corners;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint place = this->Mesh.GetPoint(triangle.Vertices[slot]);
      corners[slot] = { place.U, place.V, 0.0 };
    }
    return corners;
  }

  bool IsLarge(const TriangleRecord& triangle, double alpha, double longestEdge) const
  {
    const auto [a, b, c] = this->GetCorners(triangle);
    const double ab = PlaneLength(b.X - a.X, b.Y - a.Y);
    const double bc = PlaneLength(c.X - b.X, c.Y - b.Y);
    const double ca = PlaneLength(a.X - c.X, a.Y - c.Y);
    if (longestEdge > 0.0 && std::max({ ab, bc, ca }) > longestEdge)
    {
      return true;
    }
    // The circumradius is half of a side over the sine of the opposite angle.
    const double sine =
      ((b.X - a.X) / ab) * ((c.Y - a.Y) / ca) - ((b.Y - a.Y) / ab) * ((c.X - a.X) / ca);
    return alpha > 0.0 && !(0.5 * bc <= alpha * sine);
  }

  const PointMeshView& Mesh;
  const std::vector<SegmentEdge>& Segments;
  std::vector<unsigned char> IsRemoved;
};
}

bool MayRemove(const PointInput& input, const PointOptions& options)
{
  return input.Rings || input.NumberOfHoleSeeds > 0 || options.Alpha > 0.0 ||
    options.LongestEdge > 0.0;
}

KeptTriangles KeepTriangles(const PointMeshView& mesh, const PointInput& input,
  const PointOptions& options, std::vector<SegmentEdge>& segments)
{
  KeptTriangles kept;
  Remover remover(mesh, segments);
  remover.RemoveOutside(input, options.RingRule, kept);
  if (input.NumberOfHoleSeeds > 0)
  {
    kept.SeedsOutside = remover.RemoveHoles(input.HoleSeeds, input.NumberOfHoleSeeds);
  }
  kept.Outside = remover.CountRemoved();
  if (options.Alpha > 0.0 || options.LongestEdge > 0.0)
  {
    remover.RemoveLarge(options.Alpha, options.LongestEdge);
  }
  kept.Large = remover.CountRemoved() - kept.Outside;
  if (kept.Outside + kept.Large > 0)
  {
    remover.Number(input.FirstAdded, kept);
  }
  segments = remover.ListKeptSegments();
  return kept;
}

void RenumberTriangles(const PointMeshView& mesh, std::vector<unsigned char> isRemoved,
  std::int64_t firstAdded, std::vector<SegmentEdge>& segments, KeptTriangles& kept)
{
  kept.Count = 0;
  kept.Used = 0;
  kept.UsedGiven = 0;
  kept.Edges = 0;
  kept.Boundary = 0;
  kept.Angles = AngleSums();
  const Remover remover(mesh, segments, std::move(isRemoved));
  remover.Number(firstAdded, kept);
  segments = remover.ListKeptSegments();
}

std::int64_t SpreadSeeds(const PointMeshView& mesh, const RegionSeed* seeds, std::int64_t count,
  int side, std::vector<std::int32_t>& regions)
{
  const auto getSeed = [&](std::int64_t i) { return PlanePoint{ seeds[i].X, seeds[i].Y, 0.0 }; };
  const std::vector<TriangleId> starts =
    FindTriangles(mesh, count, getSeed, side, [&](std::int64_t t) { return regions[t] >= 0; });
  std::vector<TriangleId> stack;
  for (std::size_t i = 0; i < starts.size(); ++i)
  {
    const auto enter = [&](TriangleId triangle)
    {
      if (regions[triangle] == 0)
      {
        regions[triangle] = static_cast<std::int32_t>(i + 1);
        stack.push_back(triangle);
      }
    };
    if (starts[i] != NoTriangle)
    {
      enter(starts[i]);
    }
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
  return std::count(starts.begin(), starts.end(), NoTriangle);
}

std::vector<std::int32_t> FindRegions(const PointMeshView& mesh, const PointInput& input,
  const KeptTriangles& kept, std::int64_t& seedsOutside)
{
  std::vector<std::int32_t> regions(mesh.NumberOfTriangles, 0);
  for (std::size_t t = 0; t < kept.Numbers.size(); ++t)
  {
    const TriangleId slot = mesh.Edges.Triangles[t].InputTriangle;
    regions[t] = kept.Numbers[slot] < 0 ? -1 : 0;
  }
  seedsOutside = SpreadSeeds(mesh, input.Regions, input.NumberOfRegions, 1, regions);
  return regions;
}

}
