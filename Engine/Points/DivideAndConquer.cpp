// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DivideAndConquer.h"

#include "ExactPredicates.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delaunayflip
{

namespace
{
using Edge = std::uint32_t; ///< A directed edge; e ^ 1 runs the other way.
constexpr Edge None = ~Edge(0);

/// Of a set of points, hull edges that leave its first point counter-clockwise and its last point
/// clockwise, and the edges that are not used.
struct Part
{
  Edge First, Last;
  Edge FreeHead = None, FreeTail = None; ///< Linked by Next.
};

class Divider
{
public:
  Divider(const std::vector<CoordinatePair<double>>& places, const TaskRunner& run)
    : Run(run),
      Order(places.size()),
      Places(places.size()),
      Origin(6 * places.size()),
      Next(6 * places.size()),
      Previous(6 * places.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), 0u);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      this->Places[i] = { places[i].U, places[i].V, 0.0 };
    }
  }

  DividedPoints Solve()
  {
    const auto size = static_cast<std::uint32_t>(this->Order.size());
    // The top of the recursion is level by level, so that the parts of a level run side by side.
    std::vector<std::vector<std::uint32_t>> levels{ { 0, size } };
    constexpr std::uint32_t SmallestTask = 1 << 13;
    while (size >> (levels.size() - 1) > SmallestTask)
    {
      const std::vector<std::uint32_t>& cuts = levels.back();
      std::vector<std::uint32_t> finer(2 * cuts.size() - 1);
      const int axis = static_cast<int>(levels.size() - 1) % 2;
      this->Run(static_cast<std::int64_t>(cuts.size()) - 1,
        [&](std::int64_t i)
        {
          finer[2 * i] = cuts[i];
          finer[2 * i + 1] = this->Cut(cuts[i], cuts[i + 1], axis);
        });
      finer.back() = size;
      levels.push_back(finer);
    }
    std::vector<Part> parts(levels.back().size() - 1);
    int axis = static_cast<int>(levels.size() - 1) % 2;
    this->Run(static_cast<std::int64_t>(parts.size()),
      [&](std::int64_t i)
      { parts[i] = this->Solve(levels.back()[i], levels.back()[i + 1], axis); });
    while (parts.size() > 1)
    {
      axis = 1 - axis;
      std::vector<Part> merged(parts.size() / 2);
      this->Run(static_cast<std::int64_t>(merged.size()),
        [&](std::int64_t i) { merged[i] = this->Merge(parts[2 * i], parts[2 * i + 1], axis); });
      parts = std::move(merged);
    }
    return this->Collect(parts.front());
  }

private:
  /// By (x, y), or by (y, -x): the same order turned by a quarter.
  bool IsBefore(std::uint32_t a, std::uint32_t b, int axis) const
  {
    const PlanePoint& p = this->Places[a];
    const PlanePoint& q = this->Places[b];
    return axis == 0 ? (p.U != q.U ? p.U < q.U : p.V < q.V) : (p.V != q.V ? p.V < q.V : p.U > q.U);
  }

  std::uint32_t Cut(std::uint32_t begin, std::uint32_t end, int axis)
  {
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(this->Order.begin() + begin, this->Order.begin() + middle,
      this->Order.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) { return this->IsBefore(a, b, axis); });
    return middle;
  }

  std::uint32_t Destination(Edge e) const { return this->Origin[e ^ 1]; }

  int Turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    return FindOrientation(this->Places[a], this->Places[b], this->Places[c]);
  }
  bool IsLeftOf(std::uint32_t point, Edge e) const
  {
    return this->Turn(point, this->Origin[e], this->Destination(e)) > 0;
  }
  bool IsRightOf(std::uint32_t point, Edge e) const
  {
    return this->Turn(point, this->Destination(e), this->Origin[e]) > 0;
  }

  bool IsInCircle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const
  {
    const PlanePoint points[4] = { this->Places[a], this->Places[b], this->Places[c],
      this->Places[d] };
    const int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    const bool certain = sign != UncertainSign && IsInFilterRange(points[0]) &&
      IsInFilterRange(points[1]) && IsInFilterRange(points[2]) && IsInFilterRange(points[3]);
    return (certain ? sign : ExactInCircle(points, false)) > 0;
  }

  //----------------------------------------------------------------------------
  void Link(Edge e, Edge next)
  {
    this->Next[e] = next;
    this->Previous[next] = e;
  }

  Edge MakeEdge(Part& part, std::uint32_t from, std::uint32_t to)
  {
    const Edge e = part.FreeHead;
    part.FreeHead = this->Next[e];
    this->Origin[e] = from;
    this->Origin[e ^ 1] = to;
    this->Link(e, e);
    this->Link(e ^ 1, e ^ 1);
    return e;
  }

  /// Joins or separates the rings of edges around the origins of two edges.
  void Splice(Edge a, Edge b)
  {
    const Edge afterA = this->Next[a], afterB = this->Next[b];
    this->Link(a, afterB);
    this->Link(b, afterA);
  }

  /// A new edge from the destination of `a` to the origin of `b`, left of both.
  Edge Connect(Part& part, Edge a, Edge b)
  {
    const Edge e = this->MakeEdge(part, this->Destination(a), this->Origin[b]);
    this->Splice(e, this->NextLeft(a));
    this->Splice(e ^ 1, b);
    return e;
  }

  void Delete(Part& part, Edge e)
  {
    this->Splice(e, this->Previous[e]);
    this->Splice(e ^ 1, this->Previous[e ^ 1]);
    e &= ~Edge(1);
    this->Next[e] = part.FreeHead;
    part.FreeTail = part.FreeHead == None ? e : part.FreeTail;
    part.FreeHead = e;
  }

  /// The next edge around the left face.
  Edge NextLeft(Edge e) const { return this->Previous[e ^ 1]; }

  //----------------------------------------------------------------------------
  Part Solve(std::uint32_t begin, std::uint32_t end, int axis)
  {
    if (end - begin <= 3)
    {
      return this->SolveFew(begin, end, axis);
    }
    const std::uint32_t middle = this->Cut(begin, end, axis);
    const Part left = this->Solve(begin, middle, 1 - axis);
    const Part right = this->Solve(middle, end, 1 - axis);
    return this->Merge(left, right, axis);
  }

  Part SolveFew(std::uint32_t begin, std::uint32_t end, int axis)
  {
    std::sort(this->Order.begin() + begin, this->Order.begin() + end,
      [&](std::uint32_t a, std::uint32_t b) { return this->IsBefore(a, b, axis); });
    Part part{ None, None, 6 * begin, 6 * end - 2 };
    for (Edge e = part.FreeHead; e < part.FreeTail; e += 2)
    {
      this->Next[e] = e + 2;
    }
    this->Next[part.FreeTail] = None;
    const std::uint32_t* p = &this->Order[begin];
    const Edge a = this->MakeEdge(part, p[0], p[1]);
    part.First = a;
    part.Last = a ^ 1;
    if (end - begin == 3)
    {
      const Edge b = this->MakeEdge(part, p[1], p[2]);
      this->Splice(a ^ 1, b);
      part.Last = b ^ 1;
      const int turn = this->Turn(p[0], p[1], p[2]);
      if (turn != 0)
      {
        const Edge c = this->Connect(part, b, a);
        part.First = turn > 0 ? a : c ^ 1;
        part.Last = turn > 0 ? b ^ 1 : c;
      }
    }
    return part;
  }

  /// Moves the hull edges to the first and the last point along an axis.
  void TurnTo(Part& part, int axis) const
  {
    // The hull is the right face of First: its edges counter-clockwise are First, then those that
    // follow around it.
    Edge first = part.First, last = part.First;
    Edge e = part.First;
    do
    {
      first = this->IsBefore(this->Origin[e], this->Origin[first], axis) ? e : first;
      last = this->IsBefore(this->Origin[last], this->Origin[e], axis) ? e : last;
      e = this->Next[e ^ 1];
    } while (e != part.First);
    part.First = first;
    // Clockwise out of the last point: back along the edge that arrives there.
    part.Last = this->Previous[last];
  }

  Part Merge(Part left, Part right, int axis)
  {
    this->TurnTo(left, axis);
    this->TurnTo(right, axis);
    Part part{ left.First, right.Last, left.FreeHead, right.FreeTail };
    if (left.FreeHead == None)
    {
      part.FreeHead = right.FreeHead;
    }
    else if (right.FreeHead == None)
    {
      part.FreeTail = left.FreeTail;
    }
    else
    {
      this->Next[left.FreeTail] = right.FreeHead;
    }
    Edge l = left.Last, r = right.First;
    for (;;) // the lower common tangent
    {
      if (this->IsLeftOf(this->Origin[r], l))
      {
        l = this->NextLeft(l);
      }
      else if (this->IsRightOf(this->Origin[l], r))
      {
        r = this->Next[r ^ 1];
      }
      else
      {
        break;
      }
    }
    Edge base = this->Connect(part, r ^ 1, l);
    part.First = this->Origin[l] == this->Origin[part.First] ? base ^ 1 : part.First;
    part.Last = this->Origin[r] == this->Origin[part.Last] ? base : part.Last;
    for (;;)
    {
      const Edge leftCandidate = this->FindCandidate(part, base, true);
      const Edge rightCandidate = this->FindCandidate(part, base, false);
      if (leftCandidate == None && rightCandidate == None)
      {
        return part;
      }
      const bool takesRight = leftCandidate == None ||
        (rightCandidate != None &&
          this->IsInCircle(this->Destination(leftCandidate), this->Origin[leftCandidate],
            this->Origin[rightCandidate], this->Destination(rightCandidate)));
      base = takesRight ? this->Connect(part, rightCandidate, base ^ 1)
                        : this->Connect(part, base ^ 1, leftCandidate ^ 1);
    }
  }

  /// The next edge above the base on one side, after the edges that are not Delaunay any more have
  /// been deleted; None if there is none above it.
  Edge FindCandidate(Part& part, Edge base, bool isLeft)
  {
    const auto step = [&](Edge e) { return isLeft ? this->Next[e] : this->Previous[e]; };
    Edge candidate = isLeft ? this->Next[base ^ 1] : this->Previous[base];
    if (!this->IsRightOf(this->Destination(candidate), base))
    {
      return None;
    }
    for (Edge next = step(candidate); this->IsInCircle(this->Destination(base), this->Origin[base],
           this->Destination(candidate), this->Destination(next));
         next = step(candidate))
    {
      this->Delete(part, candidate);
      candidate = next;
    }
    return candidate;
  }

  //----------------------------------------------------------------------------
  DividedPoints Collect(const Part& whole)
  {
    DividedPoints result;
    std::vector<bool> isUsed(this->Next.size() / 2, true);
    for (Edge e = whole.FreeHead; e != None; e = this->Next[e])
    {
      isUsed[e / 2] = false;
    }
    std::vector<CornerId> cornerOf(this->Next.size(), NoCorner); // of the triangle on the left
    Edge e = whole.First;
    std::vector<bool> isOutside(this->Next.size(), false);
    do
    {
      isOutside[e ^ 1] = true;
      ++result.HullEdges;
      e = this->Next[e ^ 1];
    } while (e != whole.First);
    for (Edge first = 0; first < this->Next.size(); ++first)
    {
      if (!isUsed[first / 2] || isOutside[first] || cornerOf[first] != NoCorner)
      {
        continue;
      }
      const Edge second = this->NextLeft(first), third = this->NextLeft(second);
      const auto number = static_cast<TriangleId>(result.Triangles.size());
      TriangleRecord triangle{};
      triangle.Vertices[0] = this->Origin[first];
      triangle.Vertices[1] = this->Origin[second];
      triangle.Vertices[2] = this->Origin[third];
      cornerOf[first] = MakeCorner(number, 2);
      cornerOf[second] = MakeCorner(number, 0);
      cornerOf[third] = MakeCorner(number, 1);
      result.Triangles.push_back(triangle);
    }
    for (Edge half = 0; half < this->Next.size(); ++half)
    {
      if (isUsed[half / 2] && cornerOf[half] != NoCorner)
      {
        TriangleRecord& triangle = result.Triangles[TriangleOf(cornerOf[half])];
        triangle.HalfEdges[SlotOf(cornerOf[half])] = cornerOf[half ^ 1];
      }
    }
    return result;
  }

  const TaskRunner& Run;
  std::vector<std::uint32_t> Order;
  std::vector<PlanePoint> Places;
  std::vector<std::uint32_t> Origin;
  std::vector<Edge> Next, Previous; ///< Around the origin, counter-clockwise and clockwise.
};
}

DividedPoints DivideAndConquer(
  const std::vector<CoordinatePair<double>>& places, const TaskRunner& run)
{
  return Divider(places, run).Solve();
}

}
