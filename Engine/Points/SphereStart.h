// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESTART_H
#define DELAUNAYFLIP_SPHERESTART_H

#include "ExactPredicates.h"
#include "SmallestAngle.h"
#include "SphereMesh.h"

#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// From points on a sphere to a closed mesh of triangles, from which flips begin.
///
/// A stereographic projection from one of the points takes circles on the sphere to circles. So the
/// Delaunay triangulation of the projected points in the plane, with triangles between its boundary
/// and that point, is the convex hull, except for rounding. Only the ids of the triangles are taken
/// from the plane; exact tests with the points as given then check them.

namespace delaunayflip
{

/// Points in space; -0.0 is written as 0.0, so that equal places have equal bits.
using SpacePoints = std::vector<PlanePoint>;

DELAUNAYFLIP_HOST_DEVICE inline bool IsSamePlace(const PlanePoint& a, const PlanePoint& b)
{
  return a.U == b.U && a.V == b.V && a.W == b.W;
}

/// Whether three points are in one line, by exact arithmetic. On a device it may be undecided, and
/// then it is false.
DELAUNAYFLIP_HOST_DEVICE inline bool AreOnLine(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const PlanePoint d{ a.V, a.W, a.U }, e{ b.V, b.W, b.U }, f{ c.V, c.W, c.U };
  const PlanePoint g{ a.W, a.U, a.V }, h{ b.W, b.U, b.V }, i{ c.W, c.U, c.V };
  return FindOrientation(a, b, c) == 0 && FindOrientation(d, e, f) == 0 &&
    FindOrientation(g, h, i) == 0;
}

/// Whether z of `a` is larger; if both are equal, y; and then x. This decides between points that
/// measure the same, whatever their order.
DELAUNAYFLIP_HOST_DEVICE inline bool IsFartherNorth(const PlanePoint& a, const PlanePoint& b)
{
  if (a.W != b.W)
  {
    return a.W > b.W;
  }
  return a.V > b.V || (a.V == b.V && a.U > b.U);
}

/// Projects points from a pole onto a plane, by their directions from the origin. Triangles that
/// are counter-clockwise from outside are counter-clockwise in the plane.
class StereographicProjection
{
public:
  explicit StereographicProjection(const PlanePoint& pole);

  /// Gives NaN for the origin, and for points in the direction of the pole.
  ///
  /// An inversion about the pole takes the sphere to a plane. The difference from the pole is
  /// computed first, so that places near the pole keep their precision.
  DELAUNAYFLIP_HOST_DEVICE void Project(const PlanePoint& point, double (&xy)[2]) const
  {
    const Vector3 offset = FindDirection(point) - this->Pole;
    const double square = Dot(offset, offset);
    if (!(square > 0.0))
    {
      xy[0] = xy[1] = NAN;
      return;
    }
    xy[0] = Dot(offset, this->Across.Second) / square;
    xy[1] = Dot(offset, this->Across.First) / square;
  }

private:
  Vector3 Pole;
  AcrossAxis Across;
};

/// Finds the triangles across the edges of triangles, as FlipSession::StoreNeighbors does.
/// @param points the number of points.
std::vector<std::int32_t> FindNeighbors(
  const std::vector<std::int32_t>& triangles, std::int64_t points);

/// A side of a triangle that has no neighbour.
struct BoundarySide
{
  std::int32_t Corner; ///< The opposite one: 3 * triangle + slot.
  std::int32_t From, To;
};

/// Triangles between a pole and the boundary of a triangulation, which is one ring.
struct PoleStar
{
  std::vector<std::int32_t> Triangles, Neighbors;
};

/// Makes one triangle for each side, in their order.
/// @param first the number of the first triangle.
PoleStar MakePoleStar(
  const std::vector<BoundarySide>& sides, std::int64_t first, std::int32_t pole);

struct NumberedPoint
{
  std::int32_t Id;
  PlanePoint Place;
};

/// Four points that are not in one plane, or none. The first three are counter-clockwise, seen from
/// the side opposite to the fourth.
using Simplex = std::vector<NumberedPoint>;

/// @returns the simplex of four points; nothing if they lie in one plane, or so nearly that
/// rounding puts their center outside.
Simplex OrientSimplex(Simplex corners);

/// The center of a simplex, rounded.
PlanePoint FindCenter(const Simplex& simplex);

/// Whether the triangle has an area and is counter-clockwise, seen from the side opposite to the
/// center.
bool FacesOutside(
  const SpacePoints& points, const std::int32_t* triangle, const PlanePoint& center);

/// LargestSquaredCotangent (SurfaceAngles.h) of a triangle.
DELAUNAYFLIP_HOST_DEVICE inline double MeasureTriangle(
  const PlanePoint* points, const std::int32_t* triangle)
{
  const PlanePoint &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
  return MeasureSquaredCotangent(
    { a.U, a.V, a.W }, { b.U, b.V, b.W }, { c.U, c.V, c.W }, CoordinateRange::Mixed);
}

/// For each triangle that does not face outside, finds one end of its shortest edge: the one
/// farther north. Lists each point once.
std::vector<std::int32_t> FindStrays(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles, const PlanePoint& center);

/// Finds the ends of edges that are not convex and cannot flip, because a triangle would turn over.
/// Such an end is inside of the hull: seen from the center it is below the plane of the other three
/// points of the edge's two triangles. Lists each point once.
/// @param neighbors as FindNeighbors lists them.
std::vector<std::int32_t> FindHidden(const SpacePoints& points,
  const std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& neighbors,
  const PlanePoint& center);

/// For each triangle without an area, finds the point between the other two. Lists each point once.
std::vector<std::int32_t> FindBetween(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles);

/// Finds points of a convex hull that are no corners of it, because they lie within a face or an
/// edge of the hull. Fewer than three convex edges end at such a point. All triangles must have an
/// area.
/// @param neighbors as FindNeighbors lists them.
std::vector<std::int32_t> FindFlat(const SpacePoints& points,
  const std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& neighbors);

}

#endif
