// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_THREADPASSES_H
#define DELAUNAYFLIP_THREADPASSES_H

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgePasses.h"
#include "FilteredPredicates.h"
#include "FlipRules.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <cstdint>
#include <cstring>

/// @file
/// The passes (FlipLoop.h) that a worklist of threads runs, each for one edge. Those of a detection
/// say which states they want; the others run on the bad edges or on the winners. A pass may run
/// for all edges at once; its comment says what it writes that others may read at the same time.
/// Load(edge) reads what a pass needs first, and Prefetch requests what operator() will read, one
/// level of indirection ahead.

namespace delaunayflip
{

/// A flag per unit of 1024 edges, for some units.
struct UnitFlags
{
  static constexpr int UnitBits = 10;

  std::uint8_t* Flags;
  std::int64_t FirstUnit;

  /// Flags the unit of an edge.
  void Set(EdgeId edge) const
  {
    std::uint8_t* flag = &this->Flags[(edge >> UnitBits) - this->FirstUnit];
    if (AtomicLoad(flag) == 0)
    {
      AtomicStore(flag, std::uint8_t(1));
    }
  }
};

/// The base of passes on quads.
struct QuadPass
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_ALWAYS_INLINE Quad Load(EdgeId edge) const { return this->Mesh.GetQuad(edge); }
  void Prefetch(const Quad&) const {}
};

/// Pass 1: judges candidates by floating-point arithmetic. Writes the edge's own state, which no
/// other edge's pass reads.
template <typename Rule>
struct JudgePass : QuadPass
{
  Rule Decision;

  static constexpr StateRange Wanted{ EdgeState::Excluded, EdgeState::Candidate };
  void Prefetch(const Quad& quad) const
  {
    delaunayflip::Prefetch(this->Decision.Address(quad.A));
    delaunayflip::Prefetch(this->Decision.Address(quad.P));
    delaunayflip::Prefetch(this->Decision.Address(quad.Q));
    delaunayflip::Prefetch(this->Decision.Address(quad.B));
  }
  void operator()(EdgeId edge, const Quad& quad, StepCounts& counts) const
  {
    const EdgeState state = this->Decision.Judge(quad);
    AtomicStore(&this->Mesh.States[edge], state);
    ++counts.Tested;
    counts.Uncertain += int(state == EdgeState::Uncertain);
  }
};

/// Pass 1: judges exactly the edges that JudgePass could not decide. Writes the edge's own state.
template <typename Rule>
struct ResolvePass : QuadPass
{
  Rule Decision;

  static constexpr StateRange Wanted{ EdgeState::Uncertain, EdgeState::Uncertain };
  void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    AtomicStore(&this->Mesh.States[edge], this->Decision.JudgeExactly(quad));
  }
};

/// Pass 2: blocks a bad edge if its flip would make an edge that exists, and frees it if it no
/// longer would. Reads the guard table, which does not change meanwhile; writes the edge's own
/// state.
struct GuardPass : QuadPass
{
  GuardedEdges Edges;

  static constexpr StateRange Wanted{ EdgeState::BlockedByEdge, EdgeState::Bad };
  void Prefetch(const Quad& quad) const { this->Edges.Table.Prefetch(quad.A, quad.B); }
  void operator()(EdgeId edge, const Quad& quad, StepCounts&) const
  {
    AtomicStore(&this->Mesh.States[edge], DecideByGuard(this->Edges, this->Mesh, quad));
  }
};

/// Pass 4: chooses an independent set: a bad edge wins if no bad edge of its two triangles has a
/// smaller priority. Reads the states of neighbours, which do not change meanwhile.
struct ChoosePass
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(EdgeId edge) const
  {
    const CornerPair corners = this->Mesh.GetCorners(edge);
    return GetOuterHalfEdges(this->Mesh, corners.A, corners.B);
  }
  void Prefetch(const OuterHalfEdges& outer) const
  {
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.AP)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.QA)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.PB)]);
    delaunayflip::Prefetch(&this->Mesh.States[EdgeOf(outer.BQ)]);
  }
  /// @returns whether the edge wins.
  bool operator()(EdgeId edge, const OuterHalfEdges& outer) const
  {
    // All four loads are issued before any result is used.
    const bool ap = this->IsBad(outer.AP), qa = this->IsBad(outer.QA);
    const bool pb = this->IsBad(outer.PB), bq = this->IsBad(outer.BQ);
    // Most edges have no bad neighbour, so a branch is worth it.
    const bool alone = (int(ap) | int(qa) | int(pb) | int(bq)) == 0;
    return alone || IsFirst(edge, outer, ap, qa, pb, bq);
  }

private:
  bool IsBad(HalfEdgeId halfEdge) const
  {
    return WasBad(AtomicLoad(&this->Mesh.States[EdgeOf(halfEdge)]));
  }
};

/// Passes 4 and 5 with a guard: chooses likewise, and winners claim the edge that they would make
/// (EdgeGuard.h).
struct ChooseAndClaimPass : ChoosePass
{
  EdgeClaims Claims;

  void PrefetchClaim(EdgeId edge) const
  {
    const Quad quad = this->Mesh.GetQuad(edge);
    this->Claims.Prefetch(quad.A, quad.B);
  }
  /// @returns the slot of the claim.
  std::uint32_t Claim(EdgeId edge) const
  {
    const Quad quad = this->Mesh.GetQuad(edge);
    bool isContested = false;
    return this->Claims.Claim(quad.A, quad.B, Priority(edge), isContested);
  }
};

/// Pass 6: flips the winners, which share no triangle, and makes their outer edges candidates. Two
/// flips may mark the same outer edge, both with the same value. A fixed or deferred edge keeps its
/// state.
struct FlipPass : QuadPass
{
  UnitFlags Active;

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
    ChoosePass{ this->Mesh }.Prefetch(outer);
  }

  /// @param excluded the new state of outer edges that are bad.
  DELAUNAYFLIP_ALWAYS_INLINE void FlipAndMark(
    EdgeId edge, const Quad& quad, StepCounts& counts, EdgeState excluded) const
  {
    TriangleRecord* triangles = this->Mesh.Triangles;
    const OuterHalfEdges outer =
      FlipEdge(this->Mesh, edge, quad, triangles[TriangleOf(quad.CornerA)],
        triangles[TriangleOf(quad.CornerB)], [](int, TriangleId, const TriangleRecord&) {});
    ++counts.Flipped;
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
    // A store costs less than a branch that cannot be predicted.
    AtomicStore(state, WasBad(seen) ? excluded : EdgeState::Candidate);
    this->Active.Set(edge);
  }
};

/// Passes 5 and 6 with a guard: if winners have the same new edge, only the holder of the claim
/// flips. The others wait, and stay bad.
struct ConfirmAndFlipPass : FlipPass
{
  EdgeGuardView Guard;

  void Prefetch(const Quad& quad) const
  {
    this->FlipPass::Prefetch(quad);
    this->Guard.Claims.Prefetch(quad.A, quad.B);
    this->Guard.Edges.Table.Prefetch(quad.A, quad.B);
    this->Guard.Edges.Table.Prefetch(quad.P, quad.Q);
  }
  /// @param slot of the edge's claim.
  void operator()(EdgeId edge, const Quad& quad, std::uint32_t slot, StepCounts& counts) const
  {
    if (this->Guard.Claims.HoldsSlot(slot, quad.A, quad.B, Priority(edge)))
    {
      this->FlipAndMark(edge, quad, counts, EdgeState::Candidate);
      this->Guard.Claims.ReleaseSlot(slot);
      UpdateGuard(this->Guard.Edges, edge, quad, counts);
    }
  }
};

/// Passes 4 and 6 in one, for a single thread. Makes the same flips as ChoosePass for all edges
/// followed by FlipPass. A bad edge next to one that has flipped becomes Excluded, which still
/// counts as bad when its neighbours choose. So choices depend on the states before the first flip,
/// and nothing that the choice of an edge reads changes before it, unless the edge is excluded.
struct ChooseAndFlipPass : FlipPass
{
  DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges Load(EdgeId edge) const
  {
    return ChoosePass{ this->Mesh }.Load(edge);
  }
  void Prefetch(const OuterHalfEdges& outer) const { this->PrefetchOuter(outer); }
  /// @returns whether the edge wins.
  bool Choose(EdgeId edge, const OuterHalfEdges& outer) const
  {
    return AtomicLoad(&this->Mesh.States[edge]) == EdgeState::Bad &&
      ChoosePass{ this->Mesh }(edge, outer);
  }
  void operator()(EdgeId edge, StepCounts& counts) const
  {
    this->FlipAndMark(edge, this->Mesh.GetQuad(edge), counts, EdgeState::Excluded);
  }
};

/// JudgePass in the plane if all triangles have one orientation: collects the points of several
/// edges and judges the edges together, in the lanes of vector registers.
template <typename Real>
class InCircleBatch
{
public:
  using Rule = PlanarRule<Real, 2>;

  InCircleBatch(const EdgeMeshView& mesh, const Rule& rule)
    : Mesh(mesh),
      Decision(rule)
  {
  }

  static bool Suits(const Rule& rule) { return rule.UniformSide != 0 && rule.FiltersApply; }

  /// A triangle, with its vertices in any order of the same orientation, and the vertex opposite to
  /// it.
  struct Vertices
  {
    VertexId Ids[4];
  };

  Vertices Load(EdgeId edge) const
  {
    const CornerPair corners = this->Mesh.GetCorners(edge);
    const VertexId* triangle = this->Mesh.Triangles[TriangleOf(corners.A)].Vertices;
    return { { triangle[0], triangle[1], triangle[2],
      this->Mesh.Triangles[TriangleOf(corners.B)].Vertices[SlotOf(corners.B)] } };
  }

  void Prefetch(const Vertices& vertices) const
  {
    for (const VertexId vertex : vertices.Ids)
    {
      delaunayflip::Prefetch(this->Decision.Address(vertex));
    }
  }

  /// Adds edge i, counted from 0, and judges the batch when it is full.
  void Add(const EdgeId* edges, std::int64_t i, const Vertices& vertices, StepCounts& counts)
  {
    const std::int64_t lane = i % Size;
    for (int corner = 0; corner < 4; ++corner)
    {
      std::memcpy(
        this->Points[corner][lane], this->Decision.Address(vertices.Ids[corner]), sizeof(Real[2]));
    }
    if (lane == Size - 1)
    {
      this->Judge(edges + i - lane, Size, counts);
    }
  }

  /// Judges the remaining edges, of `size` in all.
  void Finish(const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    this->Judge(edges + size / Size * Size, size % Size, counts);
    counts.Tested += size;
  }

  EdgeMeshView Mesh;

private:
  static constexpr int Size = 8;
  static constexpr auto Good = static_cast<std::int64_t>(EdgeState::Good);
  static constexpr auto Uncertain = static_cast<std::int64_t>(EdgeState::Uncertain);
  static constexpr auto Bad = static_cast<std::int64_t>(EdgeState::Bad);

  void Judge(const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    // These are as wide as double, so that results stay in their lanes.
    std::int64_t states[Size];
    const auto side = static_cast<double>(this->Decision.UniformSide);
    for (int i = 0; i < Size; ++i)
    {
      const FilteredDeterminant determinant =
        InCircleDeterminant(this->Get(0, i), this->Get(1, i), this->Get(2, i), this->Get(3, i));
      const double value = side * determinant.Value;
      const double bound = GetBound(InCircleBound * determinant.Permanent);
      const std::int64_t other = -value > bound ? Good : Uncertain;
      states[i] = value > bound ? Bad : other;
    }
    for (std::int64_t i = 0; i < size; ++i)
    {
      AtomicStore(&this->Mesh.States[edges[i]], static_cast<EdgeState>(states[i]));
      counts.Uncertain += int(states[i] == Uncertain);
    }
  }

  PlanePoint Get(int corner, int i) const
  {
    return { this->Points[corner][i][0], this->Points[corner][i][1], 0.0 };
  }

  Rule Decision;
  Real Points[4][Size][2] = {};
};

}

#endif
