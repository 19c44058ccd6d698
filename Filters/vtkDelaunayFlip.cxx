// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "FlipRun.h"
#include "UpdateReport.h"

#include "vtkCompositeDataSet.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <cstring>
#include <string>

using namespace delaunayflip;

// The enumerators of the engine and of this class have the same values.
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
vtkDelaunayFlip::vtkDelaunayFlip()
  : Report(new UpdateReport)
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
    // The destructor calls this, so nothing may be thrown. Memory not released serves the next run.
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
  this->Superclass::FillInputPortInformation(port, info);
  // Otherwise the executive would run the filter once per block, and no sums could be made.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkDelaunayFlip::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkDelaunayFlip::ProcessRequest(
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

/// Port 0: composite data of the input's type, or a mesh.
int vtkDelaunayFlip::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  auto* blocks = vtkCompositeDataSet::GetData(inputVector[0]);
  const char* type = blocks ? blocks->GetClassName() : "vtkPolyData";
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  if (!output || std::strcmp(type, output->GetClassName()) != 0)
  {
    const auto made = vtkSmartPointer<vtkDataObject>::Take(
      blocks ? static_cast<vtkDataObject*>(blocks->NewInstance()) : vtkPolyData::New());
    outputVector->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
bool vtkDelaunayFlip::Advance()
{
  const bool continues = this->LiveUpdate && this->CanContinue;
  if (continues)
  {
    this->IsStepAsked = true;
    this->Modified();
  }
  return continues;
}

/// The executive takes the output for current after any update, so one that withheld the mesh must
/// be followed by a modification.
bool vtkDelaunayFlip::AdvanceSession()
{
  this->Advance();
  this->WithholdsMesh = true;
  const bool works = this->GetExecutive()->Update(0) != 0;
  this->WithholdsMesh = false;
  if (this->MeshIsWithheld)
  {
    this->Modified();
  }
  return works;
}

const FlipSession* vtkDelaunayFlip::GetSession() const
{
  return this->Run ? &this->Run->GetSession() : nullptr;
}

bool vtkDelaunayFlip::StoreMesh(vtkPolyData* mesh) const
{
  return this->Run && this->Run->Store(mesh);
}

void vtkDelaunayFlip::Restart()
{
  this->Run.reset();
  this->CanContinue = true;
  this->MeshIsWithheld = false;
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

vtkIdType vtkDelaunayFlip::GetNumberOfInsertedConstraintEdges() const
{
  return this->Report->InsertedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfConstraintFlips() const
{
  return this->Report->ConstraintFlips;
}

vtkIdType vtkDelaunayFlip::GetNumberOfNonDelaunayEdges() const
{
  return this->Report->NonDelaunayAfter;
}

vtkIdType vtkDelaunayFlip::GetNumberOfEdgesBlockedByShape() const
{
  return this->Report->BlockedByShape;
}

vtkIdType vtkDelaunayFlip::GetNumberOfEdgesBlockedByEdge() const
{
  return this->Report->BlockedByEdge;
}

bool vtkDelaunayFlip::GetConverged() const
{
  return this->Failure == FAILURE_NONE && this->Report->Converged();
}

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
  return this->Report->HasMixedGeometry ? static_cast<int>(GEOMETRY_MIXED)
                                        : static_cast<int>(this->Report->GeometryUsed);
}

const char* vtkDelaunayFlip::GetGeometryUsedAsString() const
{
  return this->Report->GetGeometryName();
}

const char* vtkDelaunayFlip::GetGeometryReason() const
{
  return this->Report->GeometryReason.c_str();
}

const char* vtkDelaunayFlip::GetSummary() const { return this->Summary.c_str(); }

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
  os << indent << "InsertLines: " << this->InsertLines << "\n";
  os << indent << "InsertConstraints: " << this->InsertConstraints << "\n";
  os << indent << "Triangulate: " << this->Triangulate << "\n";
  os << indent << "Backend: " << this->Backend << "\n";
  os << indent << "DeviceId: " << this->DeviceId << "\n";
  os << indent << "Devices: " << this->Devices << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "TrackQuality: " << this->TrackQuality << "\n";
  os << indent << "GenerateFlipCount: " << this->GenerateFlipCount << "\n";
  os << indent << "GenerateQuality: " << this->GenerateQuality << "\n";
  os << indent << "LiveUpdate: " << this->LiveUpdate << "\n";
  os << indent << "IterationsPerUpdate: " << this->IterationsPerUpdate << "\n";
  os << indent << "Paused: " << this->Paused << "\n";
  os << indent << "Summary:\n" << this->Summary;
}
