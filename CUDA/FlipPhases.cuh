// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPPHASES_CUH
#define DELAUNAYFLIP_FLIPPHASES_CUH

#include "Atomics.h"
#include "DeviceWorklist.cuh"
#include "EdgeBits.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "IterationSums.h"
#include "LoopView.cuh"
#include "RecordStore.cuh"
#include "StepCounts.h"
#include "Team.cuh"

/// @file
/// The passes of an iteration that choose and flip (4 to 6 of FlipLoop.h), on a worklist of the
/// device. Within a pass a thread works on one edge at a time. Results depend only on the order of
/// the passes, which the team's waits keep.

namespace delaunayflip
{

/// Makes the outer edges of a flip candidates.
template <typename Rule>
__device__ void MarkOuter(const LoopView<Rule>& loop, const OuterHalfEdges& outer)
{
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.AP));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.QA));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.PB));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.BQ));
}

/// Whether a bad edge has a smaller priority than its bad neighbours. Bad does not change
/// meanwhile.
template <typename Rule>
__device__ bool Wins(const LoopView<Rule>& loop, EdgeId edge, const OuterHalfEdges& outer)
{
  const auto isBad = [&](HalfEdgeId halfEdge)
  { return EdgeBits::Has(loop.Bits.Bad, EdgeOf(halfEdge)); };
  const bool ap = isBad(outer.AP), qa = isBad(outer.QA);
  const bool pb = isBad(outer.PB), bq = isBad(outer.BQ);
  return IsFirst(edge, outer, ap, qa, pb, bq);
}

/// Chooses among the bad edges and flips the winners. These stay marked as bad until the next
/// detection, because other choices depend on it.
///
/// So a thread may examine an edge while a neighbour flips. The edge must lose then, and it does,
/// whether the thread reads its words and triangles from before that flip or from after it. Before
/// and after, a flipping triangle contains the flipped edge, which is bad and comes first; or the
/// triangle has given the examined edge to its partner. No thread changes what a winner reads.
template <typename Rule, typename Worklist>
__device__ void ChooseAndFlip(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  unsigned flips = 0;
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Bad); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      FlippedRecords flipped;
      OuterHalfEdges outer{};
      bool wins = false;
      if (edge != NoEdge)
      {
        const RecordPair records(loop.Mesh, corners);
        outer = records.GetOuter();
        wins = Wins(loop, edge, outer) && records.Hold(edge);
        if (wins)
        {
          FlipEdge(
            loop.Mesh, edge, records.GetQuad(), records.Upper, records.Lower, flipped.Keep());
        }
      }
      flipped.Store(loop.Mesh.Triangles);
      if (wins)
      {
        ++flips;
        EdgeBits::Set(loop.Bits.Winners, edge);
        MarkOuter(loop, outer);
      }
    });
  team.Add(IterationSum::Flipped, flips);
}

/// Chooses without flipping, if winners must make claims first; sets Winners.
template <typename Rule, typename Worklist>
__device__ void Choose(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Bad); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge && Wins(loop, edge, GetOuterHalfEdges(loop.Mesh, corners.A, corners.B)))
      {
        EdgeBits::Set(loop.Bits.Winners, edge);
      }
    });
}

/// Calls work(edge, quad) for the winners.
template <typename Rule, typename Worklist, typename Work>
__device__ void ForWinners(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team, const Work& work)
{
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Winners); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge)
      {
        work(edge, loop.Mesh.GetQuad(corners));
      }
    });
}

/// Winners claim their new edges.
template <typename Rule, typename Worklist>
__device__ void Claim(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  ForWinners(loop, worklist, team,
    [&](EdgeId edge, const Quad& quad)
    { loop.Guard.Claims.Claim(quad.A, quad.B, Priority(edge)); });
}

/// Winners that lost their claim stay bad.
template <typename Rule, typename Worklist>
__device__ void Confirm(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  ForWinners(loop, worklist, team,
    [&](EdgeId edge, const Quad& quad)
    {
      if (!loop.Guard.Claims.Holds(quad.A, quad.B, Priority(edge)))
      {
        AtomicAnd(&loop.Bits.Winners[edge / 32], ~(1u << (edge % 32)));
      }
    });
}

/// Flips the winners and makes their outer edges candidates.
template <typename Rule, typename Worklist>
__device__ void FlipWinners(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  StepCounts counts;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned winners = byte.Load(loop.Bits.Winners);
      byte.Clear(loop.Bits.Winners, winners, winners);
      byte.Clear(loop.Bits.Bad, winners ? byte.Load(loop.Bits.Bad) : 0, winners);
      return winners;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      Quad quad{};
      OuterHalfEdges outer{};
      FlippedRecords flipped;
      if (edge != NoEdge)
      {
        const RecordPair records(loop.Mesh, corners);
        quad = records.GetQuad();
        outer = FlipEdge(loop.Mesh, edge, quad, records.Upper, records.Lower, flipped.Keep());
      }
      flipped.Store(loop.Mesh.Triangles);
      if (edge != NoEdge)
      {
        ++counts.Flipped;
        if (HasGuard<Worklist>(loop))
        {
          UpdateGuard(loop.Guard, edge, quad, counts);
        }
        MarkOuter(loop, outer);
      }
    });
  team.Add(IterationSum::Flipped, static_cast<unsigned>(counts.Flipped));
  if (HasGuard<Worklist>(loop))
  {
    team.Add(IterationSum::FreshSlots, static_cast<unsigned>(counts.FreshSlots));
    team.Add(IterationSum::LostInserts, static_cast<unsigned>(counts.LostInserts));
  }
}

}

#endif
