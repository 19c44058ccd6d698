// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTPREDICATES_H
#define DELAUNAYFLIP_EXACTPREDICATES_H

#include "Expansion.h"
#include "FilteredPredicates.h"

/// @file
/// Signs that are always right: expansions for coordinates whose exponents fit degree 4, wide
/// integers for the others.

namespace delaunayflip
{

/// Wide-integer signs, for any finite coordinates; on the CPU only.
int WideOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
int WideInCircle(const PlanePoint (&points)[4], bool tilted);

/// Points moved by an exact power of two to where degree-4 expansions neither overflow nor lose
/// bits. The largest magnitude becomes 2^240 at most; with exponents no further apart than 440 the
/// last bit of the smallest coordinate is 2^-252 at least, and its fourth power is still a double.
template <int Count>
struct ScaledPoints
{
  static constexpr int LargestExponent = 240;
  static constexpr int LargestSpread = 440;

  PlanePoint Points[Count];
  bool Fits = true;

  DELAUNAYFLIP_HOST_DEVICE explicit ScaledPoints(const PlanePoint (&points)[Count])
  {
    double largest = 0.0;
    double smallest = INFINITY;
    for (const PlanePoint& point : points)
    {
      Survey(point.U, largest, smallest);
      Survey(point.V, largest, smallest);
      Survey(point.W, largest, smallest);
    }
    const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
    this->Fits = largest == 0.0 || exponent - std::ilogb(smallest) <= LargestSpread;
    const int shift = LargestExponent - exponent;
    for (int i = 0; i < Count; ++i)
    {
      this->Points[i] = { std::scalbn(points[i].U, shift), std::scalbn(points[i].V, shift),
        std::scalbn(points[i].W, shift) };
    }
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static void Survey(double value, double& largest, double& smallest)
  {
    const double magnitude = std::fabs(value);
    largest = magnitude > largest ? magnitude : largest;
    smallest = magnitude > 0.0 && magnitude < smallest ? magnitude : smallest;
  }
};

/// (u, v) of a point relative to another, exactly.
struct ExactOffset
{
  Expansion<2> U, V;

  DELAUNAYFLIP_HOST_DEVICE ExactOffset(const PlanePoint& p, const PlanePoint& origin)
    : U(DifferenceOf(p.U, origin.U)),
      V(DifferenceOf(p.V, origin.V))
  {
  }
};

/// u^2 + v^2 + (w - w0) (w + w0) of an offset; the last term is 0 where W is.
DELAUNAYFLIP_HOST_DEVICE inline Expansion<24> ExactLift(
  const ExactOffset& offset, const PlanePoint& p, const PlanePoint& origin)
{
  const Expansion<8> w = Multiply(DifferenceOf(p.W, origin.W), SumOf(p.W, origin.W));
  return Add(Add(Multiply(offset.U, offset.U), Multiply(offset.V, offset.V)), w);
}

/// Sign of the in-circle determinant with the lift of ExactLift, of scaled points.
DELAUNAYFLIP_HOST_DEVICE inline int ExpandedInCircle(const PlanePoint (&points)[4])
{
  const PlanePoint& d = points[3];
  const ExactOffset a(points[0], d), b(points[1], d), c(points[2], d);
  const Expansion<768> aTerm =
    Multiply(Determinant(b.U, b.V, c.U, c.V), ExactLift(a, points[0], d));
  const Expansion<768> bTerm =
    Multiply(Determinant(c.U, c.V, a.U, a.V), ExactLift(b, points[1], d));
  const Expansion<768> cTerm =
    Multiply(Determinant(a.U, a.V, b.U, b.V), ExactLift(c, points[2], d));
  return Add(Add(aTerm, bTerm), cTerm).Sign();
}

/// Turn of a, b, c in (u, v). UncertainSign only on a device, where wide integers are needed.
DELAUNAYFLIP_HOST_DEVICE inline int ExactOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const ScaledPoints<3> scaled({ { a.U, a.V, 0.0 }, { b.U, b.V, 0.0 }, { c.U, c.V, 0.0 } });
  if (!scaled.Fits)
  {
#if defined(__CUDA_ARCH__)
    return UncertainSign;
#else
    return WideOrientation(a, b, c);
#endif
  }
  const ExactOffset first(scaled.Points[0], scaled.Points[2]);
  const ExactOffset second(scaled.Points[1], scaled.Points[2]);
  return Determinant(first.U, first.V, second.U, second.V).Sign();
}

/// Sign of the in-circle determinant; `tilted` adds W to the lift. UncertainSign as above.
DELAUNAYFLIP_HOST_DEVICE inline int ExactInCircle(const PlanePoint (&points)[4], bool tilted)
{
  PlanePoint lifted[4];
  for (int i = 0; i < 4; ++i)
  {
    lifted[i] = { points[i].U, points[i].V, tilted ? points[i].W : 0.0 };
  }
  const ScaledPoints<4> scaled(lifted);
  if (!scaled.Fits)
  {
#if defined(__CUDA_ARCH__)
    return UncertainSign;
#else
    return WideInCircle(points, tilted);
#endif
  }
  return ExpandedInCircle(scaled.Points);
}

}

#endif
