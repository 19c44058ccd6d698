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

/// An iteration of one rank. The iterations of all ranks with the same place in the same round
/// count as one iteration of the whole mesh.
struct RoundRow
{
  std::int64_t Round;
  std::int64_t Place; ///< Of the iteration in its round; -1: before them, only an angle.
  IterationRecord Record;
};

/// Adds up the reports of all ranks. All ranks get the same result. Texts that differ are listed.
/// @param rows the iterations of this rank, which take the place of report.Iterations.
FlipReport JoinReports(
  const FlipReport& report, const std::vector<RoundRow>& rows, PieceGroup& group);

/// The same for the parts of a mesh of one process. Iterations with the same number are joined.
/// Each time is the largest of all parts. Call CountIterations for the totals of the iterations.
FlipReport JoinReports(const std::vector<FlipReport>& reports);

/// Sums the iterations of a report.
void CountIterations(FlipReport& report);

/// @param factor 1 to add, -1 to subtract.
void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor);

/// Adds a defect, or to the count of the same one. Ids mean nothing outside their rank or part.
void AddDefect(const Defect& defect, std::vector<Defect>& defects);

}

#endif
