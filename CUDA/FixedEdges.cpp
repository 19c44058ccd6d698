// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FixedEdges.h"

#include "EdgeMeshSteps.h"
#include "FlipError.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace delaunayflip
{

namespace
{
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

class EdgeFixer
{
public:
  EdgeFixer(const EdgeMeshInput& input, EdgeMeshResult& result, const ThreadBackend& backend)
    : Input(input),
      Result(result),
      Backend(backend),
      FeatureCosine(std::cos(input.FeatureAngle * DegreesToRadians))
  {
  }

  void Fix()
  {
    this->FixByInput();
    this->FindDuplicateTriangles();
    this->ForgetRoles();
    this->FixConstraints();
  }

private:
  /// Fixes what topology, the caller and the input's shape ask for, and counts it.
  void FixByInput()
  {
    const EdgeMeshView mesh = this->Result.Edges.View();
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
    const EdgeMeshView mesh = this->Result.Edges.View();
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
    this->Backend.ForRange(this->Result.Edges.NumberOfTriangles,
      [triangles](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t t = begin; t < end; ++t)
        {
          triangles[t].FlipCount = 0;
        }
      });
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
  EdgeMeshResult& Result;
  const ThreadBackend& Backend;
  double FeatureCosine;
};
}

void FixEdges(const EdgeMeshInput& input, EdgeMeshResult& result, const ThreadBackend& backend)
{
  EdgeFixer(input, result, backend).Fix();
}

}
