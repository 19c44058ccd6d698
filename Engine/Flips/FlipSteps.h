// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPSTEPS_H
#define DELAUNAYFLIP_FLIPSTEPS_H

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "FlipRules.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <cstdint>

/// @file
/// The steps of an iteration, each for one edge: judge, resolve, guard; choose, claim, confirm;
/// flip. Those of the first group say which states they want, the others take what is bad and, of
/// these, who wins. All edges may run at once within a step; what a step writes that others may
/// read at the same time is said with it. Load(edge) reads what a step begins with, and Prefetch
/// asks for what operator() will read, one level of indirection ahead.

namespace delaunayflip
{

/// A flag per segment of 1024 edges, for some segments.
struct SegmentFlags
{
  static constexpr int SegmentBits = 10;

  std::uint8_t* Flags;
  std::int64_t FirstSegment;

  /// Flags the segment of an edge.
  void Set(EdgeId edge) const
  {
    std::uint8_t* flag = &this->Flags[(edge >> SegmentBits) - this->FirstSegment];
    if (AtomicLoad(flag) == 0)
    {
      AtomicStore(flag, std::uint8_t(1));
    }
  }
};

/// Which of two bad edges flips first: a bijection of edge ids, so no two are equal (equal ones
/// would both flip, on a shared triangle), and scattered, so that chains are not served one by one.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t Priority(EdgeId edge) { return Scatter(edge); }

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

  static constexpr StateRange Wanted{ EdgeState::Excluded, EdgeState::Candidate };
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

/// Whether an edge comes before those of its quad's outer edges that are bad.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFirst(
  EdgeId edge, const OuterHalfEdges& outer, bool ap, bool qa, bool pb, bool bq)
{
  const std::uint32_t own = Priority(edge);
  // All four are compared, because branches would be mispredicted half of the time.
  const int earlier = (int(ap) & int(Priority(EdgeOf(outer.AP)) < own)) |
    (int(qa) & int(Priority(EdgeOf(outer.QA)) < own)) |
    (int(pb) & int(Priority(EdgeOf(outer.PB)) < own)) |
    (int(bq) & int(Priority(EdgeOf(outer.BQ)) < own));
  return earlier == 0;
}

/// Chooses an independent set: a bad edge wins when no bad edge of its two triangles has a smaller
/// priority. Reads the states of neighbours, which do not change meanwhile.
struct ChooseStep
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(EdgeId edge) const
  {
    return this->Load(this->Mesh.GetCorners(edge));
  }
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(
    const CornerPair& corners) const
  {
    return GetOuterHalfEdges(this->Mesh, corners.A, corners.B);
  }
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(const OuterHalfEdges& outer) const
  {
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.AP)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.QA)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.PB)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.BQ)]);
  }
  /// @returns whether the edge wins.
  bool operator()(EdgeId edge, const OuterHalfEdges& outer) const
  {
    // All four states are asked for before any is looked at.
    const bool ap = this->IsBad(outer.AP), qa = this->IsBad(outer.QA);
    const bool pb = this->IsBad(outer.PB), bq = this->IsBad(outer.BQ);
    // Most have no bad neighbour, which is worth a branch.
    const bool alone = (int(ap) | int(qa) | int(pb) | int(bq)) == 0;
    return alone || IsFirst(edge, outer, ap, qa, pb, bq);
  }

private:
  bool IsBad(HalfEdgeId halfEdge) const
  {
    return WasBad(AtomicLoad(&this->Mesh.States[EdgeOf(halfEdge)]));
  }
};

/// Winners claim the edge that they would make (EdgeClaims.h).
struct ClaimStep : QuadStep
{
  EdgeClaims Claims;

  DELAUNAYFLIP_HOST_DEVICE void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    this->Claims.Claim(quad.A, quad.B, Priority(edge));
  }
};

/// Winners that do not hold their claim step back, and stay bad.
struct ConfirmStep : QuadStep
{
  EdgeClaims Claims;

  /// @returns whether the edge still wins.
  DELAUNAYFLIP_HOST_DEVICE bool operator()(EdgeId edge, const Quad& quad) const
  {
    return this->Claims.Holds(quad.A, quad.B, Priority(edge));
  }
};

/// Flips winners, which share no triangle. With a guard, gives the claim back and exchanges the old
/// vertex pair for the new one. States are the caller's business.
struct SurgeryStep : QuadStep
{
  EdgeGuardView Guard;

  /// On the CPU; a device stores the records itself.
  DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Flip(
    EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    TriangleRecord* triangles = this->Mesh.Triangles;
    const OuterHalfEdges outer =
      FlipEdge(this->Mesh, edge, quad, triangles[TriangleOf(quad.CornerA)],
        triangles[TriangleOf(quad.CornerB)], [](int, TriangleId, const TriangleRecord&) {});
    ++counts.Flipped;
    this->TellGuard(edge, quad, counts);
    return outer;
  }

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void TellGuard(
    EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    if (this->Guard.Active)
    {
      this->TellActiveGuard(edge, quad, counts);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE void TellActiveGuard(EdgeId edge, Quad quad, StepCounts& counts) const
  {
    bool fresh = false;
    this->Guard.Claims.Release(quad.A, quad.B, Priority(edge));
    this->Guard.Edges.Remove(EdgeKey(quad.P, quad.Q));
    counts.LostInserts += this->Guard.Edges.InsertNew(EdgeKey(quad.A, quad.B), fresh) ? 0 : 1;
    counts.FreshSlots += fresh ? 1 : 0;
  }
};

/// Flips the winners and makes candidates of their outer edges. Two flips may mark the same outer
/// edge, both with the same value; an edge that sits out keeps its state.
struct FlipStep : SurgeryStep
{
  SegmentFlags Active;

  void Prefetch(const Quad& quad) const
  {
    this->PrefetchOuter(GetOuterHalfEdges(this->Mesh, quad.CornerA, quad.CornerB));
  }
  void operator()(EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    this->FlipAndMark(edge, quad, counts, EdgeState::Candidate);
  }

protected:
  void PrefetchOuter(const OuterHalfEdges& outer) const
  {
    delaunayflip::Prefetch(&this->Mesh.CornerOfHalfEdge[outer.QA]);
    delaunayflip::Prefetch(&this->Mesh.CornerOfHalfEdge[outer.PB]);
    ChooseStep{ this->Mesh }.Prefetch(outer);
  }

  /// @param excluded what becomes of outer edges that are bad.
  DELAUNAYFLIP_ALWAYS_INLINE void FlipAndMark(
    EdgeId edge, const Quad& quad, StepCounts& counts, EdgeState excluded) const
  {
    const OuterHalfEdges outer = this->Flip(edge, quad, counts);
    AtomicStore(&this->Mesh.States[edge], EdgeState::Good);
    this->Mark(EdgeOf(outer.AP), excluded);
    this->Mark(EdgeOf(outer.QA), excluded);
    this->Mark(EdgeOf(outer.PB), excluded);
    this->Mark(EdgeOf(outer.BQ), excluded);
  }

private:
  void Mark(EdgeId edge, EdgeState excluded) const
  {
    EdgeState* state = &this->Mesh.States[edge];
    const EdgeState seen = AtomicLoad(state);
    if (seen == EdgeState::Fixed || seen == EdgeState::Deferred)
    {
      return;
    }
    // A store costs less than a branch that nobody can foresee.
    AtomicStore(state, WasBad(seen) ? excluded : EdgeState::Candidate);
    this->Active.Set(edge);
  }
};

/// Chooses and flips in one go, for one thread alone: the same flips as by ChooseStep for all edges
/// and FlipStep after it. A bad edge next to one that has flipped becomes Excluded. It counts as
/// bad for its neighbours' choice, which so goes by the states before the first flip; and nothing
/// that the choice of an edge reads changes before it, unless it is excluded.
struct ChooseAndFlipStep : FlipStep
{
  DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(EdgeId edge) const
  {
    return ChooseStep{ this->Mesh }.Load(edge);
  }
  void Prefetch(const OuterHalfEdges& outer) const { this->PrefetchOuter(outer); }
  /// @returns whether the edge wins.
  bool Choose(EdgeId edge, const OuterHalfEdges& outer) const
  {
    return AtomicLoad(&this->Mesh.States[edge]) == EdgeState::Bad &&
      ChooseStep{ this->Mesh }(edge, outer);
  }
  void operator()(EdgeId edge, StepCounts& counts) const
  {
    this->FlipAndMark(edge, this->Mesh.GetQuad(edge), counts, EdgeState::Excluded);
  }
};

}

#endif
