// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHBUILDER_H
#define DELAUNAYFLIP_EDGEMESHBUILDER_H

#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipReport.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

/// @file
/// Triangles into an edge mesh, in time linear in their number whatever the vertex degrees.

namespace delaunayflip
{

/// Throws MeshTooLarge when 32-bit half-edges cannot number the mesh. Allocates nothing.
void CheckMeshSize(const TriangleMesh& mesh);

struct EdgeMeshInput
{
  const TriangleMesh& Mesh;
  const MeshSurvey& Survey;
  SpatialOrder& Order; ///< TriangleOfRank is dropped once the triangles are loaded.
  double FeatureAngle; ///< Degrees; 180 fixes none. Surfaces only.
};

struct EdgeMeshResult
{
  EdgeMesh Edges;
  EdgeTable Table; ///< Vertex pairs of all edges, without words.
  EdgeCounts Counts;
  Defect DuplicateTriangles;
  std::int64_t MissingConstraints = 0;
};

/// Pairs the triangles' sides through an EdgeTable and fixes the edges that must stay: boundary,
/// non-manifold and wrongly wound ones, those of frozen, repeated-id, duplicate and non-finite
/// triangles, region borders, feature edges, constraints. All others are candidates.
///
/// EdgeId = rank of the edge's smallest incident corner in the engine's order, on every backend.
/// @throws InvalidMesh for a constraint that names no point.
EdgeMeshResult BuildEdgeMesh(const EdgeMeshInput& input, const ThreadBackend& backend);

}

#endif
