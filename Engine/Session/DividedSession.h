// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDSESSION_H
#define DELAUNAYFLIP_DIVIDEDSESSION_H

#include "Array.h"
#include "ConstraintInsertion.h"
#include "MeshInParts.h"
#include "PieceFlip.h"
#include "SessionWork.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <optional>

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

/// Flips the pieces of a mesh in one go, in a copy of its triangles.
class DividedSession : public SessionWork
{
public:
  DividedSession(
    const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  bool Advance(std::int64_t iterations, const FlipObserver& observer,
    const ProgressObserver& progress) override;
  const FlipReport& GetReport() override { return this->Report; }

  using SessionWork::StoreTriangles;
  void StoreTriangles(const MutableTriangleArray& triangles) override;
  using SessionWork::StoreFlipCounts;
  void StoreFlipCounts(std::int32_t* counts) override;

private:
  bool Prepare(const ProgressObserver& progress);
  bool IsOver() const;
  MutableTriangleArray GetTriangles();

  FlipOptions Options;
  ThreadBackend Threads;
  Array<std::int32_t> Ids32; ///< Three per triangle, if the caller's ids have 32 bits.
  Array<std::int64_t> Ids64; ///< If they have 64 bits.
  Array<std::int32_t> FlipCounts; ///< Empty before a run.
  std::optional<PreparedPieces> Pieces; ///< None before they are prepared and after a run.
  PiecesReport Report;
};

}

#endif
