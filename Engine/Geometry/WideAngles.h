// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_WIDEANGLES_H
#define DELAUNAYFLIP_WIDEANGLES_H

#include "HostDevice.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// @file
/// The judgements of SurfaceAngles.h for all finite coordinates, even where
/// products of lengths would overflow or vanish: every vector has a power of two of its own. These
/// are slow, and meant for the few meshes and quads that need them.

namespace delaunayflip
{

/// How large the coordinates of a mesh are, and so which of its quads need this file.
enum class CoordinateRange : std::uint8_t
{
  Usual, ///< The largest is usual, and all are at least 2^-100 or 0.
  Mixed, ///< The largest is usual, others are smaller: quads with tiny differences need it.
  Extreme, ///< Products of lengths may overflow or vanish everywhere: all quads need it.
};

/// Whether a vector has a component so small that products of four such may vanish. Components
/// that are 0 cannot vanish.
DELAUNAYFLIP_HOST_DEVICE inline bool HasTinyComponent(const Vector3& a)
{
  // A component of a cross product of larger ones is 0 or at least 2^-353, because the smallest
  // difference of two products is an ulp of them; and products of two of these are normal numbers.
  constexpr double Tiny = 0x1p-150;
  const auto isTiny = [](double x) { return x != 0.0 && std::fabs(x) < Tiny; };
  return isTiny(a.X) || isTiny(a.Y) || isTiny(a.Z);
}

/// Whether a triangle of a mesh with such coordinates needs this file.
DELAUNAYFLIP_HOST_DEVICE inline bool IsWide(
  CoordinateRange range, const Vector3& a, const Vector3& b, const Vector3& c)
{
  return range == CoordinateRange::Extreme ||
    (range == CoordinateRange::Mixed &&
      (HasTinyComponent(b - a) || HasTinyComponent(c - a) || HasTinyComponent(c - b)));
}

/// Whether a quad does.
DELAUNAYFLIP_HOST_DEVICE inline bool IsWide(CoordinateRange range, const QuadPoints& quad)
{
  return range == CoordinateRange::Extreme ||
    (range == CoordinateRange::Mixed &&
      (HasTinyComponent(quad.P - quad.A) || HasTinyComponent(quad.Q - quad.A) ||
        HasTinyComponent(quad.P - quad.B) || HasTinyComponent(quad.Q - quad.B) ||
        HasTinyComponent(quad.B - quad.A)));
}

DELAUNAYFLIP_HOST_DEVICE inline Vector3 operator*(double factor, const Vector3& a)
{
  return { factor * a.X, factor * a.Y, factor * a.Z };
}

DELAUNAYFLIP_HOST_DEVICE inline double LargestComponent(const Vector3& a)
{
  const double xOrY = std::max(std::fabs(a.Y), std::fabs(a.X));
  return std::max(std::fabs(a.Z), xOrY);
}

DELAUNAYFLIP_HOST_DEVICE inline bool IsFinite(const Vector3& a)
{
  return std::fabs(a.X) < INFINITY && std::fabs(a.Y) < INFINITY && std::fabs(a.Z) < INFINITY;
}

/// A vector times 2^Exponent. The largest component of the vector is from 1 to 2; it is 0 if the
/// vector has no length.
struct WideVector
{
  Vector3 Vector;
  int Exponent;

  DELAUNAYFLIP_HOST_DEVICE double GetLength() const { return Length(this->Vector); }
};

/// A vector times 2^exponent. A component may be too small for its new size. It is rounded only
/// once, so that the result is the same for a vector of twice the length. A vector that is not
/// finite stays as it is.
DELAUNAYFLIP_HOST_DEVICE inline WideVector MakeWide(const Vector3& vector, int exponent = 0)
{
  const double largest = LargestComponent(vector);
  if (!(largest > 0.0 && largest < INFINITY))
  {
    return { vector, 0 };
  }
  const int own = std::ilogb(largest);
  return { { std::scalbn(vector.X, -own), std::scalbn(vector.Y, -own),
             std::scalbn(vector.Z, -own) },
    exponent + own };
}

/// b - a. The difference of two finite numbers may be infinite, that of their halves may not.
DELAUNAYFLIP_HOST_DEVICE inline WideVector Subtract(const Vector3& b, const Vector3& a)
{
  const Vector3 difference = b - a;
  if (LargestComponent(difference) < INFINITY)
  {
    return MakeWide(difference);
  }
  return MakeWide(0.5 * b - 0.5 * a, 1);
}

DELAUNAYFLIP_HOST_DEVICE inline WideVector Cross(const WideVector& a, const WideVector& b)
{
  return MakeWide(Cross(a.Vector, b.Vector), a.Exponent + b.Exponent);
}

/// a + b, if a has an exponent at least as large as that of b, or b is 0.
DELAUNAYFLIP_HOST_DEVICE inline WideVector AddToLonger(const WideVector& a, const WideVector& b)
{
  const double factor = std::scalbn(1.0, b.Exponent - a.Exponent);
  return MakeWide(a.Vector + factor * b.Vector, a.Exponent);
}

DELAUNAYFLIP_HOST_DEVICE inline WideVector Add(const WideVector& a, const WideVector& b)
{
  const bool isLonger = a.Exponent > b.Exponent || !(LargestComponent(b.Vector) > 0.0);
  if (isLonger && LargestComponent(a.Vector) > 0.0)
  {
    return AddToLonger(a, b);
  }
  return AddToLonger(b, a);
}

/// Normal of triangle a, b, c; its length is twice the area.
DELAUNAYFLIP_HOST_DEVICE inline WideVector WideAreaVector(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  return Cross(Subtract(b, a), Subtract(c, a));
}

/// The legs of the angles opposite to an edge.
struct WideLegs
{
  DELAUNAYFLIP_HOST_DEVICE explicit WideLegs(const QuadPoints& quad)
    : AP(Subtract(quad.P, quad.A)),
      AQ(Subtract(quad.Q, quad.A)),
      BP(Subtract(quad.P, quad.B)),
      BQ(Subtract(quad.Q, quad.B))
  {
  }

  WideVector AP, AQ, BP, BQ;
};

/// The sum of the angles, whatever the lengths of the legs.
DELAUNAYFLIP_HOST_DEVICE inline AngleSum SumWide(const WideLegs& legs)
{
  const WideVector atA = Cross(legs.AP, legs.AQ), atB = Cross(legs.BP, legs.BQ);
  const int exponentA = atA.Exponent - legs.AP.Exponent - legs.AQ.Exponent;
  const int exponentB = atB.Exponent - legs.BP.Exponent - legs.BQ.Exponent;
  return AngleSum(Dot(legs.AP.Vector, legs.AQ.Vector), std::scalbn(atA.GetLength(), exponentA),
    Dot(legs.BP.Vector, legs.BQ.Vector), std::scalbn(atB.GetLength(), exponentB));
}

/// The length of a divided by that of b.
DELAUNAYFLIP_HOST_DEVICE inline double DivideLengths(const WideVector& a, const WideVector& b)
{
  return std::scalbn(a.GetLength() / b.GetLength(), a.Exponent - b.Exponent);
}

DELAUNAYFLIP_HOST_DEVICE inline WideVector FindLonger(const WideVector& a, const WideVector& b)
{
  if (DivideLengths(a, b) > 1.0)
  {
    return a;
  }
  return b;
}

/// IsNoise, for SumWide.
DELAUNAYFLIP_HOST_DEVICE inline bool IsWideNoise(
  const QuadPoints& quad, const WideLegs& legs, double precision, double excess)
{
  constexpr double Rounding = 0x1p-47;
  const WideVector farthest = FindLonger(
    FindLonger(MakeWide(quad.A), MakeWide(quad.B)), FindLonger(MakeWide(quad.P), MakeWide(quad.Q)));
  const double reciprocals = DivideLengths(farthest, legs.AP) + DivideLengths(farthest, legs.AQ) +
    DivideLengths(farthest, legs.BP) + DivideLengths(farthest, legs.BQ);
  const double noise = 2.0 * precision * reciprocals + Rounding;
  const double product =
    legs.AP.GetLength() * legs.AQ.GetLength() * legs.BP.GetLength() * legs.BQ.GetLength();
  return !(noise < 1.0 && noise * product < excess);
}

/// Whether the angles sum to more than pi and the tolerance.
DELAUNAYFLIP_HOST_DEVICE inline bool ExceedsPiWide(
  const QuadPoints& quad, const AngleTolerance& tolerance)
{
  const WideLegs legs(quad);
  const AngleSum sum = SumWide(legs);
  return sum.ExceedsPi(tolerance) &&
    !(tolerance.Precision > 0.0 && IsWideNoise(quad, legs, tolerance.Precision, sum.GetExcess()));
}

/// FoldsOver of SurfaceAngles.h.
DELAUNAYFLIP_HOST_DEVICE inline bool FoldsOverWide(const QuadPoints& quad)
{
  const Vector3 area =
    Add(WideAreaVector(quad.A, quad.P, quad.Q), WideAreaVector(quad.B, quad.Q, quad.P)).Vector;
  return !(Dot(WideAreaVector(quad.A, quad.P, quad.B).Vector, area) > 0.0 &&
    Dot(WideAreaVector(quad.B, quad.Q, quad.A).Vector, area) > 0.0);
}

/// Whether flipping p-q to a-b moves the surface by more than a length: the distance between the
/// lines of p-q and a-b. If the flip does not fold the surface over, the two edges cross as seen
/// along their common normal, which is that of the quad's vector area. Along it the old and the new
/// surface lie one above the other. They are furthest apart at that crossing, by this distance.
DELAUNAYFLIP_HOST_DEVICE inline bool MovesTooFar(const QuadPoints& quad, double maximum)
{
  const WideVector normal = Cross(Subtract(quad.B, quad.A), Subtract(quad.Q, quad.P));
  // Twice a way between the lines. The sum is the same if the two triangles are exchanged.
  const WideVector ways = Add(Subtract(quad.P, quad.A), Subtract(quad.Q, quad.B));
  const double twice = std::fabs(Dot(ways.Vector, normal.Vector)) / normal.GetLength();
  return !(twice <= std::scalbn(maximum, 1 - ways.Exponent));
}

/// IsSharp of SurfaceAngles.h.
DELAUNAYFLIP_HOST_DEVICE inline bool IsSharpWide(const QuadPoints& quad, double cosine)
{
  const Vector3 upper = WideAreaVector(quad.A, quad.P, quad.Q).Vector;
  const Vector3 lower = WideAreaVector(quad.B, quad.Q, quad.P).Vector;
  const double lengths = Length(upper) * Length(lower);
  return lengths > 0.0 && Dot(upper, lower) < cosine * lengths;
}

/// Whether a triangle with finite corners has no area at all.
DELAUNAYFLIP_HOST_DEVICE inline bool HasNoArea(const Vector3& a, const Vector3& b, const Vector3& c)
{
  return Length(AreaVector(a, b, c)) == 0.0 &&
    LargestComponent(WideAreaVector(a, b, c).Vector) == 0.0;
}

/// Moves a triangle with finite corners to the origin, and brings its size near 1, unless its area
/// is a usual number.
DELAUNAYFLIP_HOST_DEVICE inline void BringNearOne(Vector3& a, Vector3& b, Vector3& c)
{
  const double area = Length(AreaVector(a, b, c));
  if (area > 0.0 && area < INFINITY)
  {
    return;
  }
  const WideVector ab = Subtract(b, a), ac = Subtract(c, a);
  const int exponent = std::max(ab.Exponent, ac.Exponent);
  a = {};
  b = std::scalbn(1.0, ab.Exponent - exponent) * ab.Vector;
  c = std::scalbn(1.0, ac.Exponent - exponent) * ac.Vector;
}

/// LargestSquaredCotangent of SurfaceAngles.h.
DELAUNAYFLIP_HOST_DEVICE inline double LargestSquaredCotangentWide(
  const Vector3& a, const Vector3& b, const Vector3& c)
{
  if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c))
  {
    return -INFINITY;
  }
  const WideVector ab = Subtract(b, a), ac = Subtract(c, a), bc = Subtract(c, b);
  const int exponent = std::max(ab.Exponent, ac.Exponent);
  const auto scaled = [exponent](const WideVector& edge)
  { return std::scalbn(1.0, edge.Exponent - exponent) * edge.Vector; };
  const Vector3 x = scaled(ab), y = scaled(ac), z = scaled(bc);
  const Vector3 normal = Cross(x, y);
  return LargestSquaredCotangent(Dot(x, y), -Dot(x, z), Dot(y, z), Dot(normal, normal));
}

}

#endif
