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

/// Threads of a block in the loop's kernels, and blocks on a multiprocessor, which leaves 64
/// registers a thread.
constexpr int LoopThreads = 512;
constexpr int LoopBlocks = 2;

/// What the blocks of a team share in device memory; zero before a launch.
struct alignas(128) TeamState
{
  unsigned int Arrivals;
  /// Lengths of the lists that a round writes (DeviceLists); a round uses those of its parity.
  unsigned int Carried[2], Winners[2], Candidates[2];
};

/// Shared memory of a block.
struct TeamMemory
{
  unsigned int Sums[NumberOfRoundSums];
};

/// Blocks of a cooperative launch that work together and wait for each other: the whole grid, or
/// the blocks on a chunk. All threads of a team make the same calls in the same order.
class Team
{
public:
  /// Blocks [team * size, (team + 1) * size) of the grid are a team. @param first block of the
  /// grid that belongs to it.
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
  __device__ TeamState& GetState() const { return *this->State; }

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
    for (int distance = WarpSize / 2; distance > 0; distance /= 2)
    {
      value += __shfl_down_sync(WholeWarp, value, distance);
    }
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

/// Reserves room at the end of a list for `count` items of this thread: one atomic a warp. All
/// threads of a warp call it. @returns the place of the first.
__device__ inline unsigned Reserve(unsigned int* length, unsigned count)
{
  const unsigned lane = threadIdx.x % WarpSize;
  unsigned end = count;
  for (unsigned distance = 1; distance < WarpSize; distance *= 2)
  {
    const unsigned other = __shfl_up_sync(WholeWarp, end, distance);
    end += lane >= distance ? other : 0;
  }
  unsigned first = 0;
  if (lane == WarpSize - 1 && end != 0)
  {
    first = atomicAdd(length, end);
  }
  return __shfl_sync(WholeWarp, first, WarpSize - 1) + end - count;
}

/// The same for at most one item a thread.
__device__ inline unsigned ReserveOne(unsigned int* length, bool wanted)
{
  const unsigned lane = threadIdx.x % WarpSize;
  const unsigned wanting = __ballot_sync(WholeWarp, wanted);
  unsigned first = 0;
  if (lane == 0 && wanting != 0)
  {
    first = atomicAdd(length, static_cast<unsigned>(__popc(wanting)));
  }
  return __shfl_sync(WholeWarp, first, 0) + __popc(wanting & ((1u << lane) - 1));
}

}

#endif
