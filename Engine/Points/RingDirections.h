// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RINGDIRECTIONS_H
#define DELAUNAYFLIP_RINGDIRECTIONS_H

#include "SegmentCrossings.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Turns segments of a ring so that as many begin as end at each place.
/// @throws InvalidMesh if it is not closed.
/// @param ring indices of its segments. @param used by point the one that is used at its place.
void TurnSegments(const std::vector<std::size_t>& ring, const std::vector<std::int64_t>& used,
  std::vector<Segment>& segments);

}

#endif
