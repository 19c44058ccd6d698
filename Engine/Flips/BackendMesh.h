// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BACKENDMESH_H
#define DELAUNAYFLIP_BACKENDMESH_H

#include "Array.h"
#include "EdgeGuard.h"
#include "EdgeMesh.h"
#include "EdgeMeshBuilder.h"
#include "FlipRules.h"
#include "GeometryPasses.h"
#include "HiddenEdges.h"
#include "LoadedMesh.h"
#include "MeshSurvey.h"
#include "PlaceAsker.h"
#include "PlaneFrame.h"
#include "SegmentInsertion.h"
#include "SmallestAngle.h"
#include "SpatialOrder.h"
#include "StoreSteps.h"
#include "SurfaceAngles.h"
#include "TriangleCut.h"
#include "TriangleOrder.h"
#include "WideAngles.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// How many triangles have the less common orientation in x and y.
struct TurnedSums
{
  std::int64_t All = 0;
  IdSample Flipped; ///< Triangles that flips have made.

  DELAUNAYFLIP_HOST_DEVICE TurnedSums& operator+=(const TurnedSums& part)
  {
    this->All += part.All;
    this->Flipped += part.Flipped;
    return *this;
  }
};

/// A mesh in the memory of a backend, and the loop that flips its edges.
template <typename BackendT>
class BackendMesh : public LoadedMesh
{
public:
  std::unique_ptr<DeviceScope> MakeCurrent() const override { return this->Backend.MakeCurrent(); }

  FlipLoop& GetLoop() override { return *this->Loop; }

  const FlipReport& GetInputReport() const override { return this->Report; }

  void StoreTriangles(const MutableTriangleArray& triangles) const override
  {
    this->Backend.StoreTriangles(
      this->LimitToStored(triangles), this->GetStoreStep(), this->IsFromPoints);
  }

  void StoreOrderedTriangles(const MutableTriangleArray& triangles) const override
  {
    const Array<OrderedIds> listed =
      ListInOrder(this->Mesh, this->Order.View(), this->Report.Points, this->Backend);
    this->Backend.StoreTriangles(triangles, OrderedStoreStep{ listed.Data() }, true);
  }

  void StoreFlipCounts(std::int32_t* counts) const override
  {
    this->Backend.StoreValues(this->CountStored(), counts, this->GetFlipCountStep());
  }

  void StoreNeighbors(std::int32_t* neighbors) const override
  {
    const std::int64_t triangles = this->CountStored();
    if constexpr (BackendT::IsOnHost)
    {
      const OutputSlice all{ reinterpret_cast<std::uint32_t*>(neighbors), 0, 3 * triangles };
      this->Backend.ForEach(triangles, NeighborsStep{ this->GetNeighborStep(), all });
    }
    else
    {
      this->Backend.StoreValues(3 * triangles, neighbors, this->GetNeighborStep());
    }
  }

  void StoreUsedPoints(std::int64_t first, std::int64_t count, std::int64_t* ids) const override
  {
    const auto store = [=](std::int64_t i, VertexId used)
    { ids[i] = used == NoVertex ? -1 : std::int64_t(used); };
    const ThreadBackend& threads = this->Backend.GetThreads();
    if (this->UsedPoint.Size() == 0)
    {
      threads.ForEach(count, [=](std::int64_t i) { ids[i] = first + i; });
      return;
    }
    const VertexId* used = this->UsedPoint.Data() + first;
    if constexpr (BackendT::IsOnHost)
    {
      threads.ForEach(count, [=](std::int64_t i) { store(i, used[i]); });
    }
    else
    {
      this->Backend.Receive(used, count, store);
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

  KeptTriangles CutOff(const PointInput& input, const PointOptions& options,
    std::vector<SegmentEdge>& segments) override
  {
    this->RequireStates();
    TriangleCut<BackendT> cut(this->ViewHere(), this->Backend);
    KeptTriangles kept = cut.CutOff(
      input, options, segments, [this](const HostView& view) { this->ViewOnHost(view); });
    this->Kept = cut.TakeKept();
    return kept;
  }

  void NumberKept(const std::vector<std::int32_t>& regions, std::int64_t firstAdded,
    std::vector<SegmentEdge>& segments, KeptTriangles& kept) override
  {
    TriangleCut<BackendT> cut(this->ViewHere(), this->Backend);
    cut.NumberKept(regions, firstAdded, segments, kept);
    this->Kept = cut.TakeKept();
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

  std::vector<std::int64_t> FindEnds(const std::vector<HalfEdgeId>& sides) override
  {
    const auto count = static_cast<std::int64_t>(sides.size());
    std::vector<std::int64_t> ends(2 * sides.size());
    Array<HalfEdgeId> listed = this->Backend.template MakeArray<HalfEdgeId>(count);
    Array<std::int64_t> found = this->Backend.template MakeArray<std::int64_t>(2 * count);
    this->RequireStates();
    this->Backend.Upload(sides.data(), count, listed.Data());
    const HalfEdgeId* from = listed.Data();
    std::int64_t* to = found.Data();
    const PointMeshView view = this->ViewHere();
    this->Backend.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        to[2 * i] = view.Ids[view.GetStart(from[i])];
        to[2 * i + 1] = view.Ids[view.GetEnd(from[i])];
      });
    this->Backend.Download(to, 2 * count, ends.data());
    return ends;
  }

  /// Finds how many more triangles have the less common orientation than at first.
  Defect FindTurnedTriangles() const override
  {
    const OrientationSample& before = this->Orientations;
    if (!before.AreNearlyUniform()) // it never was a height field
    {
      return Defect();
    }
    const TriangleRecord* triangles = this->Mesh.Triangles.Data();
    const PackedPointsView packed = this->Points.View();
    const int side = before.GetSide(); // the orientation of most triangles at first
    const TurnedSums sums = this->Backend.template Sum<TurnedSums>(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, TurnedSums & sum)
      {
        const TriangleRecord& triangle = triangles[t];
        Vector3 a = packed.GetPosition(triangle.Vertices[0]);
        Vector3 b = packed.GetPosition(triangle.Vertices[1]);
        Vector3 c = packed.GetPosition(triangle.Vertices[2]);
        if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
        {
          return;
        }
        BringNearOne(a, b, c);
        if (FindOrientationXY(a, b, c) == -side)
        {
          ++sum.All;
          if (triangle.Flips >= OneFlip)
          {
            sum.Flipped.Note(triangle.InputTriangle);
          }
        }
      });
    Defect defect = MakeDefect(DefectKind::TurnedByFlips, sums.Flipped);
    defect.Detail = ", although the input was a height field or nearly one; if it is terrain, use "
                    "planar-xy";
    defect.Count = std::max<std::int64_t>(0, sums.All - before.GetOthers().Count);
    defect.FirstIds.resize(std::min<std::size_t>(defect.FirstIds.size(), defect.Count));
    return defect;
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

  /// Returns the place of each point of a mesh from points, or NoVertex. Public
  /// because device lambdas require it.
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

protected:
  const BackendT& GetBackend() const { return this->Backend; }
  StoredTriangles GetStored() const
  {
    return { this->Mesh.Triangles.Data(), this->Kept.Triangles.Data(), this->Kept.Numbers.Data() };
  }
  /// How many triangles are stored.
  std::int64_t CountStored() const
  {
    return this->Kept.Numbers.Size() > 0 ? static_cast<std::int64_t>(this->Kept.Triangles.Size())
                                         : this->Mesh.NumberOfTriangles;
  }
  /// The part of the caller's array that has room for the triangles that are stored.
  MutableTriangleArray LimitToStored(MutableTriangleArray triangles) const
  {
    triangles.Count = std::min(triangles.Count, this->CountStored());
    return triangles;
  }
  StoreStep GetStoreStep() const { return { this->GetStored(), this->Order.View() }; }
  NeighborStep GetNeighborStep() const
  {
    return { this->GetStored(), this->Mesh.CornerOfHalfEdge.Data() };
  }
  FlipCountStep GetFlipCountStep() const { return { this->GetStored() }; }

  explicit BackendMesh(BackendT backend)
    : Backend(std::move(backend))
  {
  }

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
    this->Loop->LeaveChunks();
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
  KeptArrays Kept; ///< What CutOff or NumberKept has left.
  OrientationSample Orientations;
  std::unique_ptr<FlipLoop> Loop;
  FlipReport Report;
};

}

#endif
