// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "RoundSums.h"
#include "StateWords.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// The loop on the device: many iterations in one launch. Where a CPU searches its worklist for
/// states, a device keeps lists: of the bad edges, the winners, and the candidates. A thread works
/// on one item at a time; the order of a list changes from run to run, the set does not, and
/// nothing else matters to the result.

namespace delaunayflip
{

/// A chunk of FlipLoop's schedule: its edges, and how many were judged after its last round.
struct DeviceChunk
{
  std::int64_t FirstEdge, LastEdge;
  unsigned long long Judged;
};

/// What the loop's kernels read and write.
template <typename Rule>
struct LoopView
{
  EdgeMeshView Mesh;
  Rule Decision;
  EdgeGuardView Guard;
  std::int64_t NumberOfEdges;
  EdgeId* Lists[2]; ///< As long as the edges; a chunk has its edges' part.
  std::uint32_t* Marks; ///< A bit an edge: it is a candidate already, or none for ever.
  DeviceChunk* Chunks;
  int NumberOfChunks;
  TeamState* Teams; ///< Zero before a launch.
  RoundSums* Rounds; ///< One an iteration and one more; zero before a launch.
  int* RoundsDone; ///< Iterations of this launch.
};

/// One round's view of the lists. Bad edges come in Bad; those that stay, and those found bad
/// later, go to the front of Next, winners to its back. Then nobody needs Bad any more, and
/// candidates take its place.
struct RoundLists
{
  EdgeId* Bad;
  EdgeId* Next;
  unsigned Size; ///< Of either.
  int Parity; ///< Of the round.

  __device__ EdgeId* GetWinner(unsigned i) const { return &this->Next[this->Size - 1 - i]; }
};

/// Calls work(i, wanted) for the items of a list, in whole warps: `wanted` tells whether there is
/// an item i.
template <typename Work>
__device__ void ForItems(const Team& team, unsigned count, const Work& work)
{
  const unsigned stride = team.GetNumberOfThreads();
  for (unsigned i = team.GetThread(); i - threadIdx.x % WarpSize < count; i += stride)
  {
    work(i, i < count);
  }
}

/// Lists the bad edges of [first, last), blocked ones with them.
template <typename Rule>
__device__ void ListBadEdges(
  const LoopView<Rule>& loop, const Team& team, EdgeId first, EdgeId last, const RoundLists& lists)
{
  const EdgeId begin = first / StatesPerWord;
  const EdgeId words = (last + StatesPerWord - 1) / StatesPerWord - begin;
  const auto* states = reinterpret_cast<const std::uint64_t*>(loop.Mesh.States);
  unsigned int* length = &team.GetState().Carried[lists.Parity ^ 1];
  ForItems(team, first < last ? words : 0,
    [&](unsigned i, bool wanted)
    {
      const EdgeId edge = (begin + i) * StatesPerWord;
      std::uint64_t matches = 0;
      if (wanted)
      {
        matches = MatchStates(states[begin + i], { EdgeState::BlockedByEdge, EdgeState::Bad }) &
          MaskOfRange(edge, first, last);
      }
      unsigned place = Reserve(length, __popcll(matches));
      for (; matches != 0; matches &= matches - 1)
      {
        lists.Bad[place++] = edge + (__ffsll(matches) - 1) / 8;
      }
    });
}

/// Chooses the winners among the bad edges; the others are carried over.
template <typename Rule>
__device__ void Choose(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  TeamState& state = team.GetState();
  const ChooseStep choose{ loop.Mesh };
  unsigned carried = 0;
  ForItems(team, AtomicLoad(&state.Carried[lists.Parity ^ 1]),
    [&](unsigned i, bool wanted)
    {
      const EdgeId edge = wanted ? lists.Bad[i] : 0;
      EdgeState now = wanted ? AtomicLoad(&loop.Mesh.States[edge]) : EdgeState::Good;
      if (now == EdgeState::Bad)
      {
        now = choose.Decide(edge, choose.Load(edge));
      }
      const bool wins = now == EdgeState::Winner;
      const bool stays = now == EdgeState::Bad || now == EdgeState::BlockedByEdge;
      const unsigned winner = ReserveOne(&state.Winners[lists.Parity], wins);
      const unsigned next = ReserveOne(&state.Carried[lists.Parity], stays);
      if (wins)
      {
        AtomicStore(&loop.Mesh.States[edge], EdgeState::Winner);
      }
      if (wins || stays)
      {
        *(wins ? lists.GetWinner(winner) : &lists.Next[next]) = edge;
      }
      carried += stays ? 1 : 0;
    });
  team.Add(RoundSum::Carried, carried);
}

/// Winners claim their new edges.
template <typename Rule>
__device__ void Claim(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  const ClaimStep claim{ { loop.Mesh }, loop.Guard.Claims };
  ForItems(team, AtomicLoad(&team.GetState().Winners[lists.Parity]),
    [&](unsigned i, bool wanted)
    {
      if (wanted)
      {
        StepCounts none;
        claim(*lists.GetWinner(i), claim.Load(*lists.GetWinner(i)), none);
      }
    });
}

/// Winners without their claim are carried over.
template <typename Rule>
__device__ void Confirm(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  TeamState& state = team.GetState();
  const ConfirmStep confirm{ { loop.Mesh }, loop.Guard.Claims };
  ForItems(team, AtomicLoad(&state.Winners[lists.Parity]),
    [&](unsigned i, bool wanted)
    {
      bool stepsBack = false;
      const EdgeId edge = wanted ? *lists.GetWinner(i) : 0;
      if (wanted)
      {
        StepCounts none;
        confirm(edge, confirm.Load(edge), none);
        stepsBack = AtomicLoad(&loop.Mesh.States[edge]) != EdgeState::Winner;
      }
      const unsigned next = ReserveOne(&state.Carried[lists.Parity], stepsBack);
      if (stepsBack)
      {
        *lists.GetWinner(i) = NoEdge;
        lists.Next[next] = edge;
      }
    });
}

/// Sets an edge's mark. @returns whether it becomes a candidate by that.
__device__ inline bool Mark(std::uint32_t* marks, EdgeId edge)
{
  const std::uint32_t bit = 1u << (edge % 32);
  return (AtomicOr(&marks[edge / 32], bit) & bit) == 0;
}

/// Flips the winners and lists their outer edges as candidates.
template <typename Rule>
__device__ void FlipWinners(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  TeamState& state = team.GetState();
  const SurgeryStep surgery{ { loop.Mesh }, loop.Guard };
  StepCounts counts;
  ForItems(team, AtomicLoad(&state.Winners[lists.Parity]),
    [&](unsigned i, bool wanted)
    {
      const EdgeId edge = wanted ? *lists.GetWinner(i) : NoEdge;
      EdgeId outer[4] = {};
      bool fresh[4] = {};
      if (edge != NoEdge)
      {
        const OuterHalfEdges sides = surgery.Flip(edge, surgery.Load(edge), counts);
        outer[0] = EdgeOf(sides.AP);
        outer[1] = EdgeOf(sides.QA);
        outer[2] = EdgeOf(sides.PB);
        outer[3] = EdgeOf(sides.BQ);
        for (int k = 0; k < 4; ++k)
        {
          fresh[k] = Mark(loop.Marks, outer[k]);
        }
      }
      unsigned place =
        Reserve(&state.Candidates[lists.Parity], fresh[0] + fresh[1] + fresh[2] + fresh[3]);
      for (int k = 0; k < 4; ++k)
      {
        if (fresh[k])
        {
          lists.Bad[place++] = outer[k];
        }
      }
    });
  team.Add(RoundSum::Flipped, static_cast<unsigned>(counts.Flipped));
  if (loop.Guard.Active)
  {
    team.Add(RoundSum::FreshSlots, static_cast<unsigned>(counts.FreshSlots));
    team.Add(RoundSum::LostInserts, static_cast<unsigned>(counts.LostInserts));
  }
  if (team.IsFirstThread())
  {
    state.Carried[lists.Parity ^ 1] = 0;
    state.Winners[lists.Parity ^ 1] = 0;
    state.Candidates[lists.Parity ^ 1] = 0;
  }
}

/// On its own, because it is large and seldom called.
template <typename Rule>
__device__ __noinline__ EdgeState JudgeExactly(const LoopView<Rule>& loop, EdgeId edge)
{
  return loop.Decision.JudgeExactly(loop.Mesh.GetQuad(edge));
}

/// Whether an edge in that state is on the list of bad edges.
__device__ inline bool IsListed(EdgeState state)
{
  return state == EdgeState::Bad || state == EdgeState::BlockedByEdge;
}

/// Judges the candidates, which are none any more then, and lists those that are newly bad.
template <typename Rule>
__device__ void Detect(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  TeamState& state = team.GetState();
  unsigned uncertain = 0, newlyBad = 0, cured = 0, newlyMisshapen = 0, reshaped = 0;
  const unsigned candidates = AtomicLoad(&state.Candidates[lists.Parity]);
  ForItems(team, candidates,
    [&](unsigned i, bool wanted)
    {
      bool listed = false;
      const EdgeId edge = wanted ? lists.Bad[i] : 0;
      if (wanted)
      {
        const EdgeState before = loop.Mesh.States[edge];
        EdgeState now = loop.Decision.Judge(loop.Mesh.GetQuad(edge));
        now = now == EdgeState::Uncertain ? JudgeExactly(loop, edge) : now;
        AtomicAnd(&loop.Marks[edge / 32], ~(1u << (edge % 32)));
        if (now != before)
        {
          AtomicStore(&loop.Mesh.States[edge], now);
        }
        listed = now == EdgeState::Bad && !IsListed(before);
        newlyBad += listed ? 1 : 0;
        cured += IsListed(before) && now != EdgeState::Bad ? 1 : 0;
        newlyMisshapen +=
          now == EdgeState::BlockedByShape && before != EdgeState::BlockedByShape ? 1 : 0;
        reshaped += before == EdgeState::BlockedByShape && now != EdgeState::BlockedByShape ? 1 : 0;
        uncertain += now == EdgeState::Uncertain ? 1 : 0;
      }
      const unsigned next = ReserveOne(&state.Carried[lists.Parity], listed);
      if (listed)
      {
        lists.Next[next] = edge;
      }
    });
  team.Add(RoundSum::Uncertain, uncertain);
  team.Add(RoundSum::NewlyBad, newlyBad);
  team.Add(RoundSum::Cured, cured);
  team.Add(RoundSum::NewlyMisshapen, newlyMisshapen);
  team.Add(RoundSum::Reshaped, reshaped);
  team.Add(RoundSum::Tested, team.IsFirstThread() ? candidates : 0);
}

/// Blocks and frees what the guard says, of all edges on the list.
template <typename Rule>
__device__ void GuardBadEdges(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists)
{
  const GuardStep guard{ { loop.Mesh }, loop.Guard.Edges };
  unsigned bad = 0, blocked = 0;
  ForItems(team, AtomicLoad(&team.GetState().Carried[lists.Parity]),
    [&](unsigned i, bool wanted)
    {
      const EdgeId edge = wanted ? lists.Next[i] : 0;
      if (wanted && IsListed(loop.Mesh.States[edge]))
      {
        const EdgeState state = guard.Decide(guard.Load(edge));
        AtomicStore(&loop.Mesh.States[edge], state);
        bad += state == EdgeState::Bad ? 1 : 0;
        blocked += state == EdgeState::Bad ? 0 : 1;
      }
    });
  team.Add(RoundSum::GuardedBad, bad);
  team.Add(RoundSum::GuardedBlocked, blocked);
}

/// Chooses and flips.
template <typename Rule>
__device__ void RunFlips(
  const LoopView<Rule>& loop, Team& team, const RoundLists& lists, RoundSums* round)
{
  Choose(loop, team, lists);
  team.Wait(round);
  if (loop.Guard.Active)
  {
    Claim(loop, team, lists);
    team.Wait(round);
    Confirm(loop, team, lists);
    team.Wait(round);
  }
  FlipWinners(loop, team, lists);
  team.Wait(round);
}

template <typename Rule>
__device__ void RunDetection(
  const LoopView<Rule>& loop, Team& team, const RoundLists& lists, RoundSums* round)
{
  Detect(loop, team, lists);
  team.Wait(round);
  if (loop.Guard.Active)
  {
    GuardBadEdges(loop, team, lists);
    team.Wait(round);
  }
}

/// The lists of the next round.
__device__ inline RoundLists GetNext(const RoundLists& lists)
{
  return { lists.Next, lists.Bad, lists.Size, lists.Parity ^ 1 };
}

/// Judges all candidates of the mesh and counts what is bad, in Rounds[0]. A thread handles an edge
/// and writes its state.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  DetectAllKernel(const __grid_constant__ LoopView<Rule> loop)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, gridDim.x);
  const GuardStep guard{ { loop.Mesh }, loop.Guard.Edges };
  unsigned tested = 0, uncertain = 0, bad = 0, misshapen = 0, blocked = 0;
  ForItems(team, static_cast<unsigned>(loop.NumberOfEdges),
    [&](unsigned edge, bool wanted)
    {
      EdgeState state = wanted ? loop.Mesh.States[edge] : EdgeState::Good;
      if (state == EdgeState::Candidate)
      {
        ++tested;
        state = loop.Decision.Judge(loop.Mesh.GetQuad(edge));
        state = state == EdgeState::Uncertain ? JudgeExactly(loop, edge) : state;
        loop.Mesh.States[edge] = state;
      }
      if (loop.Guard.Active && IsListed(state))
      {
        state = guard.Decide(guard.Load(edge));
        loop.Mesh.States[edge] = state;
      }
      uncertain += state == EdgeState::Uncertain ? 1 : 0;
      bad += state == EdgeState::Bad ? 1 : 0;
      misshapen += state == EdgeState::BlockedByShape ? 1 : 0;
      blocked += state == EdgeState::BlockedByEdge ? 1 : 0;
    });
  team.Add(RoundSum::Tested, tested);
  team.Add(RoundSum::Uncertain, uncertain);
  team.Add(RoundSum::NewlyBad, bad);
  team.Add(RoundSum::NewlyMisshapen, misshapen);
  team.Add(RoundSum::GuardedBlocked, blocked);
  team.Wait(&loop.Rounds[0]);
}

/// When a launch of IterateKernel ends.
struct IterationLimits
{
  int Iterations; ///< After so many,
  unsigned FewestBad, MostBad; ///< with fewer or more bad edges left,
  unsigned long long FreshSlots; ///< or when more slots of the guard table were used first.
};

__device__ inline unsigned long long GetSum(const RoundSums& round, RoundSum sum)
{
  return AtomicLoad(&round.Values[static_cast<int>(sum)]);
}

/// Bad edges after a round.
__device__ inline unsigned CountBad(const RoundSums& round, bool guarded)
{
  return static_cast<unsigned>(guarded ? GetSum(round, RoundSum::GuardedBad)
                                       : GetSum(round, RoundSum::Carried) +
        GetSum(round, RoundSum::NewlyBad) - GetSum(round, RoundSum::Cured));
}

/// Whether the guard's table must be made anew before edges are judged. The candidates' states then
/// say what they are, for DetectAllKernel.
template <typename Rule>
__device__ bool HandOver(const LoopView<Rule>& loop, const Team& team, const RoundLists& lists,
  const RoundSums& round, unsigned long long& freshSlots, unsigned long long most)
{
  freshSlots += GetSum(round, RoundSum::FreshSlots);
  if (freshSlots <= most && GetSum(round, RoundSum::LostInserts) == 0)
  {
    return false;
  }
  ForItems(team, AtomicLoad(&team.GetState().Candidates[lists.Parity]),
    [&](unsigned i, bool wanted)
    {
      if (wanted)
      {
        AtomicStore(&loop.Mesh.States[lists.Bad[i]], EdgeState::Candidate);
      }
    });
  return true;
}

/// Iterations on the whole mesh after a detection; what they count goes to Rounds, one each. The
/// last detection is missing when the guard needs care.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  IterateKernel(const __grid_constant__ LoopView<Rule> loop, unsigned size, IterationLimits limits)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, gridDim.x);
  RoundLists lists{ loop.Lists[0], loop.Lists[1], size, 0 };
  ListBadEdges(loop, team, 0, static_cast<EdgeId>(loop.NumberOfEdges), lists);
  team.Wait(&loop.Rounds[0]);
  unsigned long long freshSlots = 0;
  int done = 0;
  for (bool goOn = true; goOn;)
  {
    RoundSums* round = &loop.Rounds[done++];
    RunFlips(loop, team, lists, round);
    if (loop.Guard.Active && HandOver(loop, team, lists, *round, freshSlots, limits.FreshSlots))
    {
      break;
    }
    RunDetection(loop, team, lists, round);
    const unsigned bad = CountBad(*round, loop.Guard.Active);
    goOn = done < limits.Iterations && bad >= limits.FewestBad && bad <= limits.MostBad &&
      GetSum(*round, RoundSum::Uncertain) == 0;
    lists = GetNext(lists);
  }
  if (team.IsFirstThread())
  {
    *loop.RoundsDone = done;
  }
}

/// What a chunk holds before its first round.
template <typename Rule>
__device__ void CountChunk(
  const LoopView<Rule>& loop, const Team& team, const DeviceChunk& chunk, const RoundLists& lists)
{
  const bool first = team.IsFirstThread();
  team.Add(RoundSum::Tested, first ? static_cast<unsigned>(chunk.Judged) : 0);
  team.Add(RoundSum::Carried, first ? AtomicLoad(&team.GetState().Carried[lists.Parity ^ 1]) : 0);
  unsigned misshapen = 0;
  ForItems(team, static_cast<unsigned>(chunk.LastEdge - chunk.FirstEdge),
    [&](unsigned i, bool wanted)
    {
      misshapen +=
        wanted && loop.Mesh.States[chunk.FirstEdge + i] == EdgeState::BlockedByShape ? 1 : 0;
    });
  team.Add(RoundSum::NewlyMisshapen, misshapen);
}

/// Takes a chunk through rounds, which count in Rounds; Rounds[rounds] gets what was there before.
template <typename Rule>
__device__ void RunChunk(const LoopView<Rule>& loop, DeviceChunk& chunk, int rounds, Team& team)
{
  RoundLists lists{ loop.Lists[0] + chunk.FirstEdge, loop.Lists[1] + chunk.FirstEdge,
    static_cast<unsigned>(chunk.LastEdge - chunk.FirstEdge), 0 };
  ListBadEdges(
    loop, team, static_cast<EdgeId>(chunk.FirstEdge), static_cast<EdgeId>(chunk.LastEdge), lists);
  team.Wait(&loop.Rounds[rounds]);
  CountChunk(loop, team, chunk, lists);
  team.Wait(&loop.Rounds[rounds]);
  for (int i = 0; i < rounds; ++i)
  {
    RunFlips(loop, team, lists, &loop.Rounds[i]);
    RunDetection(loop, team, lists, &loop.Rounds[i]);
    lists = GetNext(lists);
  }
  if (team.IsFirstThread())
  {
    TeamState& state = team.GetState();
    chunk.Judged = state.Candidates[lists.Parity ^ 1];
    for (int parity = 0; parity < 2; ++parity)
    {
      state.Carried[parity] = 0;
      state.Winners[parity] = 0;
      state.Candidates[parity] = 0;
    }
  }
  team.Wait(&loop.Rounds[rounds]);
}

/// Rounds within chunks: a team takes a chunk through all of them, while it is in the cache, then
/// the next.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  RunChunksKernel(const __grid_constant__ LoopView<Rule> loop, int blocksOfTeam, int rounds)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Teams, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = team.GetIndex(); c < loop.NumberOfChunks; c += teams)
  {
    RunChunk(loop, loop.Chunks[c], rounds, team);
  }
}

}

#endif
