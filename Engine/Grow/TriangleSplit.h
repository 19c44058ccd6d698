// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLESPLIT_H
#define DELAUNAYFLIP_TRIANGLESPLIT_H

#include "Atomics.h"
#include "PlaceWalk.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// How a new vertex splits what it lies in. In a triangle a, b, c it makes three: each has the new
/// vertex in place of one of the old ones. On an edge it makes two of each triangle at the edge: of
/// a, b, c with the edge a-b the triangles a, v, c and v, b, c.
///
/// A new vertex owns the triangles that it splits: no other one splits them at the same time. It
/// writes the words of their outer edges on their own side, so vertices in neighbouring triangles
/// do not race.

namespace delaunayflip
{

/// A new vertex, and where it is.
struct NewVertex
{
  VertexId Vertex;
  FoundPlace Place; ///< In a triangle or inside of an edge.
  TriangleId FirstTriangle; ///< The first number for what it adds.
  EdgeId FirstEdge;
};

/// Splits triangles of an edge mesh that has room for what is added.
class TriangleSplitter
{
public:
  DELAUNAYFLIP_HOST_DEVICE explicit TriangleSplitter(const EdgeMeshView& mesh)
    : Mesh(mesh)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE const EdgeMeshView& GetMesh() const { return this->Mesh; }

  /// The triangle on the other side of the edge that a place is inside of, or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindAcross(const FoundPlace& place) const
  {
    const TriangleRecord& triangle = this->Mesh.Triangles[place.Triangle];
    return this->Mesh.CornerOfHalfEdge[triangle.HalfEdges[place.FindEdgeSlot()] ^ 1u];
  }

  /// Whether a place splits an edge of the boundary.
  DELAUNAYFLIP_HOST_DEVICE bool IsOnBoundary(const FoundPlace& place) const
  {
    return place.FindEdgeSlot() >= 0 && this->FindAcross(place) == NoCorner;
  }

  /// Edges of the triangles that are split become candidates, except fixed ones. The new edges are
  /// good: the new vertex is inside of the triangle, or on an edge that was good. Only a vertex
  /// that splits a fixed edge may, by rounding, lie beside that edge.
  DELAUNAYFLIP_HOST_DEVICE void Split(const NewVertex& vertex) const
  {
    if (vertex.Place.FindEdgeSlot() >= 0)
    {
      this->SplitEdge(vertex);
    }
    else
    {
      this->SplitTriangle(vertex);
    }
  }

  /// Splits an edge by a vertex that is not on it but inside of the place's triangle. The halves of
  /// the edge run to that vertex. A new triangle fills the gap between them and the triangle on the
  /// other side, which keeps its shape.
  DELAUNAYFLIP_HOST_DEVICE void SplitBeside(const NewVertex& vertex) const
  {
    const CornerId corner = MakeCorner(vertex.Place.Triangle, vertex.Place.FindEdgeSlot());
    const TriangleRecord old = this->Mesh.Triangles[TriangleOf(corner)];
    const HalfEdgeId near = old.HalfEdges[SlotOf(corner)];
    const CornerId across = this->Mesh.CornerOfHalfEdge[near ^ 1u];
    const EdgeId other = vertex.FirstEdge; // the other half of the edge
    const EdgeId outer = vertex.FirstEdge + 2; // between the new triangle and the one across
    const TriangleId filling = vertex.FirstTriangle + 1;
    const std::uint32_t side = near & 1u;
    this->Mesh.States[other] = this->Mesh.States[EdgeOf(near)];
    this->Mesh.States[outer] = EdgeState::Candidate;
    this->SplitHalf(
      corner, vertex, { near, 2 * other + side, vertex.FirstEdge + 1 }, vertex.FirstTriangle);
    TriangleRecord filled = old;
    filled.InputTriangle = filling;
    filled.Flips = 0;
    filled.Vertices[0] = vertex.Vertex;
    filled.Vertices[1] = old.Vertices[NextSlot(SlotOf(corner))];
    filled.Vertices[2] = old.Vertices[PreviousSlot(SlotOf(corner))];
    filled.HalfEdges[0] = this->JoinSide(outer, side, filling, 0);
    filled.HalfEdges[1] = this->JoinSide(other, side ^ 1u, filling, 1);
    filled.HalfEdges[2] = this->Join(near ^ 1u, filling, 2);
    this->Mesh.Triangles[filling] = filled;
    this->Mesh.Triangles[TriangleOf(across)].HalfEdges[SlotOf(across)] =
      this->JoinSide(outer, side ^ 1u, TriangleOf(across), SlotOf(across));
  }

private:
  /// Triangle i of three has the new vertex in place of the old triangle's vertex i.
  DELAUNAYFLIP_HOST_DEVICE void SplitTriangle(const NewVertex& vertex) const
  {
    const TriangleRecord old = this->Mesh.Triangles[vertex.Place.Triangle];
    const TriangleId made[3] = { vertex.Place.Triangle, vertex.FirstTriangle,
      vertex.FirstTriangle + 1 };
    for (int i = 0; i < 3; ++i)
    {
      const int next = NextSlot(i), previous = PreviousSlot(i);
      // Edge k runs between the new vertex and the old triangle's vertex k.
      TriangleRecord triangle = old;
      triangle.InputTriangle = i == 0 ? old.InputTriangle : made[i];
      triangle.Flips = i == 0 ? old.Flips : 0;
      triangle.Vertices[i] = vertex.Vertex;
      triangle.HalfEdges[next] = this->JoinSide(vertex.FirstEdge + previous, 0, made[i], next);
      triangle.HalfEdges[previous] = this->JoinSide(vertex.FirstEdge + next, 1, made[i], previous);
      this->Mesh.CornerOfHalfEdge[old.HalfEdges[i]] = MakeCorner(made[i], i);
      this->Mesh.Triangles[made[i]] = triangle;
      this->Mesh.States[vertex.FirstEdge + i] = EdgeState::Good;
      this->Judge(old.HalfEdges[i]);
    }
  }

  /// The record of the edge becomes that of one half: the half at the vertex that comes next after
  /// the opposite corner in the place's triangle.
  DELAUNAYFLIP_HOST_DEVICE void SplitEdge(const NewVertex& vertex) const
  {
    const CornerId corner = MakeCorner(vertex.Place.Triangle, vertex.Place.FindEdgeSlot());
    const HalfEdgeId near = this->Mesh.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)];
    const CornerId across = this->Mesh.CornerOfHalfEdge[near ^ 1u];
    const EdgeId other = vertex.FirstEdge; // the other half of the edge
    const EdgeState state = this->Mesh.States[EdgeOf(near)];
    this->Mesh.States[other] = state;
    // Each side keeps its number: 0 or 1.
    const std::uint32_t side = near & 1u;
    this->SplitHalf(
      corner, vertex, { near, 2 * other + side, vertex.FirstEdge + 1 }, vertex.FirstTriangle);
    if (across == NoCorner)
    {
      this->Mesh.CornerOfHalfEdge[2 * other + (side ^ 1u)] = NoCorner;
      return;
    }
    this->SplitHalf(across, vertex, { 2 * other + (side ^ 1u), near ^ 1u, vertex.FirstEdge + 2 },
      vertex.FirstTriangle + 1);
  }

  /// The edges that a triangle on one side of a split edge gets.
  struct HalfEdgesOfSide
  {
    HalfEdgeId First; ///< From the vertex that comes next after the opposite corner.
    HalfEdgeId Second; ///< To the one before the opposite corner.
    EdgeId Middle; ///< Between the new vertex and the opposite corner.
  };

  /// Splits the triangle on one side of an edge.
  DELAUNAYFLIP_HOST_DEVICE void SplitHalf(CornerId opposite, const NewVertex& vertex,
    const HalfEdgesOfSide& sides, TriangleId added) const
  {
    const TriangleId kept = TriangleOf(opposite);
    const TriangleRecord old = this->Mesh.Triangles[kept];
    const int slot = SlotOf(opposite), next = NextSlot(slot), previous = PreviousSlot(slot);
    TriangleRecord first = old; // the opposite corner, the next vertex and the new one
    first.Vertices[previous] = vertex.Vertex;
    first.HalfEdges[slot] = this->Join(sides.First, kept, slot);
    first.HalfEdges[next] = this->JoinSide(sides.Middle, 0, kept, next);
    TriangleRecord second = old; // the opposite corner, the new vertex and the one before
    second.InputTriangle = added;
    second.Flips = 0;
    second.Vertices[next] = vertex.Vertex;
    second.HalfEdges[slot] = this->Join(sides.Second, added, slot);
    second.HalfEdges[previous] = this->JoinSide(sides.Middle, 1, added, previous);
    this->Join(old.HalfEdges[next], added, next);
    this->Mesh.Triangles[kept] = first;
    this->Mesh.Triangles[added] = second;
    const bool isFixed = this->Mesh.States[EdgeOf(sides.First)] == EdgeState::Fixed;
    this->Mesh.States[sides.Middle] = isFixed ? EdgeState::Candidate : EdgeState::Good;
    this->Judge(old.HalfEdges[next]);
    this->Judge(old.HalfEdges[previous]);
  }

  /// Makes a half-edge name a corner. @returns the half-edge.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId Join(HalfEdgeId halfEdge, TriangleId triangle, int slot) const
  {
    this->Mesh.CornerOfHalfEdge[halfEdge] = MakeCorner(triangle, slot);
    return halfEdge;
  }
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId JoinSide(
    EdgeId edge, std::uint32_t side, TriangleId triangle, int slot) const
  {
    return this->Join(2 * edge + side, triangle, slot);
  }

  /// Another new vertex may do the same.
  DELAUNAYFLIP_HOST_DEVICE void Judge(HalfEdgeId halfEdge) const
  {
    EdgeState* state = &this->Mesh.States[EdgeOf(halfEdge)];
    if (AtomicLoad(state) != EdgeState::Fixed)
    {
      AtomicStore(state, EdgeState::Candidate);
    }
  }

  EdgeMeshView Mesh;
};

}

#endif
