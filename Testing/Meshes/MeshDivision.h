// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHDIVISION_H
#define DELAUNAYFLIP_MESHDIVISION_H

#include "PieceFlip.h"

#include <cstdint>
#include <vector>

/// @file
/// Meshes of one process that are divided among ranks.

namespace delaunayflip
{

/// A piece of a mesh, with arrays of its own.
struct OwnPiece
{
  std::vector<float> Floats; ///< Coordinates, in the precision of the mesh; Doubles is then empty.
  std::vector<double> Doubles;
  std::vector<std::int32_t> Triangles;
  std::vector<std::int64_t> PointOf; ///< The id in the mesh, by the piece's own.
  std::vector<std::int64_t> SlotOf; ///< The slot in the mesh, by the piece's own.
  std::vector<std::int64_t> Constraints; ///< Pairs of the piece's own ids.
  std::vector<unsigned char> ToInsert; ///< One flag per constraint, or empty.
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;

  /// Views of these arrays.
  MeshPiece View(bool withNumbers = true) const;
};

/// The rank of every triangle.
using Owners = std::vector<int>;

/// Parts of about the same number of triangles, next to each other: cuts across the longest side of
/// what is to be divided.
Owners DivideBySpace(const TriangleMesh& mesh, int ranks);

/// Divides a mesh with valid ids. A piece has the points of its triangles, and the constraints
/// between two of its points.
std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, const Owners& owners, int ranks);
std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, int ranks);

}

#endif
