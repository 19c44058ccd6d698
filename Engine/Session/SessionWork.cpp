// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SessionWork.h"

#include "CudaDevice.h"
#include "InputChecks.h"
#include "SmallestAngle.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <thread>

namespace delaunayflip
{

CallerMesh::CallerMesh(const DeviceMesh& mesh)
  : Device(mesh)
{
  if (mesh.Points.Components != 2 && mesh.Points.Components != 3)
  {
    throw InvalidOptions(
      "points must have 2 or 3 components, not " + std::to_string(mesh.Points.Components));
  }
  static_cast<FixedEdges&>(this->Host) = mesh;
  this->Host.Points.Count = mesh.Points.Count;
  this->Host.Triangles.Count = mesh.Triangles.Count;
}

const TriangleMesh& CallerMesh::GetOnHost()
{
  if (!this->Device || !this->Copies.empty())
  {
    return this->Host;
  }
  std::vector<std::shared_ptr<const void>> copies;
  const auto copy = [&](const auto* values, std::int64_t size, std::int64_t room)
  {
    using Value = std::decay_t<decltype(*values)>;
    const auto made = std::make_shared<std::vector<Value>>(room);
    if (size > 0)
    {
      CopyMemory(values, size * static_cast<std::int64_t>(sizeof(Value)), made->data(),
        this->Device->Stream);
    }
    copies.push_back(made);
    return made->data();
  };
  const DevicePointArray& points = this->Device->Points;
  const auto copyPoints = [&](const auto* values) // those of a plane get z = 0
  {
    auto* xyz = copy(values, points.Components * points.Count, 3 * points.Count);
    for (std::int64_t i = points.Components == 2 ? points.Count : 0; i-- > 0;)
    {
      const auto x = xyz[2 * i], y = xyz[2 * i + 1];
      xyz[3 * i] = x;
      xyz[3 * i + 1] = y;
      xyz[3 * i + 2] = 0;
    }
    return PointArray(xyz, points.Count);
  };
  const TriangleArray& triangles = this->Device->Triangles;
  const auto copyTriangles = [&](const auto* ids)
  { return TriangleArray(copy(ids, 3 * triangles.Count, 3 * triangles.Count), triangles.Count); };
  const PointArray made = points.Floats ? copyPoints(points.Floats) : copyPoints(points.Doubles);
  this->Host.Triangles =
    triangles.Ids32 ? copyTriangles(triangles.Ids32) : copyTriangles(triangles.Ids64);
  this->Host.Points = made;
  this->Copies = std::move(copies);
  return this->Host;
}

int RequireOnDevice(const void* memory, std::int64_t size, const char* what)
{
  const int device = size > 0 ? FindDeviceOf(memory) : -1;
  if (size > 0 && device < 0)
  {
    throw InvalidOptions(std::string(what) +
      " not in the memory of a GPU; arrays in the host's "
      "memory are flipped on a GPU by the functions for these");
  }
  return device;
}

int CallerMesh::ChooseDevice(int requested) const
{
  int chosen = requested;
  const auto join = [&](const auto& array, const char* what)
  {
    const int device = RequireOnDevice(array.Data(), array.Count, what);
    if (chosen >= 0 && device >= 0 && device != chosen)
    {
      throw InvalidOptions(std::string(what) + " in the memory of GPU " + std::to_string(device) +
        ", but GPU " + std::to_string(chosen) + " has other arrays of the mesh or was requested");
    }
    chosen = std::max(chosen, device);
  };
  if (this->Device)
  {
    join(this->Device->Points, "the points are");
    join(this->Device->Triangles, "the triangles are");
  }
  return chosen;
}

//------------------------------------------------------------------------------
FlipSession::Work::Work(const CallerMesh& mesh, const FlipOptions& options,
  const ProgressObserver& progress, const std::vector<ResultMemory>& expected)
  : Mesh(mesh),
    Options(options),
    Observer(progress),
    Expected(expected)
{
  if (mesh.GetOnDevice() && options.NumberOfPieces > 1)
  {
    throw InvalidOptions("a mesh in the memory of a GPU cannot be flipped in several pieces");
  }
  CheckOptions(options);
  this->IsDivided = !mesh.GetOnDevice() && CountPieces(options, mesh.CountTriangles()) > 1;
  if (!this->IsDivided)
  {
    CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
  }
  this->Options.Device = mesh.ChooseDevice(options.Device);
  this->TryToBuild();
}

FlipSession::Work::Work(
  const PointInput& points, const PointOptions& options, const ProgressObserver& progress)
  : Mesh(TriangleMesh()),
    Cloud(std::make_unique<PointRun>(points, options)),
    Options(options),
    Observer(progress)
{
  CheckOptions(options);
  constexpr std::int64_t MostToDouble = std::int64_t(1) << 40; // and far more than are supported
  CheckMeshSize(2 * std::min(points.Points.Count, MostToDouble), points.Points.Count, "");
  if (points.OnDevice)
  {
    const int device = RequireOnDevice(points.Points.Data(), points.Points.Count, "the points are");
    this->Options.Device = device >= 0 ? device : options.Device;
  }
  this->Options.Geometry = GeometryKind::PlanarXY;
  this->Options.Criterion = CriterionKind::InCircle;
  this->Options.TieRule = TieRuleKind::Canonical;
  this->Options.NumberOfPieces = 1;
  this->TryToBuild();
}

//------------------------------------------------------------------------------
void FlipSession::Work::TouchExpected()
{
  std::vector<ResultMemory> expected = std::exchange(this->Expected, {});
  if (expected.empty() || !this->OnCuda)
  {
    return;
  }
  // Measured on an H100 with 16 cores: with more threads the copies to the GPU wait.
  constexpr int Most = 4;
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int asked = this->Options.NumberOfThreads;
  const int threads = std::min({ Most, cores, asked == 0 ? cores : asked });
  const auto touch = [blocks = std::move(expected), threads]()
  {
    const ThreadBackend backend(threads);
    for (const ResultMemory& block : blocks)
    {
      backend.TouchPages(block.First, block.Bytes);
    }
  };
  try
  {
    this->Touching.push_back(std::async(std::launch::async, touch));
  }
  catch (const std::exception&) // there is no thread left
  {
  }
}

void FlipSession::Work::TryToBuild()
{
  try
  {
    this->Build();
  }
  catch (const RunAborted&)
  {
    this->Abort();
  }
}

/// Inserts constraints, loads the mesh, reports on the input, and tests all edges. When an
/// exception leaves, no mesh is loaded.
void FlipSession::Work::Build()
try
{
  if (this->IsDivided)
  {
    this->Reset(); // frees the arrays of a run before
    this->Divided = DivideMesh(this->Mesh.GetOnHost(), this->Options, this->Observer);
    this->Report = this->Divided->Report;
    return;
  }
  const StopWatch watch;
  const TemporaryValue<bool> stoppable(this->MayStop, true);
  const auto tell = [this](double share)
  { return !this->MayStop || this->Progress.Tell(this->Observer, share); };
  this->Insertion = ConstraintInsertion();
  this->Start = this->Mesh;
  if (this->Cloud)
  {
    this->Cloud->Prepare(this->Observer);
  }
  if (ConstraintInsertion::IsRequested(this->Mesh.GetFixedEdges()))
  {
    const TriangleMesh& mesh = this->Mesh.GetOnHost();
    this->Insertion = ConstraintInsertion(mesh, this->Options,
      [&](double share) { return tell(ConstraintInsertion::ShareOfRun * share); });
    this->Start = CallerMesh(this->Insertion.GetMesh(mesh));
  }
  const double begin = this->Insertion.GetShare();
  this->Building =
    BuildProgress([tell, begin](double share) { return tell(begin + (1.0 - begin) * share); });
  this->Load();
  this->Report = this->Loaded->GetInputReport();
  this->Insertion.AddTo(this->Report);
  this->ListDefects();
  const GeometryKind geometry = this->Report.GeometryUsed;
  this->Report.BuildSeconds = watch.GetSeconds();
  this->Building.Reach(geometry, BuildStep::Measured);

  const StopWatch flipWatch;
  this->Detect();
  this->Report.NonDelaunayBefore = this->Report.NonDelaunayAfter;
  this->Report.FlipSeconds = flipWatch.GetSeconds();
  this->Building.Reach(geometry, BuildStep::Tested);
  this->Progress.StartFlips(this->Found.Bad, this->Report.BuildSeconds, this->Report.FlipSeconds,
    this->Cloud && this->Cloud->HasSegments());
  if (this->Cloud)
  {
    this->ReportPoints();
  }
}
catch (...)
{
  this->Reset();
  throw;
}

/// As Advance, of a mesh in parts: all flips at once.
bool FlipSession::Work::FlipDivided(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  const bool isOver = this->Divided && this->Divided->IsOver();
  if (iterations == 0 || isOver)
  {
    return !isOver;
  }
  if (!this->Divided || !this->Divided->IsFresh)
  {
    this->Build();
  }
  this->Divided->FlipAll(progress);
  this->Report = this->Divided->Report;
  for (std::size_t i = 0; observer && i < this->Report.Iterations.size(); ++i)
  {
    observer(this->Report.Iterations[i]);
  }
  return false;
}

/// Tests all edges.
void FlipSession::Work::Detect()
{
  this->KeepFound(this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().Detect(); }));
  this->HasDetected = true;
}

/// @param backend CUDA or Threads.
std::unique_ptr<LoadedMesh> FlipSession::Work::LoadOn(BackendKind backend)
{
  const FlipOptions options = this->Insertion.GetOptions(this->Options);
  this->OnCuda = backend == BackendKind::CUDA;
  if (this->Cloud)
  {
    this->Cloud->Reset();
    return this->OnCuda ? LoadOnCuda(this->Cloud->GetPoints(), options, this->Building)
                        : LoadOnThreads(this->Cloud->GetOnHost(), options, this->Building);
  }
  const DeviceMesh* device = this->Start->GetOnDevice();
  if (this->OnCuda)
  {
    this->TouchExpected();
    return device ? LoadOnCuda(*device, options, this->Building)
                  : LoadOnCuda(this->Start->GetOnHost(), options, this->Building);
  }
  return LoadOnThreads(this->Start->GetOnHost(), options, this->Building);
}

void FlipSession::Work::Load()
{
  const std::int64_t triangles =
    this->Cloud ? 2 * this->Cloud->GetPoints().Points.Count : this->Mesh.CountTriangles();
  const bool isOnDevice =
    this->Cloud ? this->Cloud->GetPoints().OnDevice : this->Start->GetOnDevice() != nullptr;
  const bool wantsCuda = this->Options.Backend == BackendKind::CUDA ||
    (this->Options.Backend == BackendKind::Auto &&
      (isOnDevice || (triangles >= SmallestMeshForCuda && HasCudaDevice())));
  if (!wantsCuda)
  {
    this->Loaded = this->LoadOn(BackendKind::Threads);
    return;
  }
  try
  {
    this->Loaded = this->LoadOn(BackendKind::CUDA);
  }
  catch (const BackendUnavailable& error)
  {
    this->FallBack(error);
  }
}

/// Replaces a GPU that has failed by the CPU, which repeats all iterations that were reported. To
/// be called while the error is handled.
void FlipSession::Work::FallBack(const BackendUnavailable& error)
{
  if (this->Options.Backend == BackendKind::CUDA)
  {
    throw;
  }
  this->Fallback = error.what();
  try
  {
    this->RepeatOnThreads();
  }
  catch (...)
  {
    this->Reset();
    throw;
  }
}

void FlipSession::Work::RepeatOnThreads()
{
  const TemporaryValue<bool> stoppable(this->MayStop, true);
  const bool hadSegments = this->Cloud && this->Cloud->AreInserted();
  const bool hadRemoved = this->Cloud && this->Cloud->HasRemoved();
  this->Loaded.reset();
  this->Loaded = this->LoadOn(BackendKind::Threads);
  if (this->ByDivision)
  {
    this->Loaded->Divide(this->Building);
  }
  if (!this->HasDetected)
  {
    return;
  }
  FlipLoop& loop = this->Loaded->GetLoop();
  this->Building.Reach(this->Report.GeometryUsed, BuildStep::Measured);
  loop.Detect();
  this->Building.Reach(this->Report.GeometryUsed, BuildStep::Tested);
  const auto repeat = [&](std::int64_t iterations)
  {
    for (std::int64_t done = 0; done < iterations;)
    {
      done += static_cast<std::int64_t>(loop.Advance({ 1, false, false }).size());
      this->Building.Tell(0.0);
    }
  };
  std::int64_t done = this->IterationsBeforeDivision;
  if (hadSegments)
  {
    repeat(this->IterationsBeforeInsertion - done);
    done = this->IterationsBeforeInsertion;
    this->Cloud->Insert(*this->Loaded, {});
    loop.Detect();
  }
  repeat(this->CountIterations() - done);
  if (hadRemoved)
  {
    this->Cloud->Finish(*this->Loaded);
  }
}

void FlipSession::Work::Reset()
{
  this->Divided.reset();
  this->Loaded.reset();
  this->Start.reset();
  this->Fallback.clear();
  this->HasDetected = false;
  this->ByDivision = false;
  this->IterationsBeforeDivision = 0;
  this->Insertion = ConstraintInsertion();
  if (this->Cloud)
  {
    this->Cloud->Reset();
  }
  this->Report = FlipReport();
  this->Report.Points = this->Cloud ? this->Cloud->CountCallerPoints() : this->Mesh.CountPoints();
  this->Report.Triangles = this->Mesh.CountTriangles();
  this->IsMeasured = true;
}

/// Forgets all after an observer has stopped the session before there is a mesh to show for it:
/// while one is built, or while the CPU repeats what a GPU has lost.
void FlipSession::Work::Abort()
{
  this->Reset();
  this->Report.StopReason = StopReasonKind::Aborted;
}

/// Replaces the triangles of points by those of divide and conquer once flips have taken as long as
/// these would: their chains go on for as long as the points lie along curves.
void FlipSession::Work::DivideIfLong()
{
  // Measured on one thread: divide and conquer takes as long as about 8 flips per point, an
  // iteration as long as some hundred flips.
  constexpr std::int64_t FlipsPerPoint = 8;
  constexpr std::int64_t FlipsPerIteration = 256;
  constexpr std::int64_t Fewest = 10000, Most = 100000;
  if (!this->Cloud || this->ByDivision || this->Cloud->AreInserted())
  {
    return;
  }
  const std::int64_t points = this->Cloud->GetPoints().Points.Count;
  const std::int64_t allowed = FlipsPerPoint * points + std::clamp(points, Fewest, Most);
  std::vector<IterationRecord>& made = this->Report.Iterations;
  std::int64_t done = 0;
  std::size_t iterations = 0;
  bool isDue = false;
  while (iterations < made.size() && !isDue)
  {
    done += made[iterations++].Flipped + FlipsPerIteration;
    isDue = done >= allowed;
  }
  if (!isDue || (iterations == made.size() && !this->IsRunning()))
  {
    return;
  }
  // Iterations beyond belong to a batch, whose size depends on the backend.
  for (; made.size() > iterations; made.pop_back())
  {
    this->Report.TotalFlips -= made.back().Flipped;
    this->Report.TotalExcluded -= made.back().Excluded;
    this->Report.TotalBlocked -= made.back().Blocked;
  }
  const TemporaryValue<bool> stoppable(this->MayStop, true);
  this->IterationsBeforeDivision = this->CountIterations();
  this->HasDetected = false;
  this->OnBackend([this](LoadedMesh& mesh) { mesh.Divide(this->Building); });
  this->ByDivision = true;
  this->Detect();
  this->Resume();
}

/// Inserts the segments of a session from points once flips have ended without them: in the
/// Delaunay triangulation segments cross few edges, and many are edges already.
void FlipSession::Work::InsertIfDone()
{
  const bool isDue = this->Cloud && this->Cloud->HasSegments() && !this->Cloud->AreInserted() &&
    (!this->IsRunning() || this->Cloud->WasStopped());
  if (!isDue || this->Report.StopReason == StopReasonKind::Aborted)
  {
    return;
  }
  this->IterationsBeforeInsertion = this->CountIterations(); // where the CPU has to insert, too
  const auto tell = [this](double share) { return this->Progress.TellRest(this->Observer, share); };
  const bool isComplete =
    this->OnBackend([&](LoadedMesh& mesh) { return this->Cloud->Insert(mesh, tell); });
  this->Detect();
  this->Resume();
  if (!isComplete)
  {
    this->Report.StopReason = StopReasonKind::Aborted;
  }
}

//------------------------------------------------------------------------------
std::int64_t FlipSession::Work::GetIterationLimit() const
{
  if (this->Options.MaximumIterations >= 0)
  {
    return this->Options.MaximumIterations;
  }
  constexpr std::int64_t SafetyMargin = 1000; // beyond the number of triangles
  const bool mayCycle = this->Report.GeometryUsed == GeometryKind::Surface ||
    this->Options.Criterion == CriterionKind::OppositeAngles;
  return mayCycle ? this->Report.Triangles + SafetyMargin : NoLimit;
}

/// How many iterations observers can wait for. Of points, those within chunks are one batch: the
/// observer may stop it, and then all is lost.
std::int64_t FlipSession::Work::GetBatch() const
{
  const bool mayStop = this->Cloud && this->CountIterations() == 0;
  const std::int64_t fewest = mayStop ? this->Loaded->GetLoop().CountChunkIterations() : 1;
  return std::max(fewest, this->Progress.GetBatch());
}

/// Continues, even after an abort, unless there is nothing to do or no iteration is left.
void FlipSession::Work::Resume()
{
  this->Report.StopReason = this->Found.Bad == 0           ? StopReasonKind::Converged
    : this->CountIterations() >= this->GetIterationLimit() ? StopReasonKind::IterationLimit
                                                           : StopReasonKind::Running;
}

void FlipSession::Work::KeepFound(const StepCounts& found)
{
  this->Found = found;
  this->Report.NonDelaunayAfter = found.Bad + found.GetBlocked();
  this->Report.BlockedByShape = found.BlockedByShape;
  const bool isUnknown = found.BlockedByShape > 0 && this->Options.MaximumDeviation < INFINITY;
  this->Report.BlockedByDeviation = isUnknown ? -1 : 0; // MeasureEnd counts
  this->Report.BlockedByEdge = found.BlockedByEdge;
}

void FlipSession::Work::Keep(const std::vector<IterationCounts>& batch, double seconds)
{
  const double secondsPerIteration = seconds / static_cast<double>(batch.size());
  this->Progress.KeepTime(secondsPerIteration);
  for (const IterationCounts& counts : batch)
  {
    IterationRecord record;
    record.Iteration = this->CountIterations() + 1;
    record.Tested = counts.Tested;
    record.NonDelaunay = counts.Bad + counts.Blocked;
    record.Blocked = counts.Blocked;
    record.Flipped = counts.Flipped;
    record.Excluded = counts.Bad - counts.Flipped;
    record.MinimumAngle = ToDegrees(counts.SquaredCotangent);
    record.Seconds = secondsPerIteration;
    this->Report.Iterations.push_back(record);
    this->Report.TotalFlips += record.Flipped;
    this->Report.TotalExcluded += record.Excluded;
    this->Report.TotalBlocked += record.Blocked;
  }
}

/// The smallest angle is known after the first and the last iteration. If a run stops in between,
/// this takes a pass over the mesh, made only when the report is requested. Also counts the edges
/// blocked by deviation, and lists the defects of the input and, at the end of a run, those that
/// flips have caused.
void FlipSession::Work::MeasureEnd()
{
  if (this->Report.BlockedByDeviation < 0)
  {
    this->Report.BlockedByDeviation =
      this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().CountBlockedByDeviation(); });
    this->Report.BlockedByShape = this->Found.BlockedByShape - this->Report.BlockedByDeviation;
  }
  if (!this->AreSliversKnown)
  {
    const EdgeCounts& edges = this->Report.Edges;
    this->Report.KeepsSliver = !this->IsRunning() && !this->Cloud &&
      edges.Feature + edges.Constraint > 0 &&
      this->OnBackend([](LoadedMesh& mesh) { return mesh.KeepsSliver(); });
    HiddenSums hidden;
    if (!this->IsRunning() && !this->Cloud && edges.WronglyWound + edges.NonManifold > 0)
    {
      hidden = this->OnBackend([](LoadedMesh& mesh) { return mesh.CountHidden(); });
    }
    this->Report.HiddenByWinding = hidden.WronglyWound;
    this->Report.ObtuseAtNonManifold = hidden.ObtuseCorners;
    this->AreSliversKnown = true;
  }
  if (this->IsMeasured)
  {
    return;
  }
  KeepAnglesAfter(
    this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().MeasureAngles(); }), this->Report);
  this->IsMeasured = true;
  this->ListDefects();
  if (this->Cloud)
  {
    this->ReportPoints();
  }
  if (!this->IsRunning() && !this->Report.Iterations.empty())
  {
    this->Report.Iterations.back().MinimumAngle = this->Report.MinimumAngleAfter;
    const Defect turned =
      this->OnBackend([](const LoadedMesh& mesh) { return mesh.FindTurnedTriangles(); });
    if (turned.Count > 0)
    {
      this->Report.Defects.push_back(turned);
    }
  }
}

/// Those of the input, without what flips have caused.
void FlipSession::Work::ListDefects()
{
  FlipReport& report = this->Report;
  report.Defects = this->Loaded->GetInputReport().Defects;
  AddDefects(this->Insertion.GetRefused(), report.Defects);
  const EdgeCounts& edges = report.Edges;
  if (!this->Cloud && report.Triangles > 1 && edges.Edges > 0 && edges.Boundary == edges.Edges)
  {
    report.Defects.push_back({ "triangles of which no two share an edge, so that none can flip: "
                               "merge points that lie at the same place",
      report.Triangles, {}, DefectIds::Points });
  }
}

/// What is not about flips. Removes triangles once nothing is left to flip.
void FlipSession::Work::ReportPoints()
{
  this->OnBackend(
    [this](LoadedMesh& mesh)
    {
      if (this->Report.StopReason == StopReasonKind::Converged ||
        this->Report.StopReason == StopReasonKind::IterationLimit)
      {
        this->Cloud->Finish(mesh);
      }
      this->Report.FromPoints = mesh.GetInputReport().FromPoints;
      this->Report.Edges = mesh.GetInputReport().Edges;
      this->Cloud->AddTo(this->Report, mesh);
    });
}

}
