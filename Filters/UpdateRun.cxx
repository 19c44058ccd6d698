// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateRun.h"

#include "DataArrays.h"
#include "UpdateReport.h"

#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iterator>

namespace delaunayflip
{
namespace
{

constexpr double StepSeconds = 0.05; // the documentation of IterationsPerUpdate says this

/// Calls FlipSession::Advance for as many iterations as fit into `seconds`, at least one.
bool AdvanceFor(FlipSession& session, double seconds, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  double elapsed = 0.0;
  double iterations = 1.0;
  bool isRunning = false;
  do
  {
    const double before = elapsed;
    isRunning = session.Advance(static_cast<std::int64_t>(iterations), observer, progress);
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
    // Batches of iterations are faster than single ones, above all on a GPU. But an iteration may
    // take longer than those before, so batches grow slowly.
    const double fitting = (seconds - elapsed) * iterations / (elapsed - before);
    iterations = std::min(fitting, 2.0 * iterations);
  } while (isRunning && iterations >= 1.0);
  return isRunning;
}

/// A new run makes a step and puts the mesh out, unless it was stopped while it began. One that has
/// followed points need not put it out.
RunKeeper::UpdateKind FindKind(
  RunKeeper::UpdateKind asked, bool isSame, bool hasFollowed, StopReasonKind reason)
{
  const bool goesOn = isSame || (hasFollowed && asked == RunKeeper::UpdateKind::Step);
  if (goesOn)
  {
    return asked;
  }
  if (reason == StopReasonKind::Aborted)
  {
    return RunKeeper::UpdateKind::Store;
  }
  return RunKeeper::UpdateKind::StepAndStore;
}

}

bool UpdateRun::Advance(const UpdateRequest& request, FlipReport& report)
{
  const FlipObserver observer = [&report](const IterationRecord& record)
  {
    report.Iterations.push_back(record);
    report.TotalFlips += record.Flipped;
    return true;
  };
  if (request.IsLive && request.IterationsPerUpdate == 0)
  {
    return AdvanceFor(*this->Session, StepSeconds, observer, this->GetProgress());
  }
  constexpr vtkIdType NoLimit = -1;
  const vtkIdType iterations = request.IsLive ? request.IterationsPerUpdate : NoLimit;
  return this->Session->Advance(iterations, observer, this->GetProgress());
}

//------------------------------------------------------------------------------
void RunKeeper::Update(const UpdateRequest& request, FlipReport& report, vtkPolyData* output)
{
  std::unique_ptr<UpdateRun> run = std::move(this->Run); // which observers may drop
  const UpdateKind asked = std::exchange(this->Next, UpdateKind::StepAndStore);
  bool isRunning = std::exchange(this->CanContinue, false);
  report = FlipReport();
  if (!request.HasWork())
  {
    report.StopReason = StopReasonKind::Converged;
    output->ShallowCopy(request.Input);
    return;
  }
  const bool keepsRun = request.IsLive || request.KeepsRun;
  if (!keepsRun)
  {
    run.reset(); // before another takes as much memory
  }
  try
  {
    if (request.IsAborted())
    {
      throw RunAborted(); // in another block
    }
    const bool isSame = request.ContinueOrStart(run);
    if (!run->GetSession())
    {
      run->OpenSession();
    }
    report = run->GetReport();
    const UpdateKind kind = FindKind(asked, isSame, run->HasFollowed(), report.StopReason);
    if (kind != UpdateKind::Store)
    {
      isRunning = run->Advance(request, report);
    }
    const bool isWhole = kind == UpdateKind::Step || run->Store(output);
    report = run->GetReport(); // not before: a GPU may fail while its result is fetched
    if (!isWhole)
    {
      report.StopReason = StopReasonKind::Aborted;
    }
    AddFieldData(report, output->GetFieldData());
    if (kind == UpdateKind::Step)
    {
      this->Next = UpdateKind::Store;
    }
    this->CanContinue =
      request.IsLive && (isRunning || report.StopReason == StopReasonKind::Aborted);
  }
  catch (const RunAborted&) // before there are triangles to put out
  {
    report.StopReason = StopReasonKind::Aborted;
    output->ShallowCopy(request.Input);
    this->CanContinue = request.IsLive;
  }
  if (keepsRun)
  {
    this->Run = std::move(run);
    this->IsLive = request.IsLive;
  }
}

void RunKeeper::Drop(bool canContinue)
{
  this->Run.reset();
  this->CanContinue = canContinue;
  this->Next = UpdateKind::StepAndStore;
}

const FlipSession* RunKeeper::GetSession() const
{
  return this->HasRun() ? this->Run->GetSession() : nullptr;
}

const FlipSession* RunKeeper::GetSessionToDraw() const
{
  return this->HasRun() ? this->Run->GetSessionToDraw() : nullptr;
}

bool RunKeeper::IsNewWarning(const std::string& text)
{
  return !this->HasRun() || this->Run->Warnings.insert(text).second;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* input)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->ShallowCopy(input);
  if (vtkPoints* points = input->GetPoints())
  {
    mesh->SetPoints(CopyPoints(points));
  }
  return mesh;
}

//------------------------------------------------------------------------------
void Stamps::AddArray(vtkAbstractArray* array, vtkObject* owner, vtkMTimeType since)
{
  this->All.push_back({ array, owner, 0, array ? array->GetNumberOfValues() : 0, since });
  this->All.back().Time = this->All.back().FindTime();
}

void Stamps::AddCells(vtkCellArray* cells)
{
  this->AddArray(cells->GetOffsetsArray(), cells);
  this->AddArray(cells->GetConnectivityArray(), cells);
}

void Stamps::AddPoints(vtkPolyData* mesh, vtkMTimeType since)
{
  vtkPoints* points = mesh->GetPoints();
  this->AddArray(points ? points->GetData() : nullptr, points, since);
}

void Stamps::AddArrays(vtkFieldData* data, vtkMTimeType since)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    this->AddArray(data->GetAbstractArray(i), nullptr, since);
  }
  if (auto* attributes = vtkDataSetAttributes::SafeDownCast(data))
  {
    int numbers[vtkDataSetAttributes::NUM_ATTRIBUTES];
    attributes->GetAttributeIndices(numbers);
    std::for_each(
      std::begin(numbers), std::end(numbers), [this](int number) { this->AddNumber(number); });
  }
}

bool Stamps::Fit(const Stamps& now) const
{
  return std::equal(this->All.begin(), this->All.end(), now.All.begin(), now.All.end(),
    [](const Stamp& a, const Stamp& b) { return a.Fits(b); });
}

vtkMTimeType Stamps::Stamp::FindTime() const
{
  vtkMTimeType time = 0;
  for (vtkObject* object : { static_cast<vtkObject*>(this->Array.Get()), this->Owner.Get() })
  {
    if (object)
    {
      time = std::max(time, object->GetMTime());
    }
  }
  return time;
}

bool Stamps::Stamp::Fits(const Stamp& now) const
{
  if (this->Count == now.Count && this->Time == now.Time && this->Since == now.Since)
  {
    return true;
  }
  return this->MayHaveSameValues(now) && this->HasSameValues(now);
}

/// Values are compared only if they are in different arrays of the same kind, and nobody has
/// changed them since.
bool Stamps::Stamp::MayHaveSameValues(const Stamp& now) const
{
  vtkAbstractArray* a = this->Array;
  vtkAbstractArray* b = now.Array;
  return a && b && a != b && a->GetNumberOfValues() == now.Count && this->Count == now.Count &&
    this->FindTime() <= this->Time && a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents() && GetName(a) == GetName(b);
}

bool Stamps::Stamp::HasSameValues(const Stamp& now) const
{
  vtkAbstractArray* a = this->Array;
  vtkAbstractArray* b = now.Array;
  if (auto* texts = vtkStringArray::SafeDownCast(a))
  {
    const auto* first = texts->GetPointer(0);
    return std::equal(first, first + now.Count, vtkStringArray::SafeDownCast(b)->GetPointer(0));
  }
  const auto size = static_cast<std::size_t>(a->GetDataTypeSize()); // 0 if the values are bits
  if (size == 0 || !vtkDataArray::SafeDownCast(a) || !a->HasStandardMemoryLayout() ||
    !b->HasStandardMemoryLayout())
  {
    return false;
  }
  // Arrays that share memory may both have been changed.
  return now.Count == 0 ||
    (a->GetVoidPointer(0) != b->GetVoidPointer(0) &&
      std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), size * now.Count) == 0);
}

}
