// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "FlipReport.h"
#include "PartMesh.h"
#include "PartSurvey.h"

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
  /// Other constraints to be inserted, which one rank can look up alone.
  std::int64_t ToInsert = 0;

  SeamCounts& operator+=(const SeamCounts& part);
};

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
/// @param piece the caller's part, or that part after constraints have been inserted.
SeamSurvey SurveySeams(const PartJob& job, const MeshPiece& piece, const PartMesh& mesh);

}

#endif
