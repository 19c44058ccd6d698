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

/// What keeps edges of a triangle from flipping, apart from its marks.
struct TriangleLabel
{
  std::int32_t Region;
  bool IsFrozen;
};

/// What a rank inserts for all: constraints, and the triangles here that they touch.
struct InsertionTask
{
  std::vector<FarConstraint> Constraints; ///< In their order.
  std::vector<std::int64_t> Triangles; ///< Ascending.
  std::vector<TriangleLabel> Labels; ///< One per triangle.
  RecordLists<std::int64_t> Borrowed; ///< Those of them that another rank has lent, by rank.
  RecordLists<std::int64_t> Lent; ///< The triangles of this rank that others have, by rank.
  std::vector<std::int32_t> LentPoints; ///< Their points that were not shared.
};

/// Lends the triangles that touch a constraint to one rank, in planar geometry. Constraints that
/// touch the same triangle go to the same rank: the one that has most of their triangles. Where
/// flips need a guard, the triangles around those triangles come, too, so that the rank knows all
/// edges at their points.
/// @param constraints the same on all ranks.
/// @param caller has the labels. @param mesh its triangles, between BeginRounds and EndRounds.
InsertionTask LendToConstraints(const std::vector<FarConstraint>& constraints,
  const PieceSurvey& survey, const TriangleMesh& caller, PieceMesh& mesh, PieceGroup& group);

/// Gives every triangle back to the rank that has lent it, as it is now, so that the mesh is
/// divided about as before.
/// @param spread keys of points of the task that are shared from now on. The others that only the
/// loan has made so are not shared any more.
void ReturnTriangles(const InsertionTask& task, const std::vector<std::int64_t>& spread,
  PieceMesh& mesh, PieceGroup& group);

}

#endif
