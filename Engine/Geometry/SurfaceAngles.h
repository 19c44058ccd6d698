// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SURFACEANGLES_H
#define DELAUNAYFLIP_SURFACEANGLES_H

#include "FilteredPredicates.h"
#include "HostDevice.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

/// @file
/// Angles in space by cross and dot products: no inverse trigonometry, no dependence on scale.

namespace delaunayflip
{

constexpr double Pi = 3.14159265358979323846;
constexpr double DegreesToRadians = Pi / 180.0;

DELAUNAYFLIP_HOST_DEVICE inline Vector3 LoadPoint(const PointArray& points, std::int64_t point)
{
  return { points.Get(point, 0), points.Get(point, 1), points.Get(point, 2) };
}

/// The points of a quad (EdgeFlip.h's picture).
struct QuadPoints
{
  Vector3 A, P, Q, B;
};

/// Whether the normals of the two triangles differ by more than the angle with that cosine. False
/// if a triangle has no area, and so no normal.
DELAUNAYFLIP_HOST_DEVICE inline bool IsSharp(const QuadPoints& quad, double cosine)
{
  const Vector3 upper = AreaVector(quad.A, quad.P, quad.Q);
  const Vector3 lower = AreaVector(quad.B, quad.Q, quad.P);
  const double squares = Dot(upper, upper) * Dot(lower, lower), dot = Dot(upper, lower);
  // Most edges are so far from sharp that no root need be taken.
  constexpr double Rounding = 1.0 + 0x1p-40, Smallest = 0x1p-900;
  if (dot > 0.0 && squares > Smallest && dot * dot > Rounding * cosine * cosine * squares)
  {
    return false;
  }
  const double lengths = Length(upper) * Length(lower);
  return lengths > 0.0 && dot < cosine * lengths;
}

/// Whether the angles at a and b are surely acute, so that their sum is below pi: a filter before
/// AngleSum for coordinates of CoordinateRange::Usual, without roots.
DELAUNAYFLIP_HOST_DEVICE inline bool AreAcute(const QuadPoints& quad)
{
  // Products as large as this do not vanish in an AngleSum.
  constexpr double Smallest = 0x1p-200;
  const double atA = Dot(quad.P - quad.A, quad.Q - quad.A);
  const double atB = Dot(quad.P - quad.B, quad.Q - quad.B);
  return atA > 0.0 && atB > 0.0 && atA * atB > Smallest;
}

/// Whether flipping p-q to a-b would fold the surface over: whether a new normal points away from
/// the quad's vector area, which the flip does not change.
DELAUNAYFLIP_HOST_DEVICE inline bool FoldsOver(const QuadPoints& quad)
{
  const Vector3 area = AreaVector(quad.A, quad.P, quad.Q) + AreaVector(quad.B, quad.Q, quad.P);
  return !(Dot(AreaVector(quad.A, quad.P, quad.B), area) > 0.0 &&
    Dot(AreaVector(quad.B, quad.Q, quad.A), area) > 0.0);
}

/// Squared cotangent of the smallest angle of a triangle, which grows as the angle shrinks:
/// infinite without area, -infinite (no angle) with a coordinate that is NaN or infinite. The
/// smallest angle is at most 60 degrees, so its cotangent is positive.
/// @param atA, atB, atC products of the edges at the corners. @param squaredArea of twice the
/// triangle.
DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangent(
  double atA, double atB, double atC, double squaredArea)
{
  if (!(squaredArea < INFINITY))
  {
    return -INFINITY;
  }
  if (!(squaredArea > 0.0))
  {
    return INFINITY;
  }
  const double largest = std::max(std::max(atC, atB), atA);
  return largest * largest / squaredArea;
}

DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangent(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  const Vector3 ab = b - a, ac = c - a, bc = c - b;
  const Vector3 normal = Cross(ab, ac);
  return LargestSquaredCotangent(Dot(ab, ac), -Dot(ab, bc), Dot(ac, bc), Dot(normal, normal));
}

/// The angle in degrees of a LargestSquaredCotangent; NaN if there is none.
inline double ToDegrees(double squaredCotangent)
{
  if (squaredCotangent == -INFINITY)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::atan2(1.0, std::sqrt(squaredCotangent)) / DegreesToRadians; // 0 if it is infinite
}

/// The points of a polygon relative to its first one, scaled by a power of two such that products
/// of two offsets neither overflow nor vanish. Offsets may be of any type indexed by [i][axis]; the
/// first `axes` coordinates are loaded.
template <typename Offsets>
DELAUNAYFLIP_HOST_DEVICE void LoadScaledOffsets(
  const PointArray& points, const std::int64_t* ids, std::int64_t count, int axes, Offsets& offsets)
{
  const auto forEach = [&](const auto& work)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int axis = 0; axis < axes; ++axis)
      {
        work(offsets[i][axis], points.Get(ids[i], axis), points.Get(ids[0], axis));
      }
    }
  };
  double largest = 0.0;
  forEach([&](double&, double x, double) { largest = std::max(largest, std::fabs(x)); });
  // The difference of two finite numbers may be infinite, that of their halves may not.
  const bool mayOverflow = largest > 0.5 * std::numeric_limits<double>::max();
  const double unit = mayOverflow ? 0.5 : 1.0;
  largest = 0.0;
  forEach(
    [&](double& offset, double x, double origin)
    {
      offset = unit * x - unit * origin;
      largest = std::max(largest, std::fabs(offset));
    });
  const int exponent = ExponentOf(largest);
  const double scale = std::scalbn(1.0, -exponent);
  if (std::isfinite(scale))
  {
    forEach([&](double& offset, double, double) { offset *= scale; });
  }
  else // all offsets are subnormal
  {
    forEach([&](double& offset, double, double) { offset = std::scalbn(offset, -exponent); });
  }
}

/// What is measured of the angles of some triangles, with operator+= so that Sum can compute it.
struct AngleSums
{
  double Largest = -INFINITY; ///< The largest LargestSquaredCotangent.
  std::int64_t Below10 = 0; ///< How many triangles have an angle below 10 degrees.
  std::int64_t Below20 = 0;
  std::int64_t Below30 = 0;

  /// How many of the three angles the smallest angle of a triangle is below.
  DELAUNAYFLIP_HOST_DEVICE static unsigned char Grade(double squaredCotangent)
  {
    constexpr double At10 = 32.16343747752636, At20 = 7.548632170413032, At30 = 3.0;
    return static_cast<unsigned char>(
      int(squaredCotangent > At10) + int(squaredCotangent > At20) + int(squaredCotangent > At30));
  }

  DELAUNAYFLIP_HOST_DEVICE void Count(unsigned char grade, std::int64_t triangles)
  {
    this->Below30 += int(grade > 0) * triangles;
    this->Below20 += int(grade > 1) * triangles;
    this->Below10 += int(grade > 2) * triangles;
  }

  /// Adds a triangle.
  DELAUNAYFLIP_HOST_DEVICE void Add(double squaredCotangent)
  {
    this->Largest = std::max(this->Largest, squaredCotangent);
    this->Count(Grade(squaredCotangent), 1);
  }

  DELAUNAYFLIP_HOST_DEVICE AngleSums& operator+=(const AngleSums& other)
  {
    this->Largest = std::max(this->Largest, other.Largest);
    this->Below10 += other.Below10;
    this->Below20 += other.Below20;
    this->Below30 += other.Below30;
    return *this;
  }
};

//------------------------------------------------------------------------------
// Whether the two angles opposite to an edge sum to more than pi plus a tolerance.

/// How far an opposite-angle sum may exceed pi.
struct AngleTolerance
{
  double Sine = 0.0; ///< The sine of a fixed tolerance.
  double Cosine = 1.0;
  /// FloatPrecision or DoublePrecision for an automatic tolerance, beside a fixed one of 0.
  double Precision = 0.0;
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

  /// These are both times |ap| |aq| |bp| |bq|.
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
  const double atAB = std::max(Dot(quad.B, quad.B), Dot(quad.A, quad.A));
  const double atPQ = std::max(Dot(quad.Q, quad.Q), Dot(quad.P, quad.P));
  return std::sqrt(std::max(atPQ, atAB));
}

/// Whether the angle sum of a quad may really be pi or less, if each coordinate of its points may
/// be off by a unit in its last place. If every point lies at most m from the origin, it moves by
/// at most d = precision * m. A vector of length l rotates by at most asin(2 d / l) when its two
/// ends move by d. The sum changes by at most the rotations of the four legs of its angles, and
/// asin is convex and 0 at 0, so that these are together at most
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
