// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OLDPLACE_H
#define DELAUNAYFLIP_OLDPLACE_H

#include "PlaceWalk.h"
#include "RefinementPlan.h"
#include "RefinementView.h"

#include <cstdint>

/// @file
/// Finds where places of a mesh of the caller were before refinement. Such a mesh may have holes,
/// or cover places twice, so a walk from anywhere could end at a boundary or in another sheet. But
/// a triangle of the refined mesh is part of the one before, and crosses no segment. So the
/// straight line from one of its corners to a place in it is in that mesh, too.

namespace delaunayflip
{

struct OldPlaceFinder
{
  PlaneMesh Now, Old; ///< The mesh, and the one before refinement.
  const std::uint32_t* SegmentOfEdge; ///< As in RefinementView, and the next one.
  const std::uint32_t* Origins;
  const EdgeId* EdgeOfOrigin; ///< By segment, what it was at first.
  const CornerId* StartOfVertex; ///< By vertex before refinement, one of its corners there.
  const TriangleId* TriangleOfAdded; ///< By vertex that was added, where it was.
  VertexId FirstAdded; ///< Vertices from here on were added.

  /// @returns the triangle, before refinement, of a place that is in a triangle now.
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
  /// The number of the segment that an edge is, or was, a piece of; or NoOrigin. Segments keep
  /// their numbers of edges, and no other edge becomes one.
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetOrigin(EdgeId edge) const
  {
    if (this->Now.Edges.States[edge] != EdgeState::Fixed ||
      this->SegmentOfEdge[edge] >= FixedForNow)
    {
      return NoOrigin;
    }
    return this->Origins[this->SegmentOfEdge[edge]];
  }

  /// A corner, before refinement, on the same side of all segments at its vertex.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindStart(CornerId corner) const
  {
    CornerId turned = corner;
    do
    {
      const HalfEdgeId side = this->Now.GetHalfEdge(PlaneMesh::Previous(turned));
      const std::uint32_t origin = this->GetOrigin(EdgeOf(side));
      if (origin != NoOrigin) // its sides have kept their numbers
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

  /// Turns around a vertex, up to the next segment, to the corner that looks at a place.
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
        return first; // the place is there but for rounding
      }
      corner = this->Old.FindNextAround(corner);
    } while (corner != first && corner != NoCorner);
    return first;
  }

  /// Follows a straight line, but not across a segment. Every step is to a triangle whose
  /// circumcircle is nearer to the place, so this ends even where the line begins beside the
  /// triangle because of rounding.
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

  /// The corner across the edge through which a line leaves a triangle, or NoCorner.
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
      // Both edges end at this vertex. The one to the right of it is opposite the next slot.
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

/// Finds the triangle, before refinement, that has the centroid of a triangle.
struct SourceStep
{
  OldPlaceFinder Finder;
  const std::int32_t* Regions; ///< By triangle, -1: it has not changed.
  std::int64_t OldTriangles; ///< How many there were.
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
