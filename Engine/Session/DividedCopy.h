// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDCOPY_H
#define DELAUNAYFLIP_DIVIDEDCOPY_H

#include "Array.h"
#include "MeshInParts.h"
#include "PieceFlip.h"
#include "ThreadBackend.h"

#include <cstdint>
#include <optional>

namespace delaunayflip
{

/// A session's copy of the triangles of a mesh, which is flipped in parts, in one go. The functions
/// are those of FlipSession.
class DividedCopy
{
public:
  DividedCopy(
    const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress);
  const FlipReport& GetReport() const { return this->Report; }
  void StoreTriangles(const MutableTriangleArray& triangles) const;
  void StoreFlipCounts(std::int32_t* counts) const;

private:
  bool Prepare(const ProgressObserver& progress);
  bool IsOver() const;

  TriangleMesh Mesh; ///< The caller's.
  FlipOptions Options;
  ThreadBackend Threads;
  Array<std::int32_t> Ids32; ///< Three per triangle, if the caller's ids have 32 bits.
  Array<std::int64_t> Ids64; ///< If they have 64 bits.
  MutableTriangleArray Triangles; ///< These.
  Array<std::int32_t> FlipCounts; ///< Empty before a run.
  std::optional<MeshInParts> Parts; ///< None before the mesh is divided and after a run.
  FlipReport Report;
};

}

#endif
