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

/// Counts of seam edges, and of constraints between shared points.
struct SeamCounts
{
  EdgeCounts Edges; ///< A correction to the sum of the counts of all ranks; may be negative.
  std::int64_t Seams = 0; ///< Seam edges: those with triangles on two ranks that are not fixed.
  std::int64_t NonDelaunay = 0; ///< Seam edges that are bad.
  std::int64_t MissingConstraints = 0; ///< Constraints between shared points, edges on no rank.
  std::int64_t MissingToInsert = 0; ///< Of these, the ones that are to be inserted.
  std::int64_t ToInsert =
    0; ///< Other constraints to be inserted, which one rank can look up alone.

  SeamCounts& operator+=(const SeamCounts& part);
  EdgeCounts AddTo(EdgeCounts sum) const;
};

/// A constraint between shared points.
struct SharedConstraint
{
  PointPair Ends; ///< Keys.
  std::int64_t IsToInsert; ///< 0 or 1.
};

/// The answer of the home of an edge about a triangle that a rank has sent.
struct SeamAnswer
{
  std::int64_t Triangle;
  std::int32_t Slot;
  bool IsFixed;
  bool IsToFix; ///< The rank must be told to fix the edge: it has two triangles of it.
};

/// What this rank, as the home of edges, has decided about them.
struct SeamVerdict
{
  RecordLists<SeamAnswer> Answers; ///< For every rank.
  std::vector<PointPair> Missing; ///< The constraints to be inserted that are not edges yet.
  SeamCounts Counts;
};

/// Decides about the edges whose home is this rank.
/// @param seams, constraints from every rank.

SeamVerdict JudgeSeams(const RecordLists<SeamTriangle>& seams,
  const RecordLists<SharedConstraint>& constraints, const PieceSurvey& survey,
  const FlipOptions& options);

}

#endif
