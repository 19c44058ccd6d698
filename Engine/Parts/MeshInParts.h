// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHINPARTS_H
#define DELAUNAYFLIP_MESHINPARTS_H

#include "PieceFlip.h"

#include <memory>

namespace delaunayflip
{

/// A mesh of this process that is cut into parts. Each is flipped by itself, one after the other,
/// and then the triangles around the edges between them are flipped. The functions are to be called
/// once, in their order.
class MeshInParts
{
public:
  virtual ~MeshInParts() = default;

  /// About the share of the time of all flips that those of the parts take.
  static constexpr double PartsShare = 0.9;

  /// Counts the edges between parts, and finds those that stay.
  virtual void ExamineSeams() = 0;

  /// Flips the parts, and begins the report of the whole mesh. If an observer stops it, the report
  /// says so, and the triangles are valid.
  virtual void FlipParts(const ProgressObserver& progress) = 0;

  /// Flips the triangles around the edges between parts, as far as flips reach. Tells the same
  /// observer.
  virtual void FlipSeams() = 0;

  /// Counts what is left, and completes the report.
  virtual void Complete() = 0;

  PiecesReport Report; ///< The report of the whole mesh.
  MutableTriangleArray Triangles; ///< The present triangles.
  std::vector<std::int32_t> FlipCounts; ///< One per triangle; empty if an array was given.
};

/// Inserts the constraints, surveys the mesh as a whole, cuts it, and copies its triangles.
/// @param triangles receives the triangles, as FlipInPieces says; if empty, the result has arrays.
/// @throws as FlipInPieces; RunAborted. Then nothing has been copied.
std::unique_ptr<MeshInParts> CutIntoParts(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const MutableTriangleArray& triangles = {});

}

#endif
