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

/// Gives triangles of bad edges to the lower of their ranks in odd rounds, to the higher in even
/// ones, so that at least one of these edges becomes an inner edge.
/// @param bad edges of this rank. @param moved receives how many triangles of all ranks moved.
/// @returns the triangles of this rank whose edges must now be judged.
std::vector<std::int64_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  bool toLower, PieceGroup& group, std::int64_t& moved);

}

#endif
