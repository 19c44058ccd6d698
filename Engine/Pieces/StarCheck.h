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

/// Whether all triangles of the whole mesh strictly turn to one side in the plane and those around
/// every point cover no direction twice. Then no guard is needed (PlanarSurvey::StarsAreSimple);
/// nor is it for a piece, around whose points there are fewer triangles. All ranks call it
/// together.
bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, const PointKeys& keys,
  const ThreadBackend& threads, PieceGroup& group);

}

#endif
