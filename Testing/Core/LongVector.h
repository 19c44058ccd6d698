// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LONGVECTOR_H
#define DELAUNAYFLIP_LONGVECTOR_H

#include <array>
#include <cmath>

/// @file
/// Vectors and angles in long double, independent of the engine's geometry.

namespace delaunayflip
{

using LongVector = std::array<long double, 3>;

inline LongVector Subtract(const LongVector& a, const LongVector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline long double Dot(const LongVector& a, const LongVector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The normal of a triangle, as long as twice its area.
inline LongVector FindNormal(const LongVector& a, const LongVector& b, const LongVector& c)
{
  const LongVector u = Subtract(b, a);
  const LongVector v = Subtract(c, a);
  return { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
}

/// The angle p, apex, q in radians.
inline long double FindAngle(const LongVector& apex, const LongVector& p, const LongVector& q)
{
  const LongVector n = FindNormal(apex, p, q);
  return std::atan2(std::sqrt(Dot(n, n)), Dot(Subtract(p, apex), Subtract(q, apex)));
}

}

#endif
