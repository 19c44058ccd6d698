// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTPREDICATES_H
#define DELAUNAYFLIP_EXACTPREDICATES_H

#include "FilteredPredicates.h"
#include "FixedPoint.h"

/// @file
/// Exact signs: by fixed-point integers if coordinates are below 2^125 in units of their lowest
/// bit, as for nearly all quads; else by integers of any width.

namespace delaunayflip
{

/// Wide-integer signs, for any finite coordinates; on the CPU only.
int WideOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
int WideInCircle(const PlanePoint (&points)[4], bool tilted);

/// A point relative to an origin, in units. Lifts and minors are integers of twice the width.
template <typename Integer>
struct FixedPointOffset
{
  Integer U, V;
  Integer W, WSum; ///< w - w0 and w + w0, for the lift of tilted planes; else 0.

  /// u^2 + v^2 + (w - w0) (w + w0).
  DELAUNAYFLIP_HOST_DEVICE auto GetLift() const
  {
    return Multiply(this->U, this->U) + Multiply(this->V, this->V) + Multiply(this->W, this->WSum);
  }
};

/// u1 v2 - u2 v1.
template <typename Integer>
DELAUNAYFLIP_HOST_DEVICE auto MinorOf(
  const FixedPointOffset<Integer>& first, const FixedPointOffset<Integer>& second)
{
  return Multiply(first.U, second.V) - Multiply(second.U, first.V);
}

DELAUNAYFLIP_HOST_DEVICE inline void IncludePoint(
  FixedPointUnit& unit, const PlanePoint& p, bool tilted)
{
  unit.Include(p.U);
  unit.Include(p.V);
  unit.Include(tilted ? p.W : 0.0);
}

/// Makes offsets from one origin, and remembers whether all of them fit. 64 bits hold offsets of at
/// most 2^62. 128 bits hold those of all coordinates that convert: below 2^125, their differences
/// and sums are below 2^126.
template <typename Integer>
class FixedPointFrame
{
public:
  DELAUNAYFLIP_HOST_DEVICE FixedPointFrame(
    const FixedPointUnit& unit, const PlanePoint& origin, bool tilted)
    : Unit(unit),
      U(unit.Convert(origin.U, this->Fits)),
      V(unit.Convert(origin.V, this->Fits)),
      W(tilted ? unit.Convert(origin.W, this->Fits) : 0),
      Tilted(tilted)
  {
  }

  DELAUNAYFLIP_HOST_DEVICE FixedPointOffset<Integer> OffsetOf(const PlanePoint& p)
  {
    const Integer128 w = this->Tilted ? this->Unit.Convert(p.W, this->Fits) : 0;
    return { this->Narrow(this->Unit.Convert(p.U, this->Fits) - this->U),
      this->Narrow(this->Unit.Convert(p.V, this->Fits) - this->V), this->Narrow(w - this->W),
      this->Narrow(w + this->W) };
  }

  DELAUNAYFLIP_HOST_DEVICE bool AllFit() const { return this->Fits; }

private:
  DELAUNAYFLIP_HOST_DEVICE Integer Narrow(Integer128 value)
  {
    constexpr Integer128 Largest = Integer128(1) << (8 * sizeof(Integer) - 2);
    this->Fits = this->Fits && -Largest <= value && value <= Largest;
    return static_cast<Integer>(value);
  }

  bool Fits = true;
  const FixedPointUnit Unit;
  const Integer128 U, V, W;
  const bool Tilted;
};

/// The turn of a, b, c in (u, v), or UncertainSign if they do not fit. Here and below points are
/// passed by value, because compilers for GPUs store what a call refers to in memory.
///
/// Multiply accepts offsets below 2^126; the difference of their products is below 2^253.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline int FixedPointOrientation(
  PlanePoint a, PlanePoint b, PlanePoint c)
{
  FixedPointUnit unit;
  IncludePoint(unit, a, false);
  IncludePoint(unit, b, false);
  IncludePoint(unit, c, false);
  FixedPointFrame<Integer128> frame(unit, c, false);
  const auto first = frame.OffsetOf(a);
  const auto second = frame.OffsetOf(b);
  return frame.AllFit() ? SignOf(MinorOf(first, second)) : UncertainSign;
}

/// Sign of the in-circle determinant of a, b, c, d, or UncertainSign where their offsets do not fit
/// Integer; `tilted` adds W to the lift.
///
/// With offsets of at most 2^k, products of two are at most 2^2k, minors 2^(2k + 1), lifts
/// 3 * 2^2k < 2^(2k + 2), products of these less than 2^(4k + 3), the sum of three less than
/// 2^(4k + 5). 64 bits, k = 62: lifts are below 2^126, as Multiply takes them, and the sum is below
/// 2^253, in 256 bits. 128 bits, k = 126: lifts are below 2^254, and the sum is below 2^509, in
/// 512.
template <typename Integer>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE int FixedPointInCircleIn(
  PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d, bool tilted)
{
  FixedPointUnit unit;
  IncludePoint(unit, a, tilted);
  IncludePoint(unit, b, tilted);
  IncludePoint(unit, c, tilted);
  IncludePoint(unit, d, tilted);
  FixedPointFrame<Integer> frame(unit, d, tilted);
  const auto first = frame.OffsetOf(a);
  const auto second = frame.OffsetOf(b);
  const auto third = frame.OffsetOf(c);
  if (!frame.AllFit())
  {
    return UncertainSign;
  }
  const auto firstTerm = Multiply(MinorOf(second, third), first.GetLift());
  const auto secondTerm = Multiply(MinorOf(third, first), second.GetLift());
  const auto thirdTerm = Multiply(MinorOf(first, second), third.GetLift());
  return SignOf(firstTerm + secondTerm + thirdTerm);
}

/// Computes with 64 bits if the offsets fit, which takes a third of the time, else with 128;
/// UncertainSign if neither suffices.
DELAUNAYFLIP_HOST_DEVICE inline int FixedPointInCircle(const PlanePoint (&points)[4], bool tilted)
{
  const int sign =
    FixedPointInCircleIn<std::int64_t>(points[0], points[1], points[2], points[3], tilted);
  return sign != UncertainSign
    ? sign
    : FixedPointInCircleIn<Integer128>(points[0], points[1], points[2], points[3], tilted);
}

/// Turn of a, b, c in (u, v). UncertainSign only on a device, where wide integers are needed.
DELAUNAYFLIP_HOST_DEVICE inline int ExactOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FixedPointOrientation(a, b, c);
#if defined(__CUDA_ARCH__)
  return sign;
#else
  return sign != UncertainSign ? sign : WideOrientation(a, b, c);
#endif
}

/// Sign of the in-circle determinant; `tilted` adds W to the lift. UncertainSign as above.
DELAUNAYFLIP_HOST_DEVICE inline int ExactInCircle(const PlanePoint (&points)[4], bool tilted)
{
  const int sign = FixedPointInCircle(points, tilted);
#if defined(__CUDA_ARCH__)
  return sign;
#else
  return sign != UncertainSign ? sign : WideInCircle(points, tilted);
#endif
}

/// Turn of a, b, c in (u, v), filtered, then exact: for coordinates of any size. UncertainSign only
/// on a device.
DELAUNAYFLIP_HOST_DEVICE inline int FindOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FilteredOrientation(a, b, c);
  const bool certain =
    sign != UncertainSign && IsInFilterRange(a) && IsInFilterRange(b) && IsInFilterRange(c);
  return certain ? sign : ExactOrientation(a, b, c);
}

}

#endif
