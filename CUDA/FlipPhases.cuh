// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPPHASES_CUH
#define DELAUNAYFLIP_FLIPPHASES_CUH

#include "DeviceWorklist.cuh"
#include "EdgeBits.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "RecordStore.cuh"
#include "RoundSums.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// The phases of an iteration on a worklist of the device. Within a phase a thread works on one
/// edge at a time; the phases' order, which the team's waits keep, is all that results depend on.

namespace delaunayflip
{

/// The edges of a chunk of FlipLoop's schedule.
struct DeviceChunk
{
  EdgeId FirstEdge, LastEdge;
};

/// What the loop's kernels read and write.
template <typename Rule>
struct LoopView
{
  EdgeMeshView Mesh; ///< Its States are those at first.
  Rule Decision;
  EdgeGuardView Guard;
  EdgeBits Bits;
  int Splits; ///< 2^Splits warps share a unit.
  EdgeId NumberOfEdges;
  DeviceChunk* Chunks;
  int NumberOfChunks;
  TeamState* Teams; ///< Zero before a launch.
  RoundSums* Rounds; ///< One an iteration and one more; zero before a launch.
  int* RoundsDone; ///< Iterations of this launch.

  __device__ WarpWorklist GetWorklist() const { return { 0, this->NumberOfEdges, this->Splits }; }
  __device__ BlockWorklist GetWorklist(const DeviceChunk& chunk) const
  {
    return { chunk.FirstEdge, chunk.LastEdge };
  }
};

template <typename Worklist, typename Rule>
__device__ bool HasGuard(const LoopView<Rule>& loop)
{
  return Worklist::MayGuard && loop.Guard.Active;
}

/// Makes the outer edges of a flip candidates.
template <typename Rule>
__device__ void MarkOuter(const LoopView<Rule>& loop, const OuterHalfEdges& outer)
{
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.AP));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.QA));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.PB));
  EdgeBits::Set(loop.Bits.Candidates, EdgeOf(outer.BQ));
}

/// Whether a bad edge comes before its bad neighbours. Bad does not change meanwhile.
template <typename Rule>
__device__ bool Wins(const LoopView<Rule>& loop, EdgeId edge, const OuterHalfEdges& outer)
{
  const auto isBad = [&](HalfEdgeId halfEdge)
  { return EdgeBits::Has(loop.Bits.Bad, EdgeOf(halfEdge)); };
  const bool ap = isBad(outer.AP), qa = isBad(outer.QA);
  const bool pb = isBad(outer.PB), bq = isBad(outer.BQ);
  return IsFirst(edge, outer, ap, qa, pb, bq);
}

/// Chooses among the bad edges and flips the winners, which stay marked as bad until the next
/// detection, for others to choose by.
///
/// So an edge may be looked at while a neighbour flips. It loses then, as it must, whether its
/// words and its triangles are read as they were before that flip or as they are after: a triangle
/// that flips holds the flipped edge, which is bad and comes first, before and after; or it has
/// lost the edge that is looked at to its partner. What a winner reads nobody changes.
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
  team.Add(RoundSum::Flipped, flips);
}

/// Chooses alone, where winners have claims to make before they flip; sets Winners.
template <typename Rule, typename Worklist>
__device__ void Choose(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  const ChooseStep choose{ loop.Mesh };
  worklist.Run(
    team, loop.Mesh, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Bad); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge && Wins(loop, edge, choose.Load(corners)))
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

/// Winners without their claim stay bad.
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
  const SurgeryStep surgery{ { loop.Mesh }, loop.Guard };
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
          surgery.TellGuard(edge, quad, counts);
        }
        MarkOuter(loop, outer);
      }
    });
  team.Add(RoundSum::Flipped, static_cast<unsigned>(counts.Flipped));
  if (HasGuard<Worklist>(loop))
  {
    team.Add(RoundSum::FreshSlots, static_cast<unsigned>(counts.FreshSlots));
    team.Add(RoundSum::LostInserts, static_cast<unsigned>(counts.LostInserts));
  }
}

/// Sets what a judgement says. @returns whether the edge is bad.
template <typename Rule>
__device__ bool NoteState(
  const LoopView<Rule>& loop, EdgeId edge, EdgeState state, unsigned& misshapen)
{
  if (state == EdgeState::Bad)
  {
    EdgeBits::Set(loop.Bits.Bad, edge);
  }
  if (Rule::MayBlock && state == EdgeState::BlockedByShape)
  {
    EdgeBits::Set(loop.Bits.Misshapen, edge);
    ++misshapen;
  }
  return state == EdgeState::Bad;
}

/// Judges exactly what Detect could not tell and left as candidates. On its own, because it is
/// large and seldom called: within Detect's loop it would take the registers of all that goes on
/// there.
template <typename Rule, typename Worklist>
__device__ __noinline__ void ResolveUncertain(
  const LoopView<Rule>& loop, Worklist worklist, Team team)
{
  unsigned uncertain = 0, isBad = 0, isMisshapen = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned marked = byte.Load(loop.Bits.Candidates);
      const unsigned asleep = byte.Load(loop.Bits.Asleep);
      byte.Clear(loop.Bits.Candidates, marked, marked);
      return marked & ~asleep;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const EdgeState state = loop.Decision.JudgeExactly(loop.Mesh.GetQuad(corners));
      isBad += NoteState(loop, edge, state, isMisshapen) ? 1 : 0;
      uncertain += state == EdgeState::Uncertain ? 1 : 0;
    });
  team.Warn(uncertain > 0);
  team.Add(RoundSum::Uncertain, uncertain);
  team.Add(RoundSum::IsBad, isBad);
  team.Add(RoundSum::IsMisshapen, isMisshapen);
}

/// What a thread counts while it detects.
struct DetectionCounts
{
  unsigned Tested = 0, WasBad = 0, IsBad = 0, WasMisshapen = 0, IsMisshapen = 0;
  bool Uncertain = false;

  template <typename Rule>
  __device__ void AddTo(const Team& team) const
  {
    team.Add(RoundSum::Tested, this->Tested);
    team.Add(RoundSum::WasBad, this->WasBad);
    team.Add(RoundSum::IsBad, this->IsBad);
    if (Rule::MayBlock)
    {
      team.Add(RoundSum::WasMisshapen, this->WasMisshapen);
      team.Add(RoundSum::IsMisshapen, this->IsMisshapen);
    }
  }
};

/// Judges an edge by plain arithmetic; one of which that cannot tell stays a candidate.
template <typename Rule>
__device__ EdgeState JudgeAndNote(
  const LoopView<Rule>& loop, EdgeId edge, const CornerPair& corners, DetectionCounts& counts)
{
  const EdgeState state = loop.Decision.Judge(loop.Mesh.GetQuad(corners));
  if (state == EdgeState::Uncertain)
  {
    EdgeBits::Set(loop.Bits.Candidates, edge);
    counts.Uncertain = true;
  }
  counts.IsBad += NoteState(loop, edge, state, counts.IsMisshapen) ? 1 : 0;
  return state;
}

/// Judges the candidates, which are none any more then.
template <typename Rule, typename Worklist>
__device__ void Detect(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  DetectionCounts counts;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      // All are asked for before any is looked at.
      const unsigned marked = byte.Load(bits.Candidates);
      const unsigned asleep = byte.Load(bits.Asleep);
      const unsigned winners = byte.Load(bits.Winners);
      const unsigned seenBad = byte.Load(bits.Bad);
      const unsigned misshapen = Rule::MayBlock ? byte.Load(bits.Misshapen) : 0;
      const unsigned obstructed = HasGuard<Worklist>(loop) ? byte.Load(bits.Obstructed) : 0;
      const unsigned candidates = marked & ~asleep;
      const unsigned bad = seenBad & ~winners;
      byte.Clear(bits.Candidates, marked, marked);
      byte.Clear(bits.Winners, winners, winners);
      byte.Clear(bits.Bad, seenBad, winners | (candidates & bad));
      byte.Clear(bits.Misshapen, misshapen, candidates & misshapen);
      byte.Clear(bits.Obstructed, obstructed, candidates & obstructed);
      counts.Tested += __popc(candidates);
      counts.WasBad += __popc(candidates & bad);
      counts.WasMisshapen += __popc(candidates & misshapen);
      return candidates;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge != NoEdge)
      {
        JudgeAndNote(loop, edge, corners, counts);
      }
    });
  counts.AddTo<Rule>(team);
  if (worklist.IsAny(counts.Uncertain))
  {
    ResolveUncertain(loop, worklist, team);
  }
}

/// Blocks and frees what the guard says, of all edges that are bad or were blocked by it.
template <typename Rule, typename Worklist>
__device__ void GuardBadEdges(
  const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  const GuardStep guard{ { loop.Mesh }, loop.Guard.Edges };
  unsigned allBad = 0, allObstructed = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      const unsigned bad = byte.Load(bits.Bad);
      const unsigned obstructed = byte.Load(bits.Obstructed);
      byte.Clear(bits.Bad, bad, bad);
      byte.Clear(bits.Obstructed, obstructed, obstructed);
      return bad | obstructed;
    },
    [&](EdgeId edge, const CornerPair& corners)
    {
      if (edge == NoEdge)
      {
        return;
      }
      const bool isBad = guard.Decide(guard.Load(edge)) == EdgeState::Bad;
      EdgeBits::Set(isBad ? bits.Bad : bits.Obstructed, edge);
      allBad += isBad ? 1 : 0;
      allObstructed += isBad ? 0 : 1;
    });
  team.Add(RoundSum::AllBad, allBad);
  team.Add(RoundSum::AllObstructed, allObstructed);
}

/// Counts what is bad in a range.
template <typename Rule, typename Worklist>
__device__ void CountAll(const LoopView<Rule>& loop, const Worklist& worklist, const Team& team)
{
  unsigned bad = 0, misshapen = 0, obstructed = 0;
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte)
    {
      bad += __popc(byte.Load(loop.Bits.Bad));
      misshapen += __popc(byte.Load(loop.Bits.Misshapen));
      obstructed += __popc(byte.Load(loop.Bits.Obstructed));
      return 0u;
    },
    [](EdgeId, const CornerPair&) {});
  team.Add(RoundSum::AllBad, bad);
  team.Add(RoundSum::AllMisshapen, misshapen);
  team.Add(RoundSum::AllObstructed, obstructed);
}

}

#endif
