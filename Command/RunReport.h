// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RUNREPORT_H
#define DELAUNAYFLIP_RUNREPORT_H

#include "FlipReport.h"

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What the command tells of a run.

namespace delaunayflip
{

struct Arguments;

/// The engine's report, and the times of the steps outside it.
struct RunReport
{
  bool IsFromPoints = false;
  FlipReport Flip;
  std::string Summary; ///< The filter's: lines of a title, ": " and a text.
  double ReadSeconds = 0.0;
  double WriteSeconds = 0.0;
  std::int64_t Places = -1; ///< Where heights were asked for; -1: they were not.
  std::int64_t PlacesOutside = 0; ///< Those in no triangle.
  std::vector<std::string> Warnings;
};

/// One JSON object; numbers that are not finite become null.
std::string MakeJson(const RunReport& run);

/// The iterations as CSV with a header line; the smallest angle is nan where it was not computed.
std::string MakeCsv(const FlipReport& flip);

/// The summary and the times, in two columns.
std::string MakeSummary(const RunReport& run);

/// The filter's message with options of the command for properties of the filter. It does not
/// advise again what was asked for.
std::string WithOptions(const std::string& message, const Arguments& given);

}

#endif
