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
    this->LoadStates();
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
          FirstEdgeOf(words, edges, (c + 1) << ChunkBits) };
      });
  }

  /// The states at first as bits; what is behind the last edge is fixed.
  void LoadStates()
  {
    const EdgeBits bits = this->Bits;
    const EdgeState* states = this->Mesh.States.Data();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        std::uint32_t fixed = 0;
        for (int i = 0; i < 32; ++i)
        {
          const std::int64_t edge = 32 * word + i;
          fixed |= edge >= edges || states[edge] == EdgeState::Fixed ? 1u << i : 0;
        }
        bits.Fixed[word] = fixed;
        bits.Asleep[word] = fixed;
        bits.Candidates[word] = ~fixed;
        bits.Bad[word] = bits.Winners[word] = bits.Misshapen[word] = bits.Obstructed[word] = 0;
      });
  }

  void DeferEdgesBetweenChunks()
  {
    const EdgeBits bits = this->Bits;
    const EdgeMeshView mesh = this->Mesh.View();
    const std::int64_t edges = this->Mesh.NumberOfEdges;
    // Threads of a warp work on one word.
    this->Backend.ForEach(32 * this->NumberOfWords,
      [=] __device__(std::int64_t e)
      {
        bool between = false;
        if (e < edges && !EdgeBits::Has(bits.Fixed, static_cast<EdgeId>(e)))
        {
          const CornerPair corners = mesh.GetCorners(static_cast<EdgeId>(e));
          between = (TriangleOf(corners.A) ^ TriangleOf(corners.B)) >> ChunkBits != 0;
        }
        const std::uint32_t deferred = __ballot_sync(WholeWarp, between);
        if (e % 32 == 0)
        {
          bits.Asleep[e / 32] |= deferred;
          bits.Bad[e / 32] &= ~deferred;
          bits.Misshapen[e / 32] &= ~deferred;
        }
      });
  }

  void RecallEdges()
  {
    const EdgeBits bits = this->Bits;
    this->Backend.ForEach(this->NumberOfWords,
      [=] __device__(std::int64_t word)
      {
        bits.Candidates[word] = bits.Asleep[word] & ~bits.Fixed[word];
        bits.Asleep[word] = bits.Fixed[word];
      });
  }

  /// Flags the units that have something to do.
  void FlagUnits()
  {
    const EdgeBits bits = this->Bits;
    std::uint8_t* flags = this->Flags.Data();
    constexpr int Words = DeviceWorklist::UnitSize / 32;
    const std::int64_t words = this->NumberOfWords;
    this->Backend.ForEach(static_cast<std::int64_t>(this->Flags.Size()),
      [=] __device__(std::int64_t unit)
      {
        std::uint32_t any = 0;
        for (std::int64_t word = Words * unit; word < Words * (unit + 1) && word < words; ++word)
        {
          any |= bits.Bad[word] | bits.Obstructed[word];
        }
        flags[unit] = any != 0 ? 1 : 0;
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

private:
  /// Iterations of a launch: a batch ends soon enough for whoever watches.
  static constexpr int MostIterations = 128;
  /// With fewer bad edges one block is faster than the whole grid, with its slower barrier.
  static constexpr std::int64_t SmallTail = 64;
  static constexpr std::int64_t LargeTail = 4 * SmallTail;
  /// Of the second-level cache for a chunk at work: twice what it fills.
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
    const std::int64_t units =
      (this->Mesh.NumberOfEdges + DeviceWorklist::UnitSize - 1) >> DeviceWorklist::UnitBits;
    this->NumberOfWords = units * DeviceWorklist::UnitSize / 32;
    this->Words =
      this->Backend.template MakeArray<std::uint32_t>(EdgeBits::Kinds * this->NumberOfWords);
    std::uint32_t* words = this->Words.Data();
    for (std::uint32_t** bits : { &this->Bits.Fixed, &this->Bits.Asleep, &this->Bits.Candidates,
           &this->Bits.Bad, &this->Bits.Winners, &this->Bits.Misshapen, &this->Bits.Obstructed })
    {
      *bits = words;
      words += this->NumberOfWords;
    }
    // Flags are read eight at a time.
    this->Flags = this->Backend.template MakeArray<std::uint8_t>((units + 7) / 8 * 8);
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

  /// @param flagged whether to look at flagged units only.
  LoopView<Rule> View(bool flagged = false)
  {
    Results* results = this->DeviceResults.Data();
    return { this->Mesh.View(), this->Decision, this->Guard.View(), this->Bits,
      flagged ? this->Flags.Data() : nullptr, static_cast<EdgeId>(this->Mesh.NumberOfEdges),
      this->Chunks.Data(), this->NumberOfChunks, this->TeamStates.Data(), results->Rounds,
      &results->RoundsDone };
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
    this->LaunchTogether(this->GridBlocks, DetectAllKernel<Rule>, this->View());
    const Results& results = this->FetchResults();
    const RoundSums& all = results.Rounds[1];
    this->Edges = { GetSum(results.Rounds[0], RoundSum::Tested), GetSum(all, RoundSum::AllBad),
      GetSum(all, RoundSum::AllMisshapen), GetSum(all, RoundSum::AllObstructed) };
    this->Found = this->Edges.ToCounts();
  }

  /// What is bad after a round.
  BadEdges Follow(const BadEdges& before, const RoundSums& round) const
  {
    const std::int64_t bad = before.Bad - GetSum(round, RoundSum::Flipped) -
      GetSum(round, RoundSum::WasBad) + GetSum(round, RoundSum::IsBad);
    return { GetSum(round, RoundSum::Tested),
      this->Guard.IsActive() ? GetSum(round, RoundSum::AllBad) : bad,
      before.Misshapen - GetSum(round, RoundSum::WasMisshapen) +
        GetSum(round, RoundSum::IsMisshapen),
      GetSum(round, RoundSum::AllObstructed) };
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
    const IterationLimits limits{ static_cast<int>(most), this->Found.Bad, small ? 1 : SmallTail,
      small ? LargeTail : this->Mesh.NumberOfEdges, static_cast<unsigned long long>(freshSlots) };
    if (small)
    {
      this->FlagUnits();
    }
    this->Prepare();
    this->LaunchTogether(
      small ? 1 : this->GridBlocks, IterateKernel<Rule>, this->View(small), limits);
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
    BadEdges edges{ this->TestedInChunks, GetSum(sums, RoundSum::AllBad),
      GetSum(sums, RoundSum::AllMisshapen), 0 };
    for (int i = 0; i < rounds; ++i)
    {
      total.push_back(ToIteration(edges, results.Rounds[i]));
      edges = this->Follow(edges, results.Rounds[i]);
    }
    this->TestedInChunks = edges.Tested;
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
  std::int64_t TestedInChunks = 0; ///< By the last round within chunks.
  std::int64_t NumberOfWords = 0; ///< Of each kind of bits.
  Array<std::uint32_t> Words;
  EdgeBits Bits{};
  Array<std::uint8_t> Flags;
  Array<DeviceChunk> Chunks;
  Array<TeamState> TeamStates;
  Array<Results> DeviceResults;
  BadEdges Edges; ///< As Found, in detail.
};

template <typename Rule>
struct LoopOf<CudaBackend, Rule>
{
  using Type = CudaFlipLoop<Rule>;
};

}

#endif
