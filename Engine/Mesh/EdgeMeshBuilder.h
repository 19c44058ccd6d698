// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHBUILDER_H
#define DELAUNAYFLIP_EDGEMESHBUILDER_H

#include "Atomics.h"
#include "EdgeFixing.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "MeshSurvey.h"
#include "RepeatedTriangles.h"
#include "RunProgress.h"
#include "SpatialOrder.h"

#include <cstdint>
#include <stdexcept>
#include <utility>

/// @file
/// Makes an edge mesh of triangles, in linear time whatever the vertex degrees.

namespace delaunayflip
{

/// Finds or makes the table entries of the edges opposite corners 3 * triangle + slot, if they are
/// of the table's slice, and adds the corners to them.
struct PairStep
{
  EdgeTableView Table;
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t i) const
  {
    this->Table.Prefetch(KeyOpposite(this->Triangles[i / 3], static_cast<int>(i % 3)));
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t i, PairSums& sums) const
  {
    TriangleRecord& triangle = this->Triangles[i / 3];
    const int slot = static_cast<int>(i % 3);
    const std::uint64_t key = KeyOpposite(triangle, slot);
    // A table that has failed once is discarded.
    if (sums.Failures > 0 || !this->Table.Slice.Holds(key))
    {
      return;
    }
    bool inserted = false;
    const std::uint32_t entry = this->Table.FindOrInsert(key, inserted);
    if (entry == EdgeTableView::NoSlot)
    {
      ++sums.Failures;
      return;
    }
    const CornerId corner = MakeCorner(static_cast<TriangleId>(i / 3), slot);
    bool many = false; // this makes the edge non-manifold
    if (inserted)
    {
      this->Table.First[entry] = corner; // the first word belongs to the corner that inserted it
    }
    else
    {
      CornerId* second = &this->Table.Second[entry];
      many = AtomicCompareExchange(second, NoCorner, corner) != NoCorner &&
        AtomicExchange(second, ManyCorners) != ManyCorners;
    }
    sums.Edges += int(IsKeyOfEdge(key) && inserted);
    sums.NonManifold += int(IsKeyOfEdge(key) && many);
    triangle.HalfEdges[slot] = entry;
  }
};

/// Replaces table slots by the roles of a triangle's corners and the edges' other corners, for the
/// edges of the table's slice.
/// @returns the number of edges that the triangle leads, as far as roles are known.
struct RoleStep
{
  EdgeTableView Table;
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (const std::uint32_t entry : this->Triangles[t].HalfEdges)
    {
      delaunayflip::Prefetch(&this->Table.First[entry]);
      delaunayflip::Prefetch(&this->Table.Second[entry]);
    }
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t t) const
  {
    TriangleRecord& triangle = this->Triangles[t];
    const bool hasEdges = HasEdges(triangle);
    // All three are read before anything is written, so that the loads overlap.
    bool known[3];
    CornerId others[3] = {};
    for (int slot = 0; slot < 3; ++slot)
    {
      known[slot] = this->Table.Slice.Holds(KeyOpposite(triangle, slot));
      if (known[slot])
      {
        const CornerId corner = MakeCorner(static_cast<TriangleId>(t), slot);
        const CornerId first = this->Table.First[triangle.HalfEdges[slot]];
        const CornerId second = this->Table.Second[triangle.HalfEdges[slot]];
        const bool isPair = second != NoCorner && second != ManyCorners;
        others[slot] = isPair && first != corner ? first : second;
      }
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      if (known[slot])
      {
        SetRole(triangle, t, slot, hasEdges ? others[slot] : ManyCorners);
      }
    }
    return CountLeaders(triangle);
  }
};

/// Numbers the edges that a triangle leads, from `next` on.
struct NumberStep
{
  EdgeMeshView Mesh;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    const TriangleRecord& triangle = this->Mesh.Triangles[t];
    for (int slot = 0; slot < 3; ++slot)
    {
      if (GetRole(triangle, slot) == CornerRole::Leader)
      {
        delaunayflip::Prefetch(&this->Mesh.Triangles[TriangleOf(triangle.HalfEdges[slot])]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t, std::int64_t first) const
  {
    ConstTriangleAccess triangle = this->Mesh.Triangles[t];
    auto next = static_cast<EdgeId>(first);
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerRole role = GetRole(triangle, slot);
      if (role != CornerRole::Follower)
      {
        if (this->Mesh.States)
        {
          this->Mesh.States[next] =
            role == CornerRole::Leader ? EdgeState::Candidate : EdgeState::Fixed;
        }
        const CornerId other = triangle.HalfEdges[slot];
        this->Mesh.SetCorners(next, { MakeCorner(static_cast<TriangleId>(t), slot), other });
        this->Mesh.Triangles[t].HalfEdges[slot] = 2 * next;
        if (other != NoCorner)
        {
          this->Mesh.Triangles[TriangleOf(other)].HalfEdges[SlotOf(other)] = 2 * next + 1;
        }
        ++next;
      }
    }
  }
};

/// A triangle with its vertices in the engine's order and its fixed bit.
struct LoadStep
{
  TriangleMesh Mesh;
  SpatialOrderView Order;
  const PointUse* Uses; ///< Null: all points are finite.
  TriangleRecord* Triangles;

  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    constexpr std::int64_t Further = 32; // when this prefetches what the ids of a triangle name
    const std::int64_t far = std::min(t + Further, this->Mesh.Triangles.Count - 1);
    this->Mesh.Triangles.Prefetch(this->Order.GetTriangle(far));
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t vertex = this->Mesh.Triangles.Get(this->Order.GetTriangle(t), slot);
      if (this->Order.RankOfVertex)
      {
        delaunayflip::Prefetch(&this->Order.RankOfVertex[vertex]);
      }
      if (this->Uses)
      {
        delaunayflip::Prefetch(&this->Uses[vertex]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t) const
  {
    TriangleRecord& record = this->Triangles[t];
    const TriangleId own = this->Order.GetTriangle(t);
    const std::int64_t p = this->Mesh.Triangles.Get(own, 0);
    const std::int64_t q = this->Mesh.Triangles.Get(own, 1);
    const std::int64_t r = this->Mesh.Triangles.Get(own, 2);
    // Its edges must not flip: the caller says so, it has a repeated id, or a coordinate is not
    // finite.
    const bool isUntouchable =
      (this->Mesh.FrozenTriangles && this->Mesh.FrozenTriangles[own] != 0) || p == q || q == r ||
      r == p ||
      (this->Uses &&
        (this->Uses[p] == PointUse::NotFinite || this->Uses[q] == PointUse::NotFinite ||
          this->Uses[r] == PointUse::NotFinite));
    record.InputTriangle = own;
    record.Flips = int(isUntouchable) * UntouchableBit;
    record.Vertices[0] = this->Order.GetRank(p);
    record.Vertices[1] = this->Order.GetRank(q);
    record.Vertices[2] = this->Order.GetRank(r);
  }
};

/// Loads the triangles in the engine's order, with which an edge mesh begins. After this the ids of
/// the input and the order of its triangles are not needed any more.
template <typename Backend>
EdgeMesh LoadTriangles(const EdgeMeshInput& input, const Backend& backend)
{
  EdgeMesh edges;
  const TriangleMesh mesh = input.Input.Local;
  const SpatialOrderView order = input.Order.View();
  const PointUse* uses = input.Survey.GetUsesIfNeeded();
  edges.NumberOfTriangles = mesh.Triangles.Count;
  edges.Triangles = backend.template MakeArray<TriangleRecord>(mesh.Triangles.Count);
  TriangleRecord* triangles = edges.Triangles.Data();
  backend.ForEach(mesh.Triangles.Count, LoadStep{ mesh, order, uses, triangles });
  return edges;
}

/// Pairs the corners slice by slice, and numbers the edges. @returns whether all tables, for
/// `expected` edges together, were large enough.
template <typename Backend>
bool TryPairSlices(EdgeMeshResult& result, std::int64_t vertices, std::int64_t slices,
  std::int64_t expected, typename Backend::Numbering& numbering, const Backend& backend)
{
  TriangleRecord* records = result.Edges.Triangles.Data();
  const std::int64_t triangles = result.Edges.NumberOfTriangles;
  result.Counts.Edges = 0;
  result.Counts.NonManifold = 0;
  for (std::int64_t i = 0; i < slices; ++i)
  {
    const VertexSlice slice{ static_cast<VertexId>(vertices * i / slices),
      static_cast<VertexId>(vertices * (i + 1) / slices) };
    result.Table = EdgeTable(); // frees the memory first
    result.Table = EdgeTable(expected / slices, slice, backend);
    const PairSums sums =
      backend.template Sum<PairSums>(3 * triangles, PairStep{ result.Table.View(), records });
    result.Counts.Edges += sums.Edges;
    result.Counts.NonManifold += sums.NonManifold;
    // With a larger share of slots in use, later searches would be long.
    constexpr double LargestFill = 0.8;
    const auto capacity = static_cast<double>(result.Table.GetCapacity());
    if (sums.Failures > 0 || static_cast<double>(sums.Edges) > LargestFill * capacity)
    {
      return false;
    }
    const RoleStep setRoles{ result.Table.View(), records };
    if (i + 1 < slices)
    {
      backend.ForEach(triangles, setRoles);
    }
    else
    {
      numbering = backend.Count(triangles, setRoles);
    }
  }
  return true;
}

/// Finds the other corner of every corner's edge, and the roles, by the edge table.
/// @param slices into how many slices the vertices are divided. Their tables are used one after the
/// other, which saves memory. If some slice has more edges than its share, one table is used for
/// all.
/// @returns the numbering of the edges.
template <typename Backend>
typename Backend::Numbering PairByTable(
  const EdgeMeshInput& input, EdgeMeshResult& result, std::int64_t slices, const Backend& backend)
{
  const std::int64_t vertices = input.Input.Local.Points.Count;
  const std::int64_t corners = 3 * result.Edges.NumberOfTriangles;
  typename Backend::Numbering numbering;
  std::int64_t expected = corners / 2 + corners / 100;
  while (expected <= 4 * corners + 4)
  {
    if (TryPairSlices(result, vertices, slices, std::min(expected, corners), numbering, backend))
    {
      return numbering;
    }
    if (slices == 1)
    {
      expected = 2 * expected + 1;
    }
    slices = 1;
  }
  throw std::logic_error("the edge table runs full; please report this with the mesh");
}

/// Finds the other corner of every corner's edge, in the way that suits the backend.
/// @returns the numbering of the edges.
template <typename Backend>
typename Backend::Numbering PairCorners(
  const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  // Constraints are searched for in this table. A guard makes its own, which needs no words.
  if (input.Input.Caller.NumberOfConstraintEdges > 0)
  {
    return PairByTable(input, result, 1, backend);
  }
  typename Backend::Numbering numbering;
  PairSums sums;
  if (backend.PairCorners(result.Edges, input.Input.Local.Points.Count, sums, numbering))
  {
    result.Counts.Edges = sums.Edges;
    result.Counts.NonManifold = sums.NonManifold;
    return numbering;
  }
  // Slices take time, which matters in small meshes; but surfaces take most memory.
  constexpr std::int64_t SmallestSliced = std::int64_t(1) << 20; // triangles
  constexpr std::int64_t SmallestHalved = std::int64_t(1) << 17; // triangles of a surface
  const std::int64_t triangles = result.Edges.NumberOfTriangles;
  int slices = 1;
  if (triangles >= SmallestSliced)
  {
    slices = backend.CountTableSlices();
  }
  else if (triangles >= SmallestHalved && input.Survey.Geometry == GeometryKind::Surface)
  {
    slices = std::min(backend.CountTableSlices(), 2);
  }
  numbering = PairByTable(input, result, slices, backend);
  if (Backend::MemoryIsScarce)
  {
    result.Table = EdgeTable(); // frees its memory for the rest of the mesh
  }
  return numbering;
}

/// Makes the array of states, and sets those after the last edge.
template <typename Backend>
void MakeStates(EdgeMesh& edges, const Backend& backend)
{
  const std::int64_t numberOfEdges = edges.NumberOfEdges;
  const std::int64_t padded =
    (numberOfEdges + EdgeMesh::StatePadding - 1) / EdgeMesh::StatePadding * EdgeMesh::StatePadding;
  edges.States = backend.template MakeArray<EdgeState>(padded);
  EdgeState* states = edges.States.Data();
  backend.ForEach(padded - numberOfEdges,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { states[numberOfEdges + i] = EdgeState::Fixed; });
}

/// @param hasStates whether edges have states; else those with one triangle are fixed.
template <typename Backend>
void NumberEdges(EdgeMeshResult& result, const typename Backend::Numbering& numbering,
  const Backend& backend, bool hasStates = true)
{
  EdgeMesh& edges = result.Edges;
  const std::int64_t size = edges.NumberOfTriangles;
  edges.NumberOfEdges = numbering.Total;
  edges.CornerOfHalfEdge = backend.template MakeArray<CornerId>(2 * edges.NumberOfEdges);
  if (hasStates)
  {
    MakeStates(edges, backend);
  }
  const EdgeMeshView mesh = edges.View();
  backend.ForEachNumbered(
    numbering, size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { return CountLeaders(mesh.Triangles[t]); },
    NumberStep{ mesh });
}

/// Pairs the corners of triangles and fixes the edges that must stay: boundary, non-manifold and
/// wrongly wound edges, edges of triangles that are frozen, duplicate or not finite, region
/// borders, feature edges and constraints. All others are candidates. Triangles that name a point
/// twice stay, and have no edges.
///
/// EdgeId = rank of the edge's smallest incident corner in the engine's order, on every backend.
/// @param loaded made by LoadTriangles.
/// @throws InvalidMesh if a constraint names a point that does not exist; RunAborted.
template <typename Backend>
EdgeMeshResult BuildEdgeMesh(const EdgeMeshInput& input, EdgeMesh loaded, const Backend& backend,
  const BuildProgress& progress = BuildProgress())
{
  EdgeMeshResult result;
  result.Edges = std::move(loaded);
  {
    const typename Backend::Numbering numbering = PairCorners(input, result, backend);
    progress.Reach(input.Survey.Geometry, BuildStep::Paired);
    NumberEdges(result, numbering, backend);
  }
  progress.Reach(input.Survey.Geometry, BuildStep::Numbered);
  if (FixByInput(input, result, backend))
  {
    result.DuplicateTriangles = FindDuplicates(result.Edges, backend);
  }
  if (input.Input.Caller.NumberOfConstraintEdges > 0)
  {
    FixConstraints(input, result, backend);
  }
  return result;
}

}

#endif
