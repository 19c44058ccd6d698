// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEWEIGHTS_H
#define DELAUNAYFLIP_PLACEWEIGHTS_H

#include "ExactPredicates.h"
#include "PlaceOffsets.h"
#include "PlaceWalk.h"

#include <cmath>
#include <cstdint>
#include <cstring>

/// @file
/// How much the vertices around a place count for the value there. Weights are told vertex by
/// vertex. Linear ones add up to 1; natural ones do not, so their sum has to be divided by.
///
/// Both methods reproduce linear functions. At a vertex, on an edge of the hull and on a segment
/// only linear weights are defined; there natural ones approach them.

namespace delaunayflip
{

/// The power of two by which a number that is not negative comes to be between 1 and 2; the largest
/// one that is finite for the smallest numbers.
DELAUNAYFLIP_HOST_DEVICE inline double InvertPowerOfTwo(double number)
{
  constexpr int MantissaBits = 52;
  constexpr std::uint64_t TwiceTheBias = 2046;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  std::uint64_t exponent = bits >> MantissaBits;
  if (exponent >= TwiceTheBias) // its inverse would be too small to be a normal number
  {
    exponent = TwiceTheBias - 1;
  }
  const std::uint64_t inverse = (TwiceTheBias - exponent) << MantissaBits;
  double power = 0.0;
  std::memcpy(&power, &inverse, sizeof(power));
  return power;
}

/// The scale for a place and what is around it, by the triangle that has it.
class PlaceFrame
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceFrame(
    const PlaneMesh& mesh, const PlanePoint& place, TriangleId triangle)
    : Mesh(mesh)
  {
    double largest = 0.0;
    for (int slot = 0; slot < 3; ++slot)
    {
      const PlanePoint point = mesh.GetPoint(mesh.GetVertex(MakeCorner(triangle, slot)));
      for (const double half : { 0.5 * point.U - 0.5 * place.U, 0.5 * point.V - 0.5 * place.V })
      {
        if (std::fabs(half) > largest)
        {
          largest = std::fabs(half);
        }
      }
    }
    this->Scale = InvertPowerOfTwo(largest);
    this->Place = { place.U * this->Scale, place.V * this->Scale };
  }

  DELAUNAYFLIP_HOST_DEVICE const ScaledPoint& GetPlace() const { return this->Place; }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(VertexId vertex) const
  {
    const PlanePoint point = this->Mesh.GetPoint(vertex);
    return { point.U * this->Scale, point.V * this->Scale };
  }

private:
  const PlaneMesh& Mesh;
  ScaledPoint Place;
  double Scale;
};

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
template <typename Visit>
DELAUNAYFLIP_HOST_DEVICE void VisitLinearWeights(
  const PlaneMesh& mesh, const PlanePoint& place, const FoundPlace& found, const Visit& visit)
{
  const TriangleId triangle = found.Triangle;
  VertexId vertices[3];
  ScaledPoint points[3];
  const PlaceFrame frame(mesh, place, triangle);
  for (int slot = 0; slot < 3; ++slot)
  {
    vertices[slot] = mesh.GetVertex(MakeCorner(triangle, slot));
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
  double sum = 0.0;
  const int edge = found.FindEdgeSlot();
  for (int slot = 0; slot < 3 && edge < 0; ++slot)
  {
    const double area =
      FindTwiceArea(frame.GetPlace(), seen[NextSlot(slot)], seen[PreviousSlot(slot)]);
    areas[slot] = area > 0.0 ? area : 0.0;
    sum += areas[slot];
  }
  constexpr double Measurable = 1e-28; // of a triangle whose size is about 1
  if (sum > Measurable)
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

/// The centre of the circle through three points, as a vector from the first one.
/// @param a, b as seen from it.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset FindCentre(
  const ScaledPoint& origin, const SeenPoint& a, const SeenPoint& b)
{
  const double factor = 0.5 / FindTwiceArea(origin, a, b);
  return { (b.Offset.V * a.Square - a.Offset.V * b.Square) * factor,
    (a.Offset.U * b.Square - b.Offset.U * a.Square) * factor };
}

/// The triangles with a place in their circumcircle that can be reached from the place without
/// crossing a segment: the ones that an insertion of the place would replace. There is no vertex
/// inside of them all, so that they form a tree, and their boundary is one ring. A walk along it
/// comes to each triangle three times, so the centres of the first ones are kept.
class PlaceCavity
{
public:
  DELAUNAYFLIP_HOST_DEVICE PlaceCavity(
    const PlaneMesh& mesh, const PlanePoint& place, const PlaceFrame& frame)
    : Mesh(mesh),
      Place(place),
      Frame(frame)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE ScaledPoint GetPoint(CornerId corner) const
  {
    return this->Frame.GetPoint(this->Mesh.GetVertex(corner));
  }

  /// The vertex of a corner, as seen from the place.
  DELAUNAYFLIP_HOST_DEVICE SeenPoint See(CornerId corner) const
  {
    return { this->GetPoint(corner), this->Frame.GetPlace() };
  }

  /// The centre of the circumcircle of a triangle of the cavity, from the place.
  /// @param kept its number among those that are kept, or NotKept, which changes if it can be kept.
  DELAUNAYFLIP_HOST_DEVICE PlaceOffset GetCentre(TriangleId triangle, int& kept)
  {
    if (kept != NotKept)
    {
      return { this->KeptCentres[kept][0], this->KeptCentres[kept][1] };
    }
    // Always from the same corner, so that all three vertices get the same bits.
    const ScaledPoint first = this->GetPoint(MakeCorner(triangle, 0));
    PlaceOffset centre = FindCentre(first, { this->GetPoint(MakeCorner(triangle, 1)), first },
      { this->GetPoint(MakeCorner(triangle, 2)), first });
    const PlaceOffset toFirst = Subtract(first, this->Frame.GetPlace());
    centre = { toFirst.U + centre.U, toFirst.V + centre.V };
    if (this->NumberOfKept < MostKept)
    {
      kept = this->NumberOfKept++;
      this->Kept[kept] = triangle;
      this->KeptCentres[kept][0] = centre.U;
      this->KeptCentres[kept][1] = centre.V;
    }
    return centre;
  }

  /// The corner on the other side of the edge opposite a corner of the cavity, if its triangle is
  /// in the cavity, too; else NoCorner.
  /// @param kept becomes the number of that triangle, if there is one, as for GetCentre.
  DELAUNAYFLIP_HOST_DEVICE CornerId FindWithin(CornerId corner, int& kept) const
  {
    const HalfEdgeId side = this->Mesh.GetHalfEdge(corner);
    const CornerId across = this->Mesh.Edges.CornerOfHalfEdge[side ^ 1u];
    if (across == NoCorner || this->Mesh.IsFixed(side))
    {
      return NoCorner;
    }
    const int found = this->FindKept(TriangleOf(across));
    if (found != NotKept)
    {
      kept = found;
      return across;
    }
    const PlanePoint points[4] = { this->Mesh.GetPoint(this->Mesh.GetVertex(across)),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Next(across))),
      this->Mesh.GetPoint(this->Mesh.GetVertex(PlaneMesh::Previous(across))), this->Place };
    int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    if (sign == UncertainSign || !this->Mesh.IsInFilterRange)
    {
      sign = ExactInCircle(points, false);
    }
    if (this->Mesh.RequireSign(sign) != 1)
    {
      return NoCorner;
    }
    kept = NotKept;
    return across;
  }

  static constexpr int NotKept = -1;

private:
  static constexpr int MostKept = 8;

  DELAUNAYFLIP_HOST_DEVICE int FindKept(TriangleId triangle) const
  {
    for (int i = 0; i < this->NumberOfKept; ++i)
    {
      if (this->Kept[i] == triangle)
      {
        return i;
      }
    }
    return NotKept;
  }

  const PlaneMesh& Mesh;
  const PlanePoint& Place;
  const PlaceFrame& Frame;
  int NumberOfKept = 0;
  TriangleId Kept[MostKept];
  double KeptCentres[MostKept][2];
};

/// The area of a polygon by its corners, which are told one after the other, times two.
class PolygonArea
{
public:
  DELAUNAYFLIP_HOST_DEVICE explicit PolygonArea(const PlaceOffset& first)
    : First(first),
      Last(first),
      SizeOfLast(FindSize(first))
  {
  }

  DELAUNAYFLIP_HOST_DEVICE void Add(const PlaceOffset& corner)
  {
    // Corners may be very far away. The nearer one as the factor loses least.
    const PlaceOffset step = { corner.U - this->Last.U, corner.V - this->Last.V };
    const double size = FindSize(corner);
    const PlaceOffset& nearer = size < this->SizeOfLast ? corner : this->Last;
    const CrossProduct cross(nearer, step);
    this->Twice += cross.Value;
    if (cross.IsCancelled())
    {
      this->Twice += cross.GetRest(nearer, step);
    }
    this->Last = corner;
    this->SizeOfLast = size;
  }

  /// Closes the polygon.
  DELAUNAYFLIP_HOST_DEVICE double GetTwice()
  {
    this->Add(this->First);
    return this->Twice;
  }

private:
  PlaceOffset First, Last;
  double SizeOfLast;
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
    this->Size += std::fabs(weight) * FindSize(offset);
  }

  DELAUNAYFLIP_HOST_DEVICE bool IsGood() const
  {
    constexpr double Tolerance = 1e-10;
    constexpr double Least = 1e-200, Most = 1e200; // so that no sum underflows or overflows
    const double sum = FindSize({ this->SumU, this->SumV }); // may be NaN
    return sum <= Tolerance * this->Size && this->Size > Least && this->Size < Most;
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
  const PlaceFrame frame(mesh, place, triangle);
  PlaceCavity cavity(mesh, place, frame);
  WeightCheck check;
  int kept = PlaceCavity::NotKept;
  cavity.GetCentre(triangle, kept);
  // An edge of the boundary: always on across the next edge, until nothing is beyond.
  CornerId first = MakeCorner(triangle, 0);
  CornerId within = cavity.FindWithin(first, kept);
  while (within != NoCorner)
  {
    cavity.GetCentre(TriangleOf(within), kept);
    first = PlaneMesh::Next(within);
    within = cavity.FindWithin(first, kept);
  }
  CornerId opposite = first; // of an edge of the boundary
  SeenPoint end = cavity.See(PlaneMesh::Previous(first)); // of that edge
  PlaceOffset centre =
    FindCentre(frame.GetPlace(), cavity.See(PlaneMesh::Next(first)), end); // of its new triangle
  do
  {
    // Around the end of this edge, to the edge of the boundary that begins there. The centres on
    // the way are the corners of the area that the vertex loses.
    const VertexId vertex = mesh.GetVertex(PlaneMesh::Previous(opposite));
    const SeenPoint begin = end;
    PolygonArea area(centre);
    within = opposite;
    while (within != NoCorner)
    {
      area.Add(cavity.GetCentre(TriangleOf(within), kept));
      opposite = PlaneMesh::Next(within);
      within = opposite == first ? NoCorner : cavity.FindWithin(opposite, kept);
    }
    end = cavity.See(PlaneMesh::Previous(opposite));
    centre = FindCentre(frame.GetPlace(), begin, end);
    area.Add(centre);
    const double weight = area.GetTwice();
    check.Add(weight, begin.Offset);
    visit(vertex, weight);
  } while (opposite != first);
  return check.IsGood();
}

}

#endif
