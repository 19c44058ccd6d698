// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LATEROUNDS_H
#define DELAUNAYFLIP_LATEROUNDS_H

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgePasses.h"
#include "FlipRules.h"
#include "HullBoundary.h"
#include "HullChange.h"
#include "LateCounts.h"
#include "MotionView.h"
#include "ThreadGroup.h"

#include <cstdint>

/// @file
/// The rounds of a motion that move few vertices, with their flips, by one group of threads. On a
/// GPU the launches and waits of such a round take more time than its work.

namespace delaunayflip
{

/// Makes rounds until all vertices are at their targets.
template <typename Real>
struct LateRounds
{
  MotionView<Real> Motion;
  HullView Hull;
  LateVertex* Late;
  LateCounts* Counts;
  VertexId* Pending;
  std::uint32_t* PendingSides;
  TriangleId* Triangles;
  EdgeId* Edges[2]; ///< Edges that flips have to judge.
  std::uint32_t Stamp; ///< The last stamp that was used.

  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& group) const
  {
    std::uint32_t stamp = this->Stamp;
    for (std::uint32_t round = 0;; ++round)
    {
      const std::uint32_t late = AtomicLoad(&this->Counts->Late);
      group.Sync();
      if (late == 0 || late > LateLimits::Late || round == LateLimits::Rounds)
      {
        this->Finish(group, late == 0 ? LateEnd::Done : LateEnd::GoesOn, stamp);
        return;
      }
      if (!this->Move(group, late, stamp))
      {
        this->Finish(group, LateEnd::Failed, stamp);
        return;
      }
      const bool isDelaunay = this->Flip(group, late, stamp);
      this->KeepLate(group, late);
      if (!isDelaunay)
      {
        this->Finish(group, LateEnd::GoesOn, stamp);
        return;
      }
    }
  }

private:
  static constexpr EdgeId Winner = 1u << 31; ///< This bit marks an edge that flips.

  DELAUNAYFLIP_HOST_DEVICE void Finish(
    const ThreadGroup& group, LateEnd end, std::uint32_t stamp) const
  {
    if (group.Rank == 0)
    {
      this->Counts->End = end;
      this->Counts->Stamp = stamp;
    }
  }

  /// Calls work(i) for i = 0 .. count - 1, shared by the group, and waits for it.
  template <typename Work>
  DELAUNAYFLIP_HOST_DEVICE static void ForEach(
    const ThreadGroup& group, std::int64_t count, const Work& work)
  {
    for (std::int64_t i = group.Rank; i < count; i += group.Size)
    {
      work(static_cast<std::uint32_t>(i));
    }
    group.Sync();
  }

  /// Sets a count to 0. All threads must have read it.
  DELAUNAYFLIP_HOST_DEVICE static void Clear(const ThreadGroup& group, std::uint32_t* count)
  {
    if (group.Rank == 0)
    {
      AtomicStore(count, 0u);
    }
    group.Sync();
  }

  /// Reads a count that no thread changes before the next Sync.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t Read(
    const ThreadGroup& group, const std::uint32_t* count)
  {
    const std::uint32_t value = AtomicLoad(count);
    group.Sync();
    return value;
  }

  /// Counts a value, and lists it if there is room. @returns whether there is.
  DELAUNAYFLIP_HOST_DEVICE static bool Append(
    std::uint32_t* list, std::uint32_t* count, std::uint32_t most, std::uint32_t value)
  {
    const std::uint32_t place = AtomicAdd(count, 1u);
    const bool hasRoom = place < most;
    if (hasRoom)
    {
      list[place] = value;
    }
    return hasRoom;
  }

  DELAUNAYFLIP_HOST_DEVICE static void CountIf(bool is, std::uint32_t* count)
  {
    if (is)
    {
      AtomicAdd(count, 1u);
    }
  }

  //----------------------------------------------------------------------------
  // Steps of vertices.

  /// Moves the late vertices as far as triangles allow.
  /// @returns false if the motion does not suit steps.
  DELAUNAYFLIP_HOST_DEVICE bool Move(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    const MotionView<Real>& motion = this->Motion;
    const auto triangles = static_cast<TriangleId>(this->Counts->Sizes.Triangles);
    ForEach(group, late, [&](std::uint32_t i) { motion.FindCorner(this->Late[i], triangles); });
    ForEach(group, static_cast<std::int64_t>(MotionCount::End),
      [&](std::uint32_t i)
      {
        if (i != static_cast<std::uint32_t>(MotionCount::Undecided))
        {
          AtomicStore(&motion.Counts[i], 0u);
        }
      });
    ForEach(group, late, [&](std::uint32_t i) { motion.Start(this->Late[i].Vertex); });
    if (!this->CutOff(group, late))
    {
      return false;
    }
    ++stamp;
    ForEach(group, late, [&](std::uint32_t i) { motion.CheckStar(this->Late[i], stamp); });
    HalveInGroup<Real>{ motion, stamp + 1, LateLimits::Passes, false }(group);
    stamp += LateLimits::Passes;
    group.Sync();
    const bool isHalved = Read(group, motion.Get(MotionCount::Inverted)) == 0 &&
      Read(group, motion.Get(MotionCount::Late)) <= motion.MostLate;
    return isHalved && this->FillUp(group);
  }

  /// Cuts off triangles at the boundary that are inverted. @returns whether this was possible.
  DELAUNAYFLIP_HOST_DEVICE bool CutOff(const ThreadGroup& group, std::uint32_t late) const
  {
    const std::uint32_t count = this->ListPending(
      group, [this](const BoundarySide& side) { return this->Hull.MustCut(side); });
    if (count == 0 || count > LateLimits::Pending)
    {
      return count == 0;
    }
    if (group.Rank == 0)
    {
      this->Counts->Sizes.Cuts = 0;
      HullEditor(this->Hull, &this->Counts->Sizes).CutOff(this->Pending, count);
      this->Counts->HasChangedHull = 1;
    }
    group.Sync();
    HullView hull = this->Hull;
    hull.NumberOfCuts = this->Counts->Sizes.Cuts;
    ForEach(group, late,
      [&](std::uint32_t i)
      { this->Late[i].Corner = hull.FindCorner(this->Late[i].Vertex, this->Late[i].Corner); });
    return this->Counts->Sizes.HasFailed == 0;
  }

  /// Makes the boundary convex. @returns whether it is a convex polygon that goes around once.
  DELAUNAYFLIP_HOST_DEVICE bool FillUp(const ThreadGroup& group) const
  {
    const std::uint32_t count = this->ListPending(
      group, [this](const BoundarySide& side) { return this->Hull.FindTurn(side) < 0; });
    if (count > LateLimits::Pending)
    {
      return false;
    }
    if (group.Rank == 0)
    {
      this->Counts->FirstNew = static_cast<std::uint32_t>(this->Counts->Sizes.Triangles);
      if (count > 0)
      {
        HullEditor(this->Hull, &this->Counts->Sizes).FillUp(this->Pending, count);
        this->Counts->HasChangedHull = 1;
      }
    }
    group.Sync();
    std::uint32_t* counts = this->Motion.Counts + static_cast<int>(MotionCount::Hull);
    ForEach(group, this->Counts->Sizes.Sides,
      [&](std::uint32_t i)
      {
        const BoundarySide side = this->Hull.Sides[i];
        const int turn = this->Hull.FindTurn(side);
        const bool isReversed =
          this->Hull.RunsUp(side) != this->Hull.RunsUp(this->Hull.Sides[side.Before]);
        const bool isWrong = turn < 0 || (turn == 0 && isReversed);
        CountIf(isWrong, counts + static_cast<int>(HullCount::Concave));
        CountIf(isReversed, counts + static_cast<int>(HullCount::Reversals));
      });
    const std::uint32_t wrong = Read(group, counts + static_cast<int>(HullCount::Concave));
    const std::uint32_t reversals = Read(group, counts + static_cast<int>(HullCount::Reversals));
    return this->Counts->Sizes.HasFailed == 0 && wrong == 0 && reversals == 2;
  }

  /// Lists the vertices where the boundary must change, in the order of its sides.
  /// @returns how many there are.
  template <typename MustChange>
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t ListPending(
    const ThreadGroup& group, const MustChange& mustChange) const
  {
    Clear(group, &this->Counts->Listed);
    ForEach(group, this->Counts->Sizes.Sides,
      [&](std::uint32_t i)
      {
        if (mustChange(this->Hull.Sides[i]))
        {
          Append(this->PendingSides, &this->Counts->Listed, LateLimits::Pending, i);
        }
      });
    const std::uint32_t count = Read(group, &this->Counts->Listed);
    if (group.Rank == 0 && count <= LateLimits::Pending)
    {
      for (std::uint32_t i = 0; i < count; ++i) // there are few
      {
        const std::uint32_t side = this->PendingSides[i];
        std::uint32_t place = i;
        for (; place > 0 && this->PendingSides[place - 1] > side; --place)
        {
          this->PendingSides[place] = this->PendingSides[place - 1];
        }
        this->PendingSides[place] = side;
      }
      for (std::uint32_t i = 0; i < count; ++i)
      {
        this->Pending[i] = this->Hull.GetStart(this->Hull.Sides[this->PendingSides[i]]);
      }
    }
    group.Sync();
    return count;
  }

  //----------------------------------------------------------------------------
  // Flips.

  /// Flips edges around the late vertices, and at new triangles, until the mesh is Delaunay. At the
  /// beginning of an iteration all edges that have to be judged are candidates, also those for
  /// which lists have no room. So another loop can go on.
  /// @returns false if this takes too many iterations, or too much room.
  DELAUNAYFLIP_HOST_DEVICE bool Flip(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    Clear(group, &this->Counts->Listed);
    ++stamp;
    ForEach(group, late,
      [&](std::uint32_t i)
      {
        this->Motion.ForStar(
          this->Late[i].Corner, [&](CornerId corner) { this->List(TriangleOf(corner), stamp); });
      });
    const std::uint32_t firstNew = this->Counts->FirstNew;
    ForEach(group, this->Counts->Sizes.Triangles - firstNew,
      [&](std::uint32_t i) { this->List(firstNew + i, stamp); });
    int current = 0;
    Clear(group, &this->Counts->Edges[0]);
    this->ListEdges(group, stamp, current);
    for (std::uint32_t iteration = 0; iteration < LateLimits::Iterations; ++iteration)
    {
      const std::uint32_t count = Read(group, &this->Counts->Edges[current]);
      const std::uint32_t triangles = Read(group, &this->Counts->Listed);
      if (count > LateLimits::Edges || triangles > LateLimits::Triangles)
      {
        return false;
      }
      if (this->Judge(group, current, count) == 0)
      {
        return true;
      }
      this->Choose(group, current, count);
      Clear(group, &this->Counts->Listed);
      ++stamp;
      this->FlipWinners(group, current, count, stamp);
      Clear(group, &this->Counts->Edges[1 - current]);
      this->KeepLosers(group, current, count, stamp);
      current = 1 - current;
      this->ListEdges(group, stamp, current);
    }
    return false;
  }

  /// Lists a triangle once under each stamp. If there is no room, its edges become candidates.
  DELAUNAYFLIP_HOST_DEVICE void List(TriangleId triangle, std::uint32_t stamp) const
  {
    const bool isFirst = AtomicExchange(&this->Motion.TriangleMarks[triangle], stamp) != stamp;
    if (isFirst && !Append(this->Triangles, &this->Counts->Listed, LateLimits::Triangles, triangle))
    {
      this->Motion.JudgeEdges(triangle);
    }
  }

  /// Lists the edges of the listed triangles, each once.
  DELAUNAYFLIP_HOST_DEVICE void ListEdges(
    const ThreadGroup& group, std::uint32_t stamp, int current) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const std::uint32_t listed = Read(group, &this->Counts->Listed);
    ForEach(group, listed < LateLimits::Triangles ? listed : LateLimits::Triangles,
      [&](std::uint32_t i)
      {
        const TriangleId triangle = this->Triangles[i];
        for (int slot = 0; slot < 3; ++slot)
        {
          const HalfEdgeId side = edges.Triangles[triangle].HalfEdges[slot];
          const CornerId across = edges.CornerOfHalfEdge[side ^ 1u];
          if (across == NoCorner || AtomicLoad(&edges.States[EdgeOf(side)]) == EdgeState::Fixed)
          {
            continue;
          }
          const TriangleId other = TriangleOf(across);
          const bool isOfOther =
            other < triangle && AtomicLoad(&this->Motion.TriangleMarks[other]) == stamp;
          if (!isOfOther)
          {
            AtomicStore(&edges.States[EdgeOf(side)], EdgeState::Candidate);
            Append(
              this->Edges[current], &this->Counts->Edges[current], LateLimits::Edges, EdgeOf(side));
          }
        }
      });
  }

  /// Judges the listed edges. @returns how many are bad.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Judge(
    const ThreadGroup& group, int current, std::uint32_t count) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const PlanarRule<Real, 2> rule{ this->Motion.Now, 1, true, true };
    Clear(group, &this->Counts->Bad);
    ForEach(group, count,
      [&](std::uint32_t i)
      {
        const EdgeId edge = this->Edges[current][i];
        const Quad quad = edges.GetQuad(edge);
        EdgeState state = rule.Judge(quad);
        if (state == EdgeState::Uncertain)
        {
          state = rule.JudgeExactly(quad);
        }
        if (state == EdgeState::Uncertain) // a device cannot decide, which ends the motion
        {
          *this->Motion.Mesh.Failed = 1;
          state = EdgeState::Good;
        }
        AtomicStore(&edges.States[edge], state);
        CountIf(state == EdgeState::Bad, &this->Counts->Bad);
      });
    return Read(group, &this->Counts->Bad);
  }

  /// Chooses the bad edges that flip: no two of them are edges of one triangle.
  DELAUNAYFLIP_HOST_DEVICE void Choose(
    const ThreadGroup& group, int current, std::uint32_t count) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const auto isBad = [&](HalfEdgeId side)
    { return AtomicLoad(&edges.States[EdgeOf(side)]) == EdgeState::Bad; };
    ForEach(group, count,
      [&](std::uint32_t i)
      {
        const EdgeId edge = this->Edges[current][i];
        if (!isBad(2 * edge))
        {
          return;
        }
        const CornerPair corners = edges.GetCorners(edge);
        const OuterHalfEdges outer = GetOuterHalfEdges(edges, corners.A, corners.B);
        if (IsFirst(
              edge, outer, isBad(outer.AP), isBad(outer.QA), isBad(outer.PB), isBad(outer.BQ)))
        {
          this->Edges[current][i] = edge | Winner;
        }
      });
  }

  /// Flips the chosen edges, and lists their triangles.
  DELAUNAYFLIP_HOST_DEVICE void FlipWinners(
    const ThreadGroup& group, int current, std::uint32_t count, std::uint32_t stamp) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    ForEach(group, count,
      [&](std::uint32_t i)
      {
        if ((this->Edges[current][i] & Winner) == 0)
        {
          return;
        }
        const EdgeId edge = this->Edges[current][i] & ~Winner;
        const Quad quad = edges.GetQuad(edge);
        const TriangleId upper = TriangleOf(quad.CornerA), lower = TriangleOf(quad.CornerB);
        FlipEdge(edges, edge, quad, edges.Triangles[upper], edges.Triangles[lower],
          [&](int, TriangleId triangle, const TriangleRecord& record)
          { edges.Triangles[triangle] = record; });
        AtomicStore(&edges.States[edge], EdgeState::Good);
        this->List(upper, stamp);
        this->List(lower, stamp);
        AtomicAdd(&this->Counts->Flips, 1u);
      });
  }

  /// Lists the bad edges again that have not flipped, except those of changed triangles.
  DELAUNAYFLIP_HOST_DEVICE void KeepLosers(
    const ThreadGroup& group, int current, std::uint32_t count, std::uint32_t stamp) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const auto isChanged = [&](CornerId corner)
    { return AtomicLoad(&this->Motion.TriangleMarks[TriangleOf(corner)]) == stamp; };
    std::uint32_t* next = this->Edges[1 - current];
    std::uint32_t* nextCount = &this->Counts->Edges[1 - current];
    ForEach(group, count,
      [&](std::uint32_t i)
      {
        const EdgeId edge = this->Edges[current][i];
        if ((edge & Winner) != 0 || AtomicLoad(&edges.States[edge]) != EdgeState::Bad)
        {
          return;
        }
        const CornerPair corners = edges.GetCorners(edge);
        if (!isChanged(corners.A) && !isChanged(corners.B))
        {
          AtomicStore(&edges.States[edge], EdgeState::Candidate);
          Append(next, nextCount, LateLimits::Edges, edge);
        }
      });
  }

  //----------------------------------------------------------------------------

  /// Keeps the vertices that are not at their targets for the next round.
  DELAUNAYFLIP_HOST_DEVICE void KeepLate(const ThreadGroup& group, std::uint32_t late) const
  {
    ForEach(group, late,
      [&](std::uint32_t i) { this->Motion.HalvingsOf[this->Late[i].Vertex] = AtTarget; });
    const std::uint32_t next = Read(group, this->Motion.Get(MotionCount::Late));
    ForEach(group, next < this->Motion.MostLate ? next : this->Motion.MostLate,
      [&](std::uint32_t i) { this->Late[i] = this->Motion.Next[i]; });
    if (group.Rank == 0)
    {
      AtomicStore(&this->Counts->Late, next);
      ++this->Counts->Rounds;
    }
    group.Sync();
  }
};

}

#endif
