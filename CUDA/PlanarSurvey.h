// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANARSURVEY_H
#define DELAUNAYFLIP_PLANARSURVEY_H

#include "EdgeMesh.h"
#include "FlipReport.h"
#include "PackedPoints.h"
#include "ThreadBackend.h"

/// @file
/// What exact orientations tell of a planar mesh before the first flip.

namespace delaunayflip
{

struct PlanarSurvey
{
  /// 1 or -1 when every triangle strictly turns to that side; flips keep it so. Else 0.
  int UniformSide = 0;

  /// Whether the triangles around every vertex cover no direction twice. Then no two edges at a
  /// vertex point the same way, flips cannot make an edge that exists, and no guard is needed.
  /// Flips keep it so, for they keep the angle around a vertex.
  bool StarsAreSimple = false;

  Defect ZeroAreaTriangles;
  Defect InvertedTriangles; ///< Those that turn to the less common side.
};

/// Triangles with a coordinate that is not finite, which never flip, do not count.
/// @param hasBrokenFans whether there are non-manifold or wrongly wound edges or such triangles;
/// then StarsAreSimple is not examined and false.
PlanarSurvey SurveyPlane(const EdgeMesh& mesh, const PackedPoints& points, bool hasBrokenFans,
  const ThreadBackend& backend);

/// Triangles of a surface without area.
Defect FindZeroAreaTriangles(
  const EdgeMesh& mesh, const PackedPoints& points, const ThreadBackend& backend);

}

#endif
