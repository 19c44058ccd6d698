// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RUNPROGRESS_H
#define DELAUNAYFLIP_RUNPROGRESS_H

#include "FlipReport.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

/// @file
/// How far a run is: while a backend builds its mesh, and while edges flip.

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

//------------------------------------------------------------------------------
/// Tells the observer of a run its progress, and says how many iterations to make before the next
/// call.
class RunProgress
{
public:
  /// Tells the observer a fraction of the run, or the last fraction if that is larger.
  /// @returns false if the observer asks to stop.
  bool Tell(const ProgressObserver& observer, double fraction)
  {
    this->Told = std::max(this->Told, fraction);
    return !observer || observer(this->Told);
  }

  /// Called when the build is done.
  /// @param badEdges the number of edges that may flip.
  /// @param buildSeconds the time without the test that found them.
  /// @param rest the share of the progress that what follows the flips takes.
  void StartFlips(std::int64_t badEdges, double buildSeconds, double testSeconds, double rest)
  {
    this->BadEdgesBefore = badEdges;
    this->Rest = rest;
    this->ToldBeforeFlips = this->Told;
    this->SecondsPerIteration = TestsPerIteration * testSeconds;
    this->SecondsBetweenCalls =
      std::max(LeastSecondsBetweenCalls, BuildsBetweenCalls * buildSeconds);
  }

  /// @param report has the iterations up to now, at least one.
  /// @param badEdges the number of edges that may flip next.
  /// @param limit the most iterations of the run. @returns the same as Tell.
  bool TellFlips(const ProgressObserver& observer, const FlipReport& report, std::int64_t badEdges,
    std::int64_t limit)
  {
    const double byLimit =
      static_cast<double>(report.Iterations.size()) / static_cast<double>(limit);
    const double share = std::max(byLimit, this->EstimateFlipped(report, badEdges));
    const double all = 1.0 - this->Rest - this->ToldBeforeFlips;
    return this->Tell(observer, this->ToldBeforeFlips + all * share);
  }

  /// How many iterations, at least one, observers can wait for.
  std::int64_t GetBatch() const
  {
    constexpr double Most = 1e6;
    const double batch = this->SecondsBetweenCalls / std::max(this->SecondsPerIteration, 1e-9);
    return static_cast<std::int64_t>(std::clamp(batch, 1.0, Most));
  }

  void RecordTime(double secondsPerIteration) { this->SecondsPerIteration = secondsPerIteration; }

private:
  /// How long observers wait at least.
  static constexpr double LeastSecondsBetweenCalls = 0.1;
  /// The more iterations in chunks run together, the faster they are. So observers of large meshes
  /// wait longer: for this share of the time that the build took.
  static constexpr double BuildsBetweenCalls = 0.5;

  /// The first iterations that span the mesh take up to this many times as long as the test of all
  /// edges.
  static constexpr double TestsPerIteration = 3.0;

  /// If the bad edges have not become fewer, as many more iterations are expected as have been
  /// made, and this many besides.
  static constexpr double SpareIterations = 20.0;

  /// The share of all flips that have been made. So far the number of bad edges has changed by some
  /// mean factor per iteration. The numbers of bad edges and of flips are expected to shrink by
  /// this factor from now on, and every bad edge to take at least one flip.
  double EstimateFlipped(const FlipReport& report, std::int64_t badEdges) const
  {
    const auto iterations = static_cast<double>(report.Iterations.size());
    const double left = static_cast<double>(badEdges) / static_cast<double>(this->BadEdgesBefore);
    const double factor =
      std::min(std::pow(left, 1.0 / iterations), 1.0 - 1.0 / (iterations + SpareIterations));
    const double expected =
      static_cast<double>(report.Iterations.back().Flipped) * factor / (1.0 - factor);
    const auto flipped = static_cast<double>(report.TotalFlips);
    return flipped / (flipped + std::max(expected, static_cast<double>(badEdges)));
  }

  double Told = 0.0;
  double ToldBeforeFlips = 0.0;
  double Rest = 0.0; ///< The share of the run after the flips.
  std::int64_t BadEdgesBefore = 0;
  double SecondsPerIteration = 0.0;
  double SecondsBetweenCalls = 0.0;
};

}

#endif
