// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTFLIPS_H
#define DELAUNAYFLIP_CONSTRAINTFLIPS_H

#include "Atomics.h"
#include "EdgeFlip.h"
#include "EdgeTable.h"
#include "FlipRules.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// Makes constraints edges of a mesh, by flips of the edges that cross them
/// (Documentation/method.md). For both backends; nothing here needs memory of its own.

namespace delaunayflip
{

/// From vertices to their triangles. A fan is what can be reached around a vertex from triangle to
/// triangle; most vertices have one.
struct VertexFans
{
  CornerId* First; ///< For each fan a corner of its vertex, or NoCorner. Fan v is one of vertex v.
  /// For each fan another one of its vertex, 0 for none. Null if no vertex has several.
  const std::uint32_t* Others = nullptr;

  /// Calls visit(corner) for the corners of a vertex until it returns true.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void Search(
    const PlaneMesh& mesh, VertexId vertex, const Visit& visit) const
  {
    std::uint32_t fan = vertex;
    while (!SearchFan(mesh, AtomicLoad(&this->First[fan]), visit) && this->FindOther(fan) != 0)
    {
      fan = this->FindOther(fan);
    }
  }

  /// Visits the fan of one corner: first what follows it, then what comes before it.
  /// @returns whether a visit returned true.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE static bool SearchFan(
    const PlaneMesh& mesh, CornerId first, const Visit& visit)
  {
    if (first == NoCorner)
    {
      return false;
    }
    CornerId corner = first;
    do
    {
      if (visit(corner))
      {
        return true;
      }
      corner = mesh.FindNextAround(corner);
    } while (corner != NoCorner && corner != first);
    if (corner == first)
    {
      return false;
    }
    for (corner = mesh.FindPreviousAround(first); corner != NoCorner && !visit(corner);)
    {
      corner = mesh.FindPreviousAround(corner);
    }
    return corner != NoCorner;
  }

  /// A flip has taken a corner from a vertex and left it another one of the same fan. Flips
  /// elsewhere may read meanwhile, but only one of them has this corner.
  DELAUNAYFLIP_HOST_DEVICE void Replace(VertexId vertex, CornerId old, CornerId now) const
  {
    std::uint32_t fan = vertex;
    do
    {
      if (AtomicLoad(&this->First[fan]) == old)
      {
        AtomicStore(&this->First[fan], now);
      }
      fan = this->FindOther(fan);
    } while (fan != 0);
  }

private:
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t FindOther(std::uint32_t fan) const
  {
    return this->Others ? this->Others[fan] : 0;
  }
};

enum class PathResult
{
  Found,
  LeavesMesh,
  CrossesFixedEdge,
  Overlaps, ///< Triangles overlap there, or points coincide.
  IsBarred ///< By a triangle without area.
};

/// The path of a constraint through a mesh. It begins at a vertex, and a segment of it ends at each
/// vertex that it meets.
///
/// A flip replaces two triangles by two of the same orientation, and makes no edge that exists. So
/// any mesh stays as valid as it was, and flips for a constraint that cannot be inserted do no
/// harm. Several threads may flip at a time for paths that have no triangle in common.
struct ConstraintPath
{
  const PlaneMesh& Mesh;
  VertexFans Fans;
  const EdgeTableView* Table; ///< The vertex pairs of all edges; null if no flip can make one.
  VertexId From, To;
  std::int64_t Flips = 0;
  TriangleId Bar = NoTriangle; ///< Where the path IsBarred.
  HalfEdgeId Crossed = NoHalfEdge; ///< The edge if it CrossesFixedEdge.

  /// A part of the path from a vertex to the next one on it.
  struct Segment
  {
    PathResult Result;
    VertexId Start = 0, End = 0;
    /// If the segment is an edge, one of its sides. If it crosses triangles, the first edge of
    /// their left or right rim, depending on their orientation: a half-edge of the first triangle.
    /// It runs towards the segment's start, as all half-edges of a rim do.
    HalfEdgeId Side = NoHalfEdge;
    bool IsEdge = false;
    bool IsForward = false; ///< Whether Side is that of an edge and runs along the path.
  };

  /// Calls see(segment) for the segments of the path from start to end, and before each of them
  /// cross(half-edge) for the edges that it crosses. Changes nothing.
  template <typename See, typename Cross>
  DELAUNAYFLIP_HOST_DEVICE PathResult Walk(const See& see, const Cross& cross)
  {
    VertexId at = this->From;
    while (at != this->To)
    {
      const Segment segment = this->FindSegment(at, cross);
      if (segment.Result != PathResult::Found)
      {
        return segment.Result;
      }
      see(segment);
      at = segment.End;
    }
    return PathResult::Found;
  }

  /// Makes a segment one edge. `Side` is then one of its sides.
  /// @returns false where triangles overlap so that it cannot.
  DELAUNAYFLIP_HOST_DEVICE bool Flip(Segment& segment)
  {
    return segment.IsEdge || this->Straighten(segment);
  }

  /// Flips an edge if that is possible.
  DELAUNAYFLIP_HOST_DEVICE bool TryFlip(EdgeId edge)
  {
    const EdgeMeshView& edges = this->Mesh.Edges;
    if (AtomicLoad(&edges.States[edge]) == EdgeState::Fixed)
    {
      return false;
    }
    const Quad quad = edges.GetQuad(edge);
    if (!this->IsConvex(quad))
    {
      return false;
    }
    if (this->Table)
    {
      const std::uint64_t key = EdgeKey(quad.A, quad.B);
      if (this->Table->Find(key) != EdgeTableView::NoSlot || !this->Table->InsertNew(key))
      {
        return false;
      }
      this->Table->Remove(EdgeKey(quad.P, quad.Q));
    }
    const TriangleId triangles[2] = { TriangleOf(quad.CornerA), TriangleOf(quad.CornerB) };
    const OuterHalfEdges outer =
      FlipEdge(edges, edge, quad, edges.Triangles[triangles[0]], edges.Triangles[triangles[1]],
        [&](int, TriangleId triangle, const TriangleRecord& record)
        { edges.Triangles[triangle] = record; });
    this->Fans.Replace(quad.P, PlaneMesh::Previous(quad.CornerB), PlaneMesh::Next(quad.CornerA));
    this->Fans.Replace(quad.Q, PlaneMesh::Previous(quad.CornerA), PlaneMesh::Next(quad.CornerB));
    for (const HalfEdgeId side : { 2 * edge, outer.AP, outer.QA, outer.PB, outer.BQ })
    {
      EdgeState* state = &edges.States[EdgeOf(side)]; // others may make it a candidate, too
      if (AtomicLoad(state) != EdgeState::Fixed)
      {
        AtomicStore(state, EdgeState::Candidate);
      }
    }
    ++this->Flips;
    return true;
  }

private:
  //----------------------------------------------------------------------------
  // The path.

  /// How a path can leave a vertex.
  struct Exits
  {
    HalfEdgeId Along = NoHalfEdge; ///< An edge, to End.
    VertexId End = 0;
    bool IsForward = false;
    CornerId Through = NoCorner; ///< Across the edge opposite this corner.
    int Triangles = 0; ///< How many it can go through.
    TriangleId Bar = NoTriangle;
    VertexId LastVertex = NoVertex; ///< The vertex last examined.
    int SideOfLast = 0; ///< The side on which LastVertex lies.
  };

  /// The side of the constraint on which a vertex lies; 0: on its line.
  DELAUNAYFLIP_HOST_DEVICE int FindSide(VertexId vertex) const
  {
    if (vertex == this->From || vertex == this->To)
    {
      return 0;
    }
    return this->Mesh.FindOrientation(this->From, this->To, vertex);
  }

  /// Whether `b`, a vertex on the line, lies further on than `a`, another one, but not beyond the
  /// end.
  DELAUNAYFLIP_HOST_DEVICE bool IsAhead(VertexId a, VertexId b) const
  {
    const PlanePoint p = this->Mesh.GetPoint(a);
    const PlanePoint q = this->Mesh.GetPoint(b);
    const PlanePoint end = this->Mesh.GetPoint(this->To);
    if (IsLexicographicallyLess(this->Mesh.GetPoint(this->From), end))
    {
      return IsLexicographicallyLess(p, q) && !IsLexicographicallyLess(end, q);
    }
    return IsLexicographicallyLess(q, p) && !IsLexicographicallyLess(q, end);
  }

  DELAUNAYFLIP_HOST_DEVICE Segment Fail(PathResult result, TriangleId bar = NoTriangle)
  {
    this->Bar = bar;
    return { result };
  }

  template <typename Cross>
  DELAUNAYFLIP_HOST_DEVICE Segment FindSegment(VertexId at, const Cross& cross)
  {
    Exits exits;
    this->Fans.Search(this->Mesh, at,
      [&](CornerId corner)
      {
        this->AddExits(corner, exits);
        const bool hasEdge = exits.Along != NoHalfEdge;
        if (this->Mesh.IsTriangulation)
        {
          return hasEdge || exits.Triangles > 0;
        }
        return hasEdge && exits.End == this->To;
      });
    if (exits.Along != NoHalfEdge)
    {
      return { PathResult::Found, at, exits.End, exits.Along, true, exits.IsForward };
    }
    if (exits.Triangles == 1)
    {
      return this->CrossTriangles(at, exits.Through, cross);
    }
    if (exits.Triangles > 1)
    {
      return this->Fail(PathResult::Overlaps);
    }
    if (exits.Bar != NoTriangle)
    {
      return this->Fail(PathResult::IsBarred, exits.Bar);
    }
    return this->Fail(PathResult::LeavesMesh);
  }

  DELAUNAYFLIP_HOST_DEVICE void AddExits(CornerId corner, Exits& exits) const
  {
    const VertexId at = this->Mesh.GetVertex(corner);
    const VertexId next = this->Mesh.GetVertex(PlaneMesh::Next(corner));
    const VertexId previous = this->Mesh.GetVertex(PlaneMesh::Previous(corner));
    if (!this->Mesh.IsTriangulation &&
      !(this->Mesh.IsFinite(next) && this->Mesh.IsFinite(previous)))
    {
      return;
    }
    const bool isKnown = next == exits.LastVertex;
    const int nextSide = isKnown ? exits.SideOfLast : this->FindSide(next);
    const int previousSide = this->FindSide(previous);
    exits.LastVertex = previous;
    exits.SideOfLast = previousSide;
    this->AddEdge(at, next, nextSide, PlaneMesh::Previous(corner), exits);
    this->AddEdge(at, previous, previousSide, PlaneMesh::Next(corner), exits);
    if (nextSide * previousSide < 0)
    {
      const int orientation = this->Mesh.FindOrientationAt(corner);
      if (orientation == 0)
      {
        exits.Bar = TriangleOf(corner);
      }
      else if (orientation == previousSide)
      {
        exits.Through = corner;
        ++exits.Triangles;
      }
    }
  }

  /// Takes the edge to `end` if it leads along the constraint and none leads to a nearer vertex.
  DELAUNAYFLIP_HOST_DEVICE void AddEdge(
    VertexId at, VertexId end, int side, CornerId opposite, Exits& exits) const
  {
    const bool leads = side == 0 && (end == this->To || this->IsAhead(at, end));
    if (leads && (exits.Along == NoHalfEdge || end == this->To || this->IsAhead(end, exits.End)))
    {
      exits.Along = this->Mesh.GetHalfEdge(opposite);
      exits.End = end;
      exits.IsForward = this->Mesh.GetVertex(PlaneMesh::Next(opposite)) == at;
    }
  }

  /// From a vertex through the triangle at its corner to the next vertex on the line.
  template <typename Cross>
  DELAUNAYFLIP_HOST_DEVICE Segment CrossTriangles(VertexId at, CornerId corner, const Cross& cross)
  {
    const int orientation = this->Mesh.FindOrientationAt(corner);
    HalfEdgeId crossed = this->Mesh.GetHalfEdge(corner);
    while (true)
    {
      if (this->Mesh.IsFixed(crossed))
      {
        this->Crossed = crossed;
        const bool isBoundary = this->Mesh.Edges.CornerOfHalfEdge[crossed ^ 1u] == NoCorner;
        return this->Fail(isBoundary ? PathResult::LeavesMesh : PathResult::CrossesFixedEdge);
      }
      cross(crossed);
      const CornerId across = this->Mesh.FindAcross(crossed);
      const int orientationAcross = this->Mesh.FindOrientationAt(across);
      if (orientationAcross == 0)
      {
        return this->Fail(PathResult::IsBarred, TriangleOf(across));
      }
      if (orientationAcross != orientation)
      {
        return this->Fail(PathResult::Overlaps);
      }
      const VertexId vertex = this->Mesh.GetVertex(across);
      const int side = orientation * this->FindSide(vertex);
      if (side == 0 && (vertex == this->To || this->IsAhead(at, vertex)))
      {
        return { PathResult::Found, at, vertex, this->Mesh.GetHalfEdge(PlaneMesh::Next(corner)) };
      }
      if (side == 0)
      {
        return this->Fail(PathResult::Overlaps); // the walk has passed its end in another layer
      }
      const CornerId next = side > 0 ? PlaneMesh::Next(across) : PlaneMesh::Previous(across);
      crossed = this->Mesh.GetHalfEdge(next);
    }
  }

  //----------------------------------------------------------------------------
  // The flips.

  /// Cuts ears off the triangles that a segment crosses until their rim is that segment. A rim that
  /// is not straight always has an ear (Documentation/method.md).
  /// @returns false where triangles overlap so that there is none.
  DELAUNAYFLIP_HOST_DEVICE bool Straighten(Segment& segment)
  {
    const int orientation =
      this->Mesh.FindOrientationAt(this->Mesh.Edges.CornerOfHalfEdge[segment.Side]);
    HalfEdgeId& last = segment.Side;
    while (this->Mesh.GetStart(last) != segment.End)
    {
      HalfEdgeId next = this->FindNextOfRim(last, orientation);
      bool hasBefore = true;
      while (hasBefore && this->IsEar(last, next, orientation))
      {
        if (!this->CutEar(last, next))
        {
          return false;
        }
        // The third side of the ear; the rim goes on along its other side.
        const CornerId corner = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[last]);
        next = this->Mesh.GetHalfEdge(corner) ^ 1u;
        hasBefore = this->Mesh.GetEnd(next) != segment.Start;
        if (hasBefore)
        {
          last = this->FindPreviousOfRim(next, orientation);
        }
      }
      last = next;
    }
    return this->Mesh.GetEnd(last) == segment.Start;
  }

  /// The half-edge of the rim that ends where another one starts: around that vertex, the first
  /// edge that does not lead across the segment.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId FindNextOfRim(HalfEdgeId side, int orientation) const
  {
    CornerId corner = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[side]);
    while (orientation * this->FindSide(this->Mesh.GetVertex(PlaneMesh::Previous(corner))) < 0)
    {
      corner = this->Mesh.FindNextAround(corner);
    }
    return this->Mesh.GetHalfEdge(PlaneMesh::Next(corner));
  }

  /// The half-edge of the rim that starts where another one ends.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId FindPreviousOfRim(HalfEdgeId side, int orientation) const
  {
    CornerId corner = PlaneMesh::Previous(this->Mesh.Edges.CornerOfHalfEdge[side]);
    while (orientation * this->FindSide(this->Mesh.GetVertex(PlaneMesh::Next(corner))) < 0)
    {
      corner = this->Mesh.FindPreviousAround(corner);
    }
    return this->Mesh.GetHalfEdge(PlaneMesh::Previous(corner));
  }

  /// Whether the triangles at the vertex between two half-edges of a rim cover less than half a
  /// circle.
  DELAUNAYFLIP_HOST_DEVICE bool IsEar(HalfEdgeId first, HalfEdgeId second, int orientation) const
  {
    return this->Mesh.FindOrientation(this->Mesh.GetEnd(first), this->Mesh.GetStart(first),
             this->Mesh.GetStart(second)) == -orientation;
  }

  /// Flips edges away from the vertex between two half-edges of a rim, until one triangle is left
  /// there that has both. After a flip the edge before it is tried again.
  DELAUNAYFLIP_HOST_DEVICE bool CutEar(HalfEdgeId first, HalfEdgeId second)
  {
    const auto getStart = [&] { return PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[first]); };
    CornerId corner = getStart();
    HalfEdgeId side = this->Mesh.GetHalfEdge(PlaneMesh::Next(corner));
    while (side != second)
    {
      const bool isFirst = corner == getStart();
      const CornerId before = isFirst ? NoCorner : this->Mesh.FindPreviousAround(corner);
      if (this->TryFlip(EdgeOf(side)))
      {
        corner = before == NoCorner ? getStart() : before;
      }
      else
      {
        corner = this->Mesh.FindNextAround(corner);
        if (corner == NoCorner || corner == getStart())
        {
          return false;
        }
      }
      side = this->Mesh.GetHalfEdge(PlaneMesh::Next(corner));
    }
    return corner == getStart();
  }

  /// Whether both triangles have the same strict orientation after the flip, and before it one of
  /// them has it and the other one not the opposite.
  DELAUNAYFLIP_HOST_DEVICE bool IsConvex(const Quad& quad) const
  {
    int side = 1;
    if (!this->Mesh.IsTriangulation)
    {
      side = JoinOrientations(this->Mesh.FindOrientation(quad.A, quad.P, quad.Q),
        this->Mesh.FindOrientation(quad.B, quad.Q, quad.P));
    }
    return side != 0 && this->Mesh.FindOrientation(quad.A, quad.P, quad.B) == side &&
      this->Mesh.FindOrientation(quad.B, quad.Q, quad.A) == side;
  }
};

}

#endif
