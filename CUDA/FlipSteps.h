// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPSTEPS_H
#define DELAUNAYFLIP_FLIPSTEPS_H

#include "EdgeFlip.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipRules.h"
#include "HostDevice.h"
#include "StateWords.h"
#include "StepCounts.h"

#include <cstdint>

/// @file
/// The steps of an iteration, each for one edge: judge, resolve, guard, count; choose, claim,
/// confirm; flip. A step says which states it wants and handles an edge of such a state. All edges
/// may run at once within a step; what a step writes that others may read at the same time is said
/// with it. Prefetch(edge) asks for what operator() will read, one level of indirection ahead.

namespace delaunayflip
{

/// One flag a block of 2^BlockBits edges, for the edges [First, Last).
struct BlockFlags
{
  std::uint8_t* Flags;
  std::int64_t First;
  std::int64_t Last;
  int BlockBits;

  /// Flags the block of an edge of the range.
  void Set(EdgeId edge) const
  {
    if (edge < this->First || edge >= this->Last)
    {
      return;
    }
    std::uint8_t* flag = &this->Flags[(edge >> this->BlockBits) - (this->First >> this->BlockBits)];
    if (AtomicLoad(flag) == 0)
    {
      AtomicStore(flag, std::uint8_t(1));
    }
  }
};

/// Which of two bad edges flips first: a bijection of edge ids, so no two are equal (equal ones
/// would both flip, on a shared triangle), and scattered, so that chains are not served one by one.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t Priority(EdgeId edge) { return Scatter(edge); }

DELAUNAYFLIP_HOST_DEVICE inline void PrefetchTriangles(const EdgeMeshView& mesh, EdgeId edge)
{
  Prefetch(&mesh.Triangles[TriangleOf(mesh.CornerOfHalfEdge[2 * edge])]);
  Prefetch(&mesh.Triangles[TriangleOf(mesh.CornerOfHalfEdge[2 * edge + 1])]);
}

/// What steps on quads share.
struct QuadStep
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE Quad Load(EdgeId edge) const
  {
    return this->Mesh.GetQuad(edge);
  }
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(const Quad&) const {}
};

/// Judges candidates by plain arithmetic. Writes the edge's own state, which no one else reads.
template <typename Rule>
struct JudgeStep : QuadStep
{
  Rule Decision;

  static constexpr StateRange Wanted{ EdgeState::Candidate, EdgeState::Candidate };
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(const Quad& quad) const
  {
    delaunayflip::Prefetch(this->Decision.Address(quad.A));
    delaunayflip::Prefetch(this->Decision.Address(quad.P));
    delaunayflip::Prefetch(this->Decision.Address(quad.Q));
    delaunayflip::Prefetch(this->Decision.Address(quad.B));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    const EdgeState state = this->Decision.Judge(quad);
    AtomicStore(&this->Mesh.States[edge], state);
    ++counts.Tested;
    counts.Uncertain += state == EdgeState::Uncertain ? 1 : 0;
  }
};

/// Judges exactly what JudgeStep could not. Writes the edge's own state.
template <typename Rule>
struct ResolveStep : QuadStep
{
  Rule Decision;

  static constexpr StateRange Wanted{ EdgeState::Uncertain, EdgeState::Uncertain };
  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    AtomicStore(&this->Mesh.States[edge], this->Decision.JudgeExactly(quad));
  }
};

/// Blocks bad edges whose flip would make an edge that exists, and frees those whose obstacle has
/// gone. Reads the guard table, which does not change meanwhile; writes the edge's own state.
struct GuardStep : QuadStep
{
  EdgeTableView Edges;

  static constexpr StateRange Wanted{ EdgeState::BlockedByEdge, EdgeState::Bad };
  DELAUNAYFLIP_HOST_DEVICE EdgeState Decide(const Quad& quad) const
  {
    const bool exists = this->Edges.Find(EdgeKey(quad.A, quad.B)) != EdgeTableView::NoSlot;
    return exists ? EdgeState::BlockedByEdge : EdgeState::Bad;
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    AtomicStore(&this->Mesh.States[edge], this->Decide(quad));
  }
};

/// Counts what is bad. Reads and writes nothing but states.
struct CountStep
{
  static constexpr StateRange Wanted{ EdgeState::BlockedByShape, EdgeState::Bad };

  const EdgeState* States;

  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, StepCounts& counts) const
  {
    const bool bad = this->States[edge] == EdgeState::Bad;
    counts.Bad += bad ? 1 : 0;
    counts.Blocked += bad ? 0 : 1;
  }
};

/// Whether an edge comes before those of its quad's outer edges that are bad.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFirst(
  EdgeId edge, const OuterHalfEdges& outer, bool ap, bool qa, bool pb, bool bq)
{
  const std::uint32_t own = Priority(edge);
  return !(ap && Priority(EdgeOf(outer.AP)) < own) && !(qa && Priority(EdgeOf(outer.QA)) < own) &&
    !(pb && Priority(EdgeOf(outer.PB)) < own) && !(bq && Priority(EdgeOf(outer.BQ)) < own);
}

/// Chooses an independent set: a bad edge wins when no bad edge of its two triangles has a smaller
/// priority. Reads the states of neighbours while they turn from Bad to Winner, and takes both for
/// bad.
struct ChooseStep
{
  EdgeMeshView Mesh;

  static constexpr StateRange Wanted{ EdgeState::Bad, EdgeState::Bad };
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(EdgeId edge) const
  {
    return GetOuterHalfEdges(
      this->Mesh, this->Mesh.CornerOfHalfEdge[2 * edge], this->Mesh.CornerOfHalfEdge[2 * edge + 1]);
  }
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(const OuterHalfEdges& outer) const
  {
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.AP)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.QA)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.PB)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.BQ)]);
  }
  void operator()(EdgeId edge, const OuterHalfEdges& outer, StepCounts&) const
  {
    // All four states are asked for before any is looked at.
    const bool ap = this->IsBad(outer.AP), qa = this->IsBad(outer.QA);
    const bool pb = this->IsBad(outer.PB), bq = this->IsBad(outer.BQ);
    if (IsFirst(edge, outer, ap, qa, pb, bq))
    {
      AtomicStore(&this->Mesh.States[edge], EdgeState::Winner);
    }
  }

private:
  bool IsBad(HalfEdgeId halfEdge) const
  {
    const EdgeState state = AtomicLoad(&this->Mesh.States[EdgeOf(halfEdge)]);
    return state == EdgeState::Bad || state == EdgeState::Winner;
  }
};

/// Winners claim the edge that they would make (EdgeClaims.h).
struct ClaimStep : QuadStep
{
  EdgeClaims Claims;

  static constexpr StateRange Wanted{ EdgeState::Winner, EdgeState::Winner };
  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    this->Claims.Claim(quad.A, quad.B, Priority(edge));
  }
};

/// Winners that do not hold their claim step back. Writes the edge's own state, which no one else
/// reads.
struct ConfirmStep : QuadStep
{
  EdgeClaims Claims;

  static constexpr StateRange Wanted{ EdgeState::Winner, EdgeState::Winner };
  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    if (!this->Claims.Holds(quad.A, quad.B, Priority(edge)))
    {
      AtomicStore(&this->Mesh.States[edge], EdgeState::Bad);
    }
  }
};

/// Flips winners, which share no triangle. With a guard, gives the claim back and exchanges the old
/// vertex pair for the new one. States are the caller's business.
struct SurgeryStep : QuadStep
{
  EdgeGuardView Guard;

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Flip(
    EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    const OuterHalfEdges outer = FlipEdge(this->Mesh, edge, quad);
    ++counts.Flipped;
    if (this->Guard.Active)
    {
      bool fresh = false;
      this->Guard.Claims.Release(quad.A, quad.B, Priority(edge));
      this->Guard.Edges.Remove(EdgeKey(quad.P, quad.Q));
      counts.LostInserts += this->Guard.Edges.InsertNew(EdgeKey(quad.A, quad.B), fresh) ? 0 : 1;
      counts.FreshSlots += fresh ? 1 : 0;
    }
    return outer;
  }
};

/// Flips the winners and makes candidates of their outer edges. Two flips may mark the same outer
/// edge, both with the same value.
struct FlipStep : SurgeryStep
{
  BlockFlags Active;

  static constexpr StateRange Wanted{ EdgeState::Winner, EdgeState::Winner };
  void Prefetch(const Quad& quad) const
  {
    const OuterHalfEdges outer = GetOuterHalfEdges(this->Mesh, quad.CornerA, quad.CornerB);
    delaunayflip::Prefetch(&this->Mesh.CornerOfHalfEdge[outer.QA]);
    delaunayflip::Prefetch(&this->Mesh.CornerOfHalfEdge[outer.PB]);
  }
  void operator()(EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    const OuterHalfEdges outer = this->Flip(edge, quad, counts);
    AtomicStore(&this->Mesh.States[edge], EdgeState::Good);
    this->Mark(EdgeOf(outer.AP));
    this->Mark(EdgeOf(outer.QA));
    this->Mark(EdgeOf(outer.PB));
    this->Mark(EdgeOf(outer.BQ));
  }

private:
  void Mark(EdgeId edge) const
  {
    EdgeState* state = &this->Mesh.States[edge];
    const EdgeState seen = AtomicLoad(state);
    if (seen != EdgeState::Fixed && seen != EdgeState::Candidate && seen != EdgeState::Deferred)
    {
      AtomicStore(state, EdgeState::Candidate);
      this->Active.Set(edge);
    }
  }
};

}

#endif
