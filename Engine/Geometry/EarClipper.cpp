// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EarClipper.h"

#include "FilteredPredicates.h"
#include "Predicates.h"

#include <algorithm>
#include <cmath>
#include <set>
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

/// The vertices of a polygon that are left, and a search for one of them in a triangle: a k-d tree,
/// balanced from the start, whose nodes have the bounding box of their vertices.
class VertexTree
{
public:
  static constexpr std::int64_t Nobody = -1;

  explicit VertexTree(const std::vector<PlaneVector>& vertices)
    : Vertices(vertices),
      PlaceOf(vertices.size(), Nobody)
  {
    double largest = 0.0;
    for (std::int64_t v = 0; v < static_cast<std::int64_t>(vertices.size()); ++v)
    {
      if (IsFinite(vertices[v][0]) && IsFinite(vertices[v][1]))
      {
        this->Order.push_back(v);
        largest = std::max({ largest, std::fabs(vertices[v][0]), std::fabs(vertices[v][1]) });
      }
    }
    this->Broken = static_cast<std::int64_t>(vertices.size() - this->Order.size());
    // A power of two brings the largest coordinate to 1 .. 2. What underflows changes by less than
    // the filters allow for.
    this->Exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
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

  void Remove(std::int64_t vertex)
  {
    const std::int64_t place = this->PlaceOf[vertex];
    if (place == Nobody)
    {
      --this->Broken;
      return;
    }
    this->IsLeft[place] = false;
    this->FitAbove(this->GetRoot(), place);
  }

  bool HasBroken() const { return this->Broken > 0; }

  /// A vertex that is left and lies in the closed triangle but not at the place of a corner; or
  /// Nobody. If there are several, one of them, scattered so that it is seldom the next to be
  /// removed.
  /// @param corners three vertices that turn left.
  std::int64_t FindInside(const std::array<std::int64_t, 3>& corners) const
  {
    Triangle triangle{ corners, {}, {} };
    for (int i = 0; i < 3; ++i)
    {
      triangle.Points[i] = this->Scale(this->Vertices[corners[i]]);
      triangle.Around.Add({ this->Vertices[corners[i]], this->Vertices[corners[i]] });
    }
    return this->Search(this->GetRoot(), triangle);
  }

  /// The number of nodes that all searches have visited, as a measure of time.
  std::int64_t GetVisits() const { return this->Visits; }

private:
  static constexpr std::int64_t LeafSize = 16;

  /// If it is empty, Lower exceeds Upper.
  struct Box
  {
    PlaneVector Lower{ INFINITY, INFINITY }, Upper{ -INFINITY, -INFINITY };

    void Add(const Box& other)
    {
      for (int axis = 0; axis < 2; ++axis)
      {
        this->Lower[axis] = std::min(this->Lower[axis], other.Lower[axis]);
        this->Upper[axis] = std::max(this->Upper[axis], other.Upper[axis]);
      }
    }
    bool Meets(const Box& other) const
    {
      return this->Lower[0] <= other.Upper[0] && other.Lower[0] <= this->Upper[0] &&
        this->Lower[1] <= other.Upper[1] && other.Lower[1] <= this->Upper[1];
    }
  };

  /// A node with its part of Order, [Begin, End). Its children are 2 * Index and 2 * Index + 1.
  struct NodeRange
  {
    std::int64_t Index, Begin, End;

    bool IsLeaf() const { return this->End - this->Begin <= LeafSize; }
    std::int64_t GetMiddle() const { return (this->Begin + this->End) / 2; }
    NodeRange GetLeft() const { return { 2 * this->Index, this->Begin, this->GetMiddle() }; }
    NodeRange GetRight() const { return { 2 * this->Index + 1, this->GetMiddle(), this->End }; }
  };

  struct Triangle
  {
    std::array<std::int64_t, 3> Corners;
    std::array<PlanePoint, 3> Points;
    Box Around;
  };

  NodeRange GetRoot() const { return { 1, 0, static_cast<std::int64_t>(this->Order.size()) }; }

  PlanePoint Scale(const PlaneVector& v) const
  {
    return { std::scalbn(v[0], this->Exponent), std::scalbn(v[1], this->Exponent), 0.0 };
  }

  /// Divides the vertices in halves along the longer axis, recursively.
  void MakeNodes(const NodeRange& range)
  {
    if (!range.IsLeaf())
    {
      const auto begin = this->Order.begin();
      Box box;
      std::for_each(begin + range.Begin, begin + range.End,
        [&](std::int64_t v) {
          box.Add({ this->Vertices[v], this->Vertices[v] });
        });
      const int axis =
        0.5 * box.Upper[1] - 0.5 * box.Lower[1] > 0.5 * box.Upper[0] - 0.5 * box.Lower[0] ? 1 : 0;
      std::nth_element(begin + range.Begin, begin + range.GetMiddle(), begin + range.End,
        [&](std::int64_t v, std::int64_t w)
        { return this->Vertices[v][axis] < this->Vertices[w][axis]; });
      this->MakeNodes(range.GetLeft());
      this->MakeNodes(range.GetRight());
    }
    this->Fit(range);
  }

  /// Finds the box of a node; those of its children are known.
  void Fit(const NodeRange& range)
  {
    Box& box = this->Nodes[range.Index] = {};
    if (range.IsLeaf())
    {
      for (std::int64_t place = range.Begin; place < range.End; ++place)
      {
        if (this->IsLeft[place])
        {
          const PlaneVector& at = this->Vertices[this->Order[place]];
          box.Add({ at, at });
        }
      }
      return;
    }
    for (const std::int64_t child : { 2 * range.Index, 2 * range.Index + 1 })
    {
      box.Add(this->Nodes[child]);
    }
  }

  void FitAbove(const NodeRange& range, std::int64_t place)
  {
    if (!range.IsLeaf())
    {
      this->FitAbove(place < range.GetMiddle() ? range.GetLeft() : range.GetRight(), place);
    }
    this->Fit(range);
  }

  bool IsAtCorner(const PlaneVector& place, const Triangle& triangle) const
  {
    return std::any_of(triangle.Corners.begin(), triangle.Corners.end(),
      [&](std::int64_t corner) { return this->Vertices[corner] == place; });
  }

  /// Visits the children of a node in another order at every call.
  std::int64_t Search(const NodeRange& range, const Triangle& triangle) const
  {
    ++this->Visits;
    const auto& [lower, upper] = this->Nodes[range.Index];
    if (!this->Nodes[range.Index].Meets(triangle.Around) ||
      HasSeparatingSide(triangle.Points,
        std::array<PlanePoint, 4>{ this->Scale(lower), this->Scale({ upper[0], lower[1] }),
          this->Scale(upper), this->Scale({ lower[0], upper[1] }) }) ||
      (lower == upper && this->IsAtCorner(lower, triangle)))
    {
      return Nobody;
    }
    std::int64_t found = Nobody;
    if (range.IsLeaf())
    {
      for (std::int64_t place = range.Begin; place < range.End; ++place)
      {
        const std::int64_t v = this->Order[place];
        found = this->IsLeft[place] && this->IsInside(v, triangle) ? v : found;
      }
      return found;
    }
    const bool right = (static_cast<std::uint64_t>(this->Visits) * 0x9E3779B97F4A7C15u) >> 63 != 0;
    found = this->Search(right ? range.GetRight() : range.GetLeft(), triangle);
    return found != Nobody ? found
                           : this->Search(right ? range.GetLeft() : range.GetRight(), triangle);
  }

  bool IsInside(std::int64_t vertex, const Triangle& triangle) const
  {
    const PlaneVector& at = this->Vertices[vertex];
    const std::array<PlanePoint, 1> scaled = { this->Scale(at) };
    if (HasSeparatingSide(triangle.Points, scaled) || this->IsAtCorner(at, triangle))
    {
      return false;
    }
    const auto turn = [&](int from, int to)
    {
      return Orientation(this->Vertices[triangle.Corners[from]].data(),
        this->Vertices[triangle.Corners[to]].data(), at.data());
    };
    return turn(0, 1) >= 0 && turn(1, 2) >= 0 && turn(2, 0) >= 0;
  }

  const std::vector<PlaneVector>& Vertices;
  int Exponent; ///< 2^Exponent brings them near 1, for filters.
  std::vector<std::int64_t> Order; ///< The finite vertices, in the order of the leaves.
  std::vector<std::int64_t> PlaceOf; ///< Of every vertex in Order; or Nobody.
  std::vector<bool> IsLeft; ///< By place.
  std::int64_t Broken; ///< Vertices left with a NaN or infinite coordinate.
  std::vector<Box> Nodes;
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
      next = next == this->Candidates.end() ? this->Candidates.begin() : next;
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
