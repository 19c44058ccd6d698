// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GROUPBOUNDARY_H
#define DELAUNAYFLIP_GROUPBOUNDARY_H

#include "Atomics.h"
#include "GroupWork.h"
#include "HullBoundary.h"
#include "HullChange.h"
#include "LateCounts.h"
#include "ThreadGroup.h"

#include <cstdint>

namespace delaunayflip
{

/// Changes the boundary of a mesh by one group of threads, so that the host need not wait to learn
/// whether there is something to change.
struct GroupBoundary
{
  HullView Hull;
  LateCounts* Counts;
  std::uint32_t* HullCounts; ///< By HullCount.
  VertexId* Pending; ///< Vertices where the boundary must change.
  std::uint32_t* PendingSides; ///< The sides that begin there, in any order.

  /// Cuts off triangles at the boundary that are inverted. @returns whether this was possible.
  DELAUNAYFLIP_HOST_DEVICE bool CutOff(const ThreadGroup& group) const
  {
    std::uint32_t* pending = &this->Counts->CutsPending;
    ForEachInGroup(group, this->Counts->Sizes.Sides,
      [&](std::uint32_t i)
      {
        if (this->Hull.MustCut(this->Hull.Sides[i]))
        {
          Append(this->PendingSides, pending, LateLimits::Pending, i);
        }
      });
    const std::uint32_t count = AtomicLoad(pending);
    if (count == 0 || count > LateLimits::Pending)
    {
      return count == 0;
    }
    this->SortPending(group, count);
    if (group.Rank == 0)
    {
      HullEditor(this->Hull, &this->Counts->Sizes).CutOff(this->Pending, count);
      this->Counts->HasChangedHull = 1;
    }
    group.Sync();
    return this->Counts->Sizes.HasFailed == 0;
  }

  /// Finds a corner of a vertex after CutOff. @param before one of its corners before that.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindCorner(VertexId vertex, CornerId before) const
  {
    HullView hull = this->Hull;
    hull.NumberOfCuts = this->Counts->Sizes.Cuts;
    return hull.FindCorner(vertex, before);
  }

  /// Makes the boundary convex. @returns whether it is a convex polygon that goes around once.
  DELAUNAYFLIP_HOST_DEVICE bool FillUp(const ThreadGroup& group) const
  {
    std::uint32_t* pending = &this->Counts->FillsPending;
    std::uint32_t* wrong = this->HullCounts + static_cast<int>(HullCount::TurnsBack);
    std::uint32_t* reversals = this->HullCounts + static_cast<int>(HullCount::Reversals);
    if (group.Rank == 0)
    {
      this->Counts->FirstNew = static_cast<std::uint32_t>(this->Counts->Sizes.Triangles);
    }
    this->CountTurns(group, wrong, reversals,
      [&](std::uint32_t i) { Append(this->PendingSides, pending, LateLimits::Pending, i); });
    const std::uint32_t count = AtomicLoad(pending);
    if (count > LateLimits::Pending)
    {
      return false;
    }
    if (count > 0)
    {
      this->SortPending(group, count);
      if (group.Rank == 0)
      {
        HullEditor(this->Hull, &this->Counts->Sizes).FillUp(this->Pending, count);
        this->Counts->HasChangedHull = 1;
        AtomicStore(wrong, 0u);
        AtomicStore(reversals, 0u);
      }
      group.Sync();
      this->CountTurns(group, wrong, reversals, [&](std::uint32_t) { AtomicAdd(wrong, 1u); });
    }
    return AtomicLoad(wrong) == 0 && AtomicLoad(reversals) == 2 &&
      this->Counts->Sizes.HasFailed == 0;
  }

private:
  /// Counts the vertices where the boundary turns back, and where it changes between up and down.
  /// Calls visit(side) where it is concave.
  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void CountTurns(const ThreadGroup& group, std::uint32_t* turnsBack,
    std::uint32_t* reversals, const Visit& visit) const
  {
    ForEachInGroup(group, this->Counts->Sizes.Sides,
      [&](std::uint32_t i)
      {
        const BoundarySide side = this->Hull.Sides[i];
        const int turn = this->Hull.FindTurn(side);
        const bool isReversed = this->Hull.IsReversal(side);
        CountIf(turn == 0 && isReversed, turnsBack);
        CountIf(isReversed, reversals);
        if (turn < 0)
        {
          visit(i);
        }
      });
  }

  /// Lists the vertices where pending sides begin, in the order of these sides.
  DELAUNAYFLIP_HOST_DEVICE void SortPending(const ThreadGroup& group, std::uint32_t count) const
  {
    ForEachInGroup(group, count,
      [&](std::uint32_t i)
      {
        const std::uint32_t side = this->PendingSides[i];
        std::uint32_t before = 0;
        for (std::uint32_t k = 0; k < count; ++k) // there are few
        {
          before += this->PendingSides[k] < side ? 1 : 0;
        }
        this->Pending[before] = this->Hull.GetStart(this->Hull.Sides[side]);
      });
  }
};

}

#endif
