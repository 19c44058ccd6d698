// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CUDAFLIPLOOP_CUH
#define DELAUNAYFLIP_CUDAFLIPLOOP_CUH

#include "AngleSurvey.h"
#include "BadEdgeCounts.h"
#include "CudaBackend.cuh"
#include "DeviceEdgeBits.cuh"
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
  CudaFlipLoop(EdgeMesh& mesh, const Rule& rule, CoordinateRange range, EdgeGuard guard,
    const CudaBackend& backend)
    : FlipLoop(mesh.NumberOfTriangles, guard.IsActive()),
      Mesh(mesh),
      Decision(rule),
      Range(range),
      Guard(std::move(guard)),
      Backend(backend),
      Bits(mesh, backend)
  {
    this->Chunks = backend.MakeArray<DeviceChunk>(this->NumberOfChunks);
    this->DeviceResults = backend.MakeArray<Results>(1);
    this->PlanGrid();
    this->PlanTeams();
    this->CutIntoChunks();
  }

  double FindLargestSquaredCotangent() const override
  {
    const AngleSurvey<Rule> survey{ this->Mesh.Triangles.Data(), this->Decision, this->Range };
    return this->Backend.template Sum<LargestValue>(this->Mesh.NumberOfTriangles, survey).Value;
  }

  // Public because device lambdas require it.

  /// Chunk c has the edges whose smallest corner it has at first. Edges are numbered in that order.
  void CutIntoChunks()
  {
    DeviceChunk* chunks = this->Chunks.Data();
    const CornerId* words = this->Mesh.CornerOfHalfEdge.Data();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    const int bits = this->ChunkBits;
    this->Backend.ForEach(this->NumberOfChunks,
      [=] __device__(std::int64_t c)
      {
        chunks[c] = { FirstEdgeOf(words, edges, c << bits),
          FirstEdgeOf(words, edges, (c + 1) << bits) };
      });
  }

  /// The first edge whose first corner belongs to `triangle` or a later one.
  __host__ __device__ static EdgeId FirstEdgeOf(
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
    return static_cast<EdgeId>(begin);
  }

protected:
  StepCounts DetectAll() override
  {
    this->Prepare();
    this->LaunchTogether(this->GridBlocks, DetectAllKernel<Rule>, this->View());
    const Results& results = this->FetchResults();
    const IterationSums& all = results.Sums[1];
    this->Edges = { GetSum(results.Sums[0], IterationSum::Tested),
      GetSum(all, IterationSum::AllBad), GetSum(all, IterationSum::AllBlockedByShape),
      GetSum(all, IterationSum::AllBlockedByEdge) };
    return this->Edges.ToCounts();
  }

  /// A launch of iterations on the whole mesh.
  std::vector<IterationCounts> IterateMesh(const AdvancePlan& plan) override
  {
    const bool measure = plan.MeasureFirst || plan.MeasureAll;
    const std::int64_t most = measure ? 1 : std::min<std::int64_t>(plan.Iterations, MostIterations);
    const std::int64_t freshSlots =
      this->Guard.IsActive() ? std::max<std::int64_t>(0, this->Guard.GetFreshSlotsLeft()) : 0;
    const IterationLimits limits{ static_cast<int>(most), this->Found.Bad,
      static_cast<unsigned long long>(freshSlots) };
    this->Prepare();
    this->LaunchTogether(this->GridBlocks, IterateKernel<Rule>, this->View(), limits);
    std::vector<IterationCounts> iterations = this->ReadIterations(freshSlots);
    if (measure)
    {
      iterations.back().SquaredCotangent = this->FindLargestSquaredCotangent();
    }
    return iterations;
  }

  std::vector<IterationCounts> IterateChunks(const AdvancePlan& plan) override
  {
    this->Bits.DeferEdgesBetweenChunks(this->Mesh, this->ChunkBits);
    std::vector<IterationCounts> iterations;
    while (static_cast<std::int64_t>(iterations.size()) < plan.Iterations)
    {
      const bool measure = plan.MeasureAll || (plan.MeasureFirst && iterations.empty());
      const std::int64_t left = plan.Iterations - static_cast<std::int64_t>(iterations.size());
      this->LaunchChunks(measure ? 1 : static_cast<int>(left), iterations);
      if (measure)
      {
        iterations.back().SquaredCotangent = this->FindLargestSquaredCotangent();
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
    int IterationsDone;
    IterationSums Sums[MostIterations + 1];
  };

  /// The number of blocks that can run at the same time, as their barriers need.
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

  /// Only as many blocks as have work: with fewer blocks, waits are shorter.
  void PlanGrid()
  {
    const std::int64_t blocks =
      std::min(MostIterateBlocks, this->CountResidentBlocks(IterateKernel<Rule>));
    std::int64_t parts = this->Bits.CountUnits();
    for (; this->Splits < EdgeUnits::MostSplits && 2 * parts <= blocks * LoopWarps; parts *= 2)
    {
      ++this->Splits;
    }
    // One block is faster in two steps than two blocks that wait for each other.
    const std::int64_t wanted = parts <= 2 * LoopWarps ? 1 : (parts + LoopWarps - 1) / LoopWarps;
    this->GridBlocks = static_cast<int>(std::min(blocks, wanted));
  }

  void PlanTeams()
  {
    const int blocks = this->CountResidentBlocks(RunChunksKernel<Rule>);
    const auto teams = static_cast<int>(this->Backend.GetContext().CacheBytes / ChunkBytes);
    const auto chunks = static_cast<int>(this->NumberOfChunks);
    this->Teams = std::max(1, std::min({ teams, chunks, blocks }));
    this->BlocksOfTeam = blocks / this->Teams;
    this->TeamStates = this->Backend.template MakeArray<TeamState>(this->Teams);
  }

  LoopView<Rule> View()
  {
    Results* results = this->DeviceResults.Data();
    return { this->Mesh.View(), this->Decision, this->Guard.View(), this->Bits.View(), this->Splits,
      static_cast<EdgeId>(this->Mesh.NumberOfEdges), this->Chunks.Data(),
      static_cast<int>(this->NumberOfChunks), this->TeamStates.Data(), results->Sums,
      &results->IterationsDone };
  }

  /// Clears the counters of the kernels.
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
    for (const IterationSums& iteration : results->Sums)
    {
      if (GetSum(iteration, IterationSum::Uncertain) > 0)
      {
        throw BeyondDevice();
      }
    }
    return *results;
  }

  std::vector<IterationCounts> ReadIterations(std::int64_t freshSlots)
  {
    const Results& results = this->FetchResults();
    std::vector<IterationCounts> iterations;
    StepCounts flips;
    for (int i = 0; i < results.IterationsDone; ++i)
    {
      const IterationSums& iteration = results.Sums[i];
      iterations.push_back(this->Edges.ToIteration(iteration));
      this->Edges = this->Edges.Follow(iteration, this->Guard.IsActive());
      flips.FreshSlots += GetSum(iteration, IterationSum::FreshSlots);
      flips.LostInserts += GetSum(iteration, IterationSum::LostInserts);
    }
    this->Found = this->Edges.ToCounts();
    if (this->Guard.IsActive())
    {
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
      if (flips.FreshSlots > freshSlots || flips.LostInserts > 0)
      {
        this->Detect(); // the kernel did not make it
      }
    }
    return iterations;
  }

  /// Adds the counts of iterations within chunks.
  void LaunchChunks(int iterations, std::vector<IterationCounts>& total)
  {
    this->Prepare();
    this->LaunchTogether(this->Teams * this->BlocksOfTeam, RunChunksKernel<Rule>, this->View(),
      this->BlocksOfTeam, iterations);
    const Results& results = this->FetchResults();
    const IterationSums& sums = results.Sums[iterations];
    BadEdgeCounts edges{ this->TestedInChunks, GetSum(sums, IterationSum::AllBad),
      GetSum(sums, IterationSum::AllBlockedByShape), 0 };
    for (int i = 0; i < iterations; ++i)
    {
      total.push_back(edges.ToIteration(results.Sums[i]));
      edges = edges.Follow(results.Sums[i], false);
    }
    this->TestedInChunks = edges.Tested;
  }

  EdgeMesh& Mesh;
  Rule Decision;
  CoordinateRange Range;
  EdgeGuard Guard;
  const CudaBackend& Backend;
  int GridBlocks = 1;
  int Teams = 1;
  int BlocksOfTeam = 1;
  std::int64_t TestedInChunks = 0; ///< The edges tested by the last iteration within chunks.
  int Splits = 0; ///< 2^Splits warps share a unit of the worklist.
  DeviceEdgeBits Bits;
  Array<DeviceChunk> Chunks;
  Array<TeamState> TeamStates;
  Array<Results> DeviceResults;
  BadEdgeCounts Edges; ///< The same as Found, in detail.
};

template <typename Rule>
struct LoopOf<CudaBackend, Rule>
{
  using Type = CudaFlipLoop<Rule>;
};

}

#endif
