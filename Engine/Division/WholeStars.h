// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_WHOLESTARS_H
#define DELAUNAYFLIP_WHOLESTARS_H

#include "MeshSurvey.h"
#include "ThreadBackend.h"
#include "TriangleMesh.h"

namespace delaunayflip
{

/// Sets StarsAreSimple and Side of a mesh that may be too large for a session.
void SurveyStars(const TriangleMesh& mesh, const PlaneProjection& plane,
  const ThreadBackend& threads, WholeMesh& whole);

}

#endif
