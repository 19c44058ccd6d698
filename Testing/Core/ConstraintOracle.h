// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTORACLE_H
#define DELAUNAYFLIP_CONSTRAINTORACLE_H

#include "FlipTestSupport.h"

#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// What becomes of inserted constraints, in rational numbers and by looking at all pairs.

namespace delaunayflip
{

using VertexPair = std::pair<std::int64_t, std::int64_t>;

/// A mesh with constraints, all of which are to be inserted.
struct ConstrainedMesh
{
  OwnedMesh<double> Mesh;
  std::vector<std::int64_t> Ends;
  std::vector<unsigned char> ToInsert;

  void Add(std::int64_t from, std::int64_t to, bool insert = true);
  TriangleMesh View() const;
};

/// Random constraints on a random bad mesh. The fewer lattice points there are to choose from, the
/// more constraints meet vertices.
ConstrainedMesh DrawCase(
  std::size_t points, std::int32_t size, int constraints, std::uint32_t seed);

/// The mesh without constraints that would cross an earlier one.
ConstrainedMesh DropCrossing(const ConstrainedMesh& mesh);

/// The constraint cut at every vertex on it.
std::vector<VertexPair> SplitAtVertices(
  const TriangleMesh& mesh, std::int64_t from, std::int64_t to);

/// Whether two pieces meet in a point that is an end of neither.
bool Cross(const TriangleMesh& mesh, const VertexPair& a, const VertexPair& b);

/// What should become of the constraints of a mesh that covers a convex domain, with distinct
/// points.
struct ExpectedInsertion
{
  std::vector<VertexPair> Pieces; ///< That must be edges.
  std::int64_t Inserted = 0;
  std::int64_t Refused = 0;
};
ExpectedInsertion PredictInsertion(const TriangleMesh& mesh);

/// Whether all are edges of the triangles.
void ExpectEdges(const std::vector<std::int32_t>& triangles, const std::vector<VertexPair>& edges);

/// Reports a failure for every triangle whose circle holds a vertex that can be seen from the
/// triangle's middle, past the constraints. Coordinates must be whole, at most 3,000.
void ExpectConstrainedDelaunay(const TriangleMesh& mesh, const std::vector<VertexPair>& pieces);

/// Twice the area of all triangles with their sign, exact for small whole coordinates.
double SumAreas(const TriangleMesh& mesh);

}

#endif
