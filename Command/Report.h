// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REPORT_H
#define DELAUNAYFLIP_REPORT_H

#include "FlipReport.h"

#include <ostream>
#include <string>
#include <vector>

/// @file
/// The reports on a run: JSON, CSV and a summary.

namespace delaunayflip
{

/// The engine's report, and the times of the steps outside it.
struct RunReport
{
  bool IsFromPoints = false;
  FlipReport Flip;
  double ReadSeconds = 0.0;
  double WriteSeconds = 0.0;
  std::vector<std::string> Warnings;
};

/// One JSON object; numbers that are not finite become null.
void WriteJson(const RunReport& run, std::ostream& stream);

/// The iterations as CSV with a header line; the smallest angle is nan where it was not computed.
void WriteCsv(const FlipReport& flip, std::ostream& stream);

/// A summary in a few lines of text.
void WriteSummary(const RunReport& run, std::ostream& stream);

}

#endif
