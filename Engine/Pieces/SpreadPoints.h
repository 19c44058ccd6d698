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

/// Finds the points of an InsertionTask that must be shared after ReturnTriangles: those at which
/// several ranks own triangles, before or after the insertion, and the ends of the constraints.
class SpreadPoints
{
public:
  /// @param rank this rank. @param points the number of points of the task's triangles.
  SpreadPoints(const InsertionTask& task, int rank, std::int64_t points);

  /// To be called for the triangles of the task before and after the insertion.
  void AddTriangles(const TriangleArray& triangles);

  /// Adds the end of a constraint. It counts as shared, so that all ranks learn of the new edge.
  void AddEnd(std::int64_t point) { this->OwnerOf[point] = Several; }

  std::vector<std::int64_t> List() const;

private:
  static constexpr int None = -1, Several = -2;

  std::vector<int> Owners; ///< By triangle of the task: its owner, the rank it goes back to.
  std::vector<int> OwnerOf; ///< By point: the owner of all its triangles, or None, or Several.
};

}

#endif
