// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DEVICEWORKLIST_CUH
#define DELAUNAYFLIP_DEVICEWORKLIST_CUH

#include "EdgeMesh.h"
#include "FlipSteps.h"
#include "StateWords.h"
#include "StepCounts.h"

#include <cstdint>

/// @file
/// What EdgeWorklist.h is on the CPU: the edges of a range that are in a wanted state, found
/// through a flag a block of 256. A warp handles a block: each lane looks at eight states, then the
/// warp shares the edges that were found.

namespace delaunayflip
{

constexpr int WarpSize = 32;
constexpr unsigned WholeWarp = 0xFFFFFFFFu;

/// Blocks of threads that work together on one worklist: which warp of them this one is.
struct WarpPlace
{
  std::int64_t Warp;
  std::int64_t NumberOfWarps;
  EdgeId* Found; ///< Shared memory for the edges of a block of this warp.
};

class DeviceWorklist
{
public:
  static constexpr int BlockBits = 8;
  static constexpr std::int64_t BlockSize = std::int64_t(1) << BlockBits;

  /// Edges [first, last). @param flags one a block that the range touches.
  __device__ DeviceWorklist(
    const EdgeState* states, std::uint8_t* flags, std::int64_t first, std::int64_t last)
    : States(states),
      FirstEdge(first),
      LastEdge(last),
      Flags(flags)
  {
  }

  __device__ BlockFlags GetFlags() const
  {
    return { this->Flags, this->FirstEdge, this->LastEdge, BlockBits };
  }

  /// Calls work(block) for every flagged block of this warp.
  template <typename Work>
  __device__ void ForFlaggedBlocks(const WarpPlace& place, const Work& work) const
  {
    const std::int64_t firstBlock = this->FirstEdge >> BlockBits;
    const std::int64_t blocks =
      this->FirstEdge < this->LastEdge ? ((this->LastEdge - 1) >> BlockBits) - firstBlock + 1 : 0;
    const int lane = threadIdx.x % WarpSize;
    for (std::int64_t base = place.Warp; base < blocks; base += WarpSize * place.NumberOfWarps)
    {
      // One flag a lane: the loads are under way together.
      const std::int64_t own = base + lane * place.NumberOfWarps;
      const bool flagged = own < blocks && AtomicLoad(&this->Flags[own]) != 0;
      for (unsigned left = __ballot_sync(WholeWarp, flagged); left != 0; left &= left - 1)
      {
        work(firstBlock + base + (__ffs(left) - 1) * place.NumberOfWarps);
      }
    }
  }

  /// Runs a step on the edges of a block that are in a state it wants.
  template <typename Step>
  __device__ void Run(
    const Step& step, const WarpPlace& place, std::int64_t block, StepCounts& counts) const
  {
    const int size = this->Find(Step::Wanted, place, block);
    RunOnEdges(step, place.Found, size, counts, 0);
    __syncwarp();
  }

  /// CountStep, and the block's flag: whether it stays on the list.
  __device__ void Count(std::int64_t block, StepCounts& counts) const
  {
    const int bad = __popcll(this->Match({ EdgeState::Bad, EdgeState::Bad }, block));
    const int all = __popcll(this->Match(CountStep::Wanted, block));
    counts.Bad += bad;
    counts.Blocked += all - bad;
    if (!__any_sync(WholeWarp, all > 0) && threadIdx.x % WarpSize == 0)
    {
      this->Flags[block - (this->FirstEdge >> BlockBits)] = 0;
    }
  }

  /// Edges of this lane that are still uncertain.
  __device__ int CountUncertain(std::int64_t block) const
  {
    return __popcll(this->Match({ EdgeState::Uncertain, EdgeState::Uncertain }, block));
  }

private:
  /// Edges whose data a lane has under way at a time.
  static constexpr int Batch = 2;

  __device__ static std::int64_t FirstOfLane(std::int64_t block)
  {
    return block * BlockSize + StatesPerWord * (threadIdx.x % WarpSize);
  }

  /// MatchStates for this lane's edges of the block.
  __device__ std::uint64_t Match(StateRange wanted, std::int64_t block) const
  {
    const std::int64_t first = FirstOfLane(block);
    const auto* words = reinterpret_cast<const std::uint64_t*>(this->States);
    return MatchStates(AtomicLoad(&words[first / StatesPerWord]), wanted) &
      MaskOfRange(first, this->FirstEdge, this->LastEdge);
  }

  /// Lists the block's edges in a wanted state, in order. @returns how many.
  __device__ int Find(StateRange wanted, const WarpPlace& place, std::int64_t block) const
  {
    std::uint64_t matches = this->Match(wanted, block);
    const int lane = threadIdx.x % WarpSize;
    const int own = __popcll(matches);
    int end = own;
    for (int distance = 1; distance < WarpSize; distance *= 2)
    {
      const int other = __shfl_up_sync(WholeWarp, end, distance);
      end += lane >= distance ? other : 0;
    }
    const std::int64_t first = FirstOfLane(block);
    for (EdgeId* next = place.Found + (end - own); matches != 0; matches &= matches - 1)
    {
      *next++ = static_cast<EdgeId>(first + (__ffsll(matches) - 1) / 8);
    }
    __syncwarp();
    return __shfl_sync(WholeWarp, end, WarpSize - 1);
  }

  /// Steps that decide: all loads of a batch, then all decisions, then all stores. A lane without
  /// an edge of its own repeats the last one and stores nothing.
  template <typename Step>
  __device__ static auto RunOnEdges(const Step& step, const EdgeId* edges, int size,
    StepCounts& counts, int) -> decltype(step.Decide(0, step.Load(0)), void())
  {
    for (int i = threadIdx.x % WarpSize; i - static_cast<int>(threadIdx.x % WarpSize) < size;
         i += Batch * WarpSize)
    {
      decltype(step.Load(0)) items[Batch];
      EdgeState states[Batch];
#pragma unroll
      for (int k = 0; k < Batch; ++k)
      {
        items[k] = step.Load(edges[min(i + k * WarpSize, size - 1)]);
      }
#pragma unroll
      for (int k = 0; k < Batch; ++k)
      {
        states[k] = step.Decide(edges[min(i + k * WarpSize, size - 1)], items[k]);
      }
#pragma unroll
      for (int k = 0; k < Batch; ++k)
      {
        if (i + k * WarpSize < size)
        {
          step.Store(edges[i + k * WarpSize], states[k], counts);
        }
      }
    }
  }

  template <typename Step>
  __device__ static void RunOnEdges(
    const Step& step, const EdgeId* edges, int size, StepCounts& counts, ...)
  {
    for (int i = threadIdx.x % WarpSize; i < size; i += WarpSize)
    {
      step(edges[i], step.Load(edges[i]), counts);
    }
  }

  const EdgeState* States;
  std::int64_t FirstEdge;
  std::int64_t LastEdge;
  std::uint8_t* Flags;
};

}

#endif
