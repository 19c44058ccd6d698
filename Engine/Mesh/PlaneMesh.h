// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANEMESH_H
#define DELAUNAYFLIP_PLANEMESH_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "TriangleMesh.h"

namespace delaunayflip
{

constexpr HalfEdgeId NoHalfEdge = 0xFFFFFFFFu;

/// An edge mesh of planar geometry with the places of its vertices.
struct PlaneMesh
{
  EdgeMeshView Edges;
  PlaneArray Places;

  PlanePoint GetPoint(VertexId vertex) const
  {
    return { this->Places.Get(vertex, 0), this->Places.Get(vertex, 1), 0.0 };
  }
  bool IsFinite(VertexId vertex) const { return delaunayflip::IsFinite(this->GetPoint(vertex)); }

  /// Turn of a, b, c, exactly: 1, 0 or -1. Of finite points.
  int FindTurn(VertexId a, VertexId b, VertexId c) const
  {
    return FindOrientation(this->GetPoint(a), this->GetPoint(b), this->GetPoint(c));
  }

  VertexId GetVertex(CornerId corner) const
  {
    return this->Edges.Triangles[TriangleOf(corner)].Vertices[SlotOf(corner)];
  }
  /// The corner after, or before, in its triangle.
  static CornerId Next(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), NextSlot(SlotOf(corner)));
  }
  static CornerId Previous(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), PreviousSlot(SlotOf(corner)));
  }
  int FindTurnAt(CornerId corner) const
  {
    return this->FindTurn(
      this->GetVertex(corner), this->GetVertex(Next(corner)), this->GetVertex(Previous(corner)));
  }

  /// The triangle's side of the edge opposite a corner; it runs from the next vertex to the
  /// previous one.
  HalfEdgeId GetHalfEdge(CornerId corner) const
  {
    return this->Edges.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)];
  }
  /// Where a half-edge runs from, and to.
  VertexId GetStart(HalfEdgeId halfEdge) const
  {
    return this->GetVertex(Next(this->Edges.CornerOfHalfEdge[halfEdge]));
  }
  VertexId GetEnd(HalfEdgeId halfEdge) const
  {
    return this->GetVertex(Previous(this->Edges.CornerOfHalfEdge[halfEdge]));
  }

  /// The corner opposite a half-edge on its other side; NoCorner where there is no triangle, or one
  /// that runs through the edge the same way.
  CornerId FindAcross(HalfEdgeId halfEdge) const
  {
    const CornerId across = this->Edges.CornerOfHalfEdge[halfEdge ^ 1u];
    const bool isPair = across != NoCorner &&
      this->GetVertex(Next(across)) == this->GetEnd(halfEdge) &&
      this->GetVertex(Previous(across)) == this->GetStart(halfEdge);
    return isPair ? across : NoCorner;
  }

  /// The next corner of the same vertex, in the direction in which triangles run; or NoCorner.
  CornerId FindNextAround(CornerId corner) const
  {
    const CornerId across = this->FindAcross(this->GetHalfEdge(Next(corner)));
    return across == NoCorner ? NoCorner : Next(across);
  }

  bool IsFixed(HalfEdgeId halfEdge) const
  {
    return this->Edges.States[EdgeOf(halfEdge)] == EdgeState::Fixed;
  }
};

}

#endif
