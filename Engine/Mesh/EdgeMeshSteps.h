// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHSTEPS_H
#define DELAUNAYFLIP_EDGEMESHSTEPS_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "HostDevice.h"

/// @file
/// What the builder does for one corner or edge. Until edges have numbers, a triangle's HalfEdges
/// hold first the table slot of the edge opposite to each corner, then the edge's other corner. Its
/// Flips hold the roles of its corners, two bits each, from then on.

namespace delaunayflip
{

/// Second word of an edge with three or more corners.
constexpr CornerId ManyCorners = 0xFFFFFFFEu;

/// Bit of Flips: no edge of this triangle may flip.
constexpr std::uint32_t UntouchableBit = 1u << 6;

/// The counts of pairing. Loops (IsLoop) are not edges.
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
  OneOfMany ///< Of a non-manifold edge; gets an edge record of its own.
};

DELAUNAYFLIP_HOST_DEVICE inline std::uint64_t KeyOpposite(const TriangleRecord& triangle, int slot)
{
  return EdgeKey(triangle.Vertices[NextSlot(slot)], triangle.Vertices[PreviousSlot(slot)]);
}

/// Whether the edge opposite a slot joins a vertex with itself, in a triangle with a repeated id.
DELAUNAYFLIP_HOST_DEVICE inline bool IsLoop(const TriangleRecord& triangle, int slot)
{
  return triangle.Vertices[NextSlot(slot)] == triangle.Vertices[PreviousSlot(slot)];
}

/// Adds a corner to the table entry of its edge. The first word belongs to the corner that inserted
/// the entry. @returns whether this made the edge non-manifold.
DELAUNAYFLIP_HOST_DEVICE inline bool AttachCorner(
  const EdgeTableView& table, std::uint32_t slot, CornerId corner, bool inserted)
{
  if (inserted)
  {
    table.First[slot] = corner;
    return false;
  }
  return AtomicCompareExchange(&table.Second[slot], NoCorner, corner) != NoCorner &&
    AtomicExchange(&table.Second[slot], ManyCorners) != ManyCorners;
}

/// @param other receives the other corner of an edge with two triangles, else NoCorner.
DELAUNAYFLIP_HOST_DEVICE inline CornerRole FindRole(
  const EdgeTableView& table, std::uint32_t slot, CornerId corner, CornerId& other)
{
  const CornerId first = table.First[slot];
  const CornerId second = table.Second[slot];
  other = NoCorner;
  if (second == NoCorner)
  {
    return CornerRole::Alone;
  }
  if (second == ManyCorners)
  {
    return CornerRole::OneOfMany;
  }
  other = first == corner ? second : first;
  return corner < other ? CornerRole::Leader : CornerRole::Follower;
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
    leaders += GetRole(triangle, slot) == CornerRole::Follower ? 0 : 1;
  }
  return leaders;
}

/// Numbers an edge; `other` is its other corner or NoCorner.
DELAUNAYFLIP_HOST_DEVICE inline void NumberEdge(
  const EdgeMeshView& mesh, CornerId corner, CornerId other, EdgeId edge)
{
  mesh.CornerOfHalfEdge[2 * edge] = corner;
  mesh.CornerOfHalfEdge[2 * edge + 1] = other;
  mesh.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)] = 2 * edge;
  if (other != NoCorner)
  {
    mesh.Triangles[TriangleOf(other)].HalfEdges[SlotOf(other)] = 2 * edge + 1;
  }
}

}

#endif
