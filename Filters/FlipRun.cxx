// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipRun.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <utility>

namespace delaunayflip
{
namespace
{

void Stamp(vtkObject* object, std::vector<vtkMTimeType>& stamps)
{
  stamps.push_back(object ? object->GetMTime() : 0);
}

/// Cells grow in place without being marked as modified: how many values, and where.
void StampPlace(vtkDataArray* array, std::vector<vtkMTimeType>& stamps)
{
  Stamp(array, stamps);
  const void* place = array->HasStandardMemoryLayout() ? array->GetVoidPointer(0) : nullptr;
  stamps.push_back(static_cast<vtkMTimeType>(array->GetNumberOfValues()));
  stamps.push_back(static_cast<vtkMTimeType>(reinterpret_cast<std::uintptr_t>(place)));
}

void Stamp(vtkCellArray* cells, std::vector<vtkMTimeType>& stamps)
{
  Stamp(static_cast<vtkObject*>(cells), stamps);
  StampPlace(cells->GetOffsetsArray(), stamps);
  StampPlace(cells->GetConnectivityArray(), stamps);
}

void StampCoordinates(vtkPolyData* mesh, std::vector<vtkMTimeType>& stamps)
{
  Stamp(mesh->GetPoints(), stamps);
  if (mesh->GetPoints())
  {
    StampPlace(mesh->GetPoints()->GetData(), stamps);
  }
}

bool IsSame(const PolyDataBridge::Settings& a, const PolyDataBridge::Settings& b)
{
  return a.Triangulate == b.Triangulate && a.LinesAsConstraints == b.LinesAsConstraints &&
    a.InsertLines == b.InsertLines && a.InsertConstraints == b.InsertConstraints &&
    a.RegionArray == b.RegionArray;
}

/// The input, with a copy of its points on request.
vtkSmartPointer<vtkPolyData> TakeMesh(vtkPolyData* input, bool copyPoints)
{
  const vtkSmartPointer<vtkPolyData> mesh = ShareMesh(input);
  if (copyPoints && input->GetPoints())
  {
    vtkPoints* points = input->GetPoints();
    // Not vtkPoints::DeepCopy, which rounds to the precision of the copy.
    auto data =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(points->GetDataType()));
    data->DeepCopy(points->GetData());
    vtkNew<vtkPoints> copy;
    copy->SetData(data);
    mesh->SetPoints(copy);
  }
  return mesh;
}

}

//------------------------------------------------------------------------------
FlipRun::Snapshot::Snapshot(const Request& request, bool copyPoints, const UpdatePlan& plan)
  : Mesh(TakeMesh(request.Input, copyPoints)),
    Constraints(request.Constraints ? ShareMesh(request.Constraints) : nullptr),
    Edges(StampEdges(request)),
    Points(StampPoints(request.Input)),
    Time(request.Input->GetMTime()),
    Bridge(Mesh, Constraints, request.Settings, plan)
{
}

FlipRun::Snapshots::Snapshots(const Request& request, const UpdatePlan& plan)
  : Current(std::make_shared<Snapshot>(request, false, plan)),
    Origin(
      request.IsLive ? std::make_shared<Snapshot>(Current->Repeat(request), true, plan) : Current)
{
}

/// For a second snapshot: observers may have emptied the inputs since this one.
FlipRun::Request FlipRun::Snapshot::Repeat(const Request& request) const
{
  Request same = request;
  same.Input = this->Mesh;
  same.Constraints = this->Constraints;
  return same;
}

/// Of the attributes only region labels and ghosts matter.
FlipRun::Stamps FlipRun::StampEdges(const Request& request)
{
  Stamps stamps{ static_cast<vtkMTimeType>(request.Input->GetNumberOfPoints()) };
  Stamp(request.Input->GetPolys(), stamps);
  Stamp(request.Input->GetStrips(), stamps);
  Stamp(request.Input->GetLines(), stamps);
  vtkCellData* data = request.Input->GetCellData();
  Stamp(data->GetAbstractArray(vtkDataSetAttributes::GhostArrayName()), stamps);
  Stamp(data->GetAbstractArray(request.Settings.RegionArray.c_str()), stamps);
  if (request.Constraints)
  {
    Stamp(request.Constraints->GetPolys(), stamps);
    Stamp(request.Constraints->GetLines(), stamps);
    if (request.Constraints->GetPoints() != request.Input->GetPoints())
    {
      StampCoordinates(request.Constraints, stamps);
    }
  }
  return stamps;
}

FlipRun::Stamps FlipRun::StampPoints(vtkPolyData* mesh)
{
  Stamps stamps;
  StampCoordinates(mesh, stamps);
  return stamps;
}

//------------------------------------------------------------------------------
FlipRun::FlipRun(const Request& request)
  : FlipRun(request, Snapshots(request, MakePlan(request, false)), Start())
{
}

FlipRun::FlipRun(const Request& request, Snapshots input, Start start)
  : Settings(request.Settings),
    Options(request.Options),
    Wanted(request.Wanted),
    Plan(MakePlan(request, !start.Triangles.empty())),
    Input(std::move(input)),
    Begin(std::move(start)),
    Session(this->MakeSession()),
    Stopped(this->Session.GetReport().StopReason == StopReasonKind::Aborted)
{
}

UpdatePlan FlipRun::MakePlan(const Request& request, bool isWarm)
{
  return { { request.Input, request.Constraints, request.Settings.LinesAsConstraints,
             !request.Settings.RegionArray.empty(), isWarm, request.Wanted.Angles },
    request.Progress };
}

FlipSession FlipRun::MakeSession() const
{
  try
  {
    return FlipSession(
      GetMesh(this->Input, this->Begin), this->GetStartOptions(), this->GetProgress());
  }
  catch (const InvalidMesh&)
  {
    this->Input.Origin->Bridge.RequireValidIds(); // its error names the cell, not the triangle
    throw;
  }
}

TriangleMesh FlipRun::GetMesh(const Snapshots& input, const Start& start)
{
  TriangleMesh mesh = input.Origin->Bridge.GetMesh();
  if (!start.Triangles.empty())
  {
    mesh.Triangles = TriangleArray(start.Triangles.data(), mesh.Triangles.Count);
    mesh.ConstraintEdges = start.FixedEdges.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(start.FixedEdges.size()) / 2;
    mesh.ConstraintsToInsert = nullptr;
  }
  return mesh;
}

/// A warm start finds no feature edges of its own: its fixed edges include them.
FlipOptions FlipRun::GetStartOptions() const
{
  FlipOptions options = this->Options;
  options.FeatureAngle = this->IsWarm() ? 180.0 : options.FeatureAngle;
  return options;
}

//------------------------------------------------------------------------------
bool FlipRun::ContinueOrStart(std::unique_ptr<FlipRun>& run, const Request& request)
{
  if (!run || !run->Fits(request))
  {
    run.reset(); // its memory may be needed
    run.reset(new FlipRun(request));
    return false;
  }
  if (run->Input.Current->Points != StampPoints(request.Input))
  {
    WarmStart(run, request);
    return false;
  }
  if (run->Input.Current->Time != request.Input->GetMTime())
  {
    run->Input.Current = std::make_shared<Snapshot>(request, false, MakePlan(request, false));
  }
  run->Wanted = request.Wanted;
  run->Stopped = false;
  return true;
}

bool FlipRun::Fits(const Request& request) const
{
  return this->Options == request.Options && IsSame(this->Settings, request.Settings) &&
    this->Input.Current->Edges == StampEdges(request);
}

/// A warm start keeps its geometry, since a surface has feature edges that a plane does not have.
/// So Auto must choose this geometry both for the triangles that flips have made and, as it does
/// without LiveUpdate, for those of the input.
void FlipRun::WarmStart(std::unique_ptr<FlipRun>& run, const Request& request)
{
  const UpdatePlan plan = MakePlan(request, true);
  Start start = run->GetEnd(plan.ForFixedEdges());
  Snapshots input(request, plan);
  const auto keepsGeometry = [&](const Start& begin)
  { return FindGeometry(GetMesh(input, begin), request.Options) == start.Geometry; };
  if (!keepsGeometry(Start()) || !keepsGeometry(start))
  {
    start = Start();
  }
  run.reset(); // its memory may be needed
  run.reset(new FlipRun(request, std::move(input), std::move(start)));
}

FlipRun::Start FlipRun::GetEnd(const ProgressObserver& progress) const
{
  const TriangleMesh mesh = this->Input.Origin->Bridge.GetMesh();
  const FlipReport report = this->GetReport();
  Start start;
  start.Geometry = this->IsWarm() ? this->Begin.Geometry : report.GeometryUsed;
  start.Triangles.resize(3 * mesh.Triangles.Count);
  this->Session.StoreTriangles(MutableTriangleArray(start.Triangles.data(), mesh.Triangles.Count));
  start.FixedEdges =
    this->IsWarm() ? this->Begin.FixedEdges : FindFixedEdges(mesh, this->Options, progress);
  start.Constraints = report.Edges.Constraint;
  start.UnmatchedConstraints = report.UnmatchedConstraints;
  start.InsertedConstraints = report.InsertedConstraints;
  start.ConstraintFlips = report.ConstraintFlips;
  return start;
}

//------------------------------------------------------------------------------
FlipReport FlipRun::GetReport() const
{
  FlipReport report = this->Session.GetReport();
  if (this->IsWarm())
  {
    report.Edges.Constraint = this->Begin.Constraints;
    report.UnmatchedConstraints = this->Begin.UnmatchedConstraints;
    report.InsertedConstraints = this->Begin.InsertedConstraints;
    report.ConstraintFlips = this->Begin.ConstraintFlips;
  }
  else
  {
    this->AddUnmatchedConstraints(report);
  }
  this->Input.Current->Bridge.NumberCells(report.Defects);
  this->Input.Current->Bridge.AddDefects(report.Defects);
  return report;
}

void FlipRun::AddUnmatchedConstraints(FlipReport& report) const
{
  const std::int64_t count = this->Input.Origin->Bridge.GetNumberOfUnmatchedConstraints();
  report.UnmatchedConstraints += count;
  if (count > 0)
  {
    report.Defects.push_back({ "constraint edges of the second input that the mesh does not have",
      count, {}, DefectIds::Points });
  }
}

bool FlipRun::Store(vtkPolyData* output) const
{
  const PolyDataBridge& bridge = this->Input.Current->Bridge;
  bridge.Store(this->Session, output);
  if (this->Wanted.FlipCounts)
  {
    bridge.StoreFlipCounts(this->Session, output);
  }
  try
  {
    if (this->Wanted.Angles)
    {
      bridge.StoreAngles(
        this->Session, this->Options.NumberOfThreads, this->Plan.ForOutput(), output);
    }
    return true;
  }
  catch (const RunAborted&)
  {
    return false;
  }
}

}
