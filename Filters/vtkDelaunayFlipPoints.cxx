// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDelaunayFlipPoints.h"

#include "DataArrays.h"
#include "DelaunayFlip.h"
#include "FlipError.h"
#include "MeshBlocks.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkAbstractTransform.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTransform.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace delaunayflip;

static_assert(
  static_cast<int>(RingRuleKind::Orientation) == vtkDelaunayFlipPoints::RING_RULE_ORIENTATION, "");
static_assert(static_cast<int>(HeightsKind::Own) == vtkDelaunayFlipPoints::SEGMENT_HEIGHTS_OWN, "");

vtkStandardNewMacro(vtkDelaunayFlipPoints);
vtkCxxSetObjectMacro(vtkDelaunayFlipPoints, Transform, vtkAbstractTransform);

//------------------------------------------------------------------------------
vtkDelaunayFlipPoints::vtkDelaunayFlipPoints()
{
  this->InputType = "vtkPointSet";
  this->SizeOfBlocks = vtkDataObject::POINT;
}

vtkDelaunayFlipPoints::~vtkDelaunayFlipPoints() { this->SetTransform(nullptr); }

vtkMTimeType vtkDelaunayFlipPoints::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Transform ? std::max(own, this->Transform->GetMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipPoints::WarnOfLatitudes(
  vtkPoints* degrees, const std::string& name, const std::string& where, UpdateSummary& summary)
{
  constexpr double Rounding = 1e-4; // more than that of pi / 2 in single precision
  vtkIdType count = 0, first = 0;
  for (vtkIdType i = degrees->GetNumberOfPoints() - 1; i >= 0; --i)
  {
    if (std::fabs(degrees->GetPoint(i)[1]) > 90.0 + Rounding)
    {
      ++count;
      first = i;
    }
  }
  if (count > 0)
  {
    summary.Warnings.push_back({ where,
      name + std::to_string(count) + (count == 1 ? " point" : " points") +
        " with a latitude beyond 90 degrees (first: " + std::to_string(first) +
        "); x is the longitude and y the latitude" });
  }
}

bool vtkDelaunayFlipPoints::KeepHeights(
  vtkPoints* degrees, const std::string& name, bool always, vtkPointData* data)
{
  if (!degrees)
  {
    return true;
  }
  vtkNew<vtkDoubleArray> heights;
  heights->SetName(name.c_str());
  heights->SetNumberOfTuples(degrees->GetNumberOfPoints());
  bool hasHeights = false;
  for (vtkIdType i = 0; i < degrees->GetNumberOfPoints(); ++i)
  {
    const double height = degrees->GetData()->GetComponent(i, 2);
    heights->SetValue(i, height);
    hasHeights = hasHeights || (std::isfinite(height) && height != 0.0);
  }
  if (data->HasArray(name.c_str()))
  {
    return !hasHeights;
  }
  if (hasHeights || always)
  {
    AddAttributes(data, data->AddArray(heights), 1 << vtkDataSetAttributes::SCALARS);
  }
  return true;
}

namespace
{
/// What the array of heights of longitudes and latitudes is called.
constexpr char HeightArray[] = "Height";
}

namespace
{
/// The rotation that takes the plane of the first points to that of x and y. Points that are not
/// finite do not matter.
vtkSmartPointer<vtkTransform> FitPlane(vtkPoints* points, vtkIdType count)
{
  vtkNew<vtkPoints> finite;
  finite->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* x = points->GetPoint(i);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      finite->InsertNextPoint(x);
    }
  }
  double origin[3], normal[3] = { 0.0, 0.0, 1.0 }, axis[3];
  vtkPlane::ComputeBestFittingPlane(finite, origin, normal);
  if (normal[2] < 0.0)
  {
    vtkMath::MultiplyScalar(normal, -1.0);
  }
  const double up[3] = { 0.0, 0.0, 1.0 };
  vtkMath::Cross(normal, up, axis);
  auto rotation = vtkSmartPointer<vtkTransform>::New();
  rotation->RotateWXYZ(
    vtkMath::DegreesFromRadians(std::atan2(vtkMath::Norm(axis), normal[2])), axis);
  return rotation;
}
}

vtkSmartPointer<vtkAbstractTransform> delaunayflip::FindProjection(
  const TriangulationRequest& request, vtkPoints* points, vtkIdType count)
{
  if (!request.Transform && request.FitsPlane)
  {
    return FitPlane(points, count);
  }
  return request.Transform;
}

bool vtkDelaunayFlipPoints::IsOnSphere() const
{
  return this->Projection == PROJECTION_SPHERE || this->Projection == PROJECTION_OPEN_SPHERE;
}

vtkSmartPointer<vtkPolyData> vtkDelaunayFlipPoints::ReadPoints(
  vtkPointSet* input, const MeshBlock& block, UpdateSummary& summary) const
{
  if (this->Degrees && !this->IsOnSphere())
  {
    summary.Warnings.push_back(
      { block.Name, "Degrees has no effect, because the projection is not a sphere" });
  }
  auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(input->GetPoints());
  if (this->HasAngles() && input->GetPoints())
  {
    WarnOfLatitudes(input->GetPoints(), "", block.Name, summary);
    points->SetPoints(PlacePoints(input->GetPoints()));
  }
  points->GetPointData()->ShallowCopy(input->GetPointData());
  points->GetFieldData()->ShallowCopy(input->GetFieldData());
  DropResults(points->GetFieldData());
  auto* mesh = vtkPolyData::SafeDownCast(input);
  if (this->LinesAsSegments && mesh)
  {
    points->SetVerts(mesh->GetVerts()); // so that lines have their cell ids
    points->SetLines(mesh->GetLines());
  }
  return points;
}

vtkSmartPointer<vtkPolyData> vtkDelaunayFlipPoints::FindSegments(const MeshBlock& block,
  const std::vector<MeshBlock>& segments, const std::string& heights, UpdateSummary& summary) const
{
  const auto found = ListOthers(block, segments, "the segments of a single dataset");
  if (found.size() > 1)
  {
    throw InvalidOptions("the segments are in several partitions; join them first, by "
                         "vtkAppendPolyData, or Merge Blocks in ParaView");
  }
  vtkSmartPointer<vtkPolyData> given;
  if (!found.empty())
  {
    given = vtkPolyData::SafeDownCast(found.front().Data);
  }
  if (!this->HasAngles() || !given || !given->GetPoints())
  {
    return given;
  }
  WarnOfLatitudes(given->GetPoints(), "segments: ", block.Name, summary);
  auto placed = vtkSmartPointer<vtkPolyData>::New();
  placed->ShallowCopy(given);
  placed->SetPoints(PlacePoints(given->GetPoints()));
  if (!heights.empty())
  {
    const bool areOwn = this->SegmentHeights == SEGMENT_HEIGHTS_OWN;
    if (!KeepHeights(given->GetPoints(), heights, areOwn, placed->GetPointData()))
    {
      summary.Warnings.push_back(
        { block.Name, "segments: z left out, because they have an array \"" + heights + '"' });
    }
  }
  return placed;
}

template <typename Visit>
void vtkDelaunayFlipPoints::ForEachOption(const Visit& visit) const
{
  visit("Alpha", this->Alpha, &PointOptions::Alpha);
  visit("LongestEdge", this->LongestEdge, &PointOptions::LongestEdge);
  visit("PointTolerance", this->PointTolerance, &PointOptions::PointTolerance);
  visit("SplitCrossings", this->SplitCrossings, &PointOptions::SplitCrossings);
  visit("RingRule", this->RingRule, &PointOptions::RingRule);
}

TriangulationRequest vtkDelaunayFlipPoints::MakeRequest(vtkPointSet* input)
{
  TriangulationRequest request;
  this->ForEachOption(SetterOf(request.Options));
  this->FillRequest(request, request.Options);
  request.InputTime = input->GetMTime();
  request.Transform = this->Transform;
  if (this->Transform)
  {
    request.TransformTime = this->Transform->GetMTime();
  }
  request.FitsPlane = this->Projection == PROJECTION_BEST_FITTING_PLANE;
  request.LinesAsSegments = this->LinesAsSegments;
  request.ClosedLinesAsRings = this->ClosedLinesAsRings;
  request.PassesSegments = this->PassSegments;
  request.FirstHole = this->FirstHole;
  request.Heights = static_cast<HeightsKind>(this->SegmentHeights);
  request.SizeArray = this->SizeArray;
  request.Regions = this->Regions;
  if (this->Projection == PROJECTION_SPHERE)
  {
    request.Options.Projection = ProjectionKind::Sphere;
  }
  else if (this->Projection == PROJECTION_OPEN_SPHERE)
  {
    request.Options.Projection = ProjectionKind::OpenSphere;
  }
  return request;
}

bool TriangulationRequest::IsRefined() const
{
  const PointOptions& options = this->Options;
  return options.MinimumAngle + options.MaximumArea + options.MaximumEdge > 0.0 ||
    !this->SizeArray.empty() || !this->Regions.empty();
}

bool TriangulationRequest::IsPlain() const
{
  const PointOptions& options = this->Options;
  const bool hasSegments = this->Others || this->Input->GetNumberOfLines() > 0;
  const bool addsPoints = this->IsRefined() || (options.SplitCrossings && hasSegments);
  const bool leavesOut =
    options.PointTolerance > 0.0 || options.Alpha > 0.0 || options.LongestEdge > 0.0;
  return !addsPoints && !leavesOut && options.MaximumIterations < 0 &&
    options.Projection == ProjectionKind::Plane;
}

void vtkDelaunayFlipPoints::HandleDefects()
{
  if (this->Handler)
  {
    std::vector<Defect>& defects = this->Report->Defects;
    defects.erase(std::remove_if(defects.begin(), defects.end(), this->Handler), defects.end());
  }
}

/// Whether later updates may have the same points at other places.
bool vtkDelaunayFlipPoints::WantsToKeep()
{
  using Asked = vtkStreamingDemandDrivenPipeline;
  // An observer may have removed the input, and VTK has an error for a connection that is not
  // there.
  const bool hasInput = this->GetNumberOfInputConnections(0) > 0;
  vtkInformation* info = hasInput ? this->GetInputInformation(0, 0) : nullptr;
  const bool hasTimes =
    info && info->Has(Asked::TIME_STEPS()) && info->Length(Asked::TIME_STEPS()) > 1;
  return this->KeepSession == KEEP_SESSION_ON ||
    (this->KeepSession == KEEP_SESSION_AUTO && hasTimes);
}

void vtkDelaunayFlipPoints::FlipLeaves(
  MeshBlock& block, const std::vector<MeshBlock>& segments, UpdateSummary& summary)
{
  if (block.Leaves.size() > 1)
  {
    throw InvalidMesh("the points are in several partitions; join them first, by "
                      "vtkAppendDataSets, or Merge Blocks in ParaView",
      -1, -1);
  }
  BlockLeaf& leaf = block.Leaves.front();
  const auto output = vtkSmartPointer<vtkPolyData>::New();
  leaf.Result = output;
  auto* given = vtkPointSet::SafeDownCast(leaf.Data);
  if (!given)
  {
    leaf.Result = Hold(leaf.Data);
    summary.Warnings.push_back({ block.Name, "has no points of its own, passed unchanged" });
    return;
  }
  using Asked = vtkStreamingDemandDrivenPipeline;
  if (this->GetOutputInformation(0)->Get(Asked::UPDATE_PIECE_NUMBER()) > 0) // the first has all
  {
    return;
  }
  TriangulationRequest request = this->MakeRequest(given);
  const auto points = this->ReadPoints(given, block, summary);
  std::string heights = HeightArray;
  if (this->HasAngles() && !KeepHeights(given->GetPoints(), heights, false, points->GetPointData()))
  {
    summary.Warnings.push_back(
      { block.Name, "z left out, because the points have an array \"" + heights + "\"" });
    heights.clear();
  }
  const auto others = this->FindSegments(block, segments, heights, summary);
  request.Input = points;
  request.IsLive = block.IsLive;
  // Segments that all blocks share make no mesh of their own in an empty one.
  const bool isEmptyBlock = !block.Place.empty() && given->GetNumberOfPoints() == 0;
  if (!isEmptyBlock)
  {
    request.Others = others;
  }
  if (this->SegmentHeights == SEGMENT_HEIGHTS_AUTO && this->HasAngles())
  {
    request.HeightArray = heights;
  }
  request.KeepsRun = block.Place.empty() && request.IsPlain() && this->WantsToKeep();
  this->Runs->Update(request, *this->Report, output);
  this->HandleDefects();
  output->SetVerts(nullptr);
  const bool areLinesGiven = output->GetLines() == points->GetLines(); // after an abort
  if (areLinesGiven)
  {
    output->SetLines(nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkDelaunayFlipPoints::AddRegion(double x, double y, double label, double maximumArea)
{
  this->Regions.push_back({ x, y, label, maximumArea });
  this->Modified();
}

void vtkDelaunayFlipPoints::RemoveAllRegions()
{
  if (!this->Regions.empty())
  {
    this->Regions.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkDelaunayFlipPoints::GetNumberOfSegmentEdges() const
{
  return this->GetReport().FromPoints.SegmentEdges;
}

vtkIdType vtkDelaunayFlipPoints::GetNumberOfRefusedSegments() const
{
  return this->GetReport().FromPoints.RefusedSegments;
}

void vtkDelaunayFlipPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Projection: " << this->Projection << "\n";
  os << indent << "Degrees: " << this->Degrees << "\n";
  os << indent << "Transform: " << this->Transform << "\n";
  this->ForEachOption([&](const char* name, const auto& value, auto)
    { os << indent << name << ": " << value << "\n"; });
  os << indent << "Regions: " << this->Regions.size() << "\n";
  os << indent << "FirstHole: " << this->FirstHole << "\n";
  os << indent << "SegmentHeights: " << this->SegmentHeights << "\n";
  os << indent << "LinesAsSegments: " << this->LinesAsSegments << "\n";
  os << indent << "ClosedLinesAsRings: " << this->ClosedLinesAsRings << "\n";
  os << indent << "PassSegments: " << this->PassSegments << "\n";
  os << indent << "KeepSession: " << this->KeepSession << "\n";
}
