// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMeshBuilder.h"

#include "EdgeMeshSteps.h"
#include "FlipError.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace delaunayflip
{

namespace
{
/// 4 * triangle + slot, and 2 * edge + side with at most 3 edges a triangle, must stay below 2^32.
constexpr std::int64_t LargestMesh = ((std::int64_t(1) << 32) - 2) / 6;
constexpr std::int64_t MostPoints = (std::int64_t(1) << 32) - 2;

/// Why edges were fixed. Every count is of edges, a non-manifold one once.
struct FixedSums : EdgeCounts
{
  std::int64_t OneOfMany = 0; ///< Edge records of non-manifold edges.

  FixedSums& operator+=(const FixedSums& part)
  {
    this->Boundary += part.Boundary;
    this->WronglyWound += part.WronglyWound;
    this->Feature += part.Feature;
    this->Region += part.Region;
    this->Fixed += part.Fixed;
    this->OneOfMany += part.OneOfMany;
    return *this;
  }
};

/// Vertices of a triangle, ascending, and the caller's slot.
using Suspect = std::array<std::uint32_t, 4>;

struct Suspects
{
  std::vector<Suspect> List;

  Suspects& operator+=(const Suspects& part)
  {
    this->List.insert(this->List.end(), part.List.begin(), part.List.end());
    return *this;
  }
};

class Builder
{
public:
  Builder(const EdgeMeshInput& input, const ThreadBackend& backend)
    : Input(input),
      Backend(backend),
      FeatureCosine(std::cos(input.FeatureAngle * DegreesToRadians))
  {
  }

  EdgeMeshResult Build()
  {
    this->LoadTriangles();
    this->PairCorners();
    this->FindRoles();
    this->NumberEdges();
    this->LinkEdges();
    this->FixEdges();
    this->FindDuplicateTriangles();
    this->ForgetRoles();
    this->FixConstraints();
    this->Result.Table.DropWords();
    return std::move(this->Result);
  }

private:
  EdgeMeshView View() { return this->Result.Edges.View(); }

  /// Calls work(triangle, slot) for every corner.
  template <typename Work>
  void ForCorners(const Work& work)
  {
    this->Backend.ForRange(this->Result.Edges.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t t = begin; t < end; ++t)
        {
          for (int slot = 0; slot < 3; ++slot)
          {
            work(static_cast<TriangleId>(t), slot);
          }
        }
      });
  }

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

  /// Fixes what topology, the caller and the input's shape ask for, and counts it.
  void FixEdges()
  {
    const EdgeMeshView mesh = this->View();
    const FixedSums sums = this->Backend.Sum<FixedSums>(this->Result.Edges.NumberOfEdges,
      [&](std::int64_t begin, std::int64_t end)
      {
        FixedSums part;
        for (std::int64_t e = begin; e < end; ++e)
        {
          this->FixEdge(mesh, static_cast<EdgeId>(e), part);
        }
        return part;
      });
    EdgeCounts& counts = this->Result.Counts;
    counts.Boundary = sums.Boundary;
    counts.WronglyWound = sums.WronglyWound;
    counts.Feature = sums.Feature;
    counts.Region = sums.Region;
    counts.Fixed = sums.Fixed - sums.OneOfMany + counts.NonManifold;
  }

  /// Whether an edge joins more triangles than two, or two on the same three points, as all edges
  /// of a triangle that another one repeats do.
  static bool MayJoinDuplicates(const EdgeMeshView& mesh, const TriangleRecord& triangle, int slot)
  {
    const CornerRole role = GetRole(triangle, slot);
    if (role == CornerRole::Alone || role == CornerRole::OneOfMany)
    {
      return role == CornerRole::OneOfMany;
    }
    const Quad quad = mesh.GetQuad(EdgeOf(triangle.HalfEdges[slot]));
    return quad.A == quad.B;
  }

  /// Triangles that another one may repeat: none in a clean mesh.
  Suspects FindSuspects()
  {
    const EdgeMeshView mesh = this->View();
    return this->Backend.Sum<Suspects>(this->Result.Edges.NumberOfTriangles,
      [&](std::int64_t begin, std::int64_t end)
      {
        Suspects part;
        for (std::int64_t t = begin; t < end; ++t)
        {
          const TriangleRecord& triangle = mesh.Triangles[t];
          if (MayJoinDuplicates(mesh, triangle, 0) && MayJoinDuplicates(mesh, triangle, 1) &&
            MayJoinDuplicates(mesh, triangle, 2))
          {
            const VertexId* v = triangle.Vertices;
            part.List.push_back({ v[0], v[1], v[2], triangle.InputTriangle });
            std::sort(part.List.back().begin(), part.List.back().begin() + 3);
          }
        }
        return part;
      });
  }

  void FindDuplicateTriangles()
  {
    std::vector<Suspect> suspects = this->FindSuspects().List;
    std::sort(suspects.begin(), suspects.end());
    std::vector<std::int64_t> repeated;
    for (std::size_t i = 1; i < suspects.size(); ++i)
    {
      if (std::equal(suspects[i].begin(), suspects[i].begin() + 3, suspects[i - 1].begin()))
      {
        repeated.push_back(suspects[i][3]);
      }
    }
    std::sort(repeated.begin(), repeated.end());
    this->Result.DuplicateTriangles.What = "triangles that repeat another one's points";
    for (const std::int64_t triangle : repeated)
    {
      Note(this->Result.DuplicateTriangles, triangle);
    }
  }

  /// From here on FlipCount counts flips.
  void ForgetRoles()
  {
    TriangleRecord* triangles = this->Result.Edges.Triangles.Data();
    this->ForCorners([&](TriangleId t, int) { triangles[t].FlipCount = 0; });
  }

  void FixEdge(const EdgeMeshView& mesh, EdgeId edge, FixedSums& sums) const
  {
    const CornerId corner = mesh.CornerOfHalfEdge[2 * edge];
    const TriangleRecord& triangle = mesh.Triangles[TriangleOf(corner)];
    if (IsLoop(triangle, SlotOf(corner)))
    {
      mesh.States[edge] =
        EdgeState::Fixed; // of a triangle with a repeated id; no edge, not counted
      return;
    }
    const CornerRole role = GetRole(triangle, SlotOf(corner));
    sums.Boundary += role == CornerRole::Alone ? 1 : 0;
    sums.OneOfMany += role == CornerRole::OneOfMany ? 1 : 0;
    if (role != CornerRole::Leader || this->MustStay(mesh, edge, sums))
    {
      mesh.States[edge] = EdgeState::Fixed;
      ++sums.Fixed;
    }
  }

  /// Whether an edge of two triangles must stay.
  bool MustStay(const EdgeMeshView& mesh, EdgeId edge, FixedSums& sums) const
  {
    const Quad quad = mesh.GetQuad(edge);
    const TriangleRecord& a = mesh.Triangles[TriangleOf(quad.CornerA)];
    const TriangleRecord& b = mesh.Triangles[TriangleOf(quad.CornerB)];
    const bool wronglyWound = !IsConsistentlyWound(mesh, edge);
    const bool duplicate = quad.A == quad.B;
    const bool region = this->Input.Mesh.Regions &&
      this->Input.Mesh.Regions[a.InputTriangle] != this->Input.Mesh.Regions[b.InputTriangle];
    const bool feature = !wronglyWound && this->IsFeature(quad);
    sums.WronglyWound += wronglyWound ? 1 : 0;
    sums.Region += region ? 1 : 0;
    sums.Feature += feature ? 1 : 0;
    return wronglyWound || duplicate || region || feature ||
      ((a.FlipCount | b.FlipCount) & UntouchableBit) != 0;
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

  bool IsFeature(const Quad& quad) const
  {
    if (this->Input.Survey.Geometry != GeometryKind::Surface || this->Input.FeatureAngle >= 180.0)
    {
      return false;
    }
    return IsSharp({ this->GetPoint(quad.A), this->GetPoint(quad.P), this->GetPoint(quad.Q),
                     this->GetPoint(quad.B) },
      this->FeatureCosine);
  }

  Vector3 GetPoint(VertexId rank) const
  {
    return LoadScaled(
      this->Input.Mesh.Points, this->Input.Order.GetVertex(rank), this->Input.Survey.Scale);
  }

  /// Sequential: constraints are few beside the mesh, and each look-up is short.
  void FixConstraints()
  {
    const TriangleMesh& mesh = this->Input.Mesh;
    const EdgeTableView table = this->Result.Table.View();
    for (std::int64_t i = 0; i < mesh.NumberOfConstraintEdges; ++i)
    {
      const std::int64_t a = this->CheckConstraint(i, mesh.ConstraintEdges[2 * i]);
      const std::int64_t b = this->CheckConstraint(i, mesh.ConstraintEdges[2 * i + 1]);
      const std::uint32_t slot =
        table.Find(EdgeKey(this->Input.Order.GetRank(a), this->Input.Order.GetRank(b)));
      if (a == b || slot == EdgeTableView::NoSlot)
      {
        this->Result.MissingConstraints += a == b ? 0 : 1;
        continue;
      }
      this->FixConstraint(table, slot);
    }
  }

  std::int64_t CheckConstraint(std::int64_t constraint, std::int64_t point) const
  {
    if (point < 0 || point >= this->Input.Mesh.Points.Count)
    {
      throw InvalidMesh("constraint edge " + std::to_string(constraint) + " names point " +
          std::to_string(point) + ", but the mesh has points 0 to " +
          std::to_string(this->Input.Mesh.Points.Count - 1),
        constraint, point);
    }
    return point;
  }

  void FixConstraint(const EdgeTableView& table, std::uint32_t slot)
  {
    constexpr CornerId Seen = 0xFFFFFFFDu; // a constraint given twice counts once
    const CornerId second = table.Second[slot];
    if (second == Seen)
    {
      return;
    }
    table.Second[slot] = Seen;
    ++this->Result.Counts.Constraint;
    EdgeState& state = this->Result.Edges.States[second == ManyCorners ? 0 : table.First[slot]];
    if (second != ManyCorners && state != EdgeState::Fixed)
    {
      state = EdgeState::Fixed;
      ++this->Result.Counts.Fixed;
    }
  }

  const EdgeMeshInput& Input;
  const ThreadBackend& Backend;
  double FeatureCosine;
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
