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
  int SizeOfList; ///< Of all lists as one.
  unsigned int Sums[NumberOfRoundSums];
  unsigned int Expected; ///< Arrivals that the next wait waits for, but for its own.
};

__device__ inline TeamMemory& GetTeamMemory()
{
  __shared__ TeamMemory memory;
  return memory;
}

/// What the calling thread, or who waited for it, wrote before is seen by whoever acquires after.
__device__ inline void AddRelease(unsigned int* address)
{
  asm volatile("red.release.gpu.global.add.u32 [%0], 1;"
               :
               : "l"(__cvta_generic_to_global(address))
               : "memory");
}

__device__ inline unsigned int LoadAcquire(const unsigned int* address)
{
  unsigned int value = 0;
  asm volatile("ld.acquire.gpu.global.u32 %0, [%1];"
               : "=r"(value)
               : "l"(__cvta_generic_to_global(address))
               : "memory");
  return value;
}

/// Blocks of a cooperative launch that work together and wait for each other: the whole grid, or
/// the blocks on a chunk. All threads of a team make the same calls in the same order.
class Team
{
public:
  /// Blocks [team * size, (team + 1) * size) of the grid are a team.
  __device__ Team(TeamState* states, unsigned size)
    : State(&states[blockIdx.x / size]),
      Size(size)
  {
    TeamMemory& memory = GetTeamMemory();
    if (threadIdx.x < NumberOfRoundSums)
    {
      memory.Sums[threadIdx.x] = 0;
      memory.Expected = 0;
      memory.SizeOfList = 0;
    }
    __syncthreads();
  }

  __device__ unsigned GetIndex() const { return blockIdx.x / this->Size; }

  /// This warp's list, or all as one.
  __device__ EdgeId* GetList() const { return GetTeamMemory().Lists[threadIdx.x / WarpSize]; }
  __device__ EdgeId* GetListOfBlock() const { return GetTeamMemory().Lists[0]; }
  __device__ int* GetSizeOfList() const { return &GetTeamMemory().SizeOfList; }

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
      atomicAdd(&GetTeamMemory().Sums[static_cast<int>(sum)], value);
    }
  }

  /// Waits for all threads of the team; what they wrote before is then seen.
  __device__ void Wait()
  {
    __syncthreads();
    this->WaitForBlocks();
  }

  /// As Wait(), and adds what was counted since the last such call to `round`, unless null.
  __device__ void Wait(RoundSums* round)
  {
    __syncthreads();
    if (round && threadIdx.x < WarpSize)
    {
      this->FlushSums(round);
      __syncwarp();
    }
    this->WaitForBlocks();
  }

private:
  /// The first thread's release and acquire cover the block: barriers are before and behind.
  __device__ void WaitForBlocks()
  {
    if (this->Size > 1 && threadIdx.x == 0)
    {
      const unsigned expected = GetTeamMemory().Expected += this->Size;
      unsigned* arrivals = &this->State->Arrivals;
      AddRelease(arrivals);
      // To acquire empties the first-level cache, which another block may be using: not before all
      // are there.
      while (static_cast<int>(AtomicLoad(arrivals) - expected) < 0)
      {
      }
      LoadAcquire(arrivals);
    }
    __syncthreads();
  }

  __device__ void FlushSums(RoundSums* round) const
  {
    const unsigned i = threadIdx.x;
    if (i < NumberOfRoundSums && GetTeamMemory().Sums[i] != 0)
    {
      atomicAdd(&round->Values[i], static_cast<unsigned long long>(GetTeamMemory().Sums[i]));
      GetTeamMemory().Sums[i] = 0;
    }
  }

  TeamState* State;
  unsigned Size;
};

}

#endif
