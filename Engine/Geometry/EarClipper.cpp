// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EarClipper.h"

#include "FilteredPredicates.h"
#include "PortableMath.h"
#include "Predicates.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace delaunayflip
{
namespace
{

/// Whether a side of a convex polygon certainly separates it from the points.
template <std::size_t Sides, std::size_t Count>
bool HasSeparatingSide(
  const std::array<PlanePoint, Sides>& polygon, const std::array<PlanePoint, Count>& points)
{
  bool separates = false;
  for (std::size_t i = 0; i < Sides && !separates; ++i)
  {
    separates = std::all_of(points.begin(), points.end(),
      [&](const PlanePoint& point)
      { return FilteredOrientation(polygon[i], polygon[(i + 1) % Sides], point) < 0; });
  }
  return separates;
}

/// The vertices of a polygon that are left, and a search for one of them in a triangle.
///
/// A k-d tree that is balanced from the start. A node has a rectangle around its vertices, along
/// the line between two of them that are far apart: long thin triangles along thin chains would
/// meet most boxes. It is fitted again as vertices are removed.
class VertexTree
{
public:
  static constexpr std::int64_t Nobody = -1;

  explicit VertexTree(const std::vector<PlaneVector>& vertices)
    : Vertices(vertices),
      PlaceOf(vertices.size(), Nobody)
  {
    double largest = 0.0;
    for (std::int64_t v = 0; v < this->CountVertices(); ++v)
    {
      if (IsFinite(vertices[v][0]) && IsFinite(vertices[v][1]))
      {
        this->Order.push_back(v);
        largest = std::max({ largest, std::fabs(vertices[v][0]), std::fabs(vertices[v][1]) });
      }
    }
    this->Broken = this->CountVertices() - static_cast<std::int64_t>(this->Order.size());
    // A power of two brings the largest coordinate to 1 .. 2. What underflows changes by less than
    // the filters allow for.
    const int exponent = -ExponentOf(largest);
    for (const PlaneVector& v : vertices)
    {
      this->Scaled.push_back({ std::scalbn(v[0], exponent), std::scalbn(v[1], exponent), 0.0 });
    }
    this->IsLeft.resize(this->Order.size(), true);
    std::size_t leaves = 1;
    for (std::size_t size = this->Order.size(); size > LeafSize; size = (size + 1) / 2)
    {
      leaves *= 2;
    }
    this->Nodes.resize(2 * leaves);
    this->MakeNodes(this->GetRoot());
    for (std::size_t place = 0; place < this->Order.size(); ++place)
    {
      this->PlaceOf[this->Order[place]] = static_cast<std::int64_t>(place);
    }
  }

  /// Removes a vertex. Fits leaves again, and other nodes when half of their vertices are gone, so
  /// that all removals together take n log^2 n steps.
  void Remove(std::int64_t vertex)
  {
    const std::int64_t place = this->PlaceOf[vertex];
    if (place == Nobody)
    {
      --this->Broken;
      return;
    }
    this->IsLeft[place] = false;
    NodeRange range = this->GetRoot();
    for (bool isLeaf = false; !isLeaf;)
    {
      Node& node = this->Nodes[range.Index];
      isLeaf = range.IsLeaf();
      --node.Left;
      if (isLeaf || 2 * node.Left <= node.LeftAtFit)
      {
        this->Fit(range);
      }
      range = range.GetChild(place >= range.GetMiddle());
    }
  }

  bool HasBroken() const { return this->Broken > 0; }

  /// Finds a vertex that is left and lies in the closed triangle but not at the place of a corner;
  /// or Nobody. If there are several, it finds one of them, scattered so that it is seldom the next
  /// to be removed.
  /// @param corners three vertices, counter-clockwise.
  std::int64_t FindInside(const std::array<std::int64_t, 3>& corners) const
  {
    const auto& [a, b, c] = corners;
    return this->Search(
      this->GetRoot(), { corners, { this->Scaled[a], this->Scaled[b], this->Scaled[c] } });
  }

  /// The number of nodes that all searches have visited, as a measure of time.
  std::int64_t GetVisits() const { return this->Visits; }

private:
  static constexpr std::int64_t LeafSize = 8;

  struct Node
  {
    std::array<PlanePoint, 4> Hull; ///< Counter-clockwise.
    PlanePoint Direction; ///< The direction of its first side.
    std::int64_t OnlyPlace; ///< A vertex, if all are at the same place; else Nobody.
    std::int64_t Left; ///< Vertices.
    std::int64_t LeftAtFit;
  };

  /// A node with its part of Order, [Begin, End). Its children are 2 * Index and 2 * Index + 1.
  struct NodeRange
  {
    std::int64_t Index, Begin, End;

    bool IsLeaf() const { return this->End - this->Begin <= LeafSize; }
    std::int64_t GetMiddle() const { return (this->Begin + this->End) / 2; }
    NodeRange GetChild(bool second) const
    {
      if (second)
      {
        return { 2 * this->Index + 1, this->GetMiddle(), this->End };
      }
      return { 2 * this->Index, this->Begin, this->GetMiddle() };
    }
  };

  struct Triangle
  {
    std::array<std::int64_t, 3> Corners;
    std::array<PlanePoint, 3> Points;
  };

  std::int64_t CountVertices() const { return static_cast<std::int64_t>(this->Vertices.size()); }
  NodeRange GetRoot() const { return { 1, 0, static_cast<std::int64_t>(this->Order.size()) }; }

  static double Along(const PlanePoint& direction, const PlanePoint& p)
  {
    return direction.U * p.U + direction.V * p.V;
  }

  /// Divides the vertices in halves along the hulls, recursively.
  void MakeNodes(const NodeRange& range)
  {
    this->Nodes[range.Index].Left = range.End - range.Begin;
    this->Fit(range);
    if (!range.IsLeaf())
    {
      const PlanePoint direction = this->Nodes[range.Index].Direction;
      const auto begin = this->Order.begin();
      std::nth_element(begin + range.Begin, begin + range.GetMiddle(), begin + range.End,
        [&](std::int64_t v, std::int64_t w)
        {
          const double first = Along(direction, this->Scaled[v]);
          const double second = Along(direction, this->Scaled[w]);
          return std::tie(first, v) < std::tie(second, w);
        });
      this->MakeNodes(range.GetChild(false));
      this->MakeNodes(range.GetChild(true));
    }
  }

  /// Calls work(vertex) for the vertices of a node that are left.
  template <typename Work>
  void ForVertices(const NodeRange& range, const Work& work) const
  {
    for (std::int64_t place = range.Begin; place < range.End; ++place)
    {
      if (this->IsLeft[place])
      {
        work(this->Order[place]);
      }
    }
  }

  /// Along a direction: the extent of a node's vertices, and those at its ends.
  struct Extent
  {
    double Lower = INFINITY, Upper = -INFINITY;
    std::int64_t First = 0, Last = 0;

    double GetLength() const { return this->Upper - this->Lower; }
  };

  Extent FindExtent(const NodeRange& range, const PlanePoint& direction) const
  {
    Extent extent;
    this->ForVertices(range,
      [&](std::int64_t vertex)
      {
        const double at = Along(direction, this->Scaled[vertex]);
        if (at < extent.Lower)
        {
          extent.Lower = at;
          extent.First = vertex;
        }
        if (at > extent.Upper)
        {
          extent.Upper = at;
          extent.Last = vertex;
        }
      });
    return extent;
  }

  void Fit(const NodeRange& range)
  {
    Node& node = this->Nodes[range.Index];
    node.LeftAtFit = node.Left;
    if (node.Left == 0)
    {
      return;
    }
    const Extent u = this->FindExtent(range, { 1.0, 0.0, 0.0 });
    const Extent v = this->FindExtent(range, { 0.0, 1.0, 0.0 });
    const Extent& longer = v.GetLength() > u.GetLength() ? v : u;
    const PlanePoint& first = this->Scaled[longer.First];
    const PlanePoint& last = this->Scaled[longer.Last];
    const double length = PlaneLength(last.U - first.U, last.V - first.V);
    PlanePoint direction = { 1.0, 0.0, 0.0 };
    if (length > 0.0)
    {
      direction = { (last.U - first.U) / length, (last.V - first.V) / length, 0.0 };
    }
    const Extent along = this->FindExtent(range, direction);
    const Extent across = this->FindExtent(range, { -direction.V, direction.U, 0.0 });
    constexpr double Margin = 0x1p-47; // more than the rounding of all these numbers, below 4
    const auto place = [&](double s, double t) {
      return PlanePoint{ direction.U * s - direction.V * t, direction.V * s + direction.U * t,
        0.0 };
    };
    node.Direction = direction;
    node.Hull = { place(along.Lower - Margin, across.Lower - Margin),
      place(along.Upper + Margin, across.Lower - Margin),
      place(along.Upper + Margin, across.Upper + Margin),
      place(along.Lower - Margin, across.Upper + Margin) };
    node.OnlyPlace = u.First;
    this->ForVertices(range,
      [&](std::int64_t vertex)
      {
        if (this->Vertices[vertex] != this->Vertices[u.First])
        {
          node.OnlyPlace = Nobody;
        }
      });
  }

  std::uint64_t Scatter() const
  {
    return static_cast<std::uint64_t>(this->Visits) * 0x9E3779B97F4A7C15u;
  }

  bool IsAtCorner(std::int64_t vertex, const Triangle& triangle) const
  {
    return std::any_of(triangle.Corners.begin(), triangle.Corners.end(),
      [&](std::int64_t corner) { return this->Vertices[corner] == this->Vertices[vertex]; });
  }

  /// Visits the children of a node in another order at every call.
  std::int64_t Search(const NodeRange& range, const Triangle& triangle) const
  {
    ++this->Visits;
    const Node& node = this->Nodes[range.Index];
    if (node.Left == 0 || HasSeparatingSide(triangle.Points, node.Hull) ||
      HasSeparatingSide(node.Hull, triangle.Points) ||
      (node.OnlyPlace != Nobody && this->IsAtCorner(node.OnlyPlace, triangle)))
    {
      return Nobody;
    }
    if (range.IsLeaf())
    {
      std::int64_t found = Nobody;
      this->ForVertices(range,
        [&](std::int64_t vertex)
        {
          if (this->IsInside(vertex, triangle))
          {
            found = vertex;
          }
        });
      return found;
    }
    const bool secondFirst = this->Scatter() >> 63 != 0;
    const std::int64_t found = this->Search(range.GetChild(secondFirst), triangle);
    if (found != Nobody)
    {
      return found;
    }
    return this->Search(range.GetChild(!secondFirst), triangle);
  }

  bool IsInside(std::int64_t vertex, const Triangle& triangle) const
  {
    const std::array<PlanePoint, 1> scaled = { this->Scaled[vertex] };
    if (HasSeparatingSide(triangle.Points, scaled) || this->IsAtCorner(vertex, triangle))
    {
      return false;
    }
    const auto orientation = [&](int from, int to)
    {
      return Orientation(this->Vertices[triangle.Corners[from]].data(),
        this->Vertices[triangle.Corners[to]].data(), this->Vertices[vertex].data());
    };
    return orientation(0, 1) >= 0 && orientation(1, 2) >= 0 && orientation(2, 0) >= 0;
  }

  const std::vector<PlaneVector>& Vertices;
  std::vector<PlanePoint> Scaled; ///< Vertices, scaled to about 1 for filters.
  std::vector<std::int64_t> Order; ///< The finite vertices, in the order of the leaves.
  std::vector<std::int64_t> PlaceOf; ///< The place of each vertex in Order, or Nobody.
  std::vector<bool> IsLeft; ///< By place.
  std::int64_t Broken; ///< Vertices left with a NaN or infinite coordinate.
  std::vector<Node> Nodes;
  mutable std::int64_t Visits = 0;
};

/// Not every vertex is tested each time. A vertex that is not an ear can become one only when a
/// neighbour is clipped or, if another vertex lies in its triangle, when that one is clipped. So
/// there are few tests, and each is a search in a tree: usually n log n steps in all.
class EarClipper
{
public:
  EarClipper(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress)
    : Polygon(polygon),
      Progress(progress),
      Tree(polygon),
      Left(static_cast<std::int64_t>(polygon.size())),
      BlockedBy(polygon.size())
  {
    for (std::int64_t i = 0; i < this->Left; ++i)
    {
      this->Next.push_back((i + 1) % this->Left);
      this->Previous.push_back((i + this->Left - 1) % this->Left);
      this->Candidates.insert(this->Candidates.end(), i);
    }
  }

  Triples Clip()
  {
    std::int64_t vertex = 0;
    while (this->Left > 3)
    {
      const std::int64_t ear = this->FindEar(vertex);
      if (this->IsStopped)
      {
        return {};
      }
      vertex = this->CutOff(ear);
    }
    this->Cut.push_back({ this->Previous[vertex], vertex, this->Next[vertex] });
    return std::move(this->Cut);
  }

private:
  /// Calls the observer from time to time. @returns whether to go on.
  bool ReportProgress()
  {
    constexpr std::int64_t VisitsBetweenCalls = std::int64_t(1) << 15; // about a millisecond
    if (this->Progress && this->Tree.GetVisits() - this->VisitsTold >= VisitsBetweenCalls)
    {
      this->VisitsTold = this->Tree.GetVisits();
      const auto left = static_cast<double>(this->Left);
      this->IsStopped = !this->Progress(1.0 - left / static_cast<double>(this->Polygon.size()));
    }
    return !this->IsStopped;
  }

  /// The first ear from a vertex on, all the way around; the vertex itself if there is none.
  std::int64_t FindEar(std::int64_t from)
  {
    while (!this->Candidates.empty() && !this->Tree.HasBroken() && this->ReportProgress())
    {
      auto next = this->Candidates.lower_bound(from);
      if (next == this->Candidates.end())
      {
        next = this->Candidates.begin();
      }
      if (this->IsEar(*next))
      {
        return *next;
      }
      this->Candidates.erase(next);
    }
    return from;
  }

  bool IsEar(std::int64_t vertex)
  {
    const std::array<std::int64_t, 3> triangle = { this->Previous[vertex], vertex,
      this->Next[vertex] };
    if (Orientation(this->Polygon[triangle[0]].data(), this->Polygon[triangle[1]].data(),
          this->Polygon[triangle[2]].data()) <= 0)
    {
      return false;
    }
    const std::int64_t inside = this->Tree.FindInside(triangle);
    if (inside != VertexTree::Nobody)
    {
      this->BlockedBy[inside].push_back(vertex);
    }
    return inside == VertexTree::Nobody;
  }

  /// @returns the vertex after the next one, where the walk continues.
  std::int64_t CutOff(std::int64_t vertex)
  {
    const std::int64_t previous = this->Previous[vertex];
    const std::int64_t next = this->Next[vertex];
    this->Cut.push_back({ previous, vertex, next });
    this->Next[previous] = next;
    this->Previous[next] = previous;
    this->Next[vertex] = VertexTree::Nobody;
    --this->Left;
    this->Tree.Remove(vertex);
    this->Candidates.erase(vertex);
    this->Candidates.insert({ previous, next });
    for (const std::int64_t blocked : std::exchange(this->BlockedBy[vertex], {}))
    {
      if (this->Next[blocked] != VertexTree::Nobody)
      {
        this->Candidates.insert(blocked);
      }
    }
    return this->Next[next];
  }

  const std::vector<PlaneVector>& Polygon;
  const ProgressObserver& Progress;
  VertexTree Tree;
  std::int64_t Left; ///< Vertices.
  std::vector<std::int64_t> Next; ///< The next vertex; Nobody for one that was cut off.
  std::vector<std::int64_t> Previous;
  std::set<std::int64_t> Candidates; ///< Vertices that may be ears.
  std::vector<std::vector<std::int64_t>>
    BlockedBy; ///< The vertices that each keeps from being ears.
  Triples Cut;
  std::int64_t VisitsTold = 0; ///< When the observer was last asked.
  bool IsStopped = false;
};

}

Triples ClipEars(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress)
{
  return EarClipper(polygon, progress).Clip();
}

}
