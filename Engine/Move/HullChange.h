// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULLCHANGE_H
#define DELAUNAYFLIP_HULLCHANGE_H

#include "EdgeMesh.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// How the boundary of a triangulation follows points that move. If a point leaves a triangle
/// through its boundary edge, the triangle is cut off. Where the boundary has become concave, a
/// triangle is added. These changes are few, and one thread makes them, one after the other.

namespace delaunayflip
{

constexpr std::uint32_t NoSide = 0xFFFFFFFFu;

/// An edge of the boundary. Its only triangle is on its half-edge 2 * Edge, to the left.
struct BoundarySide
{
  EdgeId Edge;
  std::uint32_t Before, After; ///< The numbers of the previous and the next side.
};

/// A triangle that was cut off, and the last triangle, which has taken its number.
struct CutTriangle
{
  TriangleId Number, Last;
};

/// The sizes of a mesh while one thread changes it.
struct HullSizes
{
  std::int64_t Triangles, Edges, Sides;
  std::int64_t MostSides; ///< The number of sides that there is room for.
  std::int64_t Cuts; ///< How many triangles were cut off.
  std::int32_t HasFailed; ///< 1: there was no room left, or the change is not possible.
};

/// The boundary, and what one thread does to it.
struct HullView
{
  PlaneMesh Mesh;
  BoundarySide* Sides;
  std::uint32_t* SideOfVertex; ///< By vertex, the side that begins there, or NoSide.
  CutTriangle* Cuts; ///< The triangles that were cut off last, in their order. Null: not listed.
  std::int64_t NumberOfCuts;
  /// By edge, its index in Pinned, or NoSide. Null: none is pinned.
  std::uint32_t* PinOf = nullptr;
  HalfEdgeId* Pinned = nullptr; ///< By pinned edge, its half-edge that was even at first.

  /// Whether an edge must stay one, because a segment has become it.
  DELAUNAYFLIP_HOST_DEVICE bool IsPinned(EdgeId edge) const
  {
    return this->PinOf && this->PinOf[edge] != NoSide;
  }

  /// Tells that an edge, perhaps a pinned one, gets another number.
  DELAUNAYFLIP_HOST_DEVICE void MovePin(EdgeId from, EdgeId to) const
  {
    if (this->IsPinned(from))
    {
      const std::uint32_t pin = this->PinOf[from];
      this->PinOf[from] = NoSide;
      this->PinOf[to] = pin;
      this->Pinned[pin] = 2 * to + (this->Pinned[pin] & 1u);
    }
  }

  /// A corner of a vertex that is on the boundary.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindCorner(VertexId vertex) const
  {
    const EdgeId edge = this->Sides[this->SideOfVertex[vertex]].Edge;
    return PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[2 * edge]);
  }

  /// A corner of a vertex. Until the cuts, `before` was one of its corners.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindCorner(VertexId vertex, CornerId before) const
  {
    TriangleId triangle = TriangleOf(before);
    bool isCut = false;
    for (std::int64_t i = 0; i < this->NumberOfCuts && !isCut; ++i)
    {
      isCut = triangle == this->Cuts[i].Number;
      triangle = triangle == this->Cuts[i].Last ? this->Cuts[i].Number : triangle;
    }
    if (!isCut)
    {
      return MakeCorner(triangle, SlotOf(before));
    }
    // All vertices of a triangle that was cut off are now on the boundary.
    return this->FindCorner(vertex);
  }

  DELAUNAYFLIP_HOST_DEVICE VertexId GetStart(const BoundarySide& side) const
  {
    return this->Mesh.GetStart(2 * side.Edge);
  }
  DELAUNAYFLIP_HOST_DEVICE bool IsInside(VertexId vertex) const
  {
    return this->SideOfVertex[vertex] == NoSide;
  }

  /// The orientation of the triangle at a side.
  DELAUNAYFLIP_HOST_DEVICE int FindOrientationAt(const BoundarySide& side) const
  {
    const TriangleRecord& triangle =
      this->Mesh.Edges.Triangles[TriangleOf(this->Mesh.Edges.CornerOfHalfEdge[2 * side.Edge])];
    return this->Mesh.FindOrientation(
      triangle.Vertices[0], triangle.Vertices[1], triangle.Vertices[2]);
  }
  /// Whether the triangle at a side is not counter-clockwise, and its third vertex is inside.
  DELAUNAYFLIP_HOST_DEVICE bool MustCut(const BoundarySide& side) const
  {
    const CornerId corner = this->Mesh.Edges.CornerOfHalfEdge[2 * side.Edge];
    return this->IsInside(this->Mesh.GetVertex(corner)) && this->FindOrientationAt(side) <= 0;
  }

  /// The orientation of the boundary where a side begins: -1 where it is concave.
  DELAUNAYFLIP_HOST_DEVICE int FindTurn(const BoundarySide& side) const
  {
    return this->Mesh.FindOrientation(this->GetStart(this->Sides[side.Before]),
      this->GetStart(side), this->GetStart(this->Sides[side.After]));
  }

  /// Whether a side runs towards larger x or, at equal x, towards larger y.
  DELAUNAYFLIP_HOST_DEVICE bool RunsUp(const BoundarySide& side) const
  {
    const PlanePoint from = this->Mesh.GetPoint(this->GetStart(side));
    const PlanePoint to = this->Mesh.GetPoint(this->GetStart(this->Sides[side.After]));
    return from.U < to.U || (from.U == to.U && from.V < to.V);
  }
  /// Whether a side runs up and the one before it down, or the other way round.
  DELAUNAYFLIP_HOST_DEVICE bool IsReversal(const BoundarySide& side) const
  {
    return this->RunsUp(side) != this->RunsUp(this->Sides[side.Before]);
  }
};

/// Changes the boundary. The mesh and the arrays must have room for that.
class HullEditor
{
public:
  DELAUNAYFLIP_HOST_DEVICE HullEditor(const HullView& hull, HullSizes* sizes)
    : Hull(hull),
      Edges(hull.Mesh.Edges),
      Sizes(*sizes),
      Result(sizes)
  {
  }

  /// Cuts off the triangles at the sides that begin at these vertices, if they must be cut, and
  /// then those that have come to the boundary.
  /// @param pending the vertices, with room for two more per change.
  DELAUNAYFLIP_HOST_DEVICE void CutOff(VertexId* pending, std::int64_t count)
  {
    while (count > 0 && this->Sizes.HasFailed == 0)
    {
      const VertexId start = pending[--count];
      VertexId opposite = NoVertex;
      if (this->CutAt(start, opposite))
      {
        pending[count++] = start;
        pending[count++] = opposite;
      }
    }
    *this->Result = this->Sizes;
  }

  /// Adds triangles until the boundary is concave at none of these vertices, and at none of the
  /// neighbours that new triangles affect.
  DELAUNAYFLIP_HOST_DEVICE void FillUp(VertexId* pending, std::int64_t count)
  {
    while (count > 0 && this->Sizes.HasFailed == 0)
    {
      const VertexId vertex = pending[--count];
      VertexId ends[2];
      if (this->FillAt(vertex, ends))
      {
        pending[count++] = ends[0];
        pending[count++] = ends[1];
      }
    }
    *this->Result = this->Sizes;
  }

protected:
  /// Cuts off the triangle at the side that begins at `start`, if it must be cut.
  /// @returns whether it was.
  DELAUNAYFLIP_HOST_DEVICE bool CutAt(VertexId start, VertexId& opposite)
  {
    const std::uint32_t number = this->Hull.SideOfVertex[start];
    if (!this->Hull.MustCut(this->Hull.Sides[number]))
    {
      return false;
    }
    if (this->Sizes.Sides == this->Sizes.MostSides)
    {
      this->Sizes.HasFailed = 1;
      return false;
    }
    const EdgeId edge = this->Hull.Sides[number].Edge;
    if (this->Hull.IsPinned(edge)) // a point would go through a segment
    {
      this->Sizes.HasFailed = 1;
      return false;
    }
    const CornerId corner = this->Edges.CornerOfHalfEdge[2 * edge];
    const TriangleRecord triangle = this->Edges.Triangles[TriangleOf(corner)];
    const int slot = SlotOf(corner);
    opposite = triangle.Vertices[slot];
    const EdgeId first = this->Expose(triangle.HalfEdges[PreviousSlot(slot)]);
    const EdgeId second = this->Expose(triangle.HalfEdges[NextSlot(slot)]);
    const auto added = static_cast<std::uint32_t>(this->Sizes.Sides++);
    const std::uint32_t after = this->Hull.Sides[number].After;
    this->Hull.Sides[number].Edge = first;
    this->Hull.Sides[number].After = added;
    this->Hull.Sides[added] = { second, number, after };
    this->Hull.Sides[after].Before = added;
    this->Hull.SideOfVertex[opposite] = added;
    this->DropTriangle(TriangleOf(corner));
    this->DropEdge(edge);
    return true;
  }

  /// Makes an edge a boundary edge, because the triangle on this half-edge is cut off.
  DELAUNAYFLIP_HOST_DEVICE EdgeId Expose(HalfEdgeId cut)
  {
    const EdgeId edge = EdgeOf(cut);
    const CornerId left = this->Edges.CornerOfHalfEdge[cut ^ 1u];
    this->Edges.SetCorners(edge, { left, NoCorner });
    this->Edges.Triangles[TriangleOf(left)].HalfEdges[SlotOf(left)] = 2 * edge;
    this->Edges.States[edge] = EdgeState::Fixed;
    if (cut == 2 * edge && this->Hull.IsPinned(edge))
    {
      this->Hull.Pinned[this->Hull.PinOf[edge]] ^= 1u;
    }
    return edge;
  }

  /// Adds a triangle at a vertex if the boundary is concave there. @returns whether it was added.
  DELAUNAYFLIP_HOST_DEVICE bool FillAt(VertexId vertex, VertexId (&ends)[2])
  {
    const std::uint32_t number = this->Hull.SideOfVertex[vertex];
    if (number == NoSide || this->Hull.FindTurn(this->Hull.Sides[number]) >= 0)
    {
      return false;
    }
    if (this->Sizes.Sides <= 3)
    {
      this->Sizes.HasFailed = 1;
      return false;
    }
    const BoundarySide own = this->Hull.Sides[number];
    const EdgeId before = this->Hull.Sides[own.Before].Edge;
    ends[0] = this->Hull.GetStart(this->Hull.Sides[own.Before]);
    ends[1] = this->Hull.GetStart(this->Hull.Sides[own.After]);
    const auto added = static_cast<TriangleId>(this->Sizes.Triangles++);
    const auto edge = static_cast<EdgeId>(this->Sizes.Edges++);
    TriangleRecord triangle{ { ends[0], ends[1], vertex }, added, {}, 0 };
    triangle.HalfEdges[0] = 2 * own.Edge + 1;
    triangle.HalfEdges[1] = 2 * before + 1;
    triangle.HalfEdges[2] = 2 * edge;
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Edges.CornerOfHalfEdge[triangle.HalfEdges[slot]] = MakeCorner(added, slot);
    }
    this->Edges.CornerOfHalfEdge[2 * edge + 1] = NoCorner;
    this->Edges.Triangles[added] = triangle;
    this->Edges.States[edge] = EdgeState::Fixed;
    this->MakeInner(before);
    this->MakeInner(own.Edge);
    this->Hull.Sides[own.Before].Edge = edge;
    this->Hull.Sides[own.Before].After = own.After;
    this->Hull.Sides[own.After].Before = own.Before;
    this->Hull.SideOfVertex[vertex] = NoSide;
    this->DropSide(number);
    return true;
  }

  /// Lets an edge flip that was on the boundary until now, unless it must stay an edge.
  DELAUNAYFLIP_HOST_DEVICE void MakeInner(EdgeId edge) const
  {
    if (!this->Hull.IsPinned(edge))
    {
      this->Edges.States[edge] = EdgeState::Candidate;
    }
  }

  /// Drops a side. The last side takes its number. The next two functions do so with triangles and
  /// edges.
  DELAUNAYFLIP_HOST_DEVICE void DropSide(std::uint32_t number)
  {
    const auto last = static_cast<std::uint32_t>(--this->Sizes.Sides);
    if (last == number)
    {
      return;
    }
    const BoundarySide side = this->Hull.Sides[last];
    this->Hull.Sides[number] = side;
    this->Hull.Sides[side.Before].After = number;
    this->Hull.Sides[side.After].Before = number;
    this->Hull.SideOfVertex[this->Hull.GetStart(side)] = number;
  }

  DELAUNAYFLIP_HOST_DEVICE void DropTriangle(TriangleId number)
  {
    const auto last = static_cast<TriangleId>(--this->Sizes.Triangles);
    if (this->Hull.Cuts)
    {
      this->Hull.Cuts[this->Sizes.Cuts++] = { number, last };
    }
    if (last == number)
    {
      return;
    }
    TriangleRecord triangle = this->Edges.Triangles[last];
    triangle.InputTriangle = number;
    this->Edges.Triangles[number] = triangle;
    for (int slot = 0; slot < 3; ++slot)
    {
      this->Edges.CornerOfHalfEdge[triangle.HalfEdges[slot]] = MakeCorner(number, slot);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void DropEdge(EdgeId number)
  {
    const auto last = static_cast<EdgeId>(--this->Sizes.Edges);
    if (last != number)
    {
      const CornerPair corners = this->Edges.GetCorners(last);
      this->Edges.SetCorners(number, corners);
      this->Edges.States[number] = this->Edges.States[last];
      this->Edges.Triangles[TriangleOf(corners.A)].HalfEdges[SlotOf(corners.A)] = 2 * number;
      if (corners.B != NoCorner)
      {
        this->Edges.Triangles[TriangleOf(corners.B)].HalfEdges[SlotOf(corners.B)] = 2 * number + 1;
      }
      else
      {
        this->Hull.Sides[this->Hull.SideOfVertex[this->Hull.Mesh.GetStart(2 * number)]].Edge =
          number;
      }
      this->Hull.MovePin(last, number);
    }
    this->Edges.States[last] = EdgeState::Fixed; // like all states behind the last edge
  }

  HullView Hull;
  EdgeMeshView Edges;
  HullSizes Sizes;
  HullSizes* Result;
};

}

#endif
