// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipRun.h"

#include "DataArrays.h"
#include "UpdateReport.h"

#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace delaunayflip
{
namespace
{

Stamps StampPoints(vtkPolyData* mesh)
{
  Stamps stamps;
  stamps.AddPoints(mesh);
  return stamps;
}

UpdatePlan MakePlan(const FlipRequest& request, bool isWarm)
{
  vtkPolyData* mesh = request.Input;
  const bool hasPolygons = mesh->GetNumberOfStrips() > 0 ||
    mesh->GetPolys()->GetNumberOfConnectivityIds() != 3 * mesh->GetNumberOfPolys();
  const bool hasConstraints =
    request.Constraints || (request.Settings.LinesAsConstraints && mesh->GetNumberOfLines() > 0);
  return { { isWarm, hasPolygons, hasConstraints, !request.Settings.RegionArray.empty(), true, true,
             request.WantsAngles },
    request.Progress };
}

}

vtkSmartPointer<vtkPolyData> CopyPoints(vtkPolyData* input)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->ShallowCopy(input);
  if (vtkPoints* points = input->GetPoints())
  {
    vtkNew<vtkPoints> copy;
    copy->SetDataType(points->GetDataType()); // to which DeepCopy rounds
    copy->DeepCopy(points);
    mesh->SetPoints(copy);
  }
  return mesh;
}

//------------------------------------------------------------------------------
void Stamps::AddArray(vtkAbstractArray* array, vtkObject* owner, vtkMTimeType since)
{
  this->All.push_back({ array, owner, 0, array ? array->GetNumberOfValues() : 0 });
  this->All.back().Time = std::max(since, this->All.back().FindTime());
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

void Stamps::AddArrays(vtkFieldData* data)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    this->AddArray(data->GetAbstractArray(i));
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
  return std::max(
    this->Array ? this->Array->GetMTime() : 0, this->Owner ? this->Owner->GetMTime() : 0);
}

/// Values are compared only if they are in different memory and nobody has changed them since.
bool Stamps::Stamp::Fits(const Stamp& now) const
{
  vtkAbstractArray* a = this->Array;
  vtkAbstractArray* b = now.Array;
  if (this->Count == now.Count && this->Time == now.Time)
  {
    return true;
  }
  if (!a || !b || a == b || a->GetNumberOfValues() != now.Count || this->Count != now.Count ||
    this->FindTime() > this->Time || a->GetDataType() != b->GetDataType() ||
    a->GetNumberOfComponents() != b->GetNumberOfComponents() || GetName(a) != GetName(b))
  {
    return false;
  }
  if (auto* texts = vtkStringArray::SafeDownCast(a))
  {
    const auto* first = texts->GetPointer(0);
    return std::equal(first, first + now.Count, vtkStringArray::SafeDownCast(b)->GetPointer(0));
  }
  const auto size = static_cast<std::size_t>(a->GetDataTypeSize()); // 0: of bits
  return size > 0 && vtkDataArray::SafeDownCast(a) && a->HasStandardMemoryLayout() &&
    b->HasStandardMemoryLayout() &&
    (now.Count == 0 ||
      (a->GetVoidPointer(0) != b->GetVoidPointer(0) &&
        std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0), size * now.Count) == 0));
}

//------------------------------------------------------------------------------
FlipRun::FlipRun(const FlipRequest& request, UpdatePlan plan)
  : UpdateRun(std::move(plan)),
    Asked(request),
    Edges(StampEdges(request)),
    Points(StampPoints(request.Input)),
    Current(ShareMesh(request.Input)),
    Constraints(request.Constraints ? ShareMesh(request.Constraints) : nullptr),
    Origin(request.IsLive ? CopyPoints(Current) : Current),
    Bridge(Origin, Constraints, request.Settings, this->Plan)
{
}

/// Attributes matter only as region labels and ghosts, and verts only by their number.
Stamps FlipRun::StampEdges(const FlipRequest& request)
{
  Stamps stamps;
  stamps.AddNumber(request.Input->GetNumberOfPoints());
  stamps.AddNumber(request.Input->GetNumberOfVerts());
  stamps.AddCells(request.Input->GetPolys());
  stamps.AddCells(request.Input->GetStrips());
  stamps.AddCells(request.Input->GetLines());
  vtkCellData* data = request.Input->GetCellData();
  stamps.AddArray(data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()));
  stamps.AddArray(data->GetAbstractArray(request.Settings.RegionArray.c_str()));
  if (request.Constraints)
  {
    stamps.AddCells(request.Constraints->GetPolys());
    stamps.AddCells(request.Constraints->GetLines());
    if (request.Constraints->GetPoints() != request.Input->GetPoints())
    {
      stamps.AddPoints(request.Constraints);
    }
  }
  return stamps;
}

//------------------------------------------------------------------------------
void FlipRun::OpenSession(Start start)
{
  this->Begin = std::move(start);
  FlipOptions options = this->Asked.Options;
  // A warm start finds no feature edges of its own: its fixed edges include them.
  options.FeatureAngle = this->IsWarm() ? 180.0 : options.FeatureAngle;
  this->Room = this->Asked.IsLive ? nullptr : this->Bridge.MakeRoom();
  try
  {
    this->Session = std::make_unique<FlipSession>(
      this->GetMesh(this->Begin), options, this->GetProgress(), ListMemory(this->Room));
  }
  catch (const InvalidMesh&)
  {
    this->Bridge.RequireValidIds(); // its error names the cell, not the triangle
    throw;
  }
}

TriangleMesh FlipRun::GetMesh(const Start& start) const
{
  TriangleMesh mesh = this->Bridge.GetMesh();
  if (!start.Triangles.empty())
  {
    mesh.Triangles = TriangleArray(start.Triangles.data(), mesh.Triangles.Count);
    mesh.ConstraintEdges = start.FixedEdges.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(start.FixedEdges.size()) / 2;
    mesh.ConstraintsToInsert = nullptr;
  }
  return mesh;
}

bool FlipRun::ContinueOrStart(std::unique_ptr<UpdateRun>& run, const FlipRequest& request)
{
  auto* last = static_cast<FlipRun*>(run.get());
  const bool fits = last && last->Asked.Options == request.Options &&
    last->Asked.Settings == request.Settings && last->Edges.Fit(StampEdges(request));
  if (fits && last->Points.Fit(StampPoints(request.Input)))
  {
    last->Current = ShareMesh(request.Input);
    last->Asked = request;
    return true;
  }
  UpdatePlan plan = MakePlan(request, fits);
  Start start;
  if (fits)
  {
    start = last->GetEnd(plan.For(UpdatePlan::FixedEdges));
  }
  else
  {
    run.reset(); // its memory may be needed
  }
  std::unique_ptr<FlipRun> made(new FlipRun(request, std::move(plan)));
  // A warm start keeps its geometry, since a surface has feature edges that a plane does not have.
  // So Auto must choose this geometry both for the triangles that flips have made and, as it does
  // without LiveUpdate, for those of the input.
  const auto keepsGeometry = [&](const Start& begin)
  { return FindGeometry(made->GetMesh(begin), request.Options) == start.Geometry; };
  if (fits && (!keepsGeometry(Start()) || !keepsGeometry(start)))
  {
    start = Start();
  }
  run.reset(); // its memory may be needed
  made->OpenSession(std::move(start));
  run = std::move(made);
  return false;
}

FlipRun::Start FlipRun::GetEnd(const ProgressObserver& progress) const
{
  const TriangleMesh mesh = this->Bridge.GetMesh();
  Start start;
  start.Report = this->GetReport();
  start.Geometry = this->IsWarm() ? this->Begin.Geometry : start.Report.GeometryUsed;
  start.Triangles.resize(3 * mesh.Triangles.Count);
  this->Session->StoreTriangles(MutableTriangleArray(start.Triangles.data(), mesh.Triangles.Count));
  start.FixedEdges =
    this->IsWarm() ? this->Begin.FixedEdges : FindFixedEdges(mesh, this->Asked.Options, progress);
  return start;
}

//------------------------------------------------------------------------------
FlipReport FlipRun::GetReport() const
{
  FlipReport report = this->Session->GetReport();
  if (this->IsWarm())
  {
    const FlipReport& first = this->Begin.Report;
    report.Edges.Constraint = first.Edges.Constraint;
    report.UnmatchedConstraints = first.UnmatchedConstraints;
    report.InsertedConstraints = first.InsertedConstraints;
    report.ConstraintFlips = first.ConstraintFlips;
  }
  else if (const std::int64_t count = this->Bridge.GetConstraints().Unmatched)
  {
    report.UnmatchedConstraints += count;
    const std::string& stranger = this->Bridge.GetConstraints().FirstStranger;
    report.Defects.push_back({ "constraint edges of the second input that the mesh does not have" +
        (stranger.empty()
            ? ""
            : ": ends are not points of the mesh (coordinates must be equal, not just "
              "close), first " +
              stranger),
      count, {}, DefectIds::Points });
  }
  this->Bridge.NumberCells(report.Defects);
  if (this->Bridge.GetSlots().NoTriangles.Count > 0)
  {
    report.Defects.push_back(this->Bridge.GetSlots().NoTriangles);
  }
  const auto malformed = ListMalformedArrays(this->Current, true, this->Bridge.GetSlots().InPlace);
  report.Defects.insert(report.Defects.end(), malformed.begin(), malformed.end());
  return report;
}

bool FlipRun::Store(vtkPolyData* output) const
{
  this->Bridge.Store(
    *this->Session, this->Room ? this->Room : this->Bridge.MakeRoom(), this->Current, output);
  if (this->Asked.WantsFlipCounts)
  {
    this->Bridge.StoreFlipCounts(*this->Session, output);
  }
  try
  {
    if (this->Asked.WantsAngles)
    {
      this->Bridge.StoreAngles(*this->Session, this->Asked.Options.NumberOfThreads,
        this->Plan.For(UpdatePlan::Angles), output);
    }
    return true;
  }
  catch (const RunAborted&)
  {
    return false;
  }
}

}
