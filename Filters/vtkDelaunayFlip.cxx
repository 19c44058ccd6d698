// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "FlipFailure.h"
#include "FlipRun.h"
#include "HostProgram.h"
#include "ReportTables.h"
#include "TimedAdvance.h"
#include "VersionDifferences.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <string>
#include <utility>

using namespace delaunayflip;

// The enumerations of the engine and of the class are the same numbers.
static_assert(static_cast<int>(GeometryKind::Surface) == vtkDelaunayFlip::GEOMETRY_SURFACE, "");
static_assert(
  static_cast<int>(CriterionKind::OppositeAngles) == vtkDelaunayFlip::CRITERION_OPPOSITE_ANGLES,
  "");
static_assert(static_cast<int>(TieRuleKind::Canonical) == vtkDelaunayFlip::TIE_RULE_CANONICAL, "");
static_assert(static_cast<int>(BackendKind::Threads) == vtkDelaunayFlip::BACKEND_THREADS, "");
static_assert(
  static_cast<int>(StopReasonKind::Running) == vtkDelaunayFlip::STOP_REASON_RUNNING, "");

static_assert(SmallestMeshForCuda == 20000, "the documentation of Backend says 20,000");

vtkStandardNewMacro(vtkDelaunayFlip);

//------------------------------------------------------------------------------
struct vtkDelaunayFlip::Connection
{
  vtkPolyData* Input;
  vtkPolyData* Constraints; ///< Or null.
  vtkPolyData* Output;
  vtkTable* Iterations;
  bool IsPiece; ///< Of a mesh that several processes share.
};

//------------------------------------------------------------------------------
vtkDelaunayFlip::vtkDelaunayFlip()
  : Report(new FlipReport)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkDelaunayFlip::~vtkDelaunayFlip()
{
  this->Run.reset();
  if (this->HasExecuted)
  {
    this->ReleaseDeviceMemory();
  }
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::ReleaseDeviceMemory()
{
  try
  {
    ReleaseCudaMemory();
  }
  catch (...)
  {
    // The destructor comes here. What could not be given back stays for the next run.
  }
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::SetConstraintsData(vtkPolyData* constraints)
{
  this->SetInputData(1, constraints);
}

vtkTable* vtkDelaunayFlip::GetIterations()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkDelaunayFlip::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return this->Superclass::FillInputPortInformation(port, info);
}

int vtkDelaunayFlip::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

//------------------------------------------------------------------------------
vtkTypeBool vtkDelaunayFlip::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // Later requests, and RequestData, see block after block in the place of a composite input.
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_TIME()))
  {
    this->HasCompositeInput = vtkCompositeDataSet::GetData(inputVector[0], 0) != nullptr;
    this->HasWarnedOfComposite = false;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkDelaunayFlip::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const Connection data{ vtkPolyData::GetData(inputVector[0]), vtkPolyData::GetData(inputVector[1]),
    vtkPolyData::GetData(outputVector, 0), vtkTable::GetData(outputVector, 1),
    vtkStreamingDemandDrivenPipeline::GetUpdateNumberOfPieces(
      outputVector->GetInformationObject(0)) > 1 };
  this->HasExecuted = true;
  this->SetFailure(Attempt([&]() { this->Flip(data); }));
  if (this->Failure != FAILURE_NONE)
  {
    *this->Report = FlipReport();
    this->MayGoOn = false;
    data.Output->Initialize();
    data.Iterations->Initialize();
    AddIterationColumns(*this->Report, "", data.Iterations->GetRowData());
    vtkErrorMacro(<< this->ErrorMessage);
  }
  // Also after an error. Of 0 the representations downstream would not hear the end, without which
  // ParaView's views wait for them and update them no more.
  return 1;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::SetFailure(const FlipFailure& failure)
{
  this->Failure = failure.Kind;
  this->ErrorMessage = failure.Message;
  this->StopReasonText = "failed: " + failure.Message;
  this->SetErrorCode(failure ? vtkErrorCode::UserError + failure.Kind : vtkErrorCode::NoError);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::Flip(const Connection& data)
{
  const bool isLive = this->IsLive(data);
  std::unique_ptr<FlipRun> last = std::move(this->Run);
  *this->Report = FlipReport();
  this->MayGoOn = false;
  if (!data.Input) // a block of a composite dataset may be anything
  {
    throw FlipError("the input is no vtkPolyData; apply Extract Surface (vtkGeometryFilter) first");
  }
  if (data.Input->GetNumberOfPolys() == 0 && data.Input->GetNumberOfStrips() == 0)
  {
    this->Report->StopReason = StopReasonKind::Converged;
    data.Output->ShallowCopy(data.Input);
    AddIterationColumns(*this->Report, "", data.Iterations->GetRowData());
    return;
  }
  if (!isLive)
  {
    last.reset(); // before another takes as much memory
  }
  std::unique_ptr<FlipRun> run = FlipRun::GoOn(std::move(last),
    { data.Input, data.Constraints,
      { this->Triangulate, this->LinesAsConstraints, this->RegionArray }, this->GetOptions(),
      isLive });
  *this->Report = run->GetReport();
  const bool mayGoOn = this->Advance(run->GetSession(), isLive);
  run->Store(data.Output, this->GenerateFlipCount);
  // Not before: a GPU may fail while its result is fetched.
  *this->Report = run->GetReport();
  AddIterationColumns(*this->Report, "", data.Iterations->GetRowData());
  // The totals first: ParaView lists no field data when the first array is empty.
  AddTotals(*this->Report, FieldPrefix, data.Output->GetFieldData());
  AddIterationColumns(*this->Report, FieldPrefix, data.Output->GetFieldData());
  this->Warn(run->Warning);
  if (isLive)
  {
    this->MayGoOn = mayGoOn || this->Report->StopReason == StopReasonKind::Aborted;
    this->Run = std::move(run);
  }
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
  options.TrackQuality = this->TrackQuality;
  return options;
}

//------------------------------------------------------------------------------
/// The iterations of one update.
/// @returns whether another update could still change the mesh.
bool vtkDelaunayFlip::Advance(FlipSession& session, bool isLive)
{
  const FlipObserver observer = [this](const IterationRecord& record)
  { return this->Observe(record); };
  if (isLive && this->IterationsPerUpdate == 0)
  {
    constexpr double Seconds = 0.05; // the header says so
    return AdvanceFor(session, Seconds, observer);
  }
  return session.Advance(isLive ? this->IterationsPerUpdate : -1, observer);
}

bool vtkDelaunayFlip::Observe(const IterationRecord& record)
{
  this->Report->Iterations.push_back(record);
  this->Report->TotalFlips += record.Flipped;
  // How many flips are to come is unknown; the bad edges of this iteration stand for them.
  const double done = static_cast<double>(this->Report->TotalFlips);
  const double known = done + static_cast<double>(record.NonDelaunay);
  const double progress = known > 0.0 ? done / known : 1.0;
  this->UpdateProgress(std::max(this->GetProgress(), progress));
  return !IsAbortRequested(this);
}

//------------------------------------------------------------------------------
std::string vtkDelaunayFlip::DescribeTrouble() const
{
  std::string text = DescribeDefects(this->Report->Defects);
  const auto add = [&text](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  const bool askedForLimit = this->MaximumIterations >= 0;
  if (this->Report->StopReason == StopReasonKind::IterationLimit && !askedForLimit)
  {
    add("stopped by the safety limit of " + std::to_string(this->Report->Iterations.size()) +
      " iterations with " + std::to_string(this->Report->NonDelaunayAfter) +
      " edges left that are not Delaunay");
  }
  if (!this->Report->Fallback.empty())
  {
    add("the GPU could not be used, the CPU did the work: " + this->Report->Fallback);
  }
  return text;
}

/// Live updates warn of the same once.
void vtkDelaunayFlip::Warn(std::string& last)
{
  const std::string text = this->DescribeTrouble();
  if (!text.empty() && text != last)
  {
    vtkWarningMacro(<< text);
  }
  last = text;
}

//------------------------------------------------------------------------------
bool vtkDelaunayFlip::IsLive(const Connection& data)
{
  if (this->LiveUpdate && this->HasCompositeInput && !this->HasWarnedOfComposite)
  {
    vtkWarningMacro(<< "LiveUpdate is for a single mesh; composite input is flipped at once.");
    this->HasWarnedOfComposite = true;
  }
  return this->LiveUpdate && !this->HasCompositeInput && !data.IsPiece && !IsBatchProgram();
}

bool vtkDelaunayFlip::Advance()
{
  const bool goesOn = this->LiveUpdate && this->MayGoOn;
  if (goesOn)
  {
    this->Modified();
  }
  return goesOn;
}

void vtkDelaunayFlip::Restart()
{
  this->Run.reset();
  this->MayGoOn = true;
  this->Modified();
}

bool vtkDelaunayFlip::GetNeedsUpdate()
{
  const bool isUnderWay = this->Run && this->Report->StopReason == StopReasonKind::Running;
  return isUnderWay && !this->Paused && this->Advance();
}

//------------------------------------------------------------------------------
vtkIdType vtkDelaunayFlip::GetNumberOfIterations() const
{
  return static_cast<vtkIdType>(this->Report->Iterations.size());
}

vtkIdType vtkDelaunayFlip::GetTotalFlips() const { return this->Report->TotalFlips; }

vtkIdType vtkDelaunayFlip::GetNumberOfConstraintEdges() const
{
  return this->Report->Edges.Constraint;
}

vtkIdType vtkDelaunayFlip::GetNumberOfUnmatchedConstraintEdges() const
{
  return this->Report->UnmatchedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfNonDelaunayEdges() const
{
  return this->Report->NonDelaunayAfter;
}

bool vtkDelaunayFlip::GetConverged() const { return this->Report->Converged(); }

int vtkDelaunayFlip::GetStopReason() const
{
  return this->Failure != FAILURE_NONE ? static_cast<int>(STOP_REASON_FAILED)
                                       : static_cast<int>(this->Report->StopReason);
}

const char* vtkDelaunayFlip::GetStopReasonAsString() const
{
  return this->Failure != FAILURE_NONE ? this->StopReasonText.c_str()
                                       : ToString(this->Report->StopReason);
}

const char* vtkDelaunayFlip::GetErrorMessage() const { return this->ErrorMessage.c_str(); }

int vtkDelaunayFlip::GetGeometryUsed() const
{
  return static_cast<int>(this->Report->GeometryUsed);
}

const char* vtkDelaunayFlip::GetGeometryUsedAsString() const
{
  return ToString(this->Report->GeometryUsed);
}

const char* vtkDelaunayFlip::GetBackendUsed() const { return this->Report->Backend.c_str(); }

const FlipReport& vtkDelaunayFlip::GetReport() const { return *this->Report; }

//------------------------------------------------------------------------------
void vtkDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Geometry: " << this->Geometry << "\n";
  os << indent << "Criterion: " << this->Criterion << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TieRule: " << this->TieRule << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "RegionArray: " << this->RegionArray << "\n";
  os << indent << "LinesAsConstraints: " << this->LinesAsConstraints << "\n";
  os << indent << "Triangulate: " << this->Triangulate << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "DeviceId: " << this->DeviceId << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "TrackQuality: " << this->TrackQuality << "\n";
  os << indent << "GenerateFlipCount: " << this->GenerateFlipCount << "\n";
  os << indent << "LiveUpdate: " << this->LiveUpdate << "\n";
  os << indent << "IterationsPerUpdate: " << this->IterationsPerUpdate << "\n";
  os << indent << "Paused: " << this->Paused << "\n";
  os << indent << "NumberOfIterations: " << this->GetNumberOfIterations() << "\n";
  os << indent << "TotalFlips: " << this->GetTotalFlips() << "\n";
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
}
