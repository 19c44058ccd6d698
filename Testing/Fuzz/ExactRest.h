// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTREST_H
#define DELAUNAYFLIP_EXACTREST_H

#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <cstdint>

namespace delaunayflip
{

/// Bounds on the number of bad edges that a run must leave. They differ by the edges whose angle
/// sum is within rounding of the tolerance.
struct RestBounds
{
  std::int64_t Certain = 0, Possible = 0;
};

/// Counts the edges of a mesh that are bad and not fixed, in rational arithmetic for the in-circle
/// criterion and with 300 bits for angles. Independent of the engine.
/// @param mesh with those constraints that are edges of it.
/// @param geometry PlanarXY; Planar if z is the same for all points; or Surface, without feature
/// edges.
RestBounds BoundRest(const TriangleMesh& mesh, const FlipOptions& options, GeometryKind geometry);

}

#endif
