// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHBUILDER_H
#define DELAUNAYFLIP_EDGEMESHBUILDER_H

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
/// Triangles into an edge mesh, in time linear in their number whatever the vertex degrees.

namespace delaunayflip
{

struct PairSums
{
  std::int64_t Edges = 0, NonManifold = 0, Failures = 0;

  DELAUNAYFLIP_HOST_DEVICE PairSums& operator+=(const PairSums& part)
  {
    this->Edges += part.Edges;
    this->NonManifold += part.NonManifold;
    this->Failures += part.Failures;
    return *this;
  }
};

/// Finds or makes the table entry of the edge opposite a corner and adds the corner to it.
DELAUNAYFLIP_HOST_DEVICE inline void PairCorner(
  const EdgeTableView& table, TriangleRecord* triangles, TriangleId t, int slot, PairSums& sums)
{
  bool inserted = false;
  const std::uint32_t entry = table.FindOrInsert(KeyOpposite(triangles[t], slot), inserted);
  if (entry == EdgeTableView::NoSlot)
  {
    ++sums.Failures;
    return;
  }
  const bool many = AttachCorner(table, entry, MakeCorner(t, slot), inserted);
  const bool isEdge = !IsLoop(triangles[t], slot);
  sums.Edges += isEdge && inserted ? 1 : 0;
  sums.NonManifold += isEdge && many ? 1 : 0;
  triangles[t].HalfEdges[slot] = entry;
}

/// Stores the roles of a triangle's corners. @returns the number of edges that it leads.
DELAUNAYFLIP_HOST_DEVICE inline int FindRoles(
  const EdgeTableView& table, TriangleRecord* triangles, TriangleId t)
{
  TriangleRecord& triangle = triangles[t];
  // All three are read before anything is written, so that they are on their way together.
  std::uint32_t roles = 0;
  for (int slot = 0; slot < 3; ++slot)
  {
    const CornerRole role = FindRole(table, triangle.HalfEdges[slot], MakeCorner(t, slot));
    roles |= static_cast<std::uint32_t>(role) << (2 * slot);
  }
  triangle.FlipCount |= roles;
  return CountLeaders(triangle);
}

/// Numbers the edges that a triangle leads, from `next` on.
DELAUNAYFLIP_HOST_DEVICE inline void NumberTriangle(
  const EdgeMeshView& mesh, const EdgeTableView& table, TriangleId t, EdgeId next)
{
  const TriangleRecord& triangle = mesh.Triangles[t];
  for (int slot = 0; slot < 3; ++slot)
  {
    const CornerRole role = GetRole(triangle, slot);
    if (role != CornerRole::Follower)
    {
      mesh.States[next] = role == CornerRole::Leader ? EdgeState::Candidate : EdgeState::Fixed;
      NumberEdge(mesh, table, triangle.HalfEdges[slot], MakeCorner(t, slot), next++);
    }
  }
}

template <typename Backend>
void LoadTriangles(const EdgeMeshInput& input, EdgeMesh& edges, const Backend& backend)
{
  const TriangleMesh mesh = input.Input.Local;
  const SpatialOrderView order = input.Order.View();
  const PointUse* uses = input.Survey.Uses.Data();
  edges.NumberOfTriangles = mesh.Triangles.Count;
  edges.Triangles = backend.template MakeArray<TriangleRecord>(mesh.Triangles.Count);
  TriangleRecord* triangles = edges.Triangles.Data();
  backend.ForEach(mesh.Triangles.Count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    {
      TriangleRecord& record = triangles[t];
      record.InputTriangle = order.GetTriangle(t);
      record.FlipCount = IsUntouchable(mesh, uses, record.InputTriangle) ? UntouchableBit : 0;
      for (int slot = 0; slot < 3; ++slot)
      {
        record.Vertices[slot] = order.GetRank(mesh.Triangles.Get(record.InputTriangle, slot));
      }
    });
}

/// @returns false when the table is too small.
template <typename Backend>
bool TryPairCorners(EdgeMeshResult& result, const Backend& backend)
{
  const EdgeTableView table = result.Table.View();
  TriangleRecord* triangles = result.Edges.Triangles.Data();
  const PairSums sums = backend.template Sum<PairSums>(3 * result.Edges.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t corner, PairSums & part)
    {
      // A table that has failed once is thrown away.
      if (part.Failures == 0)
      {
        PairCorner(table, triangles, static_cast<TriangleId>(corner / 3),
          static_cast<int>(corner % 3), part);
      }
    });
  // Above this share of slots in use, later searches would be long.
  constexpr double LargestFill = 0.8;
  result.Counts.Edges = sums.Edges;
  result.Counts.NonManifold = sums.NonManifold;
  const auto capacity = static_cast<double>(result.Table.GetCapacity());
  return sums.Failures == 0 && static_cast<double>(sums.Edges) <= LargestFill * capacity;
}

/// A closed mesh has 3/2 edges a triangle; others show by a table that runs full.
template <typename Backend>
void PairCorners(EdgeMeshResult& result, std::int64_t points, const Backend& backend)
{
  const std::int64_t corners = 3 * result.Edges.NumberOfTriangles;
  for (std::int64_t expected = corners / 2 + corners / 100; expected <= 4 * corners + 4;
       expected = 2 * expected + 1)
  {
    result.Table = EdgeTable();
    result.Table = EdgeTable(std::min(expected, corners), points, true, backend);
    if (TryPairCorners(result, backend))
    {
      return;
    }
  }
  throw std::logic_error("the edge table runs full; please report this with the mesh");
}

template <typename Backend>
void NumberEdges(EdgeMeshResult& result, const Backend& backend)
{
  EdgeMesh& edges = result.Edges;
  const std::int64_t size = edges.NumberOfTriangles;
  const EdgeTableView table = result.Table.View();
  TriangleRecord* triangles = edges.Triangles.Data();
  const auto numbering = backend.Count(size,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
    { return FindRoles(table, triangles, static_cast<TriangleId>(t)); });
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
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t first)
    { NumberTriangle(mesh, table, static_cast<TriangleId>(t), static_cast<EdgeId>(first)); });
}

/// Pairs the triangles' sides through an EdgeTable and fixes the edges that must stay: boundary,
/// non-manifold and wrongly wound ones, those of frozen, repeated-id, duplicate and non-finite
/// triangles, region borders, feature edges, constraints. All others are candidates.
///
/// EdgeId = rank of the edge's smallest incident corner in the engine's order, on every backend.
/// @throws InvalidMesh for a constraint that names no point.
template <typename Backend>
EdgeMeshResult BuildEdgeMesh(const EdgeMeshInput& input, const Backend& backend)
{
  EdgeMeshResult result;
  LoadTriangles(input, result.Edges, backend);
  input.Order.TriangleOfRank = Array<TriangleId>();
  PairCorners(result, input.Input.Local.Points.Count, backend);
  NumberEdges(result, backend);
  const EdgeMeshView mesh = result.Edges.View();
  backend.ForEach(result.Edges.NumberOfEdges,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e) { LinkEdge(mesh, static_cast<EdgeId>(e)); });
  FixEdges(input, result, backend);
  result.Table.DropWords();
  return result;
}

}

#endif
