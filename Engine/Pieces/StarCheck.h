// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STARCHECK_H
#define DELAUNAYFLIP_STARCHECK_H

#include "MeshSurvey.h"
#include "PieceGroup.h"
#include "PointMatch.h"
#include "TriangleMesh.h"

namespace delaunayflip
{

/// Whether the triangles around every point of the whole mesh, which strictly turn to one side,
/// cover no direction twice. Then no guard is needed (PlanarSurvey::StarsAreSimple); nor is it for
/// a piece, around whose points there are fewer triangles. All ranks call it together.
/// @param side to which all triangles turn in the plane: 1 or -1.
bool AreStarsSimple(const TriangleMesh& mesh, const PlaneProjection& plane, int side,
  const PointKeys& keys, PieceGroup& group);

}

#endif
