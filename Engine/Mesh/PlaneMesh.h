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
  /// Whether it is known to be a triangulation: all triangles are counter-clockwise, and none
  /// overlap.
  bool IsTriangulation = false;
  std::int32_t* Failed = nullptr; ///< Set to 1 where a device cannot decide an orientation.
  /// Whether it is known that the filters may be used for all places.
  bool IsInFilterRange = false;

  DELAUNAYFLIP_HOST_DEVICE PlanePoint GetPoint(VertexId vertex) const
  {
    const std::int64_t first = this->Places.Stride * std::int64_t(vertex);
    if (this->Places.Floats)
    {
      const float* place = this->Places.Floats + first;
      return { static_cast<double>(place[0]), static_cast<double>(place[1]), 0.0 };
    }
    const double* place = this->Places.Doubles + first;
    return { place[0], place[1], 0.0 };
  }
  void PrefetchPoint(VertexId vertex) const
  {
    Prefetch(this->Places.GetAddress(this->Places.Stride * vertex));
  }
  DELAUNAYFLIP_HOST_DEVICE bool IsFinite(VertexId vertex) const
  {
    return delaunayflip::IsFinite(this->GetPoint(vertex));
  }

  /// Returns a sign. One that a device could not decide becomes 0 and sets Failed.
  DELAUNAYFLIP_HOST_DEVICE int RequireSign(int sign) const
  {
#if DELAUNAYFLIP_ON_DEVICE
    if (sign == UncertainSign)
    {
      *this->Failed = 1;
      return 0;
    }
#endif
    return sign;
  }

  /// Orientation of the finite points a, b, c, exactly: 1, 0 or -1.
  DELAUNAYFLIP_HOST_DEVICE int FindOrientation(VertexId a, VertexId b, VertexId c) const
  {
    return this->RequireSign(
      delaunayflip::FindOrientation(this->GetPoint(a), this->GetPoint(b), this->GetPoint(c)));
  }

  DELAUNAYFLIP_HOST_DEVICE VertexId GetVertex(CornerId corner) const
  {
    return this->Edges.Triangles[TriangleOf(corner)].Vertices[SlotOf(corner)];
  }
  /// The corner after, or before, in its triangle.
  DELAUNAYFLIP_HOST_DEVICE static CornerId Next(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), NextSlot(SlotOf(corner)));
  }
  DELAUNAYFLIP_HOST_DEVICE static CornerId Previous(CornerId corner)
  {
    return MakeCorner(TriangleOf(corner), PreviousSlot(SlotOf(corner)));
  }
  /// Orientation of the triangle of a corner.
  DELAUNAYFLIP_HOST_DEVICE int FindOrientationAt(CornerId corner) const
  {
    if (this->IsTriangulation)
    {
      return 1;
    }
    return this->FindOrientation(
      this->GetVertex(corner), this->GetVertex(Next(corner)), this->GetVertex(Previous(corner)));
  }

  /// The triangle's side of the edge opposite a corner; it runs from the next vertex to the
  /// previous one.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId GetHalfEdge(CornerId corner) const
  {
    return this->Edges.Triangles[TriangleOf(corner)].HalfEdges[SlotOf(corner)];
  }
  /// Where a half-edge runs from, and to.
  DELAUNAYFLIP_HOST_DEVICE VertexId GetStart(HalfEdgeId halfEdge) const
  {
    return this->GetVertex(Next(this->Edges.CornerOfHalfEdge[halfEdge]));
  }
  DELAUNAYFLIP_HOST_DEVICE VertexId GetEnd(HalfEdgeId halfEdge) const
  {
    return this->GetVertex(Previous(this->Edges.CornerOfHalfEdge[halfEdge]));
  }

  /// The corner opposite a half-edge on its other side; NoCorner where there is no triangle, or one
  /// that runs through the edge the same way.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindAcross(HalfEdgeId halfEdge) const
  {
    const CornerId across = this->Edges.CornerOfHalfEdge[halfEdge ^ 1u];
    if (this->IsTriangulation)
    {
      return across;
    }
    const bool isPair = across != NoCorner &&
      this->GetVertex(Next(across)) == this->GetEnd(halfEdge) &&
      this->GetVertex(Previous(across)) == this->GetStart(halfEdge);
    return isPair ? across : NoCorner;
  }

  /// The corner on the other side of the edge opposite a corner of a triangulation; or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindBeyond(CornerId corner) const
  {
    return this->Edges.CornerOfHalfEdge[this->GetHalfEdge(corner) ^ 1u];
  }

  /// The next corner of the same vertex, in the direction in which triangles run; or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindNextAround(CornerId corner) const
  {
    const CornerId across = this->FindAcross(this->GetHalfEdge(Next(corner)));
    return across == NoCorner ? NoCorner : Next(across);
  }
  /// The corner before it, or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindPreviousAround(CornerId corner) const
  {
    const CornerId across = this->FindAcross(this->GetHalfEdge(Previous(corner)));
    return across == NoCorner ? NoCorner : Previous(across);
  }

  /// The corner opposite the next edge of the hull, counter-clockwise.
  /// @param corner opposite an edge of the hull.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindNextOnHull(CornerId corner) const
  {
    CornerId last = Previous(corner);
    for (CornerId next = last; next != NoCorner; next = this->FindPreviousAround(next))
    {
      last = next;
    }
    return Previous(last);
  }
  /// The corner opposite the edge of the hull before.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindPreviousOnHull(CornerId corner) const
  {
    CornerId last = Next(corner);
    for (CornerId next = last; next != NoCorner; next = this->FindNextAround(next))
    {
      last = next;
    }
    return Next(last);
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsFixed(HalfEdgeId halfEdge) const
  {
    return this->Edges.States[EdgeOf(halfEdge)] == EdgeState::Fixed;
  }
};

}

#endif
