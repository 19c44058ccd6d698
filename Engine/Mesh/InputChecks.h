// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTCHECKS_H
#define DELAUNAYFLIP_INPUTCHECKS_H

#include "FlipOptions.h"

#include <cstdint>

namespace delaunayflip
{

/// @throws InvalidOptions for values out of range.
void CheckOptions(const FlipOptions& options);

/// @throws InvalidOptions if the tie rule does not apply to the geometry.
void CheckTieRule(const FlipOptions& options, GeometryKind geometry);

/// Throws MeshTooLarge if the mesh has too many triangles for 32-bit half-edges. Allocates nothing.
void CheckMeshSize(std::int64_t triangles, std::int64_t points);

}

#endif
