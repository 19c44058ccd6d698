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
  PlaneMesh Now, Old; ///< The mesh after the last round, and the one before refinement.
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
    Sector sector = this->FindSector(corner);
    if (vertex < this->FirstAdded)
    {
      if (sector.First != NoCorner)
      {
        this->CountTurns(corner, sector);
      }
      sector.Start = this->TurnTowards(place, corner, sector);
    }
    return this->Walk(this->Now.GetPoint(vertex), place, TriangleOf(sector.Start));
  }

private:
  /// The triangles between two segments at a vertex. They may turn around it by more than a circle,
  /// if triangles that are turned over lead back. Then several have the same direction.
  struct Sector
  {
    CornerId Start; ///< The rightmost corner of the mesh before.
    CornerId First; ///< The rightmost one now; NoCorner if there are no segments.
    int Turns = 0; ///< How many whole circles there are to the right of a corner.
  };

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

  /// Finds where the sector of a corner begins. Without segments at its vertex, the start is any
  /// corner of the mesh before at the same vertex, or of the triangle in which the vertex was.
  DELAUNAYFLIP_HOST_DEVICE Sector FindSector(CornerId corner) const
  {
    CornerId turned = corner;
    do
    {
      const HalfEdgeId side = this->Now.GetHalfEdge(PlaneMesh::Previous(turned));
      const std::uint32_t origin = this->GetOrigin(EdgeOf(side));
      if (origin != NoOrigin) // half-edges of a segment keep their sides
      {
        const HalfEdgeId before = 2 * this->EdgeOfOrigin[origin] + (side & 1u);
        return { PlaneMesh::Next(this->Old.Edges.CornerOfHalfEdge[before]), turned };
      }
      turned = this->Now.FindPreviousAround(turned);
    } while (turned != corner && turned != NoCorner);
    const VertexId vertex = this->Now.GetVertex(corner);
    if (vertex < this->FirstAdded)
    {
      return { this->StartOfVertex[vertex], NoCorner };
    }
    return { MakeCorner(this->TriangleOfAdded[vertex - this->FirstAdded], 0), NoCorner };
  }

  /// Counts how often the direction of a corner's right edge is passed on the way to it.
  DELAUNAYFLIP_HOST_DEVICE void CountTurns(CornerId corner, Sector& sector) const
  {
    const VertexId end = this->Now.GetVertex(PlaneMesh::Next(corner));
    const PlanePoint from = this->Now.GetPoint(this->Now.GetVertex(corner));
    // The end of the whole segment: rounding turns its pieces a little.
    PlanePoint right = this->Old.GetPoint(this->Old.GetVertex(PlaneMesh::Next(sector.Start)));
    for (CornerId passed = sector.First; passed != corner;
         passed = this->Now.FindNextAround(passed))
    {
      const VertexId next = this->Now.GetVertex(PlaneMesh::Previous(passed));
      const PlanePoint left = this->Now.GetPoint(next);
      const bool hasDirection =
        next != end && this->IsInAngle(from, right, this->Now.GetPoint(end), left);
      sector.Turns += int(hasDirection);
      right = left;
    }
  }

  /// Turns around a vertex, up to the next segment, to the corner with the place in its angle.
  /// @param corner of the vertex now, with the place in its angle.
  DELAUNAYFLIP_HOST_DEVICE CornerId TurnTowards(
    const PlanePoint& place, CornerId corner, const Sector& sector) const
  {
    const PlanePoint from = this->Old.GetPoint(this->Old.GetVertex(sector.Start));
    const PlanePoint along = this->Now.GetPoint(this->Now.GetVertex(PlaneMesh::Next(corner)));
    int turns = sector.Turns;
    bool isInTurn = corner == sector.First || sector.First == NoCorner;
    CornerId turned = sector.Start, first = NoCorner, before = NoCorner;
    do
    {
      const PlanePoint right = this->Old.GetPoint(this->Old.GetVertex(PlaneMesh::Next(turned)));
      const PlanePoint left = this->Old.GetPoint(this->Old.GetVertex(PlaneMesh::Previous(turned)));
      if (!isInTurn && this->IsInAngle(from, right, along, left))
      {
        isInTurn = turns == 0;
        --turns;
        if (isInTurn && this->FindSign(from, along, place) <= 0)
        {
          // The place is on the right side of its angle, or beside it by rounding.
          return before != NoCorner ? before : turned;
        }
      }
      const bool isBetween =
        this->FindSign(from, right, place) >= 0 && this->FindSign(from, place, left) >= 0;
      if (isBetween && isInTurn)
      {
        return turned;
      }
      first = isBetween && first == NoCorner ? turned : first;
      before = isBetween ? turned : NoCorner;
      const HalfEdgeId side = this->Old.GetHalfEdge(PlaneMesh::Next(turned));
      if (this->GetOrigin(EdgeOf(side)) != NoOrigin)
      {
        break; // the place is in an angle here except for rounding
      }
      turned = this->Old.FindNextAround(turned);
    } while (turned != sector.Start && turned != NoCorner);
    return first != NoCorner ? first : sector.Start;
  }

  /// Whether a direction is in an angle, but not on its left side.
  DELAUNAYFLIP_HOST_DEVICE bool IsInAngle(const PlanePoint& from, const PlanePoint& right,
    const PlanePoint& direction, const PlanePoint& left) const
  {
    return this->FindSign(from, right, direction) >= 0 && this->FindSign(from, direction, left) > 0;
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
  EdgeMeshView Mesh; ///< Finder.Now, or that mesh after flips of edges that were fixed meanwhile.
  const std::int32_t* Regions; ///< By triangle; negative: it is removed, and unchanged.
  std::int64_t OldTriangles; ///< The number of triangles before refinement.
  TriangleId* Sources; ///< By slot.

  DELAUNAYFLIP_HOST_DEVICE void operator()(TriangleId t) const
  {
    const TriangleRecord& triangle = this->Mesh.Triangles[t];
    TriangleId source = t;
    if (triangle.Flips != this->Finder.Now.Edges.Triangles[t].Flips)
    {
      source = this->FindBeforeFlips(t, this->FindCenter(triangle));
    }
    if (!this->IsUnchanged(source))
    {
      source = this->Finder.Find(source, this->FindCenter(triangle));
    }
    this->Sources[triangle.InputTriangle] = this->Finder.Old.Edges.Triangles[source].InputTriangle;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE PlanePoint FindCenter(const TriangleRecord& triangle) const
  {
    const PlanePoint a = this->Finder.Now.GetPoint(triangle.Vertices[0]);
    const PlanePoint b = this->Finder.Now.GetPoint(triangle.Vertices[1]);
    const PlanePoint c = this->Finder.Now.GetPoint(triangle.Vertices[2]);
    return { a.U + ((b.U - a.U) + (c.U - a.U)) / 3.0, a.V + ((b.V - a.V) + (c.V - a.V)) / 3.0,
      0.0 };
  }

  /// Finds the triangle that had a place before the last flips, near a triangle that has flipped.
  DELAUNAYFLIP_HOST_DEVICE TriangleId FindBeforeFlips(
    TriangleId triangle, const PlanePoint& place) const
  {
    constexpr int MostSteps = 32; // flips are few, so that only a loop takes more
    for (int step = 0; step < MostSteps; ++step)
    {
      TriangleId next = NoTriangle;
      for (int slot = 0; slot < 3 && next == NoTriangle; ++slot)
      {
        const HalfEdgeId side = this->Finder.Now.GetHalfEdge(MakeCorner(triangle, slot));
        const CornerId across = this->Finder.Now.Edges.CornerOfHalfEdge[side ^ 1u];
        const bool isOpen = across != NoCorner && this->Regions[TriangleOf(across)] >= 0 &&
          this->Mesh.States[EdgeOf(side)] != EdgeState::Fixed;
        const bool isBeyond = isOpen &&
          (this->Regions[triangle] < 0 ||
            FindSide(this->Finder.Now, place, MakeCorner(triangle, slot)) < 0);
        next = isBeyond ? TriangleOf(across) : NoTriangle;
      }
      if (next == NoTriangle)
      {
        return triangle;
      }
      triangle = next;
    }
    return triangle;
  }

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
