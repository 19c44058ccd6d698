// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "DetectionPhases.cuh"
#include "FlipPhases.cuh"
#include "ListedFlips.cuh"
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
  if (!HasGuard<Worklist>(loop))
  {
    ChooseAndFlip(loop, worklist, team);
    team.Wait();
    return;
  }
  Choose(loop, worklist, team);
  team.Wait();
  Claim(loop, worklist, team);
  team.Wait();
  Confirm(loop, worklist, team);
  team.Wait();
  FlipWinners(loop, worklist, team);
  // Whether to go on depends on the sums.
  team.Wait(round);
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

/// Iterations on the whole mesh, of one thread.
template <typename Rule>
class Iterations
{
public:
  __device__ Iterations(const LoopView<Rule>& loop, const IterationLimits& limits)
    : Loop(loop),
      Limits(limits),
      Members(loop.Teams, gridDim.x, loop.Splits > 0),
      Bad(limits.Bad),
      // A quarter of the room, for bad edges are not spread evenly. A guard needs no lists.
      MostListed(
        loop.Guard.Active ? 0 : Members.GetNumberOfThreads() / WarpSize * (MostListedByWarp / 4))
  {
  }

  /// @returns how many.
  __device__ int Run()
  {
    int done = 0;
    for (bool goOn = true; goOn;)
    {
      RoundSums* round = &this->Loop.Rounds[done++];
      this->Flip(round);
      goOn = this->HasRoom(round);
      if (goOn)
      {
        this->Detect(round);
        goOn = this->Bad > 0 && done < this->Limits.Iterations && !this->IsUncertain(round);
      }
    }
    return done;
  }

  __device__ bool IsFirstThread() const { return this->Members.IsFirstThread(); }

private:
  __device__ void Flip(RoundSums* round)
  {
    if (this->IsListed)
    {
      FlipListed(this->Loop, this->Members, this->List);
      this->Members.Wait();
      return;
    }
    RunFlips(this->Loop, this->Loop.GetWorklist(), this->Members, round);
  }

  /// Whether a detection may follow: not where the guard's table must be made anew first.
  __device__ bool HasRoom(const RoundSums* round)
  {
    if (!this->Loop.Guard.Active)
    {
      return true;
    }
    this->FreshSlots += LoadSum(*round, RoundSum::FreshSlots);
    return this->FreshSlots <= this->Limits.FreshSlots &&
      LoadSum(*round, RoundSum::LostInserts) == 0;
  }

  /// Lists what is bad where it is little, and where the last detection did.
  __device__ void Detect(RoundSums* round)
  {
    const WarpWorklist worklist = this->Loop.GetWorklist();
    const bool list = this->IsListed || this->Bad <= this->MostListed;
    if (list)
    {
      DetectAndList(this->Loop, worklist, this->Members, this->List);
      this->Members.Wait(round);
      this->IsListed = !this->Members.IsWarned();
    }
    else
    {
      RunDetection(this->Loop, worklist, this->Members, round);
    }
    this->Bad = this->Loop.Guard.Active ? LoadSum(*round, RoundSum::AllBad)
                                        : this->Limits.Bad + this->Members.GetBadChange();
    // Where there was no room there will be none until there is far less.
    this->MostListed = list && !this->IsListed ? this->Bad / 2 : this->MostListed;
  }

  /// Whether a device cannot tell of some edge. Those who could not have warned.
  __device__ bool IsUncertain(const RoundSums* round) const
  {
    return this->Members.IsWarned() && LoadSum(*round, RoundSum::Uncertain) > 0;
  }

  const LoopView<Rule>& Loop;
  const IterationLimits& Limits;
  Team Members;
  BadList List; ///< Of this warp. All warps' hold what is bad
  bool IsListed = false; ///< if so.
  long long Bad; ///< Edges.
  long long MostListed; ///< Bad edges of which detections make lists.
  unsigned long long FreshSlots = 0;
};

/// Iterations on the whole mesh after a detection; what they count goes to Rounds, one each. The
/// last detection is missing when the guard's table must be made anew before it.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks) IterateKernel(
  const __grid_constant__ LoopView<Rule> loop, const __grid_constant__ IterationLimits limits)
{
  Iterations<Rule> iterations(loop, limits);
  const int done = iterations.Run();
  if (iterations.IsFirstThread())
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
