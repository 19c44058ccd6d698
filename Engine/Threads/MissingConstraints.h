// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MISSINGCONSTRAINTS_H
#define DELAUNAYFLIP_MISSINGCONSTRAINTS_H

#include "ThreadBackend.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Constraint edges that are to be inserted and are no edges of the mesh.
struct MissingConstraints
{
  std::vector<std::int64_t> First; ///< Their numbers, ascending; of equal ones the first.
  std::vector<bool> IsMissing; ///< For every constraint edge; also of equal ones.
};

/// Does not trust the ids of triangles.
/// @throws InvalidMesh for a constraint that names no point.
MissingConstraints FindMissingConstraints(const TriangleMesh& mesh, const ThreadBackend& backend);

}

#endif
