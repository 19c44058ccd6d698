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
  TriangleId* Triangles;
  EdgeId* Edges[2]; ///< Edges that flips have to judge.
  std::uint32_t Stamp; ///< The last stamp that was used.

  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& group) const
  {
    std::uint32_t stamp = this->Stamp;
    for (std::uint32_t round = 0;; ++round)
    {
      const std::uint32_t late = AtomicLoad(&this->Counts->Late);
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

  //----------------------------------------------------------------------------
  // Steps of vertices.

  /// Moves the late vertices as far as triangles allow.
  /// @returns false if the motion does not suit steps.
  DELAUNAYFLIP_HOST_DEVICE bool Move(
    const ThreadGroup& group, std::uint32_t late, std::uint32_t& stamp) const
  {
    const MotionView<Real>& motion = this->Motion;
    const auto triangles = static_cast<TriangleId>(this->Counts->Sizes.Triangles);
    if (group.Rank == 0)
    {
      motion.ClearCounts();
      this->Counts->BeginRound();
    }
    ForEachInGroup(
      group, late, [&](std::uint32_t i) { motion.FindCorner(this->Late[i], triangles); });
    ForEachInGroup(group, late, [&](std::uint32_t i) { motion.Start(this->Late[i].Vertex); });
    if (!this->CutOff(group, late))
    {
      return false;
    }
    ++stamp;
    ForEachInGroup(group, late, [&](std::uint32_t i) { motion.CheckStar(this->Late[i], stamp); });
    HalveInGroup<Real>{ motion, stamp + 1, LateLimits::Passes }(group);
    stamp += LateLimits::Passes;
    const bool isHalved = AtomicLoad(motion.Get(MotionCount::Inverted)) == 0 &&
      AtomicLoad(motion.Get(MotionCount::Late)) <= motion.MostLate;
    return isHalved && this->Boundary.FillUp(group);
  }

  /// Cuts off triangles at the boundary that are inverted. @returns whether this was possible.
  DELAUNAYFLIP_HOST_DEVICE bool CutOff(const ThreadGroup& group, std::uint32_t late) const
  {
    if (!this->Boundary.CutOff(group))
    {
      return false;
    }
    ForEachInGroup(group, this->Counts->Sizes.Cuts > 0 ? late : 0,
      [&](std::uint32_t i) {
        this->Late[i].Corner =
          this->Boundary.FindCorner(this->Late[i].Vertex, this->Late[i].Corner);
      });
    return true;
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
    ++stamp;
    ForEachInGroup(group, late,
      [&](std::uint32_t i)
      {
        this->Motion.ForStar(
          this->Late[i].Corner, [&](CornerId corner) { this->List(TriangleOf(corner), stamp); });
      });
    const std::uint32_t firstNew = this->Counts->FirstNew;
    ForEachInGroup(group, this->Counts->Sizes.Triangles - firstNew,
      [&](std::uint32_t i) { this->List(firstNew + i, stamp); });
    int current = 0;
    this->ListEdges(group, stamp, current);
    group.Sync();
    for (std::uint32_t iteration = 0; iteration < LateLimits::Iterations; ++iteration)
    {
      const std::uint32_t count = AtomicLoad(&this->Counts->Edges[current]);
      const std::uint32_t triangles = AtomicLoad(&this->Counts->Listed);
      if (count > LateLimits::Edges || triangles > LateLimits::Triangles)
      {
        return false;
      }
      this->Judge(group, current, count);
      if (AtomicLoad(&this->Counts->Bad) == 0)
      {
        return true;
      }
      if (group.Rank == 0) // all have read these
      {
        AtomicStore(&this->Counts->Listed, 0u);
        AtomicStore(&this->Counts->Edges[1 - current], 0u);
      }
      this->Choose(group, current, count);
      ++stamp;
      this->FlipWinners(group, current, count, stamp);
      if (group.Rank == 0)
      {
        AtomicStore(&this->Counts->Bad, 0u);
      }
      this->KeepLosers(group, current, count, stamp);
      current = 1 - current;
      this->ListEdges(group, stamp, current);
      group.Sync();
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

  /// Lists the edges of the listed triangles, each once. Does not wait for the group.
  DELAUNAYFLIP_HOST_DEVICE void ListEdges(
    const ThreadGroup& group, std::uint32_t stamp, int current) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const std::uint32_t listed = AtomicLoad(&this->Counts->Listed);
    ShareInGroup(group, listed < LateLimits::Triangles ? listed : LateLimits::Triangles,
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

  /// Judges the listed edges, and counts those that are bad.
  DELAUNAYFLIP_HOST_DEVICE void Judge(
    const ThreadGroup& group, int current, std::uint32_t count) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const PlanarRule<Real, 2> rule{ this->Motion.Now, 1, true, true };
    ForEachInGroup(group, count,
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
  }

  /// Chooses the bad edges that flip: no two of them are edges of one triangle.
  DELAUNAYFLIP_HOST_DEVICE void Choose(
    const ThreadGroup& group, int current, std::uint32_t count) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const auto isBad = [&](HalfEdgeId side)
    { return AtomicLoad(&edges.States[EdgeOf(side)]) == EdgeState::Bad; };
    ForEachInGroup(group, count,
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
    ForEachInGroup(group, count,
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

  /// Lists the bad edges again that have not flipped, except those of changed triangles. Does
  /// not wait for the group.
  DELAUNAYFLIP_HOST_DEVICE void KeepLosers(
    const ThreadGroup& group, int current, std::uint32_t count, std::uint32_t stamp) const
  {
    const EdgeMeshView& edges = this->Motion.Mesh.Edges;
    const auto isChanged = [&](CornerId corner)
    { return AtomicLoad(&this->Motion.TriangleMarks[TriangleOf(corner)]) == stamp; };
    std::uint32_t* next = this->Edges[1 - current];
    std::uint32_t* nextCount = &this->Counts->Edges[1 - current];
    ShareInGroup(group, count,
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
    }
    group.Sync();
    return isDecided;
  }
};

}

#endif
