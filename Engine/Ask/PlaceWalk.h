// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEWALK_H
#define DELAUNAYFLIP_PLACEWALK_H

#include "PlaceOffsets.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// Finds the triangle of a place in a triangulation of points by a walk from triangle to triangle:
/// the remembering stochastic walk of Devillers, Pion and Teillaud (2002), which ends in every
/// triangulation. The triangulation must fill the convex hull of its points, but for what rounding
/// takes away where refinement has split edges of the hull.

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

/// On which sides of the edges of a triangle a place is, and the areas that say so.
struct PlaceSides
{
  static constexpr int AllEdges = 7;

  /// The bit of a slot is 1 if the place is beyond the edge opposite that slot.
  int Beyond = 0;
  int OnEdges = 0; ///< Likewise, if it is on the line of that edge.

  PlaceOffset Offsets[3] = {}; ///< From the place to the vertices.
  /// Twice the areas of the triangles from the place to the edges, and what their errors depend on.
  double Areas[3] = {}, Magnitudes[3] = {};

  /// Whether each area is positive and has lost few digits only. Then the triangle is no sliver
  /// beyond measure. The signs must be certain without exact arithmetic.
  DELAUNAYFLIP_HOST_DEVICE bool AreWeights() const
  {
    bool areExact = true;
    for (int slot = 0; slot < 3; ++slot)
    {
      areExact &= this->Areas[slot] > CrossProduct::Cancelled * this->Magnitudes[slot] &&
        this->Areas[slot] > SmallestCertifiable;
    }
    return areExact;
  }
};

/// The bits of PlaceSides for the sides that a filter has left open.
struct OpenSides
{
  int Beyond = 0, OnEdges = 0;
};

/// @param open their bits.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline OpenSides DecideSides(
  const PlaneMesh& mesh, PlanePoint place, TriangleId triangle, int open)
{
  OpenSides sides;
  for (int slot = 0; slot < 3; ++slot)
  {
    if (((open >> slot) & 1) != 0)
    {
      const int sign = FindSide(mesh, place, MakeCorner(triangle, slot));
      sides.Beyond |= int(sign < 0) << slot;
      sides.OnEdges |= int(sign == 0) << slot;
    }
  }
  return sides;
}

/// Finds all three sides without a branch, because it would be mispredicted half of the time.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE PlaceSides FindSides(
  const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle)
{
  ConstTriangleAccess record = mesh.Edges.Triangles[triangle];
  PlaceSides sides;
  for (int slot = 0; slot < 3; ++slot)
  {
    const PlanePoint point = mesh.GetPoint(record.Vertices[slot]);
    sides.Offsets[slot] = { point.U - place.U, point.V - place.V };
  }
  int within = 0;
  for (int slot = 0; slot < 3; ++slot)
  {
    const CrossProduct area(sides.Offsets[NextSlot(slot)], sides.Offsets[PreviousSlot(slot)]);
    const double magnitude = area.GetMagnitude();
    const double bound = GetBound(OrientationBound * magnitude);
    within |= int(area.Value > bound) << slot;
    sides.Beyond |= int(-area.Value > bound) << slot;
    sides.Areas[slot] = area.Value;
    sides.Magnitudes[slot] = magnitude;
  }
  if ((within | sides.Beyond) != PlaceSides::AllEdges || !mesh.IsInFilterRange)
  {
    const int certain = mesh.IsInFilterRange ? within | sides.Beyond : 0;
    const OpenSides decided = DecideSides(mesh, place, triangle, PlaceSides::AllEdges & ~certain);
    sides.Beyond = (sides.Beyond & certain) | decided.Beyond;
    sides.OnEdges = decided.OnEdges;
  }
  return sides;
}

/// The first slot from `begin` on that has a 1 in `slots`. It comes from a table, like NextSlot.
DELAUNAYFLIP_HOST_DEVICE inline int FindFirstSlot(int slots, int begin)
{
  return static_cast<int>((0xAA105A501210u >> (16 * begin + 2 * slots)) & 3u);
}

/// Whether a place that is beyond an edge of the hull is not beyond an edge beside it, and the hull
/// is concave between the two.
/// @param corner, other opposite these edges. @param end the end of the other one that is no end of
/// the first one.
DELAUNAYFLIP_HOST_DEVICE inline bool IsBehindVertex(
  const PlaneMesh& mesh, const PlanePoint& place, CornerId corner, CornerId other, VertexId end)
{
  return FindSide(mesh, mesh.GetPoint(end), corner) < 0 && FindSide(mesh, place, other) >= 0;
}

/// Follows the hull from an edge to the one that a place is next to. Points that refinement puts on
/// the hull are rounded. Where this makes the hull concave, a place beyond one of its edges may be
/// in a triangle at another edge, on almost the same line.
/// @param corner opposite an edge of the hull that the place is beyond.
/// @returns the triangle at the edge that is found, or at an edge beside it if the place may be
/// there; NoTriangle if the place is beyond these, too.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline TriangleId FollowHull(
  const PlaneMesh& mesh, PlanePoint place, CornerId corner)
{
  const CornerId first = corner;
  CornerId before = corner; // opposite the edge that came last
  int direction = 0; // 1 for the next edge, -1 for the one before
  do
  {
    const PlanePoint from = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Next(corner)));
    const PlanePoint to = mesh.GetPoint(mesh.GetVertex(PlaneMesh::Previous(corner)));
    // Halves do not overflow, and products of scaled ones neither overflow nor underflow.
    const PlaceOffset side = { 0.5 * to.U - 0.5 * from.U, 0.5 * to.V - 0.5 * from.V };
    const double scale = InvertPowerOfTwo(FindSize(side));
    const double u = side.U * scale, v = side.V * scale;
    const double along =
      (0.5 * place.U - 0.5 * from.U) * scale * u + (0.5 * place.V - 0.5 * from.V) * scale * v;
    const int step = int(along > u * u + v * v) - int(along < 0.0);
    const bool isAtVertex = step != 0 && step == -direction; // between this edge and the last
    const bool isNext = step == 0 || isAtVertex;
    if (isNext && FindSide(mesh, place, corner) >= 0)
    {
      return TriangleOf(corner);
    }
    if (isAtVertex && FindSide(mesh, place, before) >= 0)
    {
      return TriangleOf(before);
    }
    if (isNext)
    {
      const CornerId next = mesh.FindNextOnHull(corner);
      const CornerId previous = mesh.FindPreviousOnHull(corner);
      const VertexId end = mesh.GetVertex(PlaneMesh::Previous(next));
      const VertexId begin = mesh.GetVertex(PlaneMesh::Next(previous));
      if (IsBehindVertex(mesh, place, corner, next, end))
      {
        return TriangleOf(next);
      }
      return IsBehindVertex(mesh, place, corner, previous, begin) ? TriangleOf(previous)
                                                                  : NoTriangle;
    }
    direction = step;
    before = corner;
    corner = step > 0 ? mesh.FindNextOnHull(corner) : mesh.FindPreviousOnHull(corner);
  } while (corner != first);
  return NoTriangle;
}

/// Walks from a triangle to a finite place. If mesh.IsInFilterRange, the place is in it, too.
/// @param sides become those of the triangle that is found.
/// @param isConvex whether a place beyond one edge of the hull is surely outside.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE FoundPlace WalkToPlace(const PlaneMesh& mesh,
  const PlanePoint& place, TriangleId start, PlaceSides& sides, bool isConvex = false)
{
  constexpr int MostTimesAtHull = 8; // more than one is rare
  FoundPlace found;
  found.Triangle = start;
  std::uint32_t random = start;
  int timesAtHull = 0;
  for (;;)
  {
    sides = FindSides(mesh, place, found.Triangle);
    if (sides.Beyond == 0)
    {
      found.OnEdges = sides.OnEdges;
      return found;
    }
    random = random * 1664525u + 1013904223u; // Numerical Recipes' generator
    const int slot = FindFirstSlot(sides.Beyond, static_cast<int>((random >> 16) % 3));
    const HalfEdgeId side = mesh.GetHalfEdge(MakeCorner(found.Triangle, slot));
    const CornerId across = mesh.Edges.CornerOfHalfEdge[side ^ 1u];
    if (across != NoCorner)
    {
      found.Triangle = TriangleOf(across);
      continue;
    }
    if (isConvex)
    {
      return FoundPlace();
    }
    found.Triangle = FollowHull(mesh, place, MakeCorner(found.Triangle, slot));
    ++timesAtHull;
    if (found.Triangle == NoTriangle || timesAtHull > MostTimesAtHull)
    {
      return FoundPlace();
    }
  }
}
DELAUNAYFLIP_HOST_DEVICE inline FoundPlace WalkToPlace(
  const PlaneMesh& mesh, const PlanePoint& place, TriangleId start)
{
  PlaceSides sides;
  return WalkToPlace(mesh, place, start, sides);
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
template <typename Mesh>
DELAUNAYFLIP_HOST_DEVICE FoundPlace ChooseTriangle(
  const Mesh& mesh, const FoundPlace& found, const std::int32_t* numbers)
{
  constexpr int AllEdges = 7;
  LowestTriangle lowest{ numbers, INT64_MAX, FoundPlace() };
  lowest.Offer(found.Triangle, found.OnEdges);
  const int edge = found.FindEdgeSlot();
  if (edge >= 0)
  {
    const CornerId across = mesh.FindBeyond(MakeCorner(found.Triangle, edge));
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
