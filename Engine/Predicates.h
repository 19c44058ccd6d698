// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PREDICATES_H
#define DELAUNAYFLIP_PREDICATES_H

#include "EngineExport.h"

/// @file
/// Exact signs of orientation and in-circle determinants, for any finite double coordinates. A
/// floating-point filter with a proven error bound (Shewchuk 1997) comes first. If it cannot
/// decide, fixed-point integers of at most 512 bits do. If the exponents spread too far for those,
/// integers of any width do. The signs are never wrong by rounding, overflow or underflow. They are
/// 0 if a coordinate is NaN or infinite.
///
///     const double a[] = { 0, 0 }, b[] = { 1, 0 }, c[] = { 1, 1 }, d[] = { 0, 1 };
///     Orientation(a, b, c); // 1
///     Orientation(a, c, b); // -1
///     InCircle(a, b, c, d); // 0
///     const double inside[] = { 0.5, 0.1 };
///     InCircle(a, b, c, inside); // 1
///     const double o[] = { 0, 0, 0 }, x[] = { 1, 0, 0 }, y[] = { 0, 1, 0 }, z[] = { 0, 0, 1 };
///     Orientation3D(x, y, z, o); // 1

namespace delaunayflip
{

/// The orientation of a, b, c in the plane: +1 counter-clockwise, -1 clockwise, 0 collinear.
DELAUNAYFLIP_EXPORT int Orientation(const double a[2], const double b[2], const double c[2]);

/// The sign of the in-circle determinant: +1 if `d` lies inside the circle through the
/// counter-clockwise triangle a, b, c, -1 outside, 0 on it. The signs are the other way round if
/// a, b, c is clockwise.
DELAUNAYFLIP_EXPORT int InCircle(
  const double a[2], const double b[2], const double c[2], const double d[2]);

/// In-circle in a tilted plane. Points are (u, v, w): u and v span the plane's projection along its
/// dominant axis w, and the lift is the squared length u^2 + v^2 + w^2. For exactly coplanar points
/// this is the in-circle test times the sign of the projected triangle. For nearly coplanar points
/// it is the test for a fixed lifting of the points, so flips by it still end.
DELAUNAYFLIP_EXPORT int InCircleTilted(
  const double a[3], const double b[3], const double c[3], const double d[3]);

/// The orientation of a, b, c in space, seen from the side of their plane opposite to `d`: +1
/// counter-clockwise, -1 clockwise, 0 if the four points lie in one plane.
DELAUNAYFLIP_EXPORT int Orientation3D(
  const double a[3], const double b[3], const double c[3], const double d[3]);

}

#endif
