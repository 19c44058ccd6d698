// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ITERATIONSUMS_H
#define DELAUNAYFLIP_ITERATIONSUMS_H

namespace delaunayflip
{

/// What an iteration on a device counts. What it finds for the next one is said as changes.
enum class IterationSum
{
  Flipped,
  FreshSlots, ///< Slots of the guard table used for the first time.
  LostInserts, ///< New edges that found no room in the guard table.
  Tested,
  Uncertain, ///< A device cannot tell.
  WasBad, ///< Of Tested, before and after they were judged.
  IsBad,
  WasBlockedByShape,
  IsBlockedByShape,
  AllBad, ///< All bad edges, where they were counted: with a guard, and at first.
  AllBlockedByEdge, ///< All that the guard blocks.
  AllBlockedByShape, ///< All of EdgeState::BlockedByShape, at first.
  Count
};

constexpr int NumberOfIterationSums = static_cast<int>(IterationSum::Count);

struct IterationSums
{
  unsigned long long Values[NumberOfIterationSums];
};

}

#endif
