// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LoadedRun.h"

#include "CudaDevice.h"
#include "CudaSupport.h"
#include "FlipError.h"
#include "SmallestAngle.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace delaunayflip
{

LoadedRun::LoadedRun(const FlipOptions& options, const ProgressObserver& progress)
  : Options(options),
    Building(
      [this](double share)
      {
        const double done = this->ShareBefore + (1.0 - this->ShareBefore) * share;
        return !this->MayForget || this->Progress.Tell(this->Observer, done);
      })
{
  this->Observer = progress;
}

bool LoadedRun::Begin()
try
{
  this->Reset();
  this->SinceBegin = StopWatch();
  this->RunStages(this->FindFlips());
  return true;
}
catch (const RunAborted&)
{
  this->Abort();
  return false;
}
catch (...)
{
  this->Reset();
  throw;
}

std::size_t LoadedRun::FindFlips() const
{
  const auto flips = std::find_if(this->Stages.begin(), this->Stages.end(),
    [](const Stage& stage) { return stage.Stop != OnStop::Forgets; });
  return flips - this->Stages.begin();
}

bool LoadedRun::Advance(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
try
{
  const TemporaryValue<ProgressObserver> told(this->Observer, progress);
  const TemporaryValue<FlipObserver> toldOfIterations(this->IterationObserver, observer);
  if (!this->Loaded && !this->Begin())
  {
    return false;
  }
  this->TouchExpected();
  const std::vector<std::future<void>> touching = std::exchange(this->Touching, {});
  const StopWatch watch;
  const double secondsBefore = this->Report.FlipSeconds;
  const std::int64_t made = this->CountIterations();
  this->RoundsBefore = this->Rounds;
  this->Limit = NoLimit;
  if (iterations >= 0)
  {
    this->Limit = made + std::min(iterations, NoLimit - made);
  }
  if (!this->IsOver())
  {
    this->WasStopped = false;
    this->AreKeptEdgesKnown = false;
    this->Report.StopReason = StopReasonKind::Running;
    if (!this->RunStages(this->Stages.size()) && this->WasStopped)
    {
      this->Report.StopReason = StopReasonKind::Aborted;
    }
  }
  this->Report.FlipSeconds = secondsBefore + watch.GetSeconds();
  if (this->IsOver())
  {
    this->Progress.Tell(progress, 1.0);
  }
  return this->Report.StopReason == StopReasonKind::Running;
}
catch (const RunAborted&)
{
  this->Abort();
  return false;
}
catch (...)
{
  this->Reset(); // forgets what is half done
  throw;
}

const FlipReport& LoadedRun::GetReport()
try
{
  if (this->Loaded)
  {
    this->Measure();
  }
  return this->Report;
}
catch (const RunAborted&)
{
  this->Abort();
  return this->Report;
}
catch (...)
{
  this->Reset();
  throw;
}

//------------------------------------------------------------------------------
void LoadedRun::Load(bool isOnDevice, std::int64_t triangles)
{
  bool wantsCuda = this->Options.Backend == BackendKind::CUDA;
  if (this->Options.Backend == BackendKind::Auto)
  {
    wantsCuda = isOnDevice || (triangles >= SmallestMeshForCuda && HasCudaDevice());
  }
  this->OnCuda = wantsCuda;
  if (wantsCuda)
  {
    this->TouchExpected();
    try
    {
      this->Loaded = this->LoadOn(BackendKind::CUDA);
    }
    catch (const BackendUnavailable& error)
    {
      this->FallBack(error);
    }
  }
  else
  {
    this->Loaded = this->LoadOn(BackendKind::Threads);
  }
  const std::string fallback = this->Report.Fallback;
  this->Report = this->Loaded->GetInputReport();
  this->Report.Fallback = fallback;
  this->Report.BuildSeconds = this->SinceBegin.GetSeconds();
  if (this->Options.Backend == BackendKind::Auto && !wantsCuda)
  {
    this->Report.Backend += ExplainNoCuda();
  }
}

Defect LoadedRun::FindIdleOptions() const
{
  if (this->WantsRefinement)
  {
    const bool isCut = this->Rounds == 0 && !this->IsRefined && this->IsAtIterationLimit();
    return Defect(DefectKind::TrianglesNotJudged, isCut ? this->Report.Triangles : 0);
  }
  Defect defect(DefectKind::OptionsWithoutGoal);
  const auto add = [&](bool isGiven, const char* name)
  {
    if (isGiven)
    {
      ++defect.Count;
      defect.Detail += (defect.Detail.empty() ? "" : ", ") + std::string(name);
    }
  };
  add(this->Options.KeepBoundary, "KeepBoundary");
  add(this->Options.PointLimit > 0, "PointLimit");
  return defect;
}

void LoadedRun::TestAllEdges()
{
  FlipReport& report = this->Report;
  this->Building.Reach(report.GeometryUsed, BuildStep::Measured);
  const StopWatch watch;
  this->OnBackend([this](LoadedMesh& mesh) { this->RecordFound(mesh.GetLoop().Detect()); });
  this->RecordChange(0);
  this->AreAnglesKnown = this->MeasuresStart;
  report.NonDelaunayBefore = report.NonDelaunayAfter;
  report.FlipSeconds = watch.GetSeconds();
  this->Building.Reach(report.GeometryUsed, BuildStep::Tested);
  this->Progress.StartFlips(
    this->Found.Bad, report.BuildSeconds, report.FlipSeconds, this->SumLaterShares());
  this->InputDefects = report.Defects;
  this->ListDefects();
}

void LoadedRun::RepeatTest(LoadedMesh& mesh)
{
  this->Building.Reach(this->Report.GeometryUsed, BuildStep::Measured);
  mesh.GetLoop().Detect();
  this->Building.Reach(this->Report.GeometryUsed, BuildStep::Tested);
}

bool LoadedRun::HasMoreFlips() const
{
  return this->Found.Bad > 0 && this->CountIterations() < this->GetIterationLimit();
}

bool LoadedRun::Flip(const std::function<bool()>& givesUp)
{
  bool isOver = !this->HasMoreFlips();
  while (!isOver)
  {
    if (!this->MayIterate())
    {
      return false;
    }
    const std::int64_t first = this->CountIterations();
    this->RunBatch();
    isOver = (givesUp && givesUp()) || !this->HasMoreFlips();
    this->TellIterations(first, !isOver);
  }
  return true;
}

void LoadedRun::RepeatFlips(LoadedMesh& mesh, std::int64_t iterations)
{
  const AdvancePlan one{ 1, false, false }; // one iteration, and nothing is measured
  for (std::int64_t done = 0; done < iterations;)
  {
    done += SizeOf(mesh.GetLoop().Advance(one));
    this->Building.Tell(0.0); // asks whether to stop; progress never goes back
  }
}

void LoadedRun::MeasureEnd()
{
  const bool isCutShort = this->WantsRefinement && !this->IsRefined && this->Report.Triangles > 0;
  const bool hasConverged = this->Found.Bad == 0 && !isCutShort;
  this->Report.StopReason =
    hasConverged ? StopReasonKind::Converged : StopReasonKind::IterationLimit;
  this->Measure();
}

//------------------------------------------------------------------------------
void LoadedRun::RecordChange(std::int64_t count)
{
  if (this->Journal.empty() || this->Journal.back().Stage != this->Current)
  {
    this->Journal.push_back({ this->Current, 0 });
  }
  this->Journal.back().Count += count;
  this->AreAnglesKnown = false;
}

void LoadedRun::OnBackend(const MeshWork& work)
{
  try
  {
    const std::unique_ptr<DeviceScope> current = this->Loaded->MakeCurrent();
    work(*this->Loaded);
    return;
  }
  catch (const BackendUnavailable& error)
  {
    this->FallBack(error);
  }
  work(*this->Loaded);
}

bool LoadedRun::TryOnBackend(const MeshWork& work)
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

/// Replaces a GPU that has failed by threads. To be called while the error is handled.
void LoadedRun::FallBack(const BackendUnavailable& error)
{
  if (this->Options.Backend == BackendKind::CUDA)
  {
    throw;
  }
  this->Report.Fallback = error.what();
  try
  {
    this->Replay();
  }
  catch (...)
  {
    this->Reset();
    throw;
  }
}

/// Loads the mesh onto threads, and repeats there what the journal says.
void LoadedRun::Replay()
{
  const TemporaryValue<bool> forgets(this->MayForget, true);
  this->OnCuda = false;
  this->Loaded.reset(); // frees its memory first
  this->Loaded = this->LoadOn(BackendKind::Threads);
  this->Report.Backend = this->Loaded->GetInputReport().Backend;
  for (const Entry& entry : this->Journal)
  {
    this->Stages[entry.Stage].Repeat(*this->Loaded, entry.Count);
  }
}

void LoadedRun::Reset()
{
  this->Touching.clear(); // waits: after the call under way the caller may free the memory
  this->Loaded.reset();
  this->Journal.clear();
  this->ShareBefore = 0.0;
  this->Rounds = 0;
  this->IsRefined = false;
  this->Current = 0;
  this->Progress = RunProgress();
  this->Report = FlipReport();
}

void LoadedRun::TouchExpected()
{
  std::vector<ResultMemory> expected = std::exchange(this->Expected, {});
  if (expected.empty() || !this->OnCuda)
  {
    return;
  }
  // Measured on an H100 with 16 cores: with more threads the copies to the GPU wait.
  constexpr int Most = 4;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (this->Options.NumberOfThreads > 0)
  {
    threads = std::min(threads, this->Options.NumberOfThreads);
  }
  const auto touch = [blocks = std::move(expected), number = std::min(threads, Most)]()
  {
    const ThreadBackend backend(number);
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

//------------------------------------------------------------------------------
std::int64_t LoadedRun::GetIterationLimit() const
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

/// Makes at least one iteration; with observers no more than they can wait for.
void LoadedRun::RunBatch()
{
  const StopWatch watch;
  const std::int64_t first = this->CountIterations();
  std::int64_t most = std::min(this->Limit, this->GetIterationLimit()) - first;
  if (this->IterationObserver || this->Observer)
  {
    most = std::min(most, this->GetBatch());
  }
  const bool measuresFirst = first == 0 && this->MeasuresStart;
  const AdvancePlan plan{ most, measuresFirst, this->Options.TrackQuality };
  const TemporaryValue<bool> forgets(this->MayForget, first == 0);
  std::vector<IterationCounts> batch;
  this->OnBackend([&](LoadedMesh& mesh) { batch = mesh.GetLoop().Advance(plan); });
  this->RecordChange(SizeOf(batch));
  this->RecordFound(this->Loaded->GetLoop().GetFound());
  this->RecordIterations(batch, watch.GetSeconds());
#if !defined(NDEBUG)
  // After the journal has the iterations, because the CPU repeats them if the GPU fails here.
  this->OnBackend([](const LoadedMesh& mesh) { mesh.Audit(); });
#endif
}

void LoadedRun::TellIterations(std::int64_t first, bool hasMore)
{
  bool continues = true;
  for (std::int64_t i = first; this->IterationObserver && i < this->CountIterations(); ++i)
  {
    continues = this->IterationObserver(this->Report.Iterations[i]) && continues;
  }
  if (continues && hasMore)
  {
    continues = this->Progress.TellFlips(
      this->Observer, this->Report, this->Found.Bad, this->GetIterationLimit());
  }
  this->WasStopped = !continues;
}

double LoadedRun::SumLaterShares() const
{
  double sum = 0.0;
  for (std::size_t later = this->Current + 1; later < this->Stages.size(); ++later)
  {
    sum += this->Stages[later].Share;
  }
  return sum;
}

bool LoadedRun::TellStage(double share)
{
  const double left = (1.0 - share) * this->Stages[this->Current].Share + this->SumLaterShares();
  return this->Progress.Tell(this->Observer, 1.0 - left);
}

void LoadedRun::RecordFound(const StepCounts& found)
{
  FlipReport& report = this->Report;
  this->Found = found;
  report.NonDelaunayAfter = found.Bad + found.GetBlocked();
  report.BlockedByShape = found.BlockedByShape;
  const bool isUnknown = found.BlockedByShape > 0 && this->Options.MaximumDeviation < INFINITY;
  report.BlockedByDeviation = isUnknown ? -1 : 0; // Measure counts
  report.BlockedByEdge = found.BlockedByEdge;
}

void LoadedRun::RecordIterations(const std::vector<IterationCounts>& batch, double seconds)
{
  FlipReport& report = this->Report;
  const double secondsPerIteration = seconds / static_cast<double>(batch.size());
  this->Progress.RecordTime(secondsPerIteration);
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
    report.Iterations.push_back(record);
    report.TotalFlips += record.Flipped;
    report.TotalExcluded += record.Excluded;
    report.TotalBlocked += record.Blocked;
  }
}

/// The smallest angle is known after the first and the last iteration. If a run stops in between,
/// all triangles have to be measured, which is done only when the report is requested.
void LoadedRun::Measure()
{
  if (!this->AreKeptEdgesKnown)
  {
    this->MeasureKeptEdges();
    this->AreKeptEdgesKnown = true;
  }
  FlipReport& report = this->Report;
  if (report.BlockedByDeviation < 0)
  {
    this->OnBackend([&report](LoadedMesh& mesh)
      { report.BlockedByDeviation = mesh.GetLoop().CountBlockedByDeviation(); });
    report.BlockedByShape = this->Found.BlockedByShape - report.BlockedByDeviation;
  }
  if (this->AreAnglesKnown)
  {
    return;
  }
  if (this->MeasuresAngles)
  {
    this->OnBackend(
      [&report](LoadedMesh& mesh) { KeepAnglesAfter(mesh.GetLoop().MeasureAngles(), report); });
  }
  this->AreAnglesKnown = true;
  this->ListDefects();
  if (report.StopReason != StopReasonKind::Running && !report.Iterations.empty())
  {
    report.Iterations.back().MinimumAngle = report.MinimumAngleAfter;
    if (report.GeometryUsed == GeometryKind::Surface)
    {
      this->OnBackend([&report](const LoadedMesh& mesh)
        { AddDefect(mesh.FindTurnedTriangles(), report.Defects); });
    }
  }
}

}
