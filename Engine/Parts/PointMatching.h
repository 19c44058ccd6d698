// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTMATCHING_H
#define DELAUNAYFLIP_POINTMATCHING_H

#include "HostMemory.h"
#include "PieceFlip.h"
#include "PieceGroup.h"
#include "Records.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <vector>

/// @file
/// Finds the points that several parts of a mesh have.

namespace delaunayflip
{

/// The keys of points. A key is a number that stands for one point of the whole mesh: all ranks
/// that have the point use the same key.
struct PointKeys
{
  RankNumbers Owners; ///< Finds for each key a rank that has the point from the start.
  HostVector<std::int64_t> Keys; ///< One per point of this rank.
  std::vector<unsigned char> Shared; ///< One flag per point: whether another rank has it, too.
  std::vector<unsigned char> Used; ///< One flag per point: whether a triangle has it.
  /// One flag per point: whether it is not shared and its triangles form a closed fan.
  std::vector<unsigned char> Closed;

  // These are about the whole mesh:
  std::int64_t Repeated = 0; ///< Points of all ranks that a lower rank has, too.
  std::int64_t UsedPoints = 0; ///< Points of triangles, each once.
  /// Points that coincide with others of their rank and with a point of another rank.
  std::int64_t Ambiguous = 0;
};

/// Finds the points that several ranks have. They have the same global number. Without such numbers
/// they have the same coordinates, and at least one of them is at the border of a part. A point
/// without triangles that is the end of a constraint counts as a border point. Two points with the
/// same number that are inside their parts are found if each of them lies in the bounding box of
/// the other one's rank.
PointKeys MatchPoints(
  const MeshPiece& piece, PieceGroup& group, const ThreadBackend& threads = ThreadBackend(1));

}

#endif
