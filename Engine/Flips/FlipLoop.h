// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOP_H
#define DELAUNAYFLIP_FLIPLOOP_H

#include "StepCounts.h"
#include "SurfaceAngles.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

/// @file
/// The loop and its schedule, for every geometry and backend.

namespace delaunayflip
{

/// The counts of an iteration.
struct IterationCounts
{
  std::int64_t Tested = 0; ///< Edges judged before it chose.
  std::int64_t Bad = 0; ///< Edges known to be bad and free to flip when it chose.
  std::int64_t Blocked = 0; ///< Bad edges that were not free.
  std::int64_t Flipped = 0;
  double SquaredCotangent = -INFINITY; ///< The smallest angle's after it, on request.

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

/// How many iterations to run, and what to measure.
struct AdvancePlan
{
  std::int64_t Iterations; ///< The most iterations, at least 1.
  bool MeasureFirst; ///< Compute SquaredCotangent after the first of them.
  bool MeasureAll; ///< Compute it after every iteration.
};

/// When FlipLoop::Converge gives up, and whom it tells how near to that it is.
struct ConvergeLimit
{
  /// The most flips. An iteration counts as some hundred flips.
  std::int64_t Flips = std::numeric_limits<std::int64_t>::max();
  /// Told the share of Flips that has been made, unless there are few in all. It may throw; then
  /// the mesh is valid.
  std::function<void(double)> Tell;
};

/// The loop, on top of what a backend provides. Between calls the mesh is valid.
///
/// An iteration has these passes. Each runs for all its edges at once and ends before the next
/// begins; the same numbers stand in EdgePasses.h and where the backends run the passes.
///
/// 1. Judge the candidates by floating-point arithmetic, and resolve exactly those that it cannot
///    decide.
/// 2. Guard, where flips could make an edge that exists: block the bad edges that would, and free
///    those that no longer would.
/// 3. Count the bad and the blocked edges. None bad: the loop has converged.
/// 4. Choose an independent set of the bad edges by their priorities.
/// 5. Claim and confirm, only with a guard: one of two winners that would make the same edge waits.
/// 6. Flip the winners. Their outer edges are the candidates of the next iteration.
///
/// Passes 1 to 3 are a detection. The loop keeps what the last one found, so an iteration begins
/// with pass 4 and ends with the detection for the next.
///
/// The schedule is part of the algorithm and the same for every backend. If no guard is needed and
/// the mesh has more than 2^16 triangles, the first 12 iterations run within chunks of 2^14 to 2^16
/// triangles in the engine's order, which fit into a cache; edges between two chunks are deferred.
/// Each chunk runs all of these iterations at once, in the cache, and the counts are summed over
/// the chunks, iteration by iteration. After that, iterations span the mesh.
class FlipLoop
{
public:
  virtual ~FlipLoop() = default;

  /// The first detection.
  const StepCounts& Detect();

  /// Takes over what has changed in the mesh outside the loop. Edges that must be judged again have
  /// the state Candidate. Detect must follow.
  void Restart();

  /// Likewise, after points have moved. A loop that does not write states makes the candidates
  /// good.
  /// @param hasOtherEdges whether edges were added or dropped.
  /// @returns false if the mesh needs a new loop.
  bool RestartMoved(bool hasOtherEdges);

  /// Makes no more iterations within chunks. For a new loop of a mesh that has grown.
  void LeaveChunks() { this->ChunkIterationsLeft = 0; }

  /// Writes the states of all edges, as the last detection has found them, where the loop does not
  /// write them anyway: on a device. Needs a loop without chunks.
  virtual void PutStates() {}

  /// The counts of the last detection.
  const StepCounts& GetFound() const { return this->Found; }

  /// How many of the next iterations are within chunks: together they are the fastest.
  std::int64_t CountChunkIterations() const { return this->ChunkIterationsLeft; }

  /// Runs one or more iterations, at most as many as planned, after a detection that found bad
  /// edges, and detects again. @returns the iterations.
  std::vector<IterationCounts> Advance(const AdvancePlan& plan);

  static constexpr std::int64_t GaveUp = -1;

  /// Detects, and runs iterations until no edge is bad. @returns the flips, or GaveUp.
  std::int64_t Converge(const ConvergeLimit& limit = {});

  /// How many of the edges that the last detection has found blocked by shape have
  /// EdgeState::BlockedByDeviation.
  virtual std::int64_t CountBlockedByDeviation() const = 0;

  /// Measures the smallest angles of all triangles.
  virtual AngleSums MeasureAngles() const = 0;

protected:
  /// @param hasGuard whether flips need a guard; then there are no chunks.
  FlipLoop(std::int64_t triangles, bool hasGuard);

  bool HasChunks() const { return this->NumberOfChunks > 0; }

  /// Passes 1 to 3 for the whole mesh. @returns what they found.
  virtual StepCounts DetectAll() = 0;

  /// Detects, and may also make iterations like IterateMesh, where this takes less time than two
  /// calls. Sets Found.
  /// @param iterations the most iterations. @returns them.
  virtual std::vector<IterationCounts> DetectAndIterate(std::int64_t iterations);

  virtual void TakeStates() = 0;
  virtual bool TakeMoved(bool hasOtherEdges);

  /// Passes 4 to 6 and a detection, on the whole mesh, once or more. Sets Found.
  virtual std::vector<IterationCounts> IterateMesh(const AdvancePlan& plan) = 0;

  /// Runs exactly plan.Iterations iterations within chunks. The edges between chunks are deferred
  /// meanwhile, and are candidates afterwards. Makes no detection at the end.
  virtual std::vector<IterationCounts> IterateChunks(const AdvancePlan& plan) = 0;

  int ChunkBits; ///< 2^ChunkBits triangles per chunk.
  std::int64_t NumberOfChunks = 0; ///< 0: no iterations within chunks.
  StepCounts Found;

private:
  std::int64_t ChunkIterationsLeft = 0;
};

/// The type of a backend's loop for a rule: LoopOf<Backend, Rule>::Type.
template <typename Backend, typename Rule>
struct LoopOf;

}

#endif
