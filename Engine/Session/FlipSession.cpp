// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionWork.h"

#include "SubMesh.h"
#include "ThreadBackend.h"

#include <numeric>
#include <type_traits>
#include <vector>

namespace delaunayflip
{

FlipSession::FlipSession(const TriangleMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const std::vector<ResultMemory>& expected)
  : Own(std::make_unique<Work>(CallerMesh(mesh), options, progress, expected))
{
}

FlipSession::FlipSession(
  const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Own(std::make_unique<Work>(CallerMesh(mesh), options, progress))
{
}

FlipSession::FlipSession(
  const PointInput& points, const PointOptions& options, const ProgressObserver& progress)
  : Own(std::make_unique<Work>(points, options, progress))
{
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
try
{
  Work& work = *this->Own;
  const TemporaryValue<ProgressObserver> told(work.Observer, progress);
  if (work.IsDivided)
  {
    return work.FlipDivided(iterations, observer, progress);
  }
  if (!work.Loaded)
  {
    work.Build();
  }
  work.TouchExpected();
  const std::vector<std::future<void>> touching = std::exchange(work.Touching, {});
  FlipReport& report = work.Report;
  const StopWatch watch;
  const double secondsBefore = report.FlipSeconds;
  const std::int64_t made = work.CountIterations();
  const std::int64_t limit = iterations < 0 ? NoLimit : made + std::min(iterations, NoLimit - made);
  work.Resume();
  work.InsertIfDone();
  work.IsMeasured = work.IsMeasured && !work.Cloud; // triangles may be removed
  work.AreSliversKnown = false;
  while (work.IsRunning() && work.CountIterations() < limit)
  {
    // At least one iteration; with observers no more than they can wait for.
    const StopWatch batchWatch;
    const std::int64_t first = work.CountIterations();
    const std::int64_t most = std::min(limit, work.GetIterationLimit()) - first;
    const AdvancePlan plan{ observer || progress ? std::min(most, work.GetBatch()) : most,
      first == 0, work.Options.TrackQuality };
    const TemporaryValue<bool> stoppable(work.MayStop, first == 0);
    const std::vector<IterationCounts> batch =
      work.OnBackend([&](LoadedMesh& mesh) { return mesh.GetLoop().Advance(plan); });
    work.IsMeasured = false;
    work.KeepFound(work.Loaded->GetLoop().GetFound());
    work.Keep(batch, batchWatch.GetSeconds());
#if !defined(NDEBUG)
    // Now that the iterations are in the report: the CPU repeats those where the GPU fails here.
    work.OnBackend([](const LoadedMesh& mesh) { mesh.Audit(); });
#endif
    work.Resume();
    work.DivideIfLong();
    work.InsertIfDone();
    bool continues = true;
    for (std::int64_t i = first; observer && i < work.CountIterations(); ++i)
    {
      continues = observer(report.Iterations[i]) && continues;
    }
    continues = continues &&
      (!work.IsRunning() ||
        work.Progress.TellFlips(progress, report, work.Found.Bad, work.GetIterationLimit()));
    if (!continues && work.IsRunning())
    {
      report.StopReason = StopReasonKind::Aborted;
    }
  }
  if (!work.IsRunning())
  {
    work.MeasureEnd();
  }
  report.FlipSeconds = secondsBefore + watch.GetSeconds();
  if (!work.IsRunning() && report.StopReason != StopReasonKind::Aborted)
  {
    work.Progress.Tell(progress, 1.0);
  }
  return work.IsRunning();
}
catch (const RunAborted&)
{
  this->Own->Abort();
  return false;
}
catch (...)
{
  this->Own->Reset(); // forgets what is half done
  throw;
}

void FlipSession::Expect(void* memory, std::int64_t bytes)
{
  this->Own->Expected.push_back({ memory, bytes });
}

const FlipReport& FlipSession::GetReport() const
{
  Work& work = *this->Own;
  try
  {
    if (work.Loaded)
    {
      work.MeasureEnd();
      work.Report.Backend = work.Loaded->GetInputReport().Backend;
      work.Report.Fallback = work.Fallback;
    }
  }
  catch (const RunAborted&)
  {
    work.Abort();
  }
  catch (...)
  {
    work.Reset();
    throw;
  }
  return work.Report;
}

/// Into the caller's input nothing is written until the whole result is known.
void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  Work& work = *this->Own;
  const auto store = [&](const LoadedMesh& mesh)
  {
    const auto write = [&](auto* ids)
    {
      work.StoreKept(3, ids, work.Mesh.HasTriangles(ids),
        [&](auto* all)
        { mesh.StoreTriangles(MutableTriangleArray(all, mesh.GetInputReport().Triangles)); });
    };
    triangles.Ids32 ? write(triangles.Ids32) : write(triangles.Ids64);
  };
  if (!work.TryOnBackend(store))
  {
    CopyTriangles(work.Divided ? AsConst(work.Divided->Triangles) : work.Mesh.GetOnHost().Triangles,
      triangles, ThreadBackend(work.Options.NumberOfThreads));
  }
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors) const
{
  Work& work = *this->Own;
  const PointRun& points = work.RequirePoints();
  const auto store = [&](const LoadedMesh& mesh)
  {
    work.StoreKept(3, neighbors, false,
      [&](std::int32_t* all)
      {
        mesh.StoreNeighbors(all);
        points.Renumber(all, 3 * mesh.GetInputReport().Triangles);
      });
  };
  work.TryOnBackend(store);
}

void FlipSession::StoreUsedPoints(std::int64_t* ids) const
{
  const PointRun& points = this->Own->RequirePoints();
  if (!this->Own->TryOnBackend([&](const LoadedMesh& mesh) { points.StoreUsedPoints(mesh, ids); }))
  {
    std::iota(ids, ids + this->Own->Report.Points, std::int64_t(0));
  }
}

const std::vector<AddedPoint>& FlipSession::GetAddedPoints() const
{
  return this->Own->RequirePoints().GetAddedPoints();
}

std::vector<std::int64_t> FlipSession::ListSegmentEdges() const
{
  const PointRun& points = this->Own->RequirePoints();
  std::vector<std::int64_t> pairs;
  this->Own->TryOnBackend([&](LoadedMesh& mesh) { pairs = points.ListSegmentEdges(mesh); });
  return pairs;
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  Work& work = *this->Own;
  const auto store = [&](const LoadedMesh& mesh)
  { work.StoreKept(1, counts, false, [&](std::int32_t* all) { mesh.StoreFlipCounts(all); }); };
  if (work.TryOnBackend(store))
  {
    work.Insertion.AddFlipCounts(counts);
  }
  else if (work.Divided)
  {
    std::copy(work.Divided->FlipCounts.begin(), work.Divided->FlipCounts.end(), counts);
  }
  else
  {
    std::fill_n(counts, work.Mesh.CountTriangles(), 0);
  }
}

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream, std::int32_t* written) const
{
  const auto write = [&](auto* ids)
  {
    this->Own->StoreOnDevice(
      DeviceArray<std::remove_pointer_t<decltype(ids)>>{ ids, 3 * triangles.Count, stream },
      "the array for triangles is",
      [&](const LoadedMesh& mesh)
      {
        // Divide and conquer makes other triangles, of no flips.
        return mesh.StoreTrianglesOnDevice(triangles, stream, this->Own->Cloud ? nullptr : written);
      },
      [&](auto* host) { this->StoreTriangles(MutableTriangleArray(host, triangles.Count)); });
  };
  triangles.Ids32 ? write(triangles.Ids32) : write(triangles.Ids64);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  Work& work = *this->Own;
  const std::int64_t size = work.Cloud ? work.Report.Triangles : work.Mesh.CountTriangles();
  work.StoreOnDevice(
    DeviceArray<std::int32_t>{ counts, size, stream }, "the array for flip counts is",
    [&](const LoadedMesh& mesh)
    { return !work.Insertion.HasFlips() && mesh.StoreFlipCountsOnDevice(counts, stream); },
    [this](std::int32_t* host) { this->StoreFlipCounts(host); });
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) const
{
  this->Own->RequirePoints();
  this->Own->StoreOnDevice(
    DeviceArray<std::int32_t>{ neighbors, 3 * this->Own->Report.Triangles, stream },
    "the array for neighbours is",
    [&](const LoadedMesh& mesh) { return mesh.StoreNeighborsOnDevice(neighbors, stream); },
    [this](std::int32_t* host) { this->StoreNeighbors(host); });
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
