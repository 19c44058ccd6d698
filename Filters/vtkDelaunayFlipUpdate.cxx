// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The part of vtkDelaunayFlip that runs in an update.

#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "FlipRun.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"

#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"
#if defined(DELAUNAYFLIP_PARAVIEW)
#include "vtkProcessModule.h"
#endif

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

using namespace delaunayflip;

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

/// A shallow copy, whose leaves and arrays observers cannot take away; null for null.
vtkSmartPointer<vtkDataObject> Hold(vtkDataObject* data)
{
  vtkSmartPointer<vtkDataObject> held;
  if (data)
  {
    held.TakeReference(data->NewInstance());
    held->ShallowCopy(data);
  }
  return held;
}

}

//------------------------------------------------------------------------------
int vtkDelaunayFlip::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Observers may take them from the filter while it works.
  const vtkSmartPointer<vtkDataObject> input = vtkDataObject::GetData(inputVector[0]);
  const vtkSmartPointer<vtkDataObject> output = vtkDataObject::GetData(outputVector);
  const vtkSmartPointer<vtkTable> table = vtkTable::GetData(outputVector, 1);
  const struct Work
  {
    bool& IsUnderWay;
    ~Work() { this->IsUnderWay = false; }
  } work{ this->IsAtWork = true };
  this->HasExecuted = true;
  UpdateSummary summary;
  try
  {
    const auto structure = Hold(input);
    const auto constraints = Hold(vtkDataObject::GetData(inputVector[1]));
    std::vector<MeshBlock> edges;
    if (constraints)
    {
      edges = ListMeshBlocks(constraints);
      edges.resize(std::max<std::size_t>(1, edges.size()), { { 0 }, "", 0.0, false, {} });
    }
    std::vector<MeshBlock> blocks = this->ListBlocks(input);
    bool isLive = false;
    double cells = 0.0;
    for (const MeshBlock& block : blocks)
    {
      isLive = isLive || block.IsLive;
      cells += block.Cells;
    }
    if (this->LiveUpdate && !isLive && !IsBatchProgram())
    {
      summary.Warnings.push_back(
        { "", "LiveUpdate is for one mesh in one piece; others are flipped at once" });
    }
    summary.Report.StopReason = StopReasonKind::Converged; // what an input without blocks is
    double before = 0.0;
    for (MeshBlock& block : blocks)
    {
      this->SetProgressShiftScale(
        before / std::max(1.0, cells), block.Cells / std::max(1.0, cells));
      this->FlipBlock(block, edges, summary);
      before += block.Cells;
    }
    StoreResults(blocks, structure, output);
  }
  catch (...)
  {
    this->DiscardRun();
    output->Initialize();
    summary = UpdateSummary();
    summary.AddFailure(ExplainException(), "");
  }
  this->SetProgressShiftScale(0.0, 1.0);
  AddIterationColumns(this->IsSilent ? FlipReport() : summary.Report, "", table->GetRowData());
  this->Publish(summary);
  // From VTK 9.3 on the executive does not end a request to abort with the update that obeyed it.
  this->SetAbortExecute(0);
  // Even after an error: 0 would keep filters downstream from executing, and a representation of
  // ParaView that did not execute ignores all later changes.
  return 1;
}

/// Leaves nothing half done.
void vtkDelaunayFlip::DiscardRun()
{
  this->Run.reset();
  this->CanContinue = false;
  this->MeshIsWithheld = false;
  *this->Report = UpdateReport();
}

void vtkDelaunayFlip::Publish(const UpdateSummary& summary)
{
  *this->Report = summary.Report;
  this->Failure = summary.Failure;
  this->ErrorMessage = Describe(summary.Errors);
  this->StopReasonText = "failed: " + this->ErrorMessage;
  this->Summary = this->Failure ? this->StopReasonText + "\n" : Summarize(*this->Report);
  this->SetErrorCode(
    this->Failure ? vtkErrorCode::UserError + this->Failure : vtkErrorCode::NoError);
  if (this->Failure && !this->IsSilent)
  {
    vtkErrorMacro(<< this->ErrorMessage);
  }
  if (!summary.Warnings.empty() && !this->IsSilent)
  {
    vtkWarningMacro(<< Describe(summary.Warnings));
  }
}

//------------------------------------------------------------------------------
std::vector<MeshBlock> vtkDelaunayFlip::ListBlocks(vtkDataObject* input)
{
  std::vector<MeshBlock> blocks = ListMeshBlocks(input);
  if (blocks.size() == 1 && blocks.front().Place.empty())
  {
    blocks.front().IsLive = this->LiveUpdate && !IsBatchProgram();
  }
  return blocks;
}

vtkSmartPointer<vtkPolyData> vtkDelaunayFlip::GetMesh(vtkDataObject* input)
{
  return vtkPolyData::SafeDownCast(input);
}

vtkSmartPointer<vtkPolyData> vtkDelaunayFlip::ReadMesh(vtkDataObject* input)
{
  try
  {
    return this->GetMesh(input);
  }
  catch (const std::invalid_argument& error)
  {
    throw InvalidMesh(error.what(), -1, -1);
  }
}

void vtkDelaunayFlip::FlipBlock(
  MeshBlock& block, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  try
  {
    BlockMesh mesh(
      block, [this](vtkDataObject* leaf) { return this->ReadMesh(leaf); }, this->RegionArray);
    const auto edges = mesh.FindConstraints(constraints);
    const std::vector<Note> notes = mesh.ListNotes();
    summary.Warnings.insert(summary.Warnings.end(), notes.begin(), notes.end());
    if (!mesh.GetMesh())
    {
      mesh.Store(nullptr);
      return;
    }
    vtkNew<vtkPolyData> flipped;
    this->FlipMesh(mesh.GetMesh(), edges, block.IsLive, flipped);
    mesh.Store(flipped);
  }
  catch (...)
  {
    this->DiscardRun();
    summary.AddFailure(ExplainException(), block.Name);
    for (BlockLeaf& leaf : block.Leaves)
    {
      leaf.Result = vtkSmartPointer<vtkPolyData>::New();
    }
  }
  const std::string trouble =
    DescribeTrouble(*this->Report, this->MaximumIterations >= 0, this->Tolerance >= 0.0);
  // Live updates give each warning once.
  if (!trouble.empty() && !(this->Run && this->Run->Warning == trouble))
  {
    summary.Warnings.push_back({ block.Name, trouble });
  }
  if (this->Run)
  {
    this->Run->Warning = trouble;
  }
  summary.Report.Add(*this->Report);
}

//------------------------------------------------------------------------------
FlipRequest vtkDelaunayFlip::MakeRequest(vtkPolyData* mesh, vtkPolyData* constraints, bool isLive)
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
  options.Devices = ParseDevices(this->Devices);
  options.NumberOfPieces = this->NumberOfPieces;
  options.TrackQuality = this->TrackQuality;
  const auto observe = [this](double fraction)
  {
    // The share of the whole update, of which this mesh may be a part. It must not go back where a
    // session is advanced again and again.
    const double scale = this->GetProgressScale();
    const double share = this->GetProgressShift() + scale * fraction;
    this->UpdateProgress(share < this->GetProgress() && scale > 0.0
        ? (this->GetProgress() - this->GetProgressShift()) / scale
        : fraction);
    return !IsAbortRequested(this);
  };
  return { mesh, constraints,
    { this->Triangulate, this->LinesAsConstraints, this->InsertLines, this->InsertConstraints,
      this->RegionArray },
    options, isLive, this->GenerateFlipCount, this->GenerateQuality, observe };
}

void vtkDelaunayFlip::FlipMesh(
  vtkPolyData* mesh, vtkPolyData* constraints, bool isLive, vtkPolyData* output)
{
  std::unique_ptr<FlipRun> run = std::move(this->Run); // which observers may reset
  *this->Report = UpdateReport();
  const bool isAsked = std::exchange(this->IsStepAsked, false);
  const bool wasWithheld = std::exchange(this->MeshIsWithheld, false);
  const bool couldContinue = std::exchange(this->CanContinue, false);
  if (mesh->GetNumberOfPolys() == 0 && mesh->GetNumberOfStrips() == 0)
  {
    this->Report->StopReason = StopReasonKind::Converged;
    output->ShallowCopy(mesh);
    return;
  }
  if (!isLive)
  {
    run.reset(); // before another takes as much memory
  }
  try
  {
    if (IsAbortRequested(this))
    {
      throw RunAborted(); // in another block
    }
    const bool isSame = FlipRun::ContinueOrStart(run, this->MakeRequest(mesh, constraints, isLive));
    *this->Report = UpdateReport(run->GetReport());
    const bool storesOnly = isSame && wasWithheld && !isAsked;
    bool isRunning = storesOnly && couldContinue;
    if (!storesOnly && !run->IsStopped())
    {
      const FlipObserver observer = [this](const IterationRecord& record)
      {
        this->Report->Iterations.push_back(record);
        this->Report->TotalFlips += record.Flipped;
        return true;
      };
      constexpr double Seconds = 0.05; // as documented in the header
      FlipSession& session = run->GetSession();
      isRunning = isLive && this->IterationsPerUpdate == 0
        ? AdvanceFor(session, Seconds, observer, run->GetProgress())
        : session.Advance(isLive ? this->IterationsPerUpdate : -1, observer, run->GetProgress());
    }
    this->MeshIsWithheld = isSame && !storesOnly && this->WithholdsMesh;
    const bool isWhole = this->MeshIsWithheld || run->Store(output);
    // Not before: a GPU may fail while its result is fetched.
    *this->Report = UpdateReport(run->GetReport());
    this->Report->StopReason = isWhole ? this->Report->StopReason : StopReasonKind::Aborted;
    AddFieldData(*this->Report, output->GetFieldData());
    this->CanContinue =
      isLive && (isRunning || this->Report->StopReason == StopReasonKind::Aborted);
  }
  catch (const RunAborted&) // before there are triangles to put out
  {
    this->Report->StopReason = StopReasonKind::Aborted;
    output->ShallowCopy(mesh);
    this->CanContinue = isLive;
  }
  if (isLive)
  {
    this->Run = std::move(run);
  }
}
