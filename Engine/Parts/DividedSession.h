// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDSESSION_H
#define DELAUNAYFLIP_DIVIDEDSESSION_H

#include "Array.h"
#include "PieceFlip.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace delaunayflip
{

/// A session with a mesh that is flipped in parts, in one go. The functions are those of
/// FlipSession.
class DividedSession
{
public:
  /// @param triangles receives the triangles, as FlipInPieces says. Empty: a copy of this object
  /// does; then it also has flip counts.
  /// @throws as FlipInPieces.
  DividedSession(const TriangleMesh& mesh, const FlipOptions& options,
    const ProgressObserver& progress, const MutableTriangleArray& triangles = {});
  ~DividedSession();

  bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress);
  const PiecesReport& GetReport() const { return this->Report; }
  void StoreTriangles(const MutableTriangleArray& triangles) const;
  void StoreFlipCounts(std::int32_t* counts) const;

private:
  struct Run;

  bool Prepare(const ProgressObserver& progress);

  TriangleMesh Mesh; ///< The caller's.
  FlipOptions Options;
  ThreadBackend Threads;
  Array<std::int32_t> Ids32; ///< Three per triangle, if the caller's ids have 32 bits.
  Array<std::int64_t> Ids64; ///< If they have 64 bits.
  MutableTriangleArray Triangles; ///< These, or the array that was given.
  std::vector<std::int32_t> FlipCounts; ///< Empty if an array was given.
  std::unique_ptr<Run> Own; ///< None before the mesh is divided and after a run.
  PiecesReport Report;
};

}

#endif
