// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAFLIPLOOP_CUH
#define DELAUNAYFLIP_CUDAFLIPLOOP_CUH

#include "CudaBackend.cuh"
#include "DeviceWorklist.cuh"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipError.h"
#include "FlipKernels.cuh"
#include "FlipLoop.h"
#include "SmallestAngle.h"
#include "StepCounts.h"
#include "Team.cuh"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace delaunayflip
{

inline std::int64_t GetSum(const IterationSums& iteration, IterationSum sum)
{
  return static_cast<std::int64_t>(iteration.Values[static_cast<int>(sum)]);
}

/// The counts after an iteration that began with `edges`.
inline StepCounts Follow(const StepCounts& edges, const IterationSums& iteration)
{
  StepCounts next;
  next.Tested = GetSum(iteration, IterationSum::Tested);
  next.Bad = edges.Bad - GetSum(iteration, IterationSum::Flipped) -
    GetSum(iteration, IterationSum::WasBad) + GetSum(iteration, IterationSum::IsBad);
  next.BlockedByShape = edges.BlockedByShape - GetSum(iteration, IterationSum::WasBlockedByShape) +
    GetSum(iteration, IterationSum::IsBlockedByShape);
  next.BlockedByEdge = GetSum(iteration, IterationSum::AllBlockedByEdge);
  return next;
}

/// The iteration that began with these counts.
inline IterationCounts ToIteration(const StepCounts& edges, const IterationSums& iteration)
{
  return { edges.Tested, edges.Bad, edges.GetBlocked(), GetSum(iteration, IterationSum::Flipped),
    -INFINITY };
}

/// Owns the EdgeBits, and has the functions for all edges at once.
class DeviceEdgeBits
{
public:
  /// @param mayBlock Rule::MayBlock.
  DeviceEdgeBits(EdgeMesh& mesh, bool mayBlock, const CudaBackend& backend)
    : Backend(backend)
  {
    const std::int64_t units =
      (mesh.NumberOfEdges + EdgeUnits::UnitSize - 1) >> EdgeUnits::UnitBits;
    this->NumberOfWords = units * EdgeUnits::UnitSize / 32;
    std::uint32_t** const kinds[EdgeBits::Kinds] = { &this->Bits.FixedOrDeferred,
      &this->Bits.Candidates, &this->Bits.Bad, &this->Bits.Winners, &this->Bits.BlockedByEdge,
      &this->Bits.BlockedByShape };
    const int own = EdgeBits::Kinds - int(!mayBlock);
    for (int kind = 0; kind < own; ++kind)
    {
      this->Words[kind] = backend.MakeArray<std::uint32_t>(this->NumberOfWords);
      *kinds[kind] = this->Words[kind].Data();
    }
    if (!mayBlock)
    {
      this->Bits.BlockedByShape = this->Bits.BlockedByEdge;
    }
    this->TakeStates(mesh, true);
  }

  const EdgeBits& View() const { return this->Bits; }
  std::int64_t CountUnits() const { return this->NumberOfWords / (EdgeUnits::UnitSize / 32); }

  // Public because device lambdas require it.

  /// Takes over the states that are Fixed or Candidate. Other edges keep their bits, or, if
  /// isFirst, have none. Bits after the last edge are fixed.
  /// @param clears whether candidates become Good, so that nobody takes them twice.
  void TakeStates(EdgeMesh& mesh, bool isFirst, bool clears = false)
  {
    const EdgeBits bits = this->Bits;
    EdgeState* states = mesh.States.Data();
    const CornerId* corners = mesh.CornerOfHalfEdge.Data();
    const std::int64_t edges = mesh.NumberOfEdges;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        StateWord own{ ~0u, 0 };
        if (32 * word < edges)
        {
          own =
            states ? TakeWord(states + 32 * word, clears) : FindInner(corners, 32 * word, edges);
        }
        const std::int64_t left = edges - 32 * word;
        const std::uint32_t after = left < 32 ? ~0u << (left > 0 ? left : 0) : 0;
        std::uint32_t fixed = own.Fixed | after;
        const std::uint32_t candidates = own.Candidates & ~after;
        if (!isFirst)
        {
          fixed |= bits.FixedOrDeferred[word];
        }
        bits.FixedOrDeferred[word] = fixed;
        bits.Candidates[word] = candidates;
        const auto keep = [&](std::uint32_t* kind)
        { kind[word] = isFirst ? 0 : kind[word] & ~(fixed | candidates); };
        keep(bits.Bad);
        keep(bits.Winners);
        keep(bits.BlockedByShape);
        keep(bits.BlockedByEdge);
      });
  }

  /// The bits of 32 edges.
  struct StateWord
  {
    std::uint32_t Fixed, Candidates;
  };

  /// Takes the states of 32 edges. All of them have room, because States is padded.
  __device__ static StateWord TakeWord(EdgeState* states, bool clears)
  {
    constexpr int Words = 32 / sizeof(std::uint32_t);
    static_assert(sizeof(EdgeState) == 1 && EdgeMesh::StatePadding % 32 == 0);
    std::uint32_t words[Words];
    auto* halves = reinterpret_cast<uint4*>(states);
    *reinterpret_cast<uint4*>(words) = halves[0];
    *reinterpret_cast<uint4*>(words + Words / 2) = halves[1];
    constexpr auto ToGood = static_cast<std::uint32_t>(EdgeState::Candidate) ^
      static_cast<std::uint32_t>(EdgeState::Good);
    StateWord taken{ 0, 0 };
    for (int i = 0; i < 32; ++i)
    {
      const int shift = 8 * (i % 4);
      const auto state = static_cast<EdgeState>(words[i / 4] >> shift & 0xFFu);
      const auto isCandidate = static_cast<std::uint32_t>(state == EdgeState::Candidate);
      taken.Fixed |= static_cast<std::uint32_t>(state == EdgeState::Fixed) << i;
      taken.Candidates |= isCandidate << i;
      words[i / 4] ^= isCandidate * (ToGood << shift);
    }
    if (clears && taken.Candidates != 0)
    {
      halves[0] = *reinterpret_cast<const uint4*>(words);
      halves[1] = *reinterpret_cast<const uint4*>(words + Words / 2);
    }
    return taken;
  }

  /// The states of 32 edges of a mesh that has none: edges with two triangles are candidates.
  __device__ static StateWord FindInner(
    const CornerId* corners, std::int64_t first, std::int64_t edges)
  {
    StateWord found{ 0, 0 };
    for (int i = 0; i < 32 && first + i < edges; ++i)
    {
      const bool isInner = corners[2 * (first + i) + 1] != NoCorner;
      found.Fixed |= static_cast<std::uint32_t>(!isInner) << i;
      found.Candidates |= static_cast<std::uint32_t>(isInner) << i;
    }
    return found;
  }

  /// Whether there is room for the bits of all edges.
  bool HasRoom(const EdgeMesh& mesh) const
  {
    return mesh.NumberOfEdges <= 32 * this->NumberOfWords;
  }

  /// Writes what is known after a detection.
  void PutStates(EdgeMesh& mesh) const
  {
    const EdgeBits bits = this->Bits;
    EdgeState* states = mesh.States.Data();
    this->Backend.ForEach(mesh.NumberOfEdges,
      [=] __device__(std::int64_t e)
      {
        const auto edge = static_cast<EdgeId>(e);
        EdgeState state = EdgeState::Good;
        if (EdgeBits::Has(bits.FixedOrDeferred, edge))
        {
          state = EdgeState::Fixed;
        }
        else if (EdgeBits::Has(bits.BlockedByEdge, edge)) // maybe the same array as the next one
        {
          state = EdgeState::BlockedByEdge;
        }
        else if (EdgeBits::Has(bits.BlockedByShape, edge))
        {
          state = EdgeState::BlockedByShape;
        }
        else if (EdgeBits::Has(bits.Bad, edge))
        {
          state = EdgeState::Bad;
        }
        states[edge] = state;
      });
  }

  /// @param chunkBits chunks of 2^chunkBits triangles.
  void DeferEdgesBetweenChunks(EdgeMesh& edgeMesh, int chunkBits)
  {
    const EdgeBits bits = this->Bits;
    const EdgeMeshView mesh = edgeMesh.View();
    const std::int64_t edges = edgeMesh.NumberOfEdges;
    // Threads of a warp work on one word.
    this->Backend.ForEach(32 * this->NumberOfWords,
      [=] __device__(std::int64_t e)
      {
        bool between = false;
        if (e < edges && !EdgeBits::Has(bits.FixedOrDeferred, static_cast<EdgeId>(e)))
        {
          const CornerPair corners = mesh.GetCorners(static_cast<EdgeId>(e));
          between = (TriangleOf(corners.A) ^ TriangleOf(corners.B)) >> chunkBits != 0;
        }
        const std::uint32_t deferred = __ballot_sync(WholeWarp, between);
        if (e % 32 == 0)
        {
          bits.FixedOrDeferred[e / 32] |= deferred;
          bits.Bad[e / 32] &= ~deferred;
          bits.BlockedByShape[e / 32] &= ~deferred;
          bits.BlockedByEdge[e / 32] = deferred;
        }
      });
  }

  void RecallEdges()
  {
    const EdgeBits bits = this->Bits;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        bits.Candidates[word] = bits.BlockedByEdge[word];
        bits.FixedOrDeferred[word] &= ~bits.BlockedByEdge[word];
        bits.BlockedByEdge[word] = 0;
      });
  }

private:
  const CudaBackend& Backend;
  std::int64_t NumberOfWords = 0; ///< Words for each kind of bits.
  Array<std::uint32_t> Words[EdgeBits::Kinds];
  EdgeBits Bits{};
};

/// The loop on a GPU, by one of the rules of FlipRules.h.
template <typename Rule>
class CudaFlipLoop : public FlipLoop
{
public:
  CudaFlipLoop(EdgeMesh& mesh, const Rule& rule, CoordinateRange range, EdgeGuard guard,
    const CudaBackend& backend)
    : FlipLoop(mesh.NumberOfTriangles, guard.IsActive()),
      Mesh(mesh),
      Decision(rule),
      Range(range),
      Guard(std::move(guard)),
      Backend(backend),
      Bits(mesh, Rule::MayBlock, backend)
  {
    this->PlanGrid();
    this->PlanTeams();
  }

  std::int64_t CountBlockedByDeviation() const override
  {
    return CountDeviating(this->Mesh, this->Decision, this->Backend);
  }

  AngleSums MeasureAngles() const override
  {
    const AngleSurvey<Rule> survey{ this->Mesh.Triangles.Data(), this->Decision, this->Range };
    return this->Backend.template Sum<AngleSums>(this->Mesh.NumberOfTriangles, survey);
  }

  void PutStates() override { this->Bits.PutStates(this->Mesh); }

  // Public because device lambdas require it.

  /// A chunk has the edges that have their smallest corner among its points. Edges are numbered in
  /// the order of chunks. This holds until an edge flips, and only the first iterations are made
  /// within chunks.
  void CutIntoChunks()
  {
    if (this->Chunks.Size() > 0)
    {
      return;
    }
    this->Chunks = this->Backend.template MakeArray<DeviceChunk>(this->NumberOfChunks);
    DeviceChunk* chunks = this->Chunks.Data();
    const CornerId* words = this->Mesh.CornerOfHalfEdge.Data();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    const int bits = this->ChunkBits;
    this->Backend.ForEach(this->NumberOfChunks,
      [=] __device__(std::int64_t c)
      {
        chunks[c] = { static_cast<EdgeId>(FindFirstEdge(words, edges, c << bits)),
          static_cast<EdgeId>(FindFirstEdge(words, edges, (c + 1) << bits)) };
      });
  }

protected:
  StepCounts DetectAll() override
  {
    return ToFound(this->LaunchOnMesh(this->GetIterateKernel(), this->MakePlan(true, 0)));
  }

  /// One launch for both, so that the host waits once.
  std::vector<IterationCounts> DetectAndIterate(std::int64_t iterations) override
  {
    const Results& results =
      this->LaunchOnMesh(this->GetIterateKernel(), this->MakePlan(true, iterations));
    this->Found = ToFound(results);
    return this->TakeIterations(results, SumsOfDetection);
  }

  void TakeStates() override { this->Bits.TakeStates(this->Mesh, false); }

  bool TakeMoved(bool hasOtherEdges) override
  {
    const bool canTake =
      !hasOtherEdges || (!this->Guard.IsActive() && this->Bits.HasRoom(this->Mesh));
    if (canTake)
    {
      this->Bits.TakeStates(this->Mesh, hasOtherEdges, true);
    }
    return canTake;
  }

  /// A launch of iterations on the whole mesh.
  std::vector<IterationCounts> IterateMesh(const AdvancePlan& plan) override
  {
    const bool measure = plan.MeasureFirst || plan.MeasureAll;
    const std::int64_t most = measure ? 1 : plan.Iterations;
    std::vector<IterationCounts> iterations = this->TakeIterations(
      this->LaunchOnMesh(this->GetIterateKernel(), this->MakePlan(false, most)), 0);
    if (measure)
    {
      iterations.back().SquaredCotangent = this->MeasureAngles().Largest;
    }
    return iterations;
  }

  std::vector<IterationCounts> IterateChunks(const AdvancePlan& plan) override
  {
    this->CutIntoChunks();
    this->Bits.DeferEdgesBetweenChunks(this->Mesh, this->ChunkBits);
    std::vector<IterationCounts> iterations;
    while (static_cast<std::int64_t>(iterations.size()) < plan.Iterations)
    {
      const bool measure = plan.MeasureAll || (plan.MeasureFirst && iterations.empty());
      const std::int64_t left = plan.Iterations - static_cast<std::int64_t>(iterations.size());
      this->LaunchChunks(measure ? 1 : static_cast<int>(left), iterations);
      if (measure)
      {
        iterations.back().SquaredCotangent = this->MeasureAngles().Largest;
      }
    }
    this->Bits.RecallEdges();
    return iterations;
  }

private:
  /// The share of the second-level cache for each chunk that is being worked on: one and a half
  /// times its size.
  static constexpr std::size_t ChunkBytes = std::size_t(9) << 19;

  /// The results of a launch.
  struct Results
  {
    int EntriesUsed;
    IterationSums Sums[MostIterations + SumsOfDetection];
  };

  /// With fewer edges one GPU makes iterations on the whole mesh: waits of several take longer.
  static constexpr std::int64_t SmallestShared = std::int64_t(1) << 20;

  auto* GetIterateKernel() const
  {
    if (this->Guard.IsActive())
    {
      return IterateKernel<true, Rule>;
    }
    return IterateKernel<Rule::IsInSpace, Rule>;
  }

  /// The number of blocks that can run at the same time, as their barriers need, on every GPU. Also
  /// loads the kernel there: that must not happen while blocks wait for those of another GPU. The
  /// number is kept, because refinement makes a loop in every round.
  template <typename Kernel>
  int CountResidentBlocks(Kernel kernel) const
  {
    std::map<const void*, int>& known = this->Backend.GetContext().ResidentBlocks;
    const auto found = known.find(reinterpret_cast<const void*>(kernel));
    if (found != known.end())
    {
      return found->second;
    }
    int fewest = std::numeric_limits<int>::max();
    for (const int device : this->Backend.GetContext().Devices)
    {
      const CurrentDevice current(device);
      int perMultiprocessor = 0;
      int multiprocessors = 0;
      CallCuda("plan a launch",
        [&]
        {
          return cudaOccupancyMaxActiveBlocksPerMultiprocessor(
            &perMultiprocessor, kernel, LoopThreads, 0);
        });
      CallCuda("plan a launch", cudaDeviceGetAttribute, &multiprocessors,
        cudaDevAttrMultiProcessorCount, device);
      fewest = std::min(fewest, perMultiprocessor * multiprocessors);
    }
    known.emplace(reinterpret_cast<const void*>(kernel), fewest);
    return fewest;
  }

  /// Takes only as many blocks as have work, because waits of fewer blocks are shorter.
  void PlanGrid()
  {
    if (this->Mesh.NumberOfEdges >= SmallestShared)
    {
      this->Devices = this->Backend.CountDevices();
    }
    const std::int64_t blocks = std::min(
      MostIterateBlocks / this->Devices, this->CountResidentBlocks(this->GetIterateKernel()));
    std::int64_t parts = this->Bits.CountUnits();
    for (; this->Splits < EdgeUnits::MostSplits && 2 * parts <= blocks * LoopWarps; parts *= 2)
    {
      ++this->Splits;
    }
    // One block is faster in two steps than two blocks that wait for each other.
    std::int64_t wanted = 1;
    if (parts > 2 * LoopWarps)
    {
      wanted = (parts + LoopWarps - 1) / LoopWarps;
    }
    this->GridBlocks = static_cast<int>(std::min(blocks, wanted));
  }

  void PlanTeams()
  {
    int blocks = 1;
    if constexpr (!Rule::IsInSpace) // else there are no chunks
    {
      blocks = this->CountResidentBlocks(RunChunksKernel<Rule>);
    }
    const auto teams = static_cast<int>(this->Backend.GetContext().CacheBytes / ChunkBytes);
    const int devices = this->Backend.CountDevices();
    const auto chunks = static_cast<int>((this->NumberOfChunks + devices - 1) / devices);
    this->Teams = std::max(1, std::min({ teams, chunks, blocks }));
    this->BlocksOfTeam = blocks / this->Teams;
    this->TeamStates =
      this->Backend.template MakeArray<TeamState>(devices * this->CountTeamStates());
    this->DeviceResults = reinterpret_cast<Results*>(this->TeamStates.Data() + this->Teams);
  }

  /// The number of team states per GPU. The results are in place of the first ones that have no
  /// team. With several GPUs there are so many that those of each are in its memory.
  std::int64_t CountTeamStates() const
  {
    constexpr std::int64_t ForResults = (sizeof(Results) - 1) / sizeof(TeamState) + 1;
    constexpr std::int64_t Many = (std::int64_t(4) << 20) / sizeof(TeamState);
    const std::int64_t states = this->Teams + ForResults;
    return this->Backend.CountDevices() > 1 ? std::max(states, Many) : states;
  }

  /// The share of a launch that one of several GPUs has.
  /// @param teams the first of its team states.
  LoopView<Rule> View(int device, int devices, std::int64_t teams)
  {
    Results* results = this->DeviceResults;
    const auto edges = [&](int of)
    {
      const std::int64_t units = this->Bits.CountUnits() * of / devices;
      return static_cast<EdgeId>(std::min(units << EdgeUnits::UnitBits, this->Mesh.NumberOfEdges));
    };
    const auto chunks = [&](int of)
    { return static_cast<int>(this->NumberOfChunks * of / devices); };
    return { this->Mesh.View(), this->Decision, this->Guard.View(), this->Bits.View(), this->Splits,
      this->Devices, edges(device), edges(device + 1), this->Chunks.Data(), chunks(device),
      chunks(device + 1), this->TeamStates.Data() + teams, results->Sums, &results->EntriesUsed };
  }

  /// Clears the counters of the kernels.
  void Prepare()
  {
    this->Backend.Fill(
      this->TeamStates.Data(), 0, static_cast<std::int64_t>(this->TeamStates.Size()));
  }

  /// Launches a kernel that makes its blocks wait for each other.
  template <typename... Parameters, typename... Arguments>
  static void LaunchTogether(
    cudaStream_t stream, int blocks, void (*kernel)(Parameters...), const Arguments&... arguments)
  {
    std::tuple<Parameters...> values(arguments...);
    std::apply(
      [&](Parameters&... each)
      {
        void* addresses[] = { &each... };
        cudaLaunchCooperativeKernel( // CudaBackend::Launch sees whether this fails
          reinterpret_cast<const void*>(kernel), blocks, LoopThreads, addresses, 0, stream);
      },
      values);
  }

  /// Launches a kernel on the whole mesh, and waits for it. The GPUs' blocks wait for each other;
  /// if they cannot, one GPU does it, from now on.
  template <typename... Parameters, typename... Arguments>
  const Results& LaunchOnMesh(void (*kernel)(Parameters...), const Arguments&... arguments)
  {
    this->Prepare();
    this->Backend.LaunchOnEach(this->Devices,
      [&](cudaStream_t stream, int device)
      {
        LaunchTogether(
          stream, this->GridBlocks, kernel, this->View(device, this->Devices, 0), arguments...);
      });
    const Results& results = this->FetchResults();
    if (results.EntriesUsed == 0 && this->Devices > 1)
    {
      this->Devices = 1;
      return this->LaunchOnMesh(kernel, arguments...);
    }
    return results;
  }

  /// Waits for the kernel. @throws BeyondDevice.
  const Results& FetchResults()
  {
    auto* results = static_cast<Results*>(this->Backend.GetContext().GetBuffer(0).Memory.Get());
    this->Backend.Download(this->DeviceResults, 1, results);
    for (const IterationSums& iteration : results->Sums)
    {
      if (GetSum(iteration, IterationSum::Uncertain) > 0)
      {
        throw BeyondDevice();
      }
    }
    return *results;
  }

  /// @param detects whether the kernel begins with a detection.
  IterationPlan MakePlan(bool detects, std::int64_t iterations) const
  {
    const auto most = static_cast<int>(std::min<std::int64_t>(iterations, MostIterations));
    return { detects, most, this->Found.Bad, this->Guard.GetFreshSlotsLeft() };
  }

  /// What a detection has found.
  static StepCounts ToFound(const Results& results)
  {
    const IterationSums& all = results.Sums[1];
    StepCounts found;
    found.Tested = GetSum(results.Sums[0], IterationSum::Tested);
    found.Bad = GetSum(all, IterationSum::AllBad);
    found.BlockedByShape = GetSum(all, IterationSum::AllBlockedByShape);
    found.BlockedByEdge = GetSum(all, IterationSum::AllBlockedByEdge);
    return found;
  }

  /// Takes over the counts of a launch, and maintains the guard.
  /// @param first the entry of the first iteration.
  std::vector<IterationCounts> TakeIterations(const Results& results, int first)
  {
    std::vector<IterationCounts> iterations;
    StepCounts flips;
    for (int i = first; i < results.EntriesUsed; ++i)
    {
      const IterationSums& iteration = results.Sums[i];
      iterations.push_back(ToIteration(this->Found, iteration));
      this->Found = Follow(this->Found, iteration);
      flips.FreshSlots += GetSum(iteration, IterationSum::FreshSlots);
      flips.FreedSlots += GetSum(iteration, IterationSum::FreedSlots);
      flips.LostInserts += GetSum(iteration, IterationSum::LostInserts);
    }
    if (this->Guard.IsActive() && this->Guard.Maintain(flips, this->Mesh, this->Backend))
    {
      const std::int64_t tested = this->Found.Tested;
      this->Detect(); // again, now that the table holds all edges
      this->Found.Tested = tested;
    }
    return iterations;
  }

  /// Adds the counts of iterations within chunks.
  void LaunchChunks(int iterations, std::vector<IterationCounts>& total)
  {
    this->Prepare();
    const int devices = this->Backend.CountDevices();
    this->Backend.LaunchOnEach(devices,
      [&](cudaStream_t stream, int device)
      {
        if constexpr (!Rule::IsInSpace)
        {
          LaunchTogether(stream, this->Teams * this->BlocksOfTeam, RunChunksKernel<Rule>,
            this->View(device, devices, device * this->CountTeamStates()), this->BlocksOfTeam,
            iterations);
        }
      });
    const Results& results = this->FetchResults();
    const IterationSums& sums = results.Sums[iterations];
    StepCounts edges;
    edges.Tested = this->TestedInChunks;
    edges.Bad = GetSum(sums, IterationSum::AllBad);
    edges.BlockedByShape = GetSum(sums, IterationSum::AllBlockedByShape);
    for (int i = 0; i < iterations; ++i)
    {
      total.push_back(ToIteration(edges, results.Sums[i]));
      edges = Follow(edges, results.Sums[i]);
    }
    this->TestedInChunks = edges.Tested;
  }

  EdgeMesh& Mesh;
  Rule Decision;
  CoordinateRange Range;
  EdgeGuard Guard;
  const CudaBackend& Backend;
  int Devices = 1; ///< GPUs that make iterations on the whole mesh.
  int GridBlocks = 1; ///< Thread blocks on each of them.
  int Teams = 1;
  int BlocksOfTeam = 1;
  std::int64_t TestedInChunks = 0; ///< The edges tested by the last iteration within chunks.
  int Splits = 0; ///< 2^Splits warps share a unit of the worklist.
  DeviceEdgeBits Bits;
  Array<DeviceChunk> Chunks;
  Array<TeamState> TeamStates; ///< The results are behind them, so that both are cleared at once.
  Results* DeviceResults = nullptr;
};

template <typename Rule>
struct LoopOf<CudaBackend, Rule>
{
  using Type = CudaFlipLoop<Rule>;
};

}

#endif
