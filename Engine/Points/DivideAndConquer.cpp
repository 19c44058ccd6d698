// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DivideAndConquer.h"

#include "EdgeSides.h"
#include "FlipReport.h"
#include "PlaceTests.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>

namespace delaunayflip
{

namespace
{
constexpr std::chrono::milliseconds Pause(50); ///< Between questions to the caller.
/// One thread triangulates up to this many places. A second one would take longer to start than it
/// saves.
constexpr std::uint32_t MostForOneThread = 1 << 13;
constexpr std::uint32_t StepsPerCheck = 64; ///< A merge makes one edge per step.

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

/// The unused edges of a set of points, linked by Next.
struct FreeEdges
{
  Edge Head = None, Tail = None;
};

/// A strip, or a part of it, that has been triangulated. Most of these are tiny, so this is no more
/// than fits into two registers.
struct Strip
{
  Edge LeavesFirst, LeavesLast; ///< The edges of the hull that leave the ends counter-clockwise.
  FreeEdges Free;
};

/// Strips that have been triangulated and merged.
struct Subset
{
  HullPoint Ends[2][2]; ///< By axis: the first and the last point.
  FreeEdges Free;
};

/// The edges of the hull that a merge of two sets has made.
struct Tangents
{
  Edge Lower, Upper; ///< Counter-clockwise, from the first set and from the second one.
};

class Triangulator : private EdgeSides
{
public:
  Triangulator(std::int64_t count, const DivideAndConquerCaller& caller)
    : EdgeSides(6 * count, caller.Host),
      Caller(caller),
      Count(static_cast<std::uint32_t>(count)),
      Places(count, caller.Host),
      Tests(this->Places.Data())
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
        this->Caller.GetPlaces(static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end),
          this->Places.Data() + begin);
        const auto isInRange = [](const NumberedPlace& place) {
          return IsInFilterRange({ place.U, place.V, 0.0 });
        };
        if (!std::all_of(this->Places.Data() + begin, this->Places.Data() + end, isInRange))
        {
          filtersApply = false;
        }
      });
    if (!filtersApply)
    {
      this->Tests.StopFilters();
    }
    const Subset whole = this->SolveStrips(0, this->Count);
    return CollectTriangles(*this, this->Places.Data(), whole.Ends[0][0].Leaving ^ 1,
      this->Caller.Host,
      [this](std::size_t size, const auto& work) { this->ForTasks(size, work); });
  }

private:
  /// Compares by (x, y), or by (y, -x), which is the order after a quarter turn.
  static bool IsBefore(const NumberedPlace& p, const NumberedPlace& q, int axis)
  {
    if (axis == 0)
    {
      return p.U < q.U || (p.U == q.U && p.V < q.V);
    }
    return p.V < q.V || (p.V == q.V && p.U > q.U);
  }

  static bool IsLeftOf(const NumberedPlace& p, const NumberedPlace& q) { return IsBefore(p, q, 0); }

  /// 1: a point is left of an edge; -1: right.
  int FindSide(Edge e, std::uint32_t point) const
  {
    return this->Tests.Orient(this->Origin(e), this->Destination(e), point);
  }

  //----------------------------------------------------------------------------
  /// An edge that is not used yet. Both of its sides are to be put around their origins.
  Edge TakeEdge(FreeEdges& free)
  {
    const Edge e = free.Head;
    free.Head = this->Next(e);
    return e;
  }

  /// A new edge from the destination of `a` to the origin of `b`, left of both.
  Edge Connect(FreeEdges& free, Edge a, Edge b)
  {
    const Edge e = this->TakeEdge(free);
    this->PutBetween(e, this->Destination(a), this->NextLeft(a), a ^ 1);
    this->PutBetween(e ^ 1, this->Origin(b), b, this->Next(b));
    return e;
  }

  /// Makes an edge one that is not used.
  void Release(FreeEdges& free, Edge e)
  {
    e &= ~Edge(1);
    this->Sides[e].Origin = None;
    this->Sides[e].Next = free.Head;
    if (free.Head == None)
    {
      free.Tail = e;
    }
    free.Head = e;
  }

  //----------------------------------------------------------------------------
  /// Triangulates a range of places, which is cut where a strip begins.
  Subset SolveStrips(std::uint32_t begin, std::uint32_t end)
  {
    if (this->JoinsFew(begin, end))
    {
      return this->FindEnds(begin, end, this->SolveStrip(begin, end));
    }
    const std::uint32_t bounds[3] = { begin, this->FindStrip(begin, end), end };
    Subset halves[2];
    this->ForHalves(
      bounds, [&](std::int64_t i) { halves[i] = this->SolveStrips(bounds[i], bounds[i + 1]); });
    return this->Merge(halves[0], halves[1]);
  }

  /// Triangulates places of one strip, which are cut in the order of x.
  Strip SolveStrip(std::uint32_t begin, std::uint32_t end)
  {
    const std::uint32_t size = end - begin;
    if (size <= 3)
    {
      return this->SolveFew(begin, end);
    }
    const std::uint32_t bounds[3] = { begin, begin + size / 2, end };
    Strip halves[2];
    this->ForHalves(
      bounds, [&](std::int64_t i) { halves[i] = this->SolveStrip(bounds[i], bounds[i + 1]); });
    const auto [left, right] = halves;
    Strip strip{ left.LeavesFirst, right.LeavesLast, this->JoinFreeEdges(left.Free, right.Free) };
    const Tangents made =
      this->MergeHulls(strip.Free, this->Previous(left.LeavesLast), right.LeavesFirst);
    if (this->Origin(made.Lower) == begin)
    {
      strip.LeavesFirst = made.Lower;
    }
    if (this->Origin(made.Upper) == end - 1)
    {
      strip.LeavesLast = made.Upper;
    }
    return strip;
  }

  /// Calls solve(0) and solve(1) for the two parts of a range, on threads if there is enough to do.
  template <typename Solve>
  void ForHalves(const std::uint32_t (&bounds)[3], const Solve& solve)
  {
    if (bounds[2] - bounds[0] <= MostForOneThread)
    {
      solve(0);
      solve(1);
      return;
    }
    this->Run(2,
      [&](std::int64_t i)
      {
        solve(i);
        const std::uint32_t half = bounds[i + 1] - bounds[i];
        if (half <= MostForOneThread)
        {
          this->Solved += half;
        }
      });
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
      NumberedPlace* const places = this->Places.Data();
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
  Strip SolveFew(std::uint32_t begin, std::uint32_t end)
  {
    FreeEdges free{ 6 * begin, 6 * end - 2 };
    for (Edge e = free.Head; e < free.Tail; e += 2)
    {
      this->Sides[e].Origin = None;
      this->Sides[e].Next = e + 2;
    }
    this->Sides[free.Tail].Origin = None;
    this->Sides[free.Tail].Next = None;
    const Edge a = this->TakeEdge(free);
    this->PutAlone(a, begin);
    this->PutAlone(a ^ 1, begin + 1);
    if (end - begin < 3)
    {
      return { a, a ^ 1, free };
    }
    const Edge b = this->TakeEdge(free);
    this->PutBetween(b, begin + 1, a ^ 1, a ^ 1);
    this->PutAlone(b ^ 1, begin + 2);
    const int orientation = this->Tests.Orient(begin, begin + 1, begin + 2);
    if (orientation == 0)
    {
      return { a, b ^ 1, free };
    }
    const Edge c = this->Connect(free, b, a);
    if (orientation > 0)
    {
      return { a, c, free };
    }
    return { c ^ 1, b ^ 1, free };
  }

  /// Finds the ends of a strip by a walk around its hull.
  Subset FindEnds(std::uint32_t begin, std::uint32_t end, const Strip& strip) const
  {
    const HullPoint first{ begin, strip.LeavesFirst }, last{ end - 1, strip.LeavesLast };
    Subset set{ { { first, last }, { first, first } }, strip.Free };
    if (end - begin == this->Count) // it is not merged
    {
      return set;
    }
    for (Edge e = this->NextOfHull(first.Leaving); e != first.Leaving; e = this->NextOfHull(e))
    {
      const HullPoint point{ this->Origin(e), e };
      this->TakeEnds(1, { point, point }, set);
    }
    return set;
  }

  /// The edge of the hull that follows counter-clockwise.
  Edge NextOfHull(Edge e) const { return this->Next(e ^ 1); }

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
  FreeEdges JoinFreeEdges(const FreeEdges& left, const FreeEdges& right)
  {
    if (left.Head == None)
    {
      return right;
    }
    if (right.Head == None)
    {
      return left;
    }
    this->Sides[left.Tail].Next = right.Head;
    return { left.Head, right.Tail };
  }

  /// Merges strips with others above.
  Subset Merge(const Subset& lower, const Subset& upper)
  {
    Subset set = lower;
    for (int i = 0; i < 2; ++i)
    {
      this->TakeEnds(i, upper.Ends[i], set);
    }
    set.Free = this->JoinFreeEdges(lower.Free, upper.Free);
    const Tangents made = this->MergeHulls(
      set.Free, this->Previous(lower.Ends[1][1].Leaving), upper.Ends[1][0].Leaving);
    this->ReplaceEnds(made.Lower, set);
    this->ReplaceEnds(made.Upper, set);
    return set;
  }

  /// Makes the edges between two sets.
  /// @param freeEdges the unused edges of both.
  /// @param l the edge of the hull that leaves the last point of the first set clockwise. It
  /// precedes the one that leaves it counter-clockwise.
  /// @param r the edge of the hull that leaves the first point of the second set counter-clockwise.
  Tangents MergeHulls(FreeEdges& freeEdges, Edge l, Edge r)
  {
    this->Check();
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
    FreeEdges free = freeEdges; // can be in registers
    Edge made = this->Connect(free, r ^ 1, l);
    const Edge lower = made ^ 1;
    Base base = this->Tests.MakeBase(this->Origin(r), this->Origin(l));
    for (std::uint32_t step = 1;; ++step)
    {
      if (step % StepsPerCheck == 0)
      {
        this->Check();
      }
      const Candidate onLeft = this->FindCandidate(free, made, base, true);
      const Candidate onRight = this->FindCandidate(free, made, base, false);
      if (onLeft.E == None && onRight.E == None)
      {
        freeEdges = free;
        return { lower, made };
      }
      const bool takesRight = onLeft.E == None ||
        (onRight.E != None &&
          this->Tests.IsInCircle(base, onLeft.Destination, onRight.Destination));
      if (takesRight)
      {
        made = this->Connect(free, onRight.E, made ^ 1);
        base = this->Tests.MakeBase(onRight.Destination.At, base.To);
      }
      else
      {
        made = this->Connect(free, made ^ 1, onLeft.E ^ 1);
        base = this->Tests.MakeBase(base, onLeft.Destination);
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
  Candidate FindCandidate(FreeEdges& free, Edge baseEdge, const Base& base, bool isLeft)
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
    const Edge first = e;
    for (Edge next = follow(e); next != last; next = follow(e))
    {
      const PlaceBeside nextPlace = this->Tests.See(base, this->Destination(next));
      if (!this->Tests.IsInCircle(base, place, nextPlace))
      {
        break;
      }
      this->Unlink(e ^ 1);
      this->Release(free, e);
      e = next;
      place = nextPlace;
    }
    if (e != first)
    {
      const Edge both[2] = { last, e };
      this->Link(both[isLeft ? 0 : 1], both[isLeft ? 1 : 0]);
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
    this->Run(static_cast<std::int64_t>((size + SidesPerTask - 1) / SidesPerTask),
      [&](std::int64_t i)
      { work(i, i * SidesPerTask, std::min<std::size_t>(size, (i + 1) * SidesPerTask)); });
  }

  const DivideAndConquerCaller& Caller;
  const std::uint32_t Count;
  Array<NumberedPlace> Places; ///< In the order in which strips have been joined.
  PlaceTests Tests;
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
