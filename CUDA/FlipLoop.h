// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPLOOP_H
#define DELAUNAYFLIP_FLIPLOOP_H

#include "ActiveEdges.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipSteps.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <utility>

/// @file
/// The loop: detect -> choose an independent set -> flip, over a worklist.

namespace delaunayflip
{

/// The loop for any geometry. Between calls the mesh is valid.
class FlipLoop
{
public:
  virtual ~FlipLoop() = default;

  /// Judges what is new and counts what is bad: the state before an iteration, or the end state.
  virtual StepCounts Detect() = 0;

  /// Flips an independent set of the bad edges that Detect found. @returns their number.
  virtual std::int64_t Flip() = 0;

  /// Cotangent of the mesh's smallest angle (SurfaceAngles.h's LargestCotangent over all
  /// triangles).
  virtual double FindLargestCotangent() const = 0;
};

/// The edges that exist, where flips could make one twice; empty where they provably cannot.
class EdgeGuard
{
public:
  EdgeGuard() = default;

  /// Takes over a table that holds the vertex pairs of all `edges` edges.
  EdgeGuard(EdgeTable table, std::int64_t edges, std::int64_t vertices)
    : Table(std::move(table)),
      UsedSlots(edges),
      NumberOfVertices(vertices)
  {
  }

  bool IsActive() const { return !this->Table.IsEmpty(); }
  EdgeTableView View() { return this->Table.View(); }

  /// An empty table for the claims of an iteration with `bad` bad edges; kept between iterations.
  EdgeTableView MakeClaims(std::int64_t bad, const ThreadBackend& backend);

  /// Accounts for the flips of an iteration: when too many slots were used or a new edge found
  /// none, the table is made anew from the mesh.
  void Maintain(const StepCounts& flips, EdgeMesh& mesh, const ThreadBackend& backend);

private:
  void Rebuild(EdgeMesh& mesh, const ThreadBackend& backend);

  EdgeTable Table;
  EdgeTable Claims;
  std::int64_t UsedSlots = 0;
  std::int64_t NumberOfVertices = 0;
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
      Active(mesh.States.Data(), mesh.NumberOfEdges, backend)
  {
  }

  StepCounts Detect() override
  {
    const EdgeMeshView mesh = this->Mesh.View();
    const JudgeStep<Rule> judge{ mesh, this->Decision };
    const ResolveStep<Rule> resolve{ mesh, this->Decision };
    const CountStep count{ mesh };
    this->Active.Gather();
    const StepCounts counts = this->Guard.IsActive()
      ? this->Active.Run(judge, resolve, GuardStep{ mesh, this->Guard.View() }, count)
      : this->Active.Run(judge, resolve, count);
    this->Active.KeepBadBlocks();
    this->BadEdges = counts.Bad;
    return counts;
  }

  std::int64_t Flip() override
  {
    const EdgeMeshView mesh = this->Mesh.View();
    this->Active.Run(ChooseStep{ mesh });
    if (this->Guard.IsActive())
    {
      const EdgeTableView claims = this->Guard.MakeClaims(this->BadEdges, this->Backend);
      this->Active.Run(ClaimStep{ mesh, claims });
      this->Active.Run(ConfirmStep{ mesh, claims });
    }
    const StepCounts counts = this->Active.Run(FlipStep{ mesh, this->Active.GetFlags(),
      ActiveEdges::BlockBits, this->Guard.IsActive(), this->Guard.View() });
    if (this->Guard.IsActive())
    {
      this->Guard.Maintain(counts, this->Mesh, this->Backend);
    }
    return counts.Flipped;
  }

  double FindLargestCotangent() const override
  {
    return this->Backend
      .template Sum<LargestValue>(this->Mesh.NumberOfTriangles,
        [this](std::int64_t begin, std::int64_t end)
        {
          LargestValue largest;
          for (std::int64_t t = begin; t < end; ++t)
          {
            const VertexId* v = this->Mesh.Triangles[t].Vertices;
            largest += { LargestCotangent(
              this->GetPosition(v[0]), this->GetPosition(v[1]), this->GetPosition(v[2])) };
          }
          return largest;
        })
      .Value;
  }

private:
  struct LargestValue
  {
    double Value = -INFINITY;

    LargestValue& operator+=(const LargestValue& other)
    {
      this->Value = std::max(this->Value, other.Value);
      return *this;
    }
  };

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
  ActiveEdges Active;
  std::int64_t BadEdges = 0;
};

}

#endif
