// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOP_H
#define DELAUNAYFLIP_FLIPLOOP_H

#include "StepCounts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// The loop: detect -> choose an independent set -> flip, over a worklist.

namespace delaunayflip
{

/// An iteration as counted.
struct IterationCounts
{
  std::int64_t Tested = 0; ///< Edges judged before it chose.
  std::int64_t Bad = 0; ///< Edges known to be bad and free to flip when it chose.
  std::int64_t Blocked = 0; ///< Bad ones that were not free.
  std::int64_t Flipped = 0;
  double SquaredCotangent = -INFINITY; ///< After it, of the smallest angle, where asked for.

  IterationCounts& operator+=(const IterationCounts& other)
  {
    this->Tested += other.Tested;
    this->Bad += other.Bad;
    this->Blocked += other.Blocked;
    this->Flipped += other.Flipped;
    this->SquaredCotangent = std::max(this->SquaredCotangent, other.SquaredCotangent);
    return *this;
  }
};

/// How far to go.
struct AdvancePlan
{
  std::int64_t Iterations; ///< At most so many, >= 1.
  bool MeasureFirst; ///< Compute SquaredCotangent after the first of them.
  bool MeasureAll; ///< And after every one.
};

/// The loop for any geometry. Between calls the mesh is valid.
///
/// The schedule is part of the algorithm, the same for every backend. Where no guard is needed and
/// the mesh has more than 2^16 triangles, the first iterations run in chunks of it alone (2^14 to
/// 2^16 triangles in the engine's order, which fit a cache): edges between two chunks sit out. Each
/// chunk then has all its iterations at once, in cache, while the statistics are those of rounds
/// over the whole mesh. After that, iterations span the mesh.
class FlipLoop
{
public:
  virtual ~FlipLoop() = default;

  /// Judges what is new and counts what is bad: the state before an iteration, or the end state.
  virtual StepCounts Detect() = 0;

  /// What the last Detect found.
  const StepCounts& GetFound() const { return this->Found; }

  /// Iterates after a Detect that found bad edges: once, or several times where chunks work for
  /// themselves, and detects again. @returns the iterations.
  virtual std::vector<IterationCounts> Advance(const AdvancePlan& plan) = 0;

  /// LargestSquaredCotangent (SurfaceAngles.h) over all triangles.
  virtual double FindLargestSquaredCotangent() const = 0;

protected:
  /// Smaller meshes have no chunks.
  static constexpr std::int64_t SmallestChunkedMesh = std::int64_t(1) << 16; // triangles

  /// Chunks of 2^16 triangles, with their edges and points, fill 3 MB. Meshes that would have few
  /// of them have smaller ones, so that many threads get one each: 16 threads flip a random bad
  /// mesh of 100,000 points in 11 ms instead of 25, a GPU in the same time
  /// (Documentation/performance.md).
  static int FindChunkBits(std::int64_t triangles)
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

  /// Rounds within chunks before iterations span the mesh.
  static constexpr std::int64_t ChunkRounds = 12;

  StepCounts Found;
};

/// The loop of a backend by a rule: LoopOf<Backend, Rule>::Type.
template <typename Backend, typename Rule>
struct LoopOf;

}

#endif
