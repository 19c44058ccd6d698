// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ROUNDPARTS_H
#define DELAUNAYFLIP_ROUNDPARTS_H

#include "Atomics.h"
#include "GroupBoundary.h"
#include "GroupWork.h"
#include "LateCounts.h"
#include "MotionView.h"
#include "ThreadGroup.h"

#include <cstdint>

/// @file
/// The parts of a round that one group of threads does between those of all threads. The host
/// launches all of them, and waits once.

namespace delaunayflip
{

/// Cuts off triangles at the boundary that are inverted with all vertices at their targets.
template <typename Real>
struct CutInGroup
{
  MotionView<Real> Motion;
  GroupBoundary Boundary;

  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& group) const
  {
    const bool isUsual = AtomicLoad(this->Motion.Get(MotionCount::Unusual)) == 0;
    const bool canCut = isUsual && this->Boundary.CutOff(group);
    if (group.Rank == 0 && !canCut)
    {
      this->Boundary.Counts->End = LateEnd::Failed;
    }
  }
};

/// Lists the triangles that are not counter-clockwise, after CutInGroup, unless the motion has
/// failed. Then coordinates may be unusual, and a device could not decide.
template <typename Real>
struct FindLeftInverted
{
  FindInverted<Real> Find;
  const LateCounts* Counts;

  void Prefetch(std::int64_t triangle) const { this->Find.Prefetch(triangle); }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t triangle) const
  {
    if (this->Counts->End != LateEnd::Failed && triangle < this->Counts->Sizes.Triangles)
    {
      this->Find(triangle);
    }
  }
};

/// Halves the steps of vertices until no triangle is inverted, and makes the boundary convex. Does
/// nothing if the motion has failed, or if so many triangles are inverted that all threads should
/// make the next pass.
template <typename Real>
struct HalveAndFill
{
  MotionView<Real> Motion;
  GroupBoundary Boundary;
  std::uint32_t Stamp; ///< The stamp of the first pass.
  std::uint32_t MostPasses, MostInverted;

  DELAUNAYFLIP_HOST_DEVICE void operator()(const ThreadGroup& group) const
  {
    const bool hasFailed = this->Boundary.Counts->End == LateEnd::Failed;
    const std::uint32_t inverted = AtomicLoad(this->Motion.Get(MotionCount::Inverted));
    if (hasFailed || inverted > this->MostInverted)
    {
      return;
    }
    HalveInGroup<Real>{ this->Motion, this->Stamp, this->MostPasses }(group,
      [&](std::uint32_t changed, std::uint32_t stamp)
      {
        ForEachInGroup(group, changed,
          [&](std::uint32_t i) { this->Motion.CheckStar(this->Motion.Changed[i], stamp); });
      });
    const bool isHalved = AtomicLoad(this->Motion.Get(MotionCount::Inverted)) == 0 &&
      AtomicLoad(this->Motion.Get(MotionCount::Late)) <= this->Motion.MostLate;
    const bool isDone = isHalved && this->Boundary.FillUp(group);
    if (group.Rank == 0)
    {
      this->Boundary.Counts->End = isDone ? LateEnd::Done : LateEnd::Failed;
    }
  }
};

}

#endif
