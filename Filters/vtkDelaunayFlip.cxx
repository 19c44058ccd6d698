// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlip.h"

#include "CudaDevice.h"
#include "DelaunayFlip.h"
#include "FlipRun.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"

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

vtkIdType vtkDelaunayFlip::GetNumberOfUnmatchedConstraintEdges() const
{
  return this->GetReport().UnmatchedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfInsertedConstraintEdges() const
{
  return this->GetReport().InsertedConstraints;
}

vtkIdType vtkDelaunayFlip::GetNumberOfConstraintFlips() const
{
  return this->GetReport().ConstraintFlips;
}

vtkIdType vtkDelaunayFlip::GetNumberOfEdgesBlockedByShape() const
{
  return this->GetReport().BlockedByShape;
}

vtkIdType vtkDelaunayFlip::GetNumberOfEdgesBlockedByDeviation() const
{
  return this->GetReport().BlockedByDeviation;
}

vtkIdType vtkDelaunayFlip::GetNumberOfEdgesBlockedByEdge() const
{
  return this->GetReport().BlockedByEdge;
}

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
FlipRequest vtkDelaunayFlip::MakeRequest(vtkPolyData* mesh, vtkPolyData* constraints, bool isLive)
{
  FlipOptions options;
  options.Geometry = static_cast<GeometryKind>(this->Geometry);
  options.Criterion = static_cast<CriterionKind>(this->Criterion);
  options.TieRule = static_cast<TieRuleKind>(this->TieRule);
  options.Backend = static_cast<BackendKind>(this->Backend);
  options.Tolerance = this->Tolerance;
  options.FeatureAngle = this->FeatureAngle;
  options.MaximumDeviation = this->MaximumDeviation;
  options.MaximumIterations = this->MaximumIterations;
  options.NumberOfThreads = this->NumberOfThreads;
  options.Device = this->DeviceId;
  options.Devices = ParseDevices(this->Devices);
  options.NumberOfPieces = this->NumberOfPieces;
  options.TrackQuality = this->TrackQuality;
  return { mesh, constraints,
    { { this->LinesAsConstraints, this->InsertLines, this->InsertConstraints }, this->Triangulate,
      this->RegionArray },
    options, isLive, this->GenerateFlipCount, this->GenerateQuality, this->MakeProgress() };
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
  vtkNew<vtkPolyData> flipped;
  this->FlipMesh(mesh.GetMesh(), edges, block.IsLive, flipped);
  mesh.Store(flipped);
}

bool vtkDelaunayFlip::ContinueOrStart(
  std::unique_ptr<UpdateRun>& run, vtkPolyData* mesh, vtkPolyData* constraints, bool isLive)
{
  return FlipRun::ContinueOrStart(run, this->MakeRequest(mesh, constraints, isLive));
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
