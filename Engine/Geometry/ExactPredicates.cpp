// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactPredicates.h"

#include "Predicates.h"

#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 takes the unused half of a union inside cpp_int for an uninitialised value.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>

/// @file
/// Signs of determinants in integers of any width: every double is an integer times 2^-1074.

namespace delaunayflip
{

namespace
{
using Integer = boost::multiprecision::cpp_int;

/// value * 2^1074.
Integer ToInteger(double value)
{
  constexpr int MantissaBits = 53;
  constexpr int SmallestExponent = -1074;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  Integer result = static_cast<long long>(std::ldexp(fraction, MantissaBits));
  const int shift = exponent - MantissaBits - SmallestExponent;
  // Subnormal numbers end in as many zero bits as the shift is negative.
  if (shift < 0)
  {
    return result >> -shift;
  }
  return result << shift;
}

struct WidePoint
{
  Integer U, V, W;

  explicit WidePoint(const PlanePoint& point)
    : U(ToInteger(point.U)),
      V(ToInteger(point.V)),
      W(ToInteger(point.W))
  {
  }
};
}

int WideOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const WidePoint p(a), q(b), r(c);
  const Integer determinant = (p.U - r.U) * (q.V - r.V) - (p.V - r.V) * (q.U - r.U);
  return determinant.sign();
}

int WideInCircle(const PlanePoint (&points)[4], bool tilted)
{
  const WidePoint d(points[3]);
  Integer u[3], v[3], lift[3];
  for (int i = 0; i < 3; ++i)
  {
    const WidePoint p(points[i]);
    u[i] = p.U - d.U;
    v[i] = p.V - d.V;
    lift[i] = u[i] * u[i] + v[i] * v[i];
    if (tilted)
    {
      lift[i] += (p.W - d.W) * (p.W + d.W);
    }
  }
  const Integer determinant = lift[0] * (u[1] * v[2] - u[2] * v[1]) +
    lift[1] * (u[2] * v[0] - u[0] * v[2]) + lift[2] * (u[0] * v[1] - u[1] * v[0]);
  return determinant.sign();
}

int WideOrientation3D(const PlanePoint (&points)[4])
{
  const WidePoint d(points[3]);
  Integer u[3], v[3], w[3];
  for (int i = 0; i < 3; ++i)
  {
    const WidePoint p(points[i]);
    u[i] = p.U - d.U;
    v[i] = p.V - d.V;
    w[i] = p.W - d.W;
  }
  const Integer determinant = w[0] * (u[1] * v[2] - u[2] * v[1]) +
    w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
  return determinant.sign();
}

namespace
{
int DecideInCircle(const PlanePoint (&points)[4], bool tilted)
{
  bool inRange = true;
  for (const PlanePoint& p : points)
  {
    if (!IsFinite(p))
    {
      return 0;
    }
    inRange = inRange && IsInFilterRange(p) && std::fabs(p.W) <= LargestFilteredCoordinate;
  }
  int sign = UncertainSign;
  if (inRange && tilted)
  {
    sign = FilteredInCircle<true>(points[0], points[1], points[2], points[3]);
  }
  else if (inRange)
  {
    sign = FilteredInCircle<false>(points[0], points[1], points[2], points[3]);
  }
  if (sign != UncertainSign)
  {
    return sign;
  }
  return ExactInCircle(points, tilted);
}
}

int Orientation(const double a[2], const double b[2], const double c[2])
{
  const PlanePoint points[3] = { { a[0], a[1], 0.0 }, { b[0], b[1], 0.0 }, { c[0], c[1], 0.0 } };
  if (!IsFinite(points[0]) || !IsFinite(points[1]) || !IsFinite(points[2]))
  {
    return 0;
  }
  return FindOrientation(points[0], points[1], points[2]);
}

int InCircle(const double a[2], const double b[2], const double c[2], const double d[2])
{
  return DecideInCircle(
    { { a[0], a[1], 0.0 }, { b[0], b[1], 0.0 }, { c[0], c[1], 0.0 }, { d[0], d[1], 0.0 } }, false);
}

int InCircleTilted(const double a[3], const double b[3], const double c[3], const double d[3])
{
  return DecideInCircle(
    { { a[0], a[1], a[2] }, { b[0], b[1], b[2] }, { c[0], c[1], c[2] }, { d[0], d[1], d[2] } },
    true);
}

int Orientation3D(const double a[3], const double b[3], const double c[3], const double d[3])
{
  const PlanePoint points[4] = { { a[0], a[1], a[2] }, { b[0], b[1], b[2] }, { c[0], c[1], c[2] },
    { d[0], d[1], d[2] } };
  for (const PlanePoint& p : points)
  {
    if (!IsFinite(p))
    {
      return 0;
    }
  }
  return FindOrientation3D(points[0], points[1], points[2], points[3]);
}

}
