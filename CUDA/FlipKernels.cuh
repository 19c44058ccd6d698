// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "Atomics.h"
#include "FlipPhases.cuh"
#include "Team.cuh"

/// @file
/// The loop on the device: many iterations per launch.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// Iterations with few bad edges. The detection lists the bad edges with everything that a choice
// reads except the states of the neighbours, which do not change before the next detection. So
// winners may flip while other threads still choose, and there are fewer dependent loads, which
// are most of the time of such an iteration.

/// The bad edges that a block has found, in shared memory.
class BadList
{
public:
  __device__ static BadEdge& Get(int i) { return GetTeamMemory().Listed[i]; }
  __device__ static ListedClaim& GetClaim(int i) { return GetTeamMemory().Claims[i]; }
  __device__ static int GetSize() { return GetTeamMemory().NumberListed; }
  __device__ static bool HasOverflown() { return GetSize() > MostListed; }

  /// Empties the list, before a barrier.
  __device__ static void Clear()
  {
    if (threadIdx.x == 0)
    {
      GetTeamMemory().NumberListed = 0;
    }
  }

  /// Adds the bad edges among those of the warp's lanes, as long as there is room.
  /// @returns where, or -1.
  __device__ static int Add(bool isBad, const BadEdge& edge)
  {
    const unsigned bad = __ballot_sync(WholeWarp, isBad);
    if (bad == 0)
    {
      return -1;
    }
    const unsigned lane = threadIdx.x % WarpSize;
    int place = lane == 0 ? atomicAdd(&GetTeamMemory().NumberListed, __popc(bad)) : 0;
    place = __shfl_sync(WholeWarp, place, 0) + __popc(bad & ((1u << lane) - 1));
    if (!isBad || place >= MostListed)
    {
      return -1;
    }
    Get(place) = edge;
    return place;
  }
};

/// The same as RunDetection, but also lists the bad edges, and warns if the list is too short. Bad
/// edges that are not candidates are judged again to be listed; they do not count as tested.
template <bool HasGuard, typename Rule>
__device__ void DetectAndList(
  const LoopView<Rule>& loop, const BlockWorklist& worklist, const Team& team)
{
  DetectionCounts counts;
  unsigned blockedByEdge = 0;
  BadList::Clear();
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte) { return TakeCandidates(loop, byte, true, HasGuard, counts); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      BadEdge found{ edge, corners, {} };
      Quad quad{};
      EdgeState state = EdgeState::Good;
      if (edge != NoEdge)
      {
        found.Outer = GetOuterHalfEdges(loop.Mesh, corners.A, corners.B);
        quad = loop.Mesh.GetQuad(corners);
        state = JudgeAndNote(loop, edge, quad, HasGuard, counts);
        blockedByEdge += state == EdgeState::BlockedByEdge ? 1 : 0;
      }
      const int place = BadList::Add(state == EdgeState::Bad, found);
      if (HasGuard && place >= 0)
      {
        BadList::GetClaim(place) = { quad.A, quad.B, NoClaim };
      }
    });
  counts.AddTo<Rule>(team);
  team.Warn(counts.Uncertain || BadList::HasOverflown());
  if constexpr (Rule::MayBeUncertain)
  {
    if (worklist.IsAny(counts.Uncertain))
    {
      ResolveUncertain(loop, worklist, team);
      if (HasGuard)
      {
        GuardBadEdges(loop, worklist, team);
      }
      return;
    }
  }
  if (HasGuard)
  {
    team.Add(IterationSum::AllBad, counts.IsBad);
    team.Add(IterationSum::AllBlockedByEdge, blockedByEdge);
  }
}

/// Chooses among the bad edges, all of which are in the lists of the blocks; winners claim their
/// new edges. This and the other functions of lists with a guard are not inlined, so that
/// iterations without one keep their registers.
template <typename Rule>
__device__ __noinline__ void ClaimListed(const LoopView<Rule>& loop)
{
  for (int i = threadIdx.x; i < BadList::GetSize(); i += LoopThreads)
  {
    const BadEdge& bad = BadList::Get(i);
    if (Wins(loop, bad.Edge, bad.Outer))
    {
      ListedClaim& claim = BadList::GetClaim(i);
      claim.Slot = loop.Guard.Claims.Claim(claim.A, claim.B, Priority(bad.Edge));
    }
  }
}

/// Whether a listed edge flips. With a guard it has made its claim, and releases it here if it
/// holds it.
template <bool HasGuard, typename Rule>
__device__ bool MayFlipListed(const LoopView<Rule>& loop, const BadEdge& bad, int i)
{
  if (!HasGuard)
  {
    return Wins(loop, bad.Edge, bad.Outer);
  }
  const ListedClaim& claim = BadList::GetClaim(i);
  const bool holds = claim.Slot != NoClaim &&
    loop.Guard.Claims.HoldsSlot(claim.Slot, claim.A, claim.B, Priority(bad.Edge));
  if (holds)
  {
    loop.Guard.Claims.ReleaseSlot(claim.Slot);
  }
  return holds;
}

/// Flips those of the listed edges that win, without a guard, or that hold their claims. They stay
/// marked as bad until the next DetectAndList, because other choices depend on it.
template <bool HasGuard, typename Rule>
__device__ void FlipListed(const LoopView<Rule>& loop, const Team& team)
{
  StepCounts counts;
  const int size = BadList::GetSize();
  const int firstOfWarp = threadIdx.x / WarpSize * WarpSize;
  for (int first = firstOfWarp; first < size; first += LoopThreads)
  {
    const int i = first + threadIdx.x % WarpSize;
    FlippedRecords flipped;
    Quad quad{};
    BadEdge bad{};
    bool flips = false;
    if (i < size)
    {
      bad = BadList::Get(i);
      const RecordPair records(loop.Mesh, bad.Corners);
      flips = MayFlipListed<HasGuard>(loop, bad, i);
      if (flips)
      {
        quad = records.GetQuad();
        FlipEdge(loop.Mesh, bad.Edge, quad, records.Upper, records.Lower, flipped.Keep());
      }
    }
    flipped.Store(loop.Mesh.Triangles);
    if (flips)
    {
      ++counts.Flipped;
      EdgeBits::Set(loop.Bits.Winners, bad.Edge);
      MarkOuter(loop, bad.Outer);
      if (HasGuard)
      {
        UpdateGuard(loop.Guard.Edges, quad, counts);
      }
    }
  }
  AddFlips(loop, team, counts);
}

template <typename Rule>
__device__ __noinline__ void FlipListedWithGuard(const LoopView<Rule>& loop, Team team)
{
  FlipListed<true>(loop, team);
}

template <typename Rule>
__device__ __noinline__ void DetectAndListWithGuard(
  const LoopView<Rule>& loop, BlockWorklist worklist, Team team)
{
  DetectAndList<true>(loop, worklist, team);
}

//------------------------------------------------------------------------------

/// The most waits per iteration: three in RunFlips, with a guard, and one in RunDetection.
constexpr int MostWaits = 4;

/// The most iterations per launch of IterateKernel: few enough for an observer to be called and to
/// stop the run in time.
constexpr int MostIterations = 128;

/// The most blocks per such launch, so that the parts of their news stay within their bits.
constexpr int MostIterateBlocks = TeamNews::MostArrivals / (MostIterations * MostWaits);
static_assert(MostIterateBlocks < 1 << TeamNews::WarningBits, "all may warn at the same wait");
static_assert(MostIterateBlocks >= 1024, "enough for any GPU; else lower MostIterations");

/// Passes 4 to 6.
template <typename Rule, typename Worklist>
__device__ void RunFlips(const LoopView<Rule>& loop, const Worklist& worklist, Team& team)
{
  if (!HasGuard<Worklist>(loop))
  {
    ChooseAndFlip(loop, worklist, team);
    team.Wait();
    return;
  }
  ChooseAndClaim(loop, worklist, team);
  team.Wait();
  Confirm(loop, worklist, team);
  team.Wait();
  FlipWinners(loop, worklist, team);
  team.Wait();
}

/// Passes 1 to 3.
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

/// A detection on the whole mesh, counted in Sums[0], and a count of all bad and blocked edges, in
/// Sums[1].
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  DetectAllKernel(const __grid_constant__ LoopView<Rule> loop)
{
  Team team(loop.Teams, gridDim.x, loop.Parts);
  if (!team.Meet())
  {
    return;
  }
  const WarpWorklist worklist = loop.GetWorklist();
  RunDetection(loop, worklist, team, &loop.Sums[0]);
  CountAll(loop, worklist, team);
  team.Wait(&loop.Sums[1]);
  if (team.IsFirstThread())
  {
    *loop.IterationsDone = 1;
  }
}

/// When a launch of IterateKernel ends: when no bad edge is left, or at a limit.
struct IterationLimits
{
  int Iterations; ///< The most iterations.
  long long Bad; ///< The number of bad edges at the start.
  unsigned long long FreshSlots; ///< The most slots of the guard table that may come into use.
};

__device__ inline long long LoadSum(const IterationSums& iteration, IterationSum sum)
{
  return static_cast<long long>(AtomicLoad(&iteration.Values[static_cast<int>(sum)]));
}

/// Iterations on the whole mesh, as one thread runs them.
template <typename Rule>
class Iterations
{
public:
  __device__ Iterations(const LoopView<Rule>& loop, const IterationLimits& limits)
    : Loop(loop),
      Limits(limits),
      Members(loop.Teams, gridDim.x, loop.Parts, loop.Splits > 0),
      Bad(limits.Bad),
      // A quarter of the room, because bad edges are not spread evenly.
      MostToList(Members.GetNumberOfThreads() / LoopThreads * (MostListed / 4))
  {
  }

  /// @returns how many; 0 if several GPUs were to make them and do not run at the same time.
  __device__ int Run()
  {
    int done = 0;
    for (bool isRunning = this->Members.Meet(); isRunning;)
    {
      IterationSums* iteration = &this->Loop.Sums[done++];
      this->Flip();
      this->Detect(iteration);
      isRunning = this->Bad > 0 && done < this->Limits.Iterations && this->HasRoom &&
        !this->IsUncertain(iteration);
    }
    return done;
  }

  __device__ bool IsFirstThread() const { return this->Members.IsFirstThread(); }

private:
  __device__ void Flip()
  {
    if (!this->IsListed)
    {
      RunFlips(this->Loop, this->Loop.GetWorklist(), this->Members);
      return;
    }
    if (this->Loop.Guard.Active)
    {
      ClaimListed(this->Loop);
      this->Members.Wait();
      FlipListedWithGuard(this->Loop, this->Members);
    }
    else
    {
      FlipListed<false>(this->Loop, this->Members);
    }
    this->Members.Wait();
  }

  /// Makes a detection. Lists the bad edges if they are few, or if the last detection listed them.
  __device__ void Detect(IterationSums* iteration)
  {
    const bool list = this->IsListed || this->Bad <= this->MostToList;
    if (list)
    {
      const BlockWorklist worklist = this->Loop.GetSpreadWorklist();
      this->Loop.Guard.Active ? DetectAndListWithGuard(this->Loop, worklist, this->Members)
                              : DetectAndList<false>(this->Loop, worklist, this->Members);
      this->Members.Wait(iteration);
      this->IsListed = !this->Members.IsWarned();
    }
    else
    {
      RunDetection(this->Loop, this->Loop.GetWorklist(), this->Members, iteration);
    }
    this->Bad = this->Limits.Bad + this->Members.GetBadChange();
    if (this->Loop.Guard.Active)
    {
      this->Bad = LoadSum(*iteration, IterationSum::AllBad);
      this->FreshSlots += LoadSum(*iteration, IterationSum::FreshSlots);
      this->HasRoom = this->FreshSlots <= this->Limits.FreshSlots &&
        LoadSum(*iteration, IterationSum::LostInserts) == 0;
    }
    // After a list was too short, lists are tried again when there are half as many bad edges.
    this->MostToList = list && !this->IsListed ? this->Bad / 2 : this->MostToList;
  }

  /// Whether there is an edge that a device cannot decide. The thread that found it has warned.
  __device__ bool IsUncertain(const IterationSums* iteration) const
  {
    return this->Members.IsWarned() && LoadSum(*iteration, IterationSum::Uncertain) > 0;
  }

  const LoopView<Rule>& Loop;
  const IterationLimits& Limits;
  Team Members;
  bool IsListed = false; ///< Whether the lists of all blocks hold all bad edges.
  long long Bad; ///< Edges.
  long long MostToList; ///< Up to this many bad edges, detections make lists.
  unsigned long long FreshSlots = 0;
  bool HasRoom = true; ///< False if the guard's table must be rebuilt.
};

/// Iterations on the whole mesh after a detection, each counted in an entry of Sums. If the guard's
/// table must be rebuilt, the last detection may have missed edges that found no room in it.
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

/// Iterations within chunks: a team takes a chunk through all of them, while the chunk is in the
/// cache, then the next chunk. They are counted in Sums; Sums[iterations] gets the bad and blocked
/// edges from before.
template <typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks)
  RunChunksKernel(const __grid_constant__ LoopView<Rule> loop, int blocksOfTeam, int iterations)
{
  Team team(loop.Teams, blocksOfTeam);
  const int teams = gridDim.x / blocksOfTeam;
  for (int c = loop.FirstChunk + team.GetIndex(); c < loop.LastChunk; c += teams)
  {
    const BlockWorklist worklist = loop.GetWorklist(loop.Chunks[c]);
    CountAll(loop, worklist, team);
    team.Wait(&loop.Sums[iterations]);
    for (int i = 0; i < iterations; ++i)
    {
      RunFlips(loop, worklist, team);
      RunDetection(loop, worklist, team, &loop.Sums[i]);
    }
  }
}

}

#endif
