// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECESURVEY_H
#define DELAUNAYFLIP_PIECESURVEY_H

#include "MeshSurvey.h"
#include "PieceFlip.h"
#include "PointMatch.h"

#include <string>

namespace delaunayflip
{

/// Decisions that depend on the whole mesh and must be the same on all ranks.
struct PieceSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  std::string GeometryReason;
  PlaneProjection Projection; ///< For the planar kinds.
  WholeMesh Whole; ///< With the same plane; without SharedPoints.
  Defect NearlyHeightField; ///< As in MeshSurvey.
  CoordinateRange Range = CoordinateRange::Usual;
  bool FiltersApply = true; ///< As in MeshSurvey.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  /// Whether a flip could make an edge that already exists on some rank. Then flips need a guard
  /// (GuardRound).
  bool NeedsGuard() const { return !this->Whole.StarsAreSimple; }
};

/// @throws on every rank: InvalidMesh for an id that is not a point of its rank; InvalidOptions.
PieceSurvey SurveyPieces(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group);

/// Checks ids and options on every rank, as SurveyPieces does, before anything else is done.
void CheckPieces(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group);

}

#endif
