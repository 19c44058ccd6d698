// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTFLIPS_H
#define DELAUNAYFLIP_CONSTRAINTFLIPS_H

#include "Atomics.h"
#include "EdgeTable.h"
#include "PlaneMesh.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace delaunayflip
{

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

/// Makes constraints edges of a mesh, by flips of the edges that cross them.
///
/// Each flip turns two triangles into two that turn to the same side, and makes no edge that
/// exists. So whatever the mesh, it stays what it was; and where a constraint cannot be inserted,
/// flips made for it do no harm.
class ConstraintFlips
{
public:
  /// @param table of the vertex pairs of all edges.
  ConstraintFlips(
    const PlaneMesh& mesh, std::int64_t vertices, std::int64_t triangles, EdgeTableView* table)
    : Mesh(mesh),
      Table(table),
      Fans(mesh, vertices, triangles)
  {
  }

  /// For a triangulation, in which no flip can make an edge that exists.
  /// @param first as VertexFans takes it.
  ConstraintFlips(const PlaneMesh& mesh, std::vector<HalfEdgeId> first)
    : Mesh(mesh),
      Table(nullptr),
      Fans(mesh, std::move(first))
  {
  }

  /// Makes the constraint between two vertices an edge or a chain of edges, and fixes these.
  PathResult Insert(VertexId from, VertexId to);

  // The same in steps. Several threads may flip at a time for paths that have no triangle in
  // common.

  /// Finds the path of the constraint between two vertices. Changes nothing.
  ConstraintPath Find(VertexId from, VertexId to) const;
  /// Makes each segment of a path one edge. @returns false where triangles overlap.
  bool Flip(ConstraintPath& path);
  /// Fixes the edges of a path, and adds them to GetSegments.
  void Fix(const ConstraintPath& path);

  /// A side of each of the edges that constraints have become, in the order of insertion and from
  /// start to end. Flips do not change it.
  const std::vector<HalfEdgeId>& GetSegments() const { return this->Segments; }

  std::int64_t GetNumberOfFlips() const { return AtomicLoad(&this->Flips); }

private:
  using Rim = ConstraintPath::Rim;

  bool Straighten(Rim& rim);
  bool IsEar(HalfEdgeId first, HalfEdgeId second) const;
  bool CutEar(HalfEdgeId first, HalfEdgeId second);
  bool RemoveBar(TriangleId bar);
  HalfEdgeId GetLongSide(TriangleId flat) const;
  bool TryFlip(EdgeId edge);
  bool IsConvex(const Quad& quad) const;

  const PlaneMesh& Mesh;
  EdgeTableView* Table;
  VertexFans Fans;
  std::vector<HalfEdgeId> Segments;
  std::int64_t Flips = 0;
};

}

#endif
