// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LIVINGMESH_H
#define DELAUNAYFLIP_LIVINGMESH_H

#include "BackendMesh.h"
#include "MeshMotion.h"
#include "PointGrowth.h"
#include "Refinement.h"

#include <algorithm>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// A mesh that grows and lives: points are inserted, moved and removed, and triangles are refined.
template <typename BackendT>
class LivingMesh : public BackendMesh<BackendT>
{
public:
  MotionResult InsertPoints(const std::vector<double>& places, bool keepsFixed) override
  {
    if (this->Mesh.NumberOfTriangles == 0)
    {
      return MotionResult();
    }
    this->RequireStates();
    return this->Places.Floats ? this->InsertHere(places, keepsFixed, this->Points.Floats)
                               : this->InsertHere(places, keepsFixed, this->Points.Doubles);
  }

  MotionResult RemovePoints(
    const std::vector<VertexId>& ids, const std::vector<EdgeId>& segments) override
  {
    const bool canRemove = this->Mesh.NumberOfTriangles > 0 && this->FiltersApply &&
      this->Report.FromPoints.Repeated == 0;
    if (!canRemove)
    {
      return MotionResult();
    }
    this->RequireStates();
    return this->Places.Floats ? this->RemoveHere(ids, segments, this->Points.Floats)
                               : this->RemoveHere(ids, segments, this->Points.Doubles);
  }

  MotionResult MovePoints(const PointInput& targets, const std::vector<EdgeId>& segments,
    const BuildProgress& progress) override
  {
    if (this->Range != CoordinateRange::Usual || this->Mesh.NumberOfTriangles == 0)
    {
      return MotionResult();
    }
    const bool isLocal = BackendT::IsOnHost || targets.OnDevice;
    const PlaneArray places = targets.Points.Floats
      ? this->CopyHere(targets.Points, targets.Points.Floats, isLocal)
      : this->CopyHere(targets.Points, targets.Points.Doubles, isLocal);
    this->RequireStates();
    this->Asker = PlaceAsker<BackendT>();
    return this->Places.Floats ? this->MoveHere(places, segments, this->Points.Floats, progress)
                               : this->MoveHere(places, segments, this->Points.Doubles, progress);
  }

  void StartRefinement(const RefinementPlan& plan) override
  {
    this->RequireStates();
    if (plan.IsOfCaller && this->Places.Count == 0)
    {
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

  const RefinementResult& FetchRefinement(bool isOver) override
  {
    return this->Places.Floats ? this->FetchRefinement(isOver, this->RefinedFloats)
                               : this->FetchRefinement(isOver, this->RefinedDoubles);
  }

  void VisitRefined(const RefinedVertexVisitor& visit) override
  {
    if (this->RefinedFloats.Rounds)
    {
      this->RefinedFloats.Rounds->VisitVertices(this->RefinedFloats.Grown, visit);
    }
    if (this->RefinedDoubles.Rounds)
    {
      this->RefinedDoubles.Rounds->VisitVertices(this->RefinedDoubles.Grown, visit);
    }
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

  /// Adds points to UsedPoint that come last, and are used. Public because device lambdas require
  /// it.
  void AppendUsed(std::int64_t added)
  {
    const std::int64_t before = this->Report.Points;
    this->Report.Points += added;
    if (this->UsedPoint.Size() == 0)
    {
      return;
    }
    Array<VertexId> longer = this->Backend.template MakeArray<VertexId>(this->Report.Points);
    const VertexId* from = this->UsedPoint.Data();
    VertexId* used = longer.Data();
    this->Backend.ForEach(this->Report.Points,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { used[i] = i < before ? from[i] : static_cast<VertexId>(i); });
    this->UsedPoint = std::move(longer);
  }

  /// Brings the report and UsedPoint up to date after an insertion. Public because device lambdas
  /// require it.
  void CountInserted(const GrowthItem* items, std::int64_t count)
  {
    const auto countState = [&](GrowthState state)
    {
      return this->Backend.template Sum<std::int64_t>(count,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
        { sum += items[i].State == state ? 1 : 0; });
    };
    const std::int64_t repeated = countState(GrowthState::Repeated);
    const std::int64_t before = this->Report.Points;
    this->Report.Points += count;
    this->Report.FromPoints.Repeated += repeated;
    this->CountGrown();
    const bool areAllUsed = this->UsedPoint.Size() == 0;
    if (areAllUsed && repeated == 0)
    {
      return;
    }
    Array<VertexId> longer = this->Backend.template MakeArray<VertexId>(this->Report.Points);
    const VertexId* from = this->UsedPoint.Data();
    const VertexId* ids = this->Order.VertexOfRank.Data();
    VertexId* used = longer.Data();
    this->Backend.ForEach(before,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { used[i] = areAllUsed ? static_cast<VertexId>(i) : from[i]; });
    this->Backend.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const VertexId vertex = items[i].Vertex;
        used[before + i] = vertex == NoVertex ? NoVertex : ids[vertex];
      });
    this->UsedPoint = std::move(longer);
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
    this->template MakeLoopOfGrown<Real>(coordinates.Data());
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

protected:
  using BackendMesh<BackendT>::BackendMesh;

private:
  template <typename Real>
  MotionResult InsertHere(
    const std::vector<double>& places, bool keepsFixed, Array<Real>& coordinates)
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
    PointGrowth<BackendT> growth(placesHere.Data(), count, keepsFixed, this->Backend);
    MotionResult result;
    for (;;)
    {
      plane = { this->Mesh.View(), this->Places, true };
      const std::int64_t added =
        growth.InsertSome(this->Mesh, plane, this->Points.Count, grid, grow);
      if (growth.HasUnfit())
      {
        return result;
      }
      if (added == 0)
      {
        break;
      }
      this->Points.Count += added;
      this->Places = PlaneArray(coordinates.Data(), this->Points.Count, 2);
      this->template MakeLoopOfGrown<Real>(coordinates.Data());
      ++result.Rounds;
      result.Flips += this->Loop->Converge();
    }
    this->CountInserted(growth.GetItems(), count);
    result.Rounds = std::max<std::int64_t>(1, result.Rounds); // there may be points at all places
    result.IsThere = true;
    return result;
  }

  /// Targets in the memory of the backend, copied unless they are there.
  /// @param values their coordinates, in the caller's type.
  template <typename Value>
  PlaneArray CopyHere(PlaneArray targets, const Value* values, bool isLocal)
  {
    if (!isLocal)
    {
      // The array is kept, so that later motions need no new memory.
      Array<Value>& copy = std::get<Array<Value>>(this->Targets);
      const std::int64_t numbers = (targets.Count - 1) * targets.Stride + 2;
      Reserve(copy, 0, numbers, this->Backend);
      this->Backend.Upload(values, numbers, copy.Data());
      targets = PlaneArray(copy.Data(), targets.Count, targets.Stride);
    }
    return targets;
  }

  template <typename Real>
  MotionResult MoveHere(const PlaneArray& targets, const std::vector<EdgeId>& segments,
    Array<Real>& coordinates, const BuildProgress& progress)
  {
    const MovingMesh<Real> mesh{ this->Mesh, coordinates.Data(), this->Points.Count,
      this->Order.VertexOfRank.Data() };
    // Points along curves may need many flips each. Then triangulating them anew takes less time.
    constexpr std::int64_t Fewest = 10000;
    double left = 1.0; // share of the progress; nobody knows how many rounds there are
    const ConvergeLimit limit{ this->Points.Count + Fewest,
      [&](double share) { progress.Tell(1.0 - left * (1.0 - 0.5 * share)); } };
    const auto settle = [&](bool hasOtherEdges)
    {
      if (left < 1.0)
      {
        progress.Tell(1.0 - left);
      }
      const std::int64_t flips = this->Settle(coordinates.Data(), hasOtherEdges, limit);
      left *= 0.5;
      return flips;
    };
    const MotionResult result =
      this->Motion.Move(mesh, targets, this->UsedPoint, segments, this->Backend, settle);
    this->CountGrown();
    return result;
  }

  /// Flips until the mesh is Delaunay, after points were moved or removed.
  /// @returns FlipLoop::Converge(limit).
  template <typename Real>
  std::int64_t Settle(const Real* coordinates, bool hasOtherEdges, const ConvergeLimit& limit = {})
  {
    if (!this->Loop->RestartMoved(hasOtherEdges))
    {
      this->template MakeLoopOfGrown<Real>(coordinates);
    }
    return this->Loop->Converge(limit);
  }

  template <typename Real>
  MotionResult RemoveHere(
    const std::vector<VertexId>& ids, const std::vector<EdgeId>& segments, Array<Real>& coordinates)
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
    const MotionResult result = this->Motion.Remove(mesh, this->Order.VertexOfRank.Data(),
      { removed, this->Report.Points }, segments, this->Backend, settle);
    if (result.IsThere)
    {
      this->ForgetUsed(removed);
      this->Report.FromPoints.NotFinite += SizeOf(ids);
      this->CountGrown();
      const PlaneMesh plane{ this->Mesh.View(), this->Places, true };
      this->Asker.Remove(SizeOf(ids), plane, this->Mesh.NumberOfTriangles, this->Backend);
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
    bool IsPaused = false; ///< Whether edges are free that are fixed during refinement.
    RefinementResult Result; ///< What was fetched last.
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
    this->PutStates();
    refined.Grown = { &this->Mesh, &this->GetCoordinates<Real>(), &this->Order.VertexOfRank,
      this->Points.Count, this->Report.Points, this->FiltersApply };
    refined.Rounds =
      std::make_unique<Refinement<Real, BackendT>>(refined.Grown, plan, this->Backend);
  }

  template <typename Real>
  std::int64_t RefineOnce(RefinedMesh<Real>& refined)
  {
    this->ResumeRefinement(refined);
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
    this->template MakeLoopOfGrown<Real>(coordinates);
    this->Loop->Converge();
    this->PutStates();
    if (this->Frame.NeedsGuard)
    {
      refined.Rounds->FixBlocked(refined.Grown);
    }
    this->Asker = PlaceAsker<BackendT>();
    this->AppendUsed(added);
    this->CountGrown();
    return added;
  }

  /// Brings the states of edges up to date where edges may be blocked, which refinement fixes.
  void PutStates()
  {
    if (this->Frame.NeedsGuard)
    {
      this->Loop->PutStates();
    }
  }

  /// Lets edges flip that were fixed for refinement alone, and then fetches the result.
  template <typename Real>
  void EndRefinement(RefinedMesh<Real>& refined)
  {
    if (refined.IsComplete)
    {
      return;
    }
    this->ResumeRefinement(refined);
    if (refined.Rounds->FreeEdges(refined.Grown, true) > 0)
    {
      this->template MakeLoopOfGrown<Real>(this->GetCoordinates<Real>().Data());
      this->Loop->Converge();
    }
    refined.Result = refined.Rounds->Fetch(refined.Grown);
    refined.IsComplete = true;
  }

  /// Fetches the result so far, and lets edges be judged that are fixed for refinement alone.
  template <typename Real>
  void PauseRefinement(RefinedMesh<Real>& refined)
  {
    if (refined.IsComplete || refined.IsPaused)
    {
      return;
    }
    refined.Result = refined.Rounds->Fetch(refined.Grown);
    refined.IsPaused = true;
    if (refined.Rounds->FreeEdges(refined.Grown, false) > 0)
    {
      this->template MakeLoopOfGrown<Real>(this->GetCoordinates<Real>().Data());
      this->Loop->Detect();
    }
  }

  template <typename Real>
  void ResumeRefinement(RefinedMesh<Real>& refined)
  {
    if (refined.IsPaused)
    {
      refined.Rounds->FixFreed(refined.Grown);
      refined.IsPaused = false;
    }
  }

  template <typename Real>
  const RefinementResult& FetchRefinement(bool isOver, RefinedMesh<Real>& refined)
  {
    if (isOver)
    {
      this->EndRefinement(refined);
    }
    else
    {
      this->PauseRefinement(refined);
    }
    RefinementResult& result = refined.Result;
    const bool isOnAxes = !this->IsFromPoints && !this->Frame.Projection.Tilted;
    if (isOnAxes)
    {
      result.Axes[0] = this->Frame.GetAxis(0);
      result.Axes[1] = this->Frame.GetAxis(1);
    }
    return result;
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

  MeshMotion<BackendT> Motion;
  std::tuple<Array<float>, Array<double>> Targets; ///< The targets of the last motion, copied.
  RefinedMesh<float> RefinedFloats; ///< Used if coordinates are floats, else the next one.
  RefinedMesh<double> RefinedDoubles;
};

}

#endif
