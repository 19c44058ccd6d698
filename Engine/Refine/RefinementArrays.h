// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTARRAYS_H
#define DELAUNAYFLIP_REFINEMENTARRAYS_H

#include "Array.h"
#include "MeshBorders.h"
#include "MeshRoom.h"
#include "OldPlace.h"
#include "RefinementItem.h"
#include "RefinementPlan.h"
#include "RefinementStep.h"
#include "RefinementStore.h"
#include "RefinementView.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

/// @file
/// What refinement keeps beside a mesh: arrays by triangle, edge and vertex, and the mesh before
/// refinement, in which the data of new vertices is interpolated.

namespace delaunayflip
{

/// A triangle with the cotangent of its smallest angle.
struct GradedTriangle
{
  double Cotangent;
  TriangleId Triangle;

  bool operator<(const GradedTriangle& other) const
  {
    const bool isSame = this->Cotangent == other.Cotangent;
    return isSame ? this->Triangle < other.Triangle : this->Cotangent > other.Cotangent;
  }
};

/// 1 if a triangle does not reach the goals, else 0.
struct UnrefinedTest
{
  RefinementView View;
  bool IsOfCaller; ///< RefinementPlan's.

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t t) const
  {
    const auto triangle = static_cast<TriangleId>(t);
    if (this->View.IsKept(triangle))
    {
      return this->View.FindShape(triangle) >= ShapeKind::Bad ? 1 : 0;
    }
    return this->IsOfCaller && this->IsBadThoughFrozen(triangle) ? 1 : 0;
  }

private:
  /// Whether a triangle that refinement leaves as it is in the caller's mesh misses the goals. A
  /// triangle that is not counter-clockwise is another defect.
  DELAUNAYFLIP_HOST_DEVICE bool IsBadThoughFrozen(TriangleId triangle) const
  {
    const TriangleShape shape(this->View.Mesh, triangle);
    return shape.Cross > 0.0 &&
      (this->View.IsTooLarge(triangle, shape) || shape.IsSharperThan(this->View.Goals.Cotangent));
  }
};

/// The arrays, owned.
template <typename Real, typename Backend>
class RefinementArrays
{
public:
  RefinementArrays(
    const GrowingMesh<Real>& grown, const RefinementPlan& plan, const Backend& backend)
    : Device(backend),
      Goals(plan.Goals),
      FirstVertex(grown.Vertices),
      FirstId(grown.FirstId),
      HasRegions(!plan.Regions.empty()),
      IsOfCaller(plan.IsOfCaller),
      OldEdges(grown.Mesh->NumberOfEdges)
  {
    this->KeepOldMesh(grown);
    this->MakeTriangleArrays(grown, plan);
    this->FindSmallest(grown);
    this->SegmentOfEdge = backend.template MakeArray<std::uint32_t>(this->OldEdges);
    this->FixBorders(grown);
    if (plan.HasNonManifold)
    {
      this->MarkNonManifold(grown);
    }
    this->ListSegments(grown, plan.KeepsBoundary);
    this->MakeVertexArrays(grown, plan);
  }

  RefinementView View(const GrowingMesh<Real>& grown, std::int32_t* failed)
  {
    PlaneMesh plane = grown.View();
    plane.Failed = failed;
    return { plane, this->Goals, std::is_same<Real, float>::value, this->Smallest,
      this->Shapes.Data(), this->GetRegions(), this->AreaOfRegion.Data(), this->Sizes.Data(),
      this->Segments.Data(), this->Marks.Data(), this->Origins.Data(), this->SegmentOfEdge.Data(),
      this->OriginOfVertex.Data(), this->Ends.Data(), this->IsSharp.Data(), this->Features.Data() };
  }

  std::int64_t CountSegments() const { return this->NumberOfSegments; }
  std::uint64_t* GetClaims() { return this->Claims.Data(); }

  /// For each vertex that the last round has added, a triangle that it has split.
  const TriangleId* GetSplits() const { return this->Splits.Data(); }

  /// Makes room for what a round adds.
  RefinementStore<Real> MakeRoom(
    GrowingMesh<Real>& grown, const RefinementNumbers& added, std::int32_t* failed)
  {
    const RefinementNumbers before = { grown.Vertices, grown.Mesh->NumberOfTriangles,
      grown.Mesh->NumberOfEdges, this->NumberOfSegments };
    const Backend& backend = this->Device;
    Reserve(*grown.Coordinates, 2 * before.Vertex, 2 * (before.Vertex + added.Vertex), backend);
    Reserve(*grown.Ids, before.Vertex, before.Vertex + added.Vertex, backend);
    Reserve(this->OriginOfVertex, before.Vertex, before.Vertex + added.Vertex, backend);
    Reserve(this->IsSharp, before.Vertex, before.Vertex + added.Vertex, backend);
    if (this->Sizes.Size() > 0)
    {
      Reserve(this->Sizes, before.Vertex, before.Vertex + added.Vertex, backend);
    }
    if (this->Features.Size() > 0)
    {
      Reserve(this->Features, before.Vertex, before.Vertex + added.Vertex, backend);
    }
    const std::int64_t vertices = before.Vertex - this->FirstVertex;
    Reserve(this->OldTriangleOf, vertices, vertices + added.Vertex, backend);
    Reserve(this->Shapes, before.Triangle, before.Triangle + added.Triangle, backend);
    if (this->GetRegions())
    {
      Reserve(this->Regions, before.Triangle, before.Triangle + added.Triangle, backend);
    }
    Reserve(this->Claims, before.Triangle, before.Triangle + added.Triangle, backend);
    Reserve(this->SegmentOfEdge, before.Edge, before.Edge + added.Edge, backend);
    Reserve(this->Segments, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Marks, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Origins, before.Subsegment, before.Subsegment + added.Subsegment, backend);
    Reserve(this->Splits, 0, added.Vertex, backend);
    const PlaneMesh old = this->ViewOld(grown, failed);
    return { TriangleSplitter(grown.Mesh->View()), before, grown.Coordinates->Data(),
      grown.Ids->Data(), this->FirstId, this->FirstVertex, this->Shapes.Data(), this->GetRegions(),
      this->Sizes.Data(), this->Features.Data(), this->Claims.Data(), this->Segments.Data(),
      this->Marks.Data(), this->Origins.Data(), this->SegmentOfEdge.Data(),
      this->OriginOfVertex.Data(), this->Ends.Data(), this->IsSharp.Data(), this->Splits.Data(),
      this->OldTriangleOf.Data(), old, static_cast<std::int64_t>(this->OldTriangles.Size()),
      this->Grid.View(), this->IsOfCaller };
  }

  /// The mesh before refinement.
  PlaneMesh ViewOld(const GrowingMesh<Real>& grown, std::int32_t* failed)
  {
    PlaneMesh old = grown.View();
    old.Edges = { this->OldTriangles.Data(), this->OldCorners.Data(), nullptr };
    old.Failed = failed;
    return old;
  }

  /// In a mesh of the caller: finds in which triangles the winning places were before refinement.
  void FindOldPlaces(
    const GrowingMesh<Real>& grown, RefinementItem* items, std::int64_t count, std::int32_t* failed)
  {
    if (!this->IsOfCaller)
    {
      return;
    }
    const OldPlaceFinder finder = this->MakeFinder(grown, failed);
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        RefinementItem& item = items[i];
        if (item.State == ItemState::Wins)
        {
          item.Old = finder.Find(item.Found.Triangle, item.Place);
        }
      });
  }

  /// Fixes edges that are bad but cannot flip, after a round in a mesh that needs a guard.
  void FixBlocked(const GrowingMesh<Real>& grown)
  {
    const FixWallStep step{ grown.Mesh->View(), nullptr, nullptr, this->SegmentOfEdge.Data() };
    this->Device.ForEach(grown.Mesh->NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e) { step(static_cast<EdgeId>(e)); });
  }

  /// Lets edges flip again that were fixed for refinement alone. @returns how many there are.
  /// @param keepsMesh whether to keep the mesh for Fetch, because flips follow.
  std::int64_t FreeEdges(const GrowingMesh<Real>& grown, bool keepsMesh)
  {
    const EdgeMeshView mesh = grown.Mesh->View();
    const std::int64_t edges = this->IsOfCaller ? grown.Mesh->NumberOfEdges : 0;
    const FixedMeanwhileTest isFixed{ mesh, this->SegmentOfEdge.Data(), this->Marks.Data() };
    const typename Backend::Numbering numbering = this->Device.Count(edges, isFixed);
    this->Freed = this->Device.template MakeArray<EdgeId>(numbering.Total);
    EdgeId* freed = this->Freed.Data();
    this->Device.ForEachNumbered(numbering, edges, isFixed,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t number)
      {
        if (isFixed(e) != 0)
        {
          freed[number] = static_cast<EdgeId>(e);
        }
      });
    if (keepsMesh && numbering.Total > 0)
    {
      this->LastTriangles = this->Copy(mesh.Triangles, grown.Mesh->NumberOfTriangles);
      this->LastCorners = this->Copy(mesh.CornerOfHalfEdge, 2 * edges);
      this->LastStates = this->Copy(mesh.States, edges);
    }
    this->SetFreed(grown, EdgeState::Candidate);
    return numbering.Total;
  }
  /// Fixes the edges that FreeEdges has freed last, if none has flipped since.
  void FixFreed(const GrowingMesh<Real>& grown)
  {
    this->SetFreed(grown, EdgeState::Fixed);
    this->Freed = Array<EdgeId>();
  }

  /// Notes what a round has added.
  void Added(GrowingMesh<Real>& grown, std::int64_t vertices, std::int64_t subsegments)
  {
    grown.Vertices += vertices;
    this->NumberOfSegments += subsegments;
  }

  /// Tells a visitor of the vertices that were added.
  void VisitVertices(const GrowingMesh<Real>& grown, const RefinedVertexVisitor& visit)
  {
    const std::int64_t added = grown.Vertices - this->FirstVertex;
    const VertexNaming naming = this->GetNaming(grown);
    if constexpr (Backend::IsOnHost)
    {
      this->Device.ForEach(added, VisitVertex{ naming, visit });
    }
    else
    {
      Array<RefinedVertex> vertices = this->Device.template MakeArray<RefinedVertex>(added);
      RefinedVertex* to = vertices.Data();
      this->Device.ForEach(
        added, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = naming.Name(i); });
      this->Device.Receive(to, added, visit);
    }
  }

  RefinementResult Fetch(const GrowingMesh<Real>& grown)
  {
    RefinementResult result;
    result.Added = grown.Vertices - this->FirstVertex;
    if (this->IsOfCaller)
    {
      this->FetchOfCaller(grown, result);
      result.Vertices.resize(result.Added);
      this->VisitVertices(
        grown, [&](std::int64_t i, const RefinedVertex& vertex) { result.Vertices[i] = vertex; });
    }
    else if (this->HasRegions)
    {
      result.Regions.resize(grown.Mesh->NumberOfTriangles);
      this->Device.Download(
        this->Regions.Data(), grown.Mesh->NumberOfTriangles, result.Regions.data());
    }
    result.Segments.resize(this->NumberOfSegments);
    const Array<Subsegment> segments = this->NameSegments(grown);
    this->Device.Download(segments.Data(), this->NumberOfSegments, result.Segments.data());
    this->FindUnrefined(grown, result);
    return result;
  }

  // The functions below are public because device lambdas require it.

  /// The regions, or null if all triangles are in region 0 and kept.
  std::int32_t* GetRegions()
  {
    return this->HasRegions || this->IsOfCaller ? this->Regions.Data() : nullptr;
  }

  void SetFreed(const GrowingMesh<Real>& grown, EdgeState state)
  {
    EdgeState* states = grown.Mesh->View().States;
    const EdgeId* freed = this->Freed.Data();
    this->Device.ForEach(static_cast<std::int64_t>(this->Freed.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { states[freed[i]] = state; });
  }

  template <typename Value>
  Array<Value> Copy(const Value* from, std::int64_t count) const
  {
    Array<Value> copy = this->Device.template MakeArray<Value>(count);
    Value* to = copy.Data();
    this->Device.ForEach(count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = from[i]; });
    return copy;
  }

  void KeepOldMesh(const GrowingMesh<Real>& grown)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    const std::int64_t halfEdges = 2 * grown.Mesh->NumberOfEdges;
    this->Grid = BuildPlaceGrid(grown.View(), triangles, this->Device);
    const EdgeMeshView mesh = grown.Mesh->View();
    this->OldTriangles = this->Copy(mesh.Triangles, triangles);
    this->OldCorners = this->Copy(mesh.CornerOfHalfEdge, halfEdges);
  }

  void MakeTriangleArrays(const GrowingMesh<Real>& grown, const RefinementPlan& plan)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    this->Shapes = this->Device.template MakeArray<std::uint32_t>(triangles);
    this->Regions = this->Device.template MakeArray<std::int32_t>(triangles);
    this->Claims = this->Device.template MakeArray<std::uint64_t>(triangles);
    std::uint32_t* shapes = this->Shapes.Data();
    std::int32_t* regions = this->Regions.Data();
    std::uint64_t* claims = this->Claims.Data();
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        shapes[t] = static_cast<std::uint32_t>(ShapeKind::Unknown);
        regions[t] = 0;
        claims[t] = RefinementKey::None;
      });
    if (this->IsOfCaller)
    {
      this->TakeRegionsOfCaller(grown, plan);
    }
    else if (this->HasRegions)
    {
      this->Device.Upload(plan.Regions.data(), triangles, regions);
    }
    const auto labels = static_cast<std::int64_t>(plan.LabelOfRegion.size());
    if (labels > 0)
    {
      this->LabelOfRegion = this->Device.template MakeArray<std::int32_t>(labels);
      this->Device.Upload(plan.LabelOfRegion.data(), labels, this->LabelOfRegion.Data());
    }
    const auto areas = static_cast<std::int64_t>(plan.AreaOfRegion.size());
    if (areas > 0)
    {
      this->AreaOfRegion = this->Device.template MakeArray<double>(areas);
      this->Device.Upload(plan.AreaOfRegion.data(), areas, this->AreaOfRegion.Data());
    }
  }

  /// Finds by the size of the kept triangles which coordinates become 0. Exact arithmetic on a
  /// device needs coordinates of similar magnitudes.
  void FindSmallest(const GrowingMesh<Real>& grown)
  {
    const PlaneMesh plane = grown.View();
    const std::int32_t* regions = this->Regions.Data();
    PlaceGridFrame frame;
    frame.Box = this->Device.template Sum<PlaceBox>(grown.Mesh->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, PlaceBox & sum)
      {
        for (int slot = 0; slot < 3 && regions[t] >= 0; ++slot)
        {
          sum.Include(plane.GetPoint(plane.Edges.Triangles[t].Vertices[slot]));
        }
      });
    constexpr double Share = 0x1p-60;
    this->Smallest = Share / frame.GetScale();
  }

  /// In a mesh of the caller: takes the caller's regions, and marks triangles that are not
  /// counter-clockwise as removed.
  void TakeRegionsOfCaller(const GrowingMesh<Real>& grown, const RefinementPlan& plan)
  {
    Array<std::int32_t> given;
    if (this->HasRegions)
    {
      const std::int64_t count = SizeOf(plan.Regions);
      given = this->Device.template MakeArray<std::int32_t>(count);
      this->Device.Upload(plan.Regions.data(), count, given.Data());
    }
    Array<std::int32_t> failed = this->MakeFailed();
    PlaneMesh plane = grown.View();
    plane.Failed = failed.Data();
    const CallerRegionStep step{ plane, given.Data(), this->Regions.Data() };
    this->Device.ForEach(grown.Mesh->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { step(static_cast<TriangleId>(t)); });
    this->RequireDecided(failed);
  }

  Array<std::int32_t> MakeFailed() const
  {
    const std::int32_t none = 0;
    Array<std::int32_t> failed = this->Device.template MakeArray<std::int32_t>(1);
    this->Device.Upload(&none, 1, failed.Data());
    return failed;
  }
  /// @throws BeyondDevice if a device could not decide an orientation.
  void RequireDecided(const Array<std::int32_t>& failed) const
  {
    std::int32_t hasFailed = 0;
    this->Device.Download(failed.Data(), 1, &hasFailed);
    if (hasFailed != 0)
    {
      throw BeyondDevice();
    }
  }

  /// Fixes the edges between kept and removed triangles. In a mesh of the caller it fixes all edges
  /// of removed triangles, and edges that are bad but cannot flip.
  void FixBorders(const GrowingMesh<Real>& grown)
  {
    const EdgeMeshView mesh = grown.Mesh->View();
    const std::int32_t* regions = this->Regions.Data();
    if (this->IsOfCaller)
    {
      this->MarksOfEdges = this->Device.template MakeArray<std::uint8_t>(this->OldEdges);
      const FixWallStep step{ mesh, regions, this->MarksOfEdges.Data(),
        this->SegmentOfEdge.Data() };
      this->Device.ForEach(this->OldEdges,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e) { step(static_cast<EdgeId>(e)); });
      return;
    }
    this->Device.ForEach(this->HasRegions ? grown.Mesh->NumberOfEdges : 0,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e)
      {
        const CornerPair corners = mesh.GetCorners(static_cast<EdgeId>(e));
        const bool isBorder = corners.A != NoCorner && corners.B != NoCorner &&
          (regions[TriangleOf(corners.A)] < 0) != (regions[TriangleOf(corners.B)] < 0);
        if (isBorder)
        {
          mesh.States[e] = EdgeState::Fixed;
        }
      });
  }

  /// Marks non-manifold edges in a mesh of the caller, which are not split because several records
  /// stand for each.
  void MarkNonManifold(const GrowingMesh<Real>& grown)
  {
    std::vector<TriangleRecord> triangles(grown.Mesh->NumberOfTriangles);
    std::vector<CornerId> corners(2 * this->OldEdges);
    std::vector<std::uint8_t> marks(this->OldEdges);
    this->Device.Download(this->OldTriangles.Data(), SizeOf(triangles), triangles.data());
    this->Device.Download(this->OldCorners.Data(), SizeOf(corners), corners.data());
    this->Device.Download(this->MarksOfEdges.Data(), SizeOf(marks), marks.data());
    MarkRepeatedEdges(triangles, corners, marks);
    this->Device.Upload(marks.data(), SizeOf(marks), this->MarksOfEdges.Data());
  }

  void ListSegments(const GrowingMesh<Real>& grown, bool keepsBoundary)
  {
    const std::int64_t edges = grown.Mesh->NumberOfEdges;
    const PlaneMesh plane = grown.View();
    const SegmentTest isSegment{ plane.Edges, this->Regions.Data() };
    const typename Backend::Numbering numbering = this->Device.Count(edges, isSegment);
    this->NumberOfSegments = numbering.Total;
    this->SegmentsBefore = numbering.Total;
    this->Segments = this->Device.template MakeArray<EdgeId>(numbering.Total);
    this->Marks = this->Device.template MakeArray<std::uint8_t>(numbering.Total);
    this->Origins = this->Device.template MakeArray<std::uint32_t>(numbering.Total);
    this->Ends = this->Device.template MakeArray<VertexId>(2 * numbering.Total);
    std::uint8_t* marks = this->Marks.Data();
    std::uint32_t* origins = this->Origins.Data();
    std::uint32_t* segmentOfEdge = this->SegmentOfEdge.Data();
    EdgeId* segments = this->Segments.Data();
    VertexId* ends = this->Ends.Data();
    const std::uint8_t* marksOfEdges = this->MarksOfEdges.Data();
    this->Device.ForEachNumbered(numbering, edges, isSegment,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t number)
      {
        if (isSegment(e) == 0)
        {
          return;
        }
        const bool isBoundary = isSegment.CountKept(e) == 1;
        marks[number] = marksOfEdges ? marksOfEdges[e] : 0;
        const bool staysForNow = (marks[number] & CannotSplit) != 0;
        if (keepsBoundary && isBoundary && !staysForNow)
        {
          marks[number] |= CannotSplit | KeptBoundary;
        }
        origins[number] = static_cast<std::uint32_t>(number);
        segmentOfEdge[e] = static_cast<std::uint32_t>(number);
        segments[number] = static_cast<EdgeId>(e);
        const CornerPair corners = plane.Edges.GetCorners(static_cast<EdgeId>(e));
        const auto side = static_cast<HalfEdgeId>(2 * e + (corners.A == NoCorner ? 1 : 0));
        ends[2 * number] = plane.GetStart(side);
        ends[2 * number + 1] = plane.GetEnd(side);
      });
  }

  void MakeVertexArrays(const GrowingMesh<Real>& grown, const RefinementPlan& plan)
  {
    const std::int64_t vertices = grown.Vertices;
    this->OriginOfVertex = this->Device.template MakeArray<std::uint32_t>(vertices);
    this->IsSharp = this->Device.template MakeArray<std::uint8_t>(vertices);
    std::uint32_t* origins = this->OriginOfVertex.Data();
    this->Device.ForEach(
      vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { origins[i] = NoOrigin; });
    if (this->IsOfCaller)
    {
      this->ListStarts(grown);
    }
    this->MarkSharpCorners(grown);
    if (this->Goals.MayNotEnd)
    {
      this->FindFeatures(grown);
    }
    const auto points = static_cast<std::int64_t>(plan.Sizes.size());
    if (points > 0)
    {
      Array<double> byPoint = this->Device.template MakeArray<double>(points);
      this->Device.Upload(plan.Sizes.data(), points, byPoint.Data());
      this->Sizes = this->Device.template MakeArray<double>(vertices);
      const double* from = byPoint.Data();
      double* sizes = this->Sizes.Data();
      const VertexId* ids = grown.Ids->Data();
      this->Device.ForEach(
        vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { sizes[i] = from[ids[i]]; });
    }
  }

  /// Finds the least feature at each vertex: the length of an edge, or the height of a triangle.
  void FindFeatures(const GrowingMesh<Real>& grown)
  {
    this->Features = this->Device.template MakeArray<double>(grown.Vertices);
    double* features = this->Features.Data();
    const PlaneMesh plane = grown.View();
    this->Device.ForEach(
      grown.Vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { features[i] = INFINITY; });
    this->Device.ForEach(grown.Mesh->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        const TriangleShape shape(plane, static_cast<TriangleId>(t));
        const double height = shape.Cross * shape.Cross / shape.SquaredLongest;
        for (const VertexId vertex : plane.Edges.Triangles[t].Vertices)
        {
          AtomicMin(reinterpret_cast<std::uint64_t*>(&features[vertex]), ToSortableBits(height));
        }
      });
  }

  void MarkSharpCorners(const GrowingMesh<Real>& grown)
  {
    Array<std::uint32_t> sectors = this->Device.template MakeArray<std::uint32_t>(grown.Vertices);
    std::uint32_t* sectorsOf = sectors.Data();
    std::uint8_t* isSharp = this->IsSharp.Data();
    this->Device.ForEach(grown.Vertices,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        isSharp[i] = 0;
        sectorsOf[i] = 0;
      });
    const SharpCornerStep step{ grown.View(), this->Regions.Data(), isSharp, sectorsOf };
    const EdgeId* segments = this->Segments.Data();
    this->Device.ForEach(2 * this->NumberOfSegments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { step(2 * segments[i / 2] + static_cast<HalfEdgeId>(i % 2)); });
    this->Device.ForEach(grown.Vertices,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (isSharp[i] == SharpCorner && sectorsOf[i] == 1)
        {
          isSharp[i] = LoneSharpCorner;
        }
      });
  }

  /// Finds a corner of a kept triangle for each vertex of a mesh of the caller.
  void ListStarts(const GrowingMesh<Real>& grown)
  {
    this->StartOfVertex = this->Device.template MakeArray<CornerId>(grown.Vertices);
    CornerId* starts = this->StartOfVertex.Data();
    this->Device.ForEach(
      grown.Vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { starts[i] = NoCorner; });
    const TriangleRecord* triangles = this->OldTriangles.Data();
    const std::int32_t* regions = this->Regions.Data();
    this->Device.ForEach(grown.Mesh->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (int slot = 0; slot < 3 && regions[t] >= 0; ++slot)
        {
          AtomicMin(
            &starts[triangles[t].Vertices[slot]], MakeCorner(static_cast<TriangleId>(t), slot));
        }
      });
  }

  OldPlaceFinder MakeFinder(const GrowingMesh<Real>& grown, std::int32_t* failed)
  {
    PlaneMesh now = grown.View();
    if (this->LastTriangles.Size() > 0)
    {
      now.Edges = { this->LastTriangles.Data(), this->LastCorners.Data(), this->LastStates.Data() };
    }
    now.Failed = failed;
    now.IsInFilterRange = false; // places may be nearer to 0
    PlaneMesh old = this->ViewOld(grown, failed);
    old.IsInFilterRange = false;
    return { now, old, this->SegmentOfEdge.Data(), this->Origins.Data(), this->Segments.Data(),
      this->StartOfVertex.Data(), this->OldTriangleOf.Data(),
      static_cast<VertexId>(this->FirstVertex) };
  }

  /// Fetches what only a mesh of the caller has. @throws BeyondDevice.
  void FetchOfCaller(const GrowingMesh<Real>& grown, RefinementResult& result)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    Array<std::int32_t> failed = this->MakeFailed();
    Array<TriangleId> sources = this->Device.template MakeArray<TriangleId>(triangles);
    const SourceStep step{ this->MakeFinder(grown, failed.Data()), grown.Mesh->View(),
      this->Regions.Data(), static_cast<std::int64_t>(this->OldTriangles.Size()), sources.Data() };
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { step(static_cast<TriangleId>(t)); });
    result.Sources.resize(triangles);
    this->Device.Download(sources.Data(), triangles, result.Sources.data());
    if (this->LastTriangles.Size() > 0)
    {
      this->JudgeFlipped(grown, failed.Data());
    }
    this->RequireDecided(failed);
    const EdgeMeshView mesh = grown.Mesh->View();
    const EdgeId* added = this->Segments.Data() + this->SegmentsBefore;
    const BorderSums sums =
      this->Device.template Sum<BorderSums>(this->NumberOfSegments - this->SegmentsBefore,
        BorderCount{ mesh, this->Regions.Data(), this->LabelOfRegion.Data(), added });
    result.Edges = grown.Mesh->NumberOfEdges - this->OldEdges;
    result.BoundaryEdges = sums.Boundary;
    result.RegionEdges = sums.Regions;
    result.Ends.resize(2 * this->SegmentsBefore);
    const Array<VertexId> ends = this->NameEnds(grown);
    this->Device.Download(ends.Data(), SizeOf(result.Ends), result.Ends.data());
  }

  /// Finds which triangles of the last flips are counter-clockwise now, and forgets the mesh before
  /// these.
  void JudgeFlipped(const GrowingMesh<Real>& grown, std::int32_t* failed)
  {
    PlaneMesh plane = grown.View();
    plane.Failed = failed;
    std::int32_t* regions = this->Regions.Data();
    const CallerRegionStep step{ plane, nullptr, regions };
    const TriangleRecord* before = this->LastTriangles.Data();
    this->Device.ForEach(grown.Mesh->NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        if (before[t].Flips != plane.Edges.Triangles[t].Flips)
        {
          step.Judge(static_cast<TriangleId>(t), GetRegion(regions[t]));
        }
      });
    this->LastTriangles = Array<TriangleRecord>();
    this->LastCorners = Array<CornerId>();
    this->LastStates = Array<EdgeState>();
  }

  /// The points at the ends of the original segments.
  Array<VertexId> NameEnds(const GrowingMesh<Real>& grown) const
  {
    Array<VertexId> named = this->Device.template MakeArray<VertexId>(2 * this->SegmentsBefore);
    VertexId* to = named.Data();
    const VertexId* from = this->Ends.Data();
    const VertexId* ids = grown.Ids->Data();
    this->Device.ForEach(2 * this->SegmentsBefore,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { to[i] = ids[from[i]]; });
    return named;
  }

  VertexNaming GetNaming(const GrowingMesh<Real>& grown)
  {
    return { { this->ViewOld(grown, nullptr), this->Ends.Data() }, grown.View(), this->FirstVertex,
      this->OriginOfVertex.Data(), this->OldTriangleOf.Data(), grown.Ids->Data() };
  }

  Array<Subsegment> NameSegments(const GrowingMesh<Real>& grown) const
  {
    Array<Subsegment> named = this->Device.template MakeArray<Subsegment>(this->NumberOfSegments);
    Subsegment* to = named.Data();
    const EdgeId* segments = this->Segments.Data();
    const std::uint32_t* origins = this->Origins.Data();
    const PlaneMesh plane = grown.View();
    this->Device.ForEach(this->NumberOfSegments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const HalfEdgeId even = 2 * segments[i];
        if (plane.Edges.CornerOfHalfEdge[even] != NoCorner)
        {
          to[i] = { segments[i], origins[i], plane.GetStart(even), plane.GetEnd(even) };
        }
        else
        {
          to[i] = { segments[i], origins[i], plane.GetEnd(even + 1), plane.GetStart(even + 1) };
        }
      });
    return named;
  }

  /// Lists the bad triangles that cannot get better, or that the limit has left.
  void FindUnrefined(const GrowingMesh<Real>& grown, RefinementResult& result)
  {
    const RefinementView view = this->View(grown, nullptr);
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    const UnrefinedTest isUnrefined{ view, this->IsOfCaller };
    const typename Backend::Numbering numbering = this->Device.Count(triangles, isUnrefined);
    result.Unrefined = numbering.Total;
    if (numbering.Total == 0)
    {
      return;
    }
    Array<GradedTriangle> left = this->Device.template MakeArray<GradedTriangle>(numbering.Total);
    GradedTriangle* to = left.Data();
    this->Device.ForEachNumbered(numbering, triangles, isUnrefined,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        if (isUnrefined(t) != 0)
        {
          const TriangleShape shape(view.Mesh, static_cast<TriangleId>(t));
          to[number] = { shape.Dot / shape.Cross, view.Mesh.Edges.Triangles[t].InputTriangle };
        }
      });
    std::vector<GradedTriangle> onHost(numbering.Total);
    this->Device.Download(left.Data(), numbering.Total, onHost.data());
    const std::size_t named = std::min<std::size_t>(onHost.size(), 3);
    std::partial_sort(
      onHost.begin(), onHost.begin() + static_cast<std::ptrdiff_t>(named), onHost.end());
    for (std::size_t i = 0; i < named; ++i)
    {
      result.FirstUnrefined.push_back(onHost[i].Triangle);
    }
  }

private:
  const Backend& Device;
  RefinementGoals Goals;
  double Smallest = 0.0; ///< See RefinementView.
  std::int64_t FirstVertex, FirstId;
  bool HasRegions, IsOfCaller;
  std::int64_t OldEdges, SegmentsBefore = 0, NumberOfSegments = 0;

  Array<std::uint32_t> Shapes; ///< See RefinementView for this one and the next.
  Array<std::int32_t> Regions; ///< Those of added triangles only if GetRegions is not null.
  Array<std::int32_t> LabelOfRegion; ///< RefinementPlan's.
  Array<double> AreaOfRegion, Sizes;
  Array<EdgeId> Segments;
  Array<std::uint8_t> Marks;
  Array<std::uint32_t> Origins, SegmentOfEdge, OriginOfVertex;
  Array<VertexId> Ends;
  Array<std::uint8_t> IsSharp;
  Array<double> Features;
  Array<std::uint64_t> Claims; ///< See RefinementStep.
  Array<TriangleId> Splits;
  Array<TriangleId> OldTriangleOf; ///< See RefinementStore.
  Array<CornerId> StartOfVertex; ///< See OldPlaceFinder.
  Array<std::uint8_t> MarksOfEdges; ///< In a mesh of the caller: the first marks of subsegments.

  PlaceGrid Grid; ///< That of the mesh before.
  Array<TriangleRecord> OldTriangles;
  Array<CornerId> OldCorners;

  Array<EdgeId> Freed; ///< What FreeEdges has freed.
  Array<TriangleRecord> LastTriangles; ///< The mesh before the flips that follow the last round.
  Array<CornerId> LastCorners;
  Array<EdgeState> LastStates;
};

}

#endif
