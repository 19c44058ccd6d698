// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROUNDSUMS_H
#define DELAUNAYFLIP_ROUNDSUMS_H

namespace delaunayflip
{

/// What an iteration on a device counts. What it finds for the next one is said as changes.
enum class RoundSum
{
  Flipped,
  FreshSlots, ///< Slots of the guard table used for the first time.
  LostInserts, ///< New edges that found no room in the guard table.
  Tested,
  Uncertain, ///< A device cannot tell.
  WasBad, ///< Of Tested, before and after they were judged.
  IsBad,
  WasMisshapen,
  IsMisshapen,
  AllBad, ///< All bad edges, where they were counted: with a guard, and at first.
  AllObstructed, ///< All that the guard blocks.
  AllMisshapen, ///< All of EdgeState::BlockedByShape, at first.
  Count
};

constexpr int NumberOfRoundSums = static_cast<int>(RoundSum::Count);

struct RoundSums
{
  unsigned long long Values[NumberOfRoundSums];
};

}

#endif
