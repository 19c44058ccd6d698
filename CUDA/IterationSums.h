// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ITERATIONSUMS_H
#define DELAUNAYFLIP_ITERATIONSUMS_H

namespace delaunayflip
{

/// The counts of an iteration on a device. Bad and blocked edges are counted as changes.
enum class IterationSum
{
  Flipped,
  FreshSlots, ///< Slots of the guard table used for the first time.
  LostInserts, ///< New edges that found no room in the guard table.
  Tested,
  Uncertain, ///< Edges that a device cannot decide.
  WasBad, ///< Tested edges that were bad before; IsBad: that are bad afterwards.
  IsBad,
  WasBlockedByShape,
  IsBlockedByShape,
  AllBad, ///< All bad edges; counted with a guard, and in the first detection.
  AllBlockedByEdge, ///< All edges that the guard blocks.
  AllBlockedByShape, ///< All of EdgeState::BlockedByShape, in the first detection.
  Count
};

constexpr int NumberOfIterationSums = static_cast<int>(IterationSum::Count);

struct IterationSums
{
  unsigned long long Values[NumberOfIterationSums];
};

}

#endif
