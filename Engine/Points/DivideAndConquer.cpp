// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DivideAndConquer.h"

#include "ExactPredicates.h"
#include "FlipReport.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <numeric>

namespace delaunayflip
{

namespace
{
using Edge = std::uint32_t; ///< A directed edge; e ^ 1 runs the other way.
constexpr Edge None = ~Edge(0);
constexpr std::chrono::milliseconds Pause(50); ///< Between questions to the caller.
/// Of places, for which one thread does all. A thread more would take longer to start than it
/// saves.
constexpr std::uint32_t SmallestShared = 1 << 13;

struct Place
{
  double U, V;
  std::uint32_t Number;
};

/// One side of an edge.
struct Side
{
  std::uint32_t Origin; ///< A place; None: the edge is not used.
  Edge Next, Previous; ///< Around the origin, counter-clockwise and clockwise.
};

/// A point of a hull, and the edge of the hull that leaves it counter-clockwise.
struct HullPoint
{
  std::uint32_t At;
  Edge Leaving;
};

/// A set of points.
struct Part
{
  HullPoint Ends[2][2]; ///< By axis, the first and the last point.
  Edge FreeHead = None, FreeTail = None; ///< The edges that are not used, linked by Next.
};

class Divider
{
public:
  Divider(std::int64_t count, const Division& division)
    : Caller(division),
      Count(static_cast<std::uint32_t>(count)),
      Places(count, division.Host),
      Sides(6 * count, division.Host)
  {
  }

  /// Solves on the calling thread, which asks meanwhile.
  DividedPoints SolveHere()
  {
    this->AsksItself = true;
    return this->Solve();
  }

  /// Ends Solve soon, by RunAborted.
  void Stop() { this->IsStopped = true; }
  /// About the share of Solve that is done.
  double GetShare() const { return static_cast<double>(this->Solved) / this->Count; }

  DividedPoints Solve()
  {
    this->ForPieces(this->Count,
      [&](std::size_t, std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto [u, v] = this->Caller.GetPlace(static_cast<std::int64_t>(i));
          this->Places[i] = { u, v, static_cast<std::uint32_t>(i) };
          if (!IsInFilterRange({ u, v, 0.0 }))
          {
            this->FiltersApply = false;
          }
        }
      });
    return this->Collect(this->Solve(0, this->Count, false));
  }

private:
  /// By (x, y), or by (y, -x): the same order turned by a quarter.
  static bool IsBefore(const Place& p, const Place& q, int axis)
  {
    return axis == 0 ? (p.U != q.U ? p.U < q.U : p.V < q.V) : (p.V != q.V ? p.V < q.V : p.U > q.U);
  }

  static bool IsLeftOf(const Place& p, const Place& q) { return IsBefore(p, q, 0); }

  std::uint32_t Origin(Edge e) const { return this->Sides[e].Origin; }
  std::uint32_t Destination(Edge e) const { return this->Sides[e ^ 1].Origin; }
  Edge Next(Edge e) const { return this->Sides[e].Next; }
  Edge Previous(Edge e) const { return this->Sides[e].Previous; }
  /// The next edge around the left face.
  Edge NextLeft(Edge e) const { return this->Previous(e ^ 1); }

  PlanePoint GetPoint(std::uint32_t place) const
  {
    return { this->Places[place].U, this->Places[place].V, 0.0 };
  }

  int Turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    const PlanePoint points[3] = { this->GetPoint(a), this->GetPoint(b), this->GetPoint(c) };
    const int sign = FilteredOrientation(points[0], points[1], points[2]);
    return sign != UncertainSign && this->FiltersApply
      ? sign
      : ExactOrientation(points[0], points[1], points[2]);
  }
  /// 1: a point is left of an edge; -1: right.
  int FindSide(Edge e, std::uint32_t point) const
  {
    return this->Turn(this->Origin(e), this->Destination(e), point);
  }

  bool IsInCircle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const
  {
    const PlanePoint points[4] = { this->GetPoint(a), this->GetPoint(b), this->GetPoint(c),
      this->GetPoint(d) };
    const int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    return (sign != UncertainSign && this->FiltersApply ? sign : ExactInCircle(points, false)) > 0;
  }

  //----------------------------------------------------------------------------
  void Link(Edge e, Edge next)
  {
    this->Sides[e].Next = next;
    this->Sides[next].Previous = e;
  }

  Edge MakeEdge(Part& part, std::uint32_t from, std::uint32_t to)
  {
    const Edge e = part.FreeHead;
    part.FreeHead = this->Next(e);
    this->Sides[e] = { from, e, e };
    this->Sides[e ^ 1] = { to, e ^ 1, e ^ 1 };
    return e;
  }

  /// Joins or separates the rings of edges around the origins of two edges.
  void Splice(Edge a, Edge b)
  {
    const Edge afterA = this->Next(a), afterB = this->Next(b);
    this->Link(a, afterB);
    this->Link(b, afterA);
  }

  /// A new edge from the destination of `a` to the origin of `b`, left of both.
  Edge Connect(Part& part, Edge a, Edge b)
  {
    const Edge e = this->MakeEdge(part, this->Destination(a), this->Origin(b));
    this->Splice(e, this->NextLeft(a));
    this->Splice(e ^ 1, b);
    return e;
  }

  void Delete(Part& part, Edge e)
  {
    this->Splice(e, this->Previous(e));
    this->Splice(e ^ 1, this->Previous(e ^ 1));
    e &= ~Edge(1);
    this->Sides[e] = { None, part.FreeHead, None };
    part.FreeTail = part.FreeHead == None ? e : part.FreeTail;
    part.FreeHead = e;
  }

  //----------------------------------------------------------------------------
  /// Triangulates a range of places. It is cut where a strip begins, and one strip in the order of
  /// x.
  Part Solve(std::uint32_t begin, std::uint32_t end, bool isStrip)
  {
    const std::uint32_t size = end - begin;
    isStrip = isStrip || this->JoinsFew(begin, end);
    if (size <= 3)
    {
      return this->SolveFew(begin, end);
    }
    const int axis = isStrip ? 0 : 1;
    const std::uint32_t middle = isStrip ? begin + size / 2 : this->FindStrip(begin, end);
    Part halves[2];
    const auto solve = [&](std::int64_t i)
    {
      const std::uint32_t first = i == 0 ? begin : middle, last = i == 0 ? middle : end;
      halves[i] = this->Solve(first, last, isStrip);
      if (size > SmallestShared && last - first <= SmallestShared)
      {
        this->Solved += last - first;
      }
    };
    if (size > SmallestShared)
    {
      this->Run(2, solve);
    }
    else
    {
      solve(0);
      solve(1);
    }
    return this->Merge(halves[0], halves[1], axis);
  }

  /// Joins the strips of a range to one if they are few: then fewer edges are made and deleted than
  /// by merges of thin parts. If there are more, the cut nearest to the middle leaves at least two
  /// places on each side.
  /// @returns whether the range is one strip now.
  bool JoinsFew(std::uint32_t begin, std::uint32_t end)
  {
    constexpr int MostJoined = 6;
    int strips = 1;
    for (std::uint32_t i = begin + 1; i < end && strips <= MostJoined; ++i)
    {
      strips += this->Begins(i) ? 1 : 0;
    }
    if (strips <= MostJoined)
    {
      this->Join(begin, end);
    }
    return strips <= MostJoined;
  }

  /// Merges all strips of a range.
  void Join(std::uint32_t begin, std::uint32_t end)
  {
    const std::uint32_t strip = this->FindStrip(begin, end);
    if (strip < end)
    {
      this->Join(begin, strip);
      this->Join(strip, end);
      Place* const places = this->Places.Data();
      std::inplace_merge(places + begin, places + strip, places + end, IsLeftOf);
    }
  }

  /// Whether a strip begins at a place.
  bool Begins(std::uint32_t i) const { return IsLeftOf(this->Places[i], this->Places[i - 1]); }

  /// The place nearest to the middle of a range where a strip begins, or its end.
  std::uint32_t FindStrip(std::uint32_t begin, std::uint32_t end) const
  {
    const std::uint32_t middle = begin + (end - begin) / 2;
    for (std::uint32_t far = 0; far < end - middle; ++far)
    {
      for (const std::uint32_t i : { middle - far, middle + far })
      {
        if (i > begin && this->Begins(i))
        {
          return i;
        }
      }
    }
    return end;
  }

  /// Two or three sorted places.
  Part SolveFew(std::uint32_t begin, std::uint32_t end)
  {
    Part part{ {}, 6 * begin, 6 * end - 2 };
    for (Edge e = part.FreeHead; e < part.FreeTail; e += 2)
    {
      this->Sides[e] = { None, e + 2, None };
    }
    this->Sides[part.FreeTail] = { None, None, None };
    const Edge a = this->MakeEdge(part, begin, begin + 1);
    Edge leaving[3] = { a, a ^ 1, None }; // hull edges, of each point
    if (end - begin == 3)
    {
      const Edge b = this->MakeEdge(part, begin + 1, begin + 2);
      this->Splice(a ^ 1, b);
      const int turn = this->Turn(begin, begin + 1, begin + 2);
      const Edge c = turn != 0 ? this->Connect(part, b, a) : b ^ 1;
      leaving[0] = turn < 0 ? c ^ 1 : a;
      leaving[1] = turn < 0 ? a ^ 1 : b;
      leaving[2] = turn < 0 ? b ^ 1 : c;
    }
    for (int i = 0; i < 2; ++i)
    {
      part.Ends[i][0] = part.Ends[i][1] = { begin, leaving[0] };
      for (std::uint32_t k = 1; k < end - begin; ++k)
      {
        const HullPoint point{ begin + k, leaving[k] };
        this->TakeEnds(i, { point, point }, part);
      }
    }
    return part;
  }

  /// Replaces the ends of a part by others that are further out.
  void TakeEnds(int axis, const HullPoint (&ends)[2], Part& part) const
  {
    const auto isBefore = [&](const HullPoint& a, const HullPoint& b)
    { return IsBefore(this->Places[a.At], this->Places[b.At], axis); };
    HullPoint(&own)[2] = part.Ends[axis];
    own[0] = isBefore(ends[0], own[0]) ? ends[0] : own[0];
    own[1] = isBefore(own[1], ends[1]) ? ends[1] : own[1];
  }

  Part Merge(const Part& left, const Part& right, int axis)
  {
    Part part = left;
    for (int i = 0; i < 2; ++i)
    {
      this->TakeEnds(i, right.Ends[i], part);
    }
    part.FreeHead = left.FreeHead == None ? right.FreeHead : left.FreeHead;
    part.FreeTail = right.FreeHead == None ? left.FreeTail : right.FreeTail;
    if (left.FreeHead != None && right.FreeHead != None)
    {
      this->Sides[left.FreeTail].Next = right.FreeHead;
    }
    // Out of the last point clockwise: the edge before the one counter-clockwise.
    Edge l = this->Previous(left.Ends[axis][1].Leaving), r = right.Ends[axis][0].Leaving;
    for (;;) // the lower common tangent
    {
      if (this->FindSide(l, this->Origin(r)) > 0)
      {
        l = this->NextLeft(l);
      }
      else if (this->FindSide(r, this->Origin(l)) < 0)
      {
        r = this->Next(r ^ 1);
      }
      else
      {
        break;
      }
    }
    Edge base = this->Connect(part, r ^ 1, l);
    this->ReplaceEnds(base ^ 1, part);
    for (;;)
    {
      this->Check();
      const Edge leftCandidate = this->FindCandidate(part, base, true);
      const Edge rightCandidate = this->FindCandidate(part, base, false);
      if (leftCandidate == None && rightCandidate == None)
      {
        this->ReplaceEnds(base, part); // now the upper tangent
        return part;
      }
      const bool takesRight = leftCandidate == None ||
        (rightCandidate != None &&
          this->IsInCircle(this->Destination(leftCandidate), this->Origin(leftCandidate),
            this->Origin(rightCandidate), this->Destination(rightCandidate)));
      base = takesRight ? this->Connect(part, rightCandidate, base ^ 1)
                        : this->Connect(part, base ^ 1, leftCandidate ^ 1);
    }
  }

  /// Takes a new edge of the hull into the ends.
  void ReplaceEnds(Edge made, Part& part) const
  {
    for (auto& ends : part.Ends)
    {
      for (HullPoint& end : ends)
      {
        end.Leaving = end.At == this->Origin(made) ? made : end.Leaving;
      }
    }
  }

  /// The next edge above the base on one side, after the edges that are not Delaunay any more have
  /// been deleted; None if there is none above it.
  Edge FindCandidate(Part& part, Edge base, bool isLeft)
  {
    const auto step = [&](Edge e) { return isLeft ? this->Next(e) : this->Previous(e); };
    const Edge last = isLeft ? base ^ 1 : base; // which comes round again
    Edge candidate = step(last);
    if (this->FindSide(base, this->Destination(candidate)) >= 0)
    {
      return None;
    }
    for (Edge next = step(candidate); next != last &&
         this->IsInCircle(this->Destination(base), this->Origin(base), this->Destination(candidate),
           this->Destination(next));
         next = step(candidate))
    {
      this->Delete(part, candidate);
      candidate = next;
    }
    return candidate;
  }

  //----------------------------------------------------------------------------
  /// Calls work(task) for task = 0 .. count - 1, on threads.
  template <typename Work>
  void Run(std::int64_t count, const Work& work) const
  {
    this->Caller.Run(count,
      [&](std::int64_t task)
      {
        this->Check();
        work(task);
      });
  }

  void Check() const
  {
    if (this->IsStopped)
    {
      throw RunAborted();
    }
    if (this->AsksItself)
    {
      this->Ask();
    }
  }

  /// Tells the caller, if enough time has passed. Most calls do not look at the clock.
  void Ask() const
  {
    constexpr std::uint32_t CallsPerLook = 64;
    if (++this->Calls % CallsPerLook == 0 && std::chrono::steady_clock::now() >= this->NextQuestion)
    {
      this->Caller.Tell(this->GetShare());
      this->NextQuestion = std::chrono::steady_clock::now() + Pause;
    }
  }

  /// Calls work(piece, first, end) for pieces of [0, size), on threads.
  template <typename Work>
  void ForPieces(std::size_t size, const Work& work) const
  {
    this->Run(static_cast<std::int64_t>((size + Piece - 1) / Piece),
      [&](std::int64_t i) { work(i, i * Piece, std::min(size, (i + 1) * Piece)); });
  }

  DividedPoints Collect(const Part& whole) const
  {
    const auto sides = static_cast<Edge>(6 * std::size_t(this->Count));
    // Of the triangle on the left, if there is one.
    Array<CornerId> cornerOf(sides, this->Caller.Host);
    Array<bool> isLeading(sides, this->Caller.Host);
    const Edge outside = whole.Ends[0][0].Leaving ^ 1u;
    const auto isUsed = [&](Edge e) { return this->Origin(e & ~Edge(1)) != None; };
    // Whether a side comes first of those of a triangle.
    const auto leads = [&](Edge e)
    {
      const Edge second = this->NextLeft(e);
      if (second < e)
      {
        return false;
      }
      const Edge third = this->NextLeft(second);
      return e < third && this->NextLeft(third) == e && e != outside && second != outside &&
        third != outside;
    };
    std::vector<std::int64_t> usedOf(sides / Piece + 1, 0), firstOf(sides / Piece + 2, 0);
    this->ForPieces(sides,
      [&](std::size_t piece, std::size_t first, std::size_t end)
      {
        for (std::size_t i = first; i < end; ++i)
        {
          const auto e = static_cast<Edge>(i);
          cornerOf[e] = NoCorner;
          usedOf[piece] += isUsed(e) ? 1 : 0;
          isLeading[e] = isUsed(e) && leads(e);
          firstOf[piece + 1] += isLeading[e] ? 1 : 0;
        }
      });
    std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
    const auto triangles = static_cast<std::size_t>(firstOf.back());
    DividedPoints made{ Array<TriangleRecord>(triangles, this->Caller.Host),
      std::accumulate(usedOf.begin(), usedOf.end(), -3 * firstOf.back()) };
    const auto placeOf = [&](Edge side) { return this->Places[this->Origin(side)].Number; };
    this->ForPieces(sides,
      [&](std::size_t piece, std::size_t begin, std::size_t end)
      {
        auto number = static_cast<TriangleId>(firstOf[piece]);
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto first = static_cast<Edge>(i);
          if (isLeading[first])
          {
            const Edge second = this->NextLeft(first), third = this->NextLeft(second);
            cornerOf[first] = MakeCorner(number, 2);
            cornerOf[second] = MakeCorner(number, 0);
            cornerOf[third] = MakeCorner(number, 1);
            made.Triangles[number] = { { placeOf(first), placeOf(second), placeOf(third) }, number,
              { second ^ 1u, third ^ 1u, first ^ 1u }, 0 };
            ++number;
          }
        }
      });
    this->ForPieces(triangles,
      [&](std::size_t, std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          for (CornerId& other : made.Triangles[i].HalfEdges)
          {
            other = cornerOf[other];
          }
        }
      });
    return made;
  }

  /// How many sides or triangles a task has.
  static constexpr std::size_t Piece = std::size_t(1) << 16;

  const Division& Caller;
  const std::uint32_t Count;
  Array<Place> Places; ///< In the order of the parts.
  Array<Side> Sides; ///< Of edge e; e ^ 1 is its other side.
  std::atomic<bool> FiltersApply{ true };
  std::atomic<bool> IsStopped{ false };
  bool AsksItself = false; ///< Then all is done on one thread.
  mutable std::uint32_t Calls = 0; ///< Of Ask.
  mutable std::chrono::steady_clock::time_point NextQuestion =
    std::chrono::steady_clock::now() + Pause;
  /// Places in parts that one thread has solved. Not in the cache line of what all threads read.
  alignas(64) std::atomic<std::uint32_t> Solved{ 0 };
};
}

DividedPoints DivideAndConquer(std::int64_t count, const Division& division)
{
  Divider divider(count, division);
  if (count <= SmallestShared)
  {
    return divider.SolveHere();
  }
  // On a thread beside this one, or if the system has none left on this one.
  std::future<DividedPoints> divided = std::async([&]() { return divider.Solve(); });
  try
  {
    while (divided.wait_for(Pause) == std::future_status::timeout)
    {
      division.Tell(divider.GetShare());
    }
  }
  catch (...)
  {
    divider.Stop();
    throw; // once it has ended
  }
  return divided.get();
}

}
