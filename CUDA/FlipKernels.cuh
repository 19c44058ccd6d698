// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "DeviceWorklist.cuh"
#include "EdgeBits.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "RoundSums.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// The loop on the device: the phases of an iteration on a worklist, many iterations in a launch.
/// Within a phase a thread works on one edge at a time; the phases' order, which the team's waits
/// keep, is all that results depend on.

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
  std::uint8_t* Flags; ///< Of the worklist's units; null: all are looked at.
  EdgeId NumberOfEdges;
  DeviceChunk* Chunks;
  int NumberOfChunks;
  TeamState* Teams; ///< Zero before a launch.
  RoundSums* Rounds; ///< One an iteration and one more; zero before a launch.
  int* RoundsDone; ///< Iterations of this launch.

  __device__ DeviceWorklist GetWorklist() const { return { 0, this->NumberOfEdges, this->Flags }; }
  __device__ DeviceWorklist GetWorklist(const DeviceChunk& chunk) const
  {
    return { chunk.FirstEdge, chunk.LastEdge, nullptr };
  }
};

/// ChooseStep's text on bits. Reads Bad, which does not change meanwhile; sets Winners.
template <typename Rule>
__device__ void Choose(const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  const ChooseStep choose{ loop.Mesh };
  worklist.Run(
    team,
    [&](const EdgeByte& byte)
    {
      const unsigned bad = byte.Load(loop.Bits.Bad);
      // There are no candidates now: what has nothing bad has nothing to do.
      worklist.Keep(byte, bad | (loop.Guard.Active ? byte.Load(loop.Bits.Obstructed) : 0));
      return bad;
    },
    [&](EdgeId edge)
    {
      const OuterHalfEdges outer = choose.Load(edge);
      const auto isBad = [&](HalfEdgeId halfEdge)
      { return EdgeBits::Has(loop.Bits.Bad, EdgeOf(halfEdge)); };
      const bool ap = isBad(outer.AP), qa = isBad(outer.QA);
      const bool pb = isBad(outer.PB), bq = isBad(outer.BQ);
      if (IsFirst(edge, outer, ap, qa, pb, bq))
      {
        EdgeBits::Set(loop.Bits.Winners, edge);
      }
    });
}

/// Winners claim their new edges.
template <typename Rule>
__device__ void Claim(const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  worklist.Run(
    team, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Winners); },
    [&](EdgeId edge)
    {
      const Quad quad = loop.Mesh.GetQuad(edge);
      loop.Guard.Claims.Claim(quad.A, quad.B, Priority(edge));
    });
}

/// Winners without their claim stay bad.
template <typename Rule>
__device__ void Confirm(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  worklist.Run(
    team, [&](const EdgeByte& byte) { return byte.Load(loop.Bits.Winners); },
    [&](EdgeId edge)
    {
      const Quad quad = loop.Mesh.GetQuad(edge);
      if (!loop.Guard.Claims.Holds(quad.A, quad.B, Priority(edge)))
      {
        AtomicAnd(&loop.Bits.Winners[edge / 32], ~(1u << (edge % 32)));
      }
    });
}

/// Flips the winners and makes their outer edges candidates.
template <typename Rule>
__device__ void FlipWinners(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  const SurgeryStep surgery{ { loop.Mesh }, loop.Guard };
  StepCounts counts;
  const auto mark = [&](HalfEdgeId halfEdge)
  {
    EdgeBits::Set(loop.Bits.Candidates, EdgeOf(halfEdge));
    worklist.Activate(EdgeOf(halfEdge));
  };
  worklist.Run(
    team,
    [&](const EdgeByte& byte)
    {
      const unsigned winners = byte.Load(loop.Bits.Winners);
      byte.Clear(loop.Bits.Winners, winners, winners);
      byte.Clear(loop.Bits.Bad, winners ? byte.Load(loop.Bits.Bad) : 0, winners);
      return winners;
    },
    [&](EdgeId edge)
    {
      const OuterHalfEdges outer = surgery.Flip(edge, loop.Mesh.GetQuad(edge), counts);
      mark(outer.AP);
      mark(outer.QA);
      mark(outer.PB);
      mark(outer.BQ);
    });
  team.Add(RoundSum::Flipped, static_cast<unsigned>(counts.Flipped));
  if (loop.Guard.Active)
  {
    team.Add(RoundSum::FreshSlots, static_cast<unsigned>(counts.FreshSlots));
    team.Add(RoundSum::LostInserts, static_cast<unsigned>(counts.LostInserts));
  }
}

/// On its own, because it is large and seldom called.
template <typename Rule>
__device__ __noinline__ EdgeState JudgeExactly(const LoopView<Rule>& loop, EdgeId edge)
{
  return loop.Decision.JudgeExactly(loop.Mesh.GetQuad(edge));
}

/// Judges the candidates, which are none any more then.
template <typename Rule>
__device__ void Detect(const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  unsigned tested = 0, uncertain = 0, wasBad = 0, isBad = 0, wasMisshapen = 0, isMisshapen = 0;
  worklist.Run(
    team,
    [&](const EdgeByte& byte)
    {
      // All are asked for before any is looked at.
      const unsigned marked = byte.Load(bits.Candidates);
      const unsigned asleep = byte.Load(bits.Asleep);
      const unsigned bad = byte.Load(bits.Bad);
      const unsigned misshapen = Rule::MayBlock ? byte.Load(bits.Misshapen) : 0;
      const unsigned obstructed = loop.Guard.Active ? byte.Load(bits.Obstructed) : 0;
      const unsigned candidates = marked & ~asleep;
      byte.Clear(bits.Candidates, marked, marked);
      byte.Clear(bits.Bad, bad, candidates & bad);
      byte.Clear(bits.Misshapen, misshapen, candidates & misshapen);
      byte.Clear(bits.Obstructed, obstructed, candidates & obstructed);
      tested += __popc(candidates);
      wasBad += __popc(candidates & bad);
      wasMisshapen += __popc(candidates & misshapen);
      return candidates;
    },
    [&](EdgeId edge)
    {
      EdgeState state = loop.Decision.Judge(loop.Mesh.GetQuad(edge));
      state = state == EdgeState::Uncertain ? JudgeExactly(loop, edge) : state;
      if (state == EdgeState::Bad)
      {
        EdgeBits::Set(bits.Bad, edge);
        ++isBad;
      }
      if (Rule::MayBlock && state == EdgeState::BlockedByShape)
      {
        EdgeBits::Set(bits.Misshapen, edge);
        ++isMisshapen;
      }
      uncertain += state == EdgeState::Uncertain ? 1 : 0;
    });
  team.Add(RoundSum::Tested, tested);
  team.Add(RoundSum::Uncertain, uncertain);
  team.Add(RoundSum::WasBad, wasBad);
  team.Add(RoundSum::IsBad, isBad);
  if (Rule::MayBlock)
  {
    team.Add(RoundSum::WasMisshapen, wasMisshapen);
    team.Add(RoundSum::IsMisshapen, isMisshapen);
  }
}

/// Blocks and frees what the guard says, of all edges that are bad or were blocked by it.
template <typename Rule>
__device__ void GuardBadEdges(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  const EdgeBits& bits = loop.Bits;
  const GuardStep guard{ { loop.Mesh }, loop.Guard.Edges };
  unsigned allBad = 0, allObstructed = 0;
  worklist.Run(
    team,
    [&](const EdgeByte& byte)
    {
      const unsigned bad = byte.Load(bits.Bad);
      const unsigned obstructed = byte.Load(bits.Obstructed);
      byte.Clear(bits.Bad, bad, bad);
      byte.Clear(bits.Obstructed, obstructed, obstructed);
      return bad | obstructed;
    },
    [&](EdgeId edge)
    {
      const bool isBad = guard.Decide(guard.Load(edge)) == EdgeState::Bad;
      EdgeBits::Set(isBad ? bits.Bad : bits.Obstructed, edge);
      allBad += isBad ? 1 : 0;
      allObstructed += isBad ? 0 : 1;
    });
  team.Add(RoundSum::AllBad, allBad);
  team.Add(RoundSum::AllObstructed, allObstructed);
}

/// Chooses and flips.
template <typename Rule>
__device__ void RunFlips(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, Team& team, RoundSums* round)
{
  Choose(loop, worklist, team);
  team.Wait(round);
  if (loop.Guard.Active)
  {
    Claim(loop, worklist, team);
    team.Wait(round);
    Confirm(loop, worklist, team);
    team.Wait(round);
  }
  FlipWinners(loop, worklist, team);
  team.Wait(round);
}

/// Judges and guards.
template <typename Rule>
__device__ void RunDetection(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, Team& team, RoundSums* round)
{
  Detect(loop, worklist, team);
  if (loop.Guard.Active)
  {
    // A warp guards the units that it judged.
    __syncwarp();
    GuardBadEdges(loop, worklist, team);
  }
  team.Wait(round);
}

/// Counts what is bad in a range.
template <typename Rule>
__device__ void CountAll(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  unsigned bad = 0, misshapen = 0, obstructed = 0;
  worklist.Run(
    team,
    [&](const EdgeByte& byte)
    {
      bad += __popc(byte.Load(loop.Bits.Bad));
      misshapen += __popc(byte.Load(loop.Bits.Misshapen));
      obstructed += __popc(byte.Load(loop.Bits.Obstructed));
      return 0u;
    },
    [](EdgeId) {});
  team.Add(RoundSum::AllBad, bad);
  team.Add(RoundSum::AllMisshapen, misshapen);
  team.Add(RoundSum::AllObstructed, obstructed);
}

/// A detection on the whole mesh, counted in Rounds[0], and a count of all that is bad, in
/// Rounds[1].
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  DetectAllKernel(const __grid_constant__ LoopView<Rule> loop)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, gridDim.x);
  const DeviceWorklist worklist = loop.GetWorklist();
  RunDetection(loop, worklist, team, &loop.Rounds[0]);
  CountAll(loop, worklist, team);
  team.Wait(&loop.Rounds[1]);
}

/// When a launch of IterateKernel ends.
struct IterationLimits
{
  int Iterations; ///< After so many,
  long long Bad; ///< which begin with so many bad edges,
  long long FewestBad, MostBad; ///< with fewer or more bad edges left,
  unsigned long long FreshSlots; ///< or when more slots of the guard table were used first.
};

__device__ inline long long GetSum(const RoundSums& round, RoundSum sum)
{
  return static_cast<long long>(AtomicLoad(&round.Values[static_cast<int>(sum)]));
}

/// Iterations on the whole mesh after a detection; what they count goes to Rounds, one each. The
/// last detection is missing when the guard's table must be made anew before it.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  IterateKernel(const __grid_constant__ LoopView<Rule> loop, IterationLimits limits)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, gridDim.x);
  const DeviceWorklist worklist = loop.GetWorklist();
  unsigned long long freshSlots = 0;
  long long bad = limits.Bad;
  int done = 0;
  for (bool goOn = true; goOn;)
  {
    RoundSums* round = &loop.Rounds[done++];
    RunFlips(loop, worklist, team, round);
    if (loop.Guard.Active)
    {
      freshSlots += GetSum(*round, RoundSum::FreshSlots);
      if (freshSlots > limits.FreshSlots || GetSum(*round, RoundSum::LostInserts) > 0)
      {
        break;
      }
    }
    RunDetection(loop, worklist, team, round);
    bad = loop.Guard.Active ? GetSum(*round, RoundSum::AllBad)
                            : bad - GetSum(*round, RoundSum::Flipped) -
        GetSum(*round, RoundSum::WasBad) + GetSum(*round, RoundSum::IsBad);
    goOn = done < limits.Iterations && bad >= limits.FewestBad && bad <= limits.MostBad &&
      GetSum(*round, RoundSum::Uncertain) == 0;
  }
  if (team.IsFirstThread())
  {
    *loop.RoundsDone = done;
  }
}

/// Rounds within chunks: a team takes a chunk through all of them, while it is in the cache, then
/// the next. They count in Rounds; Rounds[rounds] gets what was bad before.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  RunChunksKernel(const __grid_constant__ LoopView<Rule> loop, int blocksOfTeam, int rounds)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = team.GetIndex(); c < loop.NumberOfChunks; c += teams)
  {
    const DeviceWorklist worklist = loop.GetWorklist(loop.Chunks[c]);
    CountAll(loop, worklist, team);
    team.Wait(&loop.Rounds[rounds]);
    for (int i = 0; i < rounds; ++i)
    {
      RunFlips(loop, worklist, team, &loop.Rounds[i]);
      RunDetection(loop, worklist, team, &loop.Rounds[i]);
    }
  }
}

}

#endif
