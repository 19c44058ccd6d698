// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTLOAN_H
#define DELAUNAYFLIP_CONSTRAINTLOAN_H

#include "FarConstraints.h"
#include "PieceMesh.h"
#include "PieceSurvey.h"
#include "Records.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The caller's labels of a triangle, which can fix its edges. (Its marks can, too: EdgeMark.)
struct TriangleLabel
{
  std::int32_t Region;
  bool IsFrozen;
};

/// What one rank inserts on behalf of all ranks: constraints, and the triangles that they touch,
/// which are all on this rank now.
struct InsertionTask
{
  std::vector<FarConstraint> Constraints; ///< In the order in which they are inserted.
  std::vector<std::int64_t> Triangles; ///< Ascending.
  std::vector<TriangleLabel> Labels; ///< One per triangle.
  RecordLists<std::int64_t> Borrowed; ///< Those of `Triangles` that other ranks have lent, by rank.
  RecordLists<std::int64_t> Lent; ///< Triangles that this rank has lent to others, by rank.
  std::vector<std::int32_t> LentPoints; ///< Points of `Lent` that were not shared before.
};

/// Lends all triangles that touch a constraint to one rank, in planar geometry. Constraints that
/// touch the same triangle form a group and go to the same rank: the one that has most triangles of
/// the group. Where flips need a guard (PieceSurvey::NeedsGuard), the triangles around the touched
/// ones are lent too, so that the rank knows all edges at the points of the touched ones.
/// @param constraints the same on all ranks.
/// @param caller has the regions and frozen flags of the triangles.
/// @param mesh has the triangles; between BeginRounds and EndRounds.
InsertionTask LendToConstraints(const std::vector<FarConstraint>& constraints,
  const PieceSurvey& survey, const TriangleMesh& caller, PieceMesh& mesh, PieceGroup& group);

/// Returns every borrowed triangle, with its present points, to the rank that has lent it. So the
/// mesh stays divided about as before.
/// @param spread keys of the points of the task that are shared from now on (SpreadPoints). Other
/// points that became shared only because of the loan are no longer shared.
void ReturnTriangles(const InsertionTask& task, const std::vector<std::int64_t>& spread,
  PieceMesh& mesh, PieceGroup& group);

}

#endif
