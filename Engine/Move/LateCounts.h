// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LATECOUNTS_H
#define DELAUNAYFLIP_LATECOUNTS_H

#include "HullChange.h"

#include <cstdint>

/// @file
/// What the host and a group of threads tell each other about rounds that the group makes.

namespace delaunayflip
{

/// How much a group does. The limits are those of all backends, because they decide which flips are
/// made together, and so the numbers of triangles.
struct LateLimits
{
  static constexpr std::uint32_t Late = 8192; ///< With more late vertices it makes no round.
  static constexpr std::uint32_t ForBlock = 128; ///< So few are moved by the first block alone.
  static constexpr std::uint32_t Bad = 1u << 15; ///< Edges that are bad together.
  static constexpr std::uint32_t Triangles = 2 * Bad; ///< Triangles that change together.
  static constexpr std::uint32_t Pending = 1u << 10; ///< Changes of the boundary in a round.
  static constexpr std::uint32_t Rounds = 48; ///< Rounds of a motion, also without a group.
  static constexpr std::uint32_t Iterations = 256; ///< Iterations of flips in a round.
  static constexpr std::uint32_t Passes =
    256; ///< Passes of halved steps in a round, also without a group.
};

/// How rounds by one group have ended.
enum class LateEnd : std::uint32_t
{
  Done, ///< All vertices are at their targets.
  GoesOn, ///< There are too many late vertices or flips. The mesh is as after a round.
  Failed ///< The motion does not suit steps. Places and triangles are of no use.
};

/// What the group counts, in the memory of the backend.
struct LateCounts
{
  std::uint32_t Late; ///< The length of LateRounds::Late.
  std::uint32_t Rounds, Flips;
  std::uint32_t HasChangedHull;
  std::uint32_t FirstNew; ///< The first triangle that the last FillUp has added.
  LateEnd End;
  std::uint32_t Stamp; ///< The last stamp that was used.
  std::uint32_t CutsPending, FillsPending; ///< Vertices where GroupBoundary changes the boundary.
  std::uint32_t Listed; ///< The length of LateRounds::Triangles.
  std::uint32_t Bad[2]; ///< The lengths of LateRounds::Bad.
  std::uint32_t IsAtHull; ///< 1 if a triangle around a late vertex has a side on the boundary.
  HullSizes Sizes;

  /// Begins the counts of another round.
  DELAUNAYFLIP_HOST_DEVICE void BeginRound()
  {
    this->CutsPending = this->FillsPending = this->Listed = this->IsAtHull = 0;
    this->Bad[0] = this->Bad[1] = 0;
    this->Sizes.Cuts = 0;
  }
};

}

#endif
