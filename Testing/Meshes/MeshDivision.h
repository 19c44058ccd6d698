// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHDIVISION_H
#define DELAUNAYFLIP_MESHDIVISION_H

#include "PieceFlip.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A piece of a mesh of this process, with arrays of its own.
struct OwnPiece
{
  std::vector<float> Floats; ///< Coordinates, in the precision of the mesh; Doubles is then empty.
  std::vector<double> Doubles;
  std::vector<std::int32_t> Triangles;
  std::vector<std::int64_t> PointOf; ///< The id in the mesh, by the piece's own.
  std::vector<std::int64_t> SlotOf; ///< The same for triangles.
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;

  /// Views of these arrays.
  MeshPiece View() const;
};

/// Divides a mesh with valid ids into pieces of about the same number of triangles, next to each
/// other: by cuts across the longest side of what is to be divided. Constraints are left out.
std::vector<OwnPiece> DivideMesh(const TriangleMesh& mesh, int pieces);

}

#endif
