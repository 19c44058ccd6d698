// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OLDPLACE_H
#define DELAUNAYFLIP_OLDPLACE_H

#include "PlaceWalk.h"
#include "RefinementPlan.h"
#include "RefinementView.h"

#include <cstdint>

/// @file
/// Finds the triangle in which a place was before refinement, in a mesh of the caller. Such a mesh
/// may have holes, or cover places twice. So a walk from an arbitrary triangle could end at a
/// boundary, or in another sheet. But every refined triangle lies in the mesh before, and crosses
/// no segment. So the straight line from one of its corners to a place in it lies in that mesh,
/// too.

namespace delaunayflip
{

struct OldPlaceFinder
{
  PlaneMesh Now, Old; ///< The mesh, and the one before refinement.
  const std::uint32_t* SegmentOfEdge; ///< See RefinementView, also for the next one.
  const std::uint32_t* Origins;
  const EdgeId* EdgeOfOrigin; ///< By segment, its edge in the mesh before.
  const CornerId* StartOfVertex; ///< By vertex of the mesh before, one of its corners there.
  const TriangleId* TriangleOfAdded; ///< By added vertex, its triangle in the mesh before.
  VertexId FirstAdded; ///< Vertices from this number on were added.

  /// Finds the triangle of the mesh before that has a place, which is in `triangle` now.
  DELAUNAYFLIP_HOST_DEVICE TriangleId Find(TriangleId triangle, const PlanePoint& place) const
  {
    const CornerId corner = MakeCorner(triangle, 0);
    const VertexId vertex = this->Now.GetVertex(corner);
    CornerId start = this->FindStart(corner);
    if (vertex < this->FirstAdded)
    {
      start = this->TurnTowards(place, start);
    }
    return this->Walk(this->Now.GetPoint(vertex), place, TriangleOf(start));
  }

private:
  /// The number of the segment of which an edge of either mesh is a piece, or NoOrigin. Edges on
  /// segments keep their numbers, and no other edge comes to lie on one.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetOrigin(EdgeId edge) const
  {
    if (this->Now.Edges.States[edge] != EdgeState::Fixed ||
      this->SegmentOfEdge[edge] >= FixedForNow)
    {
      return NoOrigin;
    }
    return this->Origins[this->SegmentOfEdge[edge]];
  }

  /// Finds a corner of the mesh before at the same vertex, or of the triangle in which the vertex
  /// was, on the same side of all segments there.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindStart(CornerId corner) const
  {
    CornerId turned = corner;
    do
    {
      const HalfEdgeId side = this->Now.GetHalfEdge(PlaneMesh::Previous(turned));
      const std::uint32_t origin = this->GetOrigin(EdgeOf(side));
      if (origin != NoOrigin) // half-edges of a segment keep their sides
      {
        const HalfEdgeId before = 2 * this->EdgeOfOrigin[origin] + (side & 1u);
        return PlaneMesh::Next(this->Old.Edges.CornerOfHalfEdge[before]);
      }
      turned = this->Now.FindPreviousAround(turned);
    } while (turned != corner && turned != NoCorner);
    const VertexId vertex = this->Now.GetVertex(corner);
    if (vertex < this->FirstAdded)
    {
      return this->StartOfVertex[vertex];
    }
    return MakeCorner(this->TriangleOfAdded[vertex - this->FirstAdded], 0);
  }

  /// Turns around a vertex, up to the next segment, to the corner with the place in its angle.
  DELAUNAYFLIP_HOST_DEVICE CornerId TurnTowards(const PlanePoint& place, CornerId first) const
  {
    const PlanePoint from = this->Old.GetPoint(this->Old.GetVertex(first));
    CornerId corner = first;
    do
    {
      const PlanePoint right = this->Old.GetPoint(this->Old.GetVertex(PlaneMesh::Next(corner)));
      const PlanePoint left = this->Old.GetPoint(this->Old.GetVertex(PlaneMesh::Previous(corner)));
      const bool isBetween =
        this->FindSign(from, right, place) >= 0 && this->FindSign(from, place, left) >= 0;
      const HalfEdgeId side = this->Old.GetHalfEdge(PlaneMesh::Next(corner));
      if (isBetween)
      {
        return corner;
      }
      if (this->GetOrigin(EdgeOf(side)) != NoOrigin)
      {
        return first; // the place is in that angle except for rounding
      }
      corner = this->Old.FindNextAround(corner);
    } while (corner != first && corner != NoCorner);
    return first;
  }

  /// Follows a straight line without crossing a segment. Each step goes to a triangle with a
  /// smaller power of the place. So the walk ends, even if rounding lets the line begin beside the
  /// triangle.
  DELAUNAYFLIP_HOST_DEVICE TriangleId Walk(
    const PlanePoint& from, const PlanePoint& place, TriangleId triangle) const
  {
    CornerId exit = this->FindExit(from, place, triangle);
    while (exit != NoCorner)
    {
      triangle = TriangleOf(exit);
      exit = this->FindExit(from, place, triangle);
    }
    return triangle;
  }

  /// Finds the corner opposite the edge through which a line leaves a triangle, on the other side
  /// of it; NoCorner if the place is in the triangle.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindExit(
    const PlanePoint& from, const PlanePoint& place, TriangleId triangle) const
  {
    bool isBeyond[3];
    int count = 0, chosen = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerId corner = MakeCorner(triangle, slot);
      const HalfEdgeId side = this->Old.GetHalfEdge(corner);
      isBeyond[slot] =
        this->GetOrigin(EdgeOf(side)) == NoOrigin && FindSide(this->Old, place, corner) < 0;
      count += int(isBeyond[slot]);
      chosen = isBeyond[slot] ? slot : chosen;
    }
    if (count == 0)
    {
      return NoCorner;
    }
    if (count == 2)
    {
      const int firstOrLast = isBeyond[1] ? 0 : 1;
      const int common = isBeyond[0] && isBeyond[1] ? 2 : firstOrLast;
      // Both edges end at this vertex. The edge to its right is opposite the next slot.
      const PlanePoint vertex =
        this->Old.GetPoint(this->Old.GetVertex(MakeCorner(triangle, common)));
      const bool isLeft = this->FindSign(from, place, vertex) >= 0;
      chosen = isLeft ? NextSlot(common) : PreviousSlot(common);
    }
    const HalfEdgeId side = this->Old.GetHalfEdge(MakeCorner(triangle, chosen));
    return this->Old.Edges.CornerOfHalfEdge[side ^ 1u];
  }

  DELAUNAYFLIP_HOST_DEVICE int FindSign(
    const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) const
  {
    return this->Old.RequireSign(FindOrientation(a, b, c));
  }
};

/// Finds the source of a triangle: the triangle before refinement that contains its centroid.
struct SourceStep
{
  OldPlaceFinder Finder;
  const std::int32_t* Regions; ///< By triangle; negative: it is removed, and unchanged.
  std::int64_t OldTriangles; ///< The number of triangles before refinement.
  TriangleId* Sources; ///< By slot.

  DELAUNAYFLIP_HOST_DEVICE void operator()(TriangleId t) const
  {
    const TriangleRecord& triangle = this->Finder.Now.Edges.Triangles[t];
    TriangleId source = t;
    if (!this->IsUnchanged(t))
    {
      const PlanePoint a = this->Finder.Now.GetPoint(triangle.Vertices[0]);
      const PlanePoint b = this->Finder.Now.GetPoint(triangle.Vertices[1]);
      const PlanePoint c = this->Finder.Now.GetPoint(triangle.Vertices[2]);
      const PlanePoint center = { a.U + ((b.U - a.U) + (c.U - a.U)) / 3.0,
        a.V + ((b.V - a.V) + (c.V - a.V)) / 3.0, 0.0 };
      source = this->Finder.Find(t, center);
    }
    this->Sources[triangle.InputTriangle] = this->Finder.Old.Edges.Triangles[source].InputTriangle;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsUnchanged(TriangleId t) const
  {
    if (this->Regions[t] < 0)
    {
      return true;
    }
    if (static_cast<std::int64_t>(t) >= this->OldTriangles)
    {
      return false;
    }
    const VertexId* now = this->Finder.Now.Edges.Triangles[t].Vertices;
    const VertexId* before = this->Finder.Old.Edges.Triangles[t].Vertices;
    return now[0] == before[0] && now[1] == before[1] && now[2] == before[2];
  }
};

}

#endif
