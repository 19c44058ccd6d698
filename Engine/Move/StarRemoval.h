// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARREMOVAL_H
#define DELAUNAYFLIP_STARREMOVAL_H

#include "Atomics.h"
#include "EdgeTable.h"
#include "FilteredPredicates.h"
#include "HullChange.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// Removes vertices inside of a triangulation, many at a time. Flips take triangles away from a
/// vertex until it has three, which one triangle replaces. Vertices without a common triangle do
/// not race.

namespace delaunayflip
{

/// What becomes of a vertex to remove.
enum class RemovalState : std::uint32_t
{
  Missing, ///< The point is no vertex.
  Waiting,
  OnHull, ///< Is removed after all others.
  Wins, ///< Is removed in this round.
  Removed,
  Stuck ///< Has too many triangles.
};

/// A vertex to remove.
struct RemovedVertex
{
  VertexId Vertex;
  CornerId Corner; ///< One of its corners.
  CornerId Next; ///< The lowest of its corners in triangles of the last round; or NoCorner.
  RemovalState State;
  // What nothing needs any more after it was removed:
  TriangleId Triangles[2];
  EdgeId Edges[3];
};

/// A round, vertex by vertex. The mesh must be a triangulation.
struct RemovalRound
{
  PlaneMesh Mesh;
  RemovedVertex* Items;
  std::uint32_t* ItemOf; ///< By vertex, its item, or NoSide.
  const std::uint32_t* SideOfVertex; ///< By vertex, NoSide if it is inside.

  /// A vertex wins unless a neighbour has a lower key. Keys are random, so that many win.
  DELAUNAYFLIP_HOST_DEVICE void Choose(std::int64_t i) const
  {
    RemovedVertex& own = this->Items[i];
    if (own.State != RemovalState::Waiting)
    {
      return;
    }
    if (own.Next != NoCorner)
    {
      own.Corner = own.Next;
      own.Next = NoCorner;
    }
    const std::uint32_t key = Scatter(static_cast<std::uint32_t>(i));
    bool wins = true;
    CornerId corner = own.Corner;
    do
    {
      const VertexId other = this->Mesh.GetVertex(PlaneMesh::Next(corner));
      const std::uint32_t item = this->ItemOf[other];
      const bool isLower = item != NoSide && Scatter(item) < key;
      wins = wins && !(isLower && this->SideOfVertex[other] == NoSide);
      corner = this->Mesh.FindNextAround(corner);
    } while (corner != own.Corner);
    if (wins)
    {
      own.State = RemovalState::Wins;
    }
  }

  /// Removes a winner.
  DELAUNAYFLIP_HOST_DEVICE void Remove(std::int64_t i) const
  {
    RemovedVertex& own = this->Items[i];
    CornerId corner = own.Corner;
    int degree = this->CountTriangles(corner);
    own.State = RemovalState::Stuck;
    for (; degree > 3 && degree <= MostTriangles; --degree)
    {
      const CornerId ear = this->FindEar(corner, degree);
      if (ear == NoCorner)
      {
        return;
      }
      this->CutEar(ear);
      corner = this->Mesh.FindNextAround(ear);
    }
    if (degree == 3)
    {
      this->Merge(own, corner);
      own.State = RemovalState::Removed;
    }
  }

private:
  /// With more triangles, the first ear is cut off in place of the best one.
  static constexpr int MostForBest = 24;
  static constexpr int MostTriangles = 1024;

  DELAUNAYFLIP_HOST_DEVICE int CountTriangles(CornerId first) const
  {
    int count = 0;
    CornerId corner = first;
    do
    {
      ++count;
      corner = this->Mesh.FindNextAround(corner);
    } while (corner != first);
    return count;
  }

  /// An ear a, b, c of the polygon around a vertex, which has a corner in a triangle with a and b,
  /// and one in the next with b and c.
  struct Ear
  {
    VertexId A, B, C;
  };

  DELAUNAYFLIP_HOST_DEVICE Ear GetEar(CornerId first, CornerId second) const
  {
    return { this->Mesh.GetVertex(PlaneMesh::Next(first)),
      this->Mesh.GetVertex(PlaneMesh::Previous(first)),
      this->Mesh.GetVertex(PlaneMesh::Previous(second)) };
  }

  /// Finds the ear to cut off: the one that would be the first to violate the criterion if the
  /// vertex moved up from the paraboloid above the plane. Then the other triangles stay Delaunay
  /// (Devillers 1999). Rounding may choose another ear, which flips mend.
  /// @returns the vertex's corner in the first triangle of the ear, or NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindEar(CornerId start, int degree) const
  {
    const VertexId vertex = this->Mesh.GetVertex(start);
    CornerId best = NoCorner;
    double lowest = 0.0;
    CornerId corner = start;
    do
    {
      const CornerId next = this->Mesh.FindNextAround(corner);
      const Ear ear = this->GetEar(corner, next);
      if (this->MayCut(ear, vertex, degree))
      {
        if (degree > MostForBest)
        {
          return corner;
        }
        const double height = this->FindHeight(ear, vertex);
        if (best == NoCorner || height < lowest)
        {
          best = corner;
          lowest = height;
        }
      }
      corner = next;
    } while (corner != start);
    return best;
  }

  /// Whether b is a convex corner, and the vertex is inside of what is left without it. In the end
  /// the vertex may lie between a and c.
  DELAUNAYFLIP_HOST_DEVICE bool MayCut(const Ear& ear, VertexId vertex, int degree) const
  {
    if (this->Mesh.FindOrientation(ear.A, ear.B, ear.C) <= 0)
    {
      return false;
    }
    const int side = this->Mesh.FindOrientation(vertex, ear.A, ear.C);
    return side > 0 || (side == 0 && degree == 4);
  }

  /// The height over the paraboloid of the plane through the lifted corners of an ear, at a vertex.
  DELAUNAYFLIP_HOST_DEVICE double FindHeight(const Ear& ear, VertexId vertex) const
  {
    const PlanePoint a = this->Mesh.GetPoint(ear.A), b = this->Mesh.GetPoint(ear.B),
                     c = this->Mesh.GetPoint(ear.C);
    const double area = (a.U - c.U) * (b.V - c.V) - (a.V - c.V) * (b.U - c.U);
    return InCircleDeterminant(a, b, c, this->Mesh.GetPoint(vertex)).Value / area;
  }

  /// Flips the edge from the vertex v to b: v, a, b and v, b, c become v, a, c and a, b, c.
  DELAUNAYFLIP_HOST_DEVICE void CutEar(CornerId first) const
  {
    const EdgeMeshView& edges = this->Mesh.Edges;
    const CornerId second = this->Mesh.FindNextAround(first);
    const TriangleId kept = TriangleOf(first), cut = TriangleOf(second);
    TriangleRecord left = edges.Triangles[kept], ear = edges.Triangles[cut];
    const int slot = SlotOf(first), next = NextSlot(slot), previous = PreviousSlot(slot);
    const int earSlot = SlotOf(second), earNext = NextSlot(earSlot),
              earPrevious = PreviousSlot(earSlot);
    const EdgeId diagonal = EdgeOf(left.HalfEdges[next]);
    const HalfEdgeId outer = left.HalfEdges[slot];
    ear.Vertices[earSlot] = left.Vertices[next];
    left.Vertices[previous] = ear.Vertices[earPrevious];
    left.HalfEdges[slot] = this->Join(2 * diagonal, kept, slot);
    left.HalfEdges[next] = this->Join(ear.HalfEdges[earNext], kept, next);
    ear.HalfEdges[earNext] = this->Join(2 * diagonal + 1, cut, earNext);
    ear.HalfEdges[earPrevious] = this->Join(outer, cut, earPrevious);
    edges.Triangles[kept] = left;
    edges.Triangles[cut] = ear;
    this->Finish(cut);
  }

  /// Puts one triangle in place of the three around a vertex.
  DELAUNAYFLIP_HOST_DEVICE void Merge(RemovedVertex& own, CornerId first) const
  {
    const EdgeMeshView& edges = this->Mesh.Edges;
    const CornerId second = this->Mesh.FindNextAround(first);
    const CornerId third = this->Mesh.FindNextAround(second);
    const TriangleId kept = TriangleOf(first);
    TriangleRecord merged = edges.Triangles[kept];
    const int slot = SlotOf(first), next = NextSlot(slot), previous = PreviousSlot(slot);
    own.Triangles[0] = TriangleOf(second);
    own.Triangles[1] = TriangleOf(third);
    own.Edges[0] = EdgeOf(merged.HalfEdges[previous]);
    own.Edges[1] = EdgeOf(merged.HalfEdges[next]);
    own.Edges[2] = EdgeOf(this->Mesh.GetHalfEdge(PlaneMesh::Next(second)));
    merged.Vertices[slot] = this->Mesh.GetVertex(PlaneMesh::Previous(second));
    merged.HalfEdges[next] = this->Join(this->Mesh.GetHalfEdge(second), kept, next);
    merged.HalfEdges[previous] = this->Join(this->Mesh.GetHalfEdge(third), kept, previous);
    edges.Triangles[kept] = merged;
    this->Finish(kept);
    for (const TriangleId triangle : own.Triangles)
    {
      edges.Triangles[triangle].Vertices[0] = NoVertex;
    }
    for (const EdgeId edge : own.Edges)
    {
      edges.SetCorners(edge, { NoCorner, NoCorner });
      edges.States[edge] = EdgeState::Fixed;
    }
  }

  /// Makes a half-edge name a corner. @returns the half-edge.
  DELAUNAYFLIP_HOST_DEVICE HalfEdgeId Join(HalfEdgeId halfEdge, TriangleId triangle, int slot) const
  {
    this->Mesh.Edges.CornerOfHalfEdge[halfEdge] = MakeCorner(triangle, slot);
    return halfEdge;
  }

  /// Makes the edges of a new triangle candidates, and tells its vertices that wait of it. Another
  /// vertex that is removed may do the same.
  DELAUNAYFLIP_HOST_DEVICE void Finish(TriangleId made) const
  {
    const TriangleRecord& triangle = this->Mesh.Edges.Triangles[made];
    for (int slot = 0; slot < 3; ++slot)
    {
      EdgeState* state = &this->Mesh.Edges.States[EdgeOf(triangle.HalfEdges[slot])];
      if (AtomicLoad(state) != EdgeState::Fixed)
      {
        AtomicStore(state, EdgeState::Candidate);
      }
      const std::uint32_t item = this->ItemOf[triangle.Vertices[slot]];
      if (item != NoSide)
      {
        AtomicMin(&this->Items[item].Next, MakeCorner(made, slot));
      }
    }
  }
};

}

#endif
