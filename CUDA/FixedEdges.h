// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FIXEDEDGES_H
#define DELAUNAYFLIP_FIXEDEDGES_H

#include "EdgeMeshBuilder.h"

namespace delaunayflip
{

/// The builder's last step: fixes the edges that must stay and counts them by kind, finds repeated
/// triangles, and turns FlipCount from corner roles (EdgeMeshSteps.h) into zeros.
/// @throws InvalidMesh for a constraint that names no point.
void FixEdges(const EdgeMeshInput& input, EdgeMeshResult& result, const ThreadBackend& backend);

}

#endif
