// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEGUARD_H
#define DELAUNAYFLIP_EDGEGUARD_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <algorithm>
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
  /// win, and a sixth or less in practice.
  static std::int64_t GetSize(std::int64_t edges) { return edges / 3 + 64; }

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(VertexId a, VertexId b) const
  {
    delaunayflip::Prefetch(&this->Words[this->FirstSlot(MakeWord(a, b, 0))]);
  }

  /// @param isContested receives true if another has claimed the edge before.
  /// @returns the slot of the edge, which HoldsSlot() and ReleaseSlot() take.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Claim(
    VertexId a, VertexId b, std::uint32_t priority, bool& isContested) const
  {
    const std::uint64_t word = MakeWord(a, b, priority);
    std::uint32_t slot = this->FirstSlot(word);
    for (;;)
    {
      const std::uint64_t seen = AtomicCompareExchange(&this->Words[slot], Empty, word);
      if (seen == Empty)
      {
        return slot;
      }
      if (seen >> 32 == word >> 32)
      {
        AtomicMin(&this->Words[slot], word);
        isContested = true;
        return slot;
      }
      slot = this->Next(slot);
    }
  }

  /// Whether this priority holds the claim on an edge that was claimed.
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

  /// Looks at the slot that Claim() returned. Others may be released at the same time.
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

/// A hash table of edges, which says whether there is one between two vertices.
///
/// A slot has a tag, 8 bits of the hash of the vertex pair, and the edge, which names its vertices
/// by the mesh. Eight slots are a group, and their tags are one word. A search looks at one group
/// after the other until one has an empty slot. It begins near the place that the pair's smaller
/// vertex has in the order of vertices, so that neighbours in the mesh share cache lines. After two
/// groups there it continues at places given by a hash of the whole pair. These are first among
/// spare groups, where no search begins. Most slots of these are empty, so that the search soon
/// ends. After some it continues anywhere. So searches are short whatever the vertex degrees.
///
/// A slot becomes empty again only in a group that has another empty one, which no search has
/// passed; else it stays removed until an edge uses it. Edges are inserted and removed at the same
/// time, and searched for at other times. What a search finds does not depend on their order.
struct GuardTableView
{
  static constexpr unsigned Empty = 0, Removed = 1, FirstTag = 2;
  static constexpr std::uint32_t GroupSize = 8; ///< Slots.
  static constexpr std::uint32_t NearGroups = 8; ///< The edges of a vertex begin at one of these.
  static constexpr std::uint32_t NearProbes = 2;
  static constexpr std::uint32_t SpareProbes = 8;
  static constexpr std::uint32_t Probes = NearProbes + SpareProbes + (1u << 9);
  static constexpr int StrideBits = 24;

  std::uint64_t* Tags; ///< By group.
  EdgeId* Edges; ///< By slot; NoEdge if it has none.
  std::uint32_t Groups;
  std::uint32_t Homes; ///< The groups at which searches begin; the others are spare.
  std::uint64_t Stride; ///< Homes per vertex, times 2^StrideBits.

  /// The way of a search. Loads the tags of the groups near its beginning, both at once.
  class Path
  {
  public:
    DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE Path(
      const GuardTableView& table, VertexId a, VertexId b)
      : Table(table)
    {
      const std::uint64_t key = EdgeKey(a, b);
      const auto smaller = static_cast<VertexId>(key >> 32);
      const auto larger = static_cast<VertexId>(key);
      this->Scattered = Scatter(larger + Scatter(smaller));
      this->Tag = FirstTag + (this->Scattered >> 8) % (256 - FirstTag);
      const std::uint64_t home = (std::uint64_t(smaller) * table.Stride) >> StrideBits;
      this->Group = this->Wrap(static_cast<std::uint32_t>(home) + this->Scattered % NearGroups);
      this->Next = this->Wrap(this->Group + 1);
      this->Tags = AtomicLoad(&table.Tags[this->Group]);
      this->NextTags = AtomicLoad(&table.Tags[this->Next]);
    }
    /// @returns false at the end.
    DELAUNAYFLIP_HOST_DEVICE bool Advance()
    {
      ++this->Probe;
      this->Group = this->Next;
      this->Tags = this->NextTags;
      if (this->Probe >= NearProbes)
      {
        this->Scattered = Scatter(this->Scattered + 0x9e3779b9u);
        const bool isSpare = this->Probe < NearProbes + SpareProbes;
        const std::uint32_t first = isSpare ? this->Table.Homes : 0;
        const std::uint64_t range = this->Table.Groups - first;
        this->Group = first + static_cast<std::uint32_t>((this->Scattered * range) >> 32);
        this->Tags = AtomicLoad(&this->Table.Tags[this->Group]);
      }
      return this->Probe < Probes;
    }

    std::uint32_t Group;
    std::uint64_t Tags; ///< The group's tags.
    unsigned Tag; ///< The edge's tag.

  private:
    /// Home h of the table, or one of the first for those that follow the last.
    DELAUNAYFLIP_HOST_DEVICE std::uint32_t Wrap(std::uint32_t h) const
    {
      return h < this->Table.Homes ? h : h % this->Table.Homes;
    }

    const GuardTableView& Table;
    std::uint32_t Scattered, Next, Probe = 0;
    std::uint64_t NextTags;
  };

  DELAUNAYFLIP_HOST_DEVICE Path Find(VertexId a, VertexId b) const { return { *this, a, b }; }

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(VertexId a, VertexId b) const
  {
    const std::uint64_t smaller = EdgeKey(a, b) >> 32;
    const std::uint64_t home = (smaller * this->Stride) >> StrideBits;
    delaunayflip::Prefetch(&this->Tags[home < this->Homes ? home : 0]);
  }

  /// Whether the mesh has the edge a-b. May miss an edge that is being inserted.
  DELAUNAYFLIP_HOST_DEVICE bool Has(const EdgeMeshView& mesh, VertexId a, VertexId b) const
  {
    Path path = this->Find(a, b);
    do
    {
      for (std::uint64_t same = Match(path.Tags, path.Tag); same != 0; same &= same - 1)
      {
        const EdgeId edge = AtomicLoad(&this->Edges[path.Group * GroupSize + FirstIn(same)]);
        if (edge != NoEdge && Joins(mesh, edge, a, b))
        {
          return true;
        }
      }
    } while (Match(path.Tags, Empty) == 0 && path.Advance());
    return false;
  }

  /// Inserts an edge. @param path of its vertices.
  /// @returns by how many more slots are not empty; -1 if none was free.
  DELAUNAYFLIP_HOST_DEVICE int Insert(EdgeId edge, Path path) const
  {
    do
    {
      std::uint64_t free;
      while ((free = Match(path.Tags, Empty) | Match(path.Tags, Removed)) != 0)
      {
        const std::uint32_t slot = FirstIn(free);
        const std::uint64_t seen = this->Exchange(path.Group, path.Tags, slot, path.Tag);
        if (seen == path.Tags)
        {
          AtomicStore(&this->Edges[path.Group * GroupSize + slot], edge);
          return int(GetTag(seen, slot) == Empty);
        }
        path.Tags = seen;
      }
    } while (path.Advance());
    return -1;
  }

  /// Removes an edge. @param path of its vertices. @returns how many more slots are empty.
  DELAUNAYFLIP_HOST_DEVICE int Remove(EdgeId edge, Path path) const
  {
    do
    {
      for (std::uint64_t same = Match(path.Tags, path.Tag); same != 0; same &= same - 1)
      {
        // The slot has no edge any more when it becomes free for others.
        const std::uint32_t slot = FirstIn(same);
        EdgeId* place = &this->Edges[path.Group * GroupSize + slot];
        if (AtomicCompareExchange(place, edge, NoEdge) == edge)
        {
          return this->Free(path.Group, path.Tags, slot);
        }
      }
    } while (path.Advance());
    return 0;
  }

private:
  /// Frees a slot. @returns how many more slots are empty.
  DELAUNAYFLIP_HOST_DEVICE int Free(
    std::uint32_t group, std::uint64_t tags, std::uint32_t slot) const
  {
    for (;;)
    {
      const bool hasEmpty = Match(tags, Empty) != 0;
      const unsigned tag = hasEmpty ? Empty : Removed;
      const std::uint64_t seen = this->Exchange(group, tags, slot, tag);
      if (seen == tags)
      {
        return int(hasEmpty);
      }
      tags = seen;
    }
  }

  /// The highest bit of each byte of `tags` that equals `tag`.
  DELAUNAYFLIP_HOST_DEVICE static std::uint64_t Match(std::uint64_t tags, unsigned tag)
  {
    constexpr std::uint64_t Low = 0x7F7F7F7F7F7F7F7Fu;
    const std::uint64_t other = tags ^ (0x0101010101010101u * tag);
    return ~(((other & Low) + Low) | other | Low);
  }

  /// The first slot of a group with its bit set in a Match.
  DELAUNAYFLIP_HOST_DEVICE static std::uint32_t FirstIn(std::uint64_t match)
  {
#if DELAUNAYFLIP_ON_DEVICE
    return (__ffsll(static_cast<long long>(match)) - 1) / 8;
#else
    return __builtin_ctzll(match) / 8;
#endif
  }

  DELAUNAYFLIP_HOST_DEVICE static unsigned GetTag(std::uint64_t tags, std::uint32_t slot)
  {
    return static_cast<unsigned>(tags >> (8 * slot)) & 0xFF;
  }

  /// Sets the tag of a slot if the tags of its group are `expected`. @returns what they were.
  DELAUNAYFLIP_HOST_DEVICE std::uint64_t Exchange(
    std::uint32_t group, std::uint64_t expected, std::uint32_t slot, unsigned tag) const
  {
    const std::uint64_t others = expected & ~(std::uint64_t(0xFF) << (8 * slot));
    return AtomicCompareExchange(
      &this->Tags[group], expected, others | (std::uint64_t(tag) << (8 * slot)));
  }

  DELAUNAYFLIP_HOST_DEVICE static bool Joins(
    const EdgeMeshView& mesh, EdgeId edge, VertexId a, VertexId b)
  {
    const CornerId corner = mesh.CornerOfHalfEdge[2 * edge];
    const TriangleRecord& triangle = mesh.Triangles[TriangleOf(corner)];
    const VertexId p = GetAt(triangle.Vertices, NextSlot(SlotOf(corner)));
    const VertexId q = GetAt(triangle.Vertices, PreviousSlot(SlotOf(corner)));
    return (p == a && q == b) || (p == b && q == a);
  }
};

/// The edges that flips must not make.
struct GuardedEdges
{
  GuardTableView Table; ///< All edges of the mesh.
  const unsigned char* SharedVertices; ///< By vertex (WholeMesh::SharedPoints), or null.
};

/// Plain pointers to an EdgeGuard, for functions of both backends.
struct EdgeGuardView
{
  GuardedEdges Edges;
  EdgeClaims Claims;
};

/// Enters an edge into a guard's table.
struct EnterEdgeStep
{
  EdgeMeshView Mesh;
  GuardTableView Table;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t edge) const
  {
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
    this->Table.Prefetch(
      triangle.Vertices[NextSlot(SlotOf(corner))], triangle.Vertices[PreviousSlot(SlotOf(corner))]);
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t edge) const
  {
    const CornerId corner = this->Mesh.CornerOfHalfEdge[2 * edge];
    const TriangleRecord& triangle = this->Mesh.Triangles[TriangleOf(corner)];
    const VertexId a = triangle.Vertices[NextSlot(SlotOf(corner))];
    const VertexId b = triangle.Vertices[PreviousSlot(SlotOf(corner))];
    // A non-manifold edge is as many edges as it has triangles; one of them is enough.
    const bool mayRepeat = this->Mesh.CornerOfHalfEdge[2 * edge + 1] == NoCorner;
    const bool isKnown = mayRepeat && (!HasEdges(triangle) || this->Table.Has(this->Mesh, a, b));
    if (!isKnown)
    {
      this->Table.Insert(static_cast<EdgeId>(edge), this->Table.Find(a, b));
    }
  }
};

/// The table of all edges, if flips could make an edge that exists; empty if they provably cannot.
class EdgeGuard
{
public:
  EdgeGuard() = default;

  /// @param shared the flags of WholeMesh::SharedPoints, in the order of vertices; or empty.
  template <typename Backend>
  EdgeGuard(
    EdgeMesh& mesh, std::int64_t vertices, const Backend& backend, Array<unsigned char> shared = {})
    : Claims(backend.template MakeArray<std::uint64_t>(EdgeClaims::GetSize(mesh.NumberOfEdges))),
      SharedVertices(std::move(shared)),
      NumberOfVertices(vertices)
  {
    // How many slots an edge has: a compromise between short searches and little memory.
    constexpr double Homes = Backend::MemoryIsScarce ? 1.15 : 2.0, Spare = 0.25;
    const auto edges = static_cast<double>(mesh.NumberOfEdges);
    const auto count = [&](double share)
    { return static_cast<std::int64_t>(share * edges / GuardTableView::GroupSize) + 4; };
    this->NumberOfHomes = count(Homes);
    const std::int64_t groups = this->NumberOfHomes + count(Spare);
    this->Tags = backend.template MakeArray<std::uint64_t>(groups);
    this->Edges = backend.template MakeArray<EdgeId>(groups * GuardTableView::GroupSize);
    this->Rebuild(mesh, backend);
  }

  bool IsActive() const { return this->Tags.Size() > 0; }

  EdgeGuardView View()
  {
    const GuardTableView table{ this->Tags.Data(), this->Edges.Data(),
      static_cast<std::uint32_t>(this->Tags.Size()),
      static_cast<std::uint32_t>(this->NumberOfHomes),
      (std::uint64_t(this->NumberOfHomes) << GuardTableView::StrideBits) /
        std::max<std::int64_t>(1, this->NumberOfVertices) };
    return { { table, this->SharedVertices.Data() },
      { this->Claims.Data(), static_cast<std::uint32_t>(this->Claims.Size()) } };
  }

  /// How many slots may be in use, beyond those that are, before the table must be rebuilt.
  std::int64_t GetFreshSlotsLeft() const
  {
    // The share of slots that are not empty above which searches for absent edges become long.
    constexpr double LargestUse = 0.9;
    return static_cast<std::int64_t>(LargestUse * static_cast<double>(this->Edges.Size())) -
      this->UsedSlots;
  }

  /// Takes flips into account: rebuilds the table from the mesh if too many slots are in use or a
  /// new edge found none. @returns whether it did.
  template <typename Backend>
  bool Maintain(const StepCounts& flips, EdgeMesh& mesh, const Backend& backend)
  {
    this->UsedSlots += flips.FreshSlots - flips.FreedSlots;
    const bool isFull = flips.LostInserts > 0 || this->GetFreshSlotsLeft() < 0;
    if (isFull)
    {
      this->Rebuild(mesh, backend);
    }
    return isFull;
  }

  /// Makes the table of the mesh's edges; no claims. Public because device lambdas ask for it.
  template <typename Backend>
  void Rebuild(EdgeMesh& mesh, const Backend& backend)
  {
    std::uint64_t* claims = this->Claims.Data();
    backend.ForEach(static_cast<std::int64_t>(this->Claims.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { claims[i] = EdgeClaims::Empty; });
    const GuardTableView table = this->View().Edges.Table;
    backend.ForEach(static_cast<std::int64_t>(table.Groups),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { table.Tags[i] = 0; });
    backend.ForEach(static_cast<std::int64_t>(this->Edges.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { table.Edges[i] = NoEdge; });
    backend.ForEach(mesh.NumberOfEdges, EnterEdgeStep{ mesh.View(), table });
    this->UsedSlots = mesh.NumberOfEdges;
  }

private:
  Array<std::uint64_t> Tags;
  Array<EdgeId> Edges;
  Array<std::uint64_t> Claims;
  Array<unsigned char> SharedVertices;
  std::int64_t NumberOfHomes = 0; ///< Groups of slots where searches begin.
  std::int64_t UsedSlots = 0; ///< Slots that are not empty.
  std::int64_t NumberOfVertices = 0;
};

}

#endif
