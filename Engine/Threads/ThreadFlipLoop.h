// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADFLIPLOOP_H
#define DELAUNAYFLIP_THREADFLIPLOOP_H

#include "AngleSurvey.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeWorklist.h"
#include "FlipLoop.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

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
      ChunkBits(FindChunkBits(mesh.NumberOfTriangles)),
      Worklist(mesh.States.Data(), 0, mesh.NumberOfEdges, Rule::MayBlock || this->Guard.IsActive())
  {
    this->CutIntoChunks();
  }

  StepCounts Detect() override
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Found = this->Guard.IsActive()
      ? this->Worklist.Detect(this->Backend, this->Judge(), this->Resolve(),
          GuardStep{ { mesh }, this->Guard.View().Edges })
      : this->Worklist.Detect(this->Backend, this->Judge(), this->Resolve());
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
    return this->Backend.template Sum<LargestValue>(this->Mesh.NumberOfTriangles, this->Angles())
      .Value;
  }

private:
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
    if (this->Guard.IsActive() || triangles <= SmallestChunkedMesh)
    {
      return;
    }
    const std::int64_t size = std::int64_t(1) << this->ChunkBits;
    const CornerId* words = this->Mesh.CornerOfHalfEdge.Data();
    std::int64_t edge = 0;
    for (std::int64_t t = 0; t < triangles; t += size)
    {
      Chunk chunk{ t, std::min(triangles, t + size), edge, 0, 0 };
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
    this->Worklist.Filter(this->Backend, ChooseStep{ mesh });
    const EdgeGuardView guard = this->Guard.View();
    if (guard.Active)
    {
      this->Worklist.Run(this->Backend, ClaimStep{ { mesh }, guard.Claims });
      this->Worklist.Filter(this->Backend, ConfirmStep{ { mesh }, guard.Claims });
    }
    const StepCounts flips =
      this->Worklist.Run(this->Backend, FlipStep{ { { mesh }, guard }, this->Worklist.GetFlags() });
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
    EdgeWorklist worklist(mesh.States, chunk.FirstEdge, chunk.LastEdge, Rule::MayBlock);
    const ChooseAndFlipStep flip{ { { { mesh }, EdgeGuardView{} }, worklist.GetFlags() } };
    StepCounts found = worklist.Detect();
    std::vector<IterationCounts> counts(rounds);
    for (std::int64_t round = 0; round < rounds; ++round)
    {
      const StepCounts flips = worklist.ChooseAndFlip(flip);
      counts[round] = { chunk.Tested, found.Bad, found.Blocked, flips.Flipped, -INFINITY };
      if (plan.MeasureAll || (plan.MeasureFirst && round == 0))
      {
        counts[round].SquaredCotangent =
          this->FindLargestSquaredCotangent(chunk.FirstTriangle, chunk.LastTriangle);
      }
      found = worklist.Detect(this->Judge(), this->Resolve());
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
          if (mesh.States[e] != EdgeState::Fixed && (a ^ b) >> this->ChunkBits != 0)
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

  AngleSurvey<Rule> Angles() const
  {
    return { this->Mesh.Triangles.Data(), this->Decision, this->Scale };
  }

  double FindLargestSquaredCotangent(std::int64_t firstTriangle, std::int64_t lastTriangle) const
  {
    const AngleSurvey<Rule> survey = this->Angles();
    LargestValue largest;
    for (std::int64_t t = firstTriangle; t < lastTriangle; ++t)
    {
      survey(t, largest);
    }
    return largest.Value;
  }

  EdgeMesh& Mesh;
  Rule Decision;
  double Scale;
  EdgeGuard Guard;
  const ThreadBackend& Backend;
  int ChunkBits; ///< 2^ChunkBits triangles a chunk.
  EdgeWorklist Worklist;
  std::vector<Chunk> Chunks;
  std::int64_t RoundsLeft = 0; ///< Of those within chunks.
};

template <typename Rule>
struct LoopOf<ThreadBackend, Rule>
{
  using Type = ThreadFlipLoop<Rule>;
};

}

#endif
