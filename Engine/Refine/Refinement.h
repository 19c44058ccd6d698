// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENT_H
#define DELAUNAYFLIP_REFINEMENT_H

#include "Array.h"
#include "FlipError.h"
#include "MeshRoom.h"
#include "PlaceGrid.h"
#include "RefinementArrays.h"
#include "RefinementItem.h"
#include "RefinementPlan.h"
#include "RefinementSources.h"
#include "RefinementStep.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

/// @file
/// Refines a triangulation in rounds (Ruppert 1995). A round makes places for bad triangles and for
/// subsegments, and inserts those that do not exclude each other. The loop then flips until the
/// mesh is constrained Delaunay again. All that decides, such as keys and numbers, depends on the
/// mesh alone, so that any number of threads and a GPU make the same mesh.

namespace delaunayflip
{

/// 1 if a place wins and is on a segment of the hull, else 0. Such a place splits one triangle
/// instead of two.
struct WinsOnHull
{
  TriangleSplitter Splitter;
  const RefinementItem* Items;

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const RefinementItem& item = this->Items[i];
    const bool isOnHull =
      item.State == ItemState::Wins && this->Splitter.FindAcross(item.Found) == NoCorner;
    return int(isOnHull);
  }
};

/// 1 if a place wins, else 0.
struct WinsRound
{
  const RefinementItem* Items;

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    return int(this->Items[i].State == ItemState::Wins);
  }
};

struct FindCavity
{
  static constexpr bool TakesLong = true;

  RefinementStep Step;

  void Prefetch(std::int64_t i) const { this->Step.PrefetchCavity(i); }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i) const { this->Step.FindCavity(i); }
};

/// Decides whether a place for a triangle wins. @returns 1 if it does, else 0.
struct DecidePlace
{
  static constexpr bool TakesLong = true;

  RefinementStep Step;

  void Prefetch(std::int64_t i) const { this->Step.PrefetchDecision(i); }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const { return this->Step.Decide(i); }
};

/// Inserts a place for a triangle if it wins.
template <typename Real>
struct SplitPlace
{
  static constexpr bool TakesLong = true;

  RefinementStore<Real> Store;
  const RefinementItem* Items;

  void Prefetch(std::int64_t i) const
  {
    constexpr std::int64_t Second = RefinementView::Second, Third = RefinementView::Third,
                           Fourth = RefinementView::Fourth;
    if (i >= Fourth)
    {
      this->PrefetchStage(i, [this](TriangleId t) { this->Store.PrefetchTriangle(t); });
      this->PrefetchStage(i - Second, [this](TriangleId t) { this->Store.PrefetchEdges(t); });
      this->PrefetchStage(i - Third, [this](TriangleId t) { this->Store.PrefetchOldTriangle(t); });
      this->PrefetchStage(i - Fourth, [this](TriangleId t) { this->Store.PrefetchOldPoints(t); });
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, std::int64_t number) const
  {
    const RefinementItem& item = this->Items[i];
    if (item.State == ItemState::Wins)
    {
      const RefinementNumbers before{ number, 2 * number, 3 * number, 0 };
      this->Store.Split(item, before);
    }
  }

private:
  template <typename Stage>
  void PrefetchStage(std::int64_t i, const Stage& stage) const
  {
    if (this->Items[i].State == ItemState::Wins)
    {
      stage(this->Items[i].Found.Triangle);
    }
  }
};

/// How many places of a round win.
struct CountOfWinners
{
  std::int64_t InTriangles, OnSegments;
  std::int64_t OnHull; ///< Those on segments of the hull.

  /// How many elements of each kind these winners add.
  DELAUNAYFLIP_HOST_DEVICE RefinementNumbers GetAdded() const
  {
    const std::int64_t vertices = this->InTriangles + this->OnSegments;
    return { vertices, 2 * vertices - this->OnHull, 3 * vertices - this->OnHull, this->OnSegments };
  }
};

/// The rounds on a backend.
/// @tparam Real the type of the mesh's coordinates.
template <typename Real, typename Backend>
class Refinement
{
public:
  Refinement(const GrowingMesh<Real>& grown, const RefinementPlan& plan, const Backend& backend)
    : Device(backend),
      Arrays(grown, plan, backend),
      MostVertices(grown.Vertices + plan.MostAdded),
      Failed(backend.template MakeArray<std::int32_t>(1))
  {
    const std::int32_t none = 0;
    backend.Upload(&none, 1, this->Failed.Data());
  }

  /// Inserts the places of a round. The loop must flip afterwards.
  /// @returns how many places; 0: all triangles are good or cannot get better, or the limit is
  /// reached.
  /// @throws BeyondDevice.
  std::int64_t InsertSome(GrowingMesh<Real>& grown)
  {
    while (!this->ReachedLimit)
    {
      this->BeginRound(grown);
      const RefinementView view = this->Arrays.View(grown, this->Failed.Data());
      this->ProposeForTriangles(grown, view);
      this->ProposeForSegments(view);
      const std::int64_t added = this->InsertWinners(grown, view);
      if (added > 0)
      {
        return added;
      }
      // Some subsegments were too short to be split, or all triangles must be judged a last time.
      const bool mayGoOn = this->NumberOfSegments > 0 || !this->LooksAtAll;
      this->LooksAtAll = this->NumberOfSegments == 0;
      if (!mayGoOn)
      {
        return 0;
      }
    }
    return 0;
  }

  bool HasReachedLimit() const { return this->ReachedLimit; }

  /// These are described in RefinementArrays.
  void FixBlocked(const GrowingMesh<Real>& grown) { this->Arrays.FixBlocked(grown); }
  std::int64_t FreeEdges(const GrowingMesh<Real>& grown, bool keepsMesh)
  {
    return this->Arrays.FreeEdges(grown, keepsMesh);
  }
  void FixFreed(const GrowingMesh<Real>& grown) { this->Arrays.FixFreed(grown); }

  void VisitVertices(const GrowingMesh<Real>& grown, const RefinedVertexVisitor& visit)
  {
    this->Arrays.VisitVertices(grown, visit);
  }

  /// @throws BeyondDevice.
  RefinementResult Fetch(GrowingMesh<Real>& grown)
  {
    this->RequireDecided(); // the steps after the winners were chosen
    RefinementResult result = this->Arrays.Fetch(grown);
    result.HasReachedLimit = this->ReachedLimit;
    return result;
  }

  // The functions below are public because device lambdas require it.

  void BeginRound(const GrowingMesh<Real>& grown)
  {
    ++this->Round;
    if (this->Round > RefinementKey::MostRounds)
    {
      this->Round = 1;
      std::uint64_t* claims = this->Arrays.GetClaims();
      this->Device.ForEach(grown.Mesh->NumberOfTriangles,
        [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { claims[t] = RefinementKey::None; });
    }
  }

  /// Makes an item for every bad triangle.
  void ProposeForTriangles(const GrowingMesh<Real>& grown, const RefinementView& view)
  {
    std::swap(this->Items, this->ItemsBefore);
    RefinementSources sources{ view, this->ItemsBefore.Data(), this->NumberOfPlaces,
      this->Arrays.GetSplits(), grown.Vertices - this->NumberAdded, this->NumberAdded, 0, nullptr,
      nullptr };
    if (this->LooksAtAll)
    {
      sources.NumberOfItems = sources.NumberOfVertices = 0;
      sources.NumberOfTriangles = grown.Mesh->NumberOfTriangles;
    }
    const std::int64_t size = sources.GetSize();
    Reserve(this->Counts, 0, size, this->Device);
    sources.Counts = this->Counts.Data();
    Reserve(
      this->Listed, 0, RefinementSources::MostListed * sources.NumberOfVertices, this->Device);
    sources.Listed = this->Listed.Data();
    this->Device.ForEach(
      sources.NumberOfItems, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { sources.Keep(i); });
    const typename Backend::Numbering numbering = this->Device.Count(size, JudgeSource{ sources });
    this->NumberOfPlaces = numbering.Total;
    Reserve(this->Items, 0, numbering.Total, this->Device);
    Reserve(this->Cavities, 0, numbering.Total, this->Device);
    if (numbering.Total == 0)
    {
      return;
    }
    const RefinementStep step = this->GetStep(view);
    this->Device.ForEachNumbered(
      numbering, size,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return static_cast<int>(sources.Counts[i]); },
      ProposePlaces{ sources, step });
    this->Device.ForEach(numbering.Total, FindCavity{ step });
  }

  /// Makes an item for every subsegment that has to be split, after those for triangles.
  void ProposeForSegments(const RefinementView& view)
  {
    const std::int64_t segments = this->Arrays.CountSegments();
    const auto hasToSplit = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return view.HasToSplit(i) ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(segments, hasToSplit);
    this->NumberOfSegments = numbering.Total;
    if (numbering.Total == 0)
    {
      return;
    }
    const std::int64_t first = this->NumberOfPlaces;
    Reserve(this->Items, first, first + numbering.Total, this->Device);
    RefinementItem* items = this->Items.Data() + first;
    this->Device.ForEachNumbered(numbering, segments, hasToSplit,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (view.HasToSplit(i))
        {
          items[number].Source = static_cast<std::uint32_t>(i);
        }
      });
    const RefinementStep step = this->GetStep(view);
    this->Device.ForEach(numbering.Total,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { step.ProposeForSegment(first + i); });
  }

  /// Decides which places win, and inserts them. @returns how many there are.
  std::int64_t InsertWinners(GrowingMesh<Real>& grown, const RefinementView& view)
  {
    const RefinementStep step = this->GetStep(view);
    const std::int64_t first = this->NumberOfPlaces;
    typename Backend::Numbering places = this->Device.Count(first, DecidePlace{ step });
    typename Backend::Numbering segments = this->Device.Count(this->NumberOfSegments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return step.Decide(first + i); });
    this->RequireDecided();
    const std::int64_t room = this->MostVertices - grown.Vertices;
    if (places.Total + segments.Total > room)
    {
      this->ReachedLimit = true;
      segments = this->KeepFirst(segments, first, this->NumberOfSegments, room);
      places = this->KeepFirst(places, 0, first, room - segments.Total);
    }
    const CountOfWinners count{ places.Total, segments.Total, this->NumberOnHull(view) };
    const std::int64_t vertices = count.GetAdded().Vertex;
    this->NumberAdded = 0;
    if (vertices == 0)
    {
      return 0;
    }
    this->Arrays.FindOldPlaces(grown, this->Items.Data(), first, this->Failed.Data());
    const RefinementStore<Real> store = this->MakeRoom(grown, count.GetAdded());
    this->SplitTriangles(store, places);
    this->SplitSegments(store, segments, count.InTriangles);
    this->NumberAdded = vertices;
    this->LooksAtAll = false;
    return vertices;
  }

  /// Keeps the first winners of a kind, because the limit allows no more.
  /// @param first its first item. @returns their numbering.
  typename Backend::Numbering KeepFirst(const typename Backend::Numbering& numbering,
    std::int64_t first, std::int64_t size, std::int64_t most)
  {
    RefinementItem* items = this->Items.Data() + first;
    const WinsRound wins{ items };
    this->Device.ForEachNumbered(numbering, size, wins,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (wins(i) != 0 && number >= most)
        {
          items[i].State = ItemState::Dropped;
        }
      });
    return this->Device.Count(size, wins);
  }

  /// Numbers the winners on segments of the hull. @returns how many there are.
  std::int64_t NumberOnHull(const RefinementView& view)
  {
    const std::int64_t segments = this->NumberOfSegments;
    if (segments == 0)
    {
      return 0;
    }
    const WinsOnHull wins{ TriangleSplitter(view.Mesh.Edges),
      this->Items.Data() + this->NumberOfPlaces };
    const typename Backend::Numbering numbering = this->Device.Count(segments, wins);
    Reserve(this->OnHullBefore, 0, segments, this->Device);
    std::int64_t* before = this->OnHullBefore.Data();
    this->Device.ForEachNumbered(numbering, segments, wins,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number) { before[i] = number; });
    return numbering.Total;
  }

  RefinementStore<Real> MakeRoom(GrowingMesh<Real>& grown, const RefinementNumbers& added)
  {
    EdgeMesh& mesh = *grown.Mesh;
    const std::int64_t triangles = mesh.NumberOfTriangles + added.Triangle;
    const std::int64_t edges = mesh.NumberOfEdges + added.Edge;
    ReserveMesh(mesh, triangles, edges, this->Device);
    const RefinementStore<Real> store = this->Arrays.MakeRoom(grown, added, this->Failed.Data());
    mesh.NumberOfTriangles = triangles;
    mesh.NumberOfEdges = edges;
    this->Arrays.Added(grown, added.Vertex, added.Subsegment);
    return store;
  }

  void SplitTriangles(
    const RefinementStore<Real>& store, const typename Backend::Numbering& numbering)
  {
    const RefinementItem* items = this->Items.Data();
    const WinsRound wins{ items };
    this->Device.ForEachNumbered(
      numbering, this->NumberOfPlaces, wins, SplitPlace<Real>{ store, items });
  }

  /// @param inTriangles the number of winners in triangles, which precede those on segments.
  void SplitSegments(const RefinementStore<Real>& store,
    const typename Backend::Numbering& numbering, std::int64_t inTriangles)
  {
    const RefinementItem* items = this->Items.Data() + this->NumberOfPlaces;
    const std::int64_t* onHull = this->OnHullBefore.Data();
    const WinsRound wins{ items };
    this->Device.ForEachNumbered(numbering, this->NumberOfSegments, wins,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (wins(i) != 0)
        {
          store.Split(items[i], CountOfWinners{ inTriangles, number, onHull[i] }.GetAdded());
        }
      });
  }

  RefinementStep GetStep(const RefinementView& view)
  {
    return { view, this->Items.Data(), this->Cavities.Data(), this->Arrays.GetClaims(),
      this->Round };
  }

private:
  /// @throws BeyondDevice if a device could not decide an orientation.
  void RequireDecided() const
  {
    std::int32_t hasFailed = 0;
    this->Device.Download(this->Failed.Data(), 1, &hasFailed);
    if (hasFailed != 0)
    {
      throw BeyondDevice();
    }
  }

  const Backend& Device;
  RefinementArrays<Real, Backend> Arrays;
  std::int64_t MostVertices;
  bool ReachedLimit = false;
  Array<std::int32_t> Failed; ///< 1 after a device could not decide an orientation.
  std::uint64_t Round = 0;
  bool LooksAtAll = true; ///< Whether the next round looks at all triangles.
  std::int64_t NumberAdded = 0; ///< Vertices that the last round has added.
  Array<std::uint32_t> Counts; ///< See RefinementSources.
  Array<TriangleId> Listed; ///< See RefinementSources.
  Array<RefinementItem> Items; ///< First those for triangles, then those on segments.
  Array<RefinementItem> ItemsBefore;
  std::int64_t NumberOfPlaces = 0; ///< Items for triangles.
  std::int64_t NumberOfSegments = 0; ///< Items on segments.
  Array<Cavity> Cavities;
  Array<std::int64_t> OnHullBefore; ///< By item on a segment, the winners on the hull before it.
};

}

#endif
