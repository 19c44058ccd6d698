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

#include <algorithm>

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
void vtkDelaunayFlip::AddRegion(double x, double y, double label, double maximumArea)
{
  this->Regions.push_back({ x, y, label, maximumArea });
  this->Modified();
}

void vtkDelaunayFlip::RemoveAllRegions()
{
  if (!this->Regions.empty())
  {
    this->Regions.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
template <typename Visit>
void vtkDelaunayFlip::ForEachOption(const Visit& visit) const
{
  visit("Geometry", this->Geometry, &FlipOptions::Geometry);
  visit("Criterion", this->Criterion, &FlipOptions::Criterion);
  visit("Tolerance", this->Tolerance, &FlipOptions::Tolerance);
  visit("TieRule", this->TieRule, &FlipOptions::TieRule);
  visit("FeatureAngle", this->FeatureAngle, &FlipOptions::FeatureAngle);
  visit("MaximumDeviation", this->MaximumDeviation, &FlipOptions::MaximumDeviation);
  visit("NumberOfPieces", this->NumberOfPieces, &FlipOptions::NumberOfPieces);
  visit("TrackQuality", this->TrackQuality, &FlipOptions::TrackQuality);
}

FlipRequest vtkDelaunayFlip::MakeRequest(vtkPolyData* mesh, vtkPolyData* constraints)
{
  FlipRequest request;
  this->ForEachOption(SetterOf(request.Options));
  this->FillRequest(request, request.Options);
  request.Input = mesh;
  request.Others = constraints;
  request.Settings.LinesAsConstraints = this->LinesAsConstraints;
  request.Settings.InsertLines = this->InsertLines;
  request.Settings.InsertConstraints = this->InsertConstraints;
  request.Settings.Triangulate = this->Triangulate;
  request.Settings.RegionArray = this->RegionArray;
  request.Settings.SizeArray = this->SizeArray;
  request.Settings.RegionSeeds = this->Regions;
  const bool hasAreas = std::any_of(this->Regions.begin(), this->Regions.end(),
    [](const std::array<double, 4>& region) { return region[3] > 0.0; });
  const bool hasGoals =
    this->MinimumAngle > 0.0 || this->MaximumArea > 0.0 || this->MaximumEdge > 0.0 || hasAreas;
  request.Settings.Refines = hasGoals || !this->SizeArray.empty();
  if (!this->Devices.empty())
  {
    request.Options.Devices = ParseDevices(this->Devices);
  }
  request.WantsFlipCounts = this->GenerateFlipCount;
  request.WantsAngles = this->GenerateQuality;
  return request;
}

void vtkDelaunayFlip::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& constraints, UpdateSummary& summary)
{
  BlockMesh mesh(block, this->RegionArray);
  vtkSmartPointer<vtkPolyData> edges;
  if (!constraints.empty())
  {
    edges = mesh.FindConstraints(constraints);
  }
  const std::vector<Note> notes = mesh.ListNotes();
  summary.Warnings.insert(summary.Warnings.end(), notes.begin(), notes.end());
  if (!mesh.GetMesh())
  {
    mesh.Store(nullptr);
    return;
  }
  FlipRequest request = this->MakeRequest(mesh.GetMesh(), edges);
  const bool needsWhole = request.Settings.Refines || !this->Regions.empty();
  if (needsWhole && block.Leaves.size() > 1)
  {
    throw InvalidOptions(
      "a mesh in several partitions cannot be refined or have regions; join them "
      "first, by vtkAppendPolyData, or Merge Blocks in ParaView");
  }
  request.IsLive = block.IsLive;
  vtkNew<vtkPolyData> flipped;
  this->Runs->Update(request, *this->Report, flipped);
  mesh.Store(flipped);
}

//------------------------------------------------------------------------------
void vtkDelaunayFlip::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->ForEachOption([&](const char* name, const auto& value, auto)
    { os << indent << name << ": " << value << "\n"; });
  os << indent << "RegionArray: " << this->RegionArray << "\n";
  os << indent << "Regions: " << this->Regions.size() << "\n";
  os << indent << "LinesAsConstraints: " << this->LinesAsConstraints << "\n";
  os << indent << "InsertLines: " << this->InsertLines << "\n";
  os << indent << "InsertConstraints: " << this->InsertConstraints << "\n";
  os << indent << "Triangulate: " << this->Triangulate << "\n";
  os << indent << "Devices: " << this->Devices << "\n";
  os << indent << "GenerateFlipCount: " << this->GenerateFlipCount << "\n";
  os << indent << "GenerateQuality: " << this->GenerateQuality << "\n";
}
