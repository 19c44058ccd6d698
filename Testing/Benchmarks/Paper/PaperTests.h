// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PAPERTESTS_H
#define DELAUNAYFLIP_PAPERTESTS_H

#include "HostDevice.h"
#include "PaperArrays.h"

#include <cmath>

/// @file
/// Tests of an edge in floating-point arithmetic: the paper's (eq. 5) and the in-circle test, which
/// the paper names as future work. Both return whether the edge p-q of the triangles (p, q, a) and
/// (q, p, b) is bad, and false if a number is NaN.

namespace delaunayflip
{

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE PaperPoint2<Real> operator-(
  const PaperPoint2<Real>& p, const PaperPoint2<Real>& q)
{
  return { p.X - q.X, p.Y - q.Y };
}

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE PaperPoint3<Real> operator-(
  const PaperPoint3<Real>& p, const PaperPoint3<Real>& q)
{
  return { p.X - q.X, p.Y - q.Y, p.Z - q.Z, Real(0) };
}

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE Real Dot(const PaperPoint2<Real>& p, const PaperPoint2<Real>& q)
{
  return p.X * q.X + p.Y * q.Y;
}

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE Real Dot(const PaperPoint3<Real>& p, const PaperPoint3<Real>& q)
{
  return p.X * q.X + p.Y * q.Y + p.Z * q.Z;
}

template <typename Real>
DELAUNAYFLIP_HOST_DEVICE PaperPoint3<Real> Cross(
  const PaperPoint3<Real>& p, const PaperPoint3<Real>& q)
{
  return { p.Y * q.Z - p.Z * q.Y, p.Z * q.X - p.X * q.Z, p.X * q.Y - p.Y * q.X, Real(0) };
}

/// The angle p, apex, q in radians. Because of rounding the cosine may lie outside -1 .. 1.
template <typename Point>
DELAUNAYFLIP_HOST_DEVICE typename Point::Number FindAngle(
  const Point& apex, const Point& p, const Point& q)
{
  using Real = typename Point::Number;
  const Point u = p - apex;
  const Point v = q - apex;
  const Real cosine = Dot(u, v) / (std::sqrt(Dot(u, u)) * std::sqrt(Dot(v, v)));
  return std::acos(cosine < Real(-1) ? Real(-1) : (cosine > Real(1) ? Real(1) : cosine));
}

/// Eq. 5: the opposite angles sum to more than pi + epsilon.
template <typename Real>
struct OppositeAngleTest
{
  Real Limit; ///< pi + epsilon.

  template <typename Point>
  DELAUNAYFLIP_HOST_DEVICE bool IsBad(
    const Point& p, const Point& q, const Point& a, const Point& b) const
  {
    return FindAngle(a, p, q) + FindAngle(b, p, q) > this->Limit;
  }
};

/// The in-circle determinant of a counter-clockwise mesh exceeds epsilon times the sum of the
/// absolute values of its terms.
template <typename Real>
struct InCircleTest
{
  Real Epsilon;
  Real Side; ///< 1, but -1 for a clockwise mesh.

  DELAUNAYFLIP_HOST_DEVICE bool IsBad(const PaperPoint2<Real>& p, const PaperPoint2<Real>& q,
    const PaperPoint2<Real>& a, const PaperPoint2<Real>& b) const
  {
    Real sum = 0;
    Real magnitude = 0;
    AddTerms(p - b, q - b, a - b, sum, magnitude);
    AddTerms(q - b, a - b, p - b, sum, magnitude);
    AddTerms(a - b, p - b, q - b, sum, magnitude);
    return this->Side * sum > this->Epsilon * magnitude;
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static void AddTerms(const PaperPoint2<Real>& u,
    const PaperPoint2<Real>& v, const PaperPoint2<Real>& lifted, Real& sum, Real& magnitude)
  {
    const Real left = u.X * v.Y;
    const Real right = u.Y * v.X;
    const Real lift = Dot(lifted, lifted);
    sum += lift * (left - right);
    magnitude += lift * (std::fabs(left) + std::fabs(right));
  }
};

/// Section 5.2: whether the normals of the two triangles are "almost parallel".
template <typename Real>
struct NormalThreshold
{
  Real Cosine; ///< Of the threshold; at most -1: no threshold.

  DELAUNAYFLIP_HOST_DEVICE bool Admits(const PaperPoint2<Real>&, const PaperPoint2<Real>&,
    const PaperPoint2<Real>&, const PaperPoint2<Real>&) const
  {
    return true;
  }

  DELAUNAYFLIP_HOST_DEVICE bool Admits(const PaperPoint3<Real>& p, const PaperPoint3<Real>& q,
    const PaperPoint3<Real>& a, const PaperPoint3<Real>& b) const
  {
    if (this->Cosine <= Real(-1))
    {
      return true;
    }
    const PaperPoint3<Real> m = Cross(q - p, a - p);
    const PaperPoint3<Real> n = Cross(p - q, b - q);
    return Dot(m, n) >= this->Cosine * std::sqrt(Dot(m, m)) * std::sqrt(Dot(n, n));
  }
};

}

#endif
