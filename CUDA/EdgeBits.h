// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEBITS_H
#define DELAUNAYFLIP_EDGEBITS_H

#include "EdgeMesh.h"
#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// What a device's loop knows of the edges, a bit an edge each: the states of EdgeMesh.h in a form
/// of which the second-level cache of a GPU holds all.
struct EdgeBits
{
  std::uint32_t* Fixed; ///< EdgeState::Fixed, and what is no edge.
  std::uint32_t* Asleep; ///< Fixed, or EdgeState::Deferred: candidates of these are none.
  std::uint32_t* Candidates;
  std::uint32_t* Bad;
  std::uint32_t* Winners; ///< Of the bad ones.
  std::uint32_t* Misshapen; ///< EdgeState::BlockedByShape.
  std::uint32_t* Obstructed; ///< EdgeState::BlockedByEdge.

  static constexpr int Kinds = 7;

  DELAUNAYFLIP_HOST_DEVICE static void Set(std::uint32_t* bits, EdgeId edge)
  {
    AtomicSet(&bits[edge / 32], std::uint32_t(1) << (edge % 32));
  }
  DELAUNAYFLIP_HOST_DEVICE static bool Has(const std::uint32_t* bits, EdgeId edge)
  {
    return (bits[edge / 32] >> (edge % 32) & 1u) != 0;
  }
};

}

#endif
