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
    this->ActivateAll();
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
          FirstEdgeOf(words, edges, (c + 1) << ChunkBits), StepCounts() };
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
    this->ActivateAll();
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
    this->ActivateAll();
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
  static constexpr std::int64_t SmallTail = 256;
  static constexpr std::int64_t LargeTail = 4 * SmallTail;
  /// Of the second-level cache, for chunks at work: half, the rest is others'.
  static constexpr std::size_t ChunkBytes = std::size_t(7) << 20;

  /// The head of the results that a launch leaves behind; rounds follow.
  struct Results
  {
    int RoundsDone;
    StepCounts Rounds[MostIterations + 1];
  };

  void Allocate()
  {
    const std::int64_t blocks = (this->Mesh.NumberOfEdges >> DeviceWorklist::BlockBits) + 1;
    this->Flags = this->Backend.template MakeArray<std::uint8_t>(blocks + this->NumberOfChunks);
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
    this->Barriers = this->Backend.template MakeArray<TeamBarrier>(this->Teams);
  }

  void ActivateAll()
  {
    this->Backend.Fill(this->Flags.Data(), 1, static_cast<std::int64_t>(this->Flags.Size()));
  }

  LoopView<Rule> View()
  {
    Results* results = this->DeviceResults.Data();
    return { this->Mesh.View(), this->Decision, this->Guard.View(), this->Flags.Data(),
      this->Mesh.NumberOfEdges, this->Chunks.Data(), this->NumberOfChunks, this->Barriers.Data(),
      results->Rounds, &results->RoundsDone };
  }

  /// Clears what kernels count in.
  void Prepare()
  {
    this->Backend.Fill(this->DeviceResults.Data(), 0, 1);
    this->Backend.Fill(this->Barriers.Data(), 0, static_cast<std::int64_t>(this->Barriers.Size()));
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
    for (const StepCounts& round : results->Rounds)
    {
      if (round.Uncertain > 0)
      {
        throw BeyondDevice();
      }
    }
    return *results;
  }

  void DetectAll()
  {
    this->Prepare();
    const LoopView<Rule> view = this->View();
    this->Backend.Launch([&](cudaStream_t stream)
      { DetectKernel<<<this->GridBlocks, LoopThreads, 0, stream>>>(view); });
    this->Found = this->FetchResults().Rounds[0];
  }

  /// A launch of iterations on the whole mesh.
  std::vector<IterationCounts> Iterate(const AdvancePlan& plan)
  {
    const bool measure = plan.MeasureFirst || plan.MeasureAll;
    const std::int64_t most = measure ? 1 : std::min<std::int64_t>(plan.Iterations, MostIterations);
    const bool small = this->Found.Bad < SmallTail;
    const IterationLimits limits{ static_cast<int>(most), small ? 1 : SmallTail,
      small ? LargeTail : this->Mesh.NumberOfEdges,
      this->Guard.IsActive() ? this->Guard.GetFreshSlotsLeft() : 0 };
    this->Prepare();
    this->LaunchTogether(small ? 1 : this->GridBlocks, IterateKernel<Rule>, this->View(), limits);
    const Results& results = this->FetchResults();
    std::vector<IterationCounts> iterations;
    StepCounts flips;
    for (int i = 0; i < results.RoundsDone; ++i)
    {
      const StepCounts& found = i == 0 ? this->Found : results.Rounds[i];
      iterations.push_back(
        { found.Tested, found.Bad, found.Blocked, results.Rounds[i].Flipped, -INFINITY });
      flips += results.Rounds[i];
    }
    this->Found = results.Rounds[results.RoundsDone];
    if (this->Guard.IsActive() && this->NeedsCare(flips, limits))
    {
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
      this->DetectAll();
    }
    else if (this->Guard.IsActive())
    {
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
    }
    if (measure)
    {
      iterations.back().SquaredCotangent = this->MeasureAngles();
    }
    return iterations;
  }

  /// Whether the kernel stopped before its last detection.
  static bool NeedsCare(const StepCounts& flips, const IterationLimits& limits)
  {
    return flips.FreshSlots > limits.FreshSlots || flips.LostInserts > 0;
  }

  /// The rounds that chunks run for themselves, at most as many as the plan and the schedule allow.
  /// None when no chunk has anything to flip.
  std::vector<IterationCounts> RunChunks(const AdvancePlan& plan)
  {
    const std::int64_t rounds = std::min(this->RoundsLeft, plan.Iterations);
    const bool isFirst = this->RoundsLeft == ChunkRounds;
    this->DeferEdgesBetweenChunks();
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
    for (int i = 0; i < rounds; ++i)
    {
      const StepCounts& round = results.Rounds[i];
      total.push_back({ round.Tested, round.Bad, round.Blocked, round.Flipped, -INFINITY });
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
  Array<std::uint8_t> Flags;
  Array<DeviceChunk> Chunks;
  Array<TeamBarrier> Barriers;
  Array<Results> DeviceResults;
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
