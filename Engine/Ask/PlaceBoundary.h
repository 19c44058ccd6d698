// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEBOUNDARY_H
#define DELAUNAYFLIP_PLACEBOUNDARY_H

#include "Array.h"
#include "PlaceGrid.h"
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
};

/// The boundary, for functions of both backends. Edges whose numbers are near each other are mostly
/// near each other, so groups of them have a box each.
struct PlaceBoundaryView
{
  static constexpr std::int64_t GroupSize = 32;

  PlaneArray Places; ///< Those of vertices.
  const BoundaryEdge* Edges;
  const PlaceBox* Boxes; ///< By group.
  std::int64_t NumberOfEdges;
  double Scale; ///< Multiplied by it, coordinates are about 1.

  DELAUNAYFLIP_HOST_DEVICE NearestOnBoundary FindNearest(const PlanePoint& place) const
  {
    NearestOnBoundary nearest{ this->Edges[0], 0.0 };
    double least = INFINITY;
    for (std::int64_t first = 0; first < this->NumberOfEdges; first += GroupSize)
    {
      if (!(this->BoundDistance(place, this->Boxes[first / GroupSize]) < least))
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
        this->Offer(place, this->Edges[i], least, nearest);
      }
    }
    return nearest;
  }

private:
  /// The square of the scaled distance of a place from a box.
  DELAUNAYFLIP_HOST_DEVICE double BoundDistance(const PlanePoint& place, const PlaceBox& box) const
  {
    const double coordinates[2] = { place.U, place.V };
    double square = 0.0;
    for (int axis = 0; axis < 2; ++axis)
    {
      const double below = box.Low[axis] * this->Scale - coordinates[axis] * this->Scale;
      const double above = coordinates[axis] * this->Scale - box.High[axis] * this->Scale;
      const double beyond = std::fmax(0.0, std::fmax(below, above));
      square += beyond * beyond;
    }
    return square;
  }

  /// Takes an edge if it is nearer than the nearest one so far.
  DELAUNAYFLIP_HOST_DEVICE void Offer(const PlanePoint& place, const BoundaryEdge& edge,
    double& least, NearestOnBoundary& nearest) const
  {
    const double u = this->GetOffset(edge.From, 0, place.U);
    const double v = this->GetOffset(edge.From, 1, place.V);
    const double alongU = this->GetOffset(edge.To, 0, place.U) - u;
    const double alongV = this->GetOffset(edge.To, 1, place.V) - v;
    double share = -(u * alongU + v * alongV) / (alongU * alongU + alongV * alongV);
    if (!(share > 0.0)) // or NaN
    {
      share = 0.0;
    }
    if (share > 1.0)
    {
      share = 1.0;
    }
    const double nearU = u + share * alongU, nearV = v + share * alongV;
    const double square = nearU * nearU + nearV * nearV;
    if (square < least)
    {
      least = square;
      nearest = { edge, share };
    }
  }

  DELAUNAYFLIP_HOST_DEVICE double GetOffset(VertexId vertex, int axis, double coordinate) const
  {
    return this->Places.Get(vertex, axis) * this->Scale - coordinate * this->Scale;
  }
};

/// The boundary, owned.
struct PlaceBoundary
{
  Array<BoundaryEdge> Edges;
  Array<PlaceBox> Boxes;
  std::int64_t NumberOfEdges = 0;
  double Scale = 1.0;

  PlaceBoundaryView View(const PlaneArray& places) const
  {
    return { places, this->Edges.Data(), this->Boxes.Data(), this->NumberOfEdges, this->Scale };
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
/// @param frame of the triangulation.
template <typename Backend>
PlaceBoundary BuildPlaceBoundary(const PlaneMesh& mesh, std::int64_t edges,
  const std::int32_t* numbers, const PlaceGridFrame& frame, const Backend& backend)
{
  const CountBoundaryEdge count{ mesh.Edges, numbers };
  const typename Backend::Numbering numbering = backend.Count(edges, count);
  const std::int64_t all = numbering.Total;
  PlaceBoundary boundary;
  boundary.NumberOfEdges = all;
  boundary.Scale = frame.GetScale();
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
  return boundary;
}

}

#endif
