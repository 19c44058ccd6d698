// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHBUILDER_H
#define DELAUNAYFLIP_EDGEMESHBUILDER_H

#include "BuildProgress.h"
#include "EdgeMesh.h"
#include "EdgeMeshSteps.h"
#include "EdgeTable.h"
#include "FixedEdges.h"
#include "FlipReport.h"
#include "MeshSurvey.h"
#include "SpatialOrder.h"

#include <algorithm>
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
    const std::uint64_t key = KeyOpposite(triangle, static_cast<int>(i % 3));
    // A table that has failed once is discarded.
    if (sums.Failures == 0 && this->Table.Slice.Holds(key))
    {
      this->Pair(
        key, triangle, MakeCorner(static_cast<TriangleId>(i / 3), static_cast<int>(i % 3)), sums);
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE void Pair(
    std::uint64_t key, TriangleRecord& triangle, CornerId corner, PairSums& sums) const
  {
    bool inserted = false;
    const std::uint32_t entry = this->Table.FindOrInsert(key, inserted);
    if (entry == EdgeTableView::NoSlot)
    {
      ++sums.Failures;
      return;
    }
    const int slot = SlotOf(corner);
    const bool many = AttachCorner(this->Table, entry, corner, inserted);
    const bool isEdge = !IsLoop(triangle, slot);
    sums.Edges += isEdge && inserted ? 1 : 0;
    sums.NonManifold += isEdge && many ? 1 : 0;
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
    // All three are read before anything is written, so that the loads overlap.
    std::uint32_t roles = 0;
    bool known[3];
    CornerId others[3];
    for (int slot = 0; slot < 3; ++slot)
    {
      known[slot] = this->Table.Slice.Holds(KeyOpposite(triangle, slot));
      if (known[slot])
      {
        const CornerId corner = MakeCorner(static_cast<TriangleId>(t), slot);
        const CornerRole role =
          FindRole(this->Table, triangle.HalfEdges[slot], corner, others[slot]);
        roles |= static_cast<std::uint32_t>(role) << (2 * slot);
      }
    }
    for (int slot = 0; slot < 3; ++slot)
    {
      if (known[slot])
      {
        triangle.HalfEdges[slot] = others[slot];
      }
    }
    triangle.Flips |= roles;
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
    const TriangleRecord& triangle = this->Mesh.Triangles[t];
    auto next = static_cast<EdgeId>(first);
    for (int slot = 0; slot < 3; ++slot)
    {
      const CornerRole role = GetRole(triangle, slot);
      if (role != CornerRole::Follower)
      {
        this->Mesh.States[next] =
          role == CornerRole::Leader ? EdgeState::Candidate : EdgeState::Fixed;
        NumberEdge(this->Mesh, MakeCorner(static_cast<TriangleId>(t), slot),
          triangle.HalfEdges[slot], next++);
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

  DELAUNAYFLIP_HOST_DEVICE void PrefetchFar(std::int64_t t) const
  {
    this->Mesh.Triangles.Prefetch(this->Order.GetTriangle(t));
  }
  DELAUNAYFLIP_HOST_DEVICE void Prefetch(std::int64_t t) const
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int64_t vertex = this->Mesh.Triangles.Get(this->Order.GetTriangle(t), slot);
      this->Order.PrefetchRank(vertex);
      if (this->Uses)
      {
        delaunayflip::Prefetch(&this->Uses[vertex]);
      }
    }
  }
  DELAUNAYFLIP_HOST_DEVICE void operator()(std::int64_t t) const
  {
    TriangleRecord& record = this->Triangles[t];
    record.InputTriangle = this->Order.GetTriangle(t);
    record.Flips = IsUntouchable(this->Mesh, this->Uses, record.InputTriangle) ? UntouchableBit : 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      record.Vertices[slot] =
        this->Order.GetRank(this->Mesh.Triangles.Get(record.InputTriangle, slot));
    }
  }
};

/// Loads the triangles in the engine's order, the first part of an edge mesh. After this the ids of
/// the input and the order of its triangles are not needed any more.
template <typename Backend>
EdgeMesh LoadTriangles(const EdgeMeshInput& input, const Backend& backend)
{
  EdgeMesh edges;
  const TriangleMesh mesh = input.Input.Local;
  const SpatialOrderView order = input.Order.View();
  const bool allFinite = input.Survey.NonFinitePoints.Count == 0;
  const PointUse* uses = allFinite ? nullptr : input.Survey.Uses.Data();
  edges.NumberOfTriangles = mesh.Triangles.Count;
  edges.Triangles = backend.template MakeArray<TriangleRecord>(mesh.Triangles.Count);
  TriangleRecord* triangles = edges.Triangles.Data();
  backend.ForEach(mesh.Triangles.Count, LoadStep{ mesh, order, uses, triangles });
  return edges;
}

/// Pairs the corners of a slice, by a table for `expected` edges. @returns false if that is too
/// small.
template <typename Backend>
bool TryPairSlice(
  EdgeMeshResult& result, const VertexSlice& slice, std::int64_t expected, const Backend& backend)
{
  result.Table = EdgeTable();
  result.Table = EdgeTable(expected, slice, true, backend);
  const PairSums sums = backend.template Sum<PairSums>(3 * result.Edges.NumberOfTriangles,
    PairStep{ result.Table.View(), result.Edges.Triangles.Data() });
  // With a larger share of slots in use, later searches would be long.
  constexpr double LargestFill = 0.8;
  result.Counts.Edges += sums.Edges;
  result.Counts.NonManifold += sums.NonManifold;
  const auto capacity = static_cast<double>(result.Table.GetCapacity());
  return sums.Failures == 0 && static_cast<double>(sums.Edges) <= LargestFill * capacity;
}

/// Pairs the corners slice by slice, and numbers the edges. @returns whether all tables were large
/// enough.
template <typename Backend>
bool TryPairSlices(EdgeMeshResult& result, std::int64_t vertices, std::int64_t slices,
  std::int64_t expected, typename Backend::Numbering& numbering, const Backend& backend)
{
  const std::int64_t triangles = result.Edges.NumberOfTriangles;
  result.Counts.Edges = 0;
  result.Counts.NonManifold = 0;
  for (std::int64_t i = 0; i < slices; ++i)
  {
    const VertexSlice slice{ static_cast<VertexId>(vertices * i / slices),
      static_cast<VertexId>(vertices * (i + 1) / slices) };
    if (!TryPairSlice(result, slice, expected / slices, backend))
    {
      return false;
    }
    const RoleStep setRoles{ result.Table.View(), result.Edges.Triangles.Data() };
    if (i + 1 < slices)
    {
      backend.ForEach(triangles, setRoles);
      continue;
    }
    numbering = backend.Count(triangles, setRoles);
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
    expected = slices > 1 ? expected : 2 * expected + 1;
    slices = 1;
  }
  throw std::logic_error("the edge table runs full; please report this with the mesh");
}

/// Whether the builder will search for edges. A guard makes its own table, which needs no words.
inline bool NeedsTable(const EdgeMeshInput& input)
{
  return input.Input.Caller.NumberOfConstraintEdges > 0;
}

/// Finds the other corner of every corner's edge, in the way that suits the backend.
/// @returns the numbering of the edges.
template <typename Backend>
typename Backend::Numbering PairCorners(
  const EdgeMeshInput& input, EdgeMeshResult& result, const Backend& backend)
{
  if (NeedsTable(input))
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
  constexpr std::int64_t SmallestSliced = std::int64_t(1) << 20; // triangles
  const bool inSlices = result.Edges.NumberOfTriangles >= SmallestSliced;
  numbering = PairByTable(input, result, inSlices ? backend.CountTableSlices() : 1, backend);
  if (Backend::MemoryIsScarce)
  {
    result.Table = EdgeTable(); // frees its memory for the rest of the mesh
  }
  return numbering;
}

template <typename Backend>
void NumberEdges(
  EdgeMeshResult& result, const typename Backend::Numbering& numbering, const Backend& backend)
{
  EdgeMesh& edges = result.Edges;
  const std::int64_t size = edges.NumberOfTriangles;
  edges.NumberOfEdges = numbering.Total;
  const std::int64_t padded = (edges.NumberOfEdges + EdgeMesh::StatePadding - 1) /
    EdgeMesh::StatePadding * EdgeMesh::StatePadding;
  edges.CornerOfHalfEdge = backend.template MakeArray<CornerId>(2 * edges.NumberOfEdges);
  edges.States = backend.template MakeArray<EdgeState>(padded);
  const EdgeMeshView mesh = edges.View();
  const std::int64_t numberOfEdges = edges.NumberOfEdges;
  backend.ForEach(padded - numberOfEdges,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i)
    { mesh.States[numberOfEdges + i] = EdgeState::Fixed; });
  backend.ForEachNumbered(
    numbering, size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t) { return CountLeaders(mesh.Triangles[t]); },
    NumberStep{ mesh });
}

/// Pairs the corners of triangles and fixes the edges that must stay: boundary, non-manifold and
/// wrongly wound edges, edges of triangles that are frozen, duplicate, not finite or have repeated
/// ids, region borders, feature edges and constraints. All others are candidates.
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
  FixEdges(input, result, backend);
  result.Table.DropWords();
  return result;
}

}

#endif
