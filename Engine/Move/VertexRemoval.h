// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VERTEXREMOVAL_H
#define DELAUNAYFLIP_VERTEXREMOVAL_H

#include "Array.h"
#include "Atomics.h"
#include "EdgeMesh.h"
#include "HullBoundary.h"
#include "MeshRoom.h"
#include "PlaneMesh.h"
#include "StarRemoval.h"

#include <cstdint>

/// @file
/// Removes vertices from a triangulation: first those inside, in rounds of vertices that are no
/// neighbours, then those on the boundary. In the end the last triangles, edges and vertices take
/// the numbers that have become free. All of it depends on the mesh and the points alone.

namespace delaunayflip
{

/// Points to remove.
struct RemovedPoints
{
  const Array<VertexId>& Ids; ///< Ascending, in the memory of the backend.
  std::int64_t All; ///< How many points there are, used or not.
};

/// How many vertices to remove are in each state.
struct RemovalSums
{
  std::int64_t Waiting = 0, OnHull = 0, Failed = 0;

  DELAUNAYFLIP_HOST_DEVICE RemovalSums& operator+=(const RemovalSums& part)
  {
    this->Waiting += part.Waiting;
    this->OnHull += part.OnHull;
    this->Failed += part.Failed;
    return *this;
  }
  DELAUNAYFLIP_HOST_DEVICE void Add(RemovalState state)
  {
    this->Waiting += state == RemovalState::Waiting ? 1 : 0;
    this->OnHull += state == RemovalState::OnHull ? 1 : 0;
    this->Failed += state == RemovalState::Missing || state == RemovalState::Stuck ? 1 : 0;
  }
};

enum class GapKind : std::uint32_t
{
  Triangle,
  Edge,
  Vertex
};

/// Something with a number behind the new end of its array takes one that is free.
struct Renumbering
{
  GapKind Kind;
  std::uint32_t From, To;
};

/// What a mesh has after a removal.
struct RemainingSizes
{
  std::int64_t Triangles, Edges, Vertices;
};

/// Says whether something that is removed leaves a number that another one takes.
struct CountGaps
{
  const RemovedVertex* Items;
  std::int64_t Count; ///< The number of items. Each has left two triangles, three edges, a vertex.
  RemainingSizes Left;

  DELAUNAYFLIP_HOST_DEVICE Renumbering Get(std::int64_t i) const
  {
    const std::int64_t triangles = 2 * this->Count, edges = 5 * this->Count;
    if (i < triangles)
    {
      return { GapKind::Triangle, 0, this->Items[i / 2].Triangles[i % 2] };
    }
    if (i < edges)
    {
      return { GapKind::Edge, 0, this->Items[(i - triangles) / 3].Edges[(i - triangles) % 3] };
    }
    return { GapKind::Vertex, 0, this->Items[i - edges].Vertex };
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const Renumbering gap = this->Get(i);
    const std::int64_t ends[3] = { this->Left.Triangles, this->Left.Edges, this->Left.Vertices };
    return gap.To < ends[static_cast<int>(gap.Kind)] ? 1 : 0;
  }
};

/// Says whether something behind the new end of its array is still needed.
struct CountMovers
{
  EdgeMeshView Mesh;
  const std::uint32_t* ItemOf;
  std::int64_t CountInside; ///< How many vertices were removed inside of the mesh.
  RemainingSizes Left;

  DELAUNAYFLIP_HOST_DEVICE std::uint32_t Get(std::int64_t i) const
  {
    const std::int64_t triangles = 2 * this->CountInside, edges = 5 * this->CountInside;
    if (i < triangles)
    {
      return static_cast<std::uint32_t>(this->Left.Triangles + i);
    }
    if (i < edges)
    {
      return static_cast<std::uint32_t>(this->Left.Edges + i - triangles);
    }
    return static_cast<std::uint32_t>(this->Left.Vertices + i - edges);
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t i) const
  {
    const std::uint32_t number = this->Get(i);
    if (i < 2 * this->CountInside)
    {
      return this->Mesh.Triangles[number].Vertices[0] != NoVertex ? 1 : 0;
    }
    if (i < 5 * this->CountInside)
    {
      return this->Mesh.CornerOfHalfEdge[2 * number] != NoCorner ? 1 : 0;
    }
    return this->ItemOf[number] == NoSide ? 1 : 0;
  }
};

/// Gives triangles, edges and vertices of a mesh other numbers.
template <typename Real>
struct MeshRenumberer
{
  HullView Hull;
  Real* Coordinates; ///< x and y by vertex.
  VertexId* Ids; ///< By vertex, its point.
  std::uint32_t* NumberOf; ///< By vertex that moves, its new number.

  DELAUNAYFLIP_HOST_DEVICE void MoveTriangle(const Renumbering& move) const
  {
    const EdgeMeshView& edges = this->Hull.Mesh.Edges;
    TriangleRecord triangle = edges.Triangles[move.From];
    triangle.InputTriangle = move.To;
    edges.Triangles[move.To] = triangle;
    for (int slot = 0; slot < 3; ++slot)
    {
      edges.CornerOfHalfEdge[triangle.HalfEdges[slot]] = MakeCorner(move.To, slot);
    }
  }

  /// All triangles must have their numbers, and vertices their old ones.
  DELAUNAYFLIP_HOST_DEVICE void MoveEdge(const Renumbering& move) const
  {
    const EdgeMeshView& edges = this->Hull.Mesh.Edges;
    const CornerPair corners = edges.GetCorners(move.From);
    edges.SetCorners(move.To, corners);
    edges.States[move.To] = edges.States[move.From];
    edges.States[move.From] = EdgeState::Fixed; // like all states behind the last edge
    edges.Triangles[TriangleOf(corners.A)].HalfEdges[SlotOf(corners.A)] = 2 * move.To;
    if (corners.B != NoCorner)
    {
      edges.Triangles[TriangleOf(corners.B)].HalfEdges[SlotOf(corners.B)] = 2 * move.To + 1;
    }
    else
    {
      const VertexId start = this->Hull.Mesh.GetVertex(PlaneMesh::Next(corners.A));
      this->Hull.Sides[this->Hull.SideOfVertex[start]].Edge = move.To;
    }
    this->Hull.MovePin(move.From, move.To);
  }

  DELAUNAYFLIP_HOST_DEVICE void MoveVertex(const Renumbering& move) const
  {
    this->NumberOf[move.From] = move.To;
    this->Hull.SideOfVertex[move.To] = this->Hull.SideOfVertex[move.From];
    this->Ids[move.To] = this->Ids[move.From];
    for (int axis = 0; axis < 2; ++axis)
    {
      this->Coordinates[std::int64_t(2) * move.To + axis] =
        this->Coordinates[std::int64_t(2) * move.From + axis];
    }
  }
};

/// Removes vertices of a mesh.
template <typename Real, typename Backend>
class VertexRemoval
{
public:
  VertexRemoval(
    EdgeMesh& mesh, const PlaneMesh& plane, HullBoundary<Backend>& hull, const Backend& backend)
    : Device(backend),
      Mesh(mesh),
      Plane(plane),
      Hull(hull)
  {
  }

  /// Removes points. Edges that have to be judged become candidates.
  /// @param ids by vertex, its point.
  /// @returns false if one of them is no vertex or cannot be removed. Then the mesh is of no use.
  bool Remove(Real* coordinates, VertexId* ids, const RemovedPoints& removed)
  {
    this->Find(ids, removed);
    RemovalSums sums = this->Classify();
    if (sums.Failed > 0 || sums.OnHull > MostOnHull)
    {
      return false;
    }
    const std::int64_t onHull = sums.OnHull;
    while (sums.Waiting > 0)
    {
      sums = this->MakeRound();
      if (sums.Failed > 0)
      {
        return false;
      }
    }
    const std::int64_t inside = this->Count - onHull;
    const RemainingSizes left{ this->Mesh.NumberOfTriangles - 2 * inside,
      this->Mesh.NumberOfEdges - 3 * inside, this->Plane.Places.Count - this->Count };
    const MeshRenumberer<Real> renumberer{ this->Hull.View(this->Plane), coordinates, ids,
      this->ItemOf.Data() };
    this->Fill(renumberer, left, inside);
    this->Mesh.NumberOfTriangles = left.Triangles;
    this->Mesh.NumberOfEdges = left.Edges;
    if (onHull > 0 && !this->RemoveOnHull(onHull))
    {
      return false;
    }
    this->MoveVertices(renumberer, left.Vertices);
    return true;
  }

  // The functions below are public because device lambdas require it.

  /// Finds the vertices of the points, and one corner of each.
  void Find(const VertexId* ids, const RemovedPoints& removed)
  {
    this->Count = static_cast<std::int64_t>(removed.Ids.Size());
    this->Items = this->Device.template MakeArray<RemovedVertex>(this->Count);
    this->ItemOf = this->Device.template MakeArray<std::uint32_t>(this->Plane.Places.Count);
    Array<std::uint32_t> itemOfPoint = this->Device.template MakeArray<std::uint32_t>(removed.All);
    this->Device.Fill(itemOfPoint.Data(), 0xFF, removed.All); // NoSide
    std::uint32_t* ofPoint = itemOfPoint.Data();
    std::uint32_t* itemOf = this->ItemOf.Data();
    RemovedVertex* items = this->Items.Data();
    const VertexId* wanted = removed.Ids.Data();
    this->Device.ForEach(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        ofPoint[wanted[i]] = static_cast<std::uint32_t>(i);
        items[i] = { NoVertex, NoCorner, NoCorner, RemovalState::Missing,
          { NoTriangle, NoTriangle }, { NoEdge, NoEdge, NoEdge } };
      });
    this->Device.ForEach(this->Plane.Places.Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t v)
      {
        const std::uint32_t item = ofPoint[ids[v]];
        itemOf[v] = item;
        if (item != NoSide)
        {
          items[item].Vertex = static_cast<VertexId>(v);
        }
      });
    const TriangleRecord* triangles = this->Mesh.Triangles.Data();
    this->Device.ForEach(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (int slot = 0; slot < 3; ++slot)
        {
          const std::uint32_t item = itemOf[triangles[t].Vertices[slot]];
          if (item != NoSide)
          {
            AtomicMin(&items[item].Corner, MakeCorner(static_cast<TriangleId>(t), slot));
          }
        }
      });
  }

  RemovalSums Classify()
  {
    RemovedVertex* items = this->Items.Data();
    const HullView hull = this->Hull.View(this->Plane);
    return this->Device.template Sum<RemovalSums>(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, RemovalSums & sum)
      {
        RemovedVertex& item = items[i];
        if (item.Vertex != NoVertex)
        {
          item.State = hull.IsInside(item.Vertex) ? RemovalState::Waiting : RemovalState::OnHull;
        }
        sum.Add(item.State);
      });
  }

  /// Removes vertices inside of which no two are neighbours.
  RemovalSums MakeRound()
  {
    const RemovalRound round{ this->Plane, this->Items.Data(), this->ItemOf.Data(),
      this->Hull.View(this->Plane).SideOfVertex };
    this->Device.ForEach(
      this->Count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { round.Choose(i); });
    return this->Device.template Sum<RemovalSums>(this->Count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, RemovalSums & sum)
      {
        if (round.Items[i].State == RemovalState::Wins)
        {
          round.Remove(i);
        }
        sum.Add(round.Items[i].State);
      });
  }

  /// Gives free numbers of triangles and edges to the last ones, and plans the same for vertices.
  /// @param inside how many vertices were removed inside of the mesh.
  void Fill(const MeshRenumberer<Real>& renumberer, const RemainingSizes& left, std::int64_t inside)
  {
    const CountGaps gaps{ this->Items.Data(), this->Count, left };
    const std::int64_t gapRange = 6 * this->Count;
    const typename Backend::Numbering gapNumbers = this->Device.Count(gapRange, gaps);
    this->CountMoves = gapNumbers.Total;
    this->Moves = this->Device.template MakeArray<Renumbering>(this->CountMoves);
    Renumbering* moves = this->Moves.Data();
    this->Device.ForEachNumbered(gapNumbers, gapRange, gaps,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (gaps(i) != 0)
        {
          moves[number] = gaps.Get(i);
        }
      });
    const CountMovers movers{ this->Mesh.View(), this->ItemOf.Data(), inside, left };
    const std::int64_t moverRange = 5 * inside + this->Count;
    const typename Backend::Numbering moverNumbers = this->Device.Count(moverRange, movers);
    this->Device.ForEachNumbered(moverNumbers, moverRange, movers,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (movers(i) != 0)
        {
          moves[number].From = movers.Get(i);
        }
      });
    this->Device.ForEach(this->CountMoves,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (moves[i].Kind == GapKind::Triangle)
        {
          renumberer.MoveTriangle(moves[i]);
        }
      });
    this->Device.ForEach(this->CountMoves,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (moves[i].Kind == GapKind::Edge)
        {
          renumberer.MoveEdge(moves[i]);
        }
      });
  }

  bool RemoveOnHull(std::int64_t count)
  {
    const RemovedVertex* items = this->Items.Data();
    const auto isOnHull = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { return items[i].State == RemovalState::OnHull ? 1 : 0; };
    const typename Backend::Numbering numbering = this->Device.Count(this->Count, isOnHull);
    Array<VertexId> listed = this->Device.template MakeArray<VertexId>(count);
    VertexId* vertices = listed.Data();
    this->Device.ForEachNumbered(numbering, this->Count, isOnHull,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, std::int64_t number)
      {
        if (isOnHull(i) != 0)
        {
          vertices[number] = items[i].Vertex;
        }
      });
    return this->Hull.Remove(this->Mesh, this->Plane, vertices, count);
  }

  /// Gives free numbers of vertices to the last ones.
  void MoveVertices(const MeshRenumberer<Real>& renumberer, std::int64_t left)
  {
    const Renumbering* moves = this->Moves.Data();
    this->Device.ForEach(this->CountMoves,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
      {
        if (moves[i].Kind == GapKind::Vertex)
        {
          renumberer.MoveVertex(moves[i]);
        }
      });
    TriangleRecord* triangles = this->Mesh.Triangles.Data();
    const std::uint32_t* numberOf = renumberer.NumberOf;
    this->Device.ForEach(this->Mesh.NumberOfTriangles,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
      {
        for (VertexId& vertex : triangles[t].Vertices)
        {
          if (vertex >= left)
          {
            vertex = numberOf[vertex];
          }
        }
      });
  }

private:
  static constexpr std::int64_t MostOnHull = 256; ///< One thread removes them.

  const Backend& Device;
  EdgeMesh& Mesh;
  PlaneMesh Plane;
  HullBoundary<Backend>& Hull;
  std::int64_t Count = 0; ///< How many vertices are removed.
  Array<RemovedVertex> Items;
  Array<std::uint32_t> ItemOf; ///< By vertex, its item or NoSide; later new numbers of vertices.
  Array<Renumbering> Moves;
  std::int64_t CountMoves = 0;
};

}

#endif
