// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTREST_H
#define DELAUNAYFLIP_EXACTREST_H

#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <cstdint>

namespace delaunayflip
{

/// How many edges a run must leave as bad: the number lies between the two, which differ by those
/// whose angle sum is within rounding of the tolerance.
struct RestBounds
{
  std::int64_t Certain = 0, Possible = 0;
};

/// The edges of a mesh that the options call bad and nothing holds: by rational arithmetic for the
/// in-circle criterion, with 300 bits for angles. Independent of the engine.
/// @param mesh with the constraints that are edges of it.
/// @param geometry PlanarXY; Planar where z is the same for all points; or Surface, where feature
/// edges are not seen.
RestBounds BoundRest(const TriangleMesh& mesh, const FlipOptions& options, GeometryKind geometry);

}

#endif
