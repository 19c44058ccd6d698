// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataArrays.h"
#include "UpdateReport.h"
#include "UpdateRequests.h"

#include "vtkPointData.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace delaunayflip
{
namespace
{

Stamps StampPoints(const FlipRequest& request)
{
  Stamps stamps;
  stamps.AddPoints(request.Input);
  return stamps;
}

/// Stamps everything, except points, that decides which edges exist and which are fixed. Attributes
/// matter only as region labels and ghosts, and verts only by their number.
Stamps StampEdges(const FlipRequest& request)
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
  const std::string& sizes = request.Settings.SizeArray;
  stamps.AddArray(request.Input->GetPointData()->GetAbstractArray(sizes.c_str()));
  if (request.Others)
  {
    stamps.AddCells(request.Others->GetPolys());
    stamps.AddCells(request.Others->GetLines());
    if (request.Others->GetPoints() != request.Input->GetPoints())
    {
      stamps.AddPoints(request.Others);
    }
  }
  return stamps;
}

UpdatePlan MakePlan(const FlipRequest& request, bool isWarm)
{
  vtkPolyData* mesh = request.Input;
  const bool hasPolygons = mesh->GetNumberOfStrips() > 0 ||
    mesh->GetPolys()->GetNumberOfConnectivityIds() != 3 * mesh->GetNumberOfPolys();
  const bool hasConstraints =
    request.Others || (request.Settings.LinesAsConstraints && mesh->GetNumberOfLines() > 0);
  return { { isWarm, hasPolygons, hasConstraints, !request.Settings.RegionArray.empty(), false,
             true, true, request.WantsAngles },
    request.Progress };
}

/// What has changed since the last update.
enum class InputChange
{
  Nothing,
  Points, ///< Nothing but these.
  Mesh
};

/// Where a warm start begins. It is empty for other runs.
struct RunStart
{
  GeometryKind Geometry = GeometryKind::Auto;
  std::vector<std::int64_t> Triangles; ///< Vertex ids, three per slot.
  std::vector<std::int64_t> FixedEdges; ///< Pairs of vertex ids.
  FlipReport Report; ///< What the last run did.
};

/// The run of a vtkDelaunayFlip.
class FlipRun : public UpdateRun
{
public:
  /// Reads the input. @param start is taken only if Auto chooses the same geometry there.
  FlipRun(const FlipRequest& request, UpdatePlan plan, RunStart start);

  void OpenSession() override;

  FlipReport GetReport() const override;
  bool Store(vtkPolyData* output) const override;
  const FlipSession* GetSessionToDraw() const override
  {
    return this->Bridge.IsRefined() ? nullptr : this->Session.get();
  }

  InputChange FindChange(const FlipRequest& request) const;

  /// Goes on with an input that has only other attributes.
  void Renew(const FlipRequest& request);

  /// Goes on with the triangles as they are now, and an input with points at other places.
  /// @returns false, and changes nothing, if another session has to begin there.
  /// @throws RunAborted.
  bool Follow(const FlipRequest& request, const UpdatePlan& plan);

  /// The triangles as they are now, for a warm start.
  /// @throws RunAborted.
  RunStart GetEnd(const ProgressObserver& progress) const;

private:
  /// Whether Auto chooses the geometry of a warm start both for the triangles that flips have made
  /// and, as it does without LiveUpdate, for those of the input. A surface has feature edges that a
  /// plane does not have, so the fixed edges are not right in another geometry.
  bool KeepsGeometry() const;
  TriangleMesh GetMesh(const RunStart& start) const;
  bool IsWarm() const { return !this->Begin.Triangles.empty(); }
  void AddUnmatchedConstraints(FlipReport& report) const;

  FlipRequest Asked; ///< Its meshes may be gone.
  Stamps Edges; ///< See StampEdges. Only a live run is compared with the next input.
  Stamps Points;
  vtkSmartPointer<vtkPolyData> Current; ///< The input as it was at the last update.
  vtkSmartPointer<vtkPolyData> Constraints; ///< Null without a second input.
  vtkSmartPointer<vtkPolyData> Origin; ///< With points that no later update moves.
  PolyDataBridge Bridge; ///< To the origin. The session has views of its arrays.
  RunStart Begin; ///< The session has views of its arrays, too.

  /// The points at which the session was opened, once it has followed others. They decide which
  /// edges are fixed.
  struct FirstPoints
  {
    vtkSmartPointer<vtkPolyData> Mesh;
    std::vector<double> Coordinates;
    PointArray Points;
  };
  FirstPoints First;
};

FlipRun::FlipRun(const FlipRequest& request, UpdatePlan plan, RunStart start)
  : UpdateRun(std::move(plan)),
    Asked(request),
    Edges(request.IsLive ? StampEdges(request) : Stamps()),
    Points(request.IsLive ? StampPoints(request) : Stamps()),
    Current(ShareMesh(request.Input)),
    Constraints(request.Others ? ShareMesh(request.Others) : nullptr),
    Origin(request.IsLive ? CopyPoints(Current) : Current),
    Bridge(Origin, Constraints, request.Settings, this->Plan),
    Begin(std::move(start))
{
  if (this->IsWarm() && !this->KeepsGeometry())
  {
    this->Begin = RunStart();
  }
}

InputChange FlipRun::FindChange(const FlipRequest& request) const
{
  const bool isSameMesh = this->Asked.Options == request.Options &&
    this->Asked.Settings == request.Settings && this->Edges.Fit(StampEdges(request));
  if (!isSameMesh)
  {
    return InputChange::Mesh;
  }
  if (!this->Points.Fit(StampPoints(request)))
  {
    return InputChange::Points;
  }
  return InputChange::Nothing;
}

void FlipRun::Renew(const FlipRequest& request)
{
  this->Current = ShareMesh(request.Input);
  this->Asked = request;
}

bool FlipRun::Follow(const FlipRequest& request, const UpdatePlan& plan)
{
  const auto origin = CopyPoints(request.Input);
  std::vector<double> coordinates;
  const PointArray points = ViewPoints(origin, coordinates);
  TriangleMesh mesh = this->Bridge.GetMesh();
  const PointArray before = mesh.Points;
  mesh.Points = points;
  const GeometryKind geometry = this->Session->GetReport().GeometryUsed;
  const bool isSameType = (points.Floats == nullptr) == (before.Floats == nullptr);
  if (!isSameType || FindGeometry(mesh, request.Options) != geometry)
  {
    return false;
  }
  constexpr std::int64_t Components = 3;
  PointMove move;
  move.Points = points.Floats ? PlaneArray(points.Floats, points.Count, Components)
                              : PlaneArray(points.Doubles, points.Count, Components);
  try
  {
    if (!this->Session->Move(move, plan.For(UpdatePlan::Session)))
    {
      throw RunAborted();
    }
  }
  catch (const InvalidOptions&)
  {
    return false;
  }
  this->Bridge.MovePoints(origin, points, coordinates);
  if (!this->First.Mesh)
  {
    this->First = { this->Origin, std::move(coordinates), before };
  }
  this->Origin = origin;
  this->Points = StampPoints(request);
  this->Plan = plan;
  this->Renew(request);
  return true;
}

//------------------------------------------------------------------------------
RunStart FlipRun::GetEnd(const ProgressObserver& progress) const
{
  TriangleMesh mesh = this->Bridge.GetMesh();
  if (this->First.Mesh)
  {
    mesh.Points = this->First.Points;
  }
  RunStart start;
  start.Report = this->GetReport();
  start.Triangles.resize(3 * mesh.Triangles.Count);
  this->Session->StoreTriangles(MutableTriangleArray(start.Triangles.data(), mesh.Triangles.Count));
  if (this->IsWarm())
  {
    start.Geometry = this->Begin.Geometry;
    start.FixedEdges = this->Begin.FixedEdges;
  }
  else
  {
    start.Geometry = start.Report.GeometryUsed;
    start.FixedEdges = FindFixedEdges(mesh, this->Asked.Options, progress);
  }
  return start;
}

bool FlipRun::KeepsGeometry() const
{
  const auto find = [this](const RunStart& start)
  { return FindGeometry(this->GetMesh(start), this->Asked.Options); };
  const GeometryKind geometry = this->Begin.Geometry;
  return find(RunStart()) == geometry && find(this->Begin) == geometry;
}

TriangleMesh FlipRun::GetMesh(const RunStart& start) const
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

void FlipRun::OpenSession()
{
  FlipOptions options = this->Asked.Options;
  TriangleMesh mesh = this->Bridge.GetMesh();
  if (this->IsWarm())
  {
    mesh = this->GetMesh(this->Begin);
    options.FeatureAngle = 180.0; // none: the fixed edges include the feature edges
  }
  std::vector<ResultMemory> expected;
  if (!this->Asked.IsLive)
  {
    this->Room = this->Bridge.MakeRoom();
    expected = ListMemory(this->Room);
  }
  try
  {
    this->Session = std::make_unique<FlipSession>(mesh, options, this->GetProgress(), expected);
  }
  catch (const InvalidMesh&)
  {
    this->Bridge.RequireValidIds(); // its error names the cell, not the triangle
    throw;
  }
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
  else if (this->Bridge.GetConstraints().Unmatched > 0)
  {
    this->AddUnmatchedConstraints(report);
  }
  const TriangleSlots& slots = this->Bridge.GetSlots();
  if (!report.Defects.empty())
  {
    this->Bridge.NumberCells(report.Defects);
  }
  if (slots.NoTriangles.Count > 0)
  {
    report.Defects.push_back(slots.NoTriangles);
  }
  const auto added = static_cast<std::int64_t>(this->Session->GetAddedPoints().size());
  report.Points += added;
  const auto malformed =
    ListMalformedArrays(this->Current, added == 0, slots.InPlace && !this->Bridge.IsRefined());
  report.Defects.insert(report.Defects.end(), malformed.begin(), malformed.end());
  return report;
}

void FlipRun::AddUnmatchedConstraints(FlipReport& report) const
{
  const ConstraintEdges& constraints = this->Bridge.GetConstraints();
  Defect missing(DefectKind::ConstraintsNotInMesh, constraints.Unmatched);
  if (!constraints.FirstStranger.empty())
  {
    missing.Detail =
      ": ends are not points of the mesh (coordinates must be equal, not just close), first " +
      constraints.FirstStranger;
  }
  report.UnmatchedConstraints += constraints.Unmatched;
  report.Defects.push_back(missing);
}

bool FlipRun::Store(vtkPolyData* output) const
{
  const auto room = this->Room ? this->Room : this->Bridge.MakeRoom();
  this->Bridge.Store(*this->Session, room, this->Current, output);
  if (!this->Asked.Settings.RegionSeeds.empty())
  {
    this->Bridge.StoreRegions(*this->Session, output);
  }
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

//------------------------------------------------------------------------------
bool FlipRequest::HasWork() const
{
  return this->Input->GetNumberOfPolys() > 0 || this->Input->GetNumberOfStrips() > 0;
}

bool FlipRequest::ContinueOrStart(std::unique_ptr<UpdateRun>& run) const
{
  auto* last = static_cast<FlipRun*>(run.get());
  const InputChange change = last ? last->FindChange(*this) : InputChange::Mesh;
  if (change == InputChange::Nothing)
  {
    last->Renew(*this);
    return true;
  }
  const bool isWarm = change == InputChange::Points && !this->Settings.Refines;
  if (isWarm && last->Follow(*this, MakePlan(*this, false)))
  {
    return false;
  }
  UpdatePlan plan = MakePlan(*this, isWarm);
  RunStart start;
  if (isWarm)
  {
    start = last->GetEnd(plan.For(UpdatePlan::FixedEdges));
  }
  else
  {
    run.reset(); // its memory may be needed
  }
  run = std::make_unique<FlipRun>(*this, std::move(plan), std::move(start));
  return false;
}

}
