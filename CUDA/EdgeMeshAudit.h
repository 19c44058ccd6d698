// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHAUDIT_H
#define DELAUNAYFLIP_EDGEMESHAUDIT_H

#include "EdgeMesh.h"
#include "ThreadBackend.h"

#include <cstdint>

/// @file
/// The invariants of an edge mesh.

namespace delaunayflip
{

/// Half-edges that break the adjacency: a corner and its half-edge that do not name each other, an
/// id out of range, two sides of an edge with different end vertices, or, unless the edge is Fixed,
/// two sides that run the same way or face the same vertex. 0 for a sound mesh.
std::int64_t CountInconsistencies(const EdgeMesh& mesh, const ThreadBackend& backend);

/// Throws std::logic_error when CountInconsistencies is not 0: a fault of the engine.
void RequireConsistent(const EdgeMesh& mesh, const ThreadBackend& backend);

}

#endif
