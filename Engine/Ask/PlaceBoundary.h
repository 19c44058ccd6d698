// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEBOUNDARY_H
#define DELAUNAYFLIP_PLACEBOUNDARY_H

#include "Array.h"
#include "PlaceFrame.h"
#include "PlaceGrid.h"
#include "PlaceOffsets.h"
#include "PlaneMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// The boundary of the triangles that a run has kept, for places outside of it.

namespace delaunayflip
{

/// An edge of the boundary.
struct BoundaryEdge
{
  VertexId From, To;
};

/// The place on the boundary that is nearest to another one.
struct NearestOnBoundary
{
  BoundaryEdge Edge;
  double ShareOfTo; ///< 0 at Edge.From, 1 at Edge.To.

  /// Whether this is inside of an edge that ends where the other one is. Then this is nearer,
  /// whatever rounding makes of the two distances.
  DELAUNAYFLIP_HOST_DEVICE bool IsOnEdgeOfEnd(const NearestOnBoundary& other) const
  {
    const bool isInside = this->ShareOfTo > 0.0 && this->ShareOfTo < 1.0;
    const bool isAtEnd = other.ShareOfTo == 0.0 || other.ShareOfTo == 1.0;
    const VertexId end = other.ShareOfTo == 0.0 ? other.Edge.From : other.Edge.To;
    return isInside && isAtEnd && (end == this->Edge.From || end == this->Edge.To);
  }
};

/// A place, seen from the box of the boundary. The place may be so far away that the distances of
/// all edges are equal but for rounding, or infinite. So they are compared without what they have
/// in common, the distance from the box, and without differences of large numbers.
struct PlaceFromBox
{
  double Near[2] = {}; ///< The nearest place in the box, scaled.
  double Away[2] = {}; ///< From there to the place, scaled, times Weight.
  double AwayRest[2] = {}; ///< What rounding has taken from Away.
  double Weight = 1.0; ///< A power of two, so small that Away has no large numbers.
  double Inverse = 1.0; ///< 1 / Weight.
  bool IsInside = false; ///< Whether the place is in the box, so that Away is 0.

  /// @param scale of the boundary.
  DELAUNAYFLIP_HOST_DEVICE PlaceFromBox(const PlanePoint& place, const PlaceBox& box, double scale)
  {
    constexpr double LeastWeight = 0x1p-1000; // farther places see the same
    const double u = std::fabs(place.U), v = std::fabs(place.V);
    const double fitting = InvertPowerOfTwo(u > v ? u : v);
    const double unit = fitting < scale ? fitting : scale;
    const double weight = unit / scale;
    this->Weight = weight > LeastWeight ? weight : LeastWeight;
    this->Inverse = 1.0 / this->Weight;
    this->IsInside = box.Has(place);
    const double coordinates[2] = { place.U, place.V };
    for (int axis = 0; axis < 2; ++axis)
    {
      double near = coordinates[axis] > box.Low[axis] ? coordinates[axis] : box.Low[axis];
      near = near < box.High[axis] ? near : box.High[axis];
      this->Near[axis] = near * scale;
      const double here = near * unit, there = coordinates[axis] * unit;
      this->Away[axis] = there - here;
      this->AwayRest[axis] = GetDifferenceError(there, here, this->Away[axis]);
    }
  }

  /// The product of Away and an edge, divided by Weight. Where the place is far away beside the
  /// edge, terms cancel, and each of their roundings would be longer than the edge.
  /// @param edge rounded. @param rest what was lost.
  DELAUNAYFLIP_HOST_DEVICE double MultiplyAway(
    const PlaceOffset& edge, const PlaceOffset& rest) const
  {
    const double first = this->Away[0] * edge.U, second = this->Away[1] * edge.V;
    const double sum = first + second;
    const double ofSum = GetDifferenceError(first, -second, sum);
    const double ofProducts = GetProductError(this->Away[0], edge.U, first) +
      GetProductError(this->Away[1], edge.V, second);
    const double ofFactors = (this->AwayRest[0] * edge.U + this->AwayRest[1] * edge.V) +
      (this->Away[0] * rest.U + this->Away[1] * rest.V);
    return (((sum + ofProducts) + ofSum) + ofFactors) * this->Inverse;
  }

  /// The weighted square of the distance from the place, without that of the place from the box.
  /// Both terms grow with the distance from the box's nearest place along each axis.
  /// @param u, v from the box's nearest place to one in the box.
  DELAUNAYFLIP_HOST_DEVICE double Measure(double u, double v) const
  {
    if (this->IsInside)
    {
      return u * u + v * v;
    }
    return this->Weight * (u * u + v * v) +
      2.0 * (std::fabs(u * this->Away[0]) + std::fabs(v * this->Away[1]));
  }
};

/// The boundary, for functions of both backends. Consecutive edges are mostly near each other, so
/// each group of consecutive edges has a box.
struct PlaceBoundaryView
{
  static constexpr std::int64_t GroupSize = 32;

  PlaneArray Places; ///< Those of vertices.
  const BoundaryEdge* Edges;
  const PlaceBox* Boxes; ///< By group.
  std::int64_t NumberOfEdges;
  double Scale; ///< Multiplied by it, coordinates are about 1.
  PlaceBox Box; ///< Around all edges.

  DELAUNAYFLIP_HOST_DEVICE NearestOnBoundary FindNearest(const PlanePoint& place) const
  {
    const PlaceFromBox from(place, this->Box, this->Scale);
    NearestOnBoundary nearest{ this->Edges[0], 0.0 };
    double least = INFINITY;
    for (std::int64_t first = 0; first < this->NumberOfEdges; first += GroupSize)
    {
      if (!(this->Bound(from, this->Boxes[first / GroupSize]) <= least))
      {
        continue;
      }
      std::int64_t end = first + GroupSize;
      if (end > this->NumberOfEdges)
      {
        end = this->NumberOfEdges;
      }
      for (std::int64_t i = first; i < end; ++i)
      {
        this->Offer(from, this->Edges[i], least, nearest);
      }
    }
    return nearest;
  }

private:
  /// A lower bound on the measures of all places in a box.
  DELAUNAYFLIP_HOST_DEVICE double Bound(const PlaceFromBox& from, const PlaceBox& box) const
  {
    double beyond[2] = {};
    for (int axis = 0; axis < 2; ++axis)
    {
      const double below = box.Low[axis] * this->Scale - from.Near[axis];
      const double above = from.Near[axis] - box.High[axis] * this->Scale;
      const double outside = below > above ? below : above;
      beyond[axis] = outside > 0.0 ? outside : 0.0;
    }
    return from.Measure(beyond[0], beyond[1]);
  }

  /// Takes an edge if it is nearer than the nearest one so far.
  DELAUNAYFLIP_HOST_DEVICE void Offer(const PlaceFromBox& from, const BoundaryEdge& edge,
    double& least, NearestOnBoundary& nearest) const
  {
    const ScaledPoint start = this->GetScaled(edge.From), end = this->GetScaled(edge.To);
    const PlaceOffset seen = { start.U - from.Near[0], start.V - from.Near[1] };
    const PlaceOffset along = Subtract(end, start);
    double share = -(seen.U * along.U + seen.V * along.V);
    if (!from.IsInside)
    {
      const PlaceOffset rest = { GetDifferenceError(end.U, start.U, along.U),
        GetDifferenceError(end.V, start.V, along.V) };
      share += from.MultiplyAway(along, rest);
    }
    share /= along.U * along.U + along.V * along.V;
    if (!(share > 0.0)) // or NaN
    {
      share = 0.0;
    }
    if (share > 1.0)
    {
      share = 1.0;
    }
    const double measure = from.Measure(seen.U + share * along.U, seen.V + share * along.V);
    const NearestOnBoundary offered{ edge, share };
    const bool isBetter =
      measure < least ? !nearest.IsOnEdgeOfEnd(offered) : offered.IsOnEdgeOfEnd(nearest);
    if (isBetter)
    {
      least = measure;
      nearest = offered;
    }
  }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetScaled(VertexId vertex) const
  {
    return { this->Places.Get(vertex, 0) * this->Scale, this->Places.Get(vertex, 1) * this->Scale };
  }
};

/// The boundary, owned.
struct PlaceBoundary
{
  Array<BoundaryEdge> Edges;
  Array<PlaceBox> Boxes;
  std::int64_t NumberOfEdges = 0;
  double Scale = 1.0;
  PlaceBox Box;

  PlaceBoundaryView View(const PlaneArray& places) const
  {
    return { places, this->Edges.Data(), this->Boxes.Data(), this->NumberOfEdges, this->Scale,
      this->Box };
  }
};

/// Counts an edge if exactly one of its sides has a triangle that is kept.
struct CountBoundaryEdge
{
  EdgeMeshView Edges;
  const std::int32_t* Numbers; ///< By triangle, negative for one that is removed; null: none is.

  DELAUNAYFLIP_HOST_DEVICE bool IsKept(CornerId corner) const
  {
    return corner != NoCorner && (!this->Numbers || this->Numbers[TriangleOf(corner)] >= 0);
  }
  DELAUNAYFLIP_HOST_DEVICE int operator()(std::int64_t e) const
  {
    const CornerId* sides = this->Edges.CornerOfHalfEdge + 2 * e;
    return this->IsKept(sides[0]) != this->IsKept(sides[1]) ? 1 : 0;
  }
};

/// @param edges their number. @param numbers as in CountBoundaryEdge.
template <typename Backend>
PlaceBoundary BuildPlaceBoundary(
  const PlaneMesh& mesh, std::int64_t edges, const std::int32_t* numbers, const Backend& backend)
{
  const CountBoundaryEdge count{ mesh.Edges, numbers };
  const typename Backend::Numbering numbering = backend.Count(edges, count);
  const std::int64_t all = numbering.Total;
  PlaceBoundary boundary;
  boundary.NumberOfEdges = all;
  boundary.Edges = backend.template MakeArray<BoundaryEdge>(all);
  BoundaryEdge* listed = boundary.Edges.Data();
  backend.ForEachNumbered(numbering, edges, count,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t e, std::int64_t place)
    {
      if (count(e) == 1)
      {
        const bool isFirstEmpty = mesh.Edges.CornerOfHalfEdge[2 * e] == NoCorner;
        const auto side = static_cast<HalfEdgeId>(2 * e + (isFirstEmpty ? 1 : 0));
        listed[place] = { mesh.GetStart(side), mesh.GetEnd(side) };
      }
    });
  constexpr std::int64_t GroupSize = PlaceBoundaryView::GroupSize;
  const std::int64_t groups = (all + GroupSize - 1) / GroupSize;
  boundary.Boxes = backend.template MakeArray<PlaceBox>(groups);
  PlaceBox* boxes = boundary.Boxes.Data();
  backend.ForEach(groups,
    [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t group)
    {
      PlaceBox box;
      for (std::int64_t i = group * GroupSize; i < all && i < (group + 1) * GroupSize; ++i)
      {
        box.Include(mesh.GetPoint(listed[i].From));
        box.Include(mesh.GetPoint(listed[i].To));
      }
      boxes[group] = box;
    });
  // Other points may be so far away that by their scale all distances here would be 0.
  PlaceGridFrame frame;
  frame.Box = backend.template Sum<PlaceBox>(
    groups, [=] DELAUNAYFLIP_HOST_DEVICE(std::int64_t i, PlaceBox & sum) { sum += boxes[i]; });
  boundary.Scale = frame.GetScale();
  boundary.Box = frame.Box;
  return boundary;
}

}

#endif
