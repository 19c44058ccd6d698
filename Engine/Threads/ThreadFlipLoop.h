// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADFLIPLOOP_H
#define DELAUNAYFLIP_THREADFLIPLOOP_H

#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeWorklist.h"
#include "FlipLoop.h"
#include "SmallestAngle.h"
#include "ThreadBackend.h"
#include "ThreadPasses.h"

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
  ThreadFlipLoop(EdgeMesh& mesh, const Rule& rule, CoordinateRange range, EdgeGuard guard,
    const ThreadBackend& backend)
    : FlipLoop(mesh.NumberOfTriangles, guard.IsActive()),
      Mesh(mesh),
      Decision(rule),
      Range(range),
      Guard(std::move(guard)),
      Backend(backend),
      Worklist(mesh.States.Data(), 0, mesh.NumberOfEdges, Rule::MayBlock || this->Guard.IsActive())
  {
    this->CutIntoChunks();
  }

  std::int64_t CountBlockedByDeviation() const override
  {
    return CountDeviating(this->Mesh, this->Decision, this->Backend);
  }

  /// In most meshes no flip changes the worst triangle, because of a fixed edge. While that is so,
  /// only triangles that flips have changed are measured again.
  AngleSums MeasureAngles() const override
  {
    this->Grades.resize(this->Mesh.NumberOfTriangles);
    GradeSurvey survey{ this->Angles(), this->Grades.data(), true };
    survey.MeasuresAll =
      this->Measured.Angles.Largest == -INFINITY || survey.IsChanged(this->Measured.Worst);
    if (survey.MeasuresAll)
    {
      this->Measured.Angles.Largest = -INFINITY;
    }
    this->Measured +=
      this->Backend.template Sum<GradedTriangles>(this->Mesh.NumberOfTriangles, survey);
    return this->Measured.Angles;
  }

protected:
  /// Passes 1 to 3.
  StepCounts DetectAll() override
  {
    const JudgePass<Rule> judge = this->Judge(); // pass 1
    const ResolvePass<Rule> resolve = this->Resolve(); // pass 1, exactly
    if (!this->Guard.IsActive())
    {
      return this->Worklist.Detect(this->Backend, judge, resolve); // and pass 3: counts
    }
    const GuardPass guard{ { this->Mesh.View() }, this->Guard.View().Edges }; // pass 2
    return this->Worklist.Detect(this->Backend, judge, resolve, guard); // and pass 3: counts
  }

  /// Passes 4 to 6, and the detection for the next iteration.
  std::vector<IterationCounts> IterateMesh(const AdvancePlan& plan) override
  {
    const EdgeMeshView mesh = this->Mesh.View();
    const FlipPass flip{ { mesh }, this->Worklist.GetFlags() };
    StepCounts flips;
    if (!this->Guard.IsActive())
    {
      this->Worklist.Choose(this->Backend, { mesh }); // pass 4
      flips = this->Worklist.Flip(this->Backend, flip); // pass 6
    }
    else
    {
      const EdgeGuardView guard = this->Guard.View();
      const ConfirmAndFlipPass confirmAndFlip{ flip, guard };
      this->Worklist.ChooseAndClaim(this->Backend, { { mesh }, guard.Claims }); // passes 4 and 5
      flips = this->Worklist.Flip(this->Backend, confirmAndFlip); // passes 5 and 6
      this->Guard.Maintain(flips, this->Mesh, this->Backend);
    }
    IterationCounts iteration{ this->Found.Tested, this->Found.Bad, this->Found.GetBlocked(),
      flips.Flipped };
    if (plan.MeasureFirst || plan.MeasureAll)
    {
      iteration.SquaredCotangent = this->MeasureAngles().Largest;
    }
    this->Detect();
    return { iteration };
  }

  void TakeStates() override
  {
    this->Worklist.ActivateAll();
    this->Measured.Angles.Largest = -INFINITY;
  }

  std::vector<IterationCounts> IterateChunks(const AdvancePlan& plan) override
  {
    this->DeferEdgesBetweenChunks();
    std::vector<std::vector<IterationCounts>> parts(this->Chunks.size());
    this->Backend.ForTasks(static_cast<std::int64_t>(parts.size()),
      [&](std::int64_t i) { parts[i] = this->RunChunk(this->Chunks[i], plan); });
    this->RecallEdges();
    std::vector<IterationCounts> total(plan.Iterations);
    for (const std::vector<IterationCounts>& part : parts)
    {
      for (std::int64_t i = 0; i < plan.Iterations; ++i)
      {
        total[i] += part[i];
      }
    }
    return total;
  }

private:
  /// Triangles [FirstTriangle, LastTriangle), and the edges that had their smallest corner in them
  /// at first. While flips happen only within chunks, these include every edge within the chunk.
  struct Chunk
  {
    std::int64_t FirstTriangle, LastTriangle;
    std::int64_t FirstEdge, LastEdge;
    std::int64_t Tested; ///< Edges judged since the last choice.
  };

  struct GradedTriangles
  {
    AngleSums Angles;
    std::int64_t Worst = 0; ///< The triangle with the largest squared cotangent.

    GradedTriangles& operator+=(const GradedTriangles& other)
    {
      if (other.Angles.Largest > this->Angles.Largest)
      {
        this->Worst = other.Worst;
      }
      this->Angles += other.Angles;
      return *this;
    }
  };

  /// Measures triangles again, and counts how the numbers of small angles change.
  struct GradeSurvey : AngleSurvey<Rule>
  {
    unsigned char* Grades; ///< AngleSums::Grade of every triangle, when it was last measured.
    bool MeasuresAll; ///< False: it measures only the changed triangles.

    bool IsChanged(std::int64_t triangle) const
    {
      return this->Triangles[triangle].Flips >= OneFlip;
    }
    void Prefetch(std::int64_t triangle) const
    {
      if (this->MeasuresAll)
      {
        AngleSurvey<Rule>::Prefetch(triangle);
      }
    }
    void operator()(std::int64_t triangle, GradedTriangles& sum) const
    {
      if (this->MeasuresAll || this->IsChanged(triangle))
      {
        const double own = this->Measure(triangle);
        if (own > sum.Angles.Largest)
        {
          sum.Worst = triangle;
        }
        sum.Angles.Count(this->Grades[triangle], -1);
        sum.Angles.Add(own);
        this->Grades[triangle] = AngleSums::Grade(own);
      }
    }
  };

  JudgePass<Rule> Judge() const { return { { this->Mesh.View() }, this->Decision }; }
  ResolvePass<Rule> Resolve() const { return { { this->Mesh.View() }, this->Decision }; }

  void CutIntoChunks()
  {
    const std::int64_t triangles = this->Mesh.NumberOfTriangles;
    const std::int64_t size = std::int64_t(1) << this->ChunkBits;
    const auto firstEdge = [this](std::int64_t t)
    { return FindFirstEdge(this->Mesh.CornerOfHalfEdge.Data(), this->Mesh.NumberOfEdges, t); };
    for (std::int64_t t = 0; this->HasChunks() && t < triangles; t += size)
    {
      const std::int64_t end = std::min(triangles, t + size);
      this->Chunks.push_back({ t, end, firstEdge(t), firstEdge(end), 0 });
    }
  }

  /// Runs all iterations of a chunk, on the calling thread.
  std::vector<IterationCounts> RunChunk(Chunk& chunk, const AdvancePlan& plan) const
  {
    const EdgeMeshView mesh = this->Mesh.View();
    const AngleSurvey<Rule> angles = this->Angles();
    EdgeWorklist worklist(mesh.States, chunk.FirstEdge, chunk.LastEdge, Rule::MayBlock);
    const ChooseAndFlipPass flip{ { { mesh }, worklist.GetFlags() } };
    StepCounts found = worklist.Detect();
    std::vector<IterationCounts> counts(plan.Iterations);
    for (std::int64_t i = 0; i < plan.Iterations; ++i)
    {
      const StepCounts flips = worklist.ChooseAndFlip(flip);
      counts[i] = { chunk.Tested, found.Bad, found.GetBlocked(), flips.Flipped, -INFINITY };
      if (plan.MeasureAll || (plan.MeasureFirst && i == 0))
      {
        for (std::int64_t t = chunk.FirstTriangle; t < chunk.LastTriangle; ++t)
        {
          counts[i].SquaredCotangent = std::max(counts[i].SquaredCotangent, angles.Measure(t));
        }
      }
      found = worklist.Detect(this->Judge(), this->Resolve());
      chunk.Tested = found.Tested;
    }
    return counts;
  }

  void DeferEdgesBetweenChunks()
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Backend.ForEach(this->Mesh.NumberOfEdges,
      [&](std::int64_t e)
      {
        const TriangleId a = TriangleOf(mesh.CornerOfHalfEdge[2 * e]);
        const TriangleId b = TriangleOf(mesh.CornerOfHalfEdge[2 * e + 1]);
        if (mesh.States[e] != EdgeState::Fixed && (a ^ b) >> this->ChunkBits != 0)
        {
          mesh.States[e] = EdgeState::Deferred;
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
    return { this->Mesh.Triangles.Data(), this->Decision, this->Range };
  }

  EdgeMesh& Mesh;
  Rule Decision;
  CoordinateRange Range;
  EdgeGuard Guard;
  const ThreadBackend& Backend;
  EdgeWorklist Worklist;
  std::vector<Chunk> Chunks;
  mutable GradedTriangles Measured; ///< When angles were last measured.
  mutable std::vector<unsigned char> Grades; ///< GradeSurvey's.
};

template <typename Rule>
struct LoopOf<ThreadBackend, Rule>
{
  using Type = ThreadFlipLoop<Rule>;
};

}

#endif
