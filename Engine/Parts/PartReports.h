// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PARTREPORTS_H
#define DELAUNAYFLIP_PARTREPORTS_H

#include "FlipReport.h"
#include "PieceGroup.h"

#include <cstdint>
#include <vector>

/// @file
/// The report of a whole mesh from the reports of its parts.

namespace delaunayflip
{

/// Adds up the reports of all ranks. All ranks get the same result. Texts that differ are listed.
/// Iterations with the same number are joined, without their smallest angles.
FlipReport JoinReports(const FlipReport& report, PieceGroup& group);

/// Joins the reports of the parts of a mesh of one process. Each number of seconds is the largest
/// of all parts.
FlipReport JoinReports(const std::vector<FlipReport>& reports);

/// Completes the report of the whole mesh once its edges and the smallest angle are known.
/// @param isCounted whether all edges have been counted.
void CompleteReport(FlipReport& report, std::int64_t usedPoints, bool isCounted);

/// Adds the edges that a report counts, by their kinds and after the last flip.
/// @param factor 1 to add, -1 to subtract.
///
/// The sum over all parts counts seam edges wrongly: each is a boundary edge of several parts. To
/// correct the sum, add the counts of triangles at seams, taken as one mesh, and subtract the
/// counts of the same triangles, taken part by part. Then edges inside a part cancel out, and a
/// seam edge is counted once.
void AddEdges(FlipReport& sum, const FlipReport& part, std::int64_t factor);

}

#endif
