// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OPPOSITEANGLES_H
#define DELAUNAYFLIP_OPPOSITEANGLES_H

#include "HostDevice.h"
#include "SurfaceAngles.h"

#include <cmath>

/// @file
/// Whether the two angles opposite to an edge sum to more than pi plus a tolerance.

namespace delaunayflip
{

/// How far an opposite-angle sum may exceed pi.
struct AngleTolerance
{
  double Sine = 0.0; ///< The sine of a fixed tolerance.
  double Cosine = 1.0;
  double Precision =
    0.0; ///< FloatPrecision or DoublePrecision: automatic, beside a fixed one of 0.
};

/// The distance between a normal number of type float or double and the next one is at most this
/// times the number.
constexpr double FloatPrecision = 0x1p-23;
constexpr double DoublePrecision = 0x1p-52;

/// The sum of the angles at a and b, opposite the edge p-q.
struct AngleSum
{
  DELAUNAYFLIP_HOST_DEVICE explicit AngleSum(const QuadPoints& quad)
  {
    const Vector3 ap = quad.P - quad.A, aq = quad.Q - quad.A;
    const Vector3 bp = quad.P - quad.B, bq = quad.Q - quad.B;
    this->Set(Dot(ap, aq), Length(Cross(ap, aq)), Dot(bp, bq), Length(Cross(bp, bq)));
  }

  /// The cosines and sines of the angles, each pair times a positive number.
  DELAUNAYFLIP_HOST_DEVICE AngleSum(double cosA, double sinA, double cosB, double sinB)
  {
    this->Set(cosA, sinA, cosB, sinB);
  }

  /// Whether it is more than pi + a fixed tolerance (the paper's eq. 5): sin(sum - tolerance) < 0.
  /// That holds between pi/2 and 3/2 pi, where the cosine is not positive; elsewhere the sum is
  /// small or, when both angles are obtuse, large.
  DELAUNAYFLIP_HOST_DEVICE bool ExceedsPi(const AngleTolerance& tolerance) const
  {
    if (this->Cosine > 0.0)
    {
      return this->BothObtuse;
    }
    return this->Sine * tolerance.Cosine - this->Cosine * tolerance.Sine < 0.0;
  }

  /// For a sum beyond pi: the sine of its excess over pi, infinite beyond 3/2 pi.
  DELAUNAYFLIP_HOST_DEVICE double GetExcess() const
  {
    return this->Cosine > 0.0 ? INFINITY : -this->Sine;
  }

  /// Both times |ap| |aq| |bp| |bq|.
  double Sine, Cosine;
  bool BothObtuse;
  bool MayVanish; ///< Lengths are so small that their products may have lost bits.

private:
  DELAUNAYFLIP_HOST_DEVICE void Set(double cosA, double sinA, double cosB, double sinB)
  {
    this->Sine = sinA * cosB + cosA * sinB;
    this->Cosine = cosA * cosB - sinA * sinB;
    this->BothObtuse = cosA < 0.0 && cosB < 0.0;
    // At least the product of the four lengths, which are below 2^103 unless the mesh is extreme
    // (MeshSurvey::Range): so that of any two is above 2^-446, and the squares within sinA and
    // sinB are normal numbers.
    constexpr double Smallest = 0x1p-240;
    this->MayVanish = !(std::fabs(this->Cosine) + std::fabs(this->Sine) > Smallest);
  }
};

/// The distance from the origin of the quad's farthest point.
DELAUNAYFLIP_HOST_DEVICE inline double FindFarthest(const QuadPoints& quad)
{
  const double a = Dot(quad.A, quad.A), b = Dot(quad.B, quad.B);
  const double p = Dot(quad.P, quad.P), q = Dot(quad.Q, quad.Q);
  const double atAB = a > b ? a : b;
  const double atPQ = p > q ? p : q;
  return std::sqrt(atAB > atPQ ? atAB : atPQ);
}

/// Whether the angle sum of a quad may really be pi or less, if each coordinate of its points may
/// be off by a unit in its last place. If every point lies at most m from the origin, it moves by
/// at most d = precision * m. A vector of length l turns by at most asin(2 d / l) when both its
/// ends move by d. The sum changes by at most the turns of the four legs of its angles, and asin is
/// convex and 0 at 0, so that these are together at most
///
///     asin(t), t = 2 d (1/|ap| + 1/|aq| + 1/|bp| + 1/|bq|).
///
/// So sin(sum - pi) > t tells that the sum exceeds pi wherever the points are. It is compared here
/// after a multiplication by the four lengths, which avoids divisions and makes a leg without
/// length noise. If t >= 1, any sum is noise.
/// @param excess AngleSum::GetExcess.
DELAUNAYFLIP_HOST_DEVICE inline bool IsNoise(
  const QuadPoints& quad, double precision, double excess)
{
  // More than the rounding of these numbers: below 20 * 2^-53 in the sine, below 30 * 2^-53 in t.
  constexpr double Rounding = 0x1p-47;
  const double ap = Length(quad.P - quad.A), aq = Length(quad.Q - quad.A);
  const double bp = Length(quad.P - quad.B), bq = Length(quad.Q - quad.B);
  const double atA = ap * aq, atB = bp * bq;
  const double product = atA * atB;
  const double reciprocals = (ap + aq) * atB + (bp + bq) * atA;
  const double noise = 2.0 * precision * FindFarthest(quad) * reciprocals + Rounding * product;
  return !(noise < product && noise < excess);
}

}

#endif
