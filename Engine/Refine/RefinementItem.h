// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFINEMENTITEM_H
#define DELAUNAYFLIP_REFINEMENTITEM_H

#include "PlaceWalk.h"
#include "PlaneMesh.h"

#include <cstdint>

/// @file
/// The places that a round of refinement may insert, and where they are.

namespace delaunayflip
{

/// The first triangles of a cavity: those that have a place inside their circumcircle and can be
/// reached from there without crossing a subsegment.
struct Cavity
{
  static constexpr int Most = 24; ///< Six times as many as there are on average.
  static constexpr int NoSlot = 3;

  /// For each triangle, the corner opposite the edge through which it was reached; for the first
  /// one the slot is NoSlot.
  CornerId Corners[Most];
  int Count = 0;

  DELAUNAYFLIP_HOST_DEVICE void Add(CornerId corner)
  {
    if (this->Count < Most)
    {
      this->Corners[this->Count++] = corner;
    }
  }
};

/// What becomes of a place in a round.
enum class ItemState : std::uint32_t
{
  Dropped, ///< It is not inserted.
  Waiting,
  Encroaches, ///< It is not inserted, because it is in the diametral circle of a subsegment.
  Wins ///< It is inserted.
};

/// A place that may be inserted.
struct RefinementItem
{
  PlanePoint Place;
  double SquaredRadius; ///< The square of its distance from the ends of the edge that it is for.
  std::uint64_t Key;
  FoundPlace Found; ///< What it splits; before it is located, where the search begins.
  std::uint32_t Source; ///< The subsegment for a place on a segment, else the bad triangle.
  std::uint32_t Flips; ///< Flips of the bad triangle so far. After another one the place is stale.
  std::uint32_t Rank; ///< The rank in the key.
  ItemState State;
  bool IsOnSegment;
  /// Whether a place on a segment is inside of the triangle there, and a removed triangle fills the
  /// gap between it and the segment.
  bool CutsSliver;
  TriangleId Old; ///< In a mesh of the caller: its triangle before refinement.
};

/// Where a walk within subsegments ends.
struct WalkEnd
{
  FoundPlace Found;
  HalfEdgeId Blocked = NoHalfEdge; ///< A side of the subsegment that it would have to cross.
};

/// Walks from a triangle to a place without crossing a subsegment. The mesh is constrained
/// Delaunay, so every step goes to a triangle with a circumcircle nearer to the place (by its
/// power). Therefore the walk ends.
DELAUNAYFLIP_HOST_DEVICE inline WalkEnd WalkWithinSegments(
  const PlaneMesh& mesh, const PlanePoint& place, TriangleId start)
{
  constexpr int None = 3;
  WalkEnd end;
  end.Found.Triangle = start;
  int entered = None;
  for (;;)
  {
    CornerId next = NoCorner;
    end.Found.OnEdges = 0;
    end.Blocked = NoHalfEdge;
    for (int slot = 0; slot < 3 && next == NoCorner; ++slot)
    {
      if (slot == entered)
      {
        continue;
      }
      const CornerId corner = MakeCorner(end.Found.Triangle, slot);
      const int side = FindSide(mesh, place, corner);
      const HalfEdgeId halfEdge = mesh.GetHalfEdge(corner);
      if (side == 0)
      {
        end.Found.OnEdges |= 1 << slot;
      }
      else if (side < 0 && mesh.IsFixed(halfEdge))
      {
        end.Blocked = halfEdge;
      }
      else if (side < 0)
      {
        next = mesh.Edges.CornerOfHalfEdge[halfEdge ^ 1u];
      }
    }
    if (next == NoCorner)
    {
      return end;
    }
    end.Found.Triangle = TriangleOf(next);
    entered = SlotOf(next);
  }
}

}

#endif
