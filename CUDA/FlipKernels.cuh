// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPKERNELS_CUH
#define DELAUNAYFLIP_FLIPKERNELS_CUH

#include "Atomics.h"
#include "CudaPasses.cuh"
#include "Team.cuh"

/// @file
/// The loop on the device: many iterations per launch.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// An iteration. It begins with the choice, because the detection before it has found the bad edges.

/// A detection, passes 1 to 3.
template <bool IsGuarded, typename Rule, typename Worklist>
__device__ void RunDetection(
  const LoopView<Rule>& loop, const Worklist& worklist, Team& team, IterationSums* iteration)
{
  [[maybe_unused]] const bool isUncertain =
    JudgeCandidates<IsGuarded>(loop, worklist, team); // pass 1
  if constexpr (!Rule::IsInSpace)
  {
    if (worklist.IsAny(isUncertain))
    {
      ResolveUncertain(loop, worklist, team); // pass 1, exactly
    }
  }
  if constexpr (IsGuarded)
  {
    __syncwarp(); // a warp guards the units that it judged
    GuardBadEdges(loop, worklist, team); // pass 2
  }
  team.Wait(iteration); // pass 3: adds what all threads have counted
}

/// The choice and the flips, passes 4 to 6.
template <bool IsGuarded, typename Rule, typename Worklist>
__device__ void RunFlips(const LoopView<Rule>& loop, const Worklist& worklist, Team& team)
{
  if constexpr (!IsGuarded)
  {
    ChooseAndFlip(loop, worklist, team); // passes 4 and 6
  }
  else
  {
    ChooseAndClaim(loop, worklist, team); // passes 4 and 5
    team.Wait();
    Confirm(loop, worklist, team); // pass 5
    team.Wait();
    FlipWinners(loop, worklist, team); // pass 6
  }
  team.Wait();
}

/// Iterations within chunks. A team makes all iterations of a chunk, while the chunk is in the
/// cache, and then those of the next one. They are counted in Sums[0] and so on. Sums[iterations]
/// gets the bad and blocked edges from before them.
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
      RunFlips<false>(loop, worklist, team);
      RunDetection<false>(loop, worklist, team, &loop.Sums[i]);
    }
  }
}

//------------------------------------------------------------------------------
// Iterations with few bad edges are an exception. Their detection lists the bad edges, with all
// that a choice reads except the states of the neighbours, which do not change before the next
// detection. So winners may flip while other threads still choose. There are also fewer dependent
// loads, which take most of the time of such an iteration.

/// The bad edges that a block has found, in shared memory.
class BadList
{
public:
  __device__ static BadEdge& Get(int i) { return GetTeamMemory().Listed[i]; }
  __device__ static std::uint32_t& GetClaim(int i) { return GetTeamMemory().Claims[i]; }
  __device__ static int GetSize() { return GetTeamMemory().NumberListed; }

  /// Empties the list, before a barrier.
  __device__ static void Clear()
  {
    if (threadIdx.x == 0)
    {
      GetTeamMemory().NumberListed = 0;
    }
  }

  /// Adds the bad edges among those of the warp's lanes, as long as there is room for them.
  /// @returns the place of this lane's edge in the list; -1 if it is not bad or found no room.
  __device__ static int Add(bool isBad, const BadEdge& edge, int room)
  {
    const unsigned bad = __ballot_sync(WholeWarp, isBad);
    if (bad == 0)
    {
      return -1;
    }
    const unsigned lane = threadIdx.x % WarpSize;
    int place = 0;
    if (lane == 0)
    {
      place = atomicAdd(&GetTeamMemory().NumberListed, __popc(bad));
    }
    place = __shfl_sync(WholeWarp, place, 0) + __popc(bad & ((1u << lane) - 1));
    if (!isBad || place >= room)
    {
      return -1;
    }
    Get(place) = edge;
    return place;
  }
};

/// The most edges that a block lists. With a guard each of them claims its new edge, so there must
/// be room for the claims of all blocks.
template <bool IsGuarded, typename Rule>
__device__ int GetMostListed(const LoopView<Rule>& loop, const Team& team)
{
  if constexpr (!IsGuarded)
  {
    return MostListed;
  }
  else
  {
    const unsigned blocks = team.GetNumberOfThreads() / LoopThreads * loop.Devices;
    return min(MostListed, static_cast<int>(loop.Guard.Claims.Size / blocks));
  }
}

/// Does what RunDetection does, and lists the bad edges. To be listed, bad edges that are not
/// candidates are judged again, but do not count as tested. With a guard each bad edge already
/// claims its new edge here. Warns if an edge is uncertain, the list is too short or a claim is
/// contested.
template <bool IsGuarded, typename Rule>
__device__ void DetectAndList(const LoopView<Rule>& loop, const Team& team)
{
  const WarpWorklist worklist = IsGuarded ? loop.GetSpreadWorklist() : loop.GetWorklist();
  DetectionCounts counts;
  const int room = GetMostListed<IsGuarded>(loop, team);
  unsigned blockedByEdge = 0, contested = 0;
  bool isShort = false;
  BadList::Clear();
  __syncthreads();
  worklist.Run(
    team, loop.Mesh,
    [&](const EdgeByte& byte) { return TakeCandidates<IsGuarded>(loop, byte, true, counts); },
    [&](EdgeId edge, const CornerPair& corners)
    {
      BadEdge found{ edge, corners, {} };
      Quad quad{};
      EdgeState state = EdgeState::Good;
      if (edge != NoEdge)
      {
        found.Outer = GetOuterHalfEdges(loop.Mesh, corners.A, corners.B);
        quad = loop.Mesh.GetQuad(corners);
        state = JudgeAndNote(loop, edge, quad, IsGuarded, counts);
        blockedByEdge += unsigned(state == EdgeState::BlockedByEdge);
      }
      const int place = BadList::Add(state == EdgeState::Bad, found, room);
      isShort = isShort || (state == EdgeState::Bad && place < 0);
      if (IsGuarded && place >= 0)
      {
        bool isContested = false;
        BadList::GetClaim(place) =
          loop.Guard.Claims.Claim(quad.A, quad.B, Priority(edge), isContested);
        contested += unsigned(isContested);
      }
    });
  counts.AddTo<Rule>(team);
  team.Warn(counts.Uncertain || isShort || contested > 0);
  if constexpr (!Rule::IsInSpace)
  {
    if (worklist.IsAny(counts.Uncertain))
    {
      ResolveUncertain(loop, worklist, team);
      if constexpr (IsGuarded)
      {
        GuardBadEdges(loop, worklist, team);
      }
      return;
    }
  }
  if constexpr (IsGuarded)
  {
    team.Add(IterationSum::AllBlockedByEdge, blockedByEdge);
    team.Add(IterationSum::Contested, contested);
  }
}

/// Releases the claims of all listed edges. For lists that are not flipped.
template <typename Rule>
__device__ void ReleaseListed(const LoopView<Rule>& loop, const Team& team)
{
  const int size = min(BadList::GetSize(), GetMostListed<true>(loop, team));
  for (int i = threadIdx.x; i < size; i += LoopThreads)
  {
    loop.Guard.Claims.ReleaseSlot(BadList::GetClaim(i));
  }
}

/// Flips the listed edges that win. With a guard no two listed edges have claimed the same edge.
/// They stay marked as bad until the next DetectAndList, because other choices depend on it.
/// @returns whether a new edge found no room in the guard's table.
template <bool IsGuarded, typename Rule>
__device__ bool FlipListed(const LoopView<Rule>& loop, const Team& team)
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
      flips = Wins(loop, bad.Edge, bad.Outer);
      if constexpr (IsGuarded)
      {
        loop.Guard.Claims.ReleaseSlot(BadList::GetClaim(i));
      }
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
      if constexpr (IsGuarded)
      {
        UpdateGuard(loop.Guard.Edges, bad.Edge, quad, counts);
      }
    }
  }
  AddFlips<IsGuarded>(team, counts);
  return counts.LostInserts > 0;
}

//------------------------------------------------------------------------------
/// The most waits per iteration: three in RunFlips with a guard, one in RunDetection, and one for
/// lists that are not used.
constexpr int MostWaits = 5;

/// The most iterations per launch of IterateKernel: few enough for an observer to be called and to
/// stop the run in time.
constexpr int MostIterations = 128;

/// The most blocks per such launch, so that the parts of their news stay within their bits. The
/// detection before the iterations has fewer waits than one of them.
constexpr int MostIterateBlocks = TeamNews::MostArrivals / ((MostIterations + 1) * MostWaits);
static_assert(MostIterateBlocks < 1 << TeamNews::WarningBits, "all may warn at the same wait");
static_assert(MostIterateBlocks >= 1024, "enough for any GPU; else lower MostIterations");

/// How many entries of Sums a detection has: one with its own counts, and one with all bad and
/// blocked edges.
constexpr int SumsOfDetection = 2;

/// What a launch of IterateKernel starts from, and its limits. It ends when no bad edge is left, or
/// at a limit.
struct IterationPlan
{
  bool Detects; ///< Whether a detection comes first.
  int Iterations; ///< It makes at most so many.
  long long BadAtStart; ///< The number of bad edges at the start, unless it detects.
  long long FreshSlots; ///< So many slots of the guard table may come into use.
};

__device__ inline long long LoadSum(const IterationSums& iteration, IterationSum sum)
{
  return static_cast<long long>(AtomicLoad(&iteration.Values[static_cast<int>(sum)]));
}

/// Iterations on the whole mesh, as one thread runs them.
template <bool IsGuarded, typename Rule>
class Iterations
{
public:
  __device__ Iterations(const LoopView<Rule>& loop, const IterationPlan& plan)
    : Loop(loop),
      Plan(plan),
      Members(loop.Teams, gridDim.x, loop.Devices, loop.Splits > 0),
      BadAtStart(plan.BadAtStart),
      Bad(plan.BadAtStart),
      // A quarter of the room, because bad edges are not spread evenly.
      MostToList(Members.GetNumberOfThreads() / LoopThreads * (MostListed / 4))
  {
  }

  /// @returns how many entries of Sums it has used; 0 if several GPUs share the work and do not run
  /// at the same time.
  __device__ int Run()
  {
    int done = 0;
    int most = this->Plan.Iterations;
    bool isRunning = this->Members.Meet();
    if (isRunning && this->Plan.Detects)
    {
      isRunning = this->DetectFirst() && most > 0;
      done = SumsOfDetection;
      most += SumsOfDetection;
    }
    while (isRunning)
    {
      IterationSums* iteration = &this->Loop.Sums[done++];
      this->Flip();
      this->Detect(iteration);
      isRunning = this->Bad > 0 && done < most && this->HasRoom && !this->IsUncertain(iteration);
    }
    if (IsGuarded && this->IsListed)
    {
      ReleaseListed(this->Loop, this->Members);
    }
    return done;
  }

  __device__ bool IsFirstThread() const { return this->Members.IsFirstThread(); }

private:
  /// Makes a detection before all iterations. @returns whether these have something to do.
  __device__ bool DetectFirst()
  {
    IterationSums* sums = this->Loop.Sums;
    RunDetection<IsGuarded>(this->Loop, this->Loop.GetWorklist(), this->Members, &sums[0]);
    this->IsWarned = this->Members.IsWarned();
    CountAll(this->Loop, this->Loop.GetWorklist(), this->Members);
    this->Members.Wait(&sums[1]);
    this->Bad = LoadSum(sums[1], IterationSum::AllBad);
    this->BadAtStart = this->Bad - this->Members.GetBadChange();
    return this->Bad > 0 && !this->IsUncertain(&sums[0]);
  }

  __device__ void Flip()
  {
    if (!this->IsListed)
    {
      RunFlips<IsGuarded>(this->Loop, this->Loop.GetWorklist(), this->Members);
      return;
    }
    this->HasLost = FlipListed<IsGuarded>(this->Loop, this->Members);
    this->Members.Wait();
  }

  /// Makes a detection. Lists the bad edges if they are few, or if the last detection listed them.
  __device__ void Detect(IterationSums* iteration)
  {
    const bool list = this->IsListed || this->Bad <= this->MostToList;
    if (list)
    {
      this->Members.Warn(this->HasLost);
      DetectAndList<IsGuarded>(this->Loop, this->Members);
      this->Members.Wait(iteration);
      this->IsWarned = this->Members.IsWarned();
      this->IsListed = !this->IsWarned;
      if (IsGuarded && !this->IsListed)
      {
        ReleaseListed(this->Loop, this->Members);
        this->Members.Wait();
      }
    }
    else
    {
      RunDetection<IsGuarded>(this->Loop, this->Loop.GetWorklist(), this->Members, iteration);
      this->IsWarned = this->Members.IsWarned();
    }
    this->Bad = this->BadAtStart + this->Members.GetBadChange();
    bool isDropped = list && !this->IsListed;
    if (IsGuarded && !this->IsListed)
    {
      this->FreshSlots += LoadSum(*iteration, IterationSum::FreshSlots) -
        LoadSum(*iteration, IterationSum::FreedSlots);
      this->HasRoom = this->FreshSlots <= this->Plan.FreshSlots &&
        LoadSum(*iteration, IterationSum::LostInserts) == 0;
      isDropped = isDropped && LoadSum(*iteration, IterationSum::Contested) == 0;
    }
    // After a list that could not be used, lists are tried again once half of the bad edges are
    // left; after contested claims they are tried again at once.
    if (isDropped)
    {
      this->MostToList = this->Bad / 2;
    }
  }

  /// Whether there is an edge that a device cannot decide. The thread that found it has warned.
  __device__ bool IsUncertain(const IterationSums* iteration) const
  {
    return this->IsWarned && LoadSum(*iteration, IterationSum::Uncertain) > 0;
  }

  const LoopView<Rule>& Loop;
  const IterationPlan& Plan;
  Team Members;
  bool IsListed = false; ///< Whether the lists of all blocks hold all bad edges.
  bool IsWarned = false; ///< Whether a thread has warned in the last detection.
  long long BadAtStart; ///< The number of bad edges when the changes are 0.
  long long Bad; ///< The number of bad edges that the last detection has found.
  long long MostToList; ///< Detections make lists of at most so many bad edges.
  /// How many slots of the guard's table have come into use, without iterations that end with a
  /// list: their flips are few.
  long long FreshSlots = 0;
  bool HasRoom = true; ///< False if the guard's table must be rebuilt.
  /// Whether this thread has just made an edge that found no room in the guard's table.
  bool HasLost = false;
};

/// Iterations on the whole mesh after a detection, which the kernel makes if there was none. Each
/// is counted in an entry of Sums. If the guard's table must be rebuilt, the last detection may
/// have missed edges that found no room in it.
template <bool IsGuarded, typename Rule>
__global__ void __launch_bounds__(LoopThreads, LoopBlocks) IterateKernel(
  const __grid_constant__ LoopView<Rule> loop, const __grid_constant__ IterationPlan plan)
{
  Iterations<IsGuarded, Rule> iterations(loop, plan);
  const int done = iterations.Run();
  if (iterations.IsFirstThread())
  {
    *loop.EntriesUsed = done;
  }
}

}

#endif
