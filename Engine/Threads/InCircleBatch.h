// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INCIRCLEBATCH_H
#define DELAUNAYFLIP_INCIRCLEBATCH_H

#include "Atomics.h"
#include "EdgeMesh.h"
#include "FilteredPredicates.h"
#include "FlipRules.h"
#include "HostDevice.h"
#include "StepCounts.h"

#include <cstdint>
#include <cstring>

namespace delaunayflip
{

/// JudgeStep in the plane if all triangles turn to one side: collects the points of several edges
/// and judges the edges together, in the lanes of vector registers.
template <typename Real>
class InCircleBatch
{
public:
  using Rule = PlanarRule<Real, 2>;

  InCircleBatch(const EdgeMeshView& mesh, const Rule& rule)
    : Mesh(mesh),
      Decision(rule)
  {
  }

  static bool Suits(const Rule& rule) { return rule.UniformSide != 0 && rule.FiltersApply; }

  /// A triangle, with its vertices in any order of the same turn, and the vertex opposite to it.
  struct Vertices
  {
    VertexId Ids[4];
  };

  Vertices Load(EdgeId edge) const
  {
    const CornerPair corners = this->Mesh.GetCorners(edge);
    const VertexId* triangle = this->Mesh.Triangles[TriangleOf(corners.A)].Vertices;
    return { { triangle[0], triangle[1], triangle[2],
      this->Mesh.Triangles[TriangleOf(corners.B)].Vertices[SlotOf(corners.B)] } };
  }

  void Prefetch(const Vertices& vertices) const
  {
    for (const VertexId vertex : vertices.Ids)
    {
      delaunayflip::Prefetch(this->Decision.Address(vertex));
    }
  }

  /// Adds edge i, counted from 0, and judges the batch when it is full.
  void Add(const EdgeId* edges, std::int64_t i, const Vertices& vertices, StepCounts& counts)
  {
    const std::int64_t lane = i % Size;
    for (int corner = 0; corner < 4; ++corner)
    {
      std::memcpy(
        this->Points[corner][lane], this->Decision.Address(vertices.Ids[corner]), sizeof(Real[2]));
    }
    if (lane == Size - 1)
    {
      this->Judge(edges + i - lane, Size, counts);
    }
  }

  /// Judges the remaining edges, of `size` in all.
  void Finish(const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    this->Judge(edges + size / Size * Size, size % Size, counts);
    counts.Tested += size;
  }

  EdgeMeshView Mesh;

private:
  static constexpr int Size = 8;
  static constexpr auto Good = static_cast<std::int64_t>(EdgeState::Good);
  static constexpr auto Uncertain = static_cast<std::int64_t>(EdgeState::Uncertain);
  static constexpr auto Bad = static_cast<std::int64_t>(EdgeState::Bad);

  void Judge(const EdgeId* edges, std::int64_t size, StepCounts& counts)
  {
    // As wide as double, so that results stay in their lanes.
    std::int64_t states[Size];
    const auto side = static_cast<double>(this->Decision.UniformSide);
    for (int i = 0; i < Size; ++i)
    {
      const FilteredDeterminant determinant =
        InCircleDeterminant(this->Get(0, i), this->Get(1, i), this->Get(2, i), this->Get(3, i));
      const double value = side * determinant.Value;
      const double bound = GetBound(InCircleBound * determinant.Permanent);
      const std::int64_t other = -value > bound ? Good : Uncertain;
      states[i] = value > bound ? Bad : other;
    }
    for (std::int64_t i = 0; i < size; ++i)
    {
      AtomicStore(&this->Mesh.States[edges[i]], static_cast<EdgeState>(states[i]));
      counts.Uncertain += states[i] == Uncertain ? 1 : 0;
    }
  }

  PlanePoint Get(int corner, int i) const
  {
    return { this->Points[corner][i][0], this->Points[corner][i][1], 0.0 };
  }

  Rule Decision;
  Real Points[4][Size][2] = {};
};

}

#endif
