// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STEPCOUNTS_H
#define DELAUNAYFLIP_STEPCOUNTS_H

#include "HostDevice.h"

#include <cstdint>

namespace delaunayflip
{

/// The counts that the steps make.
struct StepCounts
{
  std::int64_t Tested = 0;
  std::int64_t Uncertain = 0;
  std::int64_t Bad = 0;
  std::int64_t BlockedByShape = 0; ///< Including the edges that their deviation blocks.
  std::int64_t BlockedByEdge = 0;
  std::int64_t Flipped = 0;
  std::int64_t FreshSlots = 0; ///< Slots of the guard table that were empty.
  std::int64_t FreedSlots = 0; ///< Slots of the guard table that are empty now.
  std::int64_t LostInserts = 0; ///< New edges that found no room in the guard table.

  std::int64_t GetBlocked() const { return this->BlockedByShape + this->BlockedByEdge; }

  DELAUNAYFLIP_HOST_DEVICE StepCounts& operator+=(const StepCounts& other)
  {
    this->Tested += other.Tested;
    this->Uncertain += other.Uncertain;
    this->Bad += other.Bad;
    this->BlockedByShape += other.BlockedByShape;
    this->BlockedByEdge += other.BlockedByEdge;
    this->Flipped += other.Flipped;
    this->FreshSlots += other.FreshSlots;
    this->FreedSlots += other.FreedSlots;
    this->LostInserts += other.LostInserts;
    return *this;
  }
};

}

#endif
