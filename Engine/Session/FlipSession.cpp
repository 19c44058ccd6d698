// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "Array.h"
#include "DividedSession.h"
#include "FlipError.h"
#include "InputChecks.h"
#include "SessionWork.h"
#include "WholeSession.h"

namespace delaunayflip
{

FlipSession::FlipSession(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Work(SessionWork::Make(CallerMesh(mesh), options, progress))
{
}

FlipSession::FlipSession(
  const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Work(SessionWork::Make(CallerMesh(mesh), options, progress))
{
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  return this->Work->Advance(iterations, observer, progress);
}

const FlipReport& FlipSession::GetReport() const { return this->Work->GetReport(); }

void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  this->Work->StoreTriangles(triangles);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  this->Work->StoreFlipCounts(counts);
}

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream) const
{
  this->Work->StoreTriangles(triangles, stream);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  this->Work->StoreFlipCounts(counts, stream);
}

EngineTriangles FlipSession::ViewTriangles() const { return this->Work->ViewTriangles(); }
HostTriangles FlipSession::ViewHostTriangles() const { return this->Work->ViewHostTriangles(); }

//------------------------------------------------------------------------------
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

//------------------------------------------------------------------------------
namespace
{
/// Runs a new session and calls store(session).
template <typename Store>
FlipReport RunToEnd(FlipSession session, const FlipObserver& observer,
  const ProgressObserver& progress, const Store& store)
{
  if (session.GetReport().StopReason != StopReasonKind::Aborted)
  {
    session.Advance(-1, observer, progress);
  }
  FlipReport report = session.GetReport(); // before anything is written: it takes memory
  store(session);
  if (session.GetReport().Fallback != report.Fallback) // a GPU may fail while its result is fetched
  {
    report = session.GetReport();
  }
  return report;
}
}

FlipReport FlipToDelaunay(const TriangleMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles); });
}

FlipReport FlipToDelaunay(const DeviceMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles, mesh.Stream); });
}

}
