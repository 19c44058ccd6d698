// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESTART_H
#define DELAUNAYFLIP_SPHERESTART_H

#include "FilteredPredicates.h"

#include <cstdint>
#include <vector>

/// @file
/// From points on a sphere to a closed mesh of triangles, from which flips begin.
///
/// Projected stereographically from one of the points, circles on the sphere stay circles. So the
/// Delaunay triangulation of the projected points in the plane, with triangles between its boundary
/// and that point, is the convex hull, but for rounding. Only the combinatorial mesh is taken from
/// the plane: what it is worth is found out with the points as given.

namespace delaunayflip
{

/// Points in space; -0.0 is written as 0.0, so that equal places have equal bits.
using SpacePoints = std::vector<PlanePoint>;

bool IsSamePlace(const PlanePoint& a, const PlanePoint& b);

/// Exactly.
bool AreOnLine(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// In the order of z, then y, then x.
bool IsFartherNorth(const PlanePoint& a, const PlanePoint& b);

/// Projects directions, seen from the origin, from a pole onto a plane. What is counter-clockwise
/// from outside stays so.
class StereographicProjection
{
public:
  explicit StereographicProjection(const PlanePoint& pole);

  /// NaN for what has no direction, or that of the pole.
  void Project(const PlanePoint& point, double (&xy)[2]) const;

private:
  Vector3 Pole, First, Second;
};

/// The triangles across the edges of triangles, as FlipSession::StoreNeighbors gives them.
/// @param points how many there are.
std::vector<std::int32_t> FindNeighbors(
  const std::vector<std::int32_t>& triangles, std::int64_t points);

/// Adds the triangles between a pole and the boundary of a triangulation.
void JoinPole(std::vector<std::int32_t>& triangles, const std::vector<std::int32_t>& neighbors,
  std::int32_t pole);

/// Four points that span a large volume, counter-clockwise as seen from the other side than the
/// last one, beginning with the one farthest north; empty if all lie in one plane, or so nearly
/// that no place between them has coordinates in double precision. They depend on
/// the places alone.
std::vector<std::int32_t> FindSimplex(
  const SpacePoints& points, const std::vector<std::int32_t>& active);

/// A place inside of a simplex.
PlanePoint FindCenter(const SpacePoints& points, const std::vector<std::int32_t>& simplex);

/// Whether the triangle is counter-clockwise and has an area, seen from outside.
bool FacesOutside(
  const SpacePoints& points, const std::int32_t* triangle, const PlanePoint& center);

/// For each triangle that does not face outside, the end of its shortest edge that is farther
/// north, each point once.
std::vector<std::int32_t> FindStrays(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles, const PlanePoint& center);

/// Finds points at which edges end that are not convex and cannot flip, because a triangle would
/// turn over, each once. Such a point is inside of the hull: it is below the plane of the triangle
/// that its neighbors at the flip would make, seen from the center.
std::vector<std::int32_t> FindHidden(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles, const PlanePoint& center);

/// Of each triangle without an area the point between the others, each once.
std::vector<std::int32_t> FindBetween(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles);

/// Finds points of a convex hull, made of triangles with an area, that are no corners of it: they
/// are within a plane or an edge of the hull. Such a point has fewer than three sharp edges.
std::vector<std::int32_t> FindFlat(
  const SpacePoints& points, const std::vector<std::int32_t>& triangles);

}

#endif
