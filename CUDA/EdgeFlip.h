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

DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges GetOuterHalfEdges(
  const TriangleRecord& upper, int slotA, const TriangleRecord& lower, int slotB)
{
  return { GetAt(upper.HalfEdges, PreviousSlot(slotA)), GetAt(upper.HalfEdges, NextSlot(slotA)),
    GetAt(lower.HalfEdges, NextSlot(slotB)), GetAt(lower.HalfEdges, PreviousSlot(slotB)) };
}

DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges GetOuterHalfEdges(
  const EdgeMeshView& mesh, CornerId cornerA, CornerId cornerB)
{
  ConstTriangleAccess upper = mesh.Triangles[TriangleOf(cornerA)];
  ConstTriangleAccess lower = mesh.Triangles[TriangleOf(cornerB)];
  return GetOuterHalfEdges(upper, SlotOf(cornerA), lower, SlotOf(cornerB));
}

/// Puts `vertex` where the flip takes one away, and the two half-edges that move with it.
DELAUNAYFLIP_HOST_DEVICE inline void ReplaceAfter(
  TriangleRecord& triangle, int slot, VertexId vertex, HalfEdgeId facing, HalfEdgeId diagonal)
{
  SetAt(triangle.Vertices, PreviousSlot(slot), vertex);
  SetAt(triangle.HalfEdges, slot, facing);
  SetAt(triangle.HalfEdges, NextSlot(slot), diagonal);
  triangle.Flips += OneFlip;
}

/*! Turns edge p-q of the quad into a-b:

             a                      a
           /   \                  / | \
         /   t   \              /   |   \
        p ------- q    ->      p  t | s  q        t = (a, p, q) becomes (a, p, b)
         \   s   /              \   |   /         s = (b, q, p) becomes (b, q, a)
           \   /                  \ | /
             b                      b

    Each triangle keeps two vertices and two edges in their slots; edges p-b and q-a change hands.
    Writes the records of t and s and the words of their own four sides, nothing else. On a device
    store(0, t, record) and store(1, s, record) write the records.
    @returns the outer half-edges, whose edges must be judged again. */
template <typename Store>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE OuterHalfEdges FlipEdge(
  const EdgeMeshView& mesh, EdgeId edge, const Quad& quad, [[maybe_unused]] const Store& store)
{
  const TriangleId t = TriangleOf(quad.CornerA);
  const TriangleId s = TriangleOf(quad.CornerB);
  const int slotA = SlotOf(quad.CornerA);
  const int slotB = SlotOf(quad.CornerB);
  TriangleAccess upper = mesh.Triangles[t];
  TriangleAccess lower = mesh.Triangles[s];
  const OuterHalfEdges outer = GetOuterHalfEdges(upper, slotA, lower, slotB);

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
