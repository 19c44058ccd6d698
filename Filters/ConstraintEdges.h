// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConstraintEdges_h
#define ConstraintEdges_h

#include "FlipReport.h"
#include "TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

using PointPair = std::array<std::int64_t, 2>;

/// Edges that must stay.
struct ConstraintEdges
{
  std::vector<PointPair> Pairs; ///< Unique, in the order given, the smaller id of each pair first.
  std::vector<unsigned char> ToInsert; ///< One flag per pair, as in TriangleMesh.
  std::int64_t Unmatched = 0; ///< How many edges of the second input the mesh does not have.
};

struct ConstraintSource
{
  vtkPolyData* Lines; ///< The mesh, if the edges along its lines are constraints, else null.
  vtkPolyData* Others; ///< The second input, whose lines and polygons are constraints, or null.
  PointArray Points; ///< Of the mesh.
  TriangleArray Triangles;
  bool InsertLines; ///< Whether edges along the lines are inserted where the mesh lacks them.
  bool InsertOthers; ///< The same for the others.
};

/// Finds the edges along the lines of the mesh and along the lines and polygons of the others. The
/// ids of the others are those of the mesh if the others have no points or the same points as the
/// mesh; otherwise edges are matched by the coordinates of their points.
/// @throws InvalidMesh when a cell names a point that does not exist; RunAborted.
ConstraintEdges FindConstraintEdges(
  const ConstraintSource& source, const ProgressObserver& progress = {});

/// Adds the pair of `a` and `b`, unless they are equal.
void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs);

/// Finds, for each pair, the index of the first pair that equals it.
/// @throws RunAborted.
std::vector<std::size_t> FindFirst(
  const std::vector<PointPair>& pairs, const ProgressObserver& progress = {});

}

#endif
