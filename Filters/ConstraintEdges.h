// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConstraintEdges_h
#define ConstraintEdges_h

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
  std::vector<PointPair> Pairs; ///< The smaller id first, ascending, none twice.
  std::int64_t Unmatched = 0; ///< More of the second input: there the mesh has no edge.
};

struct ConstraintSource
{
  vtkPolyData* Lines; ///< The mesh, if edges along its lines stay, else null.
  vtkPolyData* Others; ///< Whose lines and polygons are edges that stay, or null.
  PointArray Points; ///< Of the mesh.
  TriangleArray Triangles;
};

/// The edges along the lines of the mesh and along the lines and polygons of the others. These go
/// by the point ids of the mesh where they have no points or the very ones of the mesh, else by the
/// places of their points.
/// @throws InvalidMesh when a cell names a point that is none.
ConstraintEdges FindConstraintEdges(const ConstraintSource& source);

/// Adds a pair, unless both are the same.
void AddPair(std::int64_t a, std::int64_t b, std::vector<PointPair>& pairs);

/// Puts pairs in order, and each of them once.
void SortPairs(std::vector<PointPair>& pairs);

}

#endif
