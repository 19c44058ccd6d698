// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPENGINE_H
#define DELAUNAYFLIP_FLIPENGINE_H

#include "BuildProgress.h"
#include "DeviceMesh.h"
#include "EngineTriangles.h"
#include "FlipLoop.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <memory>

namespace delaunayflip
{

/// Restores the state of the calling thread that a backend has changed.
class DeviceScope
{
public:
  virtual ~DeviceScope() = default;
};

/// A mesh on a backend, ready to flip, as used by a session. BackendEngine.h makes one.
class FlipEngine
{
public:
  virtual ~FlipEngine() = default;

  /// Makes the engine's device current in the calling thread as long as the result is kept. Null if
  /// there is no device. Call this before any other function.
  virtual std::unique_ptr<DeviceScope> MakeCurrent() const = 0;

  virtual FlipLoop& GetLoop() = 0;

  /// What is known about the input before the first iteration.
  virtual const FlipReport& GetInputReport() const = 0;

  /// The same as FlipSession's.
  virtual void StoreTriangles(const MutableTriangleArray& triangles) const = 0;
  virtual void StoreFlipCounts(std::int32_t* counts) const = 0;
  virtual void StoreNeighbors(std::int32_t* neighbors) const = 0;
  virtual void StoreUsedPoints(std::int64_t* ids) const = 0;

  /// The same into device memory. @returns false, and writes nothing, if the engine's device cannot
  /// write it.
  virtual bool StoreTrianglesOnDevice(const MutableTriangleArray&, const DeviceStream&) const
  {
    return false;
  }
  virtual bool StoreFlipCountsOnDevice(std::int32_t*, const DeviceStream&) const { return false; }

  /// The triangles as they are in device memory, if they are.
  virtual EngineTriangles ViewTriangles() const { return {}; }
  /// The same in the host's memory.
  virtual HostTriangles ViewHostTriangles() const = 0;

  /// The triangles that flips have turned over in x and y, on a surface that was a height field or
  /// nearly one; else none.
  virtual Defect FindTurnedTriangles() const = 0;

  /// Throws std::logic_error if the edge mesh is inconsistent, which is a bug of the engine.
  virtual void Audit() const = 0;
};

/// @throws RunAborted.
std::unique_ptr<FlipEngine> MakeThreadEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// Triangulates points in the plane.
/// @param byDivision as BackendEngine's.
std::unique_ptr<FlipEngine> MakeThreadEngine(const PlaneArray& points, const FlipOptions& options,
  bool byDivision, const BuildProgress& progress);

/// @throws RunAborted.
/// @throws BackendUnavailable if there is no GPU, its memory runs out, its driver fails, or the
/// mesh needs the CPU. The message says why.
std::unique_ptr<FlipEngine> MakeCudaEngine(
  const TriangleMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// For arrays in the memory of FlipOptions::Device.
std::unique_ptr<FlipEngine> MakeCudaEngine(
  const DeviceMesh& mesh, const FlipOptions& options, const BuildProgress& progress);

/// For points in the host's memory.
std::unique_ptr<FlipEngine> MakeCudaEngine(const PlaneArray& points, const FlipOptions& options,
  bool byDivision, const BuildProgress& progress);

}

#endif
