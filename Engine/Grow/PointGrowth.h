// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTGROWTH_H
#define DELAUNAYFLIP_POINTGROWTH_H

#include "Array.h"
#include "Atomics.h"
#include "FlipError.h"
#include "MeshRoom.h"
#include "PlaceGrid.h"
#include "TriangleSplit.h"

#include <algorithm>
#include <cstdint>
#include <utility>

/// @file
/// Inserts places into a triangulation, many at a time.

namespace delaunayflip
{

/// What becomes of a place to insert.
enum class GrowthState : std::uint32_t
{
  Waiting,
  Wins, ///< Is inserted in this round.
  Inserted, ///< Is a vertex.
  Repeated, ///< Is at a vertex that was there.
  Outside, ///< Is outside of all triangles, or not finite.
  Refused ///< Is on a fixed edge that must not be split.
};

/// A place to insert.
struct GrowthItem
{
  GrowthState State;
  FoundPlace Place; ///< Where it was found; the next search begins there.
  VertexId Vertex; ///< The vertex that the place becomes, or that is there already.
};

/// A round, item by item. A place claims the triangles that it would split, and the lowest number
/// wins a triangle.
struct GrowthRound
{
  PlaneMesh Mesh;
  const double* Places; ///< x and y of all items.
  GrowthItem* Items;
  std::uint32_t* Claims; ///< By triangle.
  bool KeepsFixed; ///< Whether fixed edges must not be split.

  DELAUNAYFLIP_HOST_DEVICE void FindAndClaim(std::int64_t i, const PlaceGridView& grid) const
  {
    GrowthItem& item = this->Items[i];
    if (item.State != GrowthState::Waiting)
    {
      return;
    }
    const PlanePoint place = { this->Places[2 * i] + 0.0, this->Places[2 * i + 1] + 0.0, 0.0 };
    if (!grid.Frame.Box.Has(place))
    {
      item.State = GrowthState::Outside;
      return;
    }
    const TriangleId start = item.Place.IsOutside() ? grid.FindStart(place) : item.Place.Triangle;
    item.Place = WalkToPlace(this->Mesh, place, start);
    if (item.Place.IsOutside())
    {
      item.State = GrowthState::Outside;
      return;
    }
    const int vertex = item.Place.FindVertexSlot();
    if (vertex >= 0)
    {
      item.State = GrowthState::Repeated;
      item.Vertex = this->Mesh.GetVertex(MakeCorner(item.Place.Triangle, vertex));
      return;
    }
    if (this->KeepsFixed && this->IsOnFixed(item.Place))
    {
      item.State = GrowthState::Refused;
      return;
    }
    this->ForTriangles(item.Place,
      [&](TriangleId triangle)
      { AtomicMin(&this->Claims[triangle], static_cast<std::uint32_t>(i)); });
  }

  DELAUNAYFLIP_HOST_DEVICE void Decide(std::int64_t i) const
  {
    GrowthItem& item = this->Items[i];
    if (item.State != GrowthState::Waiting)
    {
      return;
    }
    bool wins = true;
    this->ForTriangles(item.Place,
      [&](TriangleId triangle)
      { wins = wins && this->Claims[triangle] == static_cast<std::uint32_t>(i); });
    if (wins)
    {
      item.State = GrowthState::Wins;
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool IsOnFixed(const FoundPlace& place) const
  {
    const int slot = place.FindEdgeSlot();
    return slot >= 0 &&
      this->Mesh.IsFixed(this->Mesh.GetHalfEdge(MakeCorner(place.Triangle, slot)));
  }

  template <typename Visit>
  DELAUNAYFLIP_HOST_DEVICE void ForTriangles(const FoundPlace& place, const Visit& visit) const
  {
    visit(place.Triangle);
    if (place.FindEdgeSlot() >= 0)
    {
      const CornerId across = TriangleSplitter(this->Mesh.Edges).FindAcross(place);
      if (across != NoCorner)
      {
        visit(TriangleOf(across));
      }
    }
  }
};

/// Counts what the winners add: vertices, triangles or edges.
struct CountAdded
{
  TriangleSplitter Splitter;
  const GrowthItem* Items;
  int Kind; ///< 0: vertices, 1: triangles, 2: edges.

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const GrowthItem& item = this->Items[i];
    if (item.State != GrowthState::Wins)
    {
      return 0;
    }
    const SplitSize size = this->Splitter.GetSize(item.Place);
    const int counts[3] = { 1, size.Triangles, size.Edges };
    return counts[this->Kind];
  }
};

/// Where a mesh keeps its vertices, while new ones are stored.
template <typename Real>
struct StoreVertex
{
  Real* Coordinates; ///< x and y by vertex.
  VertexId* Ids; ///< By vertex, the number of its point.
  const double* Places; ///< x and y of the items.
  std::int64_t FirstId; ///< That of the first item.

  DELAUNAYFLIP_HOST_DEVICE void operator()(VertexId vertex, std::int64_t item) const
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Coordinates[std::int64_t(2) * vertex + axis] =
        static_cast<Real>(this->Places[2 * item + axis] + 0.0);
    }
    this->Ids[vertex] = static_cast<VertexId>(this->FirstId + item);
  }
};

/// The places that are inserted into a mesh, and what becomes of them.
template <typename Backend>
class PointGrowth
{
public:
  /// @param places x and y, in the memory of the backend.
  /// @param keepsFixed whether fixed edges must not be split.
  PointGrowth(const double* places, std::int64_t count, bool keepsFixed, const Backend& backend)
    : Device(backend),
      Places(places),
      Count(count),
      KeepsFixed(keepsFixed),
      Items(backend.template MakeArray<GrowthItem>(count)),
      First(backend.template MakeArray<std::int64_t>(3 * count))
  {
    this->Start();
  }

  const GrowthItem* GetItems() const { return this->Items.Data(); }

  /// Inserts places that split no common triangle. Edges that have to be judged become candidates.
  /// @param vertices how many places the mesh has. The new ones' numbers follow.
  /// @param grow makes room for so many vertices, and returns a StoreVertex.
  /// @returns how many. 0: none is waiting.
  /// @throws BeyondDevice.
  template <typename Grow>
  std::int64_t InsertSome(EdgeMesh& mesh, PlaneMesh plane, std::int64_t vertices,
    const PlaceGridView& grid, const Grow& grow)
  {
    this->FindWinners(mesh, plane, grid);
    const TriangleSplitter splitter(mesh.View());
    std::int64_t added[3];
    for (int kind = 0; kind < 3; ++kind)
    {
      added[kind] = this->Number(CountAdded{ splitter, this->Items.Data(), kind });
      if (added[kind] == 0)
      {
        return 0;
      }
    }
    const std::int64_t triangles = mesh.NumberOfTriangles, edges = mesh.NumberOfEdges;
    ReserveMesh(mesh, triangles + added[1], edges + added[2], this->Device);
    const auto store = grow(vertices + added[0]);
    this->Split(TriangleSplitter(mesh.View()), { vertices, triangles, edges }, store);
    mesh.NumberOfTriangles = triangles + added[1];
    mesh.NumberOfEdges = edges + added[2];
    return added[0];
  }

  // The functions below are public because device lambdas require it.

  /// How many places are on fixed edges that must not be split. This is known after the first call
  /// of InsertSome.
  std::int64_t CountRefused() const
  {
    const GrowthItem* items = this->Items.Data();
    return this->Device.template Sum<std::int64_t>(this->KeepsFixed ? this->Count : 0,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t & sum)
      { sum += items[i].State == GrowthState::Refused ? 1 : 0; });
  }

  void Start()
  {
    GrowthItem* items = this->Items.Data();
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        items[i] = { GrowthState::Waiting, FoundPlace(), NoVertex };
      });
  }

  void FindWinners(const EdgeMesh& mesh, PlaneMesh plane, const PlaceGridView& grid)
  {
    Reserve(this->Claims, 0, mesh.NumberOfTriangles, this->Device);
    std::uint32_t* claims = this->Claims.Data();
    this->Device.ForEach(mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { claims[t] = ~std::uint32_t(0); });
    Array<std::int32_t> failed = this->Device.template MakeArray<std::int32_t>(1);
    this->Device.Fill(failed.Data(), 0, 1);
    plane.Failed = failed.Data();
    const GrowthRound round{ plane, this->Places, this->Items.Data(), claims, this->KeepsFixed };
    this->Device.ForEach(
      this->Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { round.FindAndClaim(i, grid); });
    this->Device.ForEach(
      this->Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { round.Decide(i); });
    std::int32_t hasFailed = 0;
    this->Device.Download(failed.Data(), 1, &hasFailed);
    if (hasFailed != 0)
    {
      throw BeyondDevice();
    }
  }

  /// Numbers what the winners add. @returns how much it is.
  std::int64_t Number(const CountAdded& count)
  {
    const typename Backend::Numbering numbering = this->Device.Count(this->Count, count);
    std::int64_t* first = this->First.Data() + count.Kind * this->Count;
    this->Device.ForEachNumbered(numbering, this->Count, count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number) { first[i] = number; });
    return numbering.Total;
  }

  /// How much a mesh has before it grows.
  struct Sizes
  {
    std::int64_t Vertices, Triangles, Edges;
  };

  template <typename Store>
  void Split(const TriangleSplitter& splitter, const Sizes& before, const Store& store)
  {
    GrowthItem* items = this->Items.Data();
    const std::int64_t* first = this->First.Data();
    const std::int64_t count = this->Count;
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        GrowthItem& item = items[i];
        if (item.State != GrowthState::Wins)
        {
          return;
        }
        item.State = GrowthState::Inserted;
        item.Vertex = static_cast<VertexId>(before.Vertices + first[i]);
        store(item.Vertex, i);
        splitter.Split(
          { item.Vertex, item.Place, static_cast<TriangleId>(before.Triangles + first[count + i]),
            static_cast<EdgeId>(before.Edges + first[2 * count + i]) });
      });
  }

private:
  const Backend& Device;
  const double* Places;
  std::int64_t Count;
  bool KeepsFixed;
  Array<GrowthItem> Items;
  Array<std::int64_t> First; ///< The numbers of vertices, triangles and edges that winners add.
  Array<std::uint32_t> Claims;
};

}

#endif
