// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "PieceJob.h"
#include "PieceMesh.h"
#include "SeamJudge.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A mark for the edge opposite to a corner of a triangle of this rank.
struct MarkedCorner
{
  std::int64_t Triangle;
  std::int32_t Slot;
  EdgeMark Mark;
};

/// What is known about the edges with triangles on several ranks before the first flip. Decided
/// once for all ranks.
struct SeamSurvey
{
  std::vector<MarkedCorner> Marks;
  /// Edges that have two triangles here and are fixed because of triangles or constraints of other
  /// ranks.
  std::vector<PointPair> EdgesToFix;
  /// The constraints of the caller that this rank can look up alone: two ids for each.
  std::vector<std::int64_t> Constraints;
  std::vector<unsigned char> ToInsert; ///< One flag for each of them.
  /// The constraints of all ranks between shared points that are to be inserted: keys, ascending.
  std::vector<PointPair> Missing;
  SeamCounts Counts; ///< Sums over all ranks.
};

/// Surveys the seams. All ranks must call this together.
/// @param piece the caller's piece, or the piece after constraints have been inserted.
SeamSurvey SurveySeams(const PieceJob& job, const MeshPiece& piece, const PieceMesh& mesh);

}

#endif
