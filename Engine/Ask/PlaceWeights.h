// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEWEIGHTS_H
#define DELAUNAYFLIP_PLACEWEIGHTS_H

#include "CavityTour.h"
#include "PlaceCavity.h"
#include "PlaceFrame.h"
#include "PlaceWalk.h"
#include "PreciseCavity.h"

/// @file
/// How much the vertices around a place count for the value there. Weights are told vertex by
/// vertex. Linear ones add up to 1; natural ones do not, so they have to be divided by their sum.
///
/// Both methods reproduce linear functions. At a vertex, on an edge of the hull and on a segment
/// only linear weights are defined; there natural ones approach them.

namespace delaunayflip
{

/// The slot opposite the longest edge of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline int FindLongestEdge(const ScaledPoint (&points)[3])
{
  int longest = 0;
  double largest = -1.0;
  for (int slot = 0; slot < 3; ++slot)
  {
    const double size = FindSize(Subtract(points[NextSlot(slot)], points[PreviousSlot(slot)]));
    if (size > largest)
    {
      largest = size;
      longest = slot;
    }
  }
  return longest;
}

/// Calls visit(vertex, weight) for the three vertices of a triangle that has the place, or for
/// fewer if it is on an edge or a vertex.
/// @param frame of the place and the triangle.
template <typename Frame, typename Visit>
DELAUNAYFLIP_HOST_DEVICE void VisitLinearWeights(
  const Frame& frame, const FoundPlace& found, const Visit& visit)
{
  const TriangleId triangle = found.Triangle;
  VertexId vertices[3];
  ScaledPoint points[3];
  for (int slot = 0; slot < 3; ++slot)
  {
    vertices[slot] = frame.GetVertex(MakeCorner(triangle, slot));
    points[slot] = frame.GetPoint(vertices[slot]);
  }
  const int vertex = found.FindVertexSlot();
  if (vertex >= 0)
  {
    visit(vertices[vertex], 1.0);
    return;
  }
  const SeenPoint seen[3] = { { points[0], frame.GetPlace() }, { points[1], frame.GetPlace() },
    { points[2], frame.GetPlace() } };
  double areas[3];
  double sum = 0.0, magnitude = 0.0;
  const int edge = found.FindEdgeSlot();
  for (int slot = 0; slot < 3 && edge < 0; ++slot)
  {
    const SeenPoint& next = seen[NextSlot(slot)];
    const SeenPoint& previous = seen[PreviousSlot(slot)];
    const CrossProduct cross(next.Offset, previous.Offset);
    const double area = FindTwiceArea(frame.GetPlace(), next, previous, cross);
    areas[slot] = area > 0.0 ? area : 0.0;
    sum += areas[slot];
    magnitude += cross.GetMagnitude();
  }
  if (sum > MeasurableArea * magnitude && sum > SmallestArea)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      visit(vertices[slot], areas[slot] / sum);
    }
    return;
  }
  // On an edge, or in a triangle without a measurable area, which is as good as its longest edge.
  const int opposite = edge >= 0 ? edge : FindLongestEdge(points);
  const int from = NextSlot(opposite), to = PreviousSlot(opposite);
  const double ofFrom = FindSize(seen[to].Offset);
  const double ofTo = FindSize(seen[from].Offset);
  double share = ofFrom / (ofFrom + ofTo);
  if (ofFrom + ofTo == 0.0) // both have underflowed, since a third vertex is so far away
  {
    share = 0.5;
  }
  visit(vertices[from], share);
  visit(vertices[to], 1.0 - share);
}

/// Walks along the boundary of a cavity and calls visit(vertex, weight) for its vertices.
/// @param cavity PlaceCavity or PreciseCavity. @param triangle has the place.
/// @returns whether rounding has left the weights good.
template <typename Cavity, typename Frame, typename Visit>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE bool VisitAroundCavity(
  Cavity& cavity, const Frame& frame, TriangleId triangle, const Visit& visit)
{
  typename Cavity::Check check;
  int kept = Cavity::NotKept;
  cavity.GetCentre(triangle, kept);
  // Finds an edge of the boundary: goes on across the next edge until nothing is beyond.
  CornerId first = MakeCorner(triangle, 0);
  CornerId within = cavity.FindWithin(first, kept);
  while (within != NoCorner)
  {
    if (TriangleOf(within) == triangle) // around a vertex, as only rounding can do
    {
      return false;
    }
    cavity.GetCentre(TriangleOf(within), kept);
    first = PlaneMesh::Next(within);
    within = cavity.FindWithin(first, kept);
  }
  CornerId opposite = first; // of an edge of the boundary
  typename Cavity::Vertex end = cavity.See(PlaneMesh::Previous(first)); // of that edge
  typename Cavity::Centre centre = // of its new triangle
    cavity.FindNewCentre(cavity.See(PlaneMesh::Next(first)), end);
  do
  {
    // Around the end of this edge, to the edge of the boundary that begins there. The centres on
    // the way are the corners of the area that the vertex loses.
    const VertexId vertex = frame.GetVertex(PlaneMesh::Previous(opposite));
    const typename Cavity::Vertex begin = end;
    typename Cavity::Area area(centre);
    within = opposite;
    while (within != NoCorner)
    {
      area.Add(cavity.GetCentre(TriangleOf(within), kept));
      opposite = PlaneMesh::Next(within);
      within = opposite == first ? NoCorner : cavity.FindWithin(opposite, kept);
    }
    end = cavity.See(PlaneMesh::Previous(opposite));
    centre = cavity.FindNewCentre(begin, end);
    area.Add(centre);
    const double weight = area.GetTwice();
    check.Add(weight, begin.Offset);
    visit(vertex, weight);
  } while (opposite != first);
  return check.IsGood();
}

/// Calls visit(vertex, weight) for Sibson's natural neighbours of a place that is in a triangle and
/// on none of its edges. A weight is twice the area that the place's Voronoi cell would take from
/// that of the vertex (Watson 1992). Weights beyond a segment may be negative.
/// @param frame of the place and the triangle.
/// @returns whether rounding has left the weights good.
template <typename Frame, typename Visit>
DELAUNAYFLIP_HOST_DEVICE bool VisitNaturalWeights(
  const Frame& frame, TriangleId triangle, const Visit& visit)
{
#if !DELAUNAYFLIP_ON_DEVICE // which has no fast memory for it
  typename CavityTour<Frame>::Arrays arrays;
  CavityTour<Frame> tour(frame, arrays);
  if (tour.Run(triangle))
  {
    tour.VisitWeights(visit);
    return tour.AreGood();
  }
#endif
  PlaceCavity<Frame> cavity(frame);
  return VisitAroundCavity(cavity, frame, triangle, visit);
}

/// VisitNaturalWeights with twice the digits, which takes many times as long.
template <typename Frame, typename Visit>
DELAUNAYFLIP_HOST_DEVICE bool VisitPreciseWeights(
  const Frame& frame, TriangleId triangle, const Visit& visit)
{
  PreciseCavity<Frame> cavity(frame, triangle);
  return VisitAroundCavity(cavity, frame, triangle, visit);
}

}

#endif
