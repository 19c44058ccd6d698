// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TEAM_CUH
#define DELAUNAYFLIP_TEAM_CUH

#include "DeviceWorklist.cuh"
#include "StepCounts.h"

#include <cstdint>

namespace delaunayflip
{

/// Threads of a block in the loop's kernels.
constexpr int LoopThreads = 256;
constexpr int LoopWarps = LoopThreads / WarpSize;

/// A team's barrier, in device memory, a cache line of its own; zero before the launch.
struct alignas(128) TeamBarrier
{
  unsigned int Arrivals;
};

/// Shared memory of a block.
struct TeamMemory
{
  EdgeId Found[LoopWarps][DeviceWorklist::BlockSize];
  unsigned int Sums[7]; ///< The members of StepCounts.
};

/// Blocks of a cooperative launch that work on one worklist and wait for each other: the whole
/// grid, or the blocks on a chunk. All threads of a team make the same calls in the same order.
class Team
{
public:
  /// Blocks [team * size, (team + 1) * size) of the grid are a team.
  __device__ Team(TeamMemory& memory, TeamBarrier* barriers, int size)
    : Memory(memory),
      Barrier(&barriers[blockIdx.x / size].Arrivals),
      Size(size)
  {
  }

  __device__ int GetIndex() const { return blockIdx.x / this->Size; }

  /// Whether this is one thread of the team.
  __device__ bool IsFirstThread() const { return blockIdx.x % this->Size == 0 && threadIdx.x == 0; }

  __device__ WarpPlace GetPlace() const
  {
    const int warp = threadIdx.x / WarpSize;
    // Warps of a block are far apart in the list, so that busy regions spread over the blocks.
    return { std::int64_t(blockIdx.x % this->Size) + std::int64_t(warp) * this->Size,
      std::int64_t(LoopWarps) * this->Size, this->Memory.Found[warp] };
  }

  /// Waits for all threads of the team; what they wrote before is then seen.
  __device__ void Wait()
  {
    __syncthreads();
    if (threadIdx.x == 0 && this->Size > 1)
    {
      __threadfence();
      this->Expected += this->Size;
      atomicAdd(this->Barrier, 1u);
      while (static_cast<int>(AtomicLoad(this->Barrier) - this->Expected) < 0)
      {
      }
      __threadfence();
    }
    __syncthreads();
  }

  /// Adds what the threads of this block counted to a total in device memory.
  __device__ void Add(const StepCounts& counts, StepCounts* total)
  {
    if (threadIdx.x < 7)
    {
      this->Memory.Sums[threadIdx.x] = 0;
    }
    __syncthreads();
    this->AddMember(0, counts.Tested);
    this->AddMember(1, counts.Uncertain);
    this->AddMember(2, counts.Bad);
    this->AddMember(3, counts.Blocked);
    this->AddMember(4, counts.Flipped);
    this->AddMember(5, counts.FreshSlots);
    this->AddMember(6, counts.LostInserts);
    __syncthreads();
    static_assert(sizeof(StepCounts) == 7 * sizeof(unsigned long long), "seven sums");
    if (threadIdx.x < 7 && this->Memory.Sums[threadIdx.x] != 0)
    {
      auto* sums = reinterpret_cast<unsigned long long*>(total);
      atomicAdd(&sums[threadIdx.x], this->Memory.Sums[threadIdx.x]);
    }
  }

private:
  __device__ void AddMember(int member, std::int64_t value)
  {
    unsigned int sum = static_cast<unsigned int>(value);
    for (int distance = WarpSize / 2; distance > 0; distance /= 2)
    {
      sum += __shfl_down_sync(WholeWarp, sum, distance);
    }
    if (threadIdx.x % WarpSize == 0 && sum != 0)
    {
      atomicAdd(&this->Memory.Sums[member], sum);
    }
  }

  TeamMemory& Memory;
  unsigned int* Barrier;
  int Size;
  unsigned int Expected = 0;
};

}

#endif
