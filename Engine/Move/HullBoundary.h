// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULLBOUNDARY_H
#define DELAUNAYFLIP_HULLBOUNDARY_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "HullChange.h"
#include "HullRemoval.h"
#include "MeshRoom.h"
#include "PlaneMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// What threads count at the boundary of a mesh.
enum class HullCount : int
{
  Concave, ///< Vertices where FillUp would add a triangle.
  TurnsBack, ///< Vertices where the next side runs back on the line of the one before.
  Reversals, ///< Sides that run up after one that runs down, or the other way round.
  End
};

/// The boundary of a mesh on a backend, which is kept while points move.
template <typename Backend>
class HullBoundary
{
public:
  explicit HullBoundary(const Backend& backend)
    : Device(backend)
  {
  }

  HullView View(const PlaneMesh& mesh)
  {
    HullView hull{ mesh, this->Sides.Data(), this->SideOfVertex.Data(), this->Cuts.Data(), 0 };
    if (!this->PinnedEdges.empty())
    {
      hull.PinOf = this->PinOf.Data();
      hull.Pinned = this->Pinned.Data();
    }
    return hull;
  }

  /// Makes room for any number of changes by GroupBoundary. A change makes as many sides less as
  /// triangles more, or the other way round.
  /// @param sizes receives the sizes before the changes. @returns states that the caller must fix.
  StatesBehind BeginChanges(EdgeMesh& mesh, HullSizes& sizes)
  {
    const std::int64_t sides = this->Count + MostCuts;
    Reserve(this->Sides, this->Count, sides, this->Device);
    Reserve(this->Cuts, 0, sides, this->Device);
    Reserve(this->Pending, 0, 2 * sides, this->Device);
    sizes = { mesh.NumberOfTriangles, mesh.NumberOfEdges, this->Count, sides, 0, 0 };
    return MakeMeshRoom(
      mesh, mesh.NumberOfTriangles + this->Count, mesh.NumberOfEdges + this->Count, this->Device);
  }
  VertexId* GetPending() { return this->Pending.Data(); }

  /// Takes over the sizes after these changes.
  void EndChanges(const HullSizes& sizes, EdgeMesh& mesh)
  {
    mesh.NumberOfTriangles = sizes.Triangles;
    mesh.NumberOfEdges = sizes.Edges;
    this->Count = sizes.Sides;
  }

  // The functions below are public because device lambdas require it.

  /// Sets the edges that must stay edges. @param vertices the number of vertices.
  void Pin(const std::vector<EdgeId>& edges, std::int64_t vertices)
  {
    // A triangulation has fewer than three edges per vertex.
    const bool isKnown =
      edges == this->PinnedEdges && static_cast<std::int64_t>(this->PinOf.Size()) >= 3 * vertices;
    if (isKnown || edges.empty())
    {
      this->PinnedEdges = edges;
      return;
    }
    const auto count = static_cast<std::int64_t>(edges.size());
    Reserve(this->PinOf, 0, 3 * vertices, this->Device);
    Reserve(this->Pinned, 0, count, this->Device);
    this->Device.Upload(edges.data(), count, this->Pinned.Data());
    std::uint32_t* pinOf = this->PinOf.Data();
    HalfEdgeId* pinned = this->Pinned.Data();
    this->Device.ForEach(static_cast<std::int64_t>(this->PinOf.Size()),
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { pinOf[i] = NoSide; });
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        pinOf[pinned[i]] = static_cast<std::uint32_t>(i);
        pinned[i] *= 2;
      });
    this->PinnedEdges = edges;
  }

  /// What the pinned edges have become. From now on they are pinned by their new numbers.
  std::vector<PinnedEdge> FetchPinned(const EdgeMesh& mesh)
  {
    const auto count = static_cast<std::int64_t>(this->PinnedEdges.size());
    std::vector<PinnedEdge> fetched(count);
    if (count == 0)
    {
      return fetched;
    }
    Array<PinnedEdge> found = this->Device.template MakeArray<PinnedEdge>(count);
    PinnedEdge* to = found.Data();
    HalfEdgeId* pinned = this->Pinned.Data();
    const CornerId* corners = mesh.CornerOfHalfEdge.Data();
    this->Device.ForEach(count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const HalfEdgeId side = pinned[i];
        to[i] = { side, corners[side | 1u] == NoCorner ? 1u : 0u };
        pinned[i] = side & ~1u;
      });
    this->Device.Download(to, count, fetched.data());
    for (std::int64_t i = 0; i < count; ++i)
    {
      this->PinnedEdges[i] = EdgeOf(fetched[i].Side);
    }
    return fetched;
  }

  /// Removes vertices on the boundary, one after the other. Their numbers become free.
  /// @param vertices in the memory of the backend.
  /// @returns whether this was possible.
  bool Remove(EdgeMesh& mesh, const PlaneMesh& plane, const VertexId* vertices, std::int64_t count)
  {
    Reserve(this->Pending, 0, 2 * (this->Count + MostCuts), this->Device);
    Reserve(this->Sides, this->Count, this->Count + MostCuts, this->Device);
    HullSizes sizes{ mesh.NumberOfTriangles, mesh.NumberOfEdges, this->Count,
      this->Count + MostCuts, 0, 0 };
    Reserve(this->Sizes, 0, 1, this->Device);
    this->Device.Upload(&sizes, 1, this->Sizes.Data());
    HullView hull = this->View(plane);
    hull.Cuts = nullptr; // nobody asks for them
    HullSizes* result = this->Sizes.Data();
    VertexId* pending = this->Pending.Data();
    this->Device.ForEach(1,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t)
      { HullRemover(hull, result).Remove(vertices, count, pending); });
    this->Device.Download(result, 1, &sizes);
    mesh.NumberOfTriangles = sizes.Triangles;
    mesh.NumberOfEdges = sizes.Edges;
    this->Count = sizes.Sides;
    return sizes.HasFailed == 0;
  }

  /// Finds the boundary of a mesh.
  void Build(const EdgeMesh& mesh, const PlaneMesh& plane)
  {
    const CornerId* corners = mesh.CornerOfHalfEdge.Data();
    const auto isOnBoundary = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t edge)
    { return corners[2 * edge + 1] == NoCorner ? 1 : 0; };
    const typename Backend::Numbering numbering =
      this->Device.Count(mesh.NumberOfEdges, isOnBoundary);
    this->Count = numbering.Total;
    const std::int64_t vertices = plane.Places.Count;
    Reserve(this->Sides, 0, this->Count + MostCuts, this->Device);
    Reserve(this->SideOfVertex, 0, vertices, this->Device);
    Reserve(this->Cuts, 0, MostCuts, this->Device);
    BoundarySide* sides = this->Sides.Data();
    std::uint32_t* sideOfVertex = this->SideOfVertex.Data();
    this->Device.ForEachNumbered(numbering, mesh.NumberOfEdges, isOnBoundary,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t edge, std::int64_t number)
      {
        if (isOnBoundary(edge) != 0)
        {
          sides[number] = { static_cast<EdgeId>(edge), NoSide, NoSide };
        }
      });
    this->Device.ForEach(
      vertices, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { sideOfVertex[i] = NoSide; });
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      { sideOfVertex[plane.GetStart(2 * sides[i].Edge)] = static_cast<std::uint32_t>(i); });
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const std::uint32_t after = sideOfVertex[plane.GetEnd(2 * sides[i].Edge)];
        sides[i].After = after;
        sides[after].Before = static_cast<std::uint32_t>(i);
      });
  }

  /// Adds to the counts.
  void CountTurns(const PlaneMesh& plane, std::uint32_t* counts)
  {
    const HullView hull = this->View(plane);
    const BoundarySide* sides = this->Sides.Data();
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        const BoundarySide side = sides[i];
        const int turn = hull.FindTurn(side);
        const bool isReversed = hull.IsReversal(side);
        Add(turn < 0, HullCount::Concave, counts);
        Add(turn == 0 && isReversed, HullCount::TurnsBack, counts);
        Add(isReversed, HullCount::Reversals, counts);
      });
  }

  DELAUNAYFLIP_HOST_DEVICE static void Add(bool is, HullCount count, std::uint32_t* counts)
  {
    if (is)
    {
      AtomicAdd(counts + static_cast<int>(count), 1u);
    }
  }

private:
  static constexpr std::int64_t MostCuts = 4096; ///< The most in one round.

  const Backend& Device;
  Array<BoundarySide> Sides;
  Array<std::uint32_t> SideOfVertex;
  Array<CutTriangle> Cuts;
  Array<VertexId> Pending;
  Array<HullSizes> Sizes;
  std::vector<EdgeId> PinnedEdges; ///< The numbers of pinned edges. Empty: there are none.
  Array<std::uint32_t> PinOf;
  Array<HalfEdgeId> Pinned;
  std::int64_t Count = 0; ///< The number of sides.
};

}

#endif
