// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The iterations of a session, and what is reported of them.

#include "WholeSession.h"

#include "CotangentAngle.h"

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
}

bool WholeSession::Advance(
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

void WholeSession::Run(
  std::int64_t iterations, const FlipObserver& observer, const ProgressObserver& progress)
{
  const StopWatch watch;
  const double secondsBefore = this->Report.FlipSeconds;
  this->Resume();
  const auto done = [this]() { return static_cast<std::int64_t>(this->Report.Iterations.size()); };
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

//------------------------------------------------------------------------------
/// Runs at least one iteration and at most `most`.
void WholeSession::Iterate(
  std::int64_t most, const FlipObserver& observer, const ProgressObserver& progress)
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

void WholeSession::Tell(const ProgressObserver& progress)
{
  if (this->IsRunning() &&
    !this->Progress.TellFlips(progress, this->Report, this->Found.Bad, this->GetIterationLimit()))
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
    this->Report.Fallback = this->Engine->GetFallback();
  }
  return this->Report;
}

/// The smallest angle is known after the first and the last iteration. If a run stops in between,
/// this takes a pass over the mesh, made only when the report is requested.
void WholeSession::MeasureEnd()
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
void WholeSession::UpdateDefects()
{
  this->Report.Defects = this->Engine->GetInputReport().Defects;
  AddDefects(this->Insertion.GetRefused(), this->Report.Defects);
  const Defect turned = this->IsRunning() ? Defect() : this->Engine->FindTurnedTriangles();
  if (turned.Count > 0)
  {
    this->Report.Defects.push_back(turned);
  }
}

double WholeSession::MeasureAngle()
{
  return ToDegrees(this->Engine->FindLargestSquaredCotangent());
}

}
