// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

using namespace delaunayflip;

// The enumerators of the engine and of this class have the same values.
static_assert(static_cast<int>(GeometryKind::Mixed) == vtkDelaunayFlip::GEOMETRY_MIXED, "");
static_assert(
  static_cast<int>(CriterionKind::OppositeAngles) == vtkDelaunayFlip::CRITERION_OPPOSITE_ANGLES,
  "");
static_assert(static_cast<int>(TieRuleKind::Canonical) == vtkDelaunayFlip::TIE_RULE_CANONICAL, "");

vtkStandardNewMacro(vtkDelaunayFlip);

//------------------------------------------------------------------------------
vtkIdType vtkDelaunayFlip::GetNumberOfConstraintEdges() const
{
  return this->GetReport().Edges.Constraint;
}

vtkIdType vtkDelaunayFlip::GetNumberOfUnmatchedConstraints() const
{
  return this->GetReport().UnmatchedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfInsertedConstraints() const
{
  return this->GetReport().InsertedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfConstraintFlips() const
{
  return this->GetReport().ConstraintFlips;
}

vtkIdType vtkDelaunayFlip::GetBlockedByShape() const { return this->GetReport().BlockedByShape; }

vtkIdType vtkDelaunayFlip::GetBlockedByDeviation() const
{
  return this->GetReport().BlockedByDeviation;
}

vtkIdType vtkDelaunayFlip::GetBlockedByEdge() const { return this->GetReport().BlockedByEdge; }

int vtkDelaunayFlip::GetGeometryUsed() const
{
  return static_cast<int>(this->GetReport().GeometryUsed);
}

const char* vtkDelaunayFlip::GetGeometryUsedAsString() const
{
  return ToString(this->GetReport().GeometryUsed);
}

const char* vtkDelaunayFlip::GetGeometryReason() const
{
  return this->GetReport().GeometryReason.c_str();
}

//------------------------------------------------------------------------------
FlipRequest vtkDelaunayFlip::MakeRequest(vtkPolyData* mesh, vtkPolyData* constraints)
{
  FlipRequest request;
  this->FillRequest(request);
  request.Input = mesh;
  request.Others = constraints;
  request.Settings.LinesAsConstraints = this->LinesAsConstraints;
  request.Settings.InsertLines = this->InsertLines;
  request.Settings.InsertConstraints = this->InsertConstraints;
  request.Settings.Triangulate = this->Triangulate;
  request.Settings.RegionArray = this->RegionArray;
  request.Options.Geometry = static_cast<GeometryKind>(this->Geometry);
  request.Options.Criterion = static_cast<CriterionKind>(this->Criterion);
  request.Options.TieRule = static_cast<TieRuleKind>(this->TieRule);
  request.Options.Backend = static_cast<BackendKind>(this->Backend);
  request.Options.Tolerance = this->Tolerance;
  request.Options.FeatureAngle = this->FeatureAngle;
  request.Options.MaximumDeviation = this->MaximumDeviation;
  request.Options.MaximumIterations = this->MaximumIterations;
  request.Options.NumberOfThreads = this->NumberOfThreads;
  request.Options.Device = this->DeviceId;
  request.Options.Devices = ParseDevices(this->Devices);
  request.Options.NumberOfPieces = this->NumberOfPieces;
  request.Options.TrackQuality = this->TrackQuality;
  request.WantsFlipCounts = this->GenerateFlipCount;
  request.WantsAngles = this->GenerateQuality;
  return request;
}

void vtkDelaunayFlip::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  BlockMesh mesh(block, this->RegionArray);
  const auto edges = mesh.FindConstraints(constraints);
  const std::vector<Note> notes = mesh.ListNotes();
  summary.Warnings.insert(summary.Warnings.end(), notes.begin(), notes.end());
  if (!mesh.GetMesh())
  {
    mesh.Store(nullptr);
    return;
  }
  FlipRequest request = this->MakeRequest(mesh.GetMesh(), edges);
  request.IsLive = block.IsLive;
  vtkNew<vtkPolyData> flipped;
  this->Runs->Update(request, *this->Report, flipped);
  mesh.Store(flipped);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Geometry: " << this->Geometry << "\n";
  os << indent << "Criterion: " << this->Criterion << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TieRule: " << this->TieRule << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "MaximumDeviation: " << this->MaximumDeviation << "\n";
  os << indent << "RegionArray: " << this->RegionArray << "\n";
  os << indent << "LinesAsConstraints: " << this->LinesAsConstraints << "\n";
  os << indent << "InsertLines: " << this->InsertLines << "\n";
  os << indent << "InsertConstraints: " << this->InsertConstraints << "\n";
  os << indent << "Triangulate: " << this->Triangulate << "\n";
  os << indent << "Devices: " << this->Devices << "\n";
  os << indent << "NumberOfPieces: " << this->NumberOfPieces << "\n";
  os << indent << "TrackQuality: " << this->TrackQuality << "\n";
  os << indent << "GenerateFlipCount: " << this->GenerateFlipCount << "\n";
  os << indent << "GenerateQuality: " << this->GenerateQuality << "\n";
}
