// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHONBACKEND_H
#define DELAUNAYFLIP_MESHONBACKEND_H

#include "Array.h"
#include "EdgeMesh.h"
#include "EdgeMeshBuilder.h"
#include "FlipLoopChoice.h"
#include "GeometryChoice.h"
#include "InputChecks.h"
#include "LoadedMesh.h"
#include "MeshSurvey.h"
#include "MeshSurveyBuilder.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// Sets the ids of a triangle in the caller's slot, if the target includes it.
struct StoreStep
{
  const TriangleRecord* Triangles;
  SpatialOrderView Order;

  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const Target& target) const
  {
    if (HasTriangle(target, this->Triangles[t].InputTriangle))
    {
      for (int slot = 0; slot < 3; ++slot)
      {
        this->StoreId(t, slot, target);
      }
    }
  }

  /// Sets one of the three ids.
  template <typename Target>
  DELAUNAYFLIP_HOST_DEVICE void StoreId(std::int64_t t, int slot, const Target& target) const
  {
    const TriangleRecord& triangle = this->Triangles[t];
    target.Set(triangle.InputTriangle, slot, this->Order.GetVertex(triangle.Vertices[slot]));
  }
};

/// Sets the number of flips of a triangle in the caller's slot.
struct FlipCountStep
{
  const TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, const OutputSlice& target) const
  {
    target.Set(this->Triangles[t].InputTriangle, this->Triangles[t].Flips / OneFlip);
  }
};

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
    const MeshInput input{ mesh, local.View(), local.IsOnHost };
    MeshSurvey survey = BuildMeshSurvey(input, options.Geometry, this->Backend);
    CheckTieRule(options, survey.Geometry);
    progress.Reach(survey.Geometry, BuildStep::Surveyed);
    this->Order = OrderMesh(input, survey, this->Backend);
    progress.Reach(survey.Geometry, BuildStep::Ordered);
    const bool isSurface = survey.Geometry == GeometryKind::Surface;
    if (!isSurface)
    {
      this->PackPoints(local, survey, options.Criterion);
    }
    const EdgeMeshInput edges{ input, survey, this->Order, options.FeatureAngle };
    EdgeMesh loaded = this->LoadTriangles(edges, local);
    survey.Uses = Array<PointUse>();
    progress.Reach(survey.Geometry, BuildStep::Loaded);
    EdgeMeshResult built = BuildEdgeMesh(edges, std::move(loaded), this->Backend, progress);
    progress.Reach(survey.Geometry, BuildStep::Fixed);
    if (isSurface)
    {
      this->PackPoints(local, survey, options.Criterion);
    }
    local.DropRegions();
    this->Order.RankOfVertex = Array<VertexId>();
    this->Mesh = std::move(built.Edges);
    this->Turns = survey.Turns;
    FlipReport& report = this->Report;
    report.Points = mesh.Points.Count;
    report.Triangles = mesh.Triangles.Count;
    report.Edges = built.Counts;
    report.UnmatchedConstraints = built.MissingConstraints;
    report.EulerCharacteristic = survey.UsedPoints - built.Counts.Edges + mesh.Triangles.Count;
    report.GeometryUsed = survey.Geometry;
    report.GeometryReason = survey.GeometryReason;
    report.Tolerance = DescribeTolerance(options, survey.Geometry);
    report.Backend = this->Backend.GetName();
    Array<unsigned char> shared = this->RankSharedPoints(mesh);
    FlipLoopResult made = ChooseFlipLoop(
      { this->Points, survey, options, this->Report, this->Mesh, mesh.Whole, shared },
      std::move(built.Table), this->Backend);
    this->Loop = std::move(made.Loop);
    std::vector<Defect> defects{ survey.NonFinitePoints, survey.RepeatedIds,
      survey.NearlyHeightField, built.DuplicateTriangles,
      { "constraint edges that are not edges of the mesh", built.MissingConstraints, {},
        DefectIds::Points } };
    defects.insert(defects.end(), made.Defects.begin(), made.Defects.end());
    std::copy_if(defects.begin(), defects.end(), std::back_inserter(report.Defects),
      [](const Defect& defect) { return defect.Count > 0; });
  }

  std::unique_ptr<DeviceScope> MakeCurrent() const override { return this->Backend.MakeCurrent(); }

  FlipLoop& GetLoop() override { return *this->Loop; }

  const FlipReport& GetInputReport() const override { return this->Report; }

  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Backend.StoreTriangles(triangles, this->GetStoreStep());
  }

  void StoreFlipCounts(std::int32_t* counts) const override
  {
    this->Backend.StoreValues(this->Mesh.NumberOfTriangles, counts, this->GetFlipCountStep());
  }

  HostTriangles ViewHostTriangles() const override
  {
    return BackendT::IsOnHost ? HostTriangles{ this->Mesh.Triangles.Data(),
      this->Mesh.CornerOfHalfEdge.Data(), this->Order.View(), this->Mesh.NumberOfTriangles,
      this->Mesh.NumberOfEdges, this->Loop.get() }
                              : HostTriangles();
  }

  Defect FindTurnedTriangles() const override
  {
    const bool wasHeightField =
      this->Report.GeometryUsed == GeometryKind::Surface && this->Turns.AreNearlyUniform();
    return wasHeightField
      ? delaunayflip::FindTurnedTriangles(this->Mesh, this->Points, this->Turns, this->Backend)
      : Defect();
  }

  void Audit() const override { RequireConsistent(this->Mesh, this->Backend); }

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
  FlipCountStep GetFlipCountStep() const { return { this->Mesh.Triangles.Data() }; }

private:
  /// In the plane the caller's points are not needed once they are packed; on surfaces feature
  /// edges are found first.
  void PackPoints(LocalMesh& local, const MeshSurvey& survey, CriterionKind criterion)
  {
    const PointArray points = local.View().Points;
    this->Points = delaunayflip::PackPoints(points, this->Order.View(),
      PlanPacking(survey, criterion, points.Floats != nullptr), this->Backend);
    local.DropPoints();
  }

  /// This is the peak of memory use, with the caller's triangles and the engine's. So a device
  /// first frees what can be recomputed.
  EdgeMesh LoadTriangles(const EdgeMeshInput& edges, LocalMesh& local)
  {
    if (BackendT::MemoryIsScarce)
    {
      this->Order.DropVertices();
    }
    EdgeMesh loaded = delaunayflip::LoadTriangles(edges, this->Backend);
    local.DropTriangles();
    this->Order.TriangleOfRank = Array<TriangleId>();
    if (BackendT::MemoryIsScarce)
    {
      this->Order.RestoreVertices(this->Backend);
    }
    return loaded;
  }

  BackendT Backend;
  SpatialOrder Order;
  EdgeMesh Mesh;
  PackedPoints Points;
  TurnCounts Turns;
  std::unique_ptr<FlipLoop> Loop;
  FlipReport Report;
};

}

#endif
