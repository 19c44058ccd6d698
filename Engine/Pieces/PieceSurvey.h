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

/// What all ranks must decide alike, from the whole mesh.
struct PieceSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  std::string GeometryReason;
  PlaneProjection Projection; ///< For the planar kinds.
  WholeMesh Whole; ///< The same plane, without flags of points.
  Defect NearlyHeightField; ///< As that of MeshSurvey.
  CoordinateRange Range = CoordinateRange::Usual;
  bool FiltersApply = true; ///< As that of MeshSurvey.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  /// Whether flips could make an edge that exists, on any rank.
  bool NeedsGuard() const { return !this->Whole.StarsAreSimple; }
};

/// @throws on every rank: InvalidMesh for an id that is not a point of its rank; InvalidOptions.
PieceSurvey SurveyPieces(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group);

/// The same checks of ids and options on every rank, before anything else is done.
void CheckPieces(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group);

}

#endif
