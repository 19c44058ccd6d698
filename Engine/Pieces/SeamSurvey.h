// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "FarConstraints.h"
#include "PieceJob.h"
#include "PieceMesh.h"
#include "SeamJudge.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A mark of an edge of a triangle of this rank.
struct MarkedCorner
{
  std::int64_t Triangle;
  std::int32_t Slot;
  EdgeMark Mark;
};

/// The edges with triangles on several ranks, before the first flip. Decided once, for all ranks.
struct SeamSurvey
{
  std::vector<MarkedCorner> Marks;
  /// Edges that have two triangles here and must stay because of what other ranks know of them.
  std::vector<PointPair> EdgesToFix;
  /// The constraint edges of the caller that this rank can match alone.
  std::vector<std::int64_t> Constraints;
  std::vector<unsigned char> ToInsert;
  /// Constraints between shared points, of all ranks, that are to be inserted: keys, ascending.
  std::vector<PointPair> Missing;
  SeamCounts Counts; ///< Of all ranks.
};

/// @param piece as job.Piece, or as it has become.
/// @param far more constraints to be inserted.
SeamSurvey SurveySeams(const PieceJob& job, const MeshPiece& piece, const PieceMesh& mesh,
  const std::vector<FarConstraint>& far = {});

}

#endif
