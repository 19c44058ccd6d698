// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SESSIONWORK_H
#define DELAUNAYFLIP_SESSIONWORK_H

#include "CallerMesh.h"
#include "DelaunayFlip.h"
#include "EngineTriangles.h"
#include "StopWatch.h"

#include <cstdint>
#include <memory>

namespace delaunayflip
{

/// What a session does, for each way to do it. The functions are those of FlipSession.
class SessionWork
{
public:
  /// A session of the whole mesh, or of its pieces, as the options say.
  static std::unique_ptr<SessionWork> Make(
    const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);

  virtual ~SessionWork() = default;

  virtual bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress) = 0;
  virtual const FlipReport& GetReport() = 0;

  virtual void StoreTriangles(const MutableTriangleArray& triangles) = 0;
  virtual void StoreFlipCounts(std::int32_t* counts) = 0;
  void StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream& stream);
  void StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream);
  virtual EngineTriangles ViewTriangles() const { return {}; }
  virtual HostTriangles ViewHostTriangles() const { return {}; }

protected:
  explicit SessionWork(const CallerMesh& mesh)
    : Mesh(mesh)
  {
  }

  /// Stores on a device without a copy through the host.
  /// @returns whether that was possible.
  virtual bool TryToStoreTriangles(const MutableTriangleArray&, const DeviceStream&)
  {
    return false;
  }
  virtual bool TryToStoreFlipCounts(std::int32_t*, const DeviceStream&) { return false; }

  CallerMesh Mesh;
};

}

#endif
