// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CONSTRAINTMOVE_H
#define DELAUNAYFLIP_CONSTRAINTMOVE_H

#include "FarConstraints.h"
#include "PieceMesh.h"
#include "PieceSurvey.h"

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
};

/// Brings the triangles that touch a constraint to one rank, in planar geometry. Constraints that
/// touch the same triangle go to the same rank: the one that has most of their triangles. Where
/// flips need a guard, the triangles around those triangles come, too, so that the rank knows all
/// edges at their points.
/// @param constraints the same on all ranks. @param mesh between BeginRounds and EndRounds.
/// @param labels one per triangle; those of received ones are added.
InsertionTask MoveToConstraints(const std::vector<FarConstraint>& constraints,
  const PieceSurvey& survey, PieceMesh& mesh, std::vector<TriangleLabel>& labels,
  PieceGroup& group);

}

#endif
