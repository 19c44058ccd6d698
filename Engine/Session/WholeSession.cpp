// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "WholeSession.h"

#include "BuildProgress.h"
#include "CudaDevice.h"
#include "HostMemory.h"
#include "InputChecks.h"
#include "StopWatch.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace delaunayflip
{

namespace
{
/// Iterations that a surface may take beyond its number of triangles before the loop gives up.
constexpr std::int64_t SafetyMargin = 1000;
constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

/// Gives a variable another value for as long as this lives.
template <typename Value>
class TemporaryValue
{
public:
  TemporaryValue(Value& variable, const Value& value)
    : Variable(variable),
      Before(std::exchange(variable, value))
  {
  }
  ~TemporaryValue() { this->Variable = std::move(this->Before); }
  TemporaryValue(const TemporaryValue&) = delete;
  TemporaryValue& operator=(const TemporaryValue&) = delete;

private:
  Value& Variable;
  Value Before;
};

bool WantsCuda(const CallerMesh& mesh, const FlipOptions& options)
{
  if (options.Backend != BackendKind::Auto)
  {
    return options.Backend == BackendKind::CUDA;
  }
  return mesh.GetOnDevice() || (mesh.CountTriangles() >= SmallestMeshForCuda && HasCudaDevice());
}

FlipOptions CheckInput(const CallerMesh& mesh, const FlipOptions& options)
{
  CheckOptions(options);
  CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
  FlipOptions checked = options;
  checked.Device = mesh.ChooseDevice(options.Device);
  return checked;
}

/// Makes the iterations of a lost engine again, in batches of up to a tenth of a second.
void Repeat(FlipLoop& loop, std::int64_t iterations, const BuildProgress& progress)
{
  std::int64_t batch = 1;
  for (std::int64_t done = 0; done < iterations;)
  {
    const StopWatch watch;
    const AdvancePlan plan{ std::min(batch, iterations - done), false, false };
    done += static_cast<std::int64_t>(loop.Advance(plan).size());
    batch = watch.GetSeconds() < 0.05 ? 2 * batch : batch;
    progress.Tell(0.0);
  }
}

/// Stores into a temporary array first, so that the target is unchanged after a failure.
template <typename Id>
void StoreAtOnce(const FlipEngine& engine, Id* ids, std::int64_t count)
{
  HostMemory memory;
  Array<Id> stored(static_cast<std::size_t>(3 * count), memory);
  engine.StoreTriangles(MutableTriangleArray(stored.Data(), count));
  std::copy_n(stored.Data(), 3 * count, ids);
}
}

WholeSession::WholeSession(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : SessionWork(mesh),
    Options(CheckInput(mesh, options)),
    Observer(progress)
{
  this->Try([this]() { this->Build(); });
}

//------------------------------------------------------------------------------
/// Checks, inserts constraints, makes the engine, and reports on the input. When an exception
/// leaves, there is no engine.
void WholeSession::Build()
{
  try
  {
    this->BuildEngine();
  }
  catch (...)
  {
    this->Reset();
    throw;
  }
}

void WholeSession::BuildEngine()
{
  const StopWatch watch;
  const ProgressObserver tell = [this](double share)
  { return this->Progress.Tell(this->Observer, share); };
  const CallerMesh mesh = this->InsertConstraints(tell);
  const double begin = this->Insertion.GetShare();
  const BuildProgress progress(
    [tell, begin](double share) { return tell(begin + (1.0 - begin) * share); });
  this->Input.emplace(EngineInput{ mesh, this->Insertion.GetOptions(this->Options), progress });
  this->MakeEngine();
  this->Report = this->Engine->GetInputReport();
  this->Insertion.AddTo(this->Report);
  const GeometryKind geometry = this->Report.GeometryUsed;
  progress.Reach(geometry, BuildStep::Prepared);
  this->Report.MinimumAngleBefore = this->MeasureAngle();
  this->Report.MinimumAngleAfter = this->Report.MinimumAngleBefore;
  this->Report.BuildSeconds = watch.GetSeconds();
  progress.Reach(geometry, BuildStep::Measured);

  const StopWatch flipWatch;
  this->Detected(this->OnEngine([](FlipEngine& engine) { return engine.GetLoop().Detect(); }));
  this->HasDetected = true;
  this->Report.NonDelaunayBefore = this->Report.NonDelaunayAfter;
  this->Report.FlipSeconds = flipWatch.GetSeconds();
  progress.Reach(geometry, BuildStep::Tested);
  this->Progress.StartFlips(this->Found.Bad, this->Report.BuildSeconds, this->Report.FlipSeconds);
}

/// @returns the mesh that iterations start from.
CallerMesh WholeSession::InsertConstraints(const ProgressObserver& tell)
{
  this->Insertion = ConstraintInsertion();
  if (!this->Mesh.HasConstraintsToInsert())
  {
    return this->Mesh;
  }
  const TriangleMesh& mesh = this->Mesh.GetOnHost();
  this->Insertion = ConstraintInsertion(mesh, this->Options,
    [&](double share) { return tell(ConstraintInsertion::ShareOfRun * share); });
  return CallerMesh(this->Insertion.GetMesh(mesh));
}

void WholeSession::MakeEngine()
{
  EngineInput& input = *this->Input;
  if (!WantsCuda(input.Mesh, input.Options))
  {
    this->Engine = MakeThreadEngine(input.Mesh.GetOnHost(), input.Options, input.Progress);
    return;
  }
  try
  {
    const DeviceMesh* device = input.Mesh.GetOnDevice();
    this->Engine = device ? MakeCudaEngine(*device, input.Options, input.Progress)
                          : MakeCudaEngine(input.Mesh.GetOnHost(), input.Options, input.Progress);
  }
  catch (const BackendUnavailable& error)
  {
    this->FallBack(error);
  }
}

/// Replaces a GPU that has failed by the CPU, which repeats all iterations that were reported. To
/// be called while the error is handled.
void WholeSession::FallBack(const BackendUnavailable& error)
{
  if (this->Options.Backend == BackendKind::CUDA)
  {
    throw;
  }
  EngineInput& input = *this->Input;
  this->Fallback = error.what();
  this->Engine.reset();
  this->Engine = MakeThreadEngine(input.Mesh.GetOnHost(), input.Options, input.Progress);
  if (this->HasDetected)
  {
    FlipLoop& loop = this->Engine->GetLoop();
    input.Progress.Reach(this->Report.GeometryUsed, BuildStep::Measured);
    loop.Detect();
    input.Progress.Reach(this->Report.GeometryUsed, BuildStep::Tested);
    Repeat(loop, static_cast<std::int64_t>(this->Report.Iterations.size()), input.Progress);
  }
}

void WholeSession::Reset()
{
  this->Engine.reset();
  this->Input.reset();
  this->Fallback.clear();
  this->HasDetected = false;
  this->Insertion = ConstraintInsertion();
  this->Report = FlipReport();
  this->Report.Points = this->Mesh.CountPoints();
  this->Report.Triangles = this->Mesh.CountTriangles();
  this->IsMeasured = true;
}

//------------------------------------------------------------------------------
bool WholeSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  const TemporaryValue<ProgressObserver> told(this->Observer, progress);
  const auto run = [&]()
  {
    if (!this->Engine)
    {
      this->Build();
    }
    const StopWatch watch;
    const double secondsBefore = this->Report.FlipSeconds;
    this->Resume();
    const auto done = [this]()
    { return static_cast<std::int64_t>(this->Report.Iterations.size()); };
    const std::int64_t limit = iterations < 0 ? NoLimit : done() + iterations;
    while (this->IsRunning() && done() < limit)
    {
      this->Iterate(std::min(limit, this->GetIterationLimit()) - done(), observer, progress);
    }
    if (!this->IsRunning())
    {
      this->MeasureEnd();
    }
    this->Report.FlipSeconds = secondsBefore + watch.GetSeconds();
    if (!this->IsRunning() && this->Report.StopReason != StopReasonKind::Aborted)
    {
      this->Progress.Tell(progress, 1.0);
    }
  };
  return this->Try(run) && this->IsRunning();
}

std::int64_t WholeSession::GetIterationLimit() const
{
  if (this->Options.MaximumIterations >= 0)
  {
    return this->Options.MaximumIterations;
  }
  const bool mayCycle = this->Report.GeometryUsed == GeometryKind::Surface ||
    this->Options.Criterion == CriterionKind::OppositeAngles;
  return mayCycle ? this->Report.Triangles + SafetyMargin : NoLimit;
}

/// Continues, even after an abort, unless there is nothing to do or no iteration is left.
void WholeSession::Resume()
{
  const auto done = static_cast<std::int64_t>(this->Report.Iterations.size());
  this->Report.StopReason = StopReasonKind::Running;
  if (this->Found.Bad == 0)
  {
    this->Report.StopReason = StopReasonKind::Converged;
  }
  else if (done >= this->GetIterationLimit())
  {
    this->Report.StopReason = StopReasonKind::IterationLimit;
  }
}

/// Runs at least one iteration and at most `most`.
void WholeSession::Iterate(
  std::int64_t most, const FlipObserver& observer, const ProgressObserver& progress)
{
  const StopWatch watch;
  const std::size_t first = this->Report.Iterations.size();
  const bool isWatched = observer || progress;
  const AdvancePlan plan{ isWatched ? std::min(most, this->Progress.GetBatch()) : most, first == 0,
    this->Options.TrackQuality };
  const std::vector<IterationCounts> iterations =
    this->OnEngine([&](FlipEngine& engine) { return engine.GetLoop().Advance(plan); });
  this->IsMeasured = false;
  this->Detected(this->Engine->GetLoop().GetFound());
  const double seconds = watch.GetSeconds() / static_cast<double>(iterations.size());
  this->Progress.KeepTime(seconds);
  for (const IterationCounts& counts : iterations)
  {
    this->Keep(counts, seconds);
  }
#if !defined(NDEBUG)
  // Now that the iterations are in the report: the CPU repeats those where the GPU fails here.
  this->OnEngine([](const FlipEngine& engine) { engine.Audit(); });
#endif
  this->Resume();
  this->Tell(observer, first);
  if (this->IsRunning() &&
    !this->Progress.TellFlips(progress, this->Report, this->Found.Bad, this->GetIterationLimit()))
  {
    this->Report.StopReason = StopReasonKind::Aborted;
  }
}

void WholeSession::Detected(const StepCounts& found)
{
  this->Found = found;
  this->Report.NonDelaunayAfter = found.Bad + found.GetBlocked();
  this->Report.BlockedByShape = found.BlockedByShape;
  this->Report.BlockedByEdge = found.BlockedByEdge;
}

void WholeSession::Keep(const IterationCounts& counts, double seconds)
{
  IterationRecord record;
  record.Iteration = static_cast<std::int64_t>(this->Report.Iterations.size()) + 1;
  record.Tested = counts.Tested;
  record.NonDelaunay = counts.Bad + counts.Blocked;
  record.Blocked = counts.Blocked;
  record.Flipped = counts.Flipped;
  record.Excluded = counts.Bad - counts.Flipped;
  record.MinimumAngle = ToDegrees(counts.SquaredCotangent);
  record.Seconds = seconds;
  this->Report.Iterations.push_back(record);
  this->Report.TotalFlips += record.Flipped;
  this->Report.TotalExcluded += record.Excluded;
  this->Report.TotalBlocked += record.Blocked;
}

/// Calls the observer for the iterations from `first` on, once all of them are in the report.
void WholeSession::Tell(const FlipObserver& observer, std::size_t first)
{
  bool continues = true;
  for (std::size_t i = first; observer && i < this->Report.Iterations.size(); ++i)
  {
    continues = observer(this->Report.Iterations[i]) && continues;
  }
  if (!continues && this->IsRunning())
  {
    this->Report.StopReason = StopReasonKind::Aborted;
  }
}

//------------------------------------------------------------------------------
const FlipReport& WholeSession::GetReport()
{
  this->Try([this]() { this->MeasureEnd(); });
  if (this->Engine)
  {
    this->Report.Backend = this->Engine->GetInputReport().Backend;
    this->Report.Fallback = this->Fallback;
  }
  return this->Report;
}

/// The smallest angle is known after the first and the last iteration. If a run stops in between,
/// this takes a pass over the mesh, made only when the report is requested. Also lists the defects
/// of the input and, at the end of a run, those that flips have caused.
void WholeSession::MeasureEnd()
{
  if (this->IsMeasured)
  {
    return;
  }
  this->Report.MinimumAngleAfter = this->MeasureAngle();
  this->IsMeasured = true;
  this->Report.Defects = this->Engine->GetInputReport().Defects;
  AddDefects(this->Insertion.GetRefused(), this->Report.Defects);
  if (!this->IsRunning())
  {
    this->Report.Iterations.back().MinimumAngle = this->Report.MinimumAngleAfter;
    const Defect turned =
      this->OnEngine([](const FlipEngine& engine) { return engine.FindTurnedTriangles(); });
    if (turned.Count > 0)
    {
      this->Report.Defects.push_back(turned);
    }
  }
}

double WholeSession::MeasureAngle()
{
  return ToDegrees(this->OnEngine(
    [](FlipEngine& engine) { return engine.GetLoop().FindLargestSquaredCotangent(); }));
}

//------------------------------------------------------------------------------
/// Into the caller's input nothing is written until the whole result is known.
void WholeSession::StoreTriangles(const MutableTriangleArray& triangles)
{
  const bool atOnce = this->Mesh.HasTriangles(triangles.Data());
  const auto store = [&](const FlipEngine& engine)
  {
    if (!atOnce)
    {
      engine.StoreTriangles(triangles);
    }
    else if (triangles.Ids32)
    {
      StoreAtOnce(engine, triangles.Ids32, triangles.Count);
    }
    else
    {
      StoreAtOnce(engine, triangles.Ids64, triangles.Count);
    }
  };
  if (this->Engine && this->Try([&]() { this->OnEngine(store); }))
  {
    return;
  }
  const TriangleArray& input = this->Mesh.GetOnHost().Triangles;
  for (std::int64_t id = 0; id < 3 * triangles.Count; ++id)
  {
    const int slot = static_cast<int>(id % 3);
    triangles.Set(id / 3, slot, input.Get(id / 3, slot));
  }
}

bool WholeSession::TryToStoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream)
{
  bool isStored = false;
  const auto store = [&](const FlipEngine& engine)
  { isStored = engine.StoreTrianglesOnDevice(triangles, stream); };
  return this->Engine && this->Try([&]() { this->OnEngine(store); }) && isStored;
}

void WholeSession::StoreFlipCounts(std::int32_t* counts)
{
  const auto store = [&](const FlipEngine& engine) { engine.StoreFlipCounts(counts); };
  if (this->Engine && this->Try([&]() { this->OnEngine(store); }))
  {
    this->Insertion.AddFlipCounts(counts);
  }
  else
  {
    std::fill_n(counts, this->Mesh.CountTriangles(), 0);
  }
}

bool WholeSession::TryToStoreFlipCounts(std::int32_t* counts, const DeviceStream& stream)
{
  bool isStored = false;
  const auto store = [&](const FlipEngine& engine)
  { isStored = engine.StoreFlipCountsOnDevice(counts, stream); };
  return this->Engine && !this->Insertion.HasFlips() &&
    this->Try([&]() { this->OnEngine(store); }) && isStored;
}

/// None if the engine's flips are not all.
EngineTriangles WholeSession::ViewTriangles() const
{
  return this->Engine && !this->Insertion.HasFlips() ? this->Engine->ViewTriangles()
                                                     : EngineTriangles();
}

HostTriangles WholeSession::ViewHostTriangles() const
{
  return this->Engine && !this->Insertion.HasFlips() ? this->Engine->ViewHostTriangles()
                                                     : HostTriangles();
}

}
