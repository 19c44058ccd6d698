// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_JOINREPORTS_H
#define DELAUNAYFLIP_JOINREPORTS_H

#include "FlipReport.h"
#include "PieceGroup.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// An iteration of a rank. Iterations of several ranks with the same place in the same round are
/// one of the whole mesh.
struct RoundRow
{
  std::int64_t Round;
  std::int64_t Place; ///< Among the rank's own of that round; -1: before them, only an angle.
  IterationRecord Record;
};

/// The sums of the reports of all ranks, the same on all of them. Texts that differ are listed.
/// @param rows the iterations of this rank, which take the place of report.Iterations.
FlipReport JoinReports(
  const FlipReport& report, const std::vector<RoundRow>& rows, PieceGroup& group);

/// The same for the reports of all pieces of a mesh, whose iterations are made side by side.
/// Seconds are the largest. The totals of iterations are left to CountIterations.
FlipReport JoinReports(const std::vector<FlipReport>& reports);

/// Sums the iterations of a report.
void CountIterations(FlipReport& report);

}

#endif
