// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BUILDPROGRESS_H
#define DELAUNAYFLIP_BUILDPROGRESS_H

#include "FlipReport.h"

#include <utility>

namespace delaunayflip
{

/// The steps of a build, from the caller's arrays to the first iteration.
enum class BuildStep
{
  Surveyed,
  Ordered,
  Loaded,
  Paired,
  Numbered,
  Fixed,
  Measured, ///< The loop is made, and the smallest angle is known.
  Tested ///< All edges have been tested; the loop can begin.
};

/// Tells an observer, between the steps of a build, the share of the run that is done.
class BuildProgress
{
public:
  /// Has no observer.
  BuildProgress() = default;
  explicit BuildProgress(ProgressObserver observer)
    : Observer(std::move(observer))
  {
  }

  /// Tells the share of a run's time that has passed after a step, on one thread. The build is 0.4
  /// to 1 of a run in the plane and 0.65 to 1 on surfaces, which need a guard
  /// (Documentation/notebook/performance.md).
  /// @throws RunAborted.
  void Reach(GeometryKind geometry, BuildStep step) const
  {
    constexpr double OfSurfaces[] = { 0.02, 0.11, 0.14, 0.24, 0.28, 0.39, 0.56, 0.65 };
    const auto i = static_cast<int>(step);
    this->Tell(geometry == GeometryKind::Surface ? OfSurfaces[i] : OfPlanes[i]);
  }

  /// Tells, in a plane, that `part` of what follows a step up to another one is done.
  void Reach(BuildStep step, BuildStep next, double part) const
  {
    const double done = OfPlanes[static_cast<int>(step)];
    this->Tell(done + part * (OfPlanes[static_cast<int>(next)] - done));
  }

  /// @throws RunAborted.
  void Tell(double share) const
  {
    if (this->Observer && !this->Observer(share))
    {
      throw RunAborted();
    }
  }

private:
  static constexpr double OfPlanes[] = { 0.02, 0.11, 0.17, 0.30, 0.35, 0.39, 0.45, 0.50 };

  ProgressObserver Observer;
};

}

#endif
