// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPATIALORDER_H
#define DELAUNAYFLIP_SPATIALORDER_H

#include "Array.h"
#include "EdgeMesh.h"
#include "MeshSurvey.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

/// @file
/// The order in which the engine keeps vertices and triangles: along a Hilbert curve, so that
/// neighbours in the mesh are neighbours in memory. The order is part of the algorithm: edge ids,
/// and with them the choice among competing flips, follow it, on every backend.

namespace delaunayflip
{

/// Permutations between the caller's ids and ranks; empty for meshes small enough for the caches,
/// which keep the caller's order.
struct SpatialOrder
{
  Array<VertexId> RankOfVertex;
  Array<VertexId> VertexOfRank;
  Array<TriangleId> TriangleOfRank;

  VertexId GetRank(std::int64_t vertex) const
  {
    return this->RankOfVertex.Size() ? this->RankOfVertex[vertex] : static_cast<VertexId>(vertex);
  }
  VertexId GetVertex(std::int64_t rank) const
  {
    return this->VertexOfRank.Size() ? this->VertexOfRank[rank] : static_cast<VertexId>(rank);
  }
  TriangleId GetTriangle(std::int64_t rank) const
  {
    return this->TriangleOfRank.Size() ? this->TriangleOfRank[rank] : static_cast<TriangleId>(rank);
  }
};

/// Vertices by their cell of a Hilbert curve through the bounding box (2048^2 cells in planar
/// geometry, 128^3 on surfaces), triangles by the median rank of their vertices: a long triangle
/// lies near its short edge, where it will be flipped away.
SpatialOrder OrderMesh(
  const TriangleMesh& mesh, const MeshSurvey& survey, const ThreadBackend& backend);

}

#endif
