// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESTART_H
#define DELAUNAYFLIP_SPHERESTART_H

#include "SphereMesh.h"

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

bool IsSamePlace(const PlanePoint& a, const PlanePoint& b);

/// Whether three points are in one line, by exact arithmetic.
bool AreOnLine(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Whether z of `a` is larger; if both are equal, y; and then x. This decides between points that
/// measure the same, whatever their order.
bool IsFartherNorth(const PlanePoint& a, const PlanePoint& b);

/// Projects points from a pole onto a plane, by their directions from the origin. Triangles that
/// are counter-clockwise from outside are counter-clockwise in the plane.
class StereographicProjection
{
public:
  explicit StereographicProjection(const PlanePoint& pole);

  /// Gives NaN for the origin, and for points in the direction of the pole.
  void Project(const PlanePoint& point, double (&xy)[2]) const;

private:
  Vector3 Pole;
  AcrossAxis Across;
};

/// Finds the triangles across the edges of triangles, as FlipSession::StoreNeighbors does.
/// @param points the number of points.
std::vector<std::int32_t> FindNeighbors(
  const std::vector<std::int32_t>& triangles, std::int64_t points);

/// Adds the triangles between a pole and the boundary of a triangulation, which is one ring.
/// @param neighbors as FindNeighbors lists them, before and after.
void JoinPole(
  std::vector<std::int32_t>& triangles, std::vector<std::int32_t>& neighbors, std::int32_t pole);

/// Finds four points that span a large volume. The first one is the farthest north. The first three
/// are counter-clockwise, seen from the side opposite to the fourth. They depend on the places
/// alone.
/// @returns nothing if all points lie in one plane, or so nearly that rounding puts the center of
/// the four points outside.
std::vector<std::int32_t> FindSimplex(
  const SpacePoints& points, const std::vector<std::int32_t>& active);

/// The center of a simplex, rounded.
PlanePoint FindCenter(const SpacePoints& points, const std::vector<std::int32_t>& simplex);

/// Whether the triangle has an area and is counter-clockwise, seen from the side opposite to the
/// center.
bool FacesOutside(
  const SpacePoints& points, const std::int32_t* triangle, const PlanePoint& center);

/// LargestSquaredCotangent (SurfaceAngles.h) of a triangle.
double MeasureTriangle(const SpacePoints& points, const std::int32_t* triangle);

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
