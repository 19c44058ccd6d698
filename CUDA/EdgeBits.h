// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEBITS_H
#define DELAUNAYFLIP_EDGEBITS_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// What the loop knows about the edges on a device: the states of EdgeMesh.h, as one bit per edge
/// and state, so that all of them fit into the second-level cache of a GPU.
struct EdgeBits
{
  std::uint32_t* Fixed; ///< EdgeState::Fixed, and the bits after the last edge.
  std::uint32_t* FixedOrDeferred; ///< Edges whose bits in Candidates are ignored.
  std::uint32_t* Candidates;
  std::uint32_t* Bad;
  std::uint32_t* Winners; ///< Bad edges that flip in this iteration.
  std::uint32_t* BlockedByShape;
  std::uint32_t* BlockedByEdge;

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
