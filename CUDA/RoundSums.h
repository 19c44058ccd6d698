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
  Carried, ///< Bad edges that did not flip; they may be judged again.
  NewlyBad,
  Cured, ///< Of Carried: judged again and no longer bad.
  NewlyMisshapen, ///< Became EdgeState::BlockedByShape.
  Reshaped, ///< Were EdgeState::BlockedByShape.
  GuardedBad, ///< With a guard: all bad edges,
  GuardedBlocked, ///< and all that it blocks.
  Count
};

constexpr int NumberOfRoundSums = static_cast<int>(RoundSum::Count);

struct RoundSums
{
  unsigned long long Values[NumberOfRoundSums];
};

}

#endif
