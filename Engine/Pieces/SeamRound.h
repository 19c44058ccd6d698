// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMROUND_H
#define DELAUNAYFLIP_SEAMROUND_H

#include "PieceMesh.h"
#include "PieceSurvey.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A bad edge between two ranks, as each of them is told.
struct BadSeam
{
  std::int64_t Triangle; ///< The rank's own.
  PointPair Ends; ///< Keys.
  PointPair Opposite; ///< Keys of the points that its flip would join.
  std::int32_t OtherRank;
};

/// What a test of all edges between ranks has found.
struct SeamTest
{
  std::vector<BadSeam> Bad; ///< Of this rank; each is known to both of its ranks.
  std::int64_t BadOfAll = 0; ///< Edges of all ranks.
  std::int64_t BlockedOfAll = 0; ///< Bad, but the flip would fold the mesh over.
};

/// Finds the bad edges between ranks that may flip, as far as their shape tells.
SeamTest TestSeams(
  PieceMesh& mesh, const PieceSurvey& survey, const FlipOptions& options, PieceGroup& group);

/// Gives triangles of bad edges to the lower of their ranks in odd rounds, to the higher in even
/// ones, so that at least one of these edges becomes an inner edge.
/// @param bad edges of this rank. @param moved receives how many triangles of all ranks moved.
/// @returns the points around which edges must now be judged on this rank.
std::vector<std::int32_t> MoveTriangles(PieceMesh& mesh, const std::vector<BadSeam>& bad,
  bool toLower, PieceGroup& group, std::int64_t& moved);

}

#endif
