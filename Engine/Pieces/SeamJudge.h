// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMJUDGE_H
#define DELAUNAYFLIP_SEAMJUDGE_H

#include "FlipReport.h"
#include "PieceSurvey.h"
#include "Records.h"
#include "SeamTriangle.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// What is found about all seams together.
struct SeamCounts
{
  EdgeCounts Edges; ///< To be added to the sum of what the ranks count alone; may be negative.
  std::int64_t Seams = 0; ///< Edges with triangles on two ranks that may flip.
  std::int64_t NonDelaunay = 0; ///< Of these.
  std::int64_t MissingConstraints = 0; ///< Between shared points, and edges on no rank.
  std::int64_t MissingToInsert = 0; ///< Of the missing ones, those that are to be inserted.
  std::int64_t ToInsert = 0; ///< Those that ranks match alone and that are to be inserted.

  SeamCounts& operator+=(const SeamCounts& part);
  EdgeCounts AddTo(EdgeCounts sum) const;
};

/// A constraint between shared points.
struct SharedConstraint
{
  PointPair Ends; ///< Keys.
  std::int64_t IsToInsert; ///< 0 or 1.
};

/// What a rank must know about a triangle that it has sent.
struct SeamAnswer
{
  std::int64_t Triangle;
  std::int32_t Slot;
  bool IsFixed;
  bool IsToFix; ///< The rank has two triangles of the edge, and would flip it.
};

/// What is decided about the edges that all ranks have sent to this one.
struct SeamVerdict
{
  RecordLists<SeamAnswer> Answers; ///< For every rank.
  std::vector<PointPair> Missing; ///< The constraints to be inserted that are no edges.
  SeamCounts Counts;
};

SeamVerdict JudgeSeams(const RecordLists<SeamTriangle>& seams,
  const RecordLists<SharedConstraint>& constraints, const PieceSurvey& survey,
  const FlipOptions& options);

}

#endif
