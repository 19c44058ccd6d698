// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEWALK_H
#define DELAUNAYFLIP_PLACEWALK_H

#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// Finds the triangle of a place in a triangulation of points by a walk from triangle to triangle:
/// the remembering stochastic walk of Devillers, Pion and Teillaud (2002), which ends in every
/// triangulation. The triangulation must fill the convex hull of its points.

namespace delaunayflip
{

/// Where a place is.
struct FoundPlace
{
  TriangleId Triangle = NoTriangle; ///< NoTriangle: outside of the hull.
  /// The bit of a slot is 1 if the place is on the line of the edge opposite that slot. One bit:
  /// the place is inside of that edge. Two bits: it is at the vertex that both edges have in
  /// common.
  int OnEdges = 0;

  DELAUNAYFLIP_HOST_DEVICE bool IsOutside() const { return this->Triangle == NoTriangle; }

  /// The slot of the vertex that the place is at, or -1.
  DELAUNAYFLIP_HOST_DEVICE int FindVertexSlot() const
  {
    switch (this->OnEdges)
    {
      case 6: // on the edges opposite 1 and 2
        return 0;
      case 5:
        return 1;
      case 3:
        return 2;
      default:
        return -1;
    }
  }

  /// The slot opposite the edge that the place is inside of, or -1.
  DELAUNAYFLIP_HOST_DEVICE int FindEdgeSlot() const
  {
    switch (this->OnEdges)
    {
      case 1:
        return 0;
      case 2:
        return 1;
      case 4:
        return 2;
      default:
        return -1;
    }
  }
};

/// On which side of the edge opposite a corner a place is: 1 for that of the corner's triangle, 0
/// on its line, -1 beyond.
DELAUNAYFLIP_HOST_DEVICE inline int FindSide(
  const PlaneMesh& mesh, const PlanePoint& place, CornerId opposite)
{
  const PlanePoint from = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Next(opposite)));
  const PlanePoint to = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Previous(opposite)));
  if (mesh.IsInFilterRange)
  {
    const int sign = FilteredOrientation(from, to, place);
    if (sign != UncertainSign)
    {
      return sign;
    }
  }
  return mesh.RequireSign(FindOrientation(from, to, place));
}

/// Walks from a triangle to a finite place. If mesh.IsInFilterRange, the place is in it, too.
DELAUNAYFLIP_HOST_DEVICE inline FoundPlace WalkToPlace(
  const PlaneMesh& mesh, const PlanePoint& place, TriangleId start)
{
  constexpr int None = 3;
  FoundPlace found;
  found.Triangle = start;
  int entered = None; // the slot opposite the edge that the walk came through
  std::uint32_t random = start;
  for (;;)
  {
    random = random * 1664525u + 1013904223u; // Numerical Recipes' generator
    int slot = static_cast<int>((random >> 16) % 3);
    CornerId across = NoCorner;
    bool leaves = false;
    found.OnEdges = 0;
    for (int i = 0; i < 3 && !leaves; ++i, slot = NextSlot(slot))
    {
      if (slot == entered)
      {
        continue; // the place is on this side
      }
      const CornerId corner = MakeCorner(found.Triangle, slot);
      const int side = FindSide(mesh, place, corner);
      if (side == 0)
      {
        found.OnEdges |= 1 << slot;
      }
      if (side < 0)
      {
        leaves = true;
        across = mesh.Edges.CornerOfHalfEdge[mesh.GetHalfEdge(corner) ^ 1u];
      }
    }
    if (!leaves)
    {
      return found;
    }
    if (across == NoCorner)
    {
      return FoundPlace();
    }
    found.Triangle = TriangleOf(across);
    entered = SlotOf(across);
  }
}

/// Keeps the triangle with the lower number, if that is not negative.
struct LowestTriangle
{
  const std::int32_t* Numbers; ///< By triangle, or null: a triangle is its own number.
  std::int64_t Lowest = INT64_MAX;
  FoundPlace Best;

  DELAUNAYFLIP_HOST_DEVICE void Offer(TriangleId triangle, int onEdges)
  {
    const std::int64_t number = this->Numbers ? this->Numbers[triangle] : std::int64_t(triangle);
    if (number >= 0 && number < this->Lowest)
    {
      this->Lowest = number;
      this->Best.Triangle = triangle;
      this->Best.OnEdges = onEdges;
    }
  }
};

/// Chooses among all triangles that have a place, inside or on their boundary, the one with the
/// lowest number.
/// @param numbers by triangle, its number in the output, or -1 if it is removed. Null: none is.
/// @returns where the place is in that triangle; outside if all of them are removed.
DELAUNAYFLIP_HOST_DEVICE inline FoundPlace ChooseTriangle(
  const PlaneMesh& mesh, const FoundPlace& found, const std::int32_t* numbers)
{
  constexpr int AllEdges = 7;
  LowestTriangle lowest{ numbers, INT64_MAX, FoundPlace() };
  lowest.Offer(found.Triangle, found.OnEdges);
  const int edge = found.FindEdgeSlot();
  if (edge >= 0)
  {
    const HalfEdgeId side = mesh.GetHalfEdge(MakeCorner(found.Triangle, edge));
    const CornerId across = mesh.Edges.CornerOfHalfEdge[side ^ 1u];
    if (across != NoCorner)
    {
      lowest.Offer(TriangleOf(across), 1 << SlotOf(across));
    }
  }
  const int vertex = found.FindVertexSlot();
  if (vertex >= 0)
  {
    const CornerId first = MakeCorner(found.Triangle, vertex);
    CornerId corner = mesh.FindNextAround(first);
    for (; corner != NoCorner && corner != first; corner = mesh.FindNextAround(corner))
    {
      lowest.Offer(TriangleOf(corner), AllEdges ^ (1 << SlotOf(corner)));
    }
    if (corner == NoCorner) // the vertex is on the hull, so some triangles are on the other way
    {
      corner = mesh.FindPreviousAround(first);
      for (; corner != NoCorner; corner = mesh.FindPreviousAround(corner))
      {
        lowest.Offer(TriangleOf(corner), AllEdges ^ (1 << SlotOf(corner)));
      }
    }
  }
  return lowest.Best;
}

}

#endif
