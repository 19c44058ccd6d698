// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "DetectionPhases.cuh"
#include "FlipPhases.cuh"
#include "IterationSums.h"
#include "ListedFlips.cuh"
#include "Team.cuh"

/// @file
/// The loop on the device: many iterations in a launch.

namespace delaunayflip
{

/// Waits in an iteration at most: four in RunFlips, where there is a guard, and one in
/// RunDetection.
constexpr int MostWaits = 5;

/// Iterations in a launch of IterateKernel at most: few enough that an observer hears of them and
/// can stop the run in time.
constexpr int MostIterations = 128;

/// Blocks in such a launch at most, so that what they tell each other stays in its bits.
constexpr int MostIterateBlocks = TeamNews::MostArrivals / (MostIterations * MostWaits);
static_assert(MostIterateBlocks < 1 << TeamNews::WarningBits, "all may warn at the same wait");
static_assert(MostIterateBlocks >= 1024, "enough for any GPU; else lower MostIterations");

/// Chooses and flips.
template <typename Rule, typename Worklist>
__device__ void RunFlips(
  const LoopView<Rule>& loop, const Worklist& worklist, Team& team, IterationSums* iteration)
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
  team.Wait(iteration);
}

/// Judges and guards.
template <typename Rule, typename Worklist>
__device__ void RunDetection(
  const LoopView<Rule>& loop, const Worklist& worklist, Team& team, IterationSums* iteration)
{
  Detect(loop, worklist, team);
  if (HasGuard<Worklist>(loop))
  {
    // A warp guards the units that it judged.
    __syncwarp();
    GuardBadEdges(loop, worklist, team);
  }
  team.Wait(iteration);
}

/// A detection on the whole mesh, counted in Sums[0], and a count of all that is bad, in
/// Sums[1].
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  DetectAllKernel(const __grid_constant__ LoopView<Rule> loop)
{
  Team team(loop.Teams, gridDim.x);
  const WarpWorklist worklist = loop.GetWorklist();
  RunDetection(loop, worklist, team, &loop.Sums[0]);
  CountAll(loop, worklist, team);
  team.Wait(&loop.Sums[1]);
}

/// When a launch of IterateKernel ends.
struct IterationLimits
{
  int Iterations; ///< After so many,
  long long Bad; ///< which begin with so many bad edges; when none is left;
  unsigned long long FreshSlots; ///< or when more slots of the guard table were used first.
};

__device__ inline long long LoadSum(const IterationSums& iteration, IterationSum sum)
{
  return static_cast<long long>(AtomicLoad(&iteration.Values[static_cast<int>(sum)]));
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
      IterationSums* iteration = &this->Loop.Sums[done++];
      this->Flip(iteration);
      goOn = this->HasRoom(iteration);
      if (goOn)
      {
        this->Detect(iteration);
        goOn = this->Bad > 0 && done < this->Limits.Iterations && !this->IsUncertain(iteration);
      }
    }
    return done;
  }

  __device__ bool IsFirstThread() const { return this->Members.IsFirstThread(); }

private:
  __device__ void Flip(IterationSums* iteration)
  {
    if (this->IsListed)
    {
      FlipListed(this->Loop, this->Members, this->List);
      this->Members.Wait();
      return;
    }
    RunFlips(this->Loop, this->Loop.GetWorklist(), this->Members, iteration);
  }

  /// Whether a detection may follow: not where the guard's table must be made anew first.
  __device__ bool HasRoom(const IterationSums* iteration)
  {
    if (!this->Loop.Guard.Active)
    {
      return true;
    }
    this->FreshSlots += LoadSum(*iteration, IterationSum::FreshSlots);
    return this->FreshSlots <= this->Limits.FreshSlots &&
      LoadSum(*iteration, IterationSum::LostInserts) == 0;
  }

  /// Lists what is bad where it is little, and where the last detection did.
  __device__ void Detect(IterationSums* iteration)
  {
    const WarpWorklist worklist = this->Loop.GetWorklist();
    const bool list = this->IsListed || this->Bad <= this->MostListed;
    if (list)
    {
      DetectAndList(this->Loop, worklist, this->Members, this->List);
      this->Members.Wait(iteration);
      this->IsListed = !this->Members.IsWarned();
    }
    else
    {
      RunDetection(this->Loop, worklist, this->Members, iteration);
    }
    this->Bad = this->Loop.Guard.Active ? LoadSum(*iteration, IterationSum::AllBad)
                                        : this->Limits.Bad + this->Members.GetBadChange();
    // Where there was no room there will be none until there is far less.
    this->MostListed = list && !this->IsListed ? this->Bad / 2 : this->MostListed;
  }

  /// Whether a device cannot tell of some edge. Those who could not have warned.
  __device__ bool IsUncertain(const IterationSums* iteration) const
  {
    return this->Members.IsWarned() && LoadSum(*iteration, IterationSum::Uncertain) > 0;
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

/// Iterations on the whole mesh after a detection; what they count goes to Sums, one each. The
/// last detection is missing when the guard's table must be made anew before it.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks) IterateKernel(
  const __grid_constant__ LoopView<Rule> loop, const __grid_constant__ IterationLimits limits)
{
  Iterations<Rule> iterations(loop, limits);
  const int done = iterations.Run();
  if (iterations.IsFirstThread())
  {
    *loop.IterationsDone = done;
  }
}

/// Sums within chunks: a team takes a chunk through all of them, while it is in the cache, then
/// the next. They count in Sums; Sums[iterations] gets what was bad before.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  RunChunksKernel(const __grid_constant__ LoopView<Rule> loop, int blocksOfTeam, int iterations)
{
  Team team(loop.Teams, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = team.GetIndex(); c < loop.NumberOfChunks; c += teams)
  {
    const BlockWorklist worklist = loop.GetWorklist(loop.Chunks[c]);
    CountAll(loop, worklist, team);
    team.Wait(&loop.Sums[iterations]);
    for (int i = 0; i < iterations; ++i)
    {
      RunFlips(loop, worklist, team, &loop.Sums[i]);
      RunDetection(loop, worklist, team, &loop.Sums[i]);
    }
  }
}

}

#endif
