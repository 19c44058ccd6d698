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

/// Adds up the reports of all ranks. All ranks get the same result. Texts that differ are listed.
/// Iterations with the same number are joined, without their smallest angles.
FlipReport JoinReports(const FlipReport& report, PieceGroup& group);

/// The same for the parts of a mesh of one process. Each time is the largest of all parts.
FlipReport JoinReports(const std::vector<FlipReport>& reports);

/// Sums the iterations of a report.
void CountIterations(FlipReport& report);

/// @param factor 1 to add, -1 to subtract.
void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor);

/// Adds a defect, or to the count of the same one. Ids mean nothing outside their rank or part.
void AddDefect(const Defect& defect, std::vector<Defect>& defects);

}

#endif
