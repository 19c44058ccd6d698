// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "FlipPhases.cuh"
#include "RoundSums.h"
#include "Team.cuh"

/// @file
/// The loop on the device: many iterations in a launch.

namespace delaunayflip
{

/// Chooses and flips.
template <typename Rule, typename Worklist>
__device__ void RunFlips(
  const LoopView<Rule>& loop, const Worklist& worklist, Team& team, RoundSums* round)
{
  Choose(loop, worklist, team);
  team.Wait();
  if (HasGuard<Worklist>(loop))
  {
    Claim(loop, worklist, team);
    team.Wait();
    Confirm(loop, worklist, team);
    team.Wait();
  }
  FlipWinners(loop, worklist, team);
  // Who has a guard decides by the sums whether to go on.
  team.Wait(HasGuard<Worklist>(loop) ? round : nullptr);
}

/// Judges and guards.
template <typename Rule, typename Worklist>
__device__ void RunDetection(
  const LoopView<Rule>& loop, const Worklist& worklist, Team& team, RoundSums* round)
{
  Detect(loop, worklist, team);
  if (HasGuard<Worklist>(loop))
  {
    // A warp guards the units that it judged.
    __syncwarp();
    GuardBadEdges(loop, worklist, team);
  }
  team.Wait(round);
}

/// A detection on the whole mesh, counted in Rounds[0], and a count of all that is bad, in
/// Rounds[1].
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  DetectAllKernel(const __grid_constant__ LoopView<Rule> loop)
{
  Team team(loop.Teams, gridDim.x);
  const WarpWorklist worklist = loop.GetWorklist();
  RunDetection(loop, worklist, team, &loop.Rounds[0]);
  CountAll(loop, worklist, team);
  team.Wait(&loop.Rounds[1]);
}

/// When a launch of IterateKernel ends.
struct IterationLimits
{
  int Iterations; ///< After so many,
  long long Bad; ///< which begin with so many bad edges; when none is left;
  unsigned long long FreshSlots; ///< or when more slots of the guard table were used first.
};

__device__ inline long long LoadSum(const RoundSums& round, RoundSum sum)
{
  return static_cast<long long>(AtomicLoad(&round.Values[static_cast<int>(sum)]));
}

/// Iterations on the whole mesh after a detection; what they count goes to Rounds, one each. The
/// last detection is missing when the guard's table must be made anew before it.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  IterateKernel(const __grid_constant__ LoopView<Rule> loop, IterationLimits limits)
{
  Team team(loop.Teams, gridDim.x);
  const WarpWorklist worklist = loop.GetWorklist();
  unsigned long long freshSlots = 0;
  long long bad = limits.Bad;
  int done = 0;
  for (bool goOn = true; goOn;)
  {
    RoundSums* round = &loop.Rounds[done++];
    RunFlips(loop, worklist, team, round);
    if (loop.Guard.Active)
    {
      freshSlots += LoadSum(*round, RoundSum::FreshSlots);
      if (freshSlots > limits.FreshSlots || LoadSum(*round, RoundSum::LostInserts) > 0)
      {
        break;
      }
    }
    RunDetection(loop, worklist, team, round);
    bad = loop.Guard.Active ? LoadSum(*round, RoundSum::AllBad)
                            : bad - LoadSum(*round, RoundSum::Flipped) -
        LoadSum(*round, RoundSum::WasBad) + LoadSum(*round, RoundSum::IsBad);
    goOn = done < limits.Iterations && bad > 0 && LoadSum(*round, RoundSum::Uncertain) == 0;
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
  Team team(loop.Teams, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = team.GetIndex(); c < loop.NumberOfChunks; c += teams)
  {
    const BlockWorklist worklist = loop.GetWorklist(loop.Chunks[c]);
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
