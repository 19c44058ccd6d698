// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_QUADJUDGE_H
#define DELAUNAYFLIP_QUADJUDGE_H

#include "EdgeMesh.h"
#include "FlipOptions.h"
#include "OppositeAngles.h"
#include "PackedPoints.h"
#include "PieceMesh.h"
#include "PieceSurvey.h"
#include "QuadSoup.h"

namespace delaunayflip
{

/// Judges single edges by the rules of the engine (FlipRules.h).
class QuadJudge
{
public:
  QuadJudge(const PieceSurvey& survey, const FlipOptions& options);

  /// @param apqb x, y and z of the points a, p, q and b of a quad (picture in EdgeFlip.h).
  /// @returns Good, Bad or BlockedByShape.
  EdgeState Judge(const double (&apqb)[4][3]) const;

  /// The same for the two triangles of an edge. They must run through it in opposite directions.
  EdgeState Judge(const SeamSide& one, const SeamSide& other) const;

  /// The same for the edge that is opposite to both corners.
  EdgeState Judge(const PieceMesh& mesh, const PieceCorner& one, const PieceCorner& other) const;

private:
  PackingPlan Plan;
  CriterionKind Criterion;
  bool IsSurface;
  bool Canonical;
  bool FiltersApply;
  AngleTolerance Tolerance;
  CoordinateRange Range;
};

}

#endif
