// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipLoop.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
/// The smallest mesh with chunks.
constexpr std::int64_t SmallestChunkedMesh = std::int64_t(1) << 16; // triangles

/// How many iterations run within chunks before iterations span the mesh.
constexpr std::int64_t ChunkIterations = 12;

/// A chunk of 2^16 triangles takes 3 MB, with its edges and points. Meshes that would have only a
/// few chunks have smaller ones, so that more threads have work: 16 threads then flip a random bad
/// mesh of 100,000 points in 11 ms instead of 25; a GPU takes the same time as before
/// (Documentation/notebook/performance.md).
int FindChunkBits(std::int64_t triangles)
{
  constexpr int Most = 16, Fewest = 14;
  constexpr std::int64_t WantedChunks = 16;
  int bits = Most;
  while (bits > Fewest && triangles >> bits < WantedChunks)
  {
    --bits;
  }
  return bits;
}
}

FlipLoop::FlipLoop(std::int64_t triangles, bool hasGuard)
  : ChunkBits(FindChunkBits(triangles))
{
  if (!hasGuard && triangles > SmallestChunkedMesh)
  {
    this->NumberOfChunks = ((triangles - 1) >> this->ChunkBits) + 1;
    this->ChunkIterationsLeft = ChunkIterations;
  }
}

const StepCounts& FlipLoop::Detect()
{
  this->Found = this->DetectAll();
  return this->Found;
}

std::vector<IterationCounts> FlipLoop::DetectAndIterate(std::int64_t /*iterations*/)
{
  this->Detect();
  return {};
}

/// Edges may be in other chunks now.
void FlipLoop::Restart()
{
  this->ChunkIterationsLeft = 0;
  this->TakeStates();
}

bool FlipLoop::RestartMoved(bool hasOtherEdges)
{
  this->ChunkIterationsLeft = 0;
  return this->TakeMoved(hasOtherEdges);
}

bool FlipLoop::TakeMoved(bool hasOtherEdges)
{
  if (!hasOtherEdges)
  {
    this->TakeStates();
  }
  return !hasOtherEdges;
}

std::vector<IterationCounts> FlipLoop::Advance(const AdvancePlan& plan)
{
  if (this->ChunkIterationsLeft == 0)
  {
    return this->IterateMesh(plan);
  }
  // Within chunks, as many iterations as the plan and the schedule allow; none if no chunk has an
  // edge to flip.
  const bool isFirst = this->ChunkIterationsLeft == ChunkIterations;
  const std::int64_t most = std::min(this->ChunkIterationsLeft, plan.Iterations);
  std::vector<IterationCounts> iterations =
    this->IterateChunks({ most, plan.MeasureFirst, plan.MeasureAll });
  this->ChunkIterationsLeft -= most;
  while (!iterations.empty() && iterations.back().Flipped == 0)
  {
    iterations.pop_back();
    this->ChunkIterationsLeft = 0;
  }
  if (isFirst && !iterations.empty())
  {
    // The detection before the first iteration covered all edges. Bad edges between chunks count as
    // excluded from that iteration.
    iterations[0].Tested = this->Found.Tested;
    iterations[0].Bad = this->Found.Bad;
    iterations[0].Blocked = this->Found.GetBlocked();
  }
  this->Detect();
  if (iterations.empty())
  {
    return this->IterateMesh(plan);
  }
  return iterations;
}

std::int64_t FlipLoop::Converge(const ConvergeLimit& limit)
{
  constexpr AdvancePlan Plan{ 64, false, false };
  constexpr std::int64_t FlipsPerIteration = 256;
  constexpr std::int64_t FlipsToTell = std::int64_t(1) << 14; // a few milliseconds on one thread
  std::int64_t flips = 0, cost = 0, nextToTell = FlipsToTell;
  const bool startsInChunks = this->ChunkIterationsLeft > 0;
  std::vector<IterationCounts> iterations =
    startsInChunks ? FlipLoop::DetectAndIterate(0) : this->DetectAndIterate(Plan.Iterations);
  for (;;)
  {
    for (const IterationCounts& iteration : iterations)
    {
      flips += iteration.Flipped;
      cost += iteration.Flipped + FlipsPerIteration;
    }
    // All backends make the same iterations, though in other batches, and so all or none give up.
    if (cost > limit.Flips)
    {
      return GaveUp;
    }
    if (this->Found.Bad == 0)
    {
      return flips;
    }
    if (limit.Tell && cost >= nextToTell)
    {
      nextToTell = cost + FlipsToTell;
      limit.Tell(static_cast<double>(cost) / static_cast<double>(limit.Flips));
    }
    iterations = this->Advance(Plan);
  }
}

}
