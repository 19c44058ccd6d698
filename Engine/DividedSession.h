// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDSESSION_H
#define DELAUNAYFLIP_DIVIDEDSESSION_H

#include "Array.h"
#include "PreparedPieces.h"
#include "SessionWork.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <optional>

namespace delaunayflip
{

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
