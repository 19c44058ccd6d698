// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDRUN_H
#define DELAUNAYFLIP_DIVIDEDRUN_H

#include "PieceFlip.h"

#include <memory>

namespace delaunayflip
{

/// A mesh that is flipped in parts, in one go.
struct DividedRun
{
  virtual ~DividedRun() = default;

  /// Makes all flips. To be called once.
  virtual void FlipAll(const ProgressObserver& progress) = 0;

  /// Whether nothing is left to do.
  bool IsOver() const
  {
    return this->Report.StopReason == StopReasonKind::Converged ||
      this->Report.StopReason == StopReasonKind::IterationLimit;
  }

  PiecesReport Report; ///< The report of the whole mesh.
  bool IsFresh = true; ///< Whether FlipAll has not been called.
  MutableTriangleArray Triangles; ///< The present triangles.
  std::vector<std::int32_t> FlipCounts; ///< One per triangle; empty if an array was given.
};

/// Inserts the constraints, surveys the mesh as a whole, divides it, and copies its triangles.
/// @param triangles receives the triangles, as FlipInPieces says. If it is empty, arrays of the
/// result do.
/// @throws as FlipInPieces; RunAborted. Then nothing has been copied.
std::unique_ptr<DividedRun> DivideMesh(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const MutableTriangleArray& triangles = {});

}

#endif
