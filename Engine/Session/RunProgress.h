// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RUNPROGRESS_H
#define DELAUNAYFLIP_RUNPROGRESS_H

#include "FlipReport.h"

#include <cstdint>

namespace delaunayflip
{

/// The progress of a run that its observer is told, and how many iterations to make before it is
/// told again.
class RunProgress
{
public:
  /// Tells the observer a fraction of the run, or the last fraction if that is larger.
  /// @returns false if the observer asks to stop.
  bool Tell(const ProgressObserver& observer, double fraction);

  /// Called when the build is done.
  /// @param badEdges the number of edges that may flip.
  /// @param buildSeconds the time without the test that found them.
  void StartFlips(std::int64_t badEdges, double buildSeconds, double testSeconds);

  /// @param report has the iterations up to now, at least one.
  /// @param badEdges the number of edges that may flip next.
  /// @param limit the most iterations of the run. @returns the same as Tell.
  bool TellFlips(const ProgressObserver& observer, const FlipReport& report, std::int64_t badEdges,
    std::int64_t limit);

  /// How many iterations, at least one, observers can wait for.
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
