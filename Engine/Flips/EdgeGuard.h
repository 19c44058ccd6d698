// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEGUARD_H
#define DELAUNAYFLIP_EDGEGUARD_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <cstdint>
#include <utility>

namespace delaunayflip
{

/// The claims of an iteration on the edges that flips would make. Two flips that share no triangle
/// may make the same edge; then the one with the smaller priority holds the claim.
///
/// A hash table of words (tag of the edge, smallest priority). If two edges with neighbouring
/// places have the same tag, which happens to one pair in billions, they count as one edge, which
/// delays one of them by an iteration. All words are Empty between iterations, because the holder
/// of a claim releases it.
struct EdgeClaims
{
  static constexpr std::uint64_t Empty = ~std::uint64_t(0);

  std::uint64_t* Words;
  std::uint32_t Size;

  /// The number of words for a mesh: winners share no triangle, so at most a third of the edges
  /// win.
  static std::int64_t GetSize(std::int64_t edges) { return edges / 2 + 64; }

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(VertexId a, VertexId b) const
  {
    delaunayflip::Prefetch(&this->Words[this->FirstSlot(MakeWord(a, b, 0))]);
  }

  /// @returns the slot of the edge, which HoldsSlot() takes.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Claim(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    for (;;)
    {
      std::uint64_t seen = AtomicLoad(&this->Words[slot]);
      if (seen == Empty)
      {
        seen = AtomicCompareExchange(&this->Words[slot], Empty, word);
      }
      if (seen == Empty)
      {
        return slot;
      }
      if (seen >> 32 == word >> 32)
      {
        AtomicMin(&this->Words[slot], word);
        return slot;
      }
      slot = this->Next(slot);
    }
  }

  /// Whether an edge that was claimed is held by this priority.
  DELAUNAYFLIP_HOST_DEVICE bool Holds(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    while (AtomicLoad(&this->Words[slot]) >> 32 != word >> 32)
    {
      slot = this->Next(slot);
    }
    return this->HoldsSlot(slot, a, b, priority);
  }

  /// The same for the slot that Claim() returned. Others may be released at the same time.
  DELAUNAYFLIP_HOST_DEVICE bool HoldsSlot(
    std::uint32_t slot, VertexId a, VertexId b, std::uint32_t priority) const
  {
    return AtomicLoad(&this->Words[slot]) == MakeWord(a, b, priority);
  }

  /// Releases a claim that is held. Others may be released at the same time.
  DELAUNAYFLIP_HOST_DEVICE void Release(VertexId a, VertexId b, std::uint32_t priority) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    while (AtomicLoad(&this->Words[slot]) != word)
    {
      slot = this->Next(slot);
    }
    this->ReleaseSlot(slot);
  }
  DELAUNAYFLIP_HOST_DEVICE void ReleaseSlot(std::uint32_t slot) const
  {
    AtomicStore(&this->Words[slot], Empty);
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static std::uint64_t MakeWord(
    VertexId a, VertexId b, std::uint32_t priority)
  {
    const std::uint64_t key = EdgeKey(a, b);
    const std::uint32_t tag =
      Scatter(static_cast<std::uint32_t>(key) + Scatter(static_cast<std::uint32_t>(key >> 32)));
    // The largest tag with the largest priority would equal Empty.
    return (std::uint64_t(tag & 0x7FFFFFFFu) << 32) | priority;
  }

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FirstSlot(std::uint64_t word) const
  {
    return static_cast<std::uint32_t>(((word >> 32) * this->Size) >> 31);
  }
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Next(std::uint32_t slot) const
  {
    return slot + 1 < this->Size ? slot + 1 : 0;
  }
};

/// The edges that flips must not make.
struct GuardedEdges
{
  EdgeTableView Table; ///< The vertex pairs of the mesh's edges.
  const unsigned char* SharedVertices; ///< By vertex (WholeMesh::SharedPoints), or null.

  DELAUNAYFLIP_HOST_DEVICE bool Forbid(VertexId a, VertexId b) const
  {
    const bool isUnknown =
      this->SharedVertices && (this->SharedVertices[a] & this->SharedVertices[b]) != 0;
    return isUnknown || this->Table.Find(EdgeKey(a, b)) != EdgeTableView::NoSlot;
  }
};

/// Plain pointers to an EdgeGuard, for functions of both backends.
struct EdgeGuardView
{
  bool Active;
  GuardedEdges Edges;
  EdgeClaims Claims;
};

/// Enters an edge into a guard's table.
struct EnterEdgeStep
{
  EdgeMeshView Mesh;
  EdgeTableView Table;

  DELAUNAYFLIP_HOST_DEVICE std::uint64_t GetKey(std::int64_t edge) const
  {
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    return KeyOpposite(this->Mesh.Triangles[TriangleOf(corner)], SlotOf(corner));
  }
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t edge) const
  {
    this->Table.PrefetchKey(this->GetKey(edge));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    bool inserted = false;
    this->Table.FindOrInsert(this->GetKey(edge), inserted);
  }
};

/// The table of all edges, if flips could make an edge that exists; empty if they provably cannot.
class EdgeGuard
{
public:
  EdgeGuard() = default;

  /// @param table holds the vertex pairs of all `edges` edges, or is empty.
  /// @param shared the flags of WholeMesh::SharedPoints, in the order of vertices; or empty.
  template <typename Backend>
  EdgeGuard(EdgeTable table, std::int64_t edges, std::int64_t vertices, const Backend& backend,
    Array<unsigned char> shared = {})
    : Table(std::move(table)),
      Claims(backend.template MakeArray<std::uint64_t>(EdgeClaims::GetSize(edges))),
      SharedVertices(std::move(shared)),
      UsedSlots(edges),
      NumberOfVertices(vertices)
  {
    this->ClearClaims(backend);
  }

  bool IsActive() const { return !this->Table.IsEmpty(); }

  EdgeGuardView View()
  {
    const unsigned char* shared =
      this->SharedVertices.Size() > 0 ? this->SharedVertices.Data() : nullptr;
    return { this->IsActive(), { this->Table.View(), shared },
      { this->Claims.Data(), static_cast<std::uint32_t>(this->Claims.Size()) } };
  }

  /// How many slots flips may use for the first time before the table must be rebuilt.
  std::int64_t GetFreshSlotsLeft() const
  {
    // The share of slots ever used above which searches for absent edges become long.
    constexpr double LargestUse = 0.8;
    return static_cast<std::int64_t>(LargestUse * static_cast<double>(this->Table.GetCapacity())) -
      this->UsedSlots;
  }

  /// Takes flips into account: rebuilds the table from the mesh if too many slots have been used or
  /// a new edge found none.
  template <typename Backend>
  void Maintain(const StepCounts& flips, EdgeMesh& mesh, const Backend& backend)
  {
    this->UsedSlots += flips.FreshSlots;
    if (flips.LostInserts > 0 || this->GetFreshSlotsLeft() < 0)
    {
      this->Rebuild(mesh, backend);
    }
  }

  // Public because device lambdas ask for it.
  template <typename Backend>
  void ClearClaims(const Backend& backend)
  {
    std::uint64_t* claims = this->Claims.Data();
    backend.ForEach(static_cast<std::int64_t>(this->Claims.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { claims[i] = EdgeClaims::Empty; });
  }

  template <typename Backend>
  void Rebuild(EdgeMesh& mesh, const Backend& backend)
  {
    this->Table = EdgeTable();
    this->Table = EdgeTable(
      mesh.NumberOfEdges, { 0, static_cast<VertexId>(this->NumberOfVertices) }, false, backend);
    backend.ForEach(mesh.NumberOfEdges, EnterEdgeStep{ mesh.View(), this->Table.View() });
    this->UsedSlots = mesh.NumberOfEdges;
  }

private:
  EdgeTable Table;
  Array<std::uint64_t> Claims;
  Array<unsigned char> SharedVertices;
  std::int64_t UsedSlots = 0;
  std::int64_t NumberOfVertices = 0;
};

}

#endif
