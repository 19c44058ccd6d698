// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The part of vtkDelaunayFlip that runs in an update.

#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "FlipRun.h"
#include "PieceGroup.h"
#include "RankSum.h"
#include "ReportTables.h"
#include "UpdateReport.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"
#if defined(DELAUNAYFLIP_PARAVIEW)
#include "vtkProcessModule.h"
#endif

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <utility>

using namespace delaunayflip;

//------------------------------------------------------------------------------
/// How the run of an update may go on from that of the last one.
struct vtkDelaunayFlip::Resumption
{
  bool StoresOnly; ///< No step: the last update withheld its mesh.
  bool CouldContinue; ///< What CanContinue was after it.
};

namespace
{

// What depends on the version of VTK, and on ParaView.

/// Whether `filter` was asked to abort, directly or, from VTK 9.3 on, through a filter upstream.
/// After a direct request the filter keeps its output, which the executive would otherwise empty.
bool IsAbortRequested(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  const bool aborted = filter->CheckAbort();
  if (filter->GetAbortExecute())
  {
    filter->SetAbortOutput(false);
  }
  return aborted;
#else
  return filter->GetAbortExecute() != 0;
#endif
}

/// Ends a request to abort with the update that obeyed it. From VTK 9.3 on the executive does not,
/// and all later updates would be aborted too.
void ForgetAbortRequest(vtkAlgorithm* filter) { filter->SetAbortExecute(0); }

/// Whether the filter runs in ParaView's pvbatch, where nobody watches the mesh improve, and
/// scripts and state files expect the final mesh.
bool IsBatchProgram()
{
#if defined(DELAUNAYFLIP_PARAVIEW)
  return vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_BATCH;
#else
  return false;
#endif
}

/// Calls FlipSession::Advance for as many iterations as fit into `seconds`, at least one.
bool AdvanceFor(FlipSession& session, double seconds, const FlipObserver& observer,
  const ProgressObserver& progress)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto getElapsed = [start]()
  { return std::chrono::duration<double>(Clock::now() - start).count(); };
  double elapsed = 0.0;
  double iterations = 1.0;
  bool isRunning = false;
  do
  {
    const double before = elapsed;
    isRunning = session.Advance(static_cast<std::int64_t>(iterations), observer, progress);
    elapsed = getElapsed();
    // Batches of iterations are faster than single ones, above all on a GPU. But an iteration may
    // take longer than those before, so batches grow slowly.
    const double fitting = (seconds - elapsed) * iterations / (elapsed - before);
    iterations = std::min(fitting, 2.0 * iterations);
  } while (isRunning && iterations >= 1.0);
  return isRunning;
}

/// Sets a flag while it lives.
class FlagScope
{
public:
  explicit FlagScope(bool& flag)
    : Flag(flag)
  {
    this->Flag = true;
  }
  ~FlagScope() { this->Flag = false; }
  FlagScope(const FlagScope&) = delete;
  FlagScope& operator=(const FlagScope&) = delete;

private:
  bool& Flag;
};

void WarnOfLiveUpdate(bool isIgnored, UpdateSummary& summary)
{
  if (isIgnored)
  {
    summary.Warnings.push_back(
      { "", "LiveUpdate is for one mesh in one piece; blocks and pieces are flipped at once" });
  }
}

}

//------------------------------------------------------------------------------
int vtkDelaunayFlip::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  const Piece piece{ vtkStreamingDemandDrivenPipeline::GetUpdatePiece(outInfo),
    vtkStreamingDemandDrivenPipeline::GetUpdateNumberOfPieces(outInfo) };
  // Observers may take them from the filter while it works.
  const vtkSmartPointer<vtkDataObject> input = vtkDataObject::GetData(inputVector[0]);
  const vtkSmartPointer<vtkDataObject> constraints = vtkDataObject::GetData(inputVector[1]);
  const vtkSmartPointer<vtkDataObject> output = vtkDataObject::GetData(outputVector);
  const vtkSmartPointer<vtkTable> table = vtkTable::GetData(outputVector, 1);
  auto* blocks = vtkCompositeDataSet::SafeDownCast(input);
  auto* mesh = vtkPolyData::SafeDownCast(output);
  const FlagScope atWork(this->IsAtWork);
  this->HasExecuted = true;
  std::unique_ptr<PieceGroup> group;
  UpdateSummary summary;
  const FlipFailure failure = Attempt(
    [&]()
    {
      group = this->MakeGroup();
      summary = group ? this->FlipTogether(input, constraints, output, *group)
        : blocks      ? this->FlipBlocks(blocks, constraints, output, *MakeSingleGroup())
                      : this->FlipMesh(input, constraints, mesh, piece.Count > 1);
      WarnOfLiveUpdate(this->LiveUpdate && (blocks || group || piece.Count > 1), summary);
    });
  if (failure)
  {
    summary = UpdateSummary();
    this->DiscardRun(output);
    summary.AddMesh({ *this->Report, failure, "" }, 0, "");
  }
  const bool isFirst = group ? group->GetRank() == 0 : JoinRanks(summary, piece); // on every rank
  const auto report = [&]()
  {
    // The rows are sums over all ranks, and ParaView would concatenate the tables of the ranks.
    AddIterationColumns(isFirst ? summary.Report : UpdateReport(), "", table->GetRowData());
    if (mesh && piece.Count > 1)
    {
      RenewFieldData(summary.Report, mesh->GetFieldData());
    }
    this->Publish(summary, isFirst);
  };
  const FlipFailure unreported =
    Attempt([&]() { group ? DoTogether(*group, std::ref(report)) : report(); });
  if (unreported)
  {
    this->DiscardRun(output);
    table->Initialize();
    UpdateSummary nothing;
    nothing.AddMesh({ *this->Report, unreported, "" }, 0, "");
    this->Publish(nothing, isFirst);
  }
  ForgetAbortRequest(this);
  // Even after an error: 0 would keep filters downstream from executing, and a representation of
  // ParaView that did not execute ignores all later changes.
  return 1;
}

//------------------------------------------------------------------------------
/// Leaves nothing half done.
void vtkDelaunayFlip::DiscardRun(vtkDataObject* output)
{
  this->Run.reset();
  this->CanContinue = false;
  this->MeshIsWithheld = false;
  *this->Report = UpdateReport();
  output->Initialize();
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::Publish(const UpdateSummary& summary, bool withMessages)
{
  *this->Report = summary.Report;
  this->Failure = summary.Failure;
  this->ErrorMessage = Describe(summary.Errors);
  this->StopReasonText = "failed: " + this->ErrorMessage;
  this->SetErrorCode(
    this->Failure ? vtkErrorCode::UserError + this->Failure : vtkErrorCode::NoError);
  std::vector<Note> warnings = summary.Warnings;
  if (summary.HasSeams)
  {
    warnings.push_back({ "", "edges between pieces of the mesh stayed as they were" });
  }
  if (withMessages && this->Failure)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  if (withMessages && !warnings.empty())
  {
    vtkWarningMacro(<< Describe(warnings));
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> vtkDelaunayFlip::GetMesh(vtkDataObject* input)
{
  return vtkPolyData::SafeDownCast(input);
}

//------------------------------------------------------------------------------
UpdateSummary vtkDelaunayFlip::FlipMesh(
  vtkDataObject* input, vtkDataObject* constraints, vtkPolyData* output, bool isPiece)
{
  UpdateSummary summary;
  MeshOutcome outcome;
  vtkSmartPointer<vtkPolyData> mesh;
  outcome.Failure = Attempt([&]() { mesh = this->GetMesh(input); });
  auto* edges = vtkPolyData::SafeDownCast(constraints);
  if (!mesh && !outcome.Failure)
  {
    outcome.Failure = { FAILURE_MESH, "the input is not a surface; apply Extract Surface first" };
  }
  else if (mesh && constraints && !edges)
  {
    outcome.Failure = { FAILURE_OPTIONS,
      "the constraints of a single mesh cannot be a composite dataset" };
  }
  else if (mesh)
  {
    const bool isLive = this->LiveUpdate && !isPiece && !IsBatchProgram();
    outcome = this->TryToFlip({ mesh, edges, output, isLive });
  }
  summary.AddMesh(outcome, 0, "");
  return summary;
}

//------------------------------------------------------------------------------
MeshOutcome vtkDelaunayFlip::TryToFlip(const Connection& data)
{
  MeshOutcome outcome;
  outcome.Failure = Attempt([&]() { this->Flip(data); });
  if (outcome.Failure)
  {
    this->DiscardRun(data.Output);
  }
  outcome.Report = *this->Report;
  outcome.Trouble =
    DescribeTrouble(outcome.Report, this->MaximumIterations >= 0, this->Tolerance >= 0.0);
  if (this->Run && outcome.Trouble == std::exchange(this->Run->Warning, outcome.Trouble))
  {
    outcome.Trouble.clear(); // live updates give each warning once
  }
  return outcome;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::Flip(const Connection& data)
{
  std::unique_ptr<FlipRun> run = std::move(this->Run); // which observers may reset
  *this->Report = UpdateReport();
  const bool isAsked = std::exchange(this->IsStepAsked, false);
  const bool isWithheld = std::exchange(this->MeshIsWithheld, false);
  const Resumption from{ isWithheld && !isAsked, std::exchange(this->CanContinue, false) };
  if (data.Input->GetNumberOfPolys() == 0 && data.Input->GetNumberOfStrips() == 0)
  {
    this->PassInput(data, StopReasonKind::Converged);
    return;
  }
  if (!data.IsLive)
  {
    run.reset(); // before another takes as much memory
  }
  try
  {
    this->Flip(data, run, from);
  }
  catch (const RunAborted&)
  {
    this->PassInput(data, StopReasonKind::Aborted);
    this->CanContinue = data.IsLive;
  }
  if (data.IsLive)
  {
    this->Run = std::move(run);
  }
}

/// @param run the last one, or null; it becomes the one of this update.
/// @throws RunAborted when it is stopped before there are triangles to put out.
void vtkDelaunayFlip::Flip(
  const Connection& data, std::unique_ptr<FlipRun>& run, const Resumption& from)
{
  if (IsAbortRequested(this))
  {
    throw RunAborted(); // in another block
  }
  const bool isSame = FlipRun::ContinueOrStart(run,
    { data.Input, data.Constraints,
      { this->Triangulate, this->LinesAsConstraints, this->InsertLines, this->InsertConstraints,
        this->RegionArray },
      this->GetOptions(), data.IsLive, { this->GenerateFlipCount, this->GenerateQuality },
      [this](double fraction) { return this->ObserveProgress(fraction); } });
  *this->Report = UpdateReport(run->GetReport());
  const bool storesOnly = isSame && from.StoresOnly;
  const bool isRunning =
    storesOnly ? from.CouldContinue : !run->IsStopped() && this->Advance(*run, data.IsLive);
  this->MeshIsWithheld = isSame && !storesOnly && this->WithholdsMesh;
  vtkNew<vtkPolyData> result; // which no observer can change
  const bool isWhole = this->MeshIsWithheld || run->Store(result);
  // Not before: a GPU may fail while its result is fetched.
  *this->Report = UpdateReport(run->GetReport());
  this->Report->StopReason = isWhole ? this->Report->StopReason : StopReasonKind::Aborted;
  AddFieldData(*this->Report, result->GetFieldData());
  data.Output->ShallowCopy(result);
  this->CanContinue =
    data.IsLive && (isRunning || this->Report->StopReason == StopReasonKind::Aborted);
}

/// Passes the input to the output unchanged.
void vtkDelaunayFlip::PassInput(const Connection& data, StopReasonKind reason)
{
  this->Report->StopReason = reason;
  data.Output->ShallowCopy(data.Input);
}

//------------------------------------------------------------------------------
FlipOptions vtkDelaunayFlip::GetOptions() const
{
  FlipOptions options;
  options.Geometry = static_cast<GeometryKind>(this->Geometry);
  options.Criterion = static_cast<CriterionKind>(this->Criterion);
  options.TieRule = static_cast<TieRuleKind>(this->TieRule);
  options.Backend = static_cast<BackendKind>(this->Backend);
  options.Tolerance = this->Tolerance;
  options.FeatureAngle = this->FeatureAngle;
  options.MaximumIterations = this->MaximumIterations;
  options.NumberOfThreads = this->NumberOfThreads;
  options.Device = this->DeviceId;
  options.Devices = delaunayflip::ParseDevices(this->Devices);
  options.NumberOfPieces = this->NumberOfPieces;
  options.TrackQuality = this->TrackQuality;
  return options;
}

//------------------------------------------------------------------------------
/// The iterations of one update.
/// @returns whether another update could still change the mesh.
bool vtkDelaunayFlip::Advance(FlipRun& run, bool isLive)
{
  FlipSession& session = run.GetSession();
  const FlipObserver observer = [this](const IterationRecord& record)
  { return this->Observe(record); };
  const delaunayflip::ProgressObserver progress = run.GetProgress();
  if (isLive && this->IterationsPerUpdate == 0)
  {
    constexpr double Seconds = 0.05; // as documented in the header
    return AdvanceFor(session, Seconds, observer, progress);
  }
  return session.Advance(isLive ? this->IterationsPerUpdate : -1, observer, progress);
}

bool vtkDelaunayFlip::Observe(const IterationRecord& record)
{
  this->Report->Iterations.push_back(record);
  this->Report->TotalFlips += record.Flipped;
  return true;
}

bool vtkDelaunayFlip::ObserveProgress(double fraction)
{
  // The share of the whole update, of which this block may be a part.
  const double share = this->GetProgressShift() + this->GetProgressScale() * fraction;
  const bool goesBack = share < this->GetProgress() && this->GetProgressScale() > 0.0;
  this->UpdateProgress(goesBack
      ? (this->GetProgress() - this->GetProgressShift()) / this->GetProgressScale()
      : fraction);
  return !IsAbortRequested(this);
}
