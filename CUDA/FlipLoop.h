// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOP_H
#define DELAUNAYFLIP_FLIPLOOP_H

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeWorklist.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
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
/// the mesh is larger than a chunk (2^16 triangles in the engine's order, which fit a cache), the
/// first iterations run in the chunks alone: edges between two chunks sit out. Each chunk then has
/// all its iterations at once, in cache, while the statistics are those of rounds over the whole
/// mesh. After that, iterations span the mesh.
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
  StepCounts Found;
};

/// The loop on threads, by one of the rules of FlipRules.h.
template <typename Rule>
class ThreadFlipLoop : public FlipLoop
{
public:
  /// @param scale power of two that brings the rule's coordinates near 1, for angles.
  ThreadFlipLoop(
    EdgeMesh& mesh, const Rule& rule, double scale, EdgeGuard guard, const ThreadBackend& backend)
    : Mesh(mesh),
      Decision(rule),
      Scale(scale),
      Guard(std::move(guard)),
      Backend(backend),
      Worklist(mesh.States.Data(), 0, mesh.NumberOfEdges)
  {
    this->CutIntoChunks();
  }

  StepCounts Detect() override
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Worklist.Gather();
    this->Found = this->Guard.IsActive()
      ? this->Worklist.Run(this->Backend, this->Judge(), this->Resolve(),
          GuardStep{ { mesh }, this->Guard.View() }, CountStep{ mesh.States })
      : this->Worklist.Run(this->Backend, this->Judge(), this->Resolve(), CountStep{ mesh.States });
    return this->Found;
  }

  std::vector<IterationCounts> Advance(const AdvancePlan& plan) override
  {
    std::vector<IterationCounts> iterations;
    if (this->RoundsLeft > 0)
    {
      iterations = this->RunChunks(plan);
      this->Detect();
    }
    if (iterations.empty())
    {
      iterations.push_back(this->Iterate(plan.MeasureFirst || plan.MeasureAll));
      this->Detect();
    }
    return iterations;
  }

  double FindLargestSquaredCotangent() const override
  {
    return this->Backend
      .template Sum<IterationCounts>(this->Mesh.NumberOfTriangles,
        [this](std::int64_t begin, std::int64_t end)
        {
          IterationCounts part;
          part.SquaredCotangent = this->FindLargestSquaredCotangent(begin, end);
          return part;
        })
      .SquaredCotangent;
  }

private:
  /// Triangles of a chunk, with their edges and points, fill 3 MB.
  static constexpr int ChunkBits = 16;
  /// Rounds within chunks before iterations span the mesh.
  static constexpr std::int64_t ChunkRounds = 12;

  /// Triangles [FirstTriangle, LastTriangle) and the edges whose smallest corner they held at
  /// first. As long as only chunks have flipped, every edge within the chunk is among these.
  struct Chunk
  {
    std::int64_t FirstTriangle, LastTriangle;
    std::int64_t FirstEdge, LastEdge;
    std::int64_t Tested; ///< Edges judged since the last choice.
  };

  JudgeStep<Rule> Judge() const { return { { this->Mesh.View() }, this->Decision }; }
  ResolveStep<Rule> Resolve() const { return { { this->Mesh.View() }, this->Decision }; }

  /// A mesh of one chunk has none.
  void CutIntoChunks()
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    constexpr std::int64_t Size = std::int64_t(1) << ChunkBits;
    if (this->Guard.IsActive() || triangles <= Size)
    {
      return;
    }
    const CornerId* words = this->Mesh.CornerOfHalfEdge.Data();
    std::int64_t edge = 0;
    for (std::int64_t t = 0; t < triangles; t += Size)
    {
      Chunk chunk{ t, std::min(triangles, t + Size), edge, 0, 0 };
      while (edge < this->Mesh.NumberOfEdges && TriangleOf(words[2 * edge]) < chunk.LastTriangle)
      {
        ++edge;
      }
      chunk.LastEdge = edge;
      this->Chunks.push_back(chunk);
    }
    this->RoundsLeft = ChunkRounds;
  }

  IterationCounts Iterate(bool measure)
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Worklist.Gather();
    this->Worklist.Run(this->Backend, ChooseStep{ mesh });
    if (this->Guard.IsActive())
    {
      const EdgeTableView claims = this->Guard.MakeClaims(this->Found.Bad, this->Backend);
      this->Worklist.Run(this->Backend, ClaimStep{ { mesh }, claims });
      this->Worklist.Run(this->Backend, ConfirmStep{ { mesh }, claims });
    }
    const StepCounts flips = this->Worklist.Run(this->Backend,
      FlipStep{ { mesh }, this->Worklist.GetFlags(), this->Guard.IsActive(), this->Guard.View() });
    if (this->Guard.IsActive())
    {
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
    }
    return { this->Found.Tested, this->Found.Bad, this->Found.Blocked, flips.Flipped,
      measure ? this->FindLargestSquaredCotangent() : -INFINITY };
  }

  /// The rounds that chunks run for themselves, at most as many as the plan and the schedule allow.
  /// None when no chunk has anything to flip.
  std::vector<IterationCounts> RunChunks(const AdvancePlan& plan)
  {
    const std::int64_t rounds = std::min(this->RoundsLeft, plan.Iterations);
    const bool isFirst = this->RoundsLeft == ChunkRounds;
    this->DeferEdgesBetweenChunks();
    std::vector<std::vector<IterationCounts>> parts(this->Chunks.size());
    this->Backend.ForChunks(static_cast<std::int64_t>(parts.size()),
      [&](std::int64_t i) { parts[i] = this->RunChunk(this->Chunks[i], rounds, plan); });
    this->RecallEdges();
    std::vector<IterationCounts> total = SumRounds(parts, rounds);
    if (isFirst && !total.empty())
    {
      // The first round knows all edges; those between chunks are excluded from it.
      total[0].Tested = this->Found.Tested;
      total[0].Bad = this->Found.Bad;
      total[0].Blocked = this->Found.Blocked;
    }
    this->RoundsLeft -= rounds;
    if (static_cast<std::int64_t>(total.size()) < rounds)
    {
      this->RoundsLeft = 0;
    }
    return total;
  }

  /// Sums over chunks, without the rounds at the end in which none flipped.
  static std::vector<IterationCounts> SumRounds(
    const std::vector<std::vector<IterationCounts>>& parts, std::int64_t rounds)
  {
    std::vector<IterationCounts> total(rounds);
    for (const std::vector<IterationCounts>& part : parts)
    {
      for (std::int64_t round = 0; round < rounds; ++round)
      {
        total[round] += part[round];
      }
    }
    while (!total.empty() && total.back().Flipped == 0)
    {
      total.pop_back();
    }
    return total;
  }

  std::vector<IterationCounts> RunChunk(
    Chunk& chunk, std::int64_t rounds, const AdvancePlan& plan) const
  {
    const EdgeMeshView mesh = this->Mesh.View();
    EdgeWorklist worklist(mesh.States, chunk.FirstEdge, chunk.LastEdge);
    const FlipStep flip{ { mesh }, worklist.GetFlags(), false, EdgeTableView{} };
    worklist.Gather();
    StepCounts found = worklist.Run(CountStep{ mesh.States });
    std::vector<IterationCounts> counts(rounds);
    for (std::int64_t round = 0; round < rounds; ++round)
    {
      worklist.Gather();
      worklist.Run(ChooseStep{ mesh });
      const StepCounts flips = worklist.Run(flip);
      counts[round] = { chunk.Tested, found.Bad, found.Blocked, flips.Flipped, -INFINITY };
      if (plan.MeasureAll || (plan.MeasureFirst && round == 0))
      {
        counts[round].SquaredCotangent =
          this->FindLargestSquaredCotangent(chunk.FirstTriangle, chunk.LastTriangle);
      }
      worklist.Gather();
      found = worklist.Run(this->Judge(), this->Resolve(), CountStep{ mesh.States });
      chunk.Tested = found.Tested;
    }
    return counts;
  }

  void DeferEdgesBetweenChunks()
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Backend.ForRange(this->Mesh.NumberOfEdges,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t e = begin; e < end; ++e)
        {
          const TriangleId a = TriangleOf(mesh.CornerOfHalfEdge[2 * e]);
          const TriangleId b = TriangleOf(mesh.CornerOfHalfEdge[2 * e + 1]);
          if (mesh.States[e] != EdgeState::Fixed && (a ^ b) >> ChunkBits != 0)
          {
            mesh.States[e] = EdgeState::Deferred;
          }
        }
      });
  }

  void RecallEdges()
  {
    EdgeState* states = this->Mesh.States.Data();
    this->Backend.ForRange(this->Mesh.NumberOfEdges,
      [&](std::int64_t begin, std::int64_t end)
      { std::replace(states + begin, states + end, EdgeState::Deferred, EdgeState::Candidate); });
    this->Worklist.ActivateAll();
  }

  double FindLargestSquaredCotangent(std::int64_t firstTriangle, std::int64_t lastTriangle) const
  {
    double largest = -INFINITY;
    for (std::int64_t t = firstTriangle; t < lastTriangle; ++t)
    {
      const VertexId* v = this->Mesh.Triangles[t].Vertices;
      largest = std::max(largest,
        LargestSquaredCotangent(
          this->GetPosition(v[0]), this->GetPosition(v[1]), this->GetPosition(v[2])));
    }
    return largest;
  }

  Vector3 GetPosition(VertexId vertex) const
  {
    const Vector3 position = ToPosition(this->Decision.Get(vertex));
    return { this->Scale * position.X, this->Scale * position.Y, this->Scale * position.Z };
  }
  static Vector3 ToPosition(const Vector3& point) { return point; }
  static Vector3 ToPosition(const PlanePoint& point) { return { point.U, point.V, point.W }; }

  EdgeMesh& Mesh;
  Rule Decision;
  double Scale;
  EdgeGuard Guard;
  const ThreadBackend& Backend;
  EdgeWorklist Worklist;
  std::vector<Chunk> Chunks;
  std::int64_t RoundsLeft = 0; ///< Of those within chunks.
};

}

#endif
