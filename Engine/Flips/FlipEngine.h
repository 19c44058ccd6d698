// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPENGINE_H
#define DELAUNAYFLIP_FLIPENGINE_H

#include "BuildProgress.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>

namespace delaunayflip
{

/// Undoes what a backend did to the calling thread.
class DeviceScope
{
public:
  virtual ~DeviceScope() = default;
};

/// A mesh on a backend, ready to flip: what a session drives. BackendEngine.h makes one.
class FlipEngine
{
public:
  virtual ~FlipEngine() = default;

  /// Makes the engine's device current in the calling thread for as long as the result is kept;
  /// null where there is no device. Call it before any other function.
  virtual std::unique_ptr<DeviceScope> MakeCurrent() const = 0;

  virtual FlipLoop& GetLoop() = 0;

  /// What the input holds, as far as it is known before the first iteration.
  virtual const FlipReport& GetInputReport() const = 0;

  /// As FlipSession's.
  virtual void StoreTriangles(const MutableTriangleArray& triangles) const = 0;
  virtual void StoreFlipCounts(std::int32_t* counts) const = 0;

  /// On a surface that was a height field over x and y, or nearly: triangles that flips have turned
  /// over in x and y. Else none.
  virtual Defect FindTurnedTriangles() const = 0;

  /// Throws std::logic_error when the edge mesh is inconsistent: a fault of ours.
  virtual void Audit() const = 0;
};

/// @throws BuildAborted.
std::unique_ptr<FlipEngine> MakeThreadEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// @throws BuildAborted.
/// @throws BackendUnavailable: no GPU, no memory on it, a failure of the driver; or what it was
/// asked for needs the CPU. The message says why.
std::unique_ptr<FlipEngine> MakeCudaEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

}

#endif
