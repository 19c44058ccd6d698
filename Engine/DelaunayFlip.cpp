// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DelaunayFlip.h"

#include "CallerMesh.h"
#include "ConstraintInsertion.h"
#include "DeviceCopies.h"
#include "EngineChoice.h"
#include "FlipLoop.h"
#include "InputChecks.h"
#include "RunProgress.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace delaunayflip
{

namespace
{
/// Iterations that a surface may take beyond its number of triangles before the loop gives up.
constexpr std::int64_t SafetyMargin = 1000;
constexpr std::int64_t NoLimit = std::numeric_limits<std::int64_t>::max();

/// Share of a run that the insertion of constraints takes, where there are any: it builds an edge
/// mesh of its own.
constexpr double InsertionShare = 0.3;

class StopWatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

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

double ToDegrees(double squaredCotangent)
{
  if (squaredCotangent == -INFINITY)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return squaredCotangent == INFINITY
    ? 0.0
    : std::atan2(1.0, std::sqrt(squaredCotangent)) / DegreesToRadians;
}
}

/// Makes a loop from the caller's arrays, and a report from its iterations.
class FlipSession::Implementation
{
public:
  Implementation(
    const CallerMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
    : Mesh(mesh),
      Options(Checked(mesh, options)),
      Observer(progress)
  {
    this->Try([this]() { this->Build(); });
  }

  bool Advance(
    std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
  {
    const TemporaryValue<ProgressObserver> told(this->Observer, progress);
    const auto work = [&]()
    {
      if (!this->Engine)
      {
        this->Build();
      }
      this->Run(iterations, observer, progress);
    };
    return this->Try(work) && this->IsRunning();
  }

  const FlipReport& GetReport()
  {
    this->Try([this]() { this->MeasureEnd(); });
    if (this->Engine)
    {
      this->Report.Backend = this->Engine->GetInputReport().Backend;
      this->Report.Fallback = this->Engine->GetFallback();
    }
    return this->Report;
  }

  void StoreTriangles(const MutableTriangleArray& triangles)
  {
    const bool isInput = this->Mesh.HasTriangles(triangles.Data());
    if (this->Engine && this->Try([&]() { this->Engine->StoreTriangles(triangles, isInput); }))
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

  void StoreTriangles(const MutableTriangleArray& triangles, const DeviceStream& stream)
  {
    RequireOnDevice(triangles);
    bool isStored = false;
    const auto store = [&]()
    { isStored = this->Engine->StoreTrianglesOnDevice(triangles, stream); };
    if (this->Engine && this->Try(store) && isStored)
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

  void StoreFlipCounts(std::int32_t* counts)
  {
    const auto store = [&]()
    {
      this->Engine->StoreFlipCounts(counts);
      this->Insertion.AddFlipCounts(counts);
    };
    if (!this->Engine || !this->Try(store))
    {
      std::fill_n(counts, this->Mesh.CountTriangles(), 0);
    }
  }

  void StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream)
  {
    const std::int64_t size = this->Mesh.CountTriangles();
    RequireOnDevice(counts, size);
    bool isStored = false;
    const auto store = [&]() { isStored = this->Engine->StoreFlipCountsOnDevice(counts, stream); };
    if (this->Engine && !this->Insertion.HasFlips() && this->Try(store) && isStored)
    {
      return;
    }
    StoreThroughHost(
      counts, size, stream, [this](std::int32_t* host) { this->StoreFlipCounts(host); });
  }

private:
  static FlipOptions Checked(const CallerMesh& mesh, const FlipOptions& options)
  {
    CheckOptions(options);
    CheckMeshSize(mesh.CountTriangles(), mesh.CountPoints());
    FlipOptions checked = options;
    checked.Device = mesh.ChooseDevice(options.Device);
    return checked;
  }

  /// Calls work(), and forgets all when an observer stops it before there is a mesh to show for it:
  /// while one is built, or while the CPU repeats what a GPU has lost.
  /// @returns whether it was not stopped.
  template <typename Work>
  bool Try(const Work& work)
  {
    try
    {
      work();
      return true;
    }
    catch (const RunAborted&)
    {
      this->Reset();
      this->Report.StopReason = StopReasonKind::Aborted;
      return false;
    }
  }

  /// When an exception leaves, there is no engine.
  void Build()
  {
    try
    {
      this->BuildEngine(
        [this](double share) { return this->Progress.Tell(this->Observer, share); });
    }
    catch (...)
    {
      this->Reset();
      throw;
    }
  }

  void BuildEngine(const ProgressObserver& tell)
  {
    const StopWatch watch;
    const CallerMesh mesh = this->InsertConstraints(tell);
    const double begin = this->Insertion.HasFlips() ? InsertionShare : 0.0;
    // A copy stays in the engine, for when the CPU must start again.
    const BuildProgress progress(
      [tell, begin](double share) { return tell(begin + (1.0 - begin) * share); });
    this->Engine.emplace(mesh, this->Insertion.GetOptions(this->Options), progress);
    this->Report = this->Engine->GetInputReport();
    this->Insertion.AddTo(this->Report);
    progress.Reach(this->Report.GeometryUsed, BuildStep::Prepared);
    this->Report.MinimumAngleBefore = this->MeasureAngle();
    this->Report.MinimumAngleAfter = this->Report.MinimumAngleBefore;
    this->Report.BuildSeconds = watch.GetSeconds();
    progress.Reach(this->Report.GeometryUsed, BuildStep::Measured);
    this->DetectFirst();
    progress.Reach(this->Report.GeometryUsed, BuildStep::Tested);
    this->Progress.StartFlips(this->Found.Bad, this->Report.BuildSeconds, this->Report.FlipSeconds);
  }

  /// @returns the mesh that iterations start from.
  CallerMesh InsertConstraints(const ProgressObserver& tell)
  {
    this->Insertion = ConstraintInsertion();
    if (!this->Mesh.HasConstraintsToInsert())
    {
      return this->Mesh;
    }
    const TriangleMesh& mesh = this->Mesh.GetOnHost();
    this->Insertion = ConstraintInsertion(
      mesh, this->Options, [&](double share) { return tell(InsertionShare * share); });
    return CallerMesh(this->Insertion.GetMesh(mesh));
  }

  void Reset()
  {
    this->Engine.reset();
    this->Insertion = ConstraintInsertion();
    this->Report = FlipReport();
    this->Report.Points = this->Mesh.CountPoints();
    this->Report.Triangles = this->Mesh.CountTriangles();
    this->IsMeasured = true;
  }

  void Run(std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
  {
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
  }

  double MeasureAngle() { return ToDegrees(this->Engine->FindLargestSquaredCotangent()); }

  /// Reports on the input, and ends the run if there is nothing to do or no iteration is allowed.
  void DetectFirst()
  {
    const StopWatch watch;
    this->Detected(this->Engine->Detect());
    this->Report.NonDelaunayBefore = this->Found.Bad + this->Found.GetBlocked();
    this->Report.FlipSeconds = watch.GetSeconds();
  }

  void Detected(const StepCounts& found)
  {
    this->Found = found;
    this->Report.NonDelaunayAfter = found.Bad + found.GetBlocked();
    this->Report.BlockedByShape = found.BlockedByShape;
    this->Report.BlockedByEdge = found.BlockedByEdge;
  }

  std::int64_t GetIterationLimit() const
  {
    if (this->Options.MaximumIterations >= 0)
    {
      return this->Options.MaximumIterations;
    }
    const bool mayCycle = this->Report.GeometryUsed == GeometryKind::Surface ||
      this->Options.Criterion == CriterionKind::OppositeAngles;
    return mayCycle ? this->Report.Triangles + SafetyMargin : NoLimit;
  }

  bool IsRunning() const { return this->Report.StopReason == StopReasonKind::Running; }

  /// Continues, even after an abort, unless there is nothing to do or no iteration is left.
  void Resume()
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
  void Iterate(std::int64_t most, const FlipObserver& observer, const ProgressObserver& progress)
  {
    const StopWatch watch;
    const bool isFirst = this->Report.Iterations.empty();
    const bool isWatched = observer || progress;
    const std::int64_t batch = isWatched ? std::min(most, this->Progress.GetBatch()) : most;
    const std::vector<IterationCounts> iterations =
      this->Engine->Advance({ batch, isFirst, this->Options.TrackQuality });
    this->IsMeasured = false;
    this->Detected(this->Engine->GetFound());
#if !defined(NDEBUG)
    this->Engine->Audit();
#endif
    const double seconds = watch.GetSeconds() / static_cast<double>(iterations.size());
    this->Progress.KeepTime(seconds);
    const std::size_t first = this->Report.Iterations.size();
    for (const IterationCounts& counts : iterations)
    {
      this->Keep(counts, seconds);
    }
    this->Resume();
    this->Tell(observer, first);
    this->Tell(progress);
  }

  /// Calls the observer for the iterations from `first` on, once all of them are in the report.
  void Tell(const FlipObserver& observer, std::size_t first)
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

  void Tell(const ProgressObserver& progress)
  {
    if (this->IsRunning() &&
      !this->Progress.TellFlips(progress, this->Report, this->Found.Bad, this->GetIterationLimit()))
    {
      this->Report.StopReason = StopReasonKind::Aborted;
    }
  }

  void Keep(const IterationCounts& counts, double seconds)
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

  /// The smallest angle is known after the first and the last iteration. If a run stops in between,
  /// this takes a pass over the mesh, made only when the report is requested.
  void MeasureEnd()
  {
    if (this->IsMeasured)
    {
      return;
    }
    this->Report.MinimumAngleAfter = this->MeasureAngle();
    this->IsMeasured = true;
    if (!this->IsRunning())
    {
      this->Report.Iterations.back().MinimumAngle = this->Report.MinimumAngleAfter;
    }
    this->UpdateDefects();
  }

  /// Defects of the input and, at the end of a run, those that flips have caused.
  void UpdateDefects()
  {
    this->Report.Defects = this->Engine->GetInputReport().Defects;
    this->Insertion.AddTo(this->Report.Defects);
    const Defect turned = this->IsRunning() ? Defect() : this->Engine->FindTurnedTriangles();
    if (turned.Count > 0)
    {
      this->Report.Defects.push_back(turned);
    }
  }

  CallerMesh Mesh;
  FlipOptions Options;
  ConstraintInsertion Insertion; ///< The engine starts from its arrays.
  ProgressObserver Observer; ///< Of the call under way, else the constructor's.
  std::optional<ChosenEngine> Engine; ///< None if its build was aborted.
  RunProgress Progress;
  StepCounts Found; ///< The counts of the last Detect.
  FlipReport Report;
  bool IsMeasured = true; ///< Whether MinimumAngleAfter is that of the mesh.
};

FlipSession::FlipSession(
  const TriangleMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Impl(new Implementation(CallerMesh(mesh), options, progress))
{
}

FlipSession::FlipSession(
  const DeviceMesh& mesh, const FlipOptions& options, const ProgressObserver& progress)
  : Impl(new Implementation(CallerMesh(mesh), options, progress))
{
}

FlipSession::~FlipSession() = default;
FlipSession::FlipSession(FlipSession&&) noexcept = default;
FlipSession& FlipSession::operator=(FlipSession&&) noexcept = default;

bool FlipSession::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  return this->Impl->Advance(iterations, observer, progress);
}

const FlipReport& FlipSession::GetReport() const { return this->Impl->GetReport(); }

void FlipSession::StoreTriangles(const MutableTriangleArray& triangles) const
{
  this->Impl->StoreTriangles(triangles);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts) const
{
  this->Impl->StoreFlipCounts(counts);
}

void FlipSession::StoreTriangles(
  const MutableTriangleArray& triangles, const DeviceStream& stream) const
{
  this->Impl->StoreTriangles(triangles, stream);
}

void FlipSession::StoreFlipCounts(std::int32_t* counts, const DeviceStream& stream) const
{
  this->Impl->StoreFlipCounts(counts, stream);
}

}
