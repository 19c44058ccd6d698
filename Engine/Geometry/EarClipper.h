// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EARCLIPPER_H
#define DELAUNAYFLIP_EARCLIPPER_H

#include "FlipReport.h"

#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

using PlaneVector = std::array<double, 2>;
using Triples = std::vector<std::array<std::int64_t, 3>>;

/// Clips the ears of a polygon, one by one, in an order that depends only on the polygon: a walk
/// around it clips the next ear that it finds and continues beyond the neighbour, which makes
/// rounder triangles than a fan. A vertex is an ear if its triangle is counter-clockwise and no
/// other vertex lies in it, except at the place of a corner. A vertex with a NaN or infinite
/// coordinate lies in every triangle. If the walk goes all the way around without an ear, the
/// polygon crosses itself or has no area, and the vertex at which it began is cut off.
/// @param polygon counter-clockwise, with at least three vertices.
/// @param progress told the share of this polygon; may be empty.
/// @returns triples of positions in the polygon, in the order of the cuts; none if the observer
/// stopped it.
Triples ClipEars(const std::vector<PlaneVector>& polygon, const ProgressObserver& progress);

}

#endif
