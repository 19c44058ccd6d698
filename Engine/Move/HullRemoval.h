// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULLREMOVAL_H
#define DELAUNAYFLIP_HULLREMOVAL_H

#include "HullChange.h"

#include <cstdint>

/// @file
/// Removes vertices from the boundary of a triangulation, one after the other, on one thread. The
/// triangles of such a vertex are removed, and triangles are added until the boundary is convex.

namespace delaunayflip
{

/// The triangles around a vertex on the boundary, counter-clockwise from its side.
struct VertexFan
{
  static constexpr int Most = 64;

  int Count = 0;
  VertexId Link[Most + 1]; ///< Triangle i has the vertex, Link[i] and Link[i + 1].
  HalfEdgeId Outer[Most]; ///< The half-edge of triangle i from Link[i] to Link[i + 1].
  TriangleId Triangles[Most];
  EdgeId Spokes[Most + 1]; ///< Spoke i runs to Link[i].
};

/// Sorts a few numbers in ascending order.
DELAUNAYFLIP_HOST_DEVICE inline void SortNumbers(std::uint32_t* numbers, int count)
{
  for (int i = 1; i < count; ++i)
  {
    const std::uint32_t own = numbers[i];
    int to = i;
    for (; to > 0 && numbers[to - 1] > own; --to)
    {
      numbers[to] = numbers[to - 1];
    }
    numbers[to] = own;
  }
}

/// Removes vertices from the boundary. They keep their numbers, which nothing has any more.
class HullRemover : public HullEditor
{
public:
  using HullEditor::HullEditor;

  /// @param pending as for FillUp.
  DELAUNAYFLIP_HOST_DEVICE void Remove(
    const VertexId* vertices, std::int64_t count, VertexId* pending)
  {
    for (std::int64_t i = 0; i < count && this->Sizes.HasFailed == 0; ++i)
    {
      VertexFan fan;
      if (this->Collect(vertices[i], fan))
      {
        this->CutFan(vertices[i], fan, pending);
      }
      else
      {
        this->Sizes.HasFailed = 1;
      }
    }
    *this->Result = this->Sizes;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE bool Collect(VertexId vertex, VertexFan& fan) const
  {
    CornerId corner = this->Hull.FindCorner(vertex);
    for (; corner != NoCorner; corner = this->Hull.Mesh.FindNextAround(corner))
    {
      if (fan.Count == VertexFan::Most)
      {
        return false;
      }
      const TriangleRecord& triangle = this->Edges.Triangles[TriangleOf(corner)];
      const int slot = SlotOf(corner), next = NextSlot(slot), previous = PreviousSlot(slot);
      fan.Triangles[fan.Count] = TriangleOf(corner);
      fan.Link[fan.Count] = triangle.Vertices[next];
      fan.Outer[fan.Count] = triangle.HalfEdges[slot];
      fan.Spokes[fan.Count] = EdgeOf(triangle.HalfEdges[previous]);
      ++fan.Count;
      fan.Link[fan.Count] = triangle.Vertices[previous];
      fan.Spokes[fan.Count] = EdgeOf(triangle.HalfEdges[next]);
    }
    return true;
  }

  DELAUNAYFLIP_HOST_DEVICE void CutFan(VertexId vertex, VertexFan& fan, VertexId* pending)
  {
    const int count = fan.Count;
    bool isSimple = this->Sizes.Sides + count <= this->Sizes.MostSides;
    for (int i = 0; i < count; ++i)
    {
      const bool isOpen = this->Edges.CornerOfHalfEdge[fan.Outer[i] ^ 1u] != NoCorner;
      isSimple = isSimple && isOpen && (i == 0 || this->Hull.IsInside(fan.Link[i]));
    }
    if (!isSimple) // the rest would be connected by a single vertex
    {
      this->Sizes.HasFailed = 1;
      return;
    }
    this->ReplaceSides(vertex, fan);
    this->DropAll(fan);
    for (int i = 0; i <= count; ++i)
    {
      pending[i] = fan.Link[i];
    }
    this->FillUp(pending, count + 1);
  }

  /// Puts the outer edges on the boundary in place of the two sides at the vertex.
  DELAUNAYFLIP_HOST_DEVICE void ReplaceSides(VertexId vertex, const VertexFan& fan)
  {
    BoundarySide* sides = this->Hull.Sides;
    const std::uint32_t own = this->Hull.SideOfVertex[vertex];
    const std::uint32_t after = sides[own].After;
    std::uint32_t number = sides[own].Before;
    this->Hull.SideOfVertex[vertex] = NoSide;
    sides[number].Edge = this->Expose(fan.Outer[fan.Count - 1]);
    for (int i = fan.Count - 2; i >= 0; --i)
    {
      std::uint32_t next = own;
      if (i < fan.Count - 2)
      {
        next = static_cast<std::uint32_t>(this->Sizes.Sides++);
      }
      sides[number].After = next;
      sides[next] = { this->Expose(fan.Outer[i]), number, after };
      this->Hull.SideOfVertex[fan.Link[i + 1]] = next;
      number = next;
    }
    sides[number].After = after;
    sides[after].Before = number;
    if (fan.Count == 1)
    {
      this->DropSide(own);
    }
  }

  /// Drops the triangles and the spokes, the largest numbers first, so that the others in the lists
  /// keep their numbers.
  DELAUNAYFLIP_HOST_DEVICE void DropAll(VertexFan& fan)
  {
    SortNumbers(fan.Triangles, fan.Count);
    for (int i = fan.Count - 1; i >= 0; --i)
    {
      this->DropTriangle(fan.Triangles[i]);
    }
    SortNumbers(fan.Spokes, fan.Count + 1);
    for (int i = fan.Count; i >= 0; --i)
    {
      this->DropEdge(fan.Spokes[i]);
    }
  }
};

}

#endif
