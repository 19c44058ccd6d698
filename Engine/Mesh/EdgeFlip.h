// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEFLIP_H
#define DELAUNAYFLIP_EDGEFLIP_H

#include "EdgeMesh.h"

/// @file
/// The 2-2 flip.

namespace delaunayflip
{

/// The other four edges of a quad, as half-edges on the quad's own side.
struct OuterHalfEdges
{
  HalfEdgeId AP, QA, PB, BQ;
};

/// Reads them from the half-edges of both triangles.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges GetOuterHalfEdges(
  const HalfEdgeId (&upper)[3], int slotA, const HalfEdgeId (&lower)[3], int slotB)
{
  return { GetAt(upper, PreviousSlot(slotA)), GetAt(upper, NextSlot(slotA)),
    GetAt(lower, NextSlot(slotB)), GetAt(lower, PreviousSlot(slotB)) };
}

DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges GetOuterHalfEdges(
  const EdgeMeshView& mesh, CornerId cornerA, CornerId cornerB)
{
  ConstTriangleAccess upper = mesh.Triangles[TriangleOf(cornerA)];
  ConstTriangleAccess lower = mesh.Triangles[TriangleOf(cornerB)];
  return GetOuterHalfEdges(upper.HalfEdges, SlotOf(cornerA), lower.HalfEdges, SlotOf(cornerB));
}

/// A bad edge, with everything that its choice reads except the states of its neighbours.
struct BadEdge
{
  EdgeId Edge;
  CornerPair Corners;
  OuterHalfEdges Outer;
};

/// Writes `vertex` in the place of the one that the flip removes, and the two half-edges that move
/// with it.
DELAUNAYFLIP_HOST_DEVICE inline void ReplaceAfter(
  TriangleRecord& triangle, int slot, VertexId vertex, HalfEdgeId facing, HalfEdgeId diagonal)
{
  SetAt(triangle.Vertices, PreviousSlot(slot), vertex);
  SetAt(triangle.HalfEdges, slot, facing);
  SetAt(triangle.HalfEdges, NextSlot(slot), diagonal);
  triangle.Flips += OneFlip;
}

/*! Flips edge p-q of the quad, which becomes a-b:

             a                      a
           /   \                  / | \
         /   t   \              /   |   \
        p ------- q    ->      p  t | s  q        t = (a, p, q) becomes (a, p, b)
         \   s   /              \   |   /         s = (b, q, p) becomes (b, q, a)
           \   /                  \ | /
             b                      b

    Each triangle keeps two vertices and two edges in their slots; edges p-b and q-a change hands.
    Writes the records of t and s, `upper` and `lower`, and the words of their own four sides,
    nothing else. On a device store(0, t, record) and store(1, s, record) write the records.
    @returns the outer half-edges. Their edges must be judged again. */
template <typename Store>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges FlipEdge(
  const EdgeMeshView& mesh, EdgeId edge, const Quad& quad, TriangleAccess upper,
  TriangleAccess lower, [[maybe_unused]] const Store& store)
{
  const TriangleId t = TriangleOf(quad.CornerA);
  const TriangleId s = TriangleOf(quad.CornerB);
  const int slotA = SlotOf(quad.CornerA);
  const int slotB = SlotOf(quad.CornerB);
  const OuterHalfEdges outer = GetOuterHalfEdges(upper.HalfEdges, slotA, lower.HalfEdges, slotB);

  ReplaceAfter(upper, slotA, quad.B, outer.PB, 2 * edge);
  ReplaceAfter(lower, slotB, quad.A, outer.QA, 2 * edge + 1);
#if DELAUNAYFLIP_ON_DEVICE
  store(0, t, upper);
  store(1, s, lower);
#endif
  mesh.SetCorners(edge, { MakeCorner(t, NextSlot(slotA)), MakeCorner(s, NextSlot(slotB)) });
  mesh.CornerOfHalfEdge[outer.PB] = quad.CornerA;
  mesh.CornerOfHalfEdge[outer.QA] = quad.CornerB;
  return outer;
}

}

#endif
