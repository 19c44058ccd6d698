// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTSURVEY_H
#define DELAUNAYFLIP_PARTSURVEY_H

#include "MeshSurvey.h"
#include "PieceFlip.h"
#include "PieceGroup.h"
#include "PointMatch.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <vector>

namespace delaunayflip
{

/// What is known of the whole mesh; the same on all ranks.
struct PartSurvey : MeshSurvey
{
  WholeMesh Whole; ///< With the same plane; without SharedPoints.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  PartSurvey() = default;
  /// Without StarsAreSimple. Drops the values of single points.
  PartSurvey(MeshSurvey found, bool isFloat);

  /// Whether a flip could make an edge that already exists on some rank. Then flips need a guard
  /// (GuardRound).
  bool NeedsGuard() const { return !this->Whole.StarsAreSimple; }
  /// Of ids and coordinates.
  std::vector<Defect> ListDefects() const;
};

/// The squared cotangent of the smallest angle of a triangle, as defined in SmallestAngle.h.
/// @param x the coordinates of its corners.
double MeasureCotangent(const double (&x)[3][3], const PartSurvey& survey);

/// @throws on every rank: InvalidMesh for an id that is not a point of its rank; InvalidOptions.
PartSurvey SurveyParts(
  const MeshPiece& piece, const PointKeys& keys, const FlipOptions& options, PieceGroup& group);

/// Checks ids and options on every rank, as SurveyParts does, before anything else is done.
void CheckParts(const MeshPiece& piece, const FlipOptions& options, PieceGroup& group);

/// The input of a run on one rank. All of it must live as long as the run.
struct PartJob
{
  const MeshPiece& Piece;
  const FlipOptions& Options;
  const PartSurvey& Survey;
  PieceGroup& Group;
  const ProgressObserver& Progress;
};

/// Sets Side and StarsAreSimple of the whole mesh: whether all its triangles strictly turn to the
/// same side in the plane, and the triangles around every point cover no direction twice. Then
/// flips need no guard (PlanarSurvey::StarsAreSimple), neither in the whole mesh nor in a part,
/// where the star of a point has some of the same triangles. All ranks must call this together.
/// @param keys of which only Keys, Shared and Closed matter.
void SurveyStars(const TriangleMesh& mesh, const PointKeys& keys, const ThreadBackend& threads,
  PieceGroup& group, PartSurvey& survey);

/// The same for a mesh of this process, which may be too large for a session.
void SurveyStars(const TriangleMesh& mesh, const ThreadBackend& threads, PartSurvey& survey);

}

#endif
