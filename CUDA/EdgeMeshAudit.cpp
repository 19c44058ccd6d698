// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeMeshAudit.h"

#include <stdexcept>
#include <string>

namespace delaunayflip
{

namespace
{
bool IsCorner(const EdgeMesh& mesh, CornerId corner)
{
  return static_cast<std::int64_t>(TriangleOf(corner)) < mesh.NumberOfTriangles &&
    SlotOf(corner) < 3;
}

/// Corners of a triangle that their half-edges do not name.
std::int64_t CountStrayCorners(const EdgeMesh& mesh, std::int64_t t)
{
  std::int64_t stray = 0;
  for (int slot = 0; slot < 3; ++slot)
  {
    const HalfEdgeId halfEdge = mesh.Triangles[t].HalfEdges[slot];
    const bool named = static_cast<std::int64_t>(EdgeOf(halfEdge)) < mesh.NumberOfEdges &&
      mesh.CornerOfHalfEdge[halfEdge] == MakeCorner(static_cast<TriangleId>(t), slot);
    stray += named ? 0 : 1;
  }
  return stray;
}

/// Start and end of an edge as the triangle of one side runs through it.
struct Direction
{
  VertexId Start, End, Opposite;
};

Direction GetDirection(const EdgeMesh& mesh, CornerId corner)
{
  const TriangleRecord& triangle = mesh.Triangles[TriangleOf(corner)];
  const int slot = SlotOf(corner);
  return { triangle.Vertices[NextSlot(slot)], triangle.Vertices[PreviousSlot(slot)],
    triangle.Vertices[slot] };
}

/// Whether the sides of an edge belong together.
bool IsSound(const EdgeMesh& mesh, std::int64_t e)
{
  const CornerId a = mesh.CornerOfHalfEdge[2 * e];
  const CornerId b = mesh.CornerOfHalfEdge[2 * e + 1];
  if (!IsCorner(mesh, a) || (b != NoCorner && !IsCorner(mesh, b)))
  {
    return false;
  }
  const bool fixed = mesh.States[e] == EdgeState::Fixed;
  if (b == NoCorner)
  {
    return fixed;
  }
  const Direction upper = GetDirection(mesh, a);
  const Direction lower = GetDirection(mesh, b);
  const bool opposed = upper.Start == lower.End && upper.End == lower.Start;
  const bool alike = upper.Start == lower.Start && upper.End == lower.End;
  return fixed ? opposed || alike : opposed && upper.Opposite != lower.Opposite;
}
}

std::int64_t CountInconsistencies(const EdgeMesh& mesh, const ThreadBackend& backend)
{
  const std::int64_t stray = backend.Sum<std::int64_t>(mesh.NumberOfTriangles,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::int64_t count = 0;
      for (std::int64_t t = begin; t < end; ++t)
      {
        count += CountStrayCorners(mesh, t);
      }
      return count;
    });
  return stray +
    backend.Sum<std::int64_t>(mesh.NumberOfEdges,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::int64_t count = 0;
        for (std::int64_t e = begin; e < end; ++e)
        {
          count += IsSound(mesh, e) ? 0 : 1;
        }
        return count;
      });
}

void RequireConsistent(const EdgeMesh& mesh, const ThreadBackend& backend)
{
  const std::int64_t count = CountInconsistencies(mesh, backend);
  if (count > 0)
  {
    throw std::logic_error("the edge mesh broke: " + std::to_string(count) +
      " half-edges are inconsistent; please report this with the mesh");
  }
}

}
