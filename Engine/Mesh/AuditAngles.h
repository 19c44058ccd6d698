// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_AUDITANGLES_H
#define DELAUNAYFLIP_AUDITANGLES_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

/// @file
/// The opposite-angle test of MeshAudit and its tolerance. It does not use the engine's
/// OppositeAngles.h and works differently, with divisions, hypot and inverse trigonometry: if both
/// shared code, a mistake in it would confirm itself.

namespace delaunayflip
{
namespace audit
{

using Vector = std::array<double, 3>;

inline Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double Length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

/// Cosine and sine, times any positive number, of the angle at `apex` towards `p` and `q`.
struct Angle
{
  Angle(const Vector& apex, const Vector& p, const Vector& q)
  {
    const Vector first = Subtract(p, apex);
    const Vector second = Subtract(q, apex);
    this->Cosine = Dot(first, second);
    this->Sine = Length(Cross(first, second));
  }

  double Radians() const { return std::atan2(this->Sine, this->Cosine); }

  double Cosine;
  double Sine;
};

/// Whether the angles sum to more than pi + tolerance. The sum lies in [0, 2 pi].
inline bool IsSumAbovePi(const Angle& a, const Angle& b, double tolerance)
{
  if (a.Cosine >= 0.0 && b.Cosine >= 0.0)
  {
    return false;
  }
  const double sine = a.Sine * b.Cosine + a.Cosine * b.Sine;
  const double cosine = a.Cosine * b.Cosine - a.Sine * b.Sine;
  const bool isAboveThreeHalvesPi = a.Cosine < 0.0 && b.Cosine < 0.0 && cosine > 0.0;
  return isAboveThreeHalvesPi || sine * std::cos(tolerance) - cosine * std::sin(tolerance) < 0.0;
}

/// The automatic tolerance of a quad in radians: how much its angle sum may change when every
/// coordinate moves by a unit in the last place. Infinite if the change has no bound.
/// @param apqb the points of the quad.
/// @param epsilon that of the coordinates' type.
inline double FindTolerance(const std::array<Vector, 4>& apqb, double epsilon)
{
  // Differences and lengths of a quarter of the coordinates are finite.
  std::array<Vector, 4> quarters = apqb;
  double farthest = 0.0;
  for (Vector& point : quarters)
  {
    point = { 0.25 * point[0], 0.25 * point[1], 0.25 * point[2] };
    farthest = std::max(farthest, Length(point));
  }
  double turns = 0.0;
  for (int apex : { 0, 3 })
  {
    for (int end : { 1, 2 })
    {
      const double moved = 2.0 * epsilon * farthest; // of one end relative to the other
      turns += moved / Length(Subtract(quarters[end], quarters[apex]));
    }
  }
  // The rounding of the engine's test is less than this.
  turns += 32.0 * std::numeric_limits<double>::epsilon();
  return turns < 1.0 ? std::asin(turns) : std::numeric_limits<double>::infinity();
}

}
}

#endif
