// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DELAUNAYFLIP_H
#define DELAUNAYFLIP_DELAUNAYFLIP_H

#include "EngineExport.h"
#include "FlipError.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

/// @file
/// The door of the engine.

namespace delaunayflip
{

/// A mesh on its way to Delaunay: made once from the caller's arrays, advanced by iterations, read
/// out at any time between them. With BackendKind::Auto the caller's arrays must stay as they are
/// as long as it lives: where a GPU fails, the CPU starts from them. Else they are not needed after
/// the constructor, unless a progress observer stopped it.
///
/// Same mesh and options, same result, bit for bit, for any number of threads and any backend.
class DELAUNAYFLIP_EXPORT FlipSession
{
public:
  /// Builds the edge mesh and tests all edges. When `progress` returns false meanwhile, the
  /// report's StopReason is Aborted and the triangles are those of the input; an Advance builds
  /// again.
  /// @throws InvalidMesh, InvalidOptions, MeshTooLarge, BackendUnavailable, std::bad_alloc.
  FlipSession(
    const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress = {});
  ~FlipSession();
  FlipSession(FlipSession&&) noexcept;
  FlipSession& operator=(FlipSession&&) noexcept;

  /// Runs at most `iterations` more iterations (-1: until a stop). Ends earlier when converged, at
  /// the limit of the options, or when an observer returns false. The next call goes on from there.
  /// @returns whether there is more to do and the run was not stopped.
  /// @throws as the constructor, where that was stopped.
  bool Advance(std::int64_t iterations = -1, const FlipObserver& observer = {},
    const ProgressObserver& progress = {});

  /// What has happened so far. The first call after an Advance that did not reach the end looks for
  /// the smallest angle, a pass over the mesh.
  const FlipReport& GetReport() const;

  /// Writes the triangles in their input slots. A triangle that no flip touched keeps its three ids
  /// in their order. `triangles.Count` must be that of the input.
  void StoreTriangles(const MutableTriangleArray& triangles) const;

  /// Writes, for every triangle slot, how many flips it was part of (report.Triangles numbers).
  void StoreFlipCounts(std::int32_t* counts) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> Impl;
};

/// The edges of two triangles that never flip in a run with these options: pairs of vertex ids.
/// Given as constraint edges, with a feature angle of 180, to a run over the same triangles, or
/// what flips made of them, they stay the edges that never flip when points have moved.
/// @throws as FlipSession's constructor.
DELAUNAYFLIP_EXPORT std::vector<std::int64_t> FindFixedEdges(
  const TriangleMesh& mesh, const FlipOptions& options);

/// What GeometryKind::Auto comes to for a mesh; other kinds are what they are.
/// @throws as FlipSession's constructor.
DELAUNAYFLIP_EXPORT GeometryKind FindGeometry(const TriangleMesh& mesh, const FlipOptions& options);

/// The whole way at once: flips `mesh` and writes the result to `triangles`, which may be the very
/// array that mesh.Triangles views. Nothing is written when an exception leaves.
/// @throws as FlipSession's constructor.
DELAUNAYFLIP_EXPORT FlipReport FlipToDelaunay(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer = {},
  const ProgressObserver& progress = {});

}

#endif
