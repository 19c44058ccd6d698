// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECESTORE_H
#define DELAUNAYFLIP_PIECESTORE_H

#include "PieceFlip.h"
#include "PieceMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Stores the result of a rank, except FlippedPiece::AreFloats.
/// @param firstOrigins the number of the first triangle of every rank.
/// @param flipped must be empty.
void StorePiece(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
  FlippedPiece& flipped);

/// The same where few triangles are listed (PieceMesh).
/// @param flipped must be empty, but for the triangles and the flip counts of the first flips, in
/// their slots.
void StoreListed(const PieceMesh& mesh, const std::vector<std::int64_t>& firstOrigins, int rank,
  FlippedPiece& flipped);

}

#endif
