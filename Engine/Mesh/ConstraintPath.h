// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTPATH_H
#define DELAUNAYFLIP_CONSTRAINTPATH_H

#include "PlaneMesh.h"
#include "VertexFans.h"

#include <vector>

namespace delaunayflip
{

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
  TriangleId Bar = NoTriangle; ///< Where it IsBarred.
};

/// Finds the path of the constraint between two vertices. Reads the mesh, changes nothing.
ConstraintPath FindPath(const PlaneMesh& mesh, const VertexFans& fans, VertexId from, VertexId to);

}

#endif
