// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAFLIPLOOP_CUH
#define DELAUNAYFLIP_CUDAFLIPLOOP_CUH

#include "AngleSurvey.h"
#include "CudaBackend.cuh"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipError.h"
#include "FlipKernels.cuh"
#include "FlipLoop.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The loop on a GPU, by one of the rules of FlipRules.h.
template <typename Rule>
class CudaFlipLoop : public FlipLoop
{
public:
  /// @param scale power of two that brings the rule's coordinates near 1, for angles.
  CudaFlipLoop(
    EdgeMesh& mesh, const Rule& rule, double scale, EdgeGuard guard, const CudaBackend& backend)
    : Mesh(mesh),
      Decision(rule),
      Scale(scale),
      Guard(std::move(guard)),
      Backend(backend)
  {
    const bool hasChunks =
      !this->Guard.IsActive() && mesh.NumberOfTriangles > (std::int64_t(1) << ChunkBits);
    this->NumberOfChunks =
      hasChunks ? static_cast<int>(((mesh.NumberOfTriangles - 1) >> ChunkBits) + 1) : 0;
    this->RoundsLeft = hasChunks ? ChunkRounds : 0;
    this->Allocate();
    this->PlanGrids();
    this->CutIntoChunks();
  }

  StepCounts Detect() override
  {
    const CurrentDevice device(this->Backend.GetContext().Device);
    this->DetectAll();
    return this->Found;
  }

  std::vector<IterationCounts> Advance(const AdvancePlan& plan) override
  {
    const CurrentDevice device(this->Backend.GetContext().Device);
    std::vector<IterationCounts> iterations;
    if (this->RoundsLeft > 0)
    {
      iterations = this->RunChunks(plan);
      this->DetectAll();
    }
    if (iterations.empty())
    {
      iterations = this->Iterate(plan);
    }
    return iterations;
  }

  double FindLargestSquaredCotangent() const override
  {
    const CurrentDevice device(this->Backend.GetContext().Device);
    return this->MeasureAngles();
  }

  // Public because device lambdas ask for them.

  /// Chunk c holds the edges whose smallest corner it holds at first: they are numbered in order.
  void CutIntoChunks()
  {
    DeviceChunk* chunks = this->Chunks.Data();
    const CornerId* words = this->Mesh.CornerOfHalfEdge.Data();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    this->Backend.ForEach(this->NumberOfChunks,
      [=] __device__(std::int64_t c)
      {
        chunks[c] = { FirstEdgeOf(words, edges, c << ChunkBits),
          FirstEdgeOf(words, edges, (c + 1) << ChunkBits), 0 };
      });
  }

  void DeferEdgesBetweenChunks()
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Backend.ForEach(this->Mesh.NumberOfEdges,
      [=] __device__(std::int64_t e)
      {
        const TriangleId a = TriangleOf(mesh.CornerOfHalfEdge[2 * e]);
        const TriangleId b = TriangleOf(mesh.CornerOfHalfEdge[2 * e + 1]);
        if ((a ^ b) >> ChunkBits != 0 && mesh.States[e] != EdgeState::Fixed)
        {
          mesh.States[e] = EdgeState::Deferred;
        }
      });
  }

  void RecallEdges()
  {
    EdgeState* states = this->Mesh.States.Data();
    this->Backend.ForEach(this->Mesh.NumberOfEdges,
      [=] __device__(std::int64_t e)
      {
        if (states[e] == EdgeState::Deferred)
        {
          states[e] = EdgeState::Candidate;
        }
      });
  }

  /// Marks what is to become no candidate.
  void ResetMarks()
  {
    const EdgeState* states = this->Mesh.States.Data();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    std::uint32_t* marks = this->Marks.Data();
    this->Backend.ForEach(static_cast<std::int64_t>(this->Marks.Size()),
      [=] __device__(std::int64_t word)
      {
        std::uint32_t bits = 0;
        for (int i = 0; i < 32 && 32 * word + i < edges; ++i)
        {
          const EdgeState state = states[32 * word + i];
          bits |= state == EdgeState::Fixed || state == EdgeState::Deferred ? 1u << i : 0;
        }
        marks[word] = bits;
      });
  }

  double MeasureAngles() const
  {
    const AngleSurvey<Rule> survey{ this->Mesh.Triangles.Data(), this->Decision, this->Scale };
    return this->Backend
      .template Sum<LargestValue>(this->Mesh.NumberOfTriangles,
        [=] __device__(std::int64_t t, LargestValue & largest) { largest += survey(t); })
      .Value;
  }

  /// The first edge whose first corner is of `triangle` or a later one.
  __host__ __device__ static std::int64_t FirstEdgeOf(
    const CornerId* words, std::int64_t edges, std::int64_t triangle)
  {
    std::int64_t begin = 0;
    std::int64_t end = edges;
    while (begin < end)
    {
      const std::int64_t middle = (begin + end) / 2;
      if (static_cast<std::int64_t>(TriangleOf(words[2 * middle])) < triangle)
      {
        begin = middle + 1;
      }
      else
      {
        end = middle;
      }
    }
    return begin;
  }

private:
  /// Iterations of a launch: a batch ends soon enough for whoever watches.
  static constexpr int MostIterations = 128;
  /// With fewer bad edges one block is faster than the whole grid, with its slower barrier.
  static constexpr unsigned SmallTail = 512;
  static constexpr unsigned LargeTail = 4 * SmallTail;
  /// Of the second-level cache, for chunks at work: half, the rest is others'.
  static constexpr std::size_t ChunkBytes = std::size_t(7) << 20;

  /// What a launch leaves behind.
  struct Results
  {
    int RoundsDone;
    RoundSums Rounds[MostIterations + 1];
  };

  /// What is bad, by why it does not flip.
  struct BadEdges
  {
    std::int64_t Tested = 0, Bad = 0, Misshapen = 0, BlockedByEdge = 0;

    StepCounts ToCounts() const
    {
      StepCounts counts;
      counts.Tested = this->Tested;
      counts.Bad = this->Bad;
      counts.Blocked = this->Misshapen + this->BlockedByEdge;
      return counts;
    }
  };

  void Allocate()
  {
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    // With a guard, winners that step back are for a moment on two lists.
    this->ListSize = this->Guard.IsActive() ? edges + edges / 3 + 1 : edges;
    this->Lists[0] = this->Backend.template MakeArray<EdgeId>(this->ListSize);
    this->Lists[1] = this->Backend.template MakeArray<EdgeId>(this->ListSize);
    this->Marks = this->Backend.template MakeArray<std::uint32_t>(edges / 32 + 1);
    this->Chunks = this->Backend.template MakeArray<DeviceChunk>(this->NumberOfChunks);
    this->DeviceResults = this->Backend.template MakeArray<Results>(1);
  }

  /// As many blocks as run at the same time, which their barriers need.
  template <typename Kernel>
  int CountResidentBlocks(Kernel kernel) const
  {
    int perMultiprocessor = 0;
    CallCuda("plan a launch",
      [&]
      {
        return cudaOccupancyMaxActiveBlocksPerMultiprocessor(
          &perMultiprocessor, kernel, LoopThreads, 0);
      });
    return perMultiprocessor * this->Backend.GetContext().Multiprocessors;
  }

  void PlanGrids()
  {
    this->GridBlocks = this->CountResidentBlocks(IterateKernel<Rule>);
    const int blocks = this->CountResidentBlocks(RunChunksKernel<Rule>);
    const auto teams = static_cast<int>(this->Backend.GetContext().CacheBytes / ChunkBytes);
    this->Teams = std::max(1, std::min({ teams, this->NumberOfChunks, blocks }));
    this->BlocksOfTeam = blocks / this->Teams;
    this->TeamStates = this->Backend.template MakeArray<TeamState>(this->Teams);
  }

  LoopView<Rule> View()
  {
    Results* results = this->DeviceResults.Data();
    return { this->Mesh.View(), this->Decision, this->Guard.View(), this->Mesh.NumberOfEdges,
      { this->Lists[0].Data(), this->Lists[1].Data() }, this->Marks.Data(), this->Chunks.Data(),
      this->NumberOfChunks, this->TeamStates.Data(), results->Rounds, &results->RoundsDone };
  }

  /// Clears what kernels count in.
  void Prepare()
  {
    this->Backend.Fill(this->DeviceResults.Data(), 0, 1);
    this->Backend.Fill(this->TeamStates.Data(), 0, this->Teams);
  }

  /// Launches a kernel whose blocks wait for each other.
  template <typename... Parameters, typename... Arguments>
  void LaunchTogether(int blocks, void (*kernel)(Parameters...), Arguments... arguments)
  {
    std::tuple<Parameters...> values(arguments...);
    std::apply(
      [&](Parameters&... each)
      {
        void* addresses[] = { &each... };
        CallCuda("start a cooperative kernel",
          [&]
          {
            return cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(kernel), blocks,
              LoopThreads, addresses, 0, this->Backend.GetStream());
          });
      },
      values);
  }

  /// Waits for the kernel. @throws BeyondDevice.
  const Results& FetchResults()
  {
    auto* results = static_cast<Results*>(this->Backend.GetContext().Staging[0]);
    this->Backend.Download(this->DeviceResults.Data(), 1, results);
    for (const RoundSums& round : results->Rounds)
    {
      if (GetSum(round, RoundSum::Uncertain) > 0)
      {
        throw BeyondDevice();
      }
    }
    return *results;
  }

  static std::int64_t GetSum(const RoundSums& round, RoundSum sum)
  {
    return static_cast<std::int64_t>(round.Values[static_cast<int>(sum)]);
  }

  void DetectAll()
  {
    this->Prepare();
    const LoopView<Rule> view = this->View();
    this->LaunchTogether(this->GridBlocks, DetectAllKernel<Rule>, view);
    const RoundSums& sums = this->FetchResults().Rounds[0];
    this->Edges = { GetSum(sums, RoundSum::Tested), GetSum(sums, RoundSum::NewlyBad),
      GetSum(sums, RoundSum::NewlyMisshapen), GetSum(sums, RoundSum::GuardedBlocked) };
    this->Found = this->Edges.ToCounts();
  }

  /// What is bad after a round.
  BadEdges Follow(const BadEdges& before, const RoundSums& round) const
  {
    const std::int64_t listed = GetSum(round, RoundSum::Carried) +
      GetSum(round, RoundSum::NewlyBad) - GetSum(round, RoundSum::Cured);
    const bool guarded = this->Guard.IsActive();
    return { GetSum(round, RoundSum::Tested),
      guarded ? GetSum(round, RoundSum::GuardedBad) : listed,
      before.Misshapen + GetSum(round, RoundSum::NewlyMisshapen) -
        GetSum(round, RoundSum::Reshaped),
      GetSum(round, RoundSum::GuardedBlocked) };
  }

  static IterationCounts ToIteration(const BadEdges& before, const RoundSums& round)
  {
    return { before.Tested, before.Bad, before.Misshapen + before.BlockedByEdge,
      GetSum(round, RoundSum::Flipped), -INFINITY };
  }

  /// A launch of iterations on the whole mesh.
  std::vector<IterationCounts> Iterate(const AdvancePlan& plan)
  {
    const bool measure = plan.MeasureFirst || plan.MeasureAll;
    const std::int64_t most = measure ? 1 : std::min<std::int64_t>(plan.Iterations, MostIterations);
    const bool small = this->Found.Bad < SmallTail;
    const std::int64_t freshSlots =
      this->Guard.IsActive() ? std::max<std::int64_t>(0, this->Guard.GetFreshSlotsLeft()) : 0;
    const IterationLimits limits{ static_cast<int>(most), small ? 1 : SmallTail,
      small ? LargeTail : static_cast<unsigned>(this->Mesh.NumberOfEdges),
      static_cast<unsigned long long>(freshSlots) };
    this->ResetMarks();
    this->Prepare();
    this->LaunchTogether(small ? 1 : this->GridBlocks, IterateKernel<Rule>, this->View(),
      static_cast<unsigned>(this->ListSize), limits);
    std::vector<IterationCounts> iterations = this->ReadIterations(freshSlots);
    if (measure)
    {
      iterations.back().SquaredCotangent = this->MeasureAngles();
    }
    return iterations;
  }

  std::vector<IterationCounts> ReadIterations(std::int64_t freshSlots)
  {
    const Results& results = this->FetchResults();
    std::vector<IterationCounts> iterations;
    StepCounts flips;
    for (int i = 0; i < results.RoundsDone; ++i)
    {
      const RoundSums& round = results.Rounds[i];
      iterations.push_back(ToIteration(this->Edges, round));
      this->Edges = this->Follow(this->Edges, round);
      flips.FreshSlots += GetSum(round, RoundSum::FreshSlots);
      flips.LostInserts += GetSum(round, RoundSum::LostInserts);
    }
    this->Found = this->Edges.ToCounts();
    if (this->Guard.IsActive())
    {
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
      if (flips.FreshSlots > freshSlots || flips.LostInserts > 0)
      {
        this->DetectAll(); // which the kernel left to us
      }
    }
    return iterations;
  }

  /// The rounds that chunks run for themselves, at most as many as the plan and the schedule allow.
  /// None when no chunk has anything to flip.
  std::vector<IterationCounts> RunChunks(const AdvancePlan& plan)
  {
    const std::int64_t rounds = std::min(this->RoundsLeft, plan.Iterations);
    const bool isFirst = this->RoundsLeft == ChunkRounds;
    this->DeferEdgesBetweenChunks();
    this->ResetMarks();
    std::vector<IterationCounts> total;
    while (static_cast<std::int64_t>(total.size()) < rounds)
    {
      const bool measure = plan.MeasureAll || (plan.MeasureFirst && total.empty());
      this->RunRounds(
        measure ? 1 : static_cast<int>(rounds - static_cast<std::int64_t>(total.size())), total);
      if (measure)
      {
        total.back().SquaredCotangent = this->MeasureAngles();
      }
    }
    this->RecallEdges();
    this->RoundsLeft -= rounds;
    while (!total.empty() && total.back().Flipped == 0)
    {
      total.pop_back();
      this->RoundsLeft = 0;
    }
    if (isFirst && !total.empty())
    {
      // The first round knows all edges; those between chunks are excluded from it.
      total[0].Tested = this->Found.Tested;
      total[0].Bad = this->Found.Bad;
      total[0].Blocked = this->Found.Blocked;
    }
    return total;
  }

  void RunRounds(int rounds, std::vector<IterationCounts>& total)
  {
    this->Prepare();
    this->LaunchTogether(this->Teams * this->BlocksOfTeam, RunChunksKernel<Rule>, this->View(),
      this->BlocksOfTeam, rounds);
    const Results& results = this->FetchResults();
    const RoundSums& sums = results.Rounds[rounds];
    BadEdges edges{ GetSum(sums, RoundSum::Tested), GetSum(sums, RoundSum::Carried),
      GetSum(sums, RoundSum::NewlyMisshapen), 0 };
    for (int i = 0; i < rounds; ++i)
    {
      total.push_back(ToIteration(edges, results.Rounds[i]));
      edges = this->Follow(edges, results.Rounds[i]);
    }
  }

  EdgeMesh& Mesh;
  Rule Decision;
  double Scale;
  EdgeGuard Guard;
  const CudaBackend& Backend;
  int NumberOfChunks = 0;
  std::int64_t RoundsLeft = 0; ///< Of those within chunks.
  int GridBlocks = 1;
  int Teams = 1;
  int BlocksOfTeam = 1;
  std::int64_t ListSize = 0;
  Array<EdgeId> Lists[2];
  Array<std::uint32_t> Marks;
  Array<DeviceChunk> Chunks;
  Array<TeamState> TeamStates;
  Array<Results> DeviceResults;
  BadEdges Edges; ///< As Found, in detail.
};

template <typename Backend, typename Rule>
struct LoopOf;

template <typename Rule>
struct LoopOf<CudaBackend, Rule>
{
  using Type = CudaFlipLoop<Rule>;
};

}

#endif
