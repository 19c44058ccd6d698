// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PREPAREDPIECES_H
#define DELAUNAYFLIP_PREPAREDPIECES_H

#include "ConstraintInsertion.h"
#include "MeshInParts.h"
#include "PieceFlip.h"

#include <cstdint>

namespace delaunayflip
{

/// A mesh that is ready to be flipped in pieces: checked and divided, with its constraints
/// inserted.
class PreparedPieces
{
public:
  /// @param triangles where flips change them.
  /// @throws as FlipInPieces; RunAborted. Then no triangle has been written.
  PreparedPieces(const TriangleMesh& mesh, const FlipOptions& options,
    const MutableTriangleArray& triangles, const ProgressObserver& progress);
  PreparedPieces(const PreparedPieces&) = delete;
  PreparedPieces& operator=(const PreparedPieces&) = delete;

  /// What is known before the first flip.
  PiecesReport GetReport() const;

  /// @param flipCounts receives in how many flips each triangle slot took part, or null.
  PiecesReport Run(const ProgressObserver& progress, std::int32_t* flipCounts);

  /// What a run does that was stopped before there was such a mesh: copies the triangles.
  static PiecesReport Abort(
    const TriangleMesh& mesh, const MutableTriangleArray& triangles, int threads);

private:
  ConstraintInsertion Insertion;
  FlipOptions Options;
  MeshInParts Mesh;
};

}

#endif
