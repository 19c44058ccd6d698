// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "PieceMesh.h"
#include "PieceSurvey.h"
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
  SeamCounts Counts; ///< Of all ranks.
};

SeamSurvey SurveySeams(const MeshPiece& piece, const PieceMesh& mesh, const PieceSurvey& survey,
  const FlipOptions& options, PieceGroup& group);

}

#endif
