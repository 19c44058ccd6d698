// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTPATH_H
#define DELAUNAYFLIP_CONSTRAINTPATH_H

#include "EdgeMesh.h"
#include "ExactPredicates.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

/// @file
/// The way of a constraint through an edge mesh in the plane, on the host.

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

/// From vertices to their triangles. A fan is what can be reached around a vertex from triangle to
/// triangle; most vertices have one. Of each fan a half-edge is known that leaves the vertex: of an
/// open one the first edge, which has nothing on its other side, so that no flip takes it away.
class VertexFans
{
public:
  /// @param mesh must outlive this.
  VertexFans(const PlaneMesh& mesh, std::int64_t vertices, std::int64_t triangles);

  /// @param first where every vertex has one fan at most: a half-edge of each, as described.
  VertexFans(const PlaneMesh& mesh, std::vector<HalfEdgeId> first)
    : Mesh(mesh),
      First(std::move(first))
  {
  }

  /// Calls visit(corner) for the corners of a vertex until it returns true.
  template <typename Visit>
  void Search(VertexId vertex, const Visit& visit) const
  {
    const HalfEdgeId first = this->First[vertex];
    if (first == NoHalfEdge || this->SearchFan(first, visit))
    {
      return;
    }
    const auto [begin, end] = this->Others.equal_range(vertex);
    for (auto other = begin; other != end && !this->SearchFan(other->second, visit);)
    {
      ++other;
    }
  }

  /// Must hear of every flip.
  /// @param quad as it was. @param fromP, fromQ half-edges that leave P and Q now, other than the
  /// flipped one.
  void NoteFlip(EdgeId edge, const Quad& quad, HalfEdgeId fromP, HalfEdgeId fromQ);

private:
  template <typename Visit>
  bool SearchFan(HalfEdgeId first, const Visit& visit) const
  {
    const CornerId start = PlaneMesh::Next(this->Mesh.Edges.CornerOfHalfEdge[first]);
    CornerId corner = start;
    do
    {
      if (visit(corner))
      {
        return true;
      }
      corner = this->Mesh.FindNextAround(corner);
    } while (corner != NoCorner && corner != start);
    return false;
  }

  const PlaneMesh& Mesh;
  std::vector<HalfEdgeId> First; ///< One a vertex, or NoHalfEdge.
  std::multimap<VertexId, HalfEdgeId> Others;
};

enum class PathResult
{
  Found,
  LeavesMesh,
  CrossesFixedEdge,
  Overlaps, ///< Triangles overlap there, or points coincide.
  IsBarred ///< By a triangle without area.
};

/// The way that a constraint takes through a mesh, vertex by vertex: it begins at one, and wherever
/// it meets another, a segment of it ends.
struct ConstraintPath
{
  /// The left or right rim, depending on how triangles run, of the triangles that a segment
  /// crosses: half-edges of these triangles, in order, each of which runs towards the segment's
  /// start. Of a segment that is an edge, either side of it.
  using Rim = std::vector<HalfEdgeId>;

  PathResult Result = PathResult::Found;
  std::vector<Rim> Segments; ///< Where it was found.
  std::vector<HalfEdgeId> Crossed; ///< Edges that it crosses.
  TriangleId Bar = NoTriangle; ///< Where it IsBarred.
};

/// Finds the path of the constraint between two vertices. Reads the mesh, changes nothing.
ConstraintPath FindPath(const PlaneMesh& mesh, const VertexFans& fans, VertexId from, VertexId to);

}

#endif
