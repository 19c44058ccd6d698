// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "Array.h"
#include "BuildProgress.h"
#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "CudaDevice.h"
#include "DividedCopy.h"
#include "HostMemory.h"
#include "InputChecks.h"
#include "LoadedMesh.h"
#include "PointRun.h"
#include "RunProgress.h"
#include "SurfaceAngles.h"
#include "ThreadBackend.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
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

/// Stores into a temporary array first, so that the target is unchanged after a failure.
template <typename Id>
void StoreAtOnce(const LoadedMesh& mesh, Id* ids, std::int64_t count)
{
  HostMemory memory;
  Array<Id> stored(static_cast<std::size_t>(3 * count), memory);
  mesh.StoreTriangles(MutableTriangleArray(stored.Data(), count));
  std::copy_n(stored.Data(), 3 * count, ids);
}
}

/// What a session has. BackendKind::Auto uses a GPU if there is one and the mesh is large enough.
/// If the GPU fails, at any time, the CPU repeats what was done, with the same bits, and continues.
struct FlipSession::Work
{
  Work(const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress);
  Work(const PointInput& points, const PointOptions& options, const ProgressObserver& progress);

  /// Calls work(mesh), and calls it again on the CPU if the GPU fails.
  /// @throws BackendUnavailable with BackendKind::CUDA.
  template <typename Function>
  auto OnBackend(const Function& work)
  {
    try
    {
      const std::unique_ptr<DeviceScope> current = this->Loaded->MakeCurrent();
      return work(*this->Loaded);
    }
    catch (const BackendUnavailable& error)
    {
      this->FallBack(error);
    }
    return work(*this->Loaded);
  }

  /// The same, if a mesh is loaded. @returns whether it was called and no observer stopped it.
  template <typename Function>
  bool TryOnBackend(const Function& work)
  {
    try
    {
      if (this->Loaded)
      {
        this->OnBackend(work);
      }
    }
    catch (const RunAborted&)
    {
      this->Abort();
    }
    return this->Loaded != nullptr;
  }

  /// Calls store(mesh), which says whether it has stored, unless triangles were removed.
  template <typename Function>
  bool StoreOnDevice(const Function& store)
  {
    bool isStored = false;
    if (!this->Cloud || !this->Cloud->HasRemoved())
    {
      this->TryOnBackend([&](const LoadedMesh& mesh) { isStored = store(mesh); });
    }
    return isStored;
  }

  /// @throws InvalidOptions
  const PointRun& RequirePoints() const
  {
    if (!this->Cloud)
    {
      throw InvalidOptions("the session is not one from points");
    }
    return *this->Cloud;
  }

  void Build();
  void Load();
  std::unique_ptr<LoadedMesh> LoadOn(BackendKind backend);
  void DivideIfLong();
  void InsertIfDone();
  void FallBack(const BackendUnavailable& error);
  void Reset();
  void Abort();

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }
  std::int64_t CountIterations() const
  {
    return static_cast<std::int64_t>(this->Report.Iterations.size());
  }
  std::int64_t GetIterationLimit() const;
  void Resume();
  void KeepFound(const StepCounts& found);
  void Keep(const IterationCounts& counts, double seconds);
  double MeasureAngle();
  void MeasureEnd();
  void ListDefects();
  void ReportPoints();

  CallerMesh Mesh; ///< Empty in a session from points.
  std::unique_ptr<PointRun> Cloud; ///< Of a session from points.
  bool ByDivision = false; ///< Whether these are triangulated by divide and conquer.
  std::int64_t IterationsBeforeDivision = 0;
  std::int64_t IterationsBeforeInsertion = 0; ///< Of segments, if they are inserted.
  FlipOptions Options;
  ProgressObserver Observer; ///< Of the call under way, else the constructor's.
  FlipReport Report;
  std::unique_ptr<DividedCopy> Divided; ///< Null unless in several parts. Then only this is used.

  ConstraintInsertion Insertion; ///< The loaded mesh starts from its arrays.
  std::optional<CallerMesh> Start; ///< The mesh that iterations start from.
  BuildProgress Building; ///< Of the loading.
  std::unique_ptr<LoadedMesh> Loaded; ///< None if the build was aborted.
  std::string Fallback; ///< Why the CPU replaced a GPU that exists; else empty.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last detection.
  bool HasDetected = false; ///< Whether the first detection has been made.
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
};

FlipSession::Work::Work(
  const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Mesh(mesh),
    Options(options),
    Observer(progress)
{
  if (mesh.GetOnDevice() && options.NumberOfPieces > 1)
  {
    throw InvalidOptions("a mesh in the memory of a GPU cannot be flipped in several pieces");
  }
  if (!mesh.GetOnDevice() && CountPieces(options, mesh.CountTriangles()) > 1)
  {
    this->Divided = std::make_unique<DividedCopy>(this->Mesh.GetOnHost(), options, progress);
    return;
  }
  CheckOptions(options);
  CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
  this->Options.Device = mesh.ChooseDevice(options.Device);
  try
  {
    this->Build();
  }
  catch (const RunAborted&)
  {
    this->Abort();
  }
}

FlipSession::Work::Work(
  const PointInput& points, const PointOptions& options, const ProgressObserver& progress)
  : Mesh(TriangleMesh()),
    Cloud(std::make_unique<PointRun>(points, options)),
    Options(options),
    Observer(progress)
{
  CheckOptions(options);
  CheckMeshSize(2 * points.Points.Count, points.Points.Count, "");
  if (points.OnDevice)
  {
    const PlaneArray& plane = points.Points;
    const void* values = plane.Floats ? static_cast<const void*>(plane.Floats) : plane.Doubles;
    const int device = RequireOnDevice(values, plane.Count, "the points are");
    this->Options.Device = device >= 0 ? device : options.Device;
  }
  this->Options.Geometry = GeometryKind::PlanarXY;
  this->Options.Criterion = CriterionKind::InCircle;
  this->Options.TieRule = TieRuleKind::Canonical;
  this->Options.NumberOfPieces = 1;
  try
  {
    this->Build();
  }
  catch (const RunAborted&)
  {
    this->Abort();
  }
}

//------------------------------------------------------------------------------
/// Inserts constraints, loads the mesh, reports on the input, and tests all edges. When an
/// exception leaves, no mesh is loaded.
void FlipSession::Work::Build()
try
{
  const StopWatch watch;
  const auto tell = [this](double share) { return this->Progress.Tell(this->Observer, share); };
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
  this->Building.Reach(geometry, BuildStep::Prepared);
  this->Report.MinimumAngleBefore = this->MeasureAngle();
  this->Report.MinimumAngleAfter = this->Report.MinimumAngleBefore;
  this->Report.BuildSeconds = watch.GetSeconds();
  this->Building.Reach(geometry, BuildStep::Measured);

  const StopWatch flipWatch;
  this->KeepFound(this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().Detect(); }));
  this->HasDetected = true;
  this->Report.NonDelaunayBefore = this->Report.NonDelaunayAfter;
  this->Report.FlipSeconds = flipWatch.GetSeconds();
  this->Building.Reach(geometry, BuildStep::Tested);
  this->Progress.StartFlips(this->Found.Bad, this->Report.BuildSeconds, this->Report.FlipSeconds);
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

/// @param backend CUDA or Threads.
std::unique_ptr<LoadedMesh> FlipSession::Work::LoadOn(BackendKind backend)
{
  const FlipOptions options = this->Insertion.GetOptions(this->Options);
  const bool onCuda = backend == BackendKind::CUDA;
  if (this->Cloud)
  {
    this->Cloud->Reset();
    return onCuda
      ? LoadOnCuda(this->Cloud->GetPoints(), options, this->ByDivision, this->Building)
      : LoadOnThreads(this->Cloud->GetOnHost(), options, this->ByDivision, this->Building);
  }
  const DeviceMesh* device = this->Start->GetOnDevice();
  if (onCuda)
  {
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

/// Replaces a GPU that has failed by the CPU, which repeats all iterations that were reported, in
/// batches of up to a tenth of a second. To be called while the error is handled.
void FlipSession::Work::FallBack(const BackendUnavailable& error)
{
  if (this->Options.Backend == BackendKind::CUDA)
  {
    throw;
  }
  this->Fallback = error.what();
  const bool hadSegments = this->Cloud && this->Cloud->AreInserted();
  this->Loaded.reset();
  this->Loaded = this->LoadOn(BackendKind::Threads);
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
    std::int64_t batch = 1;
    for (std::int64_t done = 0; done < iterations;)
    {
      const StopWatch watch;
      const AdvancePlan plan{ std::min(batch, iterations - done), false, false };
      done += static_cast<std::int64_t>(loop.Advance(plan).size());
      batch = watch.GetSeconds() < 0.05 ? std::min(2 * batch, iterations) : batch;
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
}

void FlipSession::Work::Reset()
{
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
  constexpr std::int64_t Least = 100000;
  if (!this->Cloud || this->ByDivision || this->Cloud->AreInserted())
  {
    return;
  }
  const std::int64_t points = this->Cloud->GetPoints().Points.Count;
  std::vector<IterationRecord>& made = this->Report.Iterations;
  // Or if flips do not become fewer. In iteration 12 there are at most 0.5 times as many as in
  // iteration 4, also for points on rings and lines; on contours and spirals 0.7 to 1.2 times.
  const auto isSteady = [&](std::size_t iteration)
  {
    return iteration == 12 && points >= Least / 10 && made[11].Flipped > points / 7 &&
      made[11].Flipped > made[3].Flipped / 10 * 7;
  };
  std::int64_t done = 0;
  std::size_t iterations = 0;
  bool isDue = false;
  while (iterations < made.size() && !isDue)
  {
    done += made[iterations++].Flipped + FlipsPerIteration;
    isDue = done >= FlipsPerPoint * points + Least || isSteady(iterations);
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
  this->ByDivision = true;
  this->IterationsBeforeDivision = this->CountIterations();
  this->HasDetected = false;
  this->Loaded.reset();
  this->Load();
  this->KeepFound(this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().Detect(); }));
  this->HasDetected = true;
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
  const bool isComplete =
    this->OnBackend([this](LoadedMesh& mesh) { return this->Cloud->Insert(mesh, this->Observer); });
  this->KeepFound(this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().Detect(); }));
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
  const bool mayCycle = this->Report.GeometryUsed == GeometryKind::Surface ||
    this->Options.Criterion == CriterionKind::OppositeAngles;
  return mayCycle ? this->Report.Triangles + SafetyMargin : NoLimit;
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

void FlipSession::Work::Keep(const IterationCounts& counts, double seconds)
{
  IterationRecord record;
  record.Iteration = this->CountIterations() + 1;
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

double FlipSession::Work::MeasureAngle()
{
  return ToDegrees(
    this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().FindLargestSquaredCotangent(); }));
}

/// The smallest angle is known after the first and the last iteration. If a run stops in between,
/// this takes a pass over the mesh, made only when the report is requested. Also counts the edges
/// blocked by deviation, and lists the defects
/// of the input and, at the end of a run, those that flips have caused.
void FlipSession::Work::MeasureEnd()
{
  if (this->Report.BlockedByDeviation < 0)
  {
    this->Report.BlockedByDeviation =
      this->OnBackend([](LoadedMesh& mesh) { return mesh.GetLoop().CountBlockedByDeviation(); });
    this->Report.BlockedByShape = this->Found.BlockedByShape - this->Report.BlockedByDeviation;
  }
  if (this->IsMeasured)
  {
    return;
  }
  this->Report.MinimumAngleAfter = this->MeasureAngle();
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

//------------------------------------------------------------------------------
FlipSession::FlipSession(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Own(std::make_unique<Work>(CallerMesh(mesh), options, progress))
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
  if (work.Divided)
  {
    return work.Divided->Advance(iterations, observer, progress);
  }
  const TemporaryValue<ProgressObserver> told(work.Observer, progress);
  if (!work.Loaded)
  {
    work.Build();
  }
  FlipReport& report = work.Report;
  const StopWatch watch;
  const double secondsBefore = report.FlipSeconds;
  const std::int64_t limit = iterations < 0 ? NoLimit : work.CountIterations() + iterations;
  work.Resume();
  work.InsertIfDone();
  work.IsMeasured = work.IsMeasured && !work.Cloud; // triangles may be removed
  while (work.IsRunning() && work.CountIterations() < limit)
  {
    // At least one iteration; with observers no more than they can wait for.
    const StopWatch batchWatch;
    const std::int64_t first = work.CountIterations();
    const std::int64_t most = std::min(limit, work.GetIterationLimit()) - first;
    const AdvancePlan plan{ observer || progress ? std::min(most, work.Progress.GetBatch()) : most,
      first == 0, work.Options.TrackQuality };
    const std::vector<IterationCounts> made =
      work.OnBackend([&](LoadedMesh& mesh) { return mesh.GetLoop().Advance(plan); });
    work.IsMeasured = false;
    work.KeepFound(work.Loaded->GetLoop().GetFound());
    const double seconds = batchWatch.GetSeconds() / static_cast<double>(made.size());
    work.Progress.KeepTime(seconds);
    for (const IterationCounts& counts : made)
    {
      work.Keep(counts, seconds);
    }
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

const FlipReport& FlipSession::GetReport() const
{
  Work& work = *this->Own;
  if (work.Divided)
  {
    return work.Divided->GetReport();
  }
  try
  {
    work.MeasureEnd();
  }
  catch (const RunAborted&)
  {
    work.Abort();
  }
  if (work.Loaded)
  {
    work.Report.Backend = work.Loaded->GetInputReport().Backend;
    work.Report.Fallback = work.Fallback;
  }
  return work.Report;
}

/// Into the caller's input nothing is written until the whole result is known.
void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  Work& work = *this->Own;
  if (work.Divided)
  {
    work.Divided->StoreTriangles(triangles);
    return;
  }
  const bool atOnce = work.Mesh.HasTriangles(triangles.Data());
  const auto store = [&](const LoadedMesh& mesh)
  {
    if (work.Cloud)
    {
      work.Cloud->StoreTriangles(mesh, triangles);
    }
    else if (!atOnce)
    {
      mesh.StoreTriangles(triangles);
    }
    else if (triangles.Ids32)
    {
      StoreAtOnce(mesh, triangles.Ids32, triangles.Count);
    }
    else
    {
      StoreAtOnce(mesh, triangles.Ids64, triangles.Count);
    }
  };
  if (work.TryOnBackend(store))
  {
    return;
  }
  const TriangleArray& input = work.Mesh.GetOnHost().Triangles;
  for (std::int64_t id = 0; id < 3 * triangles.Count; ++id)
  {
    const int slot = static_cast<int>(id % 3);
    triangles.Set(id / 3, slot, input.Get(id / 3, slot));
  }
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors) const
{
  const PointRun& points = this->Own->RequirePoints();
  this->Own->TryOnBackend([&](const LoadedMesh& mesh) { points.StoreNeighbors(mesh, neighbors); });
}

void FlipSession::StoreUsedPoints(std::int64_t* ids) const
{
  const PointRun& points = this->Own->RequirePoints();
  const auto store = [&](const LoadedMesh& mesh) { points.StoreUsedPoints(mesh, ids); };
  if (!this->Own->TryOnBackend(store))
  {
    std::fill_n(ids, this->Own->Report.Points, -1);
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
  if (work.Divided)
  {
    work.Divided->StoreFlipCounts(counts);
  }
  else if (work.TryOnBackend(
             [&](const LoadedMesh& mesh) {
               work.Cloud ? work.Cloud->StoreFlipCounts(mesh, counts)
                          : mesh.StoreFlipCounts(counts);
             }))
  {
    work.Insertion.AddFlipCounts(counts);
  }
  else
  {
    std::fill_n(counts, work.Mesh.CountTriangles(), 0);
  }
}

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream) const
{
  RequireOnDevice(triangles.Data(), triangles.Count, "the array for triangles is");
  const bool isStored = this->Own->StoreOnDevice(
    [&](const LoadedMesh& mesh) { return mesh.StoreTrianglesOnDevice(triangles, stream); });
  const auto pass = [&](auto* ids)
  {
    StoreThroughHost(ids, 3 * triangles.Count, stream,
      [&](auto* host) { this->StoreTriangles(MutableTriangleArray(host, triangles.Count)); });
  };
  if (!isStored)
  {
    triangles.Ids32 ? pass(triangles.Ids32) : pass(triangles.Ids64);
  }
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  const Work& work = *this->Own;
  const std::int64_t size = work.Cloud ? work.Report.Triangles : work.Mesh.CountTriangles();
  RequireOnDevice(counts, size, "the array for flip counts is");
  const bool isStored = !this->Own->Insertion.HasFlips() &&
    this->Own->StoreOnDevice(
      [&](const LoadedMesh& mesh) { return mesh.StoreFlipCountsOnDevice(counts, stream); });
  if (!isStored)
  {
    StoreThroughHost(
      counts, size, stream, [this](std::int32_t* host) { this->StoreFlipCounts(host); });
  }
}

void FlipSession::StoreNeighbors(std::int32_t* neighbors, const DeviceStream& stream) const
{
  this->Own->RequirePoints();
  const std::int64_t size = 3 * this->Own->Report.Triangles;
  RequireOnDevice(neighbors, size, "the array for neighbours is");
  const bool isStored = this->Own->StoreOnDevice(
    [&](const LoadedMesh& mesh) { return mesh.StoreNeighborsOnDevice(neighbors, stream); });
  if (!isStored)
  {
    StoreThroughHost(
      neighbors, size, stream, [this](std::int32_t* host) { this->StoreNeighbors(host); });
  }
}

/// None if constraints were inserted: those flips would be missing.
DeviceTriangles FlipSession::ViewTriangles() const
{
  return this->Own->Loaded && !this->Own->Insertion.HasFlips() ? this->Own->Loaded->ViewTriangles()
                                                               : DeviceTriangles();
}

HostTriangles FlipSession::ViewHostTriangles() const
{
  return this->Own->Loaded && !this->Own->Insertion.HasFlips()
    ? this->Own->Loaded->ViewHostTriangles()
    : HostTriangles();
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
