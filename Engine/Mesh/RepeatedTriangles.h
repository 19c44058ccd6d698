// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REPEATEDTRIANGLES_H
#define DELAUNAYFLIP_REPEATEDTRIANGLES_H

#include "Array.h"
#include "EdgeMesh.h"
#include "EdgeTable.h"
#include "FlipReport.h"
#include "InputChecks.h"

#include <algorithm>
#include <cstdint>

/// @file
/// Finds the triangles of an edge mesh that have the points of another one.

namespace delaunayflip
{

/// Whether every edge of a triangle has more than two triangles, or two on the same three points.
/// This holds for every triangle with a duplicate.
DELAUNAYFLIP_HOST_DEVICE inline bool MayBeRepeated(const EdgeMeshView& mesh, std::int64_t t)
{
  const TriangleRecord& triangle = mesh.Triangles[t];
  bool may = true;
  for (int slot = 0; slot < 3 && may; ++slot)
  {
    const CornerRole role = GetRole(triangle, slot);
    may = role == CornerRole::OneOfMany;
    if (role == CornerRole::Leader || role == CornerRole::Follower)
    {
      const Quad quad = mesh.GetQuad(EdgeOf(triangle.HalfEdges[slot]));
      may = quad.A == quad.B;
    }
  }
  return may;
}

/// The vertices of a triangle, ascending, and the caller's slot of it.
struct SortedTriangle
{
  std::uint32_t Vertices[3];
  std::uint32_t Slot;

  DELAUNAYFLIP_HOST_DEVICE explicit SortedTriangle(const TriangleRecord& triangle)
    : Slot(triangle.InputTriangle)
  {
    const std::uint32_t* v = triangle.Vertices;
    const std::uint32_t low = std::min(v[0], v[1]);
    const std::uint32_t high = std::max(v[0], v[1]);
    this->Vertices[0] = std::min(low, v[2]);
    this->Vertices[1] = std::max(low, std::min(high, v[2]));
    this->Vertices[2] = std::max(high, v[2]);
  }
  DELAUNAYFLIP_HOST_DEVICE std::uint32_t GetHash() const
  {
    return Scatter(this->Vertices[0] + Scatter(this->Vertices[1] + Scatter(this->Vertices[2])));
  }
  DELAUNAYFLIP_HOST_DEVICE bool HasVerticesOf(const SortedTriangle& other) const
  {
    return this->Vertices[0] == other.Vertices[0] && this->Vertices[1] == other.Vertices[1] &&
      this->Vertices[2] == other.Vertices[2];
  }
};

/// Finds the `suspects` that have the vertices of one in a smaller slot.
template <typename Backend>
IdSample FindRepeated(const SortedTriangle* suspects, std::int64_t count, const Backend& backend)
{
  constexpr int KeyBits = 32;
  const Array<std::uint32_t> bySlot = backend.template SortIndices<KeyBits>(
    count, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return suspects[i].Slot; });
  const std::uint32_t* suspectOf = bySlot.Data();
  // Equal triangles become neighbours, and those in smaller slots come first.
  const Array<std::uint32_t> byHash = backend.template SortIndices<KeyBits>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i) { return suspects[suspectOf[i]].GetHash(); });
  const std::uint32_t* rankOf = byHash.Data();
  return backend.template Sum<IdSample>(count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, IdSample & sum)
    {
      const SortedTriangle own = suspects[suspectOf[rankOf[i]]];
      for (std::int64_t j = i - 1; j >= 0; --j)
      {
        const SortedTriangle& before = suspects[suspectOf[rankOf[j]]];
        if (before.HasVerticesOf(own))
        {
          sum.Note(own.Slot);
          return;
        }
        if (before.GetHash() != own.GetHash())
        {
          return;
        }
      }
    });
}

/// The triangles with the same points as one in a smaller slot.
template <typename Backend>
Defect FindDuplicates(EdgeMesh& edges, const Backend& backend)
{
  const EdgeMeshView mesh = edges.View();
  const auto count = [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t)
  { return int(MayBeRepeated(mesh, t)); };
  const typename Backend::Numbering numbering = backend.Count(edges.NumberOfTriangles, count);
  IdSample repeated; // none in a clean mesh
  if (numbering.Total > 0)
  {
    Array<SortedTriangle> found = backend.template MakeArray<SortedTriangle>(numbering.Total);
    SortedTriangle* suspects = found.Data();
    backend.ForEachNumbered(numbering, edges.NumberOfTriangles, count,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t number)
      {
        if (MayBeRepeated(mesh, t))
        {
          suspects[number] = SortedTriangle(mesh.Triangles[t]);
        }
      });
    repeated = FindRepeated(suspects, numbering.Total, backend);
  }
  return MakeDefect(DefectKind::DuplicateTriangles, repeated);
}

}

#endif
