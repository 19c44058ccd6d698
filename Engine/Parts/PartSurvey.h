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

#include <string>

namespace delaunayflip
{

/// Decisions that depend on the whole mesh and must be the same on all ranks.
struct PartSurvey
{
  GeometryKind Geometry = GeometryKind::Surface; ///< Never Auto.
  std::string GeometryReason;
  PlaneProjection Projection; ///< For the planar kinds.
  WholeMesh Whole; ///< With the same plane; without SharedPoints.
  Defect NearlyHeightField; ///< As in MeshSurvey.
  CoordinateRange Range = CoordinateRange::Usual;
  bool FiltersApply = true; ///< As in MeshSurvey.
  bool IsFloat = true; ///< Whether all ranks that have points have coordinates of type float.

  PartSurvey() = default;
  /// Without StarsAreSimple and IsFloat.
  explicit PartSurvey(const MeshSurvey& found);

  /// Whether a flip could make an edge that already exists on some rank. Then flips need a guard
  /// (GuardRound).
  bool NeedsGuard() const { return !this->Whole.StarsAreSimple; }
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

/// Sets Side and StarsAreSimple: whether all triangles of the whole mesh strictly turn to the same
/// side in the plane, and the triangles around every point cover no direction twice. Then flips
/// need no guard (PlanarSurvey::StarsAreSimple), neither in the whole mesh nor in a part, where the
/// star of a point has some of the same triangles. All ranks must call this together.
/// @param keys of which only Keys, Shared and Closed matter.
void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const ThreadBackend& threads, PieceGroup& group, WholeMesh& whole);

/// The same for a mesh of this process, which may be too large for a session.
void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane,
  const ThreadBackend& threads, WholeMesh& whole);

}

#endif
