// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHONBACKEND_H
#define DELAUNAYFLIP_MESHONBACKEND_H

#include "Array.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeMeshBuilder.h"
#include "FlipLoopChoice.h"
#include "GeometryChoice.h"
#include "HiddenEdges.h"
#include "InputChecks.h"
#include "LoadedMesh.h"
#include "MeshMotion.h"
#include "MeshSurvey.h"
#include "MeshSurveyBuilder.h"
#include "PlaceAsker.h"
#include "PlanarSurvey.h"
#include "PlaneFrame.h"
#include "PointGrowth.h"
#include "PointMesh.h"
#include "Refinement.h"
#include "SegmentInsertion.h"
#include "SmallestAngle.h"
#include "SpatialOrder.h"
#include "SphereSurvey.h"
#include "StoreSteps.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Makes a loop from the caller's arrays, on a backend.
template <typename BackendT>
class MeshOnBackend : public LoadedMesh
{
public:
  using LocalMesh = typename BackendT::LocalMesh;

  /// @param local `mesh` as made by the backend. No reference to either is kept.
  /// @throws RunAborted.
  MeshOnBackend(const TriangleMesh& mesh, LocalMesh local, const FlipOptions& options,
    BackendT backend, const BuildProgress& progress)
    : Backend(std::move(backend))
  {
    const MeshInput input{ mesh, local.Mesh, local.IsOnHost };
    MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, this->Backend);
    CheckTieRule(options, survey.Geometry);
    CheckRefinement(options, mesh.Sizes, survey.Geometry);
    this->Range = survey.Range;
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
    this->Orientations = survey.Orientations;
    this->FiltersApply = survey.FiltersApply && !survey.Projection.Tilted;
    this->Frame = { survey.Projection };
    this->Frame.IsCanonical = options.TieRule == TieRuleKind::Canonical;
    FlipReport& report = this->Report;
    report.Points = mesh.Points.Count;
    report.Triangles = mesh.Triangles.Count;
    report.Edges = built.Counts;
    report.DuplicateTriangles = built.DuplicateTriangles.Count;
    report.UnmatchedConstraints = built.MissingConstraints;
    report.EulerCharacteristic =
      survey.UsedPoints - built.Counts.Edges + mesh.Triangles.Count - survey.RepeatedIds.Count;
    report.GeometryUsed = survey.Geometry;
    report.GeometryReason = survey.GeometryReason;
    report.Tolerance = DescribeTolerance(options, survey.Geometry);
    report.Backend = this->Backend.GetName();
    const std::vector<Defect> made = this->ChooseLoop(survey, options, mesh);
    const bool mayHide = built.Counts.NonManifold > 0;
    report.ObtuseAtNonManifold = mayHide ? this->CountHidden().ObtuseCorners : 0;
    std::vector<Defect> defects{ survey.NonFinitePoints, survey.RepeatedIds,
      survey.NearlyHeightField, built.DuplicateTriangles,
      Defect(DefectKind::ConstraintsNotEdges, built.MissingConstraints) };
    defects.insert(defects.end(), made.begin(), made.end());
    std::copy_if(defects.begin(), defects.end(), std::back_inserter(report.Defects),
      [](const Defect& defect) { return defect.Count > 0; });
  }

  /// Triangulates points in the plane instead.
  /// @param isLocal whether they are in the memory of the backend.
  /// @throws RunAborted.
  MeshOnBackend(const PlaneArray& points, bool isLocal, const FlipOptions& options,
    BackendT backend, const BuildProgress& progress)
    : Backend(std::move(backend))
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

  std::unique_ptr<DeviceScope> MakeCurrent() const override { return this->Backend.MakeCurrent(); }

  FlipLoop& GetLoop() override { return *this->Loop; }

  const FlipReport& GetInputReport() const override { return this->Report; }

  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Backend.StoreTriangles(triangles, this->GetStoreStep(), this->IsFromPoints);
  }

  void StoreFlipCounts(std::int32_t* counts) const override
  {
    this->Backend.StoreValues(this->Mesh.NumberOfTriangles, counts, this->GetFlipCountStep());
  }

  void StoreNeighbors(std::int32_t* neighbors) const override
  {
    this->Backend.StoreValues(3 * this->Mesh.NumberOfTriangles, neighbors, this->GetNeighborStep());
  }

  void StoreUsedPoints(std::int64_t* ids) const override
  {
    const std::int64_t count = this->Report.Points;
    std::vector<VertexId> used(this->UsedPoint.Size());
    this->Backend.Download(
      this->UsedPoint.Data(), static_cast<std::int64_t>(used.size()), used.data());
    constexpr std::int64_t Piece = 65536;
    this->Backend.ForTasks((count + Piece - 1) / Piece,
      [&](std::int64_t piece)
      {
        for (std::int64_t i = piece * Piece; i < std::min(count, (piece + 1) * Piece); ++i)
        {
          ids[i] = i;
          if (!used.empty())
          {
            ids[i] = used[i] == NoVertex ? -1 : std::int64_t(used[i]);
          }
        }
      });
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

  void InsertSegments(
    const std::vector<std::uint32_t>& ends, const SegmentObserver& onBatch) override
  {
    this->RequireStates();
    const Array<VertexId> placeOf = this->ListPlaces();
    if (onBatch({})) // what precedes the first segments takes long, too
    {
      SegmentInsertion<BackendT>(this->Mesh, this->Places, placeOf.Data(), this->Backend)
        .Insert(ends, onBatch);
    }
    this->Loop->Restart();
  }

  AskResult Ask(const RunQuery& asked, const ProgressObserver& observer) override
  {
    this->RequireStates();
    AskResult result = this->Asker.Answer(this->ViewHere(), asked, this->Backend, observer);
    if (result == AskResult::Undecided && !asked.Query.OnDevice)
    {
      const ThreadBackend& threads = this->Backend.GetThreads();
      this->ViewOnHost([&](const PointMeshView& view)
        { result = PlaceAsker<ThreadBackend>().Answer(view, asked, threads, observer); });
    }
    return result;
  }

  std::int64_t InsertPoints(const std::vector<double>& places) override
  {
    this->RequireStates();
    return this->Places.Floats ? this->InsertPoints(places, this->Points.Floats)
                               : this->InsertPoints(places, this->Points.Doubles);
  }

  MotionResult RemovePoints(const std::vector<VertexId>& ids) override
  {
    const bool canRemove = this->Mesh.NumberOfTriangles > 0 && this->FiltersApply &&
      this->Report.FromPoints.Repeated == 0;
    if (!canRemove)
    {
      return MotionResult();
    }
    this->RequireStates();
    return this->Places.Floats ? this->RemoveHere(ids, this->Points.Floats)
                               : this->RemoveHere(ids, this->Points.Doubles);
  }

  MotionResult MovePoints(const PointInput& targets) override
  {
    if (this->Range != CoordinateRange::Usual || this->Mesh.NumberOfTriangles == 0)
    {
      return MotionResult();
    }
    const bool isLocal = BackendT::IsOnHost || targets.OnDevice;
    return targets.Points.Floats ? this->MoveTo(targets.Points, targets.Points.Floats, isLocal)
                                 : this->MoveTo(targets.Points, targets.Points.Doubles, isLocal);
  }

  void StartRefinement(const RefinementPlan& plan) override
  {
    this->RequireStates();
    if (plan.IsOfCaller && this->Places.Count == 0)
    {
      // FixBlocked needs the states of edges, which the loop on a device does not write.
      if (!BackendT::IsOnHost && this->Frame.NeedsGuard)
      {
        throw BackendUnavailable(
          "a mesh whose triangles overlap, are turned over or meet only at a point is refined by "
          "threads");
      }
      this->MakePlaces();
    }
    if (this->Places.Floats)
    {
      this->StartRefinement(plan, this->RefinedFloats);
    }
    else
    {
      this->StartRefinement(plan, this->RefinedDoubles);
    }
  }

  std::int64_t Refine() override
  {
    return this->Places.Floats ? this->RefineOnce(this->RefinedFloats)
                               : this->RefineOnce(this->RefinedDoubles);
  }

  RefinementResult FetchRefinement() override
  {
    return this->Places.Floats ? this->FetchRefinement(this->RefinedFloats)
                               : this->FetchRefinement(this->RefinedDoubles);
  }

  void ViewOnHost(const HostView& use) override
  {
    PointMeshView view = this->ViewHere();
    if constexpr (BackendT::IsOnHost)
    {
      use(view);
      return;
    }
    EdgeMesh& mesh = this->Mesh;
    const auto fetch = [&](const auto* values, std::int64_t size)
    {
      std::vector<std::remove_const_t<std::remove_pointer_t<decltype(values)>>> copy(size);
      this->Backend.Download(values, size, copy.data());
      return copy;
    };
    this->RequireStates();
    auto triangles = fetch(mesh.Triangles.Data(), mesh.NumberOfTriangles);
    auto corners = fetch(mesh.CornerOfHalfEdge.Data(), 2 * mesh.NumberOfEdges);
    auto states = fetch(mesh.States.Data(), mesh.NumberOfEdges);
    const auto ids = fetch(this->Order.VertexOfRank.Data(), this->Points.Count);
    view.Edges = { triangles.data(), corners.data(), states.data() };
    view.Ids = ids.data();
    const auto useWith = [&](const auto& places)
    {
      view.Places = PlaneArray(places.data(), this->Points.Count, 2);
      use(view);
    };
    if (this->Places.Floats)
    {
      useWith(fetch(this->Places.Floats, 2 * this->Points.Count));
    }
    else
    {
      useWith(fetch(this->Places.Doubles, 2 * this->Points.Count));
    }
  }

  Defect FindTurnedTriangles() const override
  {
    const bool wasHeightField =
      this->Report.GeometryUsed == GeometryKind::Surface && this->Orientations.AreNearlyUniform();
    if (!wasHeightField)
    {
      return Defect();
    }
    return delaunayflip::FindTurnedTriangles(
      this->Mesh, this->Points, this->Orientations, this->Backend);
  }

  bool KeepsSliver() override
  {
    return KeepsWorstSliver(
      this->Mesh, this->Points, this->Range, this->Loop->MeasureAngles().Largest, this->Backend);
  }

  HiddenSums CountHidden() override
  {
    return this->Backend.template Sum<HiddenSums>(
      this->Mesh.NumberOfEdges, HiddenEdgeSurvey{ this->Mesh.View(), this->Points.View() });
  }

  void Audit() const override { RequireConsistent(this->Mesh, this->Backend); }

  /// Returns the place of each point of a mesh from points, or NoVertex. This and the next function
  /// are public because device lambdas require it.
  Array<VertexId> ListPlaces() const
  {
    Array<VertexId> places = this->Backend.template MakeArray<VertexId>(this->Report.Points);
    VertexId* placeOf = places.Data();
    const VertexId* ids = this->Order.VertexOfRank.Data();
    this->Backend.ForEach(this->Points.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t place)
      { placeOf[ids[place]] = static_cast<VertexId>(place); });
    // Repeated points are not the used one, so what is read here is not written.
    const VertexId* used = this->UsedPoint.Data();
    this->Backend.ForEach(static_cast<std::int64_t>(this->UsedPoint.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (used[i] == NoVertex)
        {
          placeOf[i] = NoVertex;
        }
        else if (used[i] != i)
        {
          placeOf[i] = placeOf[used[i]];
        }
      });
    return places;
  }

  /// Writes to UsedPoint which points are no longer used. Public because device lambdas require it.
  void ForgetUsed(const Array<VertexId>& removed)
  {
    const bool isNew = this->UsedPoint.Size() == 0;
    if (isNew)
    {
      this->UsedPoint = this->Backend.template MakeArray<VertexId>(this->Report.Points);
    }
    VertexId* used = this->UsedPoint.Data();
    this->Backend.ForEach(isNew ? this->Report.Points : 0,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { used[i] = static_cast<VertexId>(i); });
    const VertexId* ids = removed.Data();
    this->Backend.ForEach(static_cast<std::int64_t>(removed.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { used[ids[i]] = NoVertex; });
  }

  /// Makes the states of edges if there are none.
  void RequireStates()
  {
    if (this->Mesh.States.Size() == 0)
    {
      MakeStates(this->Mesh, this->Backend);
      const EdgeMeshView edges = this->Mesh.View();
      this->Backend.ForEach(this->Mesh.NumberOfEdges,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
        {
          const bool isFixed = edges.CornerOfHalfEdge[2 * e + 1] == NoCorner;
          edges.States[e] = isFixed ? EdgeState::Fixed : EdgeState::Good;
        });
    }
  }

  /// Projects the points of the caller's mesh into a plane in which most triangles are
  /// counter-clockwise. This and the next two functions are public because device lambdas require
  /// it.
  void MakePlaces()
  {
    this->RequireIds();
    if (this->Points.IsFloat())
    {
      this->MakePlaces(this->Points.Floats);
    }
    else
    {
      this->MakePlaces(this->Points.Doubles);
    }
    this->Points.Components = 2;
  }

  template <typename Real>
  void MakePlaces(Array<Real>& coordinates)
  {
    const std::int64_t count = this->Points.Count;
    const PlacementStep step{ this->Points.View(), this->Frame };
    if (this->Frame.IsMirrored || this->Points.Components == 3)
    {
      Array<Real> places = this->Backend.template MakeArray<Real>(2 * count);
      Real* to = places.Data();
      this->Backend.ForEach(count,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
        {
          const PlanePoint place = step.Find(static_cast<VertexId>(i));
          to[2 * i] = static_cast<Real>(place.U);
          to[2 * i + 1] = static_cast<Real>(place.V);
        });
      coordinates = std::move(places);
    }
    this->Places = PlaneArray(static_cast<const Real*>(coordinates.Data()), count, 2);
    this->MakeLoopOfGrown<Real>(coordinates.Data());
  }

  /// Fills the ids of vertices if there are none: the id of each vertex is its number.
  void RequireIds()
  {
    if (this->Order.VertexOfRank.Size() == 0)
    {
      this->Order.VertexOfRank = this->Backend.template MakeArray<VertexId>(this->Points.Count);
      VertexId* ids = this->Order.VertexOfRank.Data();
      this->Backend.ForEach(this->Points.Count,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { ids[i] = static_cast<VertexId>(i); });
    }
  }

  /// WholeMesh::SharedPoints in the order of vertices; empty if there are none. Public because
  /// device lambdas require it.
  Array<unsigned char> RankSharedPoints(const TriangleMesh& mesh) const
  {
    const unsigned char* caller = mesh.Whole.SharedPoints;
    const std::int64_t count = mesh.Points.Count;
    if (!caller)
    {
      return {};
    }
    Array<unsigned char> given = this->Backend.template MakeArray<unsigned char>(count);
    Array<unsigned char> ranked = this->Backend.template MakeArray<unsigned char>(count);
    this->Backend.Upload(caller, count, given.Data());
    const SpatialOrderView order = this->Order.View();
    const unsigned char* from = given.Data();
    unsigned char* to = ranked.Data();
    this->Backend.ForEach(
      count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = from[order.GetVertex(i)]; });
    return ranked;
  }

protected:
  const BackendT& GetBackend() const { return this->Backend; }
  StoreStep GetStoreStep() const { return { this->Mesh.Triangles.Data(), this->Order.View() }; }
  NeighborStep GetNeighborStep() const
  {
    return { this->Mesh.Triangles.Data(), this->Mesh.CornerOfHalfEdge.Data() };
  }
  FlipCountStep GetFlipCountStep() const { return { this->Mesh.Triangles.Data() }; }

private:
  /// A view of a mesh from points, in the memory of the backend.
  PointMeshView ViewHere()
  {
    PointMeshView view;
    view.Edges = this->Mesh.View();
    view.Places = this->Places;
    view.NumberOfTriangles = this->Mesh.NumberOfTriangles;
    view.NumberOfEdges = this->Mesh.NumberOfEdges;
    view.NumberOfPlaces = this->Points.Count;
    view.Ids = this->Order.VertexOfRank.Data();
    view.Range = this->Range;
    return view;
  }

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

  template <typename Rule>
  void MakeLoop(const Rule& rule, EdgeGuard guard = EdgeGuard())
  {
    using Type = typename LoopOf<BackendT, Rule>::Type;
    this->Loop.reset(new Type(this->Mesh, rule, this->Range, std::move(guard), this->Backend));
  }

  /// Makes a loop without chunks: edges that are added are not in the order of the triangles.
  template <typename Real>
  void MakeLoopOfGrown(const Real* coordinates)
  {
    EdgeGuard guard;
    if (this->Frame.NeedsGuard)
    {
      guard = EdgeGuard(this->Mesh, this->Points.Count, this->Backend);
    }
    const int side = this->Frame.NeedsGuard ? 0 : 1;
    this->MakeLoop(
      PlanarRule<Real, 2>{ coordinates, side, this->Frame.IsCanonical, this->FiltersApply },
      std::move(guard));
    this->Loop->Restart();
  }

  /// Makes the loop that suits the mesh, and measures the smallest angle.
  /// @returns the triangles without area or with another orientation than most.
  std::vector<Defect> ChooseLoop(
    const MeshSurvey& survey, const FlipOptions& options, const TriangleMesh& mesh)
  {
    const bool isSurface = survey.Geometry == GeometryKind::Surface;
    Array<unsigned char> shared = this->RankSharedPoints(mesh);
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

  template <typename Real>
  std::int64_t InsertPoints(const std::vector<double>& places, Array<Real>& coordinates)
  {
    const std::int64_t count = SizeOf(places) / 2;
    Array<double> placesHere = this->Backend.template MakeArray<double>(2 * count);
    this->Backend.Upload(places.data(), 2 * count, placesHere.Data());
    PlaneMesh plane{ this->Mesh.View(), this->Places, true };
    const PlaceGridView grid =
      this->Asker.RequireGrid(plane, this->Mesh.NumberOfTriangles, this->Backend);
    const auto grow = [&](std::int64_t vertices)
    {
      Reserve(coordinates, 2 * this->Points.Count, 2 * vertices, this->Backend);
      Reserve(this->Order.VertexOfRank, this->Points.Count, vertices, this->Backend);
      return StoreVertex<Real>{ coordinates.Data(), this->Order.VertexOfRank.Data(),
        placesHere.Data(), this->Report.Points };
    };
    PointGrowth<BackendT> growth(placesHere.Data(), count, this->Backend);
    std::int64_t flips = 0;
    for (;;)
    {
      plane = { this->Mesh.View(), this->Places, true };
      const std::int64_t added =
        growth.InsertSome(this->Mesh, plane, this->Points.Count, grid, grow);
      if (added == 0)
      {
        break;
      }
      this->Points.Count += added;
      this->Places = PlaneArray(coordinates.Data(), this->Points.Count, 2);
      this->MakeLoopOfGrown<Real>(coordinates.Data());
      flips += this->Loop->Converge();
    }
    this->CountInserted(growth, count);
    return flips;
  }

  /// @param values the coordinates of the targets, in the caller's type.
  template <typename Value>
  MotionResult MoveTo(PlaneArray targets, const Value* values, bool isLocal)
  {
    this->RequireStates();
    if (!isLocal)
    {
      // The array is kept, so that later motions need no new memory.
      Array<Value>& copy = std::get<Array<Value>>(this->Targets);
      const std::int64_t numbers = (targets.Count - 1) * targets.Stride + 2;
      Reserve(copy, 0, numbers, this->Backend);
      this->Backend.Upload(values, numbers, copy.Data());
      targets = PlaneArray(copy.Data(), targets.Count, targets.Stride);
    }
    this->Asker = PlaceAsker<BackendT>();
    return this->Places.Floats ? this->MoveHere(targets, this->Points.Floats)
                               : this->MoveHere(targets, this->Points.Doubles);
  }

  template <typename Real>
  MotionResult MoveHere(const PlaneArray& targets, Array<Real>& coordinates)
  {
    const MovingMesh<Real> mesh{ this->Mesh, coordinates.Data(), this->Points.Count,
      this->Order.VertexOfRank.Data() };
    const auto settle = [&](bool hasOtherEdges)
    { return this->Settle(coordinates.Data(), hasOtherEdges); };
    const MotionResult result =
      this->Motion.Move(mesh, targets, this->UsedPoint, this->Backend, settle);
    this->CountGrown();
    return result;
  }

  /// Flips until the mesh is Delaunay, after points were moved or removed. @returns the number of
  /// flips.
  template <typename Real>
  std::int64_t Settle(const Real* coordinates, bool hasOtherEdges)
  {
    if (hasOtherEdges)
    {
      this->MakeLoopOfGrown<Real>(coordinates);
    }
    else
    {
      this->Loop->Restart();
    }
    return this->Loop->Converge();
  }

  template <typename Real>
  MotionResult RemoveHere(const std::vector<VertexId>& ids, Array<Real>& coordinates)
  {
    Array<VertexId> removed = this->Backend.template MakeArray<VertexId>(SizeOf(ids));
    this->Backend.Upload(ids.data(), SizeOf(ids), removed.Data());
    const MovingMesh<Real> mesh{ this->Mesh, coordinates.Data(), this->Points.Count,
      this->Order.VertexOfRank.Data() };
    const auto settle = [&](bool hasOtherEdges)
    {
      this->Points.Count -= SizeOf(ids);
      this->Places = PlaneArray(coordinates.Data(), this->Points.Count, 2);
      return this->Settle(coordinates.Data(), hasOtherEdges);
    };
    this->Asker = PlaceAsker<BackendT>();
    const MotionResult result =
      this->Motion.Remove(mesh, this->Order.VertexOfRank.Data(), removed, this->Backend, settle);
    if (result.IsThere)
    {
      this->ForgetUsed(removed);
      this->Report.FromPoints.NotFinite += SizeOf(ids);
      this->CountGrown();
    }
    return result;
  }

  /// A mesh while it is refined.
  template <typename Real>
  struct RefinedMesh
  {
    GrowingMesh<Real> Grown;
    std::unique_ptr<Refinement<Real, BackendT>> Rounds;
    bool IsComplete = false;
    RefinementResult Result; ///< Valid if IsComplete.
  };

  template <typename Real>
  Array<Real>& GetCoordinates()
  {
    if constexpr (std::is_same<Real, float>::value)
    {
      return this->Points.Floats;
    }
    else
    {
      return this->Points.Doubles;
    }
  }

  template <typename Real>
  void StartRefinement(const RefinementPlan& plan, RefinedMesh<Real>& refined)
  {
    if (refined.Rounds)
    {
      return;
    }
    this->Loop->Converge(); // because a limit may have ended the iterations
    refined.Grown = { &this->Mesh, &this->GetCoordinates<Real>(), &this->Order.VertexOfRank,
      this->Points.Count, this->Report.Points, this->FiltersApply };
    refined.Rounds =
      std::make_unique<Refinement<Real, BackendT>>(refined.Grown, plan, this->Backend);
  }

  template <typename Real>
  std::int64_t RefineOnce(RefinedMesh<Real>& refined)
  {
    std::int64_t added = 0;
    if (!refined.IsComplete)
    {
      added = refined.Rounds->InsertSome(refined.Grown);
    }
    if (added == 0)
    {
      this->EndRefinement(refined);
      return 0;
    }
    this->Points.Count = refined.Grown.Vertices;
    const Real* coordinates = this->GetCoordinates<Real>().Data();
    this->Places = PlaneArray(coordinates, this->Points.Count, 2);
    this->MakeLoopOfGrown<Real>(coordinates);
    this->Loop->Converge();
    if (this->Frame.NeedsGuard)
    {
      refined.Rounds->FixBlocked(refined.Grown);
    }
    this->Asker = PlaceAsker<BackendT>();
    std::vector<VertexId> used(added);
    std::iota(used.begin(), used.end(), static_cast<VertexId>(this->Report.Points));
    this->AppendUsed(used);
    this->CountGrown();
    return added;
  }

  /// Fetches the result, and then lets edges flip that were fixed for refinement alone.
  template <typename Real>
  void EndRefinement(RefinedMesh<Real>& refined)
  {
    if (refined.IsComplete)
    {
      return;
    }
    refined.Result = refined.Rounds->Fetch(refined.Grown);
    refined.IsComplete = true;
    if (refined.Rounds->FreeEdges(refined.Grown) > 0)
    {
      this->MakeLoopOfGrown<Real>(this->GetCoordinates<Real>().Data());
      this->Loop->Converge();
    }
  }

  template <typename Real>
  RefinementResult FetchRefinement(RefinedMesh<Real>& refined)
  {
    RefinementResult result =
      refined.IsComplete ? refined.Result : refined.Rounds->Fetch(refined.Grown);
    const bool isOnAxes = !this->IsFromPoints && !this->Frame.Projection.Tilted;
    if (isOnAxes)
    {
      result.Axes[0] = this->Frame.GetAxis(0);
      result.Axes[1] = this->Frame.GetAxis(1);
    }
    return result;
  }

  /// Adds to UsedPoint what is used at the places of points that come last.
  void AppendUsed(const std::vector<VertexId>& added)
  {
    const auto before = static_cast<std::int64_t>(this->UsedPoint.Size());
    const std::int64_t points = this->Report.Points + SizeOf(added);
    if (before > 0)
    {
      std::vector<VertexId> used(this->Report.Points);
      this->Backend.Download(this->UsedPoint.Data(), this->Report.Points, used.data());
      used.insert(used.end(), added.begin(), added.end());
      this->UsedPoint = this->Backend.template MakeArray<VertexId>(points);
      this->Backend.Upload(used.data(), points, this->UsedPoint.Data());
    }
    this->Report.Points = points;
  }

  /// Counts what a mesh has after it has grown.
  void CountGrown()
  {
    FlipReport& report = this->Report;
    report.Triangles = this->Mesh.NumberOfTriangles;
    if (!this->IsFromPoints)
    {
      return; // because edges inside may be fixed, too
    }
    const std::int64_t hullEdges = 2 * this->Mesh.NumberOfEdges - 3 * this->Mesh.NumberOfTriangles;
    report.Edges.Edges = this->Mesh.NumberOfEdges;
    report.Edges.Boundary = hullEdges;
    report.Edges.Fixed = hullEdges;
    report.EulerCharacteristic = this->Points.Count - report.Edges.Edges + report.Triangles;
  }

  /// Brings the report and UsedPoint up to date.
  void CountInserted(const PointGrowth<BackendT>& growth, std::int64_t count)
  {
    std::vector<GrowthItem> items(count);
    this->Backend.Download(growth.GetItems(), count, items.data());
    FlipReport& report = this->Report;
    const std::int64_t before = report.Points;
    std::vector<VertexId> used(this->UsedPoint.Size());
    this->Backend.Download(
      this->UsedPoint.Data(), static_cast<std::int64_t>(used.size()), used.data());
    if (used.empty())
    {
      used.resize(before);
      std::iota(used.begin(), used.end(), VertexId(0));
    }
    std::vector<VertexId> ids(this->Points.Count);
    this->Backend.Download(this->Order.VertexOfRank.Data(), this->Points.Count, ids.data());
    for (const GrowthItem& item : items)
    {
      report.FromPoints.Repeated += item.State == GrowthState::Repeated ? 1 : 0;
      report.FromPoints.NotFinite += item.State == GrowthState::Outside ? 1 : 0;
      used.push_back(item.Vertex == NoVertex ? NoVertex : ids[item.Vertex]);
    }
    this->UsedPoint = this->Backend.template MakeArray<VertexId>(SizeOf(used));
    this->Backend.Upload(used.data(), SizeOf(used), this->UsedPoint.Data());
    report.Points = before + count;
    this->CountGrown();
  }

  BackendT Backend;
  SpatialOrder Order;
  EdgeMesh Mesh;
  PackedPoints Points;
  CoordinateRange Range = CoordinateRange::Usual;
  bool FiltersApply = false; ///< Whether coordinates are in the range of the planar filters.
  bool IsFromPoints = false;
  /// A view of Points, in a mesh from points, or in the caller's mesh once refinement has begun.
  PlaneArray Places;
  PlaneFrame Frame;
  Array<VertexId> UsedPoint; ///< What MergePlaces returned.
  PlaceAsker<BackendT> Asker;
  MeshMotion<BackendT> Motion;
  std::tuple<Array<float>, Array<double>> Targets; ///< The targets of the last motion, copied.
  RefinedMesh<float> RefinedFloats; ///< Used if coordinates are floats, else the next one.
  RefinedMesh<double> RefinedDoubles;
  OrientationSample Orientations;
  std::unique_ptr<FlipLoop> Loop;
  FlipReport Report;
};

}

#endif
