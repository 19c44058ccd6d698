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

/// A point relative to another as expansions of at most N components: 1 where no difference had to
/// be rounded, as on lattices and for most single-precision input, else 2.
template <int N>
struct ExactOffset
{
  Expansion<N> U, V;
  Expansion<N> W, WSum; ///< w - w0 and w + w0, for the lift of tilted planes.

  DELAUNAYFLIP_HOST_DEVICE bool IsSingle() const
  {
    return this->U.Size <= 1 && this->V.Size <= 1 && this->W.Size <= 1 && this->WSum.Size <= 1;
  }

  /// The same with room for fewer components, which must be enough.
  DELAUNAYFLIP_HOST_DEVICE ExactOffset<1> ToSingle() const
  {
    return { { { this->U.Components[0] }, this->U.Size },
      { { this->V.Components[0] }, this->V.Size }, { { this->W.Components[0] }, this->W.Size },
      { { this->WSum.Components[0] }, this->WSum.Size } };
  }

  /// u^2 + v^2 + (w - w0) (w + w0); the last term is 0 where w is.
  DELAUNAYFLIP_HOST_DEVICE Expansion<6 * N * N> GetLift() const
  {
    return Add(
      Add(Multiply(this->U, this->U), Multiply(this->V, this->V)), Multiply(this->W, this->WSum));
  }
};

DELAUNAYFLIP_HOST_DEVICE inline ExactOffset<2> OffsetOf(
  const PlanePoint& p, const PlanePoint& origin)
{
  return { DifferenceOf(p.U, origin.U), DifferenceOf(p.V, origin.V), DifferenceOf(p.W, origin.W),
    SumOf(p.W, origin.W) };
}

/// u1 v2 - u2 v1.
template <int N>
DELAUNAYFLIP_HOST_DEVICE Expansion<4 * N * N> MinorOf(
  const ExactOffset<N>& first, const ExactOffset<N>& second)
{
  return Determinant(first.U, first.V, second.U, second.V);
}

template <int N>
DELAUNAYFLIP_HOST_DEVICE int InCircleSign(
  const ExactOffset<N>& a, const ExactOffset<N>& b, const ExactOffset<N>& c)
{
  return Add(Add(Multiply(MinorOf(b, c), a.GetLift()), Multiply(MinorOf(c, a), b.GetLift())),
    Multiply(MinorOf(a, b), c.GetLift()))
    .Sign();
}

/// Sign of the in-circle determinant of scaled points.
DELAUNAYFLIP_HOST_DEVICE inline int ExpandedInCircle(const PlanePoint (&points)[4])
{
  const ExactOffset<2> a = OffsetOf(points[0], points[3]);
  const ExactOffset<2> b = OffsetOf(points[1], points[3]);
  const ExactOffset<2> c = OffsetOf(points[2], points[3]);
  return a.IsSingle() && b.IsSingle() && c.IsSingle()
    ? InCircleSign(a.ToSingle(), b.ToSingle(), c.ToSingle())
    : InCircleSign(a, b, c);
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
  return MinorOf(
    OffsetOf(scaled.Points[0], scaled.Points[2]), OffsetOf(scaled.Points[1], scaled.Points[2]))
    .Sign();
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
