// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RUNPROGRESS_H
#define DELAUNAYFLIP_RUNPROGRESS_H

#include "FlipReport.h"

#include <cstdint>

namespace delaunayflip
{

/// How far a run is, as a progress observer is told, and how many iterations to make before it is
/// told again.
class RunProgress
{
public:
  /// Tells a fraction of the run, or what was told before if that is more.
  /// @returns false when the observer wants to stop.
  bool Tell(const ProgressObserver& observer, double fraction);

  /// The build is done.
  /// @param badEdges that may flip. @param buildSeconds without the test that found them.
  void StartFlips(std::int64_t badEdges, double buildSeconds, double testSeconds);

  /// @param report of the iterations up to now, at least one. @param badEdges that may flip next.
  /// @param limit of iterations. @returns as Tell.
  bool TellFlips(const ProgressObserver& observer, const FlipReport& report, std::int64_t badEdges,
    std::int64_t limit);

  /// Iterations, at least one, that observers can wait for.
  std::int64_t GetBatch() const;

  void KeepTime(double secondsPerIteration) { this->SecondsPerIteration = secondsPerIteration; }

private:
  double EstimateFlipped(const FlipReport& report, std::int64_t badEdges) const;

  double Told = 0.0;
  double ToldBeforeFlips = 0.0;
  std::int64_t BadEdgesBefore = 0;
  double SecondsPerIteration = 0.0;
  double SecondsBetweenCalls = 0.0;
};

}

#endif
