// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDMESH_H
#define DELAUNAYFLIP_DIVIDEDMESH_H

#include "FlipTestSupport.h"
#include "PieceFlip.h"

#include <cstdint>
#include <vector>

/// @file
/// Meshes that are divided among the ranks of a group of threads, for tests.

namespace delaunayflip
{

/// The rank of every triangle.
using Owners = std::vector<int>;

/// Pieces of about the same number of triangles, next to each other: cuts across the longest side.
Owners DivideBySpace(const TriangleMesh& mesh, int ranks);

/// Every triangle to any rank: the worst there is.
Owners DivideAtRandom(const TriangleMesh& mesh, int ranks, std::uint32_t seed);

/// A piece with arrays of its own.
struct OwnedPiece
{
  std::vector<float> Floats;
  std::vector<double> Doubles;
  std::vector<std::int64_t> Triangles;
  std::vector<std::int64_t> PointOf; ///< The id in the whole mesh, by the piece's own.
  std::vector<std::int64_t> SlotOf; ///< The same for triangles.
  std::vector<std::int64_t> Constraints;
  std::vector<unsigned char> ToInsert; ///< One flag per constraint, or empty.
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;

  MeshPiece View(bool withNumbers) const;
};

/// A piece has the points of its triangles. Constraints go to all pieces that have their points.
std::vector<OwnedPiece> Divide(const TriangleMesh& mesh, const Owners& owners, int ranks);

/// What all ranks together made.
struct GroupResult
{
  std::vector<std::int64_t> Triangles; ///< In their slots of the whole mesh.
  std::vector<std::int32_t> FlipCounts;
  std::vector<PiecesReport> Reports; ///< One per rank.
  std::vector<std::int64_t> Sizes; ///< How many triangles every rank has in the end.

  TriangleArray View() const
  {
    return TriangleArray(
      this->Triangles.data(), static_cast<std::int64_t>(this->Triangles.size()) / 3);
  }
};

/// Flips a divided mesh by as many threads as it has pieces. Reports a failure for a triangle that
/// is lost or comes twice, and for points with other coordinates.
GroupResult FlipDivided(const TriangleMesh& mesh, const std::vector<OwnedPiece>& pieces,
  const FlipOptions& options, bool withNumbers = true);

}

#endif
