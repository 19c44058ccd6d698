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
    // Either triangle at an edge would do. This one does not depend on where the walk began.
    item.Place = ChooseTriangle(this->Mesh, item.Place, nullptr);
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

  DELAUNAYFLIP_HOST_DEVICE bool IsUnfit(std::int64_t i) const
  {
    const GrowthState state = this->Items[i].State;
    return state == GrowthState::Outside || state == GrowthState::Refused;
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

/// What is counted of a round.
struct GrowthSums
{
  std::int64_t Winners = 0;
  std::int64_t OnBoundary = 0; ///< Those of them that split an edge of the boundary.
  std::int64_t Unfit = 0; ///< Places that cannot be inserted: they are Outside or Refused.
  std::int64_t Failed = 0; ///< Not 0 if a device could not decide.

  DELAUNAYFLIP_HOST_DEVICE GrowthSums& operator+=(const GrowthSums& part)
  {
    this->Winners += part.Winners;
    this->OnBoundary += part.OnBoundary;
    this->Unfit += part.Unfit;
    this->Failed += part.Failed;
    return *this;
  }

  /// What so many winners add. On the boundary it is a triangle and an edge less.
  DELAUNAYFLIP_HOST_DEVICE std::int64_t CountTriangles() const
  {
    return 2 * this->Winners - this->OnBoundary;
  }
  DELAUNAYFLIP_HOST_DEVICE std::int64_t CountEdges() const
  {
    return 3 * this->Winners - this->OnBoundary;
  }
};

/// Counts the winners.
struct CountWinners
{
  TriangleSplitter Splitter;
  const GrowthItem* Items;
  bool OnBoundary; ///< Whether only those that split an edge of the boundary count.

  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const GrowthItem& item = this->Items[i];
    const bool wins = item.State == GrowthState::Wins;
    return wins && (!this->OnBoundary || this->Splitter.IsOnBoundary(item.Place)) ? 1 : 0;
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
      Before(backend.template MakeArray<std::int64_t>(2 * count))
  {
    this->Start();
  }

  const GrowthItem* GetItems() const { return this->Items.Data(); }

  /// Whether some places cannot be inserted, because they are outside of all triangles or on fixed
  /// edges that must not be split. Then none is inserted. This is known after the first call of
  /// InsertSome.
  bool HasUnfit() const { return this->AreUnfit; }

  /// Inserts places that split no common triangle. Edges that have to be judged become candidates.
  /// @param vertices how many places the mesh has. The new ones' numbers follow.
  /// @param grow makes room for so many vertices, and returns a StoreVertex.
  /// @returns how many. 0: none is waiting, or HasUnfit.
  /// @throws BeyondDevice.
  template <typename Grow>
  std::int64_t InsertSome(EdgeMesh& mesh, PlaneMesh plane, std::int64_t vertices,
    const PlaceGridView& grid, const Grow& grow)
  {
    const GrowthSums added = this->FindWinners(mesh, plane, grid);
    this->AreUnfit = added.Unfit > 0;
    if (added.Winners == 0 || this->AreUnfit)
    {
      return 0;
    }
    this->Number({ TriangleSplitter(mesh.View()), this->Items.Data(), false });
    if (added.OnBoundary > 0)
    {
      this->Number({ TriangleSplitter(mesh.View()), this->Items.Data(), true });
    }
    const Sizes before{ vertices, mesh.NumberOfTriangles, mesh.NumberOfEdges };
    const std::int64_t triangles = before.Triangles + added.CountTriangles();
    const std::int64_t edges = before.Edges + added.CountEdges();
    ReserveMesh(mesh, triangles, edges, this->Device);
    const auto store = grow(vertices + added.Winners);
    this->Split(TriangleSplitter(mesh.View()), before, added.OnBoundary > 0, store);
    mesh.NumberOfTriangles = triangles;
    mesh.NumberOfEdges = edges;
    return added.Winners;
  }

  // The functions below are public because device lambdas require it.

  void Start()
  {
    GrowthItem* items = this->Items.Data();
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) {
        items[i] = { GrowthState::Waiting, FoundPlace(), NoVertex };
      });
  }

  GrowthSums FindWinners(const EdgeMesh& mesh, PlaneMesh plane, const PlaceGridView& grid)
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
    const TriangleSplitter splitter(plane.Edges);
    const GrowthSums sums = this->Device.template Sum<GrowthSums>(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, GrowthSums & sum)
      {
        round.Decide(i);
        const bool wins = round.Items[i].State == GrowthState::Wins;
        sum.Winners += wins ? 1 : 0;
        sum.OnBoundary += wins && splitter.IsOnBoundary(round.Items[i].Place) ? 1 : 0;
        sum.Unfit += round.IsUnfit(i) ? 1 : 0;
        sum.Failed += i == 0 ? *round.Mesh.Failed : 0;
      });
    if (sums.Failed != 0)
    {
      throw BeyondDevice();
    }
    return sums;
  }

  /// Finds out how many winners precede each one.
  void Number(const CountWinners& count)
  {
    const typename Backend::Numbering numbering = this->Device.Count(this->Count, count);
    std::int64_t* before = this->Before.Data() + (count.OnBoundary ? this->Count : 0);
    this->Device.ForEachNumbered(numbering, this->Count, count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number) { before[i] = number; });
  }

  /// How much a mesh has before it grows.
  struct Sizes
  {
    std::int64_t Vertices, Triangles, Edges;
  };

  /// @param onBoundary whether a winner splits an edge of the boundary.
  template <typename Store>
  void Split(
    const TriangleSplitter& splitter, const Sizes& before, bool onBoundary, const Store& store)
  {
    GrowthItem* items = this->Items.Data();
    const std::int64_t* winners = this->Before.Data();
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
        GrowthSums added; // by the winners before this one
        added.Winners = winners[i];
        added.OnBoundary = onBoundary ? winners[count + i] : 0;
        item.Vertex = static_cast<VertexId>(before.Vertices + added.Winners);
        store(item.Vertex, i);
        splitter.Split({ item.Vertex, item.Place,
          static_cast<TriangleId>(before.Triangles + added.CountTriangles()),
          static_cast<EdgeId>(before.Edges + added.CountEdges()) });
      });
  }

private:
  const Backend& Device;
  const double* Places;
  std::int64_t Count;
  bool KeepsFixed;
  bool AreUnfit = false; ///< See HasUnfit.
  Array<GrowthItem> Items;
  /// By item, how many winners precede it; then how many of those on the boundary.
  Array<std::int64_t> Before;
  Array<std::uint32_t> Claims;
};

}

#endif
