// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "DeviceWorklist.cuh"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <cstdint>

/// @file
/// The loop on the device: the phases of an iteration on a worklist, many iterations in one launch.

namespace delaunayflip
{

/// A chunk of FlipLoop's schedule: its edges, and how many were judged since the last choice.
struct DeviceChunk
{
  std::int64_t FirstEdge, LastEdge;
  StepCounts Judged; ///< By the last detection; Tested only.
};

/// What the loop's kernels read and write.
template <typename Rule>
struct LoopView
{
  EdgeMeshView Mesh;
  Rule Decision;
  EdgeGuardView Guard;
  std::uint8_t* Flags; ///< Of the worklists' blocks.
  std::int64_t NumberOfEdges;
  DeviceChunk* Chunks;
  int NumberOfChunks;
  TeamBarrier* Barriers; ///< One a team; zero before a launch.
  StepCounts* Rounds; ///< What every iteration counted; zero before a launch.
  int* RoundsDone; ///< Iterations of this launch.

  __device__ DeviceWorklist GetWorklist() const
  {
    return { this->Mesh.States, this->Flags, 0, this->NumberOfEdges };
  }

  /// A block at the border of two chunks has a flag for each.
  __device__ DeviceWorklist GetWorklist(int chunk) const
  {
    const DeviceChunk& c = this->Chunks[chunk];
    return { this->Mesh.States, this->Flags + (c.FirstEdge >> DeviceWorklist::BlockBits) + chunk,
      c.FirstEdge, c.LastEdge };
  }
};

template <typename Step>
__device__ StepCounts RunPhase(const Step& step, const DeviceWorklist& worklist, const Team& team)
{
  StepCounts counts;
  const WarpPlace place = team.GetPlace();
  worklist.ForFlaggedBlocks(
    place, [&](std::int64_t block) { worklist.Run(step, place, block, counts); });
  return counts;
}

/// Judges, resolves and guards what is new and counts what is bad.
template <typename Rule>
__device__ StepCounts RunDetection(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, const Team& team)
{
  StepCounts counts;
  const WarpPlace place = team.GetPlace();
  const JudgeStep<Rule> judge{ { loop.Mesh }, loop.Decision };
  const ResolveStep<Rule> resolve{ { loop.Mesh }, loop.Decision };
  const GuardStep guard{ { loop.Mesh }, loop.Guard.Edges };
  worklist.ForFlaggedBlocks(place,
    [&](std::int64_t block)
    {
      StepCounts part;
      worklist.Run(judge, place, block, part);
      if (__any_sync(WholeWarp, part.Uncertain > 0))
      {
        worklist.Run(resolve, place, block, part);
        part.Uncertain = worklist.CountUncertain(block);
      }
      if (loop.Guard.Active)
      {
        worklist.Run(guard, place, block, part);
      }
      worklist.Count(block, part);
      counts += part;
    });
  return counts;
}

/// Chooses the winners and flips them; the team has then to Wait before it goes on. Adds to *total.
template <typename Rule>
__device__ void RunFlips(
  const LoopView<Rule>& loop, const DeviceWorklist& worklist, Team& team, StepCounts* total)
{
  RunPhase(ChooseStep{ loop.Mesh }, worklist, team);
  team.Wait();
  if (loop.Guard.Active)
  {
    RunPhase(ClaimStep{ { loop.Mesh }, loop.Guard.Claims }, worklist, team);
    team.Wait();
    RunPhase(ConfirmStep{ { loop.Mesh }, loop.Guard.Claims }, worklist, team);
    team.Wait();
  }
  const FlipStep flip{ { loop.Mesh }, worklist.GetFlags(), loop.Guard };
  team.Add(RunPhase(flip, worklist, team), total);
}

/// A detection on the whole mesh; adds to Rounds[0].
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads) DetectKernel(LoopView<Rule> loop)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Barriers, gridDim.x);
  team.Add(RunDetection(loop, loop.GetWorklist(), team), &loop.Rounds[0]);
}

/// When a launch of IterateKernel ends.
struct IterationLimits
{
  int Iterations; ///< After so many,
  std::int64_t FewestBad, MostBad; ///< with fewer or more bad edges left,
  std::int64_t FreshSlots; ///< or when more slots of the guard table were used for the first time.
};

/// Iterations on the whole mesh after a detection. Iteration i adds its flips to Rounds[i] and what
/// it then detects to Rounds[i + 1]; the last detection is missing when the guard needs care.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads)
  IterateKernel(LoopView<Rule> loop, IterationLimits limits)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Barriers, gridDim.x);
  const DeviceWorklist worklist = loop.GetWorklist();
  std::int64_t freshSlots = 0;
  int done = 0;
  for (bool goOn = true; goOn;)
  {
    StepCounts* flipped = &loop.Rounds[done];
    StepCounts* found = &loop.Rounds[++done];
    RunFlips(loop, worklist, team, flipped);
    team.Wait();
    freshSlots += AtomicLoad(&flipped->FreshSlots);
    if (freshSlots > limits.FreshSlots || AtomicLoad(&flipped->LostInserts) > 0)
    {
      break;
    }
    team.Add(RunDetection(loop, worklist, team), found);
    team.Wait();
    const std::int64_t bad = AtomicLoad(&found->Bad);
    goOn = done < limits.Iterations && bad >= limits.FewestBad && bad <= limits.MostBad &&
      AtomicLoad(&found->Uncertain) == 0;
  }
  if (team.IsFirstThread())
  {
    *loop.RoundsDone = done;
  }
}

/// Takes a chunk through rounds. Round i adds to Rounds[i] what was found before it and what it
/// flipped; Rounds[rounds] learns what stays uncertain at the end.
template <typename Rule>
__device__ void RunChunk(const LoopView<Rule>& loop, int c, int rounds, Team& team)
{
  const DeviceWorklist worklist = loop.GetWorklist(c);
  StepCounts* judged = &loop.Chunks[c].Judged;
  StepCounts found;
  worklist.ForFlaggedBlocks(
    team.GetPlace(), [&](std::int64_t block) { worklist.Count(block, found); });
  found.Tested = team.IsFirstThread() ? judged->Tested : 0;
  for (int i = 0; i < rounds; ++i)
  {
    team.Add(found, &loop.Rounds[i]);
    team.Wait();
    RunFlips(loop, worklist, team, &loop.Rounds[i]);
    team.Wait();
    found = RunDetection(loop, worklist, team);
  }
  StepCounts last;
  last.Uncertain = found.Uncertain;
  team.Add(last, &loop.Rounds[rounds]);
  if (team.IsFirstThread())
  {
    judged->Tested = 0;
  }
  team.Wait();
  StepCounts tested;
  tested.Tested = found.Tested;
  team.Add(tested, judged);
}

/// Rounds within chunks: a team takes a chunk through all of them, while it is in the cache, then
/// the next.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads)
  RunChunksKernel(LoopView<Rule> loop, int blocksOfTeam, int rounds)
{
  __shared__ TeamMemory memory;
  Team team(memory, loop.Barriers, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = team.GetIndex(); c < loop.NumberOfChunks; c += teams)
  {
    RunChunk(loop, c, rounds, team);
  }
}

}

#endif
