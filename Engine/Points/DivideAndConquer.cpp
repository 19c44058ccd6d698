// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DivideAndConquer.h"

#include "FlipReport.h"
#include "PlaceTests.h"

#include <algorithm>
#include <array>
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
/// One thread triangulates up to this many places. A second one would take longer to start than it
/// saves.
constexpr std::uint32_t MostForOneThread = 1 << 13;

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

/// An edge at one end of a base, and its destination.
struct Candidate
{
  Edge E;
  PlaceBeside Destination;
};

/// A set of points that has been triangulated.
struct Subset
{
  HullPoint Ends[2][2]; ///< By axis: the first and the last point.
  Edge FreeHead = None, FreeTail = None; ///< The edges that are not used, linked by Next.
};

class Triangulator
{
public:
  Triangulator(std::int64_t count, const DivideAndConquerCaller& caller)
    : Caller(caller),
      Count(static_cast<std::uint32_t>(count)),
      Places(count, caller.Host),
      Tests(this->Places.Data()),
      Sides(6 * count, caller.Host)
  {
  }

  /// Solves on the calling thread, which asks meanwhile.
  PointTriangles SolveHere()
  {
    this->AsksItself = true;
    return this->Solve();
  }

  /// Ends Solve soon, by RunAborted.
  void Stop() { this->IsStopped = true; }
  /// About the share of Solve that is done.
  double GetShare() const { return static_cast<double>(this->Solved) / this->Count; }

  PointTriangles Solve()
  {
    std::atomic<bool> filtersApply{ true };
    this->ForTasks(this->Count,
      [&](std::size_t, std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          const auto [u, v] = this->Caller.GetPlace(static_cast<std::int64_t>(i));
          this->Places[i] = { u, v, static_cast<std::uint32_t>(i) };
          if (!IsInFilterRange({ u, v, 0.0 }))
          {
            filtersApply = false;
          }
        }
      });
    this->Tests.FiltersApply = filtersApply;
    return this->Collect(this->Solve(0, this->Count, false));
  }

private:
  /// Compares by (x, y), or by (y, -x), which is the order after a quarter turn.
  static bool IsBefore(const Place& p, const Place& q, int axis)
  {
    if (axis == 0)
    {
      return p.U < q.U || (p.U == q.U && p.V < q.V);
    }
    return p.V < q.V || (p.V == q.V && p.U > q.U);
  }

  static bool IsLeftOf(const Place& p, const Place& q) { return IsBefore(p, q, 0); }

  std::uint32_t Origin(Edge e) const { return this->Sides[e].Origin; }
  std::uint32_t Destination(Edge e) const { return this->Sides[e ^ 1].Origin; }
  Edge Next(Edge e) const { return this->Sides[e].Next; }
  Edge Previous(Edge e) const { return this->Sides[e].Previous; }
  /// The next edge around the left face.
  Edge NextLeft(Edge e) const { return this->Previous(e ^ 1); }

  /// 1: a point is left of an edge; -1: right.
  int FindSide(Edge e, std::uint32_t point) const
  {
    return this->Tests.Orient(this->Origin(e), this->Destination(e), point);
  }

  //----------------------------------------------------------------------------
  void Link(Edge e, Edge next)
  {
    this->Sides[e].Next = next;
    this->Sides[next].Previous = e;
  }

  /// An edge that is not used yet. Both of its sides are to be put around their origins.
  Edge TakeEdge(Subset& set)
  {
    const Edge e = set.FreeHead;
    set.FreeHead = this->Next(e);
    return e;
  }

  void PutAlone(Edge e, std::uint32_t origin) { this->Sides[e] = { origin, e, e }; }

  /// Puts a side between two others around its origin. Each number is written once, since a merge
  /// makes so many edges that stores and the loads that wait for them take much of its time.
  void PutBetween(Edge e, std::uint32_t origin, Edge previous, Edge next)
  {
    this->Sides[e] = { origin, next, previous };
    this->Sides[previous].Next = e;
    this->Sides[next].Previous = e;
  }

  /// A new edge from the destination of `a` to the origin of `b`, left of both.
  Edge Connect(Subset& set, Edge a, Edge b)
  {
    const Edge e = this->TakeEdge(set);
    this->PutBetween(e, this->Destination(a), this->NextLeft(a), a ^ 1);
    this->PutBetween(e ^ 1, this->Origin(b), b, this->Next(b));
    return e;
  }

  void Delete(Subset& set, Edge e)
  {
    this->Link(this->Previous(e), this->Next(e));
    this->Link(this->Previous(e ^ 1), this->Next(e ^ 1));
    e &= ~Edge(1);
    this->Sides[e] = { None, set.FreeHead, None };
    if (set.FreeHead == None)
    {
      set.FreeTail = e;
    }
    set.FreeHead = e;
  }

  //----------------------------------------------------------------------------
  /// Triangulates a range of places. It is cut where a strip begins, and one strip is cut in the
  /// order of x.
  Subset Solve(std::uint32_t begin, std::uint32_t end, bool isStrip)
  {
    const std::uint32_t size = end - begin;
    isStrip = isStrip || this->JoinsFew(begin, end);
    if (size <= 3)
    {
      return this->SolveFew(begin, end);
    }
    int axis = 0;
    std::uint32_t bounds[3] = { begin, begin + size / 2, end };
    if (!isStrip)
    {
      axis = 1;
      bounds[1] = this->FindStrip(begin, end);
    }
    Subset halves[2];
    const auto solve = [&](std::int64_t i)
    {
      const std::uint32_t half = bounds[i + 1] - bounds[i];
      halves[i] = this->Solve(bounds[i], bounds[i + 1], isStrip);
      if (size > MostForOneThread && half <= MostForOneThread)
      {
        this->Solved += half;
      }
    };
    if (size > MostForOneThread)
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

  /// Joins the strips of a range to one if they are few. Then fewer edges are made and deleted than
  /// by merges of thin sets. If there are more, the cut nearest to the middle leaves at least two
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
  Subset SolveFew(std::uint32_t begin, std::uint32_t end)
  {
    Subset set{ {}, 6 * begin, 6 * end - 2 };
    for (Edge e = set.FreeHead; e < set.FreeTail; e += 2)
    {
      this->Sides[e] = { None, e + 2, None };
    }
    this->Sides[set.FreeTail] = { None, None, None };
    const Edge a = this->TakeEdge(set);
    this->PutAlone(a, begin);
    this->PutAlone(a ^ 1, begin + 1);
    std::array<Edge, 3> leaving{ a, a ^ 1, None }; // by point: the edge of the hull
    if (end - begin == 3)
    {
      const Edge b = this->TakeEdge(set);
      this->PutBetween(b, begin + 1, a ^ 1, a ^ 1);
      this->PutAlone(b ^ 1, begin + 2);
      const int orientation = this->Tests.Orient(begin, begin + 1, begin + 2);
      leaving = { a, b, b ^ 1 }; // if the points are on one line
      if (orientation > 0)
      {
        leaving[2] = this->Connect(set, b, a);
      }
      else if (orientation < 0)
      {
        const Edge c = this->Connect(set, b, a);
        leaving = { c ^ 1, a ^ 1, b ^ 1 };
      }
    }
    for (int i = 0; i < 2; ++i)
    {
      set.Ends[i][0] = set.Ends[i][1] = { begin, leaving[0] };
      for (std::uint32_t k = 1; k < end - begin; ++k)
      {
        const HullPoint point{ begin + k, leaving[k] };
        this->TakeEnds(i, { point, point }, set);
      }
    }
    return set;
  }

  /// Replaces the ends of a set by others that are further out.
  void TakeEnds(int axis, const HullPoint (&ends)[2], Subset& set) const
  {
    const auto isBefore = [&](const HullPoint& a, const HullPoint& b)
    { return IsBefore(this->Places[a.At], this->Places[b.At], axis); };
    HullPoint(&own)[2] = set.Ends[axis];
    if (isBefore(ends[0], own[0]))
    {
      own[0] = ends[0];
    }
    if (isBefore(own[1], ends[1]))
    {
      own[1] = ends[1];
    }
  }

  /// The edges of two sets that are not used become those of their union.
  void JoinFreeEdges(const Subset& left, const Subset& right, Subset& set)
  {
    if (left.FreeHead == None)
    {
      set.FreeHead = right.FreeHead;
      set.FreeTail = right.FreeTail;
    }
    else if (right.FreeHead != None)
    {
      this->Sides[left.FreeTail].Next = right.FreeHead;
      set.FreeTail = right.FreeTail;
    }
  }

  Subset Merge(const Subset& left, const Subset& right, int axis)
  {
    Subset set = left;
    for (int i = 0; i < 2; ++i)
    {
      this->TakeEnds(i, right.Ends[i], set);
    }
    this->JoinFreeEdges(left, right, set);
    // The edge of the hull that leaves the last point clockwise precedes the one that leaves it
    // counter-clockwise.
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
    Edge made = this->Connect(set, r ^ 1, l);
    this->ReplaceEnds(made ^ 1, set);
    for (;;)
    {
      this->Check();
      const Base base = this->Tests.MakeBase(this->Origin(made), this->Destination(made));
      const Candidate onLeft = this->FindCandidate(set, made, base, true);
      const Candidate onRight = this->FindCandidate(set, made, base, false);
      if (onLeft.E == None && onRight.E == None)
      {
        this->ReplaceEnds(made, set); // `made` is now the upper tangent
        return set;
      }
      const bool takesRight = onLeft.E == None ||
        (onRight.E != None &&
          this->Tests.IsInCircle(base, onLeft.Destination, onRight.Destination));
      if (takesRight)
      {
        made = this->Connect(set, onRight.E, made ^ 1);
      }
      else
      {
        made = this->Connect(set, made ^ 1, onLeft.E ^ 1);
      }
    }
  }

  /// Updates the ends of a set after a new edge of its hull has been made.
  void ReplaceEnds(Edge made, Subset& set) const
  {
    for (auto& ends : set.Ends)
    {
      for (HullPoint& end : ends)
      {
        if (end.At == this->Origin(made))
        {
          end.Leaving = made;
        }
      }
    }
  }

  /// The next edge above the base on one side, after the edges that are not Delaunay any more have
  /// been deleted. Its edge is None if no edge is above the base.
  Candidate FindCandidate(Subset& set, Edge baseEdge, const Base& base, bool isLeft)
  {
    // Goes through the edges around this end of the base, until it comes back to the base.
    const auto follow = [&](Edge e) { return isLeft ? this->Next(e) : this->Previous(e); };
    const Edge last = isLeft ? baseEdge ^ 1 : baseEdge;
    Edge e = follow(last);
    PlaceBeside place = this->Tests.See(base, this->Destination(e));
    if (!this->Tests.IsOnRight(base, place))
    {
      return { None, place };
    }
    for (Edge next = follow(e); next != last; next = follow(e))
    {
      const PlaceBeside nextPlace = this->Tests.See(base, this->Destination(next));
      if (!this->Tests.IsInCircle(base, place, nextPlace))
      {
        break;
      }
      this->Delete(set, e);
      e = next;
      place = nextPlace;
    }
    return { e, place };
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

  /// Calls work(task, first, end) for ranges of [0, size), on threads.
  template <typename Work>
  void ForTasks(std::size_t size, const Work& work) const
  {
    this->Run(static_cast<std::int64_t>((size + TaskSize - 1) / TaskSize),
      [&](std::int64_t i)
      { work(i, i * TaskSize, std::min<std::size_t>(size, (i + 1) * TaskSize)); });
  }

  PointTriangles Collect(const Subset& whole) const
  {
    const auto sides = static_cast<Edge>(6 * std::size_t(this->Count));
    // By side: the corner of the triangle on the left, if there is one.
    Array<CornerId> cornerOf(sides, this->Caller.Host);
    Array<bool> isLeading(sides, this->Caller.Host);
    const Edge outside = whole.Ends[0][0].Leaving ^ 1u;
    const auto isUsed = [&](Edge e) { return this->Origin(e & ~Edge(1)) != None; };
    // Whether a side is the first one of its triangle. This has no branches, because they would be
    // mispredicted half of the time.
    const auto leads = [&](Edge e)
    {
      const Edge second = this->NextLeft(e), third = this->NextLeft(second);
      const int isFirst = int(e < second) & int(e < third);
      const int isTriangle = int(this->NextLeft(third) == e);
      const int isInside = int(e != outside) & int(second != outside) & int(third != outside);
      return (isFirst & isTriangle & isInside) != 0;
    };
    std::vector<std::int64_t> usedOf(sides / TaskSize + 1, 0), firstOf(sides / TaskSize + 2, 0);
    this->ForTasks(sides,
      [&](std::size_t task, std::size_t first, std::size_t end)
      {
        for (std::size_t i = first; i < end; ++i)
        {
          const auto e = static_cast<Edge>(i);
          cornerOf[e] = NoCorner;
          usedOf[task] += isUsed(e) ? 1 : 0;
          isLeading[e] = isUsed(e) && leads(e);
          firstOf[task + 1] += isLeading[e] ? 1 : 0;
        }
      });
    std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
    const auto triangles = static_cast<std::size_t>(firstOf.back());
    PointTriangles made{ Array<TriangleRecord>(triangles, this->Caller.Host),
      std::accumulate(usedOf.begin(), usedOf.end(), -3 * firstOf.back()) };
    const auto placeOf = [&](Edge side) { return this->Places[this->Origin(side)].Number; };
    this->ForTasks(sides,
      [&](std::size_t task, std::size_t begin, std::size_t end)
      {
        auto number = static_cast<TriangleId>(firstOf[task]);
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
    this->ForTasks(triangles,
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
  static constexpr std::size_t TaskSize = std::size_t(1) << 16;

  const DivideAndConquerCaller& Caller;
  const std::uint32_t Count;
  Array<Place> Places; ///< In the order in which strips have been joined.
  PlaceTests Tests;
  Array<Side> Sides; ///< By directed edge.
  std::atomic<bool> IsStopped{ false };
  bool AsksItself = false; ///< Then all is done on one thread.
  mutable std::uint32_t Calls = 0; ///< How often Ask was called.
  mutable std::chrono::steady_clock::time_point NextQuestion =
    std::chrono::steady_clock::now() + Pause;
  /// How many places single threads have solved. It is in another cache line than what all threads
  /// read.
  alignas(64) std::atomic<std::uint32_t> Solved{ 0 };
};
}

PointTriangles DivideAndConquer(std::int64_t count, const DivideAndConquerCaller& caller)
{
  Triangulator triangulator(count, caller);
  if (count <= MostForOneThread)
  {
    return triangulator.SolveHere();
  }
  // It runs on a thread beside this one, or on this one if the system has none left.
  std::future<PointTriangles> made = std::async([&]() { return triangulator.Solve(); });
  try
  {
    while (made.wait_for(Pause) == std::future_status::timeout)
    {
      caller.Tell(triangulator.GetShare());
    }
  }
  catch (...)
  {
    triangulator.Stop();
    throw; // once it has ended
  }
  return made.get();
}

}
