// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PREDICATES_H
#define DELAUNAYFLIP_PREDICATES_H

#include "EngineExport.h"

/// @file
/// Exact signs of orientation and in-circle determinants, for any finite double coordinates: by a
/// floating-point filter with a proven error bound (Shewchuk 1997); if that cannot decide, by
/// fixed-point integers of at most 512 bits; if the exponents spread too far for those, by integers
/// of any width. Never wrong by rounding, overflow or underflow. 0 if a coordinate is NaN or
/// infinite.

namespace delaunayflip
{

/// The turn of the path a, b, c in the plane: +1 left (counter-clockwise), -1 right, 0 collinear.
DELAUNAYFLIP_EXPORT int Orientation(const double a[2], const double b[2], const double c[2]);

/// The sign of the in-circle determinant: +1 if `d` lies inside the circle through the
/// counter-clockwise triangle a, b, c, -1 outside, 0 on it; the opposite for clockwise a, b, c.
DELAUNAYFLIP_EXPORT int InCircle(
  const double a[2], const double b[2], const double c[2], const double d[2]);

/// In-circle in a tilted plane. Points are (u, v, w): u and v span the plane's projection along its
/// dominant axis w, and the lift is the squared length u^2 + v^2 + w^2. For exactly coplanar points
/// this is the in-circle test times the sign of the projected triangle. For nearly coplanar points
/// it is the test for a fixed lifting of the points, so flips by it still end.
DELAUNAYFLIP_EXPORT int InCircleTilted(
  const double a[3], const double b[3], const double c[3], const double d[3]);

}

#endif
