// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LATEROUNDS_H
#define DELAUNAYFLIP_LATEROUNDS_H

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgePasses.h"
#include "FlipRules.h"
#include "GroupBoundary.h"
#include "GroupWork.h"
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
  GroupBoundary Boundary;
  LateVertex* Late;
  LateCounts* Counts;
  TriangleId* Triangles; ///< Triangles that have changed.
  BadEdge* Bad[2]; ///< Bad edges of this iteration and of the last one, by turns.
  std::uint32_t Stamp; ///< The last stamp that was used.

  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& all) const
  {
    ThreadGroup group = all;
    std::uint32_t stamp = this->Stamp;
    for (std::uint32_t round = 0;; ++round)
    {
      const std::uint32_t late = AtomicLoad(&this->Counts->Late);
      if (late == 0 || late > LateLimits::Late || round == LateLimits::Rounds)
      {
        this->Finish(group, late == 0 ? LateEnd::Done : LateEnd::GoesOn, stamp);
        return;
      }
      if (late <= LateLimits::ForBlock)
      {
        if (!group.IsInFirstBlock())
        {
          return;
        }
        group = group.GetFirstBlock();
      }
      if (!this->ListStars(group, late, stamp))
      {
        this->Finish(group, LateEnd::GoesOn, stamp);
        return;
      }
      if (!this->Move(group, late, stamp))
      {
        this->Finish(group, LateEnd::Failed, stamp);
        return;
      }
      const bool isDelaunay = this->Flip(group, stamp);
      if (!this->KeepLate(group, late))
      {
        this->Finish(group, LateEnd::Failed, stamp);
        return;
      }
      if (!isDelaunay)
      {
        this->Finish(group, LateEnd::GoesOn, stamp);
        return;
      }
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE void Finish(
    const ThreadGroup& group, LateEnd end, std::uint32_t stamp) const
  {
    if (group.Rank == 0)
    {
      this->Counts->End = end;
      this->Counts->Stamp = stamp;
    }
  }

  //----------------------------------------------------------------------------
  // Steps of vertices.

  /// Lists the triangles around the late vertices. @returns false if there is no room.
  DELAUNAYFLIP_HOST_DEVICE bool ListStars(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    const MotionView<Real>& motion = this->Motion;
    const auto triangles = static_cast<TriangleId>(this->Counts->Sizes.Triangles);
    stamp += LateLimits::Passes + 1; // the passes have the stamps before it
    if (group.Rank == 0)
    {
      motion.ClearCounts();
    }
    ForEachInGroup(group, late,
      [&](std::uint32_t i)
      {
        motion.FindCorner(this->Late[i], triangles);
        this->ListStar(this->Late[i], stamp);
      });
    return AtomicLoad(&this->Counts->Listed) <= LateLimits::Triangles;
  }

  /// Moves the late vertices as far as the listed triangles allow, and lists new triangles at the
  /// boundary.
  /// @returns false if the motion does not suit steps.
  DELAUNAYFLIP_HOST_DEVICE bool Move(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    const MotionView<Real>& motion = this->Motion;
    ShareInGroup(group, AtomicLoad(&this->Counts->Listed),
      [&](std::uint32_t i) { this->LookForHull(this->Triangles[i]); });
    ForEachInGroup(group, late, [&](std::uint32_t i) { motion.Start(this->Late[i].Vertex); });
    if (!this->CutOff(group, late, stamp))
    {
      return false;
    }
    this->Halve(group, stamp - LateLimits::Passes);
    const bool isHalved = AtomicLoad(motion.Get(MotionCount::Inverted)) == 0 &&
      AtomicLoad(motion.Get(MotionCount::Late)) <= motion.MostLate;
    return isHalved && this->FillUp(group, stamp);
  }

  /// Lists the triangles around a vertex.
  DELAUNAYFLIP_HOST_DEVICE void ListStar(const LateVertex& late, std::uint32_t stamp) const
  {
    // The place in the list is waited for once, because it takes as long as the way around.
    constexpr std::uint32_t Most = 12; // few vertices have more triangles
    TriangleId found[Most];
    std::uint32_t count = 0;
    const auto append = [&]
    {
      const std::uint32_t place = AtomicAdd(&this->Counts->Listed, count);
      for (std::uint32_t i = 0; i < count && place + i < LateLimits::Triangles; ++i)
      {
        this->Triangles[place + i] = found[i];
      }
      count = 0;
    };
    this->Motion.ForStar(late.Corner,
      [&](CornerId corner)
      {
        const TriangleId triangle = TriangleOf(corner);
        if (AtomicExchange(&this->Motion.TriangleMarks[triangle], stamp) == stamp)
        {
          return;
        }
        if (count == Most)
        {
          append();
        }
        found[count++] = triangle;
      });
    append();
  }

  /// Lists a triangle once under each stamp, and counts it if there is no room.
  DELAUNAYFLIP_HOST_DEVICE void List(TriangleId triangle, std::uint32_t stamp) const
  {
    if (AtomicExchange(&this->Motion.TriangleMarks[triangle], stamp) != stamp)
    {
      Append(this->Triangles, &this->Counts->Listed, LateLimits::Triangles, triangle);
    }
  }

  /// Notes if a triangle has a side on the boundary.
  DELAUNAYFLIP_HOST_DEVICE void LookForHull(TriangleId triangle) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    for (const HalfEdgeId side : edges.Triangles[triangle].HalfEdges)
    {
      if (edges.CornerOfHalfEdge[side ^ 1u] == NoCorner)
      {
        AtomicStore(&this->Counts->IsAtHull, 1u);
      }
    }
  }

  /// Cuts off triangles at the boundary that are inverted. @returns whether this was possible.
  DELAUNAYFLIP_HOST_DEVICE bool CutOff(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    if (AtomicLoad(&this->Counts->IsAtHull) == 0)
    {
      return true;
    }
    if (!this->Boundary.CutOff(group))
    {
      return false;
    }
    if (this->Counts->Sizes.Cuts == 0)
    {
      return true;
    }
    if (group.Rank == 0)
    {
      AtomicStore(&this->Counts->Listed, 0u);
    }
    group.Sync();
    ++stamp;
    ForEachInGroup(group, late,
      [&](std::uint32_t i)
      {
        LateVertex& moved = this->Late[i];
        moved.Corner = this->Boundary.FindCorner(moved.Vertex, moved.Corner);
        this->ListStar(moved, stamp);
      });
    return true;
  }

  /// Halves the steps of vertices until no listed triangle is inverted.
  /// @param first the stamp of the first pass.
  DELAUNAYFLIP_HOST_DEVICE void Halve(const ThreadGroup& group, std::uint32_t first) const
  {
    const MotionView<Real>& motion = this->Motion;
    const std::uint32_t listed = AtomicLoad(&this->Counts->Listed);
    const auto check = [&](std::uint32_t i)
    {
      if (motion.IsInverted(this->Triangles[i]))
      {
        motion.AppendInverted(this->Triangles[i]);
      }
    };
    ForEachInGroup(group, listed, check);
    HalveInGroup<Real>{ motion, first, LateLimits::Passes }(group,
      [&](std::uint32_t, std::uint32_t stamp)
      {
        ForEachInGroup(group, listed,
          [&](std::uint32_t i)
          {
            if (motion.HasNewStep(this->Triangles[i], stamp))
            {
              check(i);
            }
          });
      });
  }

  /// Makes the boundary convex, and lists the new triangles. @returns whether this was possible.
  DELAUNAYFLIP_HOST_DEVICE bool FillUp(const ThreadGroup& group, std::uint32_t stamp) const
  {
    if (AtomicLoad(&this->Counts->IsAtHull) == 0)
    {
      return true;
    }
    if (!this->Boundary.FillUp(group))
    {
      return false;
    }
    const std::uint32_t firstNew = this->Counts->FirstNew;
    ForEachInGroup(group, this->Counts->Sizes.Triangles - firstNew,
      [&](std::uint32_t i) { this->List(firstNew + i, stamp); });
    return AtomicLoad(&this->Counts->Listed) <= LateLimits::Triangles;
  }

  //----------------------------------------------------------------------------
  // Flips.

  /// Flips edges of the listed triangles, and of those that change then, until the mesh is
  /// Delaunay.
  /// @returns false if this takes too many iterations, or too much room. Then all edges that have
  /// to be judged are candidates, so that another loop can go on.
  DELAUNAYFLIP_HOST_DEVICE bool Flip(const ThreadGroup& group, std::uint32_t& stamp) const
  {
    int current = 0;
    std::uint32_t before = 0; // bad edges of the last iteration
    for (std::uint32_t iteration = 0;; ++iteration)
    {
      this->JudgeListed(group, current, stamp);
      this->KeepLosers(group, current, before, stamp);
      group.Sync();
      const std::uint32_t bad = AtomicLoad(&this->Counts->Bad[current]);
      if (bad == 0)
      {
        return true;
      }
      if (bad > LateLimits::Bad || iteration == LateLimits::Iterations)
      {
        this->LeaveEdges(group, current, bad);
        return false;
      }
      if (group.Rank == 0)
      {
        AtomicStore(&this->Counts->Listed, 0u);
        AtomicStore(&this->Counts->Bad[1 - current], 0u);
      }
      group.Sync();
      ++stamp;
      this->FlipWinners(group, current, bad, stamp);
      before = bad;
      current = 1 - current;
    }
  }

  /// Judges the edges of the listed triangles, each once, and lists those that are bad. Does not
  /// wait for the group.
  DELAUNAYFLIP_HOST_DEVICE void JudgeListed(
    const ThreadGroup& group, int current, std::uint32_t stamp) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    ShareInGroup(group, std::int64_t(3) * AtomicLoad(&this->Counts->Listed),
      [&](std::uint32_t i)
      {
        const TriangleId triangle = this->Triangles[i / 3];
        const HalfEdgeId side = edges.Triangles[triangle].HalfEdges[i % 3];
        const EdgeId edge = EdgeOf(side);
        // Both are loaded before any of them is waited for, and so are the two below.
        const EdgeState state = AtomicLoad(&edges.States[edge]);
        const CornerPair corners = edges.GetCorners(edge);
        if (corners.B == NoCorner || state == EdgeState::Fixed)
        {
          return;
        }
        const TriangleId other = TriangleOf((side & 1u) == 0 ? corners.B : corners.A);
        const bool isListed = AtomicLoad(&this->Motion.TriangleMarks[other]) == stamp;
        const Quad quad = edges.GetQuad(corners);
        if (other > triangle || !isListed) // else it is judged from the other one
        {
          this->Judge(edge, corners, quad, current);
        }
      });
  }

  DELAUNAYFLIP_HOST_DEVICE void Judge(
    EdgeId edge, const CornerPair& corners, const Quad& quad, int current) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const PlanarRule<Real, 2> rule{ this->Motion.Now, 1, true, true };
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
    if (state == EdgeState::Bad)
    {
      this->AppendBad({ edge, corners, GetOuterHalfEdges(edges, corners.A, corners.B) }, current);
    }
  }

  /// Lists a bad edge. If there is no room, it becomes a candidate.
  DELAUNAYFLIP_HOST_DEVICE void AppendBad(const BadEdge& bad, int current) const
  {
    const bool hasRoom =
      Append(this->Bad[current], &this->Counts->Bad[current], LateLimits::Bad, bad);
    if (!hasRoom)
    {
      AtomicStore(&this->Motion.Mesh.Edges.States[bad.Edge], EdgeState::Candidate);
    }
  }

  /// Lists the bad edges of the last iteration again, except those of changed triangles, which are
  /// those that have flipped and others that are judged again. Does not wait for the group.
  DELAUNAYFLIP_HOST_DEVICE void KeepLosers(
    const ThreadGroup& group, int current, std::uint32_t before, std::uint32_t stamp) const
  {
    const auto isChanged = [&](CornerId corner)
    { return AtomicLoad(&this->Motion.TriangleMarks[TriangleOf(corner)]) == stamp; };
    ShareInGroup(group, before,
      [&](std::uint32_t i)
      {
        const BadEdge& bad = this->Bad[1 - current][i];
        if (!isChanged(bad.Corners.A) && !isChanged(bad.Corners.B))
        {
          this->AppendBad(bad, current);
        }
      });
  }

  /// Flips bad edges, no two of them of one triangle, and lists their triangles. The states stay as
  /// they are, because other threads still choose by them; all these edges are judged again.
  DELAUNAYFLIP_HOST_DEVICE void FlipWinners(
    const ThreadGroup& group, int current, std::uint32_t count, std::uint32_t stamp) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const auto isBad = [&](HalfEdgeId side)
    { return AtomicLoad(&edges.States[EdgeOf(side)]) == EdgeState::Bad; };
    ForEachInGroup(group, count,
      [&](std::uint32_t i)
      {
        const BadEdge bad = this->Bad[current][i];
        const OuterHalfEdges& outer = bad.Outer;
        const bool wins = IsFirst(
          bad.Edge, outer, isBad(outer.AP), isBad(outer.QA), isBad(outer.PB), isBad(outer.BQ));
        if (!wins)
        {
          return;
        }
        const TriangleId upper = TriangleOf(bad.Corners.A), lower = TriangleOf(bad.Corners.B);
        FlipEdge(edges, bad.Edge, edges.GetQuad(bad.Corners), edges.Triangles[upper],
          edges.Triangles[lower],
          [&](int, TriangleId triangle, const TriangleRecord& record)
          { edges.Triangles[triangle] = record; });
        this->ListFlipped(upper, lower, stamp);
        AtomicAdd(&this->Counts->Flips, 1u);
      });
  }

  /// Lists the triangles of an edge that has flipped. No other edge of theirs has.
  DELAUNAYFLIP_HOST_DEVICE void ListFlipped(
    TriangleId upper, TriangleId lower, std::uint32_t stamp) const
  {
    AtomicStore(&this->Motion.TriangleMarks[upper], stamp);
    AtomicStore(&this->Motion.TriangleMarks[lower], stamp);
    const std::uint32_t place = AtomicAdd(&this->Counts->Listed, 2u);
    this->Triangles[place] = upper; // there is room, because at most LateLimits::Bad edges flip
    this->Triangles[place + 1] = lower;
  }

  /// Leaves the bad edges to another loop.
  DELAUNAYFLIP_HOST_DEVICE void LeaveEdges(
    const ThreadGroup& group, int current, std::uint32_t bad) const
  {
    EdgeState* states = this->Motion.Mesh.Edges.States;
    ForEachInGroup(group, bad < LateLimits::Bad ? bad : LateLimits::Bad,
      [&](std::uint32_t i)
      { AtomicStore(&states[this->Bad[current][i].Edge], EdgeState::Candidate); });
  }

  //----------------------------------------------------------------------------

  /// Keeps the vertices that are not at their targets for the next round.
  /// @returns false if a device could not decide something, so that triangles may be inverted.
  DELAUNAYFLIP_HOST_DEVICE bool KeepLate(const ThreadGroup& group, std::uint32_t late) const
  {
    ForEachInGroup(group, late,
      [&](std::uint32_t i) { this->Motion.HalvingsOf[this->Late[i].Vertex] = AtTarget; });
    const std::uint32_t next = AtomicLoad(this->Motion.Get(MotionCount::Late));
    // Read between two waits, because the next round may set it.
    const bool isDecided = AtomicLoad(this->Motion.Get(MotionCount::Undecided)) == 0;
    ShareInGroup(group, next < this->Motion.MostLate ? next : this->Motion.MostLate,
      [&](std::uint32_t i) { this->Late[i] = this->Motion.Next[i]; });
    if (group.Rank == 0)
    {
      AtomicStore(&this->Counts->Late, next);
      ++this->Counts->Rounds;
      this->Counts->BeginRound();
    }
    group.Sync();
    return isDecided;
  }
};

}

#endif
