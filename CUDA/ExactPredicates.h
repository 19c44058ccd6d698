// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTPREDICATES_H
#define DELAUNAYFLIP_EXACTPREDICATES_H

#include "FilteredPredicates.h"
#include "FixedPoint.h"

/// @file
/// Signs that are always right: fixed-point integers for points that lie close together compared
/// with their last bits, which nearly all quads do; integers of any width for the others.

namespace delaunayflip
{

/// Wide-integer signs, for any finite coordinates; on the CPU only.
int WideOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
int WideInCircle(const PlanePoint (&points)[4], bool tilted);

/// A point relative to an origin, in units; no member exceeds 2^62 in magnitude.
struct FixedPointOffset
{
  std::int64_t U, V;
  std::int64_t W, WSum; ///< w - w0 and w + w0, for the lift of tilted planes; else 0.

  /// u^2 + v^2 + (w - w0) (w + w0): at most 3 * 2^124.
  DELAUNAYFLIP_HOST_DEVICE Integer128 GetLift() const
  {
    return Integer128(this->U) * this->U + Integer128(this->V) * this->V +
      Integer128(this->W) * this->WSum;
  }
};

/// u1 v2 - u2 v1: at most 2^125.
DELAUNAYFLIP_HOST_DEVICE inline Integer128 MinorOf(
  const FixedPointOffset& first, const FixedPointOffset& second)
{
  return Integer128(first.U) * second.V - Integer128(second.U) * first.V;
}

DELAUNAYFLIP_HOST_DEVICE inline void IncludePoint(
  FixedPointUnit& unit, const PlanePoint& p, bool tilted)
{
  unit.Include(p.U);
  unit.Include(p.V);
  unit.Include(tilted ? p.W : 0.0);
}

/// Makes offsets from one origin, and remembers whether all of them fit.
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

  DELAUNAYFLIP_HOST_DEVICE FixedPointOffset OffsetOf(const PlanePoint& p)
  {
    const Integer128 w = this->Tilted ? this->Unit.Convert(p.W, this->Fits) : 0;
    return { this->Narrow(this->Unit.Convert(p.U, this->Fits) - this->U),
      this->Narrow(this->Unit.Convert(p.V, this->Fits) - this->V), this->Narrow(w - this->W),
      this->Narrow(w + this->W) };
  }

  DELAUNAYFLIP_HOST_DEVICE bool AllFit() const { return this->Fits; }

private:
  DELAUNAYFLIP_HOST_DEVICE std::int64_t Narrow(Integer128 value)
  {
    constexpr Integer128 Largest = Integer128(1) << 62;
    this->Fits = this->Fits && -Largest <= value && value <= Largest;
    return static_cast<std::int64_t>(value);
  }

  bool Fits = true;
  const FixedPointUnit Unit;
  const Integer128 U, V, W;
  const bool Tilted;
};

/// Turn of a, b, c in (u, v), or UncertainSign where they do not fit. Points come by value, here
/// and below, because compilers for GPUs put what a call refers to in memory.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline int FixedPointOrientation(
  PlanePoint a, PlanePoint b, PlanePoint c)
{
  FixedPointUnit unit;
  IncludePoint(unit, a, false);
  IncludePoint(unit, b, false);
  IncludePoint(unit, c, false);
  FixedPointFrame frame(unit, c, false);
  const FixedPointOffset first = frame.OffsetOf(a);
  const FixedPointOffset second = frame.OffsetOf(b);
  if (!frame.AllFit())
  {
    return UncertainSign;
  }
  const Integer128 determinant = MinorOf(first, second);
  return determinant < 0 ? -1 : (determinant > 0 ? 1 : 0);
}

/// Sign of the in-circle determinant of a, b, c, d, or UncertainSign where they do not fit;
/// `tilted` adds W to the lift.
///
/// Offsets of at most 2^62 suffice: minors are at most 2^125 and lifts 3 * 2^124, both below the
/// 2^126 that Multiply takes; a product of the two stays below 2^251, the sum of three below 2^253.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline int FixedPointInCircle(
  PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d, bool tilted)
{
  FixedPointUnit unit;
  IncludePoint(unit, a, tilted);
  IncludePoint(unit, b, tilted);
  IncludePoint(unit, c, tilted);
  IncludePoint(unit, d, tilted);
  FixedPointFrame frame(unit, d, tilted);
  const FixedPointOffset first = frame.OffsetOf(a);
  const FixedPointOffset second = frame.OffsetOf(b);
  const FixedPointOffset third = frame.OffsetOf(c);
  if (!frame.AllFit())
  {
    return UncertainSign;
  }
  const Integer256 firstTerm = Multiply(MinorOf(second, third), first.GetLift());
  const Integer256 secondTerm = Multiply(MinorOf(third, first), second.GetLift());
  const Integer256 thirdTerm = Multiply(MinorOf(first, second), third.GetLift());
  return Add(Add(firstTerm, secondTerm), thirdTerm).Sign();
}

/// The same for points in an array.
DELAUNAYFLIP_HOST_DEVICE inline int FixedPointInCircle(const PlanePoint (&points)[4], bool tilted)
{
  return FixedPointInCircle(points[0], points[1], points[2], points[3], tilted);
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

}

#endif
