// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMeshBuilder.h"

#include "EdgeMeshSteps.h"
#include "FixedEdges.h"
#include "FlipError.h"

#include <algorithm>

namespace delaunayflip
{

namespace
{
/// 4 * triangle + slot, and 2 * edge + side with at most 3 edges a triangle, must stay below 2^32.
constexpr std::int64_t LargestMesh = ((std::int64_t(1) << 32) - 2) / 6;
constexpr std::int64_t MostPoints = (std::int64_t(1) << 32) - 2;

class Builder
{
public:
  Builder(const EdgeMeshInput& input, const ThreadBackend& backend)
    : Input(input),
      Backend(backend)
  {
  }

  EdgeMeshResult Build()
  {
    this->LoadTriangles();
    this->Input.Order.TriangleOfRank = Array<TriangleId>();
    this->PairCorners();
    this->FindRoles();
    this->NumberEdges();
    this->LinkEdges();
    FixEdges(this->Input, this->Result, this->Backend);
    this->Result.Table.DropWords();
    return std::move(this->Result);
  }

private:
  EdgeMeshView View() { return this->Result.Edges.View(); }

  void LoadTriangles()
  {
    const TriangleArray& triangles = this->Input.Mesh.Triangles;
    EdgeMesh& edges = this->Result.Edges;
    edges.NumberOfTriangles = triangles.Count;
    edges.Triangles = Array<TriangleRecord>(triangles.Count);
    this->Backend.ForRange(triangles.Count,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t t = begin; t < end; ++t)
        {
          TriangleRecord& record = edges.Triangles[t];
          record.InputTriangle = this->Input.Order.GetTriangle(t);
          record.FlipCount = this->IsUntouchable(record.InputTriangle) ? UntouchableBit : 0;
          for (int slot = 0; slot < 3; ++slot)
          {
            record.Vertices[slot] =
              this->Input.Order.GetRank(triangles.Get(record.InputTriangle, slot));
          }
        }
      });
  }

  /// A closed mesh has 3/2 edges a triangle; others show by a table that runs full.
  void PairCorners()
  {
    const std::int64_t corners = 3 * this->Result.Edges.NumberOfTriangles;
    for (std::int64_t expected = corners / 2 + corners / 100;; expected = 2 * expected)
    {
      this->Result.Table =
        EdgeTable(std::min(expected, corners), this->Input.Mesh.Points.Count, true, this->Backend);
      if (this->TryPairCorners())
      {
        return;
      }
    }
  }

  struct PairSums
  {
    std::int64_t Edges = 0, NonManifold = 0, Failures = 0;

    PairSums& operator+=(const PairSums& part)
    {
      this->Edges += part.Edges;
      this->NonManifold += part.NonManifold;
      this->Failures += part.Failures;
      return *this;
    }
  };

  bool TryPairCorners()
  {
    const EdgeTableView table = this->Result.Table.View();
    TriangleRecord* triangles = this->Result.Edges.Triangles.Data();
    const PairSums sums = this->Backend.Sum<PairSums>(this->Result.Edges.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        PairSums part;
        for (std::int64_t t = begin; t < end && part.Failures == 0; ++t)
        {
          this->PairTriangle(table, triangles, static_cast<TriangleId>(t), part);
        }
        return part;
      });
    // Above this share of slots in use, later searches would be long.
    constexpr double LargestFill = 0.8;
    this->Result.Counts.Edges = sums.Edges;
    this->Result.Counts.NonManifold = sums.NonManifold;
    const std::int64_t capacity = this->Result.Table.GetCapacity();
    return sums.Failures == 0 && static_cast<double>(sums.Edges) <= LargestFill * capacity;
  }

  static void PairTriangle(
    const EdgeTableView& table, TriangleRecord* triangles, TriangleId t, PairSums& sums)
  {
    for (int slot = 0; slot < 3; ++slot)
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
  }

  /// Stores every corner's role, and the number of edges that each piece of triangles leads.
  void FindRoles()
  {
    const EdgeTableView table = this->Result.Table.View();
    TriangleRecord* triangles = this->Result.Edges.Triangles.Data();
    const std::int64_t size = this->Result.Edges.NumberOfTriangles;
    this->FirstEdges.assign(size / ThreadBackend::DefaultGrain + 2, 0);
    this->Backend.ForRange(size,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t leaders = 0;
        for (std::int64_t t = begin; t < end; ++t)
        {
          for (int slot = 0; slot < 3; ++slot)
          {
            const CornerRole role = FindRole(
              table, triangles[t].HalfEdges[slot], MakeCorner(static_cast<TriangleId>(t), slot));
            triangles[t].FlipCount |= static_cast<std::uint32_t>(role) << (2 * slot);
            leaders += role == CornerRole::Follower ? 0 : 1;
          }
        }
        this->FirstEdges[begin / ThreadBackend::DefaultGrain + 1] = leaders;
      });
    for (std::size_t i = 1; i < this->FirstEdges.size(); ++i)
    {
      this->FirstEdges[i] += this->FirstEdges[i - 1];
    }
  }

  void NumberEdges()
  {
    EdgeMesh& edges = this->Result.Edges;
    edges.NumberOfEdges = this->FirstEdges.back();
    edges.CornerOfHalfEdge = Array<CornerId>(2 * edges.NumberOfEdges);
    edges.States = Array<EdgeState>((edges.NumberOfEdges + 7) / 8 * 8);
    std::fill(edges.States.Data() + edges.NumberOfEdges, edges.States.Data() + edges.States.Size(),
      EdgeState::Fixed);
    const EdgeTableView table = this->Result.Table.View();
    const EdgeMeshView mesh = this->View();
    this->Backend.ForRange(edges.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        EdgeId next = static_cast<EdgeId>(this->FirstEdges[begin / ThreadBackend::DefaultGrain]);
        for (std::int64_t t = begin; t < end; ++t)
        {
          const TriangleRecord& triangle = mesh.Triangles[t];
          for (int slot = 0; slot < 3; ++slot)
          {
            const CornerRole role = GetRole(triangle, slot);
            if (role == CornerRole::Follower)
            {
              continue;
            }
            mesh.States[next] =
              role == CornerRole::Leader ? EdgeState::Candidate : EdgeState::Fixed;
            NumberEdge(mesh, table, triangle.HalfEdges[slot],
              MakeCorner(static_cast<TriangleId>(t), slot), next++);
          }
        }
      });
  }

  void LinkEdges()
  {
    const EdgeMeshView mesh = this->View();
    this->Backend.ForRange(this->Result.Edges.NumberOfEdges,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t e = begin; e < end; ++e)
        {
          LinkEdge(mesh, static_cast<EdgeId>(e));
        }
      });
  }

  bool IsUntouchable(TriangleId inputTriangle) const
  {
    const TriangleMesh& mesh = this->Input.Mesh;
    const std::int64_t p = mesh.Triangles.Get(inputTriangle, 0);
    const std::int64_t q = mesh.Triangles.Get(inputTriangle, 1);
    const std::int64_t r = mesh.Triangles.Get(inputTriangle, 2);
    const Array<PointUse>& uses = this->Input.Survey.Uses;
    return (mesh.FrozenTriangles && mesh.FrozenTriangles[inputTriangle] != 0) || p == q || q == r ||
      r == p || uses[p] == PointUse::NotFinite || uses[q] == PointUse::NotFinite ||
      uses[r] == PointUse::NotFinite;
  }

  const EdgeMeshInput& Input;
  const ThreadBackend& Backend;
  std::vector<std::int64_t> FirstEdges; ///< Number of the first edge that each piece leads.
  EdgeMeshResult Result;
};
}

void CheckMeshSize(const TriangleMesh& mesh)
{
  if (mesh.Triangles.Count > LargestMesh || mesh.Points.Count > MostPoints)
  {
    throw MeshTooLarge("the mesh has " + std::to_string(mesh.Triangles.Count) + " triangles and " +
      std::to_string(mesh.Points.Count) + " points; at most " + std::to_string(LargestMesh) +
      " triangles and " + std::to_string(MostPoints) +
      " points are supported: split the mesh into parts");
  }
}

EdgeMeshResult BuildEdgeMesh(const EdgeMeshInput& input, const ThreadBackend& backend)
{
  return Builder(input, backend).Build();
}

}
