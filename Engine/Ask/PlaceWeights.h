// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEWEIGHTS_H
#define DELAUNAYFLIP_PLACEWEIGHTS_H

#include "PlaceWalk.h"

#include "ExactPredicates.h"

#include <cmath>

/// @file
/// How much the vertices around a place count for the value there. Weights are told vertex by
/// vertex and need not add up to 1: who takes them divides by their sum.
///
/// Both methods reproduce linear functions. At a vertex, on an edge of the hull and on a segment
/// only linear weights are defined; there natural ones approach them.

namespace delaunayflip
{

/// A vector from a place, in twice the precision of double: U and V rounded, and the rest.
struct PlaceOffset
{
  double U, V;
  double RestU = 0.0, RestV = 0.0;
};

/// The rounding error of the difference a - b, exactly (Knuth).
DELAUNAYFLIP_HOST_DEVICE inline double GetDifferenceError(double a, double b, double difference)
{
  const double subtracted = a - difference;
  return (a - (difference + subtracted)) + (subtracted - b);
}

/// Dekker's product: the rounding error of a b, if nothing overflows or underflows.
DELAUNAYFLIP_HOST_DEVICE inline double GetProductError(double a, double b, double product)
{
  constexpr double Splitter = 134217729.0; // 2^27 + 1
  const double aBig = Splitter * a, bBig = Splitter * b;
  const double aHigh = aBig - (aBig - a), bHigh = bBig - (bBig - b);
  const double aLow = a - aHigh, bLow = b - bHigh;
  return aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
}

/// The cross product of two vectors, with a relative error of a few roundings even where the two
/// products nearly cancel: slivers need it.
DELAUNAYFLIP_HOST_DEVICE inline double CrossProduct(const PlaceOffset& a, const PlaceOffset& b)
{
  constexpr double Cancelled = 1e-3; // the rest loses three of 16 digits at most
  const double left = a.U * b.V;
  const double right = a.V * b.U;
  const double cross = left - right;
  if (std::fabs(cross) > Cancelled * (std::fabs(left) + std::fabs(right)))
  {
    return cross;
  }
  const double ofProducts = GetProductError(a.U, b.V, left) - GetProductError(a.V, b.U, right);
  const double ofRests = (a.U * b.RestV - a.V * b.RestU) + (a.RestU * b.V - a.RestV * b.U);
  return cross + (ofProducts + ofRests);
}

/// A place and its triangle, with the scale at which products neither overflow nor underflow.
class PlaceFrame
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceFrame(
    const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle)
    : Mesh(mesh),
      Place(place)
  {
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint point = mesh.GetPoint(mesh.GetVertex(MakeCorner(triangle, slot)));
      const double u = std::fabs(0.5 * point.U - 0.5 * place.U);
      const double v = std::fabs(0.5 * point.V - 0.5 * place.V);
      largest = std::fmax(largest, std::fmax(u, v));
    }
    constexpr int Most = 900; // so that the scale itself is a normal number
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    const int bounded = exponent < -Most ? -Most : (exponent > Most ? Most : exponent);
    this->Scale = std::scalbn(1.0, -bounded);
  }

  DELAUNAYFLIP_HOST_DEVICE PlaceOffset GetOffset(VertexId vertex) const
  {
    const PlanePoint point = this->Mesh.GetPoint(vertex);
    const double u = point.U * this->Scale, placeU = this->Place.U * this->Scale;
    const double v = point.V * this->Scale, placeV = this->Place.V * this->Scale;
    PlaceOffset offset{ u - placeU, v - placeV };
    offset.RestU = GetDifferenceError(u, placeU, offset.U);
    offset.RestV = GetDifferenceError(v, placeV, offset.V);
    return offset;
  }

private:
  const PlaneMesh& Mesh;
  const PlanePoint& Place;
  double Scale = 1.0;
};

/// Calls visit(vertex, weight) for the three vertices of a triangle that has the place, or for
/// fewer if it is on an edge or a vertex.
template <typename Visit>
DELAUNAYFLIP_HOST_DEVICE void VisitLinearWeights(
  const PlaneMesh& mesh, const PlanePoint& place, const FoundPlace& found, const Visit& visit)
{
  const TriangleId triangle = found.Triangle;
  VertexId vertices[3];
  PlaceOffset offsets[3];
  const PlaceFrame frame(mesh, place, triangle);
  for (int slot = 0; slot < 3; ++slot)
  {
    vertices[slot] = mesh.GetVertex(MakeCorner(triangle, slot));
    offsets[slot] = frame.GetOffset(vertices[slot]);
  }
  const int vertex = found.FindVertexSlot();
  if (vertex >= 0)
  {
    visit(vertices[vertex], 1.0);
    return;
  }
  const auto visitEdge = [&](int opposite)
  {
    const int from = NextSlot(opposite), to = PreviousSlot(opposite);
    const double toFrom = std::fabs(offsets[from].U) + std::fabs(offsets[from].V);
    const double toTo = std::fabs(offsets[to].U) + std::fabs(offsets[to].V);
    visit(vertices[from], toTo);
    visit(vertices[to], toFrom);
  };
  const int edge = found.FindEdgeSlot();
  if (edge >= 0)
  {
    visitEdge(edge);
    return;
  }
  for (int slot = 0; slot < 3; ++slot)
  {
    const double area = CrossProduct(offsets[NextSlot(slot)], offsets[PreviousSlot(slot)]);
    visit(vertices[slot], std::fmax(area, 0.0));
  }
}

/// The centre of the circle through a place and two vertices.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset FindCentre(const PlaceOffset& a, const PlaceOffset& b)
{
  const double twice = 2.0 * CrossProduct(a, b);
  const double aSquare = a.U * a.U + a.V * a.V;
  const double bSquare = b.U * b.U + b.V * b.V;
  return { (b.V * aSquare - a.V * bSquare) / twice, (a.U * bSquare - b.U * aSquare) / twice };
}

/// b - a.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset Subtract(const PlaceOffset& b, const PlaceOffset& a)
{
  PlaceOffset difference{ b.U - a.U, b.V - a.V };
  difference.RestU = GetDifferenceError(b.U, a.U, difference.U) + (b.RestU - a.RestU);
  difference.RestV = GetDifferenceError(b.V, a.V, difference.V) + (b.RestV - a.RestV);
  return difference;
}

/// The centre of the circle through three vertices.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset FindCentre(
  const PlaceOffset& a, const PlaceOffset& b, const PlaceOffset& c)
{
  const PlaceOffset centre = FindCentre(Subtract(b, a), Subtract(c, a));
  return { a.U + centre.U, a.V + centre.V };
}

/// The triangles with a place in their circumcircle that can be reached from the place without
/// crossing a segment: the ones that an insertion of the place would replace. There is no vertex
/// inside of them all, so that they form a tree, and their boundary is one ring.
class PlaceCavity
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceCavity(const PlaneMesh& mesh, const PlanePoint& place)
    : Mesh(mesh),
      Place(place)
  {
  }

  /// The corner on the other side of the edge opposite a corner of the cavity, if its triangle is
  /// in the cavity, too; else NoCorner.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindWithin(CornerId corner) const
  {
    const HalfEdgeId side = this->Mesh.GetHalfEdge(corner);
    const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
    if (across == NoCorner || this->Mesh.IsFixed(side))
    {
      return NoCorner;
    }
    const PlanePoint points[4] = { this->Mesh.GetPoint(this->Mesh.GetVertex(across)),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Next(across))),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Previous(across))), this->Place };
    int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    const bool isInRange = IsInFilterRange(points[0]) && IsInFilterRange(points[1]) &&
      IsInFilterRange(points[2]) && IsInFilterRange(points[3]);
    if (sign == UncertainSign || !isInRange)
    {
      sign = ExactInCircle(points, false);
    }
    return this->Mesh.RequireSign(sign) == 1 ? across : NoCorner;
  }

private:
  const PlaneMesh& Mesh;
  const PlanePoint& Place;
};

/// The area of a polygon by its corners, which are told one after the other, times two.
class PolygonArea
{
public:
  DELAUNAYFLIP_HOST_DEVICE explicit PolygonArea(const PlaceOffset& first)
    : First(first),
      Last(first)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE void Add(const PlaceOffset& corner)
  {
    // Corners may be very far away. The nearer one as the factor loses least.
    const PlaceOffset step = { corner.U - this->Last.U, corner.V - this->Last.V };
    const double toLast = std::fabs(this->Last.U) + std::fabs(this->Last.V);
    const double toCorner = std::fabs(corner.U) + std::fabs(corner.V);
    this->Twice += CrossProduct(toCorner < toLast ? corner : this->Last, step);
    this->Last = corner;
  }

  /// Closes the polygon.
  DELAUNAYFLIP_HOST_DEVICE double GetTwice()
  {
    this->Add(this->First);
    return this->Twice;
  }

private:
  PlaceOffset First, Last;
  double Twice = 0.0;
};

/// Whether weights and the offsets of their vertices fit together. In exact arithmetic the weighted
/// sum of the offsets is 0. Next to triangles that are nearly on one line, such as those along a
/// hull, centres are so far away that rounding can leave nothing of the areas.
class WeightCheck
{
public:
  DELAUNAYFLIP_HOST_DEVICE void Add(double weight, const PlaceOffset& offset)
  {
    this->SumU += weight * offset.U;
    this->SumV += weight * offset.V;
    this->Size += std::fabs(weight) * (std::fabs(offset.U) + std::fabs(offset.V));
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsGood() const
  {
    constexpr double Tolerance = 1e-10;
    return std::fabs(this->SumU) + std::fabs(this->SumV) <= Tolerance * this->Size; // not for NaN
  }

private:
  double SumU = 0.0, SumV = 0.0, Size = 0.0;
};

/// Calls visit(vertex, weight) for Sibson's natural neighbours of a place that is in a triangle and
/// on none of its edges. A weight is twice the area that the place's Voronoi cell would take from
/// that of the vertex (Watson 1992). Weights beyond a segment may be negative.
/// @returns whether rounding has left the weights good.
template <typename Visit>
DELAUNAYFLIP_HOST_DEVICE bool VisitNaturalWeights(
  const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle, const Visit& visit)
{
  const PlaceCavity cavity(mesh, place);
  const PlaceFrame frame(mesh, place, triangle);
  const auto getOffset = [&](CornerId corner) { return frame.GetOffset(mesh.GetVertex(corner)); };
  const auto findNewCentre = [&](CornerId opposite)
  {
    return FindCentre(
      getOffset(PlaneMesh::Next(opposite)), getOffset(PlaneMesh::Previous(opposite)));
  };
  WeightCheck check;
  // An edge of the boundary: always on across the next edge, until nothing is beyond.
  CornerId first = MakeCorner(triangle, 0);
  CornerId within = cavity.FindWithin(first);
  while (within != NoCorner)
  {
    first = PlaneMesh::Next(within);
    within = cavity.FindWithin(first);
  }
  CornerId opposite = first; // of an edge of the boundary
  PlaceOffset centre = findNewCentre(first);
  do
  {
    // Around the vertex where this edge ends, to the edge of the boundary that begins there. The
    // centres on the way are the corners of the area that the vertex loses.
    const VertexId vertex = mesh.GetVertex(PlaneMesh::Previous(opposite));
    PolygonArea area(centre);
    within = opposite;
    while (within != NoCorner)
    {
      // From the same corner for all three vertices, so that rounding is the same.
      const TriangleId t = TriangleOf(within);
      area.Add(FindCentre(
        getOffset(MakeCorner(t, 0)), getOffset(MakeCorner(t, 1)), getOffset(MakeCorner(t, 2))));
      opposite = PlaneMesh::Next(within);
      within = cavity.FindWithin(opposite);
    }
    centre = findNewCentre(opposite);
    area.Add(centre);
    const double weight = area.GetTwice();
    check.Add(weight, frame.GetOffset(vertex));
    visit(vertex, weight);
  } while (opposite != first);
  return check.IsGood();
}

}

#endif
