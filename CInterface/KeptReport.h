// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_KEPTREPORT_H
#define DELAUNAYFLIP_KEPTREPORT_H

#include "delaunayflip_c.h"

#include "FlipReport.h"

#include <cstdint>
#include <string>

/// @file
/// Converts the engine's report to C structs.

namespace delaunayflip
{

delaunayflip_iteration ToC(const IterationRecord& record);

/// A report, kept for the C struct that points to its strings.
class KeptReport
{
public:
  /// @param numbers the numbers by which the report names triangles; null: their indices.
  KeptReport(FlipReport report, const std::int64_t* numbers);

  /// Fills as many bytes of `target` as target.size says.
  void Fill(delaunayflip_report& target) const;

private:
  FlipReport Report;
  std::string Defects;
};

}

#endif
