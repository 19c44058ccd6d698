// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_ENGINETIMING_H
#define DELAUNAYFLIP_ENGINETIMING_H

#include "DelaunayFlip.h"
#include "RowTiming.h"

#include <vector>

namespace delaunayflip
{

/// The times of the engine's runs on one mesh, whose arrays may be anywhere.
class EngineTiming
{
public:
  /// Times open(), which returns a session, its iterations, and store(session).
  /// @returns milliseconds, which count if `isWarm`.
  template <typename Open, typename Store>
  double RunOnce(bool isWarm, const Open& open, const Store& store)
  {
    LapWatch watch;
    FlipSession session = open();
    const double build = watch.Lap();
    session.Advance();
    const double flips = watch.Lap();
    store(session);
    const double stored = watch.Lap();
    if (isWarm)
    {
      this->Build.push_back(build);
      this->Flips.push_back(flips);
      this->Stored.push_back(stored);
      this->Total.push_back(build + flips + stored);
    }
    this->Report = session.GetReport();
    return build + flips + stored;
  }

  void Fill(BenchmarkRow& row, bool endsDelaunay) const
  {
    row.Build = GetMedian(this->Build);
    row.Flips = GetMedian(this->Flips);
    row.Store = GetMedian(this->Stored);
    row.Total = GetMedian(this->Total);
    row.TotalFlips = this->Report.TotalFlips;
    row.Iterations = static_cast<std::int64_t>(this->Report.Iterations.size());
    row.Left = this->Report.NonDelaunayAfter;
    row.HasFailed = endsDelaunay && row.Left != 0;
    row.Note = row.HasFailed ? "FAILED: bad edges left" : "";
  }

  const FlipReport& GetReport() const { return this->Report; }

private:
  std::vector<double> Build, Flips, Stored, Total;
  FlipReport Report;
};

}

#endif
