// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTCHECKS_H
#define DELAUNAYFLIP_INPUTCHECKS_H

#include "FlipOptions.h"
#include "TriangleMesh.h"

namespace delaunayflip
{

/// @throws InvalidOptions for values out of range.
void CheckOptions(const FlipOptions& options);

/// @throws InvalidOptions where the geometry has no ties to decide.
void CheckTieRule(const FlipOptions& options, GeometryKind geometry);

/// Throws MeshTooLarge when 32-bit half-edges cannot number the mesh. Allocates nothing.
void CheckMeshSize(const TriangleMesh& mesh);

}

#endif
