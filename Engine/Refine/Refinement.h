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

/// Counts what the places that win add.
struct CountRefined
{
  enum KindOfCount
  {
    Vertices,
    Triangles,
    Edges,
    Subsegments,
    NumberOfKinds
  };

  TriangleSplitter Splitter;
  const RefinementItem* Items;
  int Kind;

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const RefinementItem& item = this->Items[i];
    if (item.State != ItemState::Wins)
    {
      return 0;
    }
    const SplitSize size = this->Splitter.GetSize(item.Found);
    const int counts[NumberOfKinds] = { 1, size.Triangles, size.Edges, int(item.IsOnSegment) };
    return counts[this->Kind];
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
      MostVertices(plan.MostVertices),
      Failed(backend.template MakeArray<std::int32_t>(1))
  {
    const std::int32_t none = 0;
    backend.Upload(&none, 1, this->Failed.Data());
  }

  /// Inserts the places of a round. The loop must flip then. @returns how many; 0: all triangles
  /// are good or cannot get better, or the limit is reached.
  /// @throws BeyondDevice.
  std::int64_t InsertSome(GrowingMesh<Real>& grown)
  {
    for (;;)
    {
      const RefinementView view = this->Arrays.View(grown, this->Failed.Data());
      const std::int64_t triangles = this->ProposeForTriangles(grown, view);
      const std::int64_t segments = this->ProposeForSegments(view, triangles);
      this->Choose(grown, view, triangles + segments);
      const std::int64_t added = this->Insert(grown, view, triangles + segments);
      this->RequireDecided();
      const bool mayGoOn = added == 0 && !this->ReachedLimit;
      const bool isStuck = mayGoOn && this->CountInvalid(triangles, segments) > 0;
      if (!isStuck)
      {
        return added;
      }
    }
  }

  bool HasReachedLimit() const { return this->ReachedLimit; }

  RefinementResult Fetch(GrowingMesh<Real>& grown)
  {
    RefinementResult result = this->Arrays.Fetch(grown);
    result.HasReachedLimit = this->ReachedLimit;
    return result;
  }

  // Public for nvcc.

  /// @returns how many bad triangles there are.
  std::int64_t ProposeForTriangles(const GrowingMesh<Real>& grown, const RefinementView& view)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    const typename Backend::Numbering numbering = this->Device.Count(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      { return view.Judge(t) == ShapeKind::Bad ? 1 : 0; });
    Reserve(this->Bad, 0, numbering.Total, this->Device);
    TriangleId* bad = this->Bad.Data();
    this->Device.ForEachNumbered(
      numbering, triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      { return view.GetShape(t) == ShapeKind::Bad ? 1 : 0; },
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        if (view.GetShape(t) == ShapeKind::Bad)
        {
          bad[number] = static_cast<TriangleId>(t);
        }
      });
    Reserve(this->Items, 0, numbering.Total, this->Device);
    const RefinementStep step{ view, this->Items.Data(), nullptr };
    this->Device.ForEach(numbering.Total,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { step.ProposeForTriangle(i, bad[i]); });
    return numbering.Total;
  }

  /// @param first the number of the first item. @returns how many subsegments have to be split.
  std::int64_t ProposeForSegments(const RefinementView& view, std::int64_t first)
  {
    const std::int64_t segments = this->Arrays.CountSegments();
    const EdgeId* edges = this->Arrays.GetSegments();
    const auto hasToSplit = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return view.HasToSplit(edges[i]) ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(segments, hasToSplit);
    Reserve(this->Items, first, first + numbering.Total, this->Device);
    Reserve(this->SplitEdges, 0, numbering.Total, this->Device);
    EdgeId* split = this->SplitEdges.Data();
    this->Device.ForEachNumbered(numbering, segments, hasToSplit,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (view.HasToSplit(edges[i]))
        {
          split[number] = edges[i];
        }
      });
    const RefinementStep step{ view, this->Items.Data(), nullptr };
    this->Device.ForEach(numbering.Total,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { step.ProposeForSegment(first + i, split[i]); });
    return numbering.Total;
  }

  /// Chooses among the items.
  void Choose(const GrowingMesh<Real>& grown, const RefinementView& view, std::int64_t items)
  {
    const std::int64_t triangles = grown.Mesh->NumberOfTriangles;
    Reserve(this->Claims, 0, triangles, this->Device);
    const RefinementStep step{ view, this->Items.Data(), this->Claims.Data() };
    this->Device.ForEach(triangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { step.Claims[t] = RefinementStep::NoClaim; });
    this->Device.ForEach(items, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { step.Claim(i); });
    this->Device.ForEach(items, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { step.Decide(i); });
    this->RequireDecided();
  }

  /// Splits what the winners split. @returns how many there are.
  std::int64_t Insert(GrowingMesh<Real>& grown, const RefinementView& view, std::int64_t items)
  {
    std::int64_t added[CountRefined::NumberOfKinds];
    Reserve(this->First, 0, CountRefined::NumberOfKinds * items, this->Device);
    for (int kind = 0; kind < CountRefined::NumberOfKinds; ++kind)
    {
      added[kind] = this->Number(
        CountRefined{ TriangleSplitter(view.Mesh.Edges), this->Items.Data(), kind }, items);
    }
    const std::int64_t vertices = added[CountRefined::Vertices];
    this->ReachedLimit = this->ReachedLimit || grown.Vertices + vertices > this->MostVertices;
    if (vertices == 0 || this->ReachedLimit)
    {
      return 0;
    }
    EdgeMesh& mesh = *grown.Mesh;
    const std::int64_t triangles = mesh.NumberOfTriangles, edges = mesh.NumberOfEdges;
    ReserveMesh(mesh, triangles + added[CountRefined::Triangles],
      edges + added[CountRefined::Edges], this->Device);
    const RefinementStore<Real> store = this->Arrays.MakeRoom(grown,
      { vertices, added[CountRefined::Triangles], added[CountRefined::Edges],
        added[CountRefined::Subsegments] },
      this->Failed.Data());
    this->Split(store, items);
    mesh.NumberOfTriangles = triangles + added[CountRefined::Triangles];
    mesh.NumberOfEdges = edges + added[CountRefined::Edges];
    this->Arrays.Added(grown, vertices, added[CountRefined::Subsegments]);
    return vertices;
  }

  /// Numbers what the winners add. @returns how much it is.
  std::int64_t Number(const CountRefined& count, std::int64_t items)
  {
    const typename Backend::Numbering numbering = this->Device.Count(items, count);
    std::int64_t* first = this->First.Data() + count.Kind * items;
    this->Device.ForEachNumbered(numbering, items, count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number) { first[i] = number; });
    return numbering.Total;
  }

  void Split(const RefinementStore<Real>& store, std::int64_t items)
  {
    const RefinementItem* item = this->Items.Data();
    const std::int64_t* first = this->First.Data();
    this->Device.ForEach(items,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (item[i].State == ItemState::Wins)
        {
          store.Split(item[i],
            { first[i + CountRefined::Vertices * items], first[i + CountRefined::Triangles * items],
              first[i + CountRefined::Edges * items],
              first[i + CountRefined::Subsegments * items] });
        }
      });
  }

  /// How many subsegments have turned out to be too short: the next round may be another one.
  std::int64_t CountInvalid(std::int64_t first, std::int64_t segments) const
  {
    const RefinementItem* items = this->Items.Data() + first;
    return this->Device.template Sum<std::int64_t>(segments,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      { sum += items[i].State == ItemState::Dropped ? 1 : 0; });
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
  Array<TriangleId> Bad;
  Array<EdgeId> SplitEdges;
  Array<RefinementItem> Items; ///< First those for triangles, then those on segments.
  Array<std::uint64_t> Claims;
  Array<std::int64_t> First; ///< The numbers of what the winners add, kind by kind.
};

}

#endif
