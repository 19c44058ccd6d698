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

/// How the progress of an update is divided: up to SplitShare polygons are split, if there are any;
/// up to SessionEnd the session works; the rest is for the output.
constexpr double SplitShare = 0.3;
constexpr double SessionEnd = 0.95;

/// An observer of a part of the work that begins and ends at these shares of the whole.
ProgressObserver Scale(const ProgressObserver& progress, double begin, double end)
{
  if (!progress)
  {
    return {};
  }
  return [=](double share) { return progress(begin + (end - begin) * share); };
}

bool IsSame(const PolyDataBridge::Settings& a, const PolyDataBridge::Settings& b)
{
  return a.Triangulate == b.Triangulate && a.LinesAsConstraints == b.LinesAsConstraints &&
    a.InsertLines == b.InsertLines && a.InsertConstraints == b.InsertConstraints &&
    a.RegionArray == b.RegionArray;
}

vtkSmartPointer<vtkPolyData> ShareMesh(vtkPolyData* input)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->ShallowCopy(input);
  return mesh;
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
FlipRun::Snapshot::Snapshot(
  const Request& request, bool copyPoints, const ProgressObserver& progress)
  : Mesh(TakeMesh(request.Input, copyPoints)),
    Constraints(request.Constraints ? ShareMesh(request.Constraints) : nullptr),
    Edges(StampEdges(request)),
    Points(StampPoints(request.Input)),
    Time(request.Input->GetMTime()),
    Bridge(Mesh, Constraints, request.Settings, progress)
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
  : FlipRun(request, Start())
{
}

FlipRun::FlipRun(const Request& request, Start start)
  : Settings(request.Settings),
    Options(request.Options),
    Current(std::make_shared<Snapshot>(request, false, Scale(request.Progress, 0.0, SplitShare))),
    Origin(request.IsLive ? std::make_shared<Snapshot>(Current->Repeat(request), true,
                              Scale(request.Progress, SplitShare, SplitShare))
                          : Current),
    Begin(std::move(start)),
    Session(this->MakeSession(this->IsWarm() ? nullptr : request.Progress)),
    Stopped(this->Session.GetReport().StopReason == StopReasonKind::Aborted)
{
}

/// A warm start is built even if the observer asks to stop, because only this update knows its
/// start.
FlipSession FlipRun::MakeSession(const ProgressObserver& progress) const
{
  try
  {
    return FlipSession(
      this->GetStartMesh(), this->GetStartOptions(), this->ScaleProgress(progress));
  }
  catch (const InvalidMesh&)
  {
    this->Origin->Bridge.RequireValidIds(); // its error names the cell, not the triangle
    throw;
  }
}

TriangleMesh FlipRun::GetStartMesh() const
{
  TriangleMesh mesh = this->Origin->Bridge.GetMesh();
  if (this->IsWarm())
  {
    mesh.Triangles = TriangleArray(this->Begin.Triangles.data(), mesh.Triangles.Count);
    mesh.ConstraintEdges = this->Begin.FixedEdges.data();
    mesh.NumberOfConstraintEdges = static_cast<std::int64_t>(this->Begin.FixedEdges.size()) / 2;
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

ProgressObserver FlipRun::ScaleProgress(const ProgressObserver& progress) const
{
  return Scale(progress, this->Origin->Bridge.HasSplit() ? SplitShare : 0.0, SessionEnd);
}

//------------------------------------------------------------------------------
std::unique_ptr<FlipRun> FlipRun::GoOn(std::unique_ptr<FlipRun> last, const Request& request)
{
  if (last && last->Fits(request))
  {
    if (last->Current->Points != StampPoints(request.Input))
    {
      return StartWarmly(std::move(last), request);
    }
    if (last->Current->Time != request.Input->GetMTime())
    {
      last->Current = std::make_shared<Snapshot>(request, false);
    }
    last->Stopped = false;
    return last;
  }
  last.reset(); // its memory may be needed
  return std::unique_ptr<FlipRun>(new FlipRun(request));
}

bool FlipRun::Fits(const Request& request) const
{
  return this->Options == request.Options && IsSame(this->Settings, request.Settings) &&
    this->Current->Edges == StampEdges(request);
}

std::unique_ptr<FlipRun> FlipRun::StartWarmly(std::unique_ptr<FlipRun> last, const Request& request)
{
  const GeometryKind geometry = last->Session.GetReport().GeometryUsed;
  Start start = last->GetEnd();
  last.reset();
  std::unique_ptr<FlipRun> run(new FlipRun(request, std::move(start)));
  if (!run->GoesBy(geometry))
  {
    run.reset();
    run.reset(new FlipRun(request));
  }
  return run;
}

/// A warm start keeps its geometry, since a surface has feature edges that a plane does not have.
/// So Auto must choose this geometry both for the triangles that flips have made and, as it does
/// without LiveUpdate, for those of the input.
bool FlipRun::GoesBy(GeometryKind geometry) const
{
  return this->Session.GetReport().GeometryUsed == geometry &&
    FindGeometry(this->Origin->Bridge.GetMesh(), this->Options) == geometry;
}

FlipRun::Start FlipRun::GetEnd() const
{
  const TriangleMesh mesh = this->Origin->Bridge.GetMesh();
  Start start;
  start.Triangles.resize(3 * mesh.Triangles.Count);
  this->Session.StoreTriangles(MutableTriangleArray(start.Triangles.data(), mesh.Triangles.Count));
  start.FixedEdges = this->IsWarm() ? this->Begin.FixedEdges : FindFixedEdges(mesh, this->Options);
  const FlipReport report = this->GetReport();
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
  this->Current->Bridge.NumberCells(report.Defects);
  this->Current->Bridge.AddDefects(report.Defects);
  return report;
}

void FlipRun::AddUnmatchedConstraints(FlipReport& report) const
{
  const std::int64_t count = this->Origin->Bridge.GetNumberOfUnmatchedConstraints();
  report.UnmatchedConstraints += count;
  if (count > 0)
  {
    report.Defects.push_back({ "constraint edges of the second input that the mesh does not have",
      count, {}, DefectIds::Points });
  }
}

void FlipRun::Store(vtkPolyData* output, const Extras& extras) const
{
  this->Current->Bridge.Store(this->Session, output);
  if (extras.FlipCounts)
  {
    this->Current->Bridge.StoreFlipCounts(this->Session, output);
  }
  if (extras.Angles)
  {
    this->Current->Bridge.StoreAngles(this->Session, this->Options.NumberOfThreads, output);
  }
}

}
