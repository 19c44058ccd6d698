// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BADEDGES_H
#define DELAUNAYFLIP_BADEDGES_H

#include "FlipLoop.h"
#include "RoundSums.h"
#include "StepCounts.h"

#include <cmath>
#include <cstdint>

namespace delaunayflip
{

inline std::int64_t GetSum(const RoundSums& round, RoundSum sum)
{
  return static_cast<std::int64_t>(round.Values[static_cast<int>(sum)]);
}

/// What is bad on a device, by why it does not flip.
struct BadEdges
{
  std::int64_t Tested = 0, Bad = 0, Misshapen = 0, BlockedByEdge = 0;

  StepCounts ToCounts() const
  {
    StepCounts counts;
    counts.Tested = this->Tested;
    counts.Bad = this->Bad;
    counts.Blocked = this->Misshapen + this->BlockedByEdge;
    return counts;
  }

  /// What is bad after a round.
  BadEdges Follow(const RoundSums& round, bool hasGuard) const
  {
    const std::int64_t bad = this->Bad - GetSum(round, RoundSum::Flipped) -
      GetSum(round, RoundSum::WasBad) + GetSum(round, RoundSum::IsBad);
    return { GetSum(round, RoundSum::Tested), hasGuard ? GetSum(round, RoundSum::AllBad) : bad,
      this->Misshapen - GetSum(round, RoundSum::WasMisshapen) +
        GetSum(round, RoundSum::IsMisshapen),
      GetSum(round, RoundSum::AllObstructed) };
  }

  /// The iteration that began with this.
  IterationCounts ToIteration(const RoundSums& round) const
  {
    return { this->Tested, this->Bad, this->Misshapen + this->BlockedByEdge,
      GetSum(round, RoundSum::Flipped), -INFINITY };
  }
};

}

#endif
