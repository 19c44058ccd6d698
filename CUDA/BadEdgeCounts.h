// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BADEDGECOUNTS_H
#define DELAUNAYFLIP_BADEDGECOUNTS_H

#include "FlipLoop.h"
#include "IterationSums.h"
#include "StepCounts.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

inline std::int64_t GetSum(const IterationSums& iteration, IterationSum sum)
{
  return static_cast<std::int64_t>(iteration.Values[static_cast<int>(sum)]);
}

/// How many edges of a mesh on a device are bad or blocked, by kind.
struct BadEdgeCounts
{
  std::int64_t Tested = 0, Bad = 0, BlockedByShape = 0, BlockedByEdge = 0;

  StepCounts ToCounts() const
  {
    StepCounts counts;
    counts.Tested = this->Tested;
    counts.Bad = this->Bad;
    counts.BlockedByShape = this->BlockedByShape;
    counts.BlockedByEdge = this->BlockedByEdge;
    return counts;
  }

  /// The counts after an iteration.
  BadEdgeCounts Follow(const IterationSums& iteration, bool hasGuard) const
  {
    const std::int64_t bad = this->Bad - GetSum(iteration, IterationSum::Flipped) -
      GetSum(iteration, IterationSum::WasBad) + GetSum(iteration, IterationSum::IsBad);
    return { GetSum(iteration, IterationSum::Tested),
      hasGuard ? GetSum(iteration, IterationSum::AllBad) : bad,
      this->BlockedByShape - GetSum(iteration, IterationSum::WasBlockedByShape) +
        GetSum(iteration, IterationSum::IsBlockedByShape),
      GetSum(iteration, IterationSum::AllBlockedByEdge) };
  }

  /// The iteration that began with these counts.
  IterationCounts ToIteration(const IterationSums& iteration) const
  {
    return { this->Tested, this->Bad, this->BlockedByShape + this->BlockedByEdge,
      GetSum(iteration, IterationSum::Flipped), -INFINITY };
  }
};

}

#endif
