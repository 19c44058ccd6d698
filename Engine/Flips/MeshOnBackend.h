// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHONBACKEND_H
#define DELAUNAYFLIP_MESHONBACKEND_H

#include "Array.h"
#include "EdgeGuard.h"
#include "EdgeMeshBuilder.h"
#include "GeometryChoice.h"
#include "InputChecks.h"
#include "LivingMesh.h"
#include "MeshSurveyBuilder.h"
#include "PlanarSurvey.h"
#include "PointMesh.h"
#include "SmallestAngle.h"
#include "SpatialOrder.h"
#include "SphereSurvey.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Makes a mesh and its loop from the caller's arrays, on a backend.
template <typename BackendT>
class MeshOnBackend : public LivingMesh<BackendT>
{
public:
  using LocalMesh = typename BackendT::LocalMesh;

  /// @param given `mesh` as made by the backend. No reference to either is kept.
  /// @throws RunAborted.
  MeshOnBackend(const TriangleMesh& mesh, LocalMesh&& given, const FlipOptions& options,
    BackendT backend, const BuildProgress& progress)
    : LivingMesh<BackendT>(std::move(backend))
  {
    // An exception ends this variable before the member that owns the backend, and with it the
    // memory of its arrays. A parameter would end later.
    LocalMesh local = std::move(given);
    const MeshInput input{ mesh, local.Mesh, local.IsOnHost };
    MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, this->Backend);
    CheckTieRule(options, survey.Geometry);
    if (HasGoals(options, mesh) || mesh.NumberOfRegionSeeds > 0)
    {
      const bool isPlanar =
        survey.Geometry == GeometryKind::Planar || survey.Geometry == GeometryKind::PlanarXY;
      CheckRefinement(options, mesh, survey.Geometry, isPlanar && survey.Projection.IsInXY());
    }
    progress.Reach(survey.Geometry, BuildStep::Surveyed);
    this->Order = OrderMesh(input, survey, this->Backend);
    progress.Reach(survey.Geometry, BuildStep::Ordered);
    EdgeMeshInput edges{ input, survey, this->Order, options.FeatureAngle };
    const PointArray& points = input.Local.Points;
    this->Points = PackPoints(points, this->Order.View(),
      PlanPacking(survey, options.Criterion, points.Floats != nullptr), this->Backend);
    local.DropPoints(); // the caller's points are not needed any more
    if (survey.Geometry == GeometryKind::Surface)
    {
      edges.Packed = this->Points.View().GetPoints();
    }
    // This is the peak of memory use, with the caller's triangles and the engine's. So a device
    // first frees what can be recomputed.
    if (BackendT::MemoryIsScarce)
    {
      this->Order.DropVertices();
    }
    EdgeMesh loaded = LoadTriangles(edges, this->Backend);
    local.DropTriangles();
    this->Order.TriangleOfRank = Array<TriangleId>();
    if (BackendT::MemoryIsScarce)
    {
      this->Order.RestoreVertices(this->Backend);
    }
    survey.Uses = Array<PointUse>();
    progress.Reach(survey.Geometry, BuildStep::Loaded);
    EdgeMeshResult built = BuildEdgeMesh(edges, std::move(loaded), this->Backend, progress);
    progress.Reach(survey.Geometry, BuildStep::Fixed);
    local.DropRegions();
    this->Order.RankOfVertex = Array<VertexId>();
    this->Mesh = std::move(built.Edges);
    built.Table = EdgeTable(); // frees its memory
    FlipReport& report = this->Report;
    report.Points = mesh.Points.Count;
    report.Triangles = mesh.Triangles.Count;
    report.Edges = built.Counts;
    report.DuplicateTriangles = built.DuplicateTriangles.Count;
    report.UnmatchedConstraints = built.MissingConstraints;
    report.EulerCharacteristic =
      survey.UsedPoints - built.Counts.Edges + mesh.Triangles.Count - survey.RepeatedIds.Count;
    report.GeometryUsed = survey.Geometry;
    report.Backend = this->Backend.GetName();
    this->TakeSurvey(survey, options, mesh,
      { built.DuplicateTriangles,
        Defect(DefectKind::ConstraintsNotEdges, built.MissingConstraints) });
  }

  /// Triangulates points in the plane instead.
  /// @param isLocal whether they are in the memory of the backend.
  /// @throws RunAborted.
  MeshOnBackend(const PlaneArray& points, bool isLocal, const FlipOptions& options,
    BackendT backend, const BuildProgress& progress)
    : LivingMesh<BackendT>(std::move(backend))
  {
    if (points.Floats)
    {
      this->Triangulate<float>(points, isLocal, points.Floats, options, progress);
    }
    else
    {
      this->Triangulate<double>(points, isLocal, points.Doubles, options, progress);
    }
  }

  bool MoveMesh(const TriangleMesh& moved, const FlipOptions& options) override
  {
    if constexpr (BackendT::IsOnHost)
    {
      return this->MoveHere(moved, options);
    }
    return false;
  }

  void DivideAndConquer(const BuildProgress& progress) override
  {
    this->StartPolls(progress);
    if (this->Places.Floats)
    {
      this->DivideAndConquer(this->Places.Floats, progress);
    }
    else
    {
      this->DivideAndConquer(this->Places.Doubles, progress);
    }
  }

  /// WholeMesh::SharedPoints in the order of vertices. Public because device lambdas require it.
  Array<unsigned char> RankSharedPoints(const TriangleMesh& mesh) const
  {
    const std::int64_t count = mesh.Points.Count;
    Array<unsigned char> given = this->Backend.template MakeArray<unsigned char>(count);
    Array<unsigned char> ranked = this->Backend.template MakeArray<unsigned char>(count);
    this->Backend.Upload(mesh.Whole.SharedPoints, count, given.Data());
    const SpatialOrderView order = this->Order.View();
    const unsigned char* from = given.Data();
    unsigned char* to = ranked.Data();
    this->Backend.ForEach(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = from[order.GetVertex(i)]; });
    return ranked;
  }

private:
  /// Lets the observer be asked also within steps, which may take seconds, and in the loop.
  void StartPolls(const BuildProgress& progress)
  {
    if constexpr (BackendT::IsOnHost)
    {
      this->Backend.SetPoll([&progress] { progress.Tell(0.0); });
    }
  }

  template <typename Real>
  void Triangulate(PlaneArray points, bool isLocal, const Real* values, const FlipOptions& options,
    const BuildProgress& progress)
  {
    constexpr GeometryKind Plane = GeometryKind::PlanarXY;
    this->StartPolls(progress);
    StripPoints<Real> sorted;
    {
      Array<Real> copy;
      if (!isLocal && points.Count > 0)
      {
        const std::int64_t numbers = (points.Count - 1) * points.Stride + 2;
        copy = this->Backend.template MakeArray<Real>(numbers);
        this->Backend.Upload(values, numbers, copy.Data());
        points = PlaneArray(copy.Data(), points.Count, points.Stride);
      }
      progress.Reach(Plane, BuildStep::Surveyed);
      sorted = StripSorter<Real, BackendT>::Sort(
        points, ChooseStrips(points, this->Backend), this->Backend);
    }
    const std::int64_t finite = sorted.Count;
    this->UsedPoint = MergePlaces(sorted, points.Count, this->Backend);
    const std::int64_t places = sorted.Count;
    progress.Reach(Plane, BuildStep::Loaded);
    const MeshSurvey survey = SurveyPlaces(sorted, this->Backend);
    PointMesh<Real> mesh;
    if (places < 3)
    {
      mesh.Points = std::move(sorted);
    }
    else
    {
      mesh = BuildPointMesh(std::move(sorted), survey.FiltersApply, this->Backend, progress);
    }
    progress.Reach(Plane, BuildStep::Fixed);
    this->Mesh = std::move(mesh.Edges);
    this->Order.VertexOfRank = std::move(mesh.Points.Ids);
    this->Points.Count = places;
    const Real* coordinates = mesh.Points.Coordinates.Data();
    this->Points.Take(std::move(mesh.Points.Coordinates));
    this->Places = PlaneArray(coordinates, places, 2);

    FlipReport& report = this->Report;
    report.Points = points.Count;
    report.Triangles = this->Mesh.NumberOfTriangles;
    report.Edges.Edges = this->Mesh.NumberOfEdges;
    if (report.Triangles > 0)
    {
      report.Edges.Boundary = mesh.HullEdges;
      report.Edges.Fixed = mesh.HullEdges;
      report.EulerCharacteristic = places - report.Edges.Edges + report.Triangles;
    }
    report.GeometryUsed = Plane;
    report.GeometryReason = "points are triangulated in the plane";
    report.Backend = this->Backend.GetName();
    report.Tolerance = DescribeTolerance(options, Plane);
    this->IsFromPoints = true;
    report.FromPoints.NotFinite = points.Count - finite;
    report.FromPoints.Repeated = finite - places;
    // All triangles are counter-clockwise and none overlap, so that flips need no guard.
    this->Range = survey.Range;
    this->FiltersApply = survey.FiltersApply;
    this->MakeLoop(PlanarRule<Real, 2>{ coordinates, 1, true, this->FiltersApply });
    KeepAnglesBefore({}, report); // the caller has never seen these triangles
    KeepAnglesAfter({}, report); // measured when they are asked for
  }

  /// Takes over what is known of the places of the points, and makes the loop for these.
  /// @param defects what else was found, to report.
  void TakeSurvey(const MeshSurvey& survey, const FlipOptions& options, const TriangleMesh& mesh,
    const std::vector<Defect>& defects)
  {
    this->Range = survey.Range;
    this->Orientations = survey.Orientations;
    this->FiltersApply = survey.FiltersApply && !survey.Projection.Tilted;
    this->Frame = { survey.Projection };
    this->Frame.IsCanonical = options.TieRule == TieRuleKind::Canonical;
    FlipReport& report = this->Report;
    report.GeometryReason = survey.GeometryReason;
    report.Tolerance = DescribeTolerance(options, survey.Geometry);
    const std::vector<Defect> made = this->ChooseLoop(survey, options, mesh);
    const bool mayHide = report.Edges.NonManifold > 0;
    report.ObtuseAtNonManifold = mayHide ? this->CountHidden().ObtuseCorners : 0;
    std::vector<Defect> all{ survey.NonFinitePoints, survey.RepeatedIds, survey.NearlyHeightField };
    all.insert(all.end(), defects.begin(), defects.end());
    all.insert(all.end(), made.begin(), made.end());
    report.Defects.clear();
    std::copy_if(all.begin(), all.end(), std::back_inserter(report.Defects),
      [](const Defect& defect) { return defect.Count > 0; });
  }

  /// Does what MoveMesh does, on the host.
  bool MoveHere(const TriangleMesh& moved, const FlipOptions& options)
  {
    const std::int64_t count = this->Mesh.NumberOfTriangles;
    Array<std::int32_t> ids = this->Backend.template MakeArray<std::int32_t>(3 * count);
    this->StoreTriangles(MutableTriangleArray(ids.Data(), count));
    TriangleMesh mesh = moved;
    mesh.Triangles = TriangleArray(const_cast<const std::int32_t*>(ids.Data()), count);
    MeshSurvey survey = BuildMeshSurvey({ mesh, mesh }, options.Geometry, this->Backend);
    // Which triangles have edges depends on which points are finite.
    std::vector<Defect> defects = this->Report.Defects;
    const bool wereFinite = std::none_of(defects.begin(), defects.end(),
      [](const Defect& defect) { return defect.Kind == DefectKind::PointsNotFinite; });
    const bool follows = wereFinite && survey.NonFinitePoints.Count == 0 &&
      survey.Geometry == this->Report.GeometryUsed;
    if (!follows)
    {
      return false;
    }
    defects.erase(std::remove_if(defects.begin(), defects.end(),
                    [](const Defect& defect)
                    {
                      return defect.Kind != DefectKind::DuplicateTriangles &&
                        defect.Kind != DefectKind::ConstraintsNotEdges;
                    }),
      defects.end());
    this->Points = PackPoints(mesh.Points, this->Order.View(),
      PlanPacking(survey, options.Criterion, mesh.Points.Floats != nullptr), this->Backend);
    TriangleRecord* triangles = this->Mesh.Triangles.Data();
    this->Backend.ForEach(count, [=](std::int64_t t) { triangles[t].Flips %= OneFlip; });
    EdgeState* states = this->Mesh.States.Data();
    this->Backend.ForEach(this->Mesh.NumberOfEdges,
      [=](std::int64_t edge)
      {
        if (states[edge] != EdgeState::Fixed)
        {
          states[edge] = EdgeState::Candidate;
        }
      });
    this->TakeSurvey(survey, options, mesh, defects);
    this->Loop->Restart();
    return true;
  }

  /// Makes the loop that suits the mesh, and measures the smallest angle.
  /// @returns the triangles without area or with another orientation than most.
  std::vector<Defect> ChooseLoop(
    const MeshSurvey& survey, const FlipOptions& options, const TriangleMesh& mesh)
  {
    const bool isSurface = survey.Geometry == GeometryKind::Surface;
    Array<unsigned char> shared;
    if (mesh.Whole.SharedPoints)
    {
      shared = this->RankSharedPoints(mesh);
    }
    std::vector<Defect> defects;
    bool needsGuard = true;
    int uniformSide = 0;
    const PlanePoint center{ mesh.Center[0], mesh.Center[1], mesh.Center[2] };
    if (survey.Geometry == GeometryKind::Sphere)
    {
      const SphereSurvey sphere = SurveySphere(this->Mesh, this->Points, center, this->Backend);
      defects = sphere.Defects;
      uniformSide = sphere.UniformSide;
      needsGuard = !mesh.Whole.StarsAreSimple;
    }
    else if (!isSurface)
    {
      const EdgeCounts& edges = this->Report.Edges;
      const bool brokenFans =
        edges.NonManifold > 0 || edges.WronglyWound > 0 || survey.NonFinitePoints.Count > 0;
      const bool areSimple = mesh.Whole.StarsAreSimple;
      const PlanarSurvey plane = SurveyPlane(
        this->Mesh, this->Points, brokenFans || areSimple, survey.UsedPoints, this->Backend);
      defects = plane.ListDefects(mesh.Whole.Side);
      needsGuard = !(plane.StarsAreSimple || areSimple) || shared.Size() > 0;
      uniformSide = plane.UniformSide;
      this->Frame.IsMirrored = plane.Orientations.GetSide() < 0;
      this->Frame.NeedsGuard = needsGuard || survey.Projection.Tilted;
    }
    EdgeGuard guard;
    if (needsGuard)
    {
      guard = EdgeGuard(this->Mesh, mesh.Points.Count, this->Backend, std::move(shared));
    }
    const PackedPointsView packed = this->Points.View();
    RuleChoice(survey, options, center)
      .Visit(packed.Floats, packed.Doubles, uniformSide,
        [&](const auto& rule) { this->MakeLoop(rule, std::move(guard)); });
    const AngleSums angles = this->Loop->MeasureAngles();
    KeepAnglesBefore(angles, this->Report);
    KeepAnglesAfter(angles, this->Report);
    if (isSurface && angles.Largest == INFINITY)
    {
      defects = { FindZeroAreaTriangles(this->Mesh, this->Points, this->Backend) };
    }
    return defects;
  }

  template <typename Real>
  void DivideAndConquer(const Real* coordinates, const BuildProgress& progress)
  {
    std::int64_t hullEdges = 0; // the same as before
    this->Mesh =
      TriangulateByDivideAndConquer(reinterpret_cast<const CoordinatePair<Real>*>(coordinates),
        this->Points.Count, this->Backend, progress, hullEdges);
    this->MakeLoop(PlanarRule<Real, 2>{ coordinates, 1, true, this->FiltersApply });
    this->Asker = PlaceAsker<BackendT>();
  }
};

}

#endif
