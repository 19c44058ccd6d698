// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "Array.h"
#include "InputChecks.h"
#include "MeshRun.h"
#include "PiecesRun.h"
#include "PointRun.h"
#include "SphereRun.h"

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
/// An array in the memory of a device, ordered by a stream.
template <typename Value>
struct DeviceArray
{
  Value* Values;
  std::int64_t Size;
  DeviceStream Stream;
};

/// Writes values into device memory by store(), which says whether it could, or else by
/// storeOnHost(values) and a copy.
/// @param what the array, for messages.
template <typename Value, typename Store, typename StoreOnHost>
void StoreOnDevice(
  DeviceArray<Value> values, const char* what, const Store& store, const StoreOnHost& storeOnHost)
{
  RequireOnDevice(values.Values, values.Size, what);
  if (!store() && values.Size > 0)
  {
    std::vector<Value> all(values.Size);
    storeOnHost(all.data());
    CopyMemory(all.data(), values.Size * static_cast<std::int64_t>(sizeof(Value)), values.Values,
      values.Stream);
  }
}
}

FlipSession::FlipSession(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const std::vector<ResultMemory>& expected)
{
  CheckOptions(options);
  if (CountPieces(options, mesh.Triangles.Count) > 1)
  {
    RefuseRefinement(options, mesh, "a mesh in several pieces");
    this->Run = std::make_unique<PiecesRun>(mesh, options, progress);
    return;
  }
  auto run = std::make_unique<MeshRun>(CallerMesh(mesh), options, progress);
  for (const ResultMemory& memory : expected)
  {
    run->Expect(memory);
  }
  run->Begin();
  this->Run = std::move(run);
}

FlipSession::FlipSession(
  const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
{
  const CallerMesh caller(mesh);
  if (options.NumberOfPieces > 1)
  {
    throw InvalidOptions("a mesh in the memory of a GPU cannot be flipped in several pieces");
  }
  CheckOptions(options);
  auto run = std::make_unique<MeshRun>(caller, options, progress);
  run->Begin();
  this->Run = std::move(run);
}

FlipSession::FlipSession(
  const PointInput& points, const PointOptions& options, const ProgressObserver& progress)
{
  if (options.Projection != ProjectionKind::Plane)
  {
    this->Run = std::make_unique<SphereRun>(points, options, progress);
    return;
  }
  auto run = std::make_unique<PointRun>(points, options, progress);
  run->Begin();
  this->Run = std::move(run);
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  return this->Run->Advance(iterations, observer, progress);
}

void FlipSession::Expect(void* memory, std::int64_t bytes) { this->Run->Expect({ memory, bytes }); }

std::int64_t FlipSession::CountTriangles() const { return this->Run->CountTriangles(); }

const FlipReport& FlipSession::GetReport() const { return this->Run->GetReport(); }

void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  this->Run->StoreTriangles(triangles);
}

void FlipSession::StoreOrderedTriangles(const MutableTriangleArray& triangles) const
{
  this->Run->StoreOrderedTriangles(triangles);
}

bool FlipSession::Insert(const PlaneArray& points, const ProgressObserver& progress)
{
  return this->Run->Insert(points, progress);
}

bool FlipSession::Move(const PointMove& move, const ProgressObserver& progress)
{
  return this->Run->Move(move, progress);
}

bool FlipSession::Remove(
  const std::int64_t* ids, std::int64_t count, const ProgressObserver& progress)
{
  return this->Run->Remove(ids, count, progress);
}

bool FlipSession::Compact(const ProgressObserver& progress) { return this->Run->Compact(progress); }

bool FlipSession::Ask(const PlaceQuery& query, const ProgressObserver& progress) const
{
  return this->Run->Ask(query, progress);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  this->Run->StoreFlipCounts(counts);
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors) const
{
  this->Run->StoreNeighbors(neighbors);
}

void FlipSession::StoreUsedPoints(std::int64_t* ids) const { this->Run->StoreUsedPoints(ids); }

const std::vector<AddedPoint>& FlipSession::GetAddedPoints() const
{
  return this->Run->GetAddedPoints();
}

void FlipSession::StoreAddedPoints(const AddedPointArrays& arrays) const
{
  this->Run->StoreAddedPoints(arrays);
}

void FlipSession::StoreSources(std::int32_t* sources) const { this->Run->StoreSources(sources); }

std::vector<std::int64_t> FlipSession::ListSegmentEdges() const
{
  return this->Run->ListSegmentEdges();
}

std::vector<std::int64_t> FlipSession::ListSegmentsOfEdges() const
{
  return this->Run->ListSegmentsOfEdges();
}

void FlipSession::StoreRegions(std::int32_t* labels) const { this->Run->StoreRegions(labels); }

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream, std::int32_t* written) const
{
  const auto write = [&](auto* ids)
  {
    StoreOnDevice(
      DeviceArray<std::remove_pointer_t<decltype(ids)>>{ ids, 3 * triangles.Count, stream },
      "the array for triangles is",
      [&] { return this->Run->StoreTrianglesOnDevice(triangles, stream, written); },
      [&](auto* host) { this->StoreTriangles(MutableTriangleArray(host, triangles.Count)); });
  };
  if (triangles.Ids32)
  {
    write(triangles.Ids32);
  }
  else
  {
    write(triangles.Ids64);
  }
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  const std::int64_t size = this->Run->CountTriangles();
  StoreOnDevice(
    DeviceArray<std::int32_t>{ counts, size, stream }, "the array for flip counts is",
    [&] { return this->Run->StoreFlipCountsOnDevice(counts, stream); },
    [this](std::int32_t* host) { this->StoreFlipCounts(host); });
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) const
{
  SessionRun& run = *this->Run;
  StoreOnDevice(
    DeviceArray<std::int32_t>{ neighbors, 3 * run.CountTriangles(), stream },
    "the array for neighbours is", [&] { return run.StoreNeighborsOnDevice(neighbors, stream); },
    [&run](std::int32_t* host) { run.StoreNeighbors(host); });
}

//------------------------------------------------------------------------------
void CheckOptionsAndBackend(const FlipOptions& options)
{
  CheckOptions(options);
  CheckTieRule(options, options.Geometry);
  if (options.Backend == BackendKind::CUDA)
  {
    LoadOnCuda(TriangleMesh(), options, {}); // throws if the GPU cannot be used
  }
}

namespace
{
constexpr const char* InOneCall = "without a session, a mesh";

/// Runs a new session and calls store(session).
template <typename Store>
FlipReport RunToEnd(FlipSession session, const FlipObserver& observer,
  const ProgressObserver& progress, const Store& store)
{
  if (session.GetReport().StopReason != StopReasonKind::Aborted)
  {
    session.Advance(-1, observer, progress);
  }
  FlipReport report = session.GetReport(); // now, because it may run out of memory
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
  RefuseRefinement(options, mesh, InOneCall);
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles); });
}

FlipReport FlipToDelaunay(const DeviceMesh& mesh, const FlipOptions& options,
  const MutableTriangleArray& triangles, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  RefuseRefinement(options, mesh, InOneCall);
  return RunToEnd(FlipSession(mesh, options, progress), observer, progress,
    [&](const FlipSession& session) { session.StoreTriangles(triangles, mesh.Stream); });
}

}
