// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGETABLE_H
#define DELAUNAYFLIP_EDGETABLE_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "HostDevice.h"

#include <algorithm>
#include <cstdint>

/// @file
/// A hash set of edges by their vertex pair, shared by all threads: it pairs the triangles of an
/// edge when the edge mesh is built, and guards against duplicate edges while constraints are
/// inserted. Membership never depends on the order of insertions.

namespace delaunayflip
{

/// Vertex pair of an edge, smaller id first.
DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t EdgeKey(VertexId a, VertexId b)
{
  // Two selections instead of a branch, which would be mispredicted half of the time. Compilers
  // make a branch of std::min with std::max.
  const VertexId smaller = a < b ? a : b;
  const VertexId larger = a < b ? b : a;
  return (std::uint64_t(smaller) << 32) | larger;
}

/// A bijection of 32-bit numbers that scatters them (MurmurHash3's finalizer).
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t Scatter(std::uint32_t x)
{
  x ^= x >> 16;
  x *= 0x85ebca6bu;
  x ^= x >> 13;
  x *= 0xc2b2ae35u;
  return x ^ (x >> 16);
}

/// The vertices [First, Last) of the engine's order. A table may be restricted to the edges with
/// their smaller vertex in such a slice.
struct VertexSlice
{
  VertexId First, Last;

  DELAUNAYFLIP_HOST_DEVICE bool Holds(std::uint64_t key) const
  {
    const auto smaller = static_cast<VertexId>(key >> 32);
    return smaller >= this->First && smaller < this->Last;
  }
};

/// Plain pointers to an EdgeTable, for functions of both backends.
///
/// A search for a key begins near the place that its smaller vertex has in the order of vertices,
/// so that neighbours in the mesh share cache lines. If NearProbes slots there are taken (at a
/// vertex with very many edges), it continues at places given by a hash of the whole pair. So
/// searches are short whatever the vertex degrees.
struct EdgeTableView
{
  static constexpr std::uint64_t Empty = ~std::uint64_t(0);
  static constexpr std::uint64_t Removed = Empty - 1;
  static constexpr std::uint32_t NoSlot = 0xFFFFFFFFu;
  /// The edges of a vertex are spread over this many slots.
  static constexpr std::uint32_t NearSlots = 64;
  static constexpr std::uint32_t NearProbes = 8;
  static constexpr std::uint32_t FarSlots = 1u << 12;
  static constexpr int StrideBits = 24;

  std::uint64_t* Keys;
  std::uint32_t* First; ///< Two words per key, for the user of the table.
  std::uint32_t* Second;
  std::uint32_t Capacity; ///< Below 2^32, so that Stride times a vertex fits 64 bits.
  VertexSlice Slice;
  std::uint64_t Stride; ///< Slots per vertex of the slice, times 2^StrideBits.

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t NearSlot(VertexId smaller, std::uint32_t scattered) const
  {
    const std::uint64_t home =
      (std::uint64_t(smaller - this->Slice.First) * this->Stride) >> StrideBits;
    const std::uint64_t slot = home + scattered % NearSlots;
    if (slot < this->Capacity)
    {
      return static_cast<std::uint32_t>(slot);
    }
    return static_cast<std::uint32_t>(slot % this->Capacity);
  }

  /// Calls visit(slot, key there) for the slots at which `key` may be, in the order of search,
  /// until it returns true. @param loads if false, the keys are not loaded. @returns that slot, or
  /// NoSlot.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Search(
    std::uint64_t key, bool loads, const Visit& visit) const
  {
    const VertexId smaller = static_cast<VertexId>(key >> 32);
    std::uint32_t scattered = Scatter(static_cast<std::uint32_t>(key) + Scatter(smaller));
    const std::uint32_t near = this->NearSlot(smaller, scattered);
    for (std::uint32_t probe = 0; probe < NearProbes + FarSlots; ++probe)
    {
      std::uint64_t slot = std::uint64_t(near) + probe;
      if (slot >= this->Capacity)
      {
        slot -= this->Capacity;
      }
      if (probe >= NearProbes)
      {
        // Slots are scattered, because vertices with many edges fill thousands of consecutive ones.
        scattered = Scatter(scattered + 0x9e3779b9u);
        slot = (std::uint64_t(scattered) * this->Capacity) >> 32;
      }
      const auto found = static_cast<std::uint32_t>(slot);
      const std::uint64_t there = loads ? AtomicLoad(&this->Keys[found]) : Empty;
      if (visit(found, there))
      {
        return found;
      }
    }
    return NoSlot;
  }

  /// Prefetches the slot at which a search for `key` begins, and its words.
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::uint64_t key) const
  {
    const VertexId smaller = static_cast<VertexId>(key >> 32);
    const std::uint32_t slot =
      this->NearSlot(smaller, Scatter(static_cast<std::uint32_t>(key) + Scatter(smaller)));
    delaunayflip::Prefetch(&this->Keys[slot]);
    delaunayflip::Prefetch(&this->First[slot]);
    delaunayflip::Prefetch(&this->Second[slot]);
  }

  /// @returns the slot of `key`, or NoSlot.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Find(std::uint64_t key) const
  {
    std::uint64_t seen = Empty;
    const std::uint32_t slot = this->Search(key, true,
      [&](std::uint32_t, std::uint64_t there)
      {
        seen = there;
        return seen == key || seen == Empty;
      });
    return seen == key ? slot : NoSlot;
  }

  /// @returns the slot that now holds `key`, or NoSlot if the table is too full. `inserted`
  /// receives whether this call inserted it.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindOrInsert(std::uint64_t key, bool& inserted) const
  {
    inserted = false;
    // On a device a single access to memory, whether the key is there or not.
    return this->Search(key, !DELAUNAYFLIP_ON_DEVICE,
      [&](std::uint32_t candidate, std::uint64_t seen)
      {
        if (seen == Empty)
        {
          seen = AtomicCompareExchange(&this->Keys[candidate], Empty, key);
          inserted = seen == Empty;
        }
        return inserted || seen == key;
      });
  }

  /// Uses the first free slot for a `key` that is not in the table. @returns whether there was one.
  DELAUNAYFLIP_HOST_DEVICE bool InsertNew(std::uint64_t key) const
  {
    const std::uint32_t slot = this->Search(key, true,
      [&](std::uint32_t candidate, std::uint64_t seen) {
        return seen >= Removed && AtomicCompareExchange(&this->Keys[candidate], seen, key) == seen;
      });
    return slot != NoSlot;
  }

  DELAUNAYFLIP_HOST_DEVICE void Remove(std::uint64_t key) const
  {
    const std::uint32_t slot = this->Find(key);
    if (slot != NoSlot)
    {
      AtomicStore(&this->Keys[slot], Removed);
    }
  }
};

/// The table, owned.
class EdgeTable
{
public:
  EdgeTable() = default;

  /// An empty table with room for `edges` edges.
  template <typename Backend>
  EdgeTable(std::int64_t edges, const VertexSlice& slice, const Backend& backend)
    : Slice(slice)
  {
    // Share of slots in use when all expected edges are in: a compromise between short searches and
    // little memory.
    constexpr double FillFactor = 0.6;
    const std::int64_t wanted =
      static_cast<std::int64_t>(static_cast<double>(edges) / FillFactor) + 64;
    const std::int64_t capacity = std::min<std::int64_t>(wanted, EdgeTableView::NoSlot);
    this->Keys = backend.template MakeArray<std::uint64_t>(capacity);
    this->First = backend.template MakeArray<std::uint32_t>(capacity);
    this->Second = backend.template MakeArray<std::uint32_t>(capacity);
    Clear(this->View(), backend);
  }

  EdgeTableView View()
  {
    const std::uint64_t capacity = this->Keys.Size();
    return { this->Keys.Data(), this->First.Data(), this->Second.Data(),
      static_cast<std::uint32_t>(capacity), this->Slice,
      (capacity << EdgeTableView::StrideBits) /
        std::max<std::uint64_t>(1, this->Slice.Last - this->Slice.First) };
  }
  std::int64_t GetCapacity() const { return static_cast<std::int64_t>(this->Keys.Size()); }

  /// Removes all keys; words become NoCorner. Public because device lambdas ask for it.
  template <typename Backend>
  static void Clear(const EdgeTableView& table, const Backend& backend)
  {
    backend.ForEach(table.Capacity,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        table.Keys[i] = EdgeTableView::Empty;
        table.First[i] = NoCorner;
        table.Second[i] = NoCorner;
      });
  }

private:
  Array<std::uint64_t> Keys;
  Array<std::uint32_t> First, Second;
  VertexSlice Slice{ 0, 0 };
};

//------------------------------------------------------------------------------
// What the builder does for one corner or edge. Until edges have numbers, a triangle's HalfEdges
// hold first the table slot of the edge opposite to each corner, then the edge's other corner. Its
// Flips hold the roles of its corners, two bits each, from then on.

/// Second word of an edge with three or more corners.
constexpr CornerId ManyCorners = 0xFFFFFFFEu;

/// Bit of Flips: no edge of this triangle may flip.
constexpr std::uint32_t UntouchableBit = 1u << 6;

/// The counts of pairing. Triangles without edges (HasEdges) are left out.
struct PairSums
{
  std::int64_t Edges = 0, NonManifold = 0, Failures = 0;

  DELAUNAYFLIP_HOST_DEVICE PairSums& operator+=(const PairSums& part)
  {
    this->Edges += part.Edges;
    this->NonManifold += part.NonManifold;
    this->Failures += part.Failures;
    return *this;
  }
};

/// The role of a corner for its edge.
enum class CornerRole : std::uint32_t
{
  Follower, ///< The other corner numbers the edge.
  Leader, ///< The smaller corner of two.
  Alone, ///< The only corner: a boundary edge.
  OneOfMany ///< One of three or more: it gets an edge record of its own.
};

/// Whether the three vertices differ. A triangle that names a vertex twice has no edges.
DELAUNAYFLIP_HOST_DEVICE inline bool HasEdges(const TriangleRecord& triangle)
{
  const VertexId* v = triangle.Vertices;
  return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

/// The key of the edge opposite a slot. In a triangle without edges it joins a vertex with itself,
/// as no edge does.
DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t KeyOpposite(const TriangleRecord& triangle, int slot)
{
  const VertexId a = triangle.Vertices[NextSlot(slot)], b = triangle.Vertices[PreviousSlot(slot)];
  if (!HasEdges(triangle))
  {
    const VertexId smaller = std::min(a, b);
    return EdgeKey(smaller, smaller);
  }
  return EdgeKey(a, b);
}

/// Whether a key is that of an edge.
DELAUNAYFLIP_HOST_DEVICE inline bool IsKeyOfEdge(std::uint64_t key)
{
  return static_cast<VertexId>(key >> 32) != static_cast<VertexId>(key);
}

DELAUNAYFLIP_HOST_DEVICE inline CornerRole GetRole(const TriangleRecord& triangle, int slot)
{
  return static_cast<CornerRole>((triangle.Flips >> (2 * slot)) & 3);
}

/// The number of edges that the corners of a triangle lead.
DELAUNAYFLIP_HOST_DEVICE inline int CountLeaders(const TriangleRecord& triangle)
{
  int leaders = 0;
  for (int slot = 0; slot < 3; ++slot)
  {
    leaders += int(GetRole(triangle, slot) != CornerRole::Follower);
  }
  return leaders;
}

/// Writes the role of a corner of triangle `t` into Flips, and the other corner of its edge into
/// HalfEdges.
/// @param other NoCorner for a boundary edge, and for a non-manifold one ManyCorners, which becomes
/// NoCorner.
DELAUNAYFLIP_HOST_DEVICE inline void SetRole(
  TriangleRecord& triangle, std::int64_t t, int slot, CornerId other)
{
  static_assert(static_cast<int>(CornerRole::Follower) == 0 &&
      static_cast<int>(CornerRole::Leader) == 1 && static_cast<int>(CornerRole::Alone) == 2 &&
      static_cast<int>(CornerRole::OneOfMany) == 3,
    "without branches, the two special ids being larger than any corner");
  const bool isSmaller = MakeCorner(static_cast<TriangleId>(t), slot) < other;
  const std::uint32_t role =
    int(isSmaller) + int(other == NoCorner) + 2 * int(other == ManyCorners);
  triangle.Flips |= role << (2 * slot);
  triangle.HalfEdges[slot] = other == ManyCorners ? NoCorner : other;
}

/// If a triangle has no edges, gives each of its corners a record of its own, whatever was paired
/// with it.
DELAUNAYFLIP_HOST_DEVICE inline void SeparateIfEdgeless(TriangleRecord& triangle)
{
  if (!HasEdges(triangle))
  {
    for (CornerId& other : triangle.HalfEdges)
    {
      other = ManyCorners;
    }
  }
}

/// Sets the roles of all three corners. The triangle's HalfEdges hold the other corners.
/// @returns the number of edges that the triangle leads.
DELAUNAYFLIP_HOST_DEVICE inline int SetRoles(TriangleRecord& triangle, std::int64_t t)
{
  for (int slot = 0; slot < 3; ++slot)
  {
    SetRole(triangle, t, slot, triangle.HalfEdges[slot]);
  }
  return CountLeaders(triangle);
}

}

#endif
