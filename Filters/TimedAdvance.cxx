// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "TimedAdvance.h"

#include "DelaunayFlip.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace delaunayflip
{

bool AdvanceFor(FlipSession& session, double seconds, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto getElapsed = [start]()
  { return std::chrono::duration<double>(Clock::now() - start).count(); };
  double elapsed = 0.0;
  double iterations = 1.0;
  bool isRunning = false;
  do
  {
    const double before = elapsed;
    isRunning = session.Advance(static_cast<std::int64_t>(iterations), observer, progress);
    elapsed = getElapsed();
    // Batches of iterations are faster than single ones, above all on a GPU. But an iteration may
    // take longer than those before, so batches grow slowly.
    const double fitting = (seconds - elapsed) * iterations / (elapsed - before);
    iterations = std::min(fitting, 2.0 * iterations);
  } while (isRunning && iterations >= 1.0);
  return isRunning;
}

}
