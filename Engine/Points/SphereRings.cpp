// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereRings.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace delaunayflip
{

namespace
{
constexpr double SphereArea = 4.0 * Pi;

/// The angle of a vector, from -pi to pi, with the same bits on all systems. Its error is below
/// 1e-14.
double FindAngle(double x, double y)
{
  // Half angles, by roots, are small enough for a short series.
  constexpr int Halvings = 5;
  for (int i = 0; i < Halvings; ++i)
  {
    const double length = std::sqrt(x * x + y * y);
    if (!(length > 0.0))
    {
      return 0.0;
    }
    const double sum = x < 0.0 ? y * y / (length - x) : x + length; // their sum would cancel
    x = sum / length;
    y /= length;
    if (x == 0.0) // half a turn
    {
      y = 1.0;
    }
  }
  const double t = y / x, square = t * t;
  double sum = 0.0;
  for (int power = 13; power > 0; power -= 2)
  {
    sum = 1.0 / power - square * sum;
  }
  return std::ldexp(t * sum, Halvings);
}

/// The area of a triangle on the unit sphere.
double FindArea(const PlanePoint& p, const PlanePoint& q, const PlanePoint& r)
{
  const Vector3 a = FindDirection(p), b = FindDirection(q), c = FindDirection(r);
  // The angle is half of the area, so it is from 0 to pi.
  const double angle =
    FindAngle(1.0 + Dot(a, b) + Dot(b, c) + Dot(c, a), Dot(a, Cross(b - a, c - a)));
  return 2.0 * std::fabs(angle);
}

/// Edges by their numbers, which are those of the sorted pairs of their ends.
class EdgeNumbers
{
public:
  explicit EdgeNumbers(const SphereMeshView& mesh)
    : IsEnd(mesh.Points.size())
  {
    for (const SphereEdge& edge : mesh.Edges)
    {
      this->Pairs.push_back(std::minmax({ edge.From, edge.To }));
      this->IsEnd[edge.From] = this->IsEnd[edge.To] = 1;
    }
    std::sort(this->Pairs.begin(), this->Pairs.end());
    this->Pairs.erase(std::unique(this->Pairs.begin(), this->Pairs.end()), this->Pairs.end());
  }

  std::size_t Count() const { return this->Pairs.size(); }

  /// The number of an edge, or -1 if it is of no segment.
  std::int32_t Find(std::int32_t from, std::int32_t to) const
  {
    if (this->IsEnd[from] == 0 || this->IsEnd[to] == 0)
    {
      return -1;
    }
    const std::pair<std::int32_t, std::int32_t> pair = std::minmax({ from, to });
    const auto found = std::lower_bound(this->Pairs.begin(), this->Pairs.end(), pair);
    const bool isThere = found != this->Pairs.end() && *found == pair;
    return isThere ? static_cast<std::int32_t>(found - this->Pairs.begin()) : -1;
  }

private:
  std::vector<std::pair<std::int32_t, std::int32_t>> Pairs;
  std::vector<char> IsEnd; ///< By point.
};

/// Sums for a set of rings, the outline or the holes.
struct RingSet
{
  std::vector<std::int64_t> Turns; ///< By edge; see RingEdge.
  std::int64_t Start = 0; ///< How often the rings wind around the first node.
  bool HasArea = false;
};

/// A tree of all triangles, each entered through a side of another one, in the order in which a
/// walk meets them. What lies beyond the boundary of an open mesh is a node, too, the first one.
class SphereTree
{
public:
  explicit SphereTree(const SphereMeshView& mesh)
    : Mesh(mesh),
      Numbers(mesh),
      NodeBehind(this->Numbers.Count(), None)
  {
    this->WalkAll();
    this->SumAreas();
  }

  /// Adds a ring to a set, so that it winds 0 times around its outside.
  /// @param ring its edges, sorted.
  void AddRing(const std::vector<RingEdge>& ring, RingSet& set) const
  {
    set.HasArea = set.HasArea || !ring.empty();
    set.Turns.resize(this->Numbers.Count());
    for (const RingEdge& edge : ring)
    {
      set.Turns[edge.Edge] += edge.Turns;
    }
    set.Start -= this->FindTurnsOutside(ring);
  }

  /// By node: how often the rings of a set wind around it.
  std::vector<std::int64_t> SumTurns(const RingSet& set) const
  {
    std::vector<std::int64_t> sums(this->Nodes.size(), set.Start);
    if (!set.HasArea)
    {
      return sums;
    }
    for (std::size_t i = 1; i < this->Nodes.size(); ++i)
    {
      const Node& node = this->Nodes[i];
      sums[i] = sums[node.Parent];
      if (node.Edge != None)
      {
        sums[i] += node.IsEven ? set.Turns[node.Edge] : -set.Turns[node.Edge];
      }
    }
    return sums;
  }

  /// The triangle of a node; -1: beyond the boundary.
  std::int32_t GetTriangle(std::size_t node) const { return this->Nodes[node].Triangle; }
  std::size_t CountNodes() const { return this->Nodes.size(); }

  std::int32_t FindEdge(std::int32_t from, std::int32_t to) const
  {
    return this->Numbers.Find(from, to);
  }

private:
  struct Node
  {
    std::int32_t Triangle, Parent;
    std::int32_t Edge; ///< The one that was crossed to get here, if it is of a segment, or None.
    bool IsEven; ///< Whether this is the side of the edge with the even number.
    std::int32_t End; ///< The node after all those below this one.
  };
  static constexpr std::int32_t None = -1;

  /// Enters a triangle through the side opposite to a corner.
  void Enter(std::int32_t corner, std::int32_t parent)
  {
    const std::int32_t first = corner - corner % 3;
    const std::int32_t from = this->Mesh.Triangles[first + (corner + 1) % 3];
    const std::int32_t to = this->Mesh.Triangles[first + (corner + 2) % 3];
    const std::int32_t edge = this->Numbers.Find(from, to);
    const auto node = static_cast<std::int32_t>(this->Nodes.size());
    this->Nodes.push_back({ first / 3, parent, edge, from < to, None });
    if (edge != None)
    {
      this->NodeBehind[edge] = node;
    }
  }

  void WalkAll()
  {
    const std::vector<std::int32_t>& neighbors = this->Mesh.Neighbors;
    const auto triangles = static_cast<std::int32_t>(neighbors.size() / 3);
    const auto boundary = std::find(neighbors.begin(), neighbors.end(), None);
    std::vector<unsigned char> sides(triangles); // how many sides of a triangle were looked at
    std::vector<char> isKnown(triangles);
    std::vector<std::int32_t> path;
    const auto enter = [&](std::int32_t corner, std::int32_t parent)
    {
      isKnown[corner / 3] = 1;
      path.push_back(static_cast<std::int32_t>(this->Nodes.size()));
      this->Enter(corner, parent);
    };
    if (boundary == neighbors.end())
    {
      isKnown[0] = 1;
      path.push_back(0);
      this->Nodes.push_back({ 0, None, None, false, None });
    }
    else
    {
      this->Nodes.push_back({ None, None, None, false, None });
      enter(static_cast<std::int32_t>(boundary - neighbors.begin()), 0);
    }
    while (!path.empty())
    {
      const std::int32_t node = path.back(), triangle = this->Nodes[node].Triangle;
      if (sides[triangle] == 3)
      {
        this->Nodes[node].End = static_cast<std::int32_t>(this->Nodes.size());
        path.pop_back();
        continue;
      }
      const std::int32_t corner = 3 * triangle + sides[triangle]++;
      const std::int32_t across = neighbors[corner];
      if (across != None && isKnown[across] == 0)
      {
        enter(this->FindCorner(across, triangle), node);
      }
    }
    this->Nodes[0].End = static_cast<std::int32_t>(this->Nodes.size());
  }

  /// The corner of a triangle that is opposite to the edge with another one.
  std::int32_t FindCorner(std::int32_t triangle, std::int32_t other) const
  {
    const std::int32_t* ids = &this->Mesh.Triangles[std::size_t(3) * triangle];
    const std::int32_t* others = &this->Mesh.Triangles[std::size_t(3) * other];
    std::int32_t slot = 0;
    while (slot < 2 && std::find(others, others + 3, ids[slot]) != others + 3)
    {
      ++slot;
    }
    return 3 * triangle + slot;
  }

  void SumAreas()
  {
    double sum = 0.0;
    for (const Node& node : this->Nodes)
    {
      this->AreaBefore.push_back(sum);
      if (node.Triangle != None)
      {
        const std::int32_t* ids = &this->Mesh.Triangles[std::size_t(3) * node.Triangle];
        sum +=
          FindArea(this->Mesh.Points[ids[0]], this->Mesh.Points[ids[1]], this->Mesh.Points[ids[2]]);
      }
    }
    this->AreaBefore.push_back(sum);
  }

  double GetArea(std::int32_t first, std::int32_t end) const
  {
    const bool hasOutside = first == 0 && this->Nodes[0].Triangle == None;
    const double beyond = hasOutside ? SphereArea - this->AreaBefore.back() : 0.0;
    return this->AreaBefore[end] - this->AreaBefore[first] + beyond;
  }

  /// How much more often a ring winds around its outside than around the first node. The outside is
  /// the part of the sphere with the largest area among those that the ring winds around equally
  /// often; of equal ones, the one to its right.
  std::int64_t FindTurnsOutside(const std::vector<RingEdge>& ring) const
  {
    struct Piece
    {
      std::int32_t Begin, End;
      std::int64_t Turns;
    };
    std::vector<Piece> crossed;
    for (const RingEdge& edge : ring)
    {
      const std::int32_t node = this->NodeBehind[edge.Edge];
      if (node != None)
      {
        const Node& behind = this->Nodes[node];
        crossed.push_back({ node, behind.End, behind.IsEven ? edge.Turns : -edge.Turns });
      }
    }
    std::sort(crossed.begin(), crossed.end(),
      [](const Piece& a, const Piece& b) { return a.Begin < b.Begin; });
    std::vector<Piece> above = { { 0, this->Nodes[0].End, 0 } };
    std::map<std::int64_t, double> areas;
    areas[0] = this->GetArea(0, this->Nodes[0].End);
    for (Piece piece : crossed)
    {
      while (above.back().End <= piece.Begin)
      {
        above.pop_back();
      }
      const double area = this->GetArea(piece.Begin, piece.End);
      areas[above.back().Turns] -= area;
      piece.Turns += above.back().Turns;
      areas[piece.Turns] += area;
      above.push_back(piece);
    }
    double largest = 0.0;
    for (const auto& [turns, area] : areas)
    {
      largest = std::max(largest, area);
    }
    constexpr double Rounding = 1e-9 * SphereArea;
    return std::find_if(areas.begin(), areas.end(),
      [&](const auto& item) { return item.second > largest - Rounding; })
      ->first;
  }

  const SphereMeshView& Mesh;
  const EdgeNumbers Numbers;
  std::vector<Node> Nodes;
  std::vector<std::int32_t> NodeBehind; ///< By edge, the node that was entered through it, or None.
  std::vector<double> AreaBefore; ///< By node, that of all nodes before; and that of all.
};

bool IsInside(RingRuleKind rule, std::int64_t turns, std::int64_t fewest)
{
  switch (rule)
  {
    case RingRuleKind::EvenOdd:
      return turns % 2 != 0;
    case RingRuleKind::NonZero:
      return turns != 0;
    case RingRuleKind::Orientation:
      break;
  }
  return turns > fewest;
}
}

std::vector<unsigned char> FindOutside(const SphereMeshView& mesh,
  const std::vector<std::int32_t>& rings, std::int32_t firstHole, RingRuleKind rule,
  KeptTriangles& kept)
{
  const SphereTree tree(mesh);
  std::vector<SegmentEdge> edges;
  for (const SphereEdge& edge : mesh.Edges)
  {
    const auto number = static_cast<HalfEdgeId>(tree.FindEdge(edge.From, edge.To));
    const HalfEdgeId side = 2 * number + (edge.From < edge.To ? 0 : 1); // the left one
    edges.push_back({ side, rings[edge.Segment], true, false, edge.IsFirst,
      static_cast<std::uint32_t>(edge.Segment) });
  }
  std::set<std::int32_t> withoutArea(rings.begin(), rings.end());
  withoutArea.erase(-1); // segments of no ring
  RingSet outline, holes;
  for (const auto& [number, ring] : ListRings(edges, firstHole, kept))
  {
    if (!ring.empty())
    {
      withoutArea.erase(number);
    }
    tree.AddRing(ring, number < firstHole ? outline : holes);
  }
  for (const std::int32_t repeated : kept.RepeatedRings)
  {
    withoutArea.erase(repeated);
  }
  kept.RingsWithoutArea.assign(withoutArea.begin(), withoutArea.end());
  const std::vector<std::int64_t> ofOutline = tree.SumTurns(outline),
                                  ofHoles = tree.SumTurns(holes);
  const std::int64_t fewest = *std::min_element(ofOutline.begin(), ofOutline.end());
  const RingRuleKind ruleOfHoles = rule == RingRuleKind::Orientation ? RingRuleKind::NonZero : rule;
  std::vector<unsigned char> isOutside(mesh.Triangles.size() / 3);
  for (std::size_t i = 0; i < tree.CountNodes(); ++i)
  {
    const bool isInHole = holes.HasArea && IsInside(ruleOfHoles, ofHoles[i], 0);
    const bool isKept = !outline.HasArea || IsInside(rule, ofOutline[i], fewest);
    const std::int32_t triangle = tree.GetTriangle(i);
    if (triangle >= 0)
    {
      isOutside[triangle] = isInHole || !isKept ? 1 : 0;
    }
  }
  return isOutside;
}

//------------------------------------------------------------------------------
namespace
{
/// The slot of a side of a triangle beyond which a place is, seen from the origin; 3: it is inside.
int FindSlotTowards(const SphereMeshView& mesh, std::int32_t triangle, const PlanePoint& place)
{
  const std::int32_t* ids = &mesh.Triangles[std::size_t(3) * triangle];
  int slot = 0;
  while (slot < 3 &&
    FindOrientation3D(
      mesh.Points[ids[(slot + 1) % 3]], mesh.Points[ids[(slot + 2) % 3]], place, Origin) >= 0)
  {
    ++slot;
  }
  return slot;
}

/// The triangle that a place is in, or -1. Walks towards it, and looks at all if the walk does not
/// end.
std::int32_t FindTriangle(const SphereMeshView& mesh, std::int32_t start, const PlanePoint& place)
{
  const auto triangles = static_cast<std::int32_t>(mesh.Triangles.size() / 3);
  std::int32_t t = start;
  for (std::int32_t steps = 0; t >= 0 && steps < triangles; ++steps)
  {
    const int slot = FindSlotTowards(mesh, t, place);
    if (slot == 3)
    {
      return t;
    }
    t = mesh.Neighbors[std::size_t(3) * t + slot];
  }
  for (t = 0; t < triangles; ++t)
  {
    if (FindSlotTowards(mesh, t, place) == 3)
    {
      return t;
    }
  }
  return -1;
}
}

std::int64_t RemoveAround(const SphereMeshView& mesh, const std::vector<PlanePoint>& seeds,
  std::vector<unsigned char>& isRemoved)
{
  const EdgeNumbers numbers(mesh);
  std::vector<std::int32_t> stack;
  std::int64_t outside = 0;
  std::int32_t last = 0;
  for (const PlanePoint& seed : seeds)
  {
    const std::int32_t found = mesh.Triangles.empty() ? -1 : FindTriangle(mesh, last, seed);
    if (found < 0)
    {
      ++outside;
      continue;
    }
    last = found;
    stack.push_back(found);
  }
  while (!stack.empty())
  {
    const std::int32_t triangle = stack.back();
    stack.pop_back();
    isRemoved[triangle] = 1;
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t first = 3 * triangle;
      const std::int32_t across = mesh.Neighbors[first + slot];
      const std::int32_t edge = numbers.Find(
        mesh.Triangles[first + (slot + 1) % 3], mesh.Triangles[first + (slot + 2) % 3]);
      if (across >= 0 && edge < 0 && isRemoved[across] == 0)
      {
        stack.push_back(across);
      }
    }
  }
  return outside;
}

}
