// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTFLIPS_H
#define DELAUNAYFLIP_CONSTRAINTFLIPS_H

#include "Atomics.h"
#include "ConstraintPath.h"
#include "EdgeTable.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

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

  ConstraintPath Find(VertexId from, VertexId to) const
  {
    return FindPath(this->Mesh, this->Fans, from, to);
  }
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
