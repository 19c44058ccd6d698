// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGETOTALS_H
#define DELAUNAYFLIP_EDGETOTALS_H

#include "FlipReport.h"

#include <cstdint>

namespace delaunayflip
{

/// Counts of the edges of a mesh.
///
/// The sum over all pieces counts seam edges wrongly: each is a boundary edge of several pieces. To
/// correct the sum, add the counts of the triangles at seams, taken as one mesh, and subtract the
/// counts of the same triangles, taken piece by piece. Then edges inside a piece cancel out, and a
/// seam edge is counted once.
struct EdgeTotals
{
  EdgeCounts Edges;
  std::int64_t NonDelaunay = 0;
  std::int64_t BlockedByShape = 0;
  std::int64_t BlockedByEdge = 0;

  /// @param report of a run without iterations.
  /// @param factor 1 to add, -1 to subtract.
  void Add(const FlipReport& report, std::int64_t factor)
  {
    this->Add(report.Edges, factor);
    this->NonDelaunay += factor * report.NonDelaunayAfter;
    this->BlockedByShape += factor * report.BlockedByShape;
    this->BlockedByEdge += factor * report.BlockedByEdge;
  }

  void Add(const EdgeCounts& part, std::int64_t factor)
  {
    for (std::int64_t EdgeCounts::*kind : { &EdgeCounts::Edges, &EdgeCounts::Boundary,
           &EdgeCounts::NonManifold, &EdgeCounts::WronglyWound, &EdgeCounts::Feature,
           &EdgeCounts::Constraint, &EdgeCounts::Region, &EdgeCounts::Fixed })
    {
      this->Edges.*kind += factor * part.*kind;
    }
  }
};

}

#endif
