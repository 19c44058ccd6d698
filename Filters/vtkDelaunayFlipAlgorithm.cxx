// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipAlgorithm.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "MeshBlocks.h"
#include "UpdatePipeline.h"
#include "UpdateReport.h"
#include "UpdateRun.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"
#if defined(DELAUNAYFLIP_PARAVIEW)
#include "vtkProcessModule.h"
#endif

#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace delaunayflip;
using Asked = vtkStreamingDemandDrivenPipeline;

// The enumerators of the engine and of this class have the same values.
static_assert(
  static_cast<int>(BackendKind::Threads) == vtkDelaunayFlipAlgorithm::BACKEND_THREADS, "");
static_assert(
  static_cast<int>(StopReasonKind::Running) == vtkDelaunayFlipAlgorithm::STOP_REASON_RUNNING, "");
static_assert(static_cast<int>(FailureKind::Other) == vtkDelaunayFlipAlgorithm::FAILURE_OTHER, "");

static_assert(SmallestMeshForCuda == 20000, "the documentation of Backend says 20,000");

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

}

//------------------------------------------------------------------------------
vtkDelaunayFlipAlgorithm::vtkDelaunayFlipAlgorithm()
  : Runs(new RunKeeper),
    Report(new FlipReport),
    SizeOfBlocks(vtkDataObject::CELL),
    SizeOfOthers(vtkDataObject::CELL)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkDelaunayFlipAlgorithm::~vtkDelaunayFlipAlgorithm()
{
  this->Runs->Drop(false);
  if (this->GetStopReason() != STOP_REASON_NOT_STARTED) // it may have memory of a GPU
  {
    this->ReleaseDeviceMemory();
  }
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipAlgorithm::ReleaseDeviceMemory()
{
  try
  {
    ReleaseCudaMemory();
  }
  catch (...)
  {
    // The destructor calls this, so nothing may be thrown. Memory not released serves the next run.
  }
}

vtkTable* vtkDelaunayFlipAlgorithm::GetIterations()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
vtkExecutive* vtkDelaunayFlipAlgorithm::CreateDefaultExecutive()
{
  vtkExecutive* usual = this->Superclass::CreateDefaultExecutive();
  if (std::strcmp(usual->GetClassName(), "vtkCompositeDataPipeline") != 0)
  {
    return usual; // which the program prefers, such as ParaView
  }
  usual->Delete();
  UpdatePipeline* pipeline = UpdatePipeline::New();
  pipeline->OnRefusal = [this](const std::string& why) { this->RefuseInput(why); };
  return pipeline;
}

int vtkDelaunayFlipAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  const char* types[] = { this->InputType, "vtkPolyData" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  // Otherwise the executive would run the filter once per block, and no sums could be made.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkDelaunayFlipAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkDataObject", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkDelaunayFlipAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputVector, outputVector);
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) && this->IsAtWork)
  {
    vtkErrorMacro("An observer asked for an update within an update.");
    return 0;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

/// Port 0 has a mesh, or data of the input's type.
int vtkDelaunayFlipAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const vtkNew<vtkPolyData> mesh;
  vtkDataObject* type = mesh;
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  if (input && (this->KeepsType || vtkCompositeDataSet::SafeDownCast(input)))
  {
    type = input;
  }
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!output || std::strcmp(type->GetClassName(), output->GetClassName()) != 0)
  {
    const auto made = vtkSmartPointer<vtkDataObject>::Take(type->NewInstance());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
bool vtkDelaunayFlipAlgorithm::Advance()
{
  const bool continues = this->LiveUpdate && this->Runs->CanContinue;
  if (continues)
  {
    this->Runs->Next = RunKeeper::UpdateKind::StepAndStore;
    this->Modified();
  }
  return continues;
}

/// The executive empties the output, and takes it for current after any update.
bool vtkDelaunayFlipAlgorithm::AdvanceSession()
{
  auto* output = vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
  vtkNew<vtkPolyData> last;
  if (output)
  {
    last->ShallowCopy(output);
  }
  this->Advance();
  this->Runs->Next = RunKeeper::UpdateKind::Step;
  const bool works = this->GetExecutive()->Update(0) != 0;
  if (this->GetMeshIsWithheld())
  {
    output->ShallowCopy(last);
    this->Modified();
  }
  else
  {
    this->Runs->Next = RunKeeper::UpdateKind::StepAndStore;
  }
  return works;
}

bool vtkDelaunayFlipAlgorithm::GetMeshIsWithheld() const
{
  return this->Runs->Next == RunKeeper::UpdateKind::Store;
}

const FlipSession* vtkDelaunayFlipAlgorithm::GetSession() const
{
  return this->Runs->GetSessionToDraw();
}

void vtkDelaunayFlipAlgorithm::Restart()
{
  this->Runs->Drop(true);
  this->IsRestarted = true;
  this->Modified();
}

bool vtkDelaunayFlipAlgorithm::GetNeedsUpdate()
{
  const bool isUnderWay =
    this->Runs->HasRun() && this->Report->StopReason == StopReasonKind::Running;
  return isUnderWay && !this->Paused && this->Advance();
}

//------------------------------------------------------------------------------
vtkIdType vtkDelaunayFlipAlgorithm::GetNumberOfIterations() const
{
  return static_cast<vtkIdType>(this->Report->Iterations.size());
}

vtkIdType vtkDelaunayFlipAlgorithm::GetTotalFlips() const { return this->Report->TotalFlips; }

vtkIdType vtkDelaunayFlipAlgorithm::GetNonDelaunayAfter() const
{
  return this->Report->NonDelaunayAfter;
}

bool vtkDelaunayFlipAlgorithm::GetConverged() const
{
  return this->Failure == FAILURE_NONE && this->Report->Converged();
}

int vtkDelaunayFlipAlgorithm::GetStopReason() const
{
  if (this->Failure != FAILURE_NONE)
  {
    return STOP_REASON_FAILED;
  }
  return static_cast<int>(this->Report->StopReason);
}

const char* vtkDelaunayFlipAlgorithm::GetStopReasonAsString() const
{
  if (this->Failure != FAILURE_NONE)
  {
    return this->StopReasonText.c_str();
  }
  return ToString(this->Report->StopReason);
}

const char* vtkDelaunayFlipAlgorithm::GetErrorMessage() const { return this->ErrorMessage.c_str(); }

const char* vtkDelaunayFlipAlgorithm::GetSummary() const { return this->Summary.c_str(); }

const char* vtkDelaunayFlipAlgorithm::GetBackendUsed() const
{
  return this->Report->Backend.c_str();
}

const FlipReport& vtkDelaunayFlipAlgorithm::GetReport() const { return *this->Report; }

//------------------------------------------------------------------------------
/// The outputs change whenever one of the inputs does. VTK passes on the times of the first alone.
int vtkDelaunayFlipAlgorithm::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  std::set<double> times;
  double range[2] = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* info = inputVector[port]->GetInformationObject(0);
    if (info && info->Has(Asked::TIME_STEPS()))
    {
      const double* steps = info->Get(Asked::TIME_STEPS());
      times.insert(steps, steps + info->Length(Asked::TIME_STEPS()));
    }
    if (info && info->Has(Asked::TIME_RANGE()))
    {
      range[0] = std::min(range[0], info->Get(Asked::TIME_RANGE())[0]);
      range[1] = std::max(range[1], info->Get(Asked::TIME_RANGE())[1]);
    }
  }
  const std::vector<double> steps(times.begin(), times.end());
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    if (!steps.empty())
    {
      info->Set(Asked::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
    }
    if (range[0] <= range[1])
    {
      info->Set(Asked::TIME_RANGE(), range, 2);
    }
  }
  return 1;
}

/// Points are wanted whole, and a piece of a mesh may need any of the second input. But an
/// algorithm upstream of both inputs cannot make a piece for one and all for the other.
int vtkDelaunayFlipAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool arePoints = this->SizeOfBlocks == vtkDataObject::POINT;
  for (int port = arePoints ? 0 : 1; port < 2; ++port)
  {
    vtkInformation* info = inputVector[port]->GetInformationObject(0);
    if (info &&
      (arePoints || !ShareUpstream(this->GetInputAlgorithm(0, 0), this->GetInputAlgorithm(1, 0))))
    {
      info->Set(Asked::UPDATE_PIECE_NUMBER(), 0);
      info->Set(Asked::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(Asked::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
}

int vtkDelaunayFlipAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Observers may take them from the filter while it works, and the input even before.
  const vtkSmartPointer<vtkDataObject> output = vtkDataObject::GetData(outputVector);
  vtkSmartPointer<vtkDataObject> input = vtkDataObject::GetData(inputVector[0]);
  if (!input)
  {
    input.TakeReference(output->NewInstance());
  }
  const vtkSmartPointer<vtkTable> table = vtkTable::GetData(outputVector, 1);
  const struct Work
  {
    bool& IsUnderWay;
    ~Work() { this->IsUnderWay = false; }
  } work{ this->IsAtWork = true };
  UpdateSummary summary;
  this->IsRestarted = false;
  try
  {
    const auto structure = Hold(input);
    std::vector<MeshBlock> others;
    if (vtkDataObject* second = vtkDataObject::GetData(inputVector[1]))
    {
      others = ListOtherBlocks(Hold(second), this->SizeOfOthers);
    }
    std::vector<MeshBlock> blocks = this->ListBlocks(
      vtkCompositeDataSet::SafeDownCast(input) ? structure : input, others, summary);
    double size = 0.0;
    for (const MeshBlock& block : blocks)
    {
      size += block.Size;
    }
    const bool isLive = blocks.size() == 1 && blocks.front().IsLive;
    if (this->LiveUpdate && this->HasSteps && !isLive && !IsBatchProgram())
    {
      summary.Warnings.push_back(
        { "", "LiveUpdate is for one mesh in one piece; this input was flipped at once" });
    }
    summary.Report.StopReason = StopReasonKind::Converged; // what an input without blocks is
    double before = 0.0;
    for (MeshBlock& block : blocks)
    {
      this->SetProgressShiftScale(before / std::max(1.0, size), block.Size / std::max(1.0, size));
      this->FlipBlock(block, others, summary);
      before += block.Size;
    }
    const bool isOfEarlierMesh = blocks.size() != 1 || this->Runs->HasRun();
    if (!isLive && isOfEarlierMesh)
    {
      this->Runs->Drop(false);
    }
    StoreResults(blocks, structure, output);
  }
  catch (...)
  {
    this->Runs->Drop(false);
    output->Initialize();
    summary = UpdateSummary();
    summary.AddFailure("");
  }
  if (this->IsRestarted)
  {
    this->Runs->Drop(true);
  }
  this->SetProgressShiftScale(0.0, 1.0);
  const FlipReport& shown = this->IsSilent ? FlipReport() : summary.Report;
  AddIterationColumns(shown, "", table->GetRowData());
  this->Publish(summary);
  // From VTK 9.3 on the executive does not end a request to abort with the update that obeyed it.
  this->SetAbortExecute(0);
  // An error does not make it 0: that would keep filters downstream from executing, and a
  // representation of ParaView that did not execute ignores all later changes.
  return 1;
}

/// VTK has given the error, and has not asked for an update.
void vtkDelaunayFlipAlgorithm::RefuseInput(const std::string& why)
{
  if (this->IsAtWork) // an update within an update was refused
  {
    return;
  }
  this->Runs->Drop(false);
  UpdateSummary summary;
  summary.Failure = FailureKind::Mesh;
  summary.Errors.push_back({ "", why });
  this->Keep(summary);
  for (int port = 0; port < 2; ++port)
  {
    if (vtkDataObject* output = this->GetExecutive()->GetOutputData(port))
    {
      output->Initialize(); // what an earlier update has made
    }
  }
}

void vtkDelaunayFlipAlgorithm::Keep(const UpdateSummary& summary)
{
  *this->Report = summary.Report;
  this->Failure = static_cast<int>(summary.Failure);
  this->FailedRing = static_cast<vtkIdType>(summary.FailedRing);
  this->ErrorMessage = Describe(summary.Errors);
  this->StopReasonText = "failed: " + this->ErrorMessage;
  if (this->Failure != FAILURE_NONE)
  {
    this->Summary = this->StopReasonText + "\n";
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
  else
  {
    this->Summary = Summarize(*this->Report);
    this->SetErrorCode(vtkErrorCode::NoError);
  }
}

void vtkDelaunayFlipAlgorithm::Publish(const UpdateSummary& summary)
{
  this->Keep(summary);
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
std::vector<MeshBlock> vtkDelaunayFlipAlgorithm::ListBlocks(
  vtkDataObject* input, const std::vector<MeshBlock>& others, UpdateSummary& summary)
{
  std::vector<MeshBlock> blocks = ListMeshBlocks(input, this->SizeOfBlocks);
  if (blocks.size() == 1 && blocks.front().Place.empty())
  {
    blocks.front().IsLive = this->LiveUpdate && !IsBatchProgram() &&
      this->GetOutputInformation(0)->Get(Asked::UPDATE_NUMBER_OF_PIECES()) <= 1;
  }
  if (!others.empty())
  {
    summary.Warnings = ListMisfits(blocks, others);
  }
  return blocks;
}

void vtkDelaunayFlipAlgorithm::FlipBlock(
  MeshBlock& block, const std::vector<MeshBlock>& others, UpdateSummary& summary)
{
  *this->Report = FlipReport();
  try
  {
    this->FlipLeaves(block, others, summary);
  }
  catch (...)
  {
    this->Runs->Drop(false);
    *this->Report = FlipReport();
    summary.AddFailure(block.Name);
    for (BlockLeaf& leaf : block.Leaves)
    {
      if (leaf.Data->IsA(this->InputType))
      {
        const vtkNew<vtkPolyData> mesh;
        vtkDataObject* type = this->KeepsType ? leaf.Data.Get() : mesh.Get();
        leaf.Result.TakeReference(type->NewInstance());
      }
      else
      {
        leaf.Result = Hold(leaf.Data);
      }
    }
  }
  const std::string trouble =
    DescribeTrouble(*this->Report, this->MaximumIterations >= 0, this->HasTolerance());
  std::vector<Note>& warnings = summary.Warnings;
  if (!trouble.empty())
  {
    warnings.push_back({ block.Name, trouble });
  }
  if (this->HasSteps) // live updates give each warning once
  {
    const auto isKnown = [this](const Note& note)
    { return !this->Runs->IsNewWarning(Describe({ note })); };
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(), isKnown), warnings.end());
  }
  AddReport(summary.Report, *this->Report);
}

//------------------------------------------------------------------------------
template <typename Visit>
void vtkDelaunayFlipAlgorithm::ForEachOption(const Visit& visit) const
{
  visit("Backend", this->Backend, &FlipOptions::Backend);
  visit("DeviceId", this->DeviceId, &FlipOptions::Device);
  visit("NumberOfThreads", this->NumberOfThreads, &FlipOptions::NumberOfThreads);
  visit("MaximumIterations", this->MaximumIterations, &FlipOptions::MaximumIterations);
  visit("MinimumAngle", this->MinimumAngle, &FlipOptions::MinimumAngle);
  visit("MaximumArea", this->MaximumArea, &FlipOptions::MaximumArea);
  visit("MaximumEdge", this->MaximumEdge, &FlipOptions::MaximumEdge);
  visit("KeepBoundary", this->KeepBoundary, &FlipOptions::KeepBoundary);
  visit("PointLimit", this->PointLimit, &FlipOptions::PointLimit);
}

void vtkDelaunayFlipAlgorithm::FillRequest(UpdateRequest& request, FlipOptions& options)
{
  this->ForEachOption(SetterOf(options));
  request.IterationsPerUpdate = this->IterationsPerUpdate;
  request.IsAborted = [this]() { return IsAbortRequested(this); };
  request.Progress = [this](double fraction)
  {
    // The share of the whole update, of which this mesh may be a part. It must not go back where a
    // session is advanced again and again.
    const double scale = this->GetProgressScale();
    const double share = this->GetProgressShift() + scale * fraction;
    const bool goesBack = share < this->GetProgress() && scale > 0.0;
    if (goesBack)
    {
      fraction = (this->GetProgress() - this->GetProgressShift()) / scale;
    }
    this->UpdateProgress(fraction);
    return !IsAbortRequested(this);
  };
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->ForEachOption([&](const char* name, const auto& value, auto)
    { os << indent << name << ": " << value << "\n"; });
  os << indent << "SizeArray: " << this->SizeArray << "\n";
  os << indent << "LiveUpdate: " << this->LiveUpdate << "\n";
  os << indent << "IterationsPerUpdate: " << this->IterationsPerUpdate << "\n";
  os << indent << "Paused: " << this->Paused << "\n";
  os << indent << "Summary:\n" << this->Summary;
}
