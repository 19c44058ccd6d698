// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TEAM_CUH
#define DELAUNAYFLIP_TEAM_CUH

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgeMesh.h"

namespace delaunayflip
{

/// The counts of an iteration on a device. Bad and blocked edges are counted as changes.
enum class IterationSum
{
  Flipped,
  FreshSlots, ///< Slots of the guard table that were empty.
  FreedSlots, ///< Slots of the guard table that are empty now.
  LostInserts, ///< New edges that found no room in the guard table.
  Tested,
  Uncertain, ///< Edges that a device cannot decide.
  WasBad, ///< Tested edges that were bad before; IsBad: that are bad afterwards.
  IsBad,
  WasBlockedByShape,
  IsBlockedByShape,
  Contested, ///< New edges of two listed edges.
  AllBad, ///< All bad edges, in the first detection.
  AllBlockedByEdge, ///< All edges that the guard blocks.
  AllBlockedByShape, ///< All of EdgeState::BlockedByShape, in the first detection.
  Count
};

constexpr int NumberOfIterationSums = static_cast<int>(IterationSum::Count);

struct IterationSums
{
  unsigned long long Values[NumberOfIterationSums];
};

constexpr int WarpSize = 32;
constexpr unsigned WholeWarp = 0xFFFFFFFFu;

/// The number of threads per block in the loop's kernels, and of blocks per multiprocessor, which
/// leaves 80 registers per thread.
constexpr int LoopThreads = 384;
constexpr int LoopBlocks = 2;

/// What the blocks of a team share in device memory; zero before a launch.
struct alignas(128) TeamState
{
  unsigned long long Arrivals; ///< TeamNews of all blocks so far.
  unsigned int Present; ///< Blocks that have called Team::Meet.
  unsigned int Verdict; ///< How Team::Meet ended: 1: all are present; 2: they are not.
};

/// What thread blocks tell each other when they arrive at a barrier. Every block adds its own
/// number to one number of 64 bits, and all blocks read the sum:
///
/// | bits     | sum over the blocks of                  | range                                   |
/// |----------|-----------------------------------------|-----------------------------------------|
/// | 0 .. 19  | 1: how many have arrived, at all waits  | modulo 2^20; compared with an expected  |
/// |          |                                         | number                                  |
/// | 20 .. 51 | the change of the number of bad edges   | signed, 32 bits                         |
/// | 52 .. 63 | 1 if the block warns                    | modulo 2^12; only a change of it counts |
///
/// More than MostArrivals in a launch carry into the change of bad edges, so only kernels that read
/// neither this nor the warnings may have so many (RunChunksKernel); MostIterateBlocks keeps
/// IterateKernel below. A negative change borrows from the warnings; GetWarnings() puts that right.
struct TeamNews
{
  static constexpr int ArrivalBits = 20;
  static constexpr int MostArrivals = (1 << ArrivalBits) - 1;
  static constexpr int WarningShift = ArrivalBits + 32;
  static constexpr int WarningBits = 64 - WarningShift;

  unsigned long long Value;

  __device__ static TeamNews Make(bool warns, int badChange)
  {
    const auto change = static_cast<unsigned long long>(static_cast<long long>(badChange));
    const auto warnings = static_cast<unsigned long long>(warns);
    return { 1ull + (change << ArrivalBits) + (warnings << WarningShift) };
  }
  __device__ bool HasArrived(unsigned expected) const
  {
    constexpr int Unused = 32 - ArrivalBits;
    return static_cast<int>((static_cast<unsigned>(this->Value) - expected) << Unused) >= 0;
  }
  __device__ int GetBadChange() const { return static_cast<int>(this->Value >> ArrivalBits); }
  /// Modulo 2^12, which is more than blocks can be at a time.
  __device__ unsigned GetWarnings() const
  {
    // A negative number has borrowed from the bits above it.
    const auto borrowed = unsigned(this->GetBadChange() < 0);
    const auto warnings = static_cast<unsigned>(this->Value >> WarningShift);
    return (warnings + borrowed) & ((1u << WarningBits) - 1);
  }
};

constexpr int LoopWarps = LoopThreads / WarpSize;
/// Room for the edges that a warp lists before it works on them: more than a full unit of a
/// worklist.
constexpr int WarpListSize = 384;

/// Room for the bad edges that a block lists where there are few.
constexpr int MostListed = 48 * LoopWarps;

/// Shared memory of a block.
struct TeamMemory
{
  EdgeId Lists[LoopWarps][WarpListSize];
  int SizeOfList; ///< The size of all lists together.
  BadEdge Listed[MostListed];
  std::uint32_t Claims[MostListed]; ///< With a guard: the slots of EdgeClaims of the listed edges.
  int NumberListed; ///< Bad edges, also those that found no room.
  unsigned int Sums[NumberOfIterationSums];
  unsigned int Expected; ///< Arrivals up to and including the last wait.
  unsigned int Warns; ///< Whether this block warns at the next wait.
  int BadChange; ///< Change of this block's number of bad edges since the last wait.
  TeamNews News; ///< From the last wait.
  bool IsWarned; ///< Whether a thread warned before the last wait.
};

__device__ inline TeamMemory& GetTeamMemory()
{
  __shared__ TeamMemory memory;
  return memory;
}

/// Threads that acquire after this see what the calling thread, and those it waited for, wrote
/// before.
/// @param isShared whether they may be on other GPUs.
__device__ inline void AddRelease(
  unsigned long long* address, unsigned long long value, bool isShared)
{
  const std::size_t global = __cvta_generic_to_global(address);
  if (isShared)
  {
    asm volatile("red.release.sys.global.add.u64 [%0], %1;" : : "l"(global), "l"(value) : "memory");
  }
  else
  {
    asm volatile("red.release.gpu.global.add.u64 [%0], %1;" : : "l"(global), "l"(value) : "memory");
  }
}

__device__ inline unsigned long long LoadAcquire(const unsigned long long* address, bool isShared)
{
  const std::size_t global = __cvta_generic_to_global(address);
  unsigned long long value = 0;
  if (isShared)
  {
    asm volatile("ld.acquire.sys.global.u64 %0, [%1];" : "=l"(value) : "l"(global) : "memory");
  }
  else
  {
    asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(value) : "l"(global) : "memory");
  }
  return value;
}

__device__ inline unsigned long long GetNanoseconds()
{
  unsigned long long time = 0;
  asm volatile("mov.u64 %0, %%globaltimer;" : "=l"(time));
  return time;
}

/// Blocks of a cooperative launch that work together and wait for each other: the whole grid, the
/// grids of several GPUs, or the blocks on a chunk. All threads of a team make the same calls in
/// the same order.
class Team
{
public:
  /// Blocks [team * size, (team + 1) * size) of the grid are a team.
  /// @param devices how many GPUs have launched such a grid for the team, each with its own edges.
  /// @param hasFewEdges whether there is too little work for the first-level caches to matter.
  __device__ Team(TeamState* states, unsigned size, unsigned devices = 1, bool hasFewEdges = false)
    : State(&states[blockIdx.x / size]),
      Size(size),
      Devices(devices),
      HasFewEdges(hasFewEdges)
  {
    TeamMemory& memory = GetTeamMemory();
    if (threadIdx.x < NumberOfIterationSums)
    {
      memory.Sums[threadIdx.x] = 0;
    }
    if (threadIdx.x == 0)
    {
      memory.Expected = 0;
      memory.SizeOfList = 0;
      memory.NumberListed = 0;
      memory.Warns = 0;
      memory.BadChange = 0;
      memory.News = {};
    }
    __syncthreads();
  }

  __device__ unsigned GetIndex() const { return blockIdx.x / this->Size; }

  /// The list of this warp, and that of the block, in the same memory.
  __device__ EdgeId* GetList() const { return GetTeamMemory().Lists[threadIdx.x / WarpSize]; }
  __device__ EdgeId* GetListOfBlock() const { return GetTeamMemory().Lists[0]; }
  __device__ int* GetSizeOfList() const { return &GetTeamMemory().SizeOfList; }

  /// Waits until the grids of all GPUs run. All blocks call it first.
  /// @returns false in all of them if these do not run at the same time, as where launches are made
  /// one after the other for a debugger or a profiler; then they must not wait for each other.
  __device__ bool Meet() const
  {
    constexpr unsigned long long Patience = 2000000000; // nanoseconds
    constexpr unsigned Unknown = 0, Together = 1, Apart = 2;
    if (this->Devices == 1)
    {
      return true;
    }
    bool isTogether = false;
    if (threadIdx.x == 0)
    {
      const unsigned long long start = GetNanoseconds();
      AtomicAdd(&this->State->Present, 1);
      unsigned verdict = Unknown;
      while (verdict == Unknown)
      {
        const bool areAll = AtomicLoad(&this->State->Present) == this->Size * this->Devices;
        const bool isLate = GetNanoseconds() - start > Patience;
        verdict = AtomicLoad(&this->State->Verdict);
        if (verdict == Unknown && (areAll || isLate))
        {
          const unsigned own = areAll ? Together : Apart;
          const unsigned before = AtomicCompareExchange(&this->State->Verdict, Unknown, own);
          verdict = before == Unknown ? own : before;
        }
      }
      isTogether = verdict == Together;
    }
    return __syncthreads_or(isTogether) != 0;
  }

  /// This thread among those of the team on this GPU, and their number.
  __device__ unsigned GetThread() const
  {
    return (blockIdx.x % this->Size) * LoopThreads + threadIdx.x;
  }
  /// This warp among those of the team on this GPU, so that consecutive ones are in different
  /// blocks.
  __device__ unsigned GetSpreadWarp() const
  {
    return blockIdx.x % this->Size + this->Size * (threadIdx.x / WarpSize);
  }
  __device__ unsigned GetNumberOfThreads() const { return this->Size * LoopThreads; }
  __device__ bool IsFirstThread() const { return this->GetThread() == 0; }

  /// Adds the values of the threads of a warp, all of which call it, to a sum.
  __device__ void Add(IterationSum sum, unsigned value) const
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

  /// Warns all threads of the team, which see it after the next wait. Only one of two consecutive
  /// waits may have warnings before it: a block may reach the next wait while others still read the
  /// news of the last.
  __device__ void Warn(bool warning) const
  {
    if (warning)
    {
      GetTeamMemory().Warns = 1;
    }
  }
  /// Whether a thread warned before the last wait.
  __device__ bool IsWarned() const { return GetTeamMemory().IsWarned; }

  /// The change of the number of bad edges since the launch, as counted up to the last wait that
  /// had an iteration.
  __device__ int GetBadChange() const { return GetTeamMemory().News.GetBadChange(); }

  /// Waits for all threads of the team and sees what they wrote before. If `iteration` is not null,
  /// adds to it the sums since the last call that had one.
  __device__ void Wait(IterationSums* iteration = nullptr)
  {
    __syncthreads();
    if (iteration && threadIdx.x < WarpSize)
    {
      this->FlushSums(iteration);
      __syncwarp();
    }
    this->WaitForBlocks();
  }

private:
  /// The release and acquire of the first thread cover the block, because barriers surround them.
  __device__ void WaitForBlocks()
  {
    if (threadIdx.x == 0)
    {
      TeamMemory& memory = GetTeamMemory();
      const TeamNews own = TeamNews::Make(memory.Warns != 0, memory.BadChange);
      TeamNews all{ memory.News.Value + own.Value };
      if (this->CountBlocks() > 1)
      {
        all = this->Arrive(own);
      }
      memory.IsWarned = all.GetWarnings() != memory.News.GetWarnings();
      memory.News = all;
      memory.Warns = 0;
      memory.BadChange = 0;
    }
    __syncthreads();
  }

  /// @returns the sum of all blocks' news.
  __device__ TeamNews Arrive(TeamNews own)
  {
    const unsigned expected = GetTeamMemory().Expected += this->CountBlocks();
    unsigned long long* arrivals = &this->State->Arrivals;
    const bool isShared = this->Devices > 1;
    AddRelease(arrivals, own.Value, isShared);
    TeamNews news{};
    // An acquire flushes the first-level cache, which another block may be using. So this waits
    // until all blocks have arrived.
    while (!this->HasFewEdges && !news.HasArrived(expected))
    {
      news.Value = AtomicLoad(arrivals);
    }
    do
    {
      news.Value = LoadAcquire(arrivals, isShared);
    } while (!news.HasArrived(expected));
    return news;
  }

  __device__ void FlushSums(IterationSums* iteration) const
  {
    const unsigned i = threadIdx.x;
    if (i == 0)
    {
      GetTeamMemory().BadChange = static_cast<int>(
        GetSum(IterationSum::IsBad) - GetSum(IterationSum::WasBad) - GetSum(IterationSum::Flipped));
    }
    __syncwarp();
    if (i < NumberOfIterationSums && GetTeamMemory().Sums[i] != 0)
    {
      atomicAdd_system(
        &iteration->Values[i], static_cast<unsigned long long>(GetTeamMemory().Sums[i]));
      GetTeamMemory().Sums[i] = 0;
    }
  }

  __device__ unsigned CountBlocks() const { return this->Size * this->Devices; }

  __device__ static unsigned GetSum(IterationSum sum)
  {
    return GetTeamMemory().Sums[static_cast<int>(sum)];
  }

  TeamState* State;
  unsigned Size; ///< Blocks on this GPU.
  unsigned Devices; ///< GPUs.
  bool HasFewEdges;
};

}

#endif
