// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPREADPOINTS_H
#define DELAUNAYFLIP_SPREADPOINTS_H

#include "ConstraintLoan.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Finds the points of borrowed triangles at which, when these are back, not only the rank may have
/// triangles that has had them all.
class SpreadPoints
{
public:
  /// @param rank this one. @param points how many the triangles of the task have.
  SpreadPoints(const InsertionTask& task, int rank, std::int64_t points);

  /// To be called for the triangles of the task before and after the insertion.
  void AddTriangles(const TriangleArray& triangles);

  /// Adds the end of a constraint: its edge must be known to all ranks.
  void AddEnd(std::int64_t point) { this->OwnerOf[point] = Several; }

  std::vector<std::int64_t> List() const;

private:
  static constexpr int None = -1, Several = -2;

  std::vector<int> Owners; ///< Of the triangles.
  std::vector<int> OwnerOf; ///< By point.
};

}

#endif
