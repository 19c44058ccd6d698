// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TEAM_CUH
#define DELAUNAYFLIP_TEAM_CUH

#include "EdgeMesh.h"
#include "HostDevice.h"
#include "RoundSums.h"

namespace delaunayflip
{

constexpr int WarpSize = 32;
constexpr unsigned WholeWarp = 0xFFFFFFFFu;

/// Threads of a block in the loop's kernels, and blocks on a multiprocessor, which leaves 80
/// registers a thread.
constexpr int LoopThreads = 384;
constexpr int LoopBlocks = 2;

/// What the blocks of a team share in device memory; zero before a launch.
struct alignas(128) TeamState
{
  unsigned int Arrivals;
};

constexpr int LoopWarps = LoopThreads / WarpSize;
/// Edges that a warp lists before it works on them: more than a full unit of a worklist.
constexpr int WarpListSize = 384;

/// Shared memory of a block.
struct TeamMemory
{
  EdgeId Lists[LoopWarps][WarpListSize];
  unsigned int Sums[NumberOfRoundSums];
};

/// Blocks of a cooperative launch that work together and wait for each other: the whole grid, or
/// the blocks on a chunk. All threads of a team make the same calls in the same order.
class Team
{
public:
  static constexpr int ListSize = WarpListSize;

  /// Blocks [team * size, (team + 1) * size) of the grid are a team.
  __device__ Team(TeamMemory& memory, TeamState* states, unsigned size)
    : Memory(memory),
      State(&states[blockIdx.x / size]),
      Size(size)
  {
    if (threadIdx.x < NumberOfRoundSums)
    {
      memory.Sums[threadIdx.x] = 0;
    }
    __syncthreads();
  }

  __device__ unsigned GetIndex() const { return blockIdx.x / this->Size; }

  /// This warp's list.
  __device__ EdgeId* GetList() const { return this->Memory.Lists[threadIdx.x / WarpSize]; }

  /// This thread among those of the team, and their number.
  __device__ unsigned GetThread() const
  {
    return (blockIdx.x % this->Size) * LoopThreads + threadIdx.x;
  }
  __device__ unsigned GetNumberOfThreads() const { return this->Size * LoopThreads; }
  __device__ bool IsFirstThread() const { return this->GetThread() == 0; }

  /// Counts what the threads of a warp say. All of them call it.
  __device__ void Add(RoundSum sum, unsigned value) const
  {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
    value = __reduce_add_sync(WholeWarp, value);
#else
    for (int distance = WarpSize / 2; distance > 0; distance /= 2)
    {
      value += __shfl_down_sync(WholeWarp, value, distance);
    }
#endif
    if (threadIdx.x % WarpSize == 0 && value != 0)
    {
      atomicAdd(&this->Memory.Sums[static_cast<int>(sum)], value);
    }
  }

  /// Adds what was counted to `round` and waits for all threads of the team; what they wrote before
  /// is then seen.
  __device__ void Wait(RoundSums* round)
  {
    __syncthreads();
    if (threadIdx.x == 0)
    {
      this->FlushSums(round);
      __threadfence();
      if (this->Size > 1)
      {
        this->Expected += this->Size;
        atomicAdd(&this->State->Arrivals, 1u);
        while (static_cast<int>(AtomicLoad(&this->State->Arrivals) - this->Expected) < 0)
        {
        }
        __threadfence();
      }
    }
    __syncthreads();
  }

private:
  __device__ void FlushSums(RoundSums* round) const
  {
    for (int i = 0; i < NumberOfRoundSums; ++i)
    {
      if (this->Memory.Sums[i] != 0)
      {
        atomicAdd(&round->Values[i], static_cast<unsigned long long>(this->Memory.Sums[i]));
        this->Memory.Sums[i] = 0;
      }
    }
  }

  TeamMemory& Memory;
  TeamState* State;
  unsigned Size;
  unsigned Expected = 0;
};

}

#endif
