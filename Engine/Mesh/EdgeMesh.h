// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESH_H
#define DELAUNAYFLIP_EDGEMESH_H

#include "Array.h"
#include "HostDevice.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

/// @file
/// The paper's arrays (Sec. 2: Triangles, Edges, Opposites) in half-edge form.
///
/// Edge e has two sides, the half-edges 2 e and 2 e + 1. A half-edge's word in CornerOfHalfEdge
/// names a corner, 4 * triangle + slot: the triangle on that side and the slot of its vertex
/// opposite the edge. So one word says what the paper keeps in a pair of Edges (ta or tb) and an
/// entry of Opposites, and the end vertices are the triangle's other two.
///
/// A word belongs to the triangle that it names: a flip that owns its two triangles writes the
/// words of their outer edges on its own side and never reads the far side's. So flips of disjoint
/// triangle pairs race nowhere, and the repair that the paper needs (Sec. 3.2) has nothing to do.

namespace delaunayflip
{

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;
using EdgeId = std::uint32_t;
using HalfEdgeId = std::uint32_t;
using CornerId = std::uint32_t;

/// No corner: the far side of a boundary edge, or of one incident triangle of a non-manifold edge.
constexpr CornerId NoCorner = 0xFFFFFFFFu;

constexpr VertexId NoVertex = 0xFFFFFFFFu;
constexpr EdgeId NoEdge = 0xFFFFFFFFu;
constexpr TriangleId NoTriangle = 0xFFFFFFFFu;

/// What the loop knows about an edge. Between iterations an edge is Good, Fixed, Candidate, Bad or
/// blocked.
enum class EdgeState : std::uint8_t
{
  Good, ///< Locally Delaunay.
  Fixed, ///< Never flips, never judged.
  Deferred, ///< Between chunks while iterations run within them; a candidate afterwards.
  BlockedByDeviation, ///< Bad, but the flip would move the surface too far.
  BlockedByShape, ///< Bad, but the flip would fold the mesh over.
  BlockedByEdge, ///< Bad, but the new edge already exists. May become free when others flip.
  Bad, ///< Violates the criterion and may flip.
  Excluded, ///< A bad edge next to one that has flipped, while other edges still choose.
  Candidate, ///< To be judged: new, or an incident triangle changed.
  Uncertain ///< The filter could not decide; exact arithmetic must.
};

/// States from the first to the last.
struct StateRange
{
  EdgeState First;
  EdgeState Last;
};

/// Bad or Excluded.
inline bool WasBad(EdgeState state)
{
  static_assert(static_cast<int>(EdgeState::Bad) == 6 && static_cast<int>(EdgeState::Excluded) == 7,
    "equal but for the last bit");
  return static_cast<int>(state) >> 1 == 3;
}

/// Next and previous slot of a triangle, from a table of two-bit entries: a branch would be
/// mispredicted half of the time, which costs more than all the rest of reading a quad.
DELAUNAYFLIP_HOST_DEVICE inline int NextSlot(int slot) { return (0x09 >> (2 * slot)) & 3; }
DELAUNAYFLIP_HOST_DEVICE inline int PreviousSlot(int slot) { return (0x12 >> (2 * slot)) & 3; }

DELAUNAYFLIP_HOST_DEVICE inline CornerId MakeCorner(TriangleId triangle, int slot)
{
  return 4 * triangle + static_cast<CornerId>(slot);
}
DELAUNAYFLIP_HOST_DEVICE inline TriangleId TriangleOf(CornerId corner) { return corner >> 2; }
DELAUNAYFLIP_HOST_DEVICE inline int SlotOf(CornerId corner) { return static_cast<int>(corner & 3); }
DELAUNAYFLIP_HOST_DEVICE inline EdgeId EdgeOf(HalfEdgeId halfEdge) { return halfEdge >> 1; }

/// A triangle in one aligned 32-byte sector: two words of 16 bytes, as GPUs load them.
struct alignas(32) TriangleRecord
{
  VertexId Vertices[3];
  TriangleId InputTriangle; ///< The caller's slot.
  HalfEdgeId HalfEdges[3]; ///< This triangle's side of the edge opposite each slot.
  std::uint32_t Flips; ///< In how many flips it took part, times OneFlip, and the builder's marks.
};

/// Flips are counted above seven bits of marks (EdgeTable.h).
constexpr std::uint32_t OneFlip = 1u << 7;

/// The value at a slot. A device keeps what it loaded in registers, which have no index.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t GetAt(const std::uint32_t (&values)[3], int slot)
{
#if DELAUNAYFLIP_ON_DEVICE
  const std::uint32_t firstOrSecond = slot == 0 ? values[0] : values[1];
  return slot == 2 ? values[2] : firstOrSecond;
#else
  return values[slot];
#endif
}
DELAUNAYFLIP_HOST_DEVICE inline void SetAt(
  std::uint32_t (&values)[3], int slot, std::uint32_t value)
{
#if DELAUNAYFLIP_ON_DEVICE
  values[0] = slot == 0 ? value : values[0];
  values[1] = slot == 1 ? value : values[1];
  values[2] = slot == 2 ? value : values[2];
#else
  values[slot] = value;
#endif
}

/// A triangle to read, or to change and write back: on a device a copy in registers, else the
/// record itself.
#if DELAUNAYFLIP_ON_DEVICE
using TriangleAccess = TriangleRecord;
using ConstTriangleAccess = const TriangleRecord;
#else
using TriangleAccess = TriangleRecord&;
using ConstTriangleAccess = const TriangleRecord&;
#endif

/// The two words of an edge.
struct alignas(8) CornerPair
{
  CornerId A, B;
};

/// An edge that a segment has become, after points were moved or removed.
struct PinnedEdge
{
  HalfEdgeId Side; ///< What its even half-edge has become.
  std::uint32_t IsOnHull; ///< Whether it has only one triangle, which is on the even half-edge.
};

/// The quadrilateral around an edge of two triangles, every index named (see EdgeFlip.h's picture).
struct Quad
{
  CornerId CornerA, CornerB; ///< Opposite corners: a in triangle (a, p, q), b in (b, q, p).
  VertexId A, P, Q, B; ///< The edge runs from p to q in a's triangle.
};

/// Two coordinates, which a device loads with one instruction.
template <typename Real>
struct alignas(2 * sizeof(Real)) CoordinatePair
{
  Real U, V;
};

/// Plain pointers to an EdgeMesh, for functions of both backends.
struct EdgeMeshView
{
  TriangleRecord* Triangles;
  CornerId* CornerOfHalfEdge;
  EdgeState* States;

  DELAUNAYFLIP_HOST_DEVICE CornerPair GetCorners(EdgeId edge) const
  {
#if DELAUNAYFLIP_ON_DEVICE
    return reinterpret_cast<const CornerPair*>(this->CornerOfHalfEdge)[edge];
#else
    const CornerId* corners = &this->CornerOfHalfEdge[std::size_t(2) * edge];
    return { corners[0], corners[1] };
#endif
  }

  DELAUNAYFLIP_HOST_DEVICE void SetCorners(EdgeId edge, const CornerPair& corners) const
  {
#if DELAUNAYFLIP_ON_DEVICE
    reinterpret_cast<CornerPair*>(this->CornerOfHalfEdge)[edge] = corners;
#else
    CornerId* stored = &this->CornerOfHalfEdge[std::size_t(2) * edge];
    stored[0] = corners.A;
    stored[1] = corners.B;
#endif
  }

  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE Quad GetQuad(EdgeId edge) const
  {
    return this->GetQuad(this->GetCorners(edge));
  }
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE Quad GetQuad(const CornerPair& corners) const
  {
    Quad quad;
    quad.CornerA = corners.A;
    quad.CornerB = corners.B;
    ConstTriangleAccess triangle = this->Triangles[TriangleOf(corners.A)];
    const int slot = SlotOf(corners.A);
    quad.A = GetAt(triangle.Vertices, slot);
    quad.P = GetAt(triangle.Vertices, NextSlot(slot));
    quad.Q = GetAt(triangle.Vertices, PreviousSlot(slot));
    quad.B = this->Triangles[TriangleOf(corners.B)].Vertices[SlotOf(corners.B)];
    return quad;
  }
};

/// Prefetches both triangles of an edge; for a missing one, an address that no thread
/// reads.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE void PrefetchTriangles(
  const EdgeMeshView& mesh, EdgeId edge)
{
  const CornerPair corners = mesh.GetCorners(edge);
  Prefetch(&mesh.Triangles[TriangleOf(corners.A)]);
  Prefetch(&mesh.Triangles[TriangleOf(corners.B)]);
}

/// The arrays, owned. NumberOfEdges counts records: an edge of k >= 3 triangles has k records, each
/// with one side and Fixed.
struct EdgeMesh
{
  /// How many states are searched at a time.
  static constexpr std::int64_t StatePadding = 64;

  std::int64_t NumberOfTriangles = 0;
  std::int64_t NumberOfEdges = 0;
  Array<TriangleRecord> Triangles;
  Array<CornerId> CornerOfHalfEdge;
  /// Padded with Fixed to a multiple of StatePadding. Empty for points on a device, unless segments
  /// are inserted: the edges with one triangle are Fixed.
  Array<EdgeState> States;

  EdgeMeshView View()
  {
    return { this->Triangles.Data(), this->CornerOfHalfEdge.Data(), this->States.Data() };
  }
};

//------------------------------------------------------------------------------
// The invariants of an edge mesh.

/// Checks an edge. @returns by the sum: how many sides it has, or -1 if it is broken.
struct AuditStep
{
  const TriangleRecord* Triangles;
  const CornerId* CornerOfHalfEdge;
  const EdgeState* States;
  std::int64_t NumberOfTriangles;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t e, std::int64_t& sum) const
  {
    const CornerId* corners = &this->CornerOfHalfEdge[2 * e];
    const int sides = 1 + int(corners[1] != NoCorner);
    const bool isFixed = this->IsFixed(e, sides);
    bool isSound = sides == 2 || isFixed;
    VertexId found[2][3]; // the opposite vertex, and the ends in the direction of the triangle
    for (int side = 0; side < sides && isSound; ++side)
    {
      const std::int64_t triangle = TriangleOf(corners[side]);
      const int slot = SlotOf(corners[side]);
      isSound = triangle < this->NumberOfTriangles && slot < 3 &&
        this->Triangles[triangle].HalfEdges[slot] == 2 * e + side;
      for (int i = 0; i < 3 && isSound; ++i)
      {
        found[side][i] = this->Triangles[triangle].Vertices[(slot + i) % 3];
      }
    }
    if (sides == 2 && isSound)
    {
      const bool opposed = found[0][1] == found[1][2] && found[0][2] == found[1][1];
      const bool alike = found[0][1] == found[1][1] && found[0][2] == found[1][2];
      const bool mayFlip = opposed && found[0][0] != found[1][0];
      isSound = mayFlip || (isFixed && (opposed || alike));
    }
    sum += isSound ? sides : -1;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsFixed(std::int64_t e, int sides) const
  {
    if (this->States)
    {
      return this->States[e] == EdgeState::Fixed;
    }
    return sides == 1;
  }
};

/// Counts what breaks the adjacency: a corner and its half-edge do not name each other, an id is
/// out of range, the two sides of an edge have different end vertices, or, unless the edge is
/// Fixed, they run the same way or face the same vertex. 0 for a consistent mesh.
template <typename Backend>
std::int64_t CountInconsistencies(const EdgeMesh& mesh, const Backend& backend)
{
  // Two half-edges that name the same corner cannot both be named by it.
  return 3 * mesh.NumberOfTriangles -
    backend.template Sum<std::int64_t>(mesh.NumberOfEdges,
      AuditStep{ mesh.Triangles.Data(), mesh.CornerOfHalfEdge.Data(), mesh.States.Data(),
        mesh.NumberOfTriangles });
}

/// Throws std::logic_error if CountInconsistencies is not 0, which is a bug of the engine.
template <typename Backend>
void RequireConsistent(const EdgeMesh& mesh, const Backend& backend)
{
  const std::int64_t count = CountInconsistencies(mesh, backend);
  if (count > 0)
  {
    throw std::logic_error("the edge mesh broke: " + std::to_string(count) +
      " half-edges are inconsistent; please report this with the mesh");
  }
}

}

#endif
