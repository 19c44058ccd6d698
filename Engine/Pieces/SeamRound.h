// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMROUND_H
#define DELAUNAYFLIP_SEAMROUND_H

#include "PieceMesh.h"
#include "SeamTester.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Which of the two ranks of a bad seam edge gets its triangles: its receiver.
struct MoveRule
{
  bool ToLower; ///< The lower one, else the higher.
  /// Whether this holds only for the first half of the edges between two ranks (SeamHalves), and
  /// for the second half it is the other way round.
  bool InHalves;
};

/// Moves triangles so that at least one bad seam edge becomes an inner edge. A triangle with
/// several bad edges goes to the lowest of their receivers (ToLower), or to the highest.
///
/// So take the bad edges with the lowest receiver of all. Both triangles of each go to that rank,
/// and these edges become inner edges.
/// @param bad the bad seam edges of this rank.
/// @param moved receives the number of triangles that have moved, over all ranks.
/// @returns the triangles of this rank whose edges must now be judged.
std::vector<std::int64_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  const MoveRule& rule, PieceGroup& group, std::int64_t& moved);

}

#endif
