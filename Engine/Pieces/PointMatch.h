// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMATCH_H
#define DELAUNAYFLIP_POINTMATCH_H

#include "HostVector.h"
#include "PieceFlip.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// One number for every point of the whole mesh: a key. Ranks that have the same point know it by
/// the same key, which tells a rank that has it from the start, and its id there.
struct PointKeys
{
  std::vector<std::int64_t> FirstKeys; ///< Of every rank, and at the end the number of all keys.
  HostVector<std::int64_t> Keys; ///< One per point of this rank.
  std::vector<unsigned char> Shared; ///< One flag per point: whether another rank has it, too.
  std::vector<unsigned char> Used; ///< One flag per point: whether a triangle has it.
  /// One flag per point: whether it is not shared and its triangles form a closed ring around it.
  std::vector<unsigned char> Closed;

  // Of the whole mesh:
  std::int64_t Repeated = 0; ///< Points that a rank before theirs has, too.
  std::int64_t UsedPoints = 0; ///< Points of triangles, each once.
  std::int64_t Ambiguous = 0; ///< Coincide with others of their rank, and with one of another.

  PieceOrigin FindOrigin(std::int64_t key) const;
};

/// Finds the points that several ranks have: those with the same number or, without numbers, with
/// the same coordinates if at least one of them is at the border of a piece. A point without
/// triangles that is the end of a constraint counts as a border point. Two points with the same
/// number that are inside their pieces are found if each of them lies in the bounding box of the
/// other one's rank.
PointKeys MatchPoints(const MeshPiece& piece, PieceGroup& group);

}

#endif
