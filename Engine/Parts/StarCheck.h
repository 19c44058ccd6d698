// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARCHECK_H
#define DELAUNAYFLIP_STARCHECK_H

#include "MeshSurvey.h"
#include "PieceGroup.h"
#include "PointMatch.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

namespace delaunayflip
{

/// Whether all triangles of the whole mesh strictly turn to the same side in the plane, and the
/// triangles around every point cover no direction twice. Then flips need no guard
/// (PlanarSurvey::StarsAreSimple), neither in the whole mesh nor in a part, where the star of a
/// point has some of the same triangles. All ranks must call this together.
/// @param keys of which only Keys, Shared and Closed matter.
bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const ThreadBackend& threads, PieceGroup& group);

/// The same for a mesh of this process, which may be too large for a session.
bool AreStarsSimple(
  const TriangleMesh& mesh, const PlaneProjection& plane, const ThreadBackend& threads);

}

#endif
