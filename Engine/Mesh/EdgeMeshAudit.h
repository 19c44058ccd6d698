// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EDGEMESHAUDIT_H
#define DELAUNAYFLIP_EDGEMESHAUDIT_H

#include "EdgeMesh.h"
#include "HostDevice.h"

#include <cstdint>
#include <stdexcept>
#include <string>

/// @file
/// The invariants of an edge mesh.

namespace delaunayflip
{

/// The checks, for one triangle or edge.
struct EdgeMeshInspector
{
  const TriangleRecord* Triangles;
  const CornerId* CornerOfHalfEdge;
  const EdgeState* States;
  std::int64_t NumberOfTriangles, NumberOfEdges;

  /// Counts the corners of a triangle that their half-edges do not name.
  DELAUNAYFLIP_HOST_DEVICE int CountStrayCorners(std::int64_t t) const
  {
    int stray = 0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const HalfEdgeId halfEdge = this->Triangles[t].HalfEdges[slot];
      const bool named = static_cast<std::int64_t>(EdgeOf(halfEdge)) < this->NumberOfEdges &&
        this->CornerOfHalfEdge[halfEdge] == MakeCorner(static_cast<TriangleId>(t), slot);
      stray += named ? 0 : 1;
    }
    return stray;
  }

  /// Whether the sides of an edge belong together.
  DELAUNAYFLIP_HOST_DEVICE bool IsSound(std::int64_t e) const
  {
    const CornerId a = this->CornerOfHalfEdge[2 * e];
    const CornerId b = this->CornerOfHalfEdge[2 * e + 1];
    const bool fixed = this->States[e] == EdgeState::Fixed;
    if (!this->IsCorner(a) || (b != NoCorner && !this->IsCorner(b)))
    {
      return false;
    }
    if (b == NoCorner)
    {
      return fixed;
    }
    const Direction upper = this->GetDirection(a);
    const Direction lower = this->GetDirection(b);
    const bool opposed = upper.Start == lower.End && upper.End == lower.Start;
    const bool alike = upper.Start == lower.Start && upper.End == lower.End;
    return fixed ? opposed || alike : opposed && upper.Opposite != lower.Opposite;
  }

private:
  /// Start and end of an edge in the direction of the triangle on one side.
  struct Direction
  {
    VertexId Start, End, Opposite;
  };

  DELAUNAYFLIP_HOST_DEVICE bool IsCorner(CornerId corner) const
  {
    return static_cast<std::int64_t>(TriangleOf(corner)) < this->NumberOfTriangles &&
      SlotOf(corner) < 3;
  }

  DELAUNAYFLIP_HOST_DEVICE Direction GetDirection(CornerId corner) const
  {
    const TriangleRecord& triangle = this->Triangles[TriangleOf(corner)];
    const int slot = SlotOf(corner);
    return { triangle.Vertices[NextSlot(slot)], triangle.Vertices[PreviousSlot(slot)],
      triangle.Vertices[slot] };
  }
};

/// Counts half-edges that break the adjacency: a corner and its half-edge do not name each other,
/// an id is out of range, the two sides of an edge have different end vertices, or, unless the edge
/// is Fixed, they run the same way or face the same vertex. 0 for a consistent mesh.
template <typename Backend>
std::int64_t CountInconsistencies(const EdgeMesh& mesh, const Backend& backend)
{
  const EdgeMeshInspector inspector{ mesh.Triangles.Data(), mesh.CornerOfHalfEdge.Data(),
    mesh.States.Data(), mesh.NumberOfTriangles, mesh.NumberOfEdges };
  const std::int64_t stray = backend.template Sum<std::int64_t>(mesh.NumberOfTriangles,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t t, std::int64_t & sum)
    { sum += inspector.CountStrayCorners(t); });
  return stray +
    backend.template Sum<std::int64_t>(mesh.NumberOfEdges,
      [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t & sum)
      { sum += inspector.IsSound(e) ? 0 : 1; });
}

/// Throws std::logic_error if CountInconsistencies is not 0, which is a bug of the engine.
template <typename Backend>
void RequireConsistent(const EdgeMesh& mesh, const Backend& backend)
{
  const std::int64_t count = CountInconsistencies(mesh, backend);
  if (count > 0)
  {
    throw std::logic_error("the edge mesh broke: " + std::to_string(count) +
      " half-edges are inconsistent; please report this with the mesh");
  }
}

}

#endif
