// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERETESTSUPPORT_H
#define DELAUNAYFLIP_SPHERETESTSUPPORT_H

#include "FlipTestSupport.h"

#include <array>
#include <cstdint>
#include <vector>

/// @file
/// Points on a sphere, and their convex hull by CGAL.

namespace delaunayflip
{

/// A set of points with a name.
struct SphereFamily
{
  const char* Name;
  std::vector<Point3> (*Make)();
  bool HasTies; ///< Whether four points may lie in one plane, exactly.
  bool IsPart = false; ///< Whether one half of the sphere has no points.
};

/// Sets of some hundred points, of many kinds. Those on a part of the sphere come last.
std::vector<SphereFamily> ListSphereFamilies();

/// All points with integer coordinates at the square root of `square` from the origin. They lie
/// exactly on a sphere, and many of them on common circles.
std::vector<Point3> MakeLatticePoints(int square);

/// Normally distributed directions, scaled to length 1 and rounded to the precision of Real.
template <typename Real>
std::vector<Point3> MakeRandomPoints(std::int64_t count, std::uint32_t seed);

/// The convex hull, as CGAL finds it. Its triangles are counter-clockwise from outside. Where four
/// points tie, CGAL chooses the diagonal. Points inside have no triangles.
OwnedMesh<double> MakeHull(const std::vector<Point3>& points);

/// Makes a number of random flips that turn no triangle over, seen from the origin.
void Scramble(OwnedMesh<double>& mesh, int flips, std::uint32_t seed);

/// The places of longitudes and latitudes on the unit sphere.
std::vector<Point3> PlaceAll(const std::vector<std::array<double, 2>>& degrees);

FlipOptions OnSphere(TieRuleKind ties = TieRuleKind::Canonical);

}

#endif
