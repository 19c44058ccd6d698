// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "RunProgress.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

namespace
{
/// The more iterations in chunks run together, the faster they are. So observers of large meshes
/// wait longer: for this share of the time that the build took.
constexpr double LeastSecondsBetweenCalls = 0.1;
constexpr double BuildsBetweenCalls = 0.5;

/// The first iterations that span the mesh take up to this many times as long as the test of all
/// edges.
constexpr double TestsPerIteration = 3.0;

/// If bad edges do not become fewer, this many more iterations are expected than have been made.
constexpr double SpareIterations = 20.0;
}

void RunProgress::StartFlips(std::int64_t badEdges, double buildSeconds, double testSeconds)
{
  this->BadEdgesBefore = badEdges;
  this->ToldBeforeFlips = this->Told;
  this->SecondsPerIteration = TestsPerIteration * testSeconds;
  this->SecondsBetweenCalls = std::max(LeastSecondsBetweenCalls, BuildsBetweenCalls * buildSeconds);
}

bool RunProgress::TellFlips(const ProgressObserver& observer, const FlipReport& report,
  std::int64_t badEdges, std::int64_t limit)
{
  const double byLimit = static_cast<double>(report.Iterations.size()) / static_cast<double>(limit);
  const double share = std::max(byLimit, this->EstimateFlipped(report, badEdges));
  return this->Tell(observer, this->ToldBeforeFlips + (1.0 - this->ToldBeforeFlips) * share);
}

std::int64_t RunProgress::GetBatch() const
{
  constexpr double Most = 1e6;
  const double batch = this->SecondsBetweenCalls / std::max(this->SecondsPerIteration, 1e-9);
  return static_cast<std::int64_t>(std::clamp(batch, 1.0, Most));
}

bool RunProgress::Tell(const ProgressObserver& observer, double fraction)
{
  this->Told = std::max(this->Told, fraction);
  return !observer || observer(this->Told);
}

/// The share of all flips that have been made. Bad edges have decreased by some mean factor per
/// iteration, and they, and flips with them, are expected to continue so; every bad edge takes a
/// flip. If they have not decreased, as many more iterations are expected as have been made.
double RunProgress::EstimateFlipped(const FlipReport& report, std::int64_t badEdges) const
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

}
