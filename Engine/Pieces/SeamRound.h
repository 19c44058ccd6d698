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

/// Moves triangles so that at least one bad seam edge becomes an inner edge. The triangles at a bad
/// edge go to the lower of its two ranks (in odd rounds) or to the higher (in even rounds). A
/// triangle with several bad edges goes to the lowest (or highest) of their ranks.
/// @param bad the bad seam edges of this rank.
/// @param toLower whether triangles go to the lower ranks.
/// @param moved receives the number of triangles that have moved, over all ranks.
/// @returns the triangles of this rank whose edges must now be judged.
std::vector<std::int64_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  bool toLower, PieceGroup& group, std::int64_t& moved);

}

#endif
