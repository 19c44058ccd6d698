// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionWork.h"

#include "DeviceCopies.h"
#include "DividedSession.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "WholeSession.h"

namespace delaunayflip
{

std::unique_ptr<SessionWork> SessionWork::Make(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  if (mesh.GetOnDevice())
  {
    if (options.NumberOfPieces > 1)
    {
      throw InvalidOptions("a mesh in the memory of a GPU cannot be flipped in several pieces");
    }
    return std::make_unique<WholeSession>(mesh, options, progress);
  }
  if (CountPieces(options, mesh.CountTriangles()) > 1)
  {
    return std::make_unique<DividedSession>(mesh, options, progress);
  }
  return std::make_unique<WholeSession>(mesh, options, progress);
}

void SessionWork::StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream& stream)
{
  RequireOnDevice(triangles);
  if (this->TryToStoreTriangles(triangles, stream))
  {
    return;
  }
  const auto pass = [&](auto* ids)
  {
    StoreThroughHost(ids, 3 * triangles.Count, stream,
      [&](auto* host) { this->StoreTriangles(MutableTriangleArray(host, triangles.Count)); });
  };
  triangles.Ids32 ? pass(triangles.Ids32) : pass(triangles.Ids64);
}

void SessionWork::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream)
{
  const std::int64_t size = this->Mesh.CountTriangles();
  RequireOnDevice(counts, size);
  if (!this->TryToStoreFlipCounts(counts, stream))
  {
    StoreThroughHost(
      counts, size, stream, [this](std::int32_t* host) { this->StoreFlipCounts(host); });
  }
}

}
