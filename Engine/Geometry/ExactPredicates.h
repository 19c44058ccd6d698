// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXACTPREDICATES_H
#define DELAUNAYFLIP_EXACTPREDICATES_H

#include "FilteredPredicates.h"
#include "HostDevice.h"

#include <cstdint>
#include <cstring>

/// @file
/// Exact signs: by fixed-point integers if coordinates are below 2^125 in units of their lowest
/// bit, as for nearly all quads; else by integers of any width.

namespace delaunayflip
{

//------------------------------------------------------------------------------
// Doubles as integers times a common power of two, and the sums and products of such integers in
// up to 512 bits. Everything has a fixed size and fits the registers of a GPU: no loops, no
// arrays.

__extension__ typedef __int128 Integer128; // NOLINT(modernize-use-using)
__extension__ typedef unsigned __int128 Unsigned128; // NOLINT(modernize-use-using)

/// High * 2^128 + Low.
struct Unsigned256
{
  Unsigned128 High, Low;
};

/// High * 2^128 + Low, in two's complement.
struct Integer256
{
  Integer128 High;
  Unsigned128 Low;
};

/// High * 2^256 + Low, in two's complement.
struct Integer512
{
  Integer256 High;
  Unsigned256 Low;
};

DELAUNAYFLIP_HOST_DEVICE inline Integer256 operator+(const Integer256& a, const Integer256& b)
{
  const Unsigned128 low = a.Low + b.Low;
  const auto carry = Integer128(low < a.Low);
  return { a.High + b.High + carry, low };
}

DELAUNAYFLIP_HOST_DEVICE inline Integer256 operator-(const Integer256& a, const Integer256& b)
{
  const auto borrow = Integer128(a.Low < b.Low);
  return { a.High - b.High - borrow, a.Low - b.Low };
}

DELAUNAYFLIP_HOST_DEVICE inline Integer512 operator+(const Integer512& a, const Integer512& b)
{
  const Unsigned128 low = a.Low.Low + b.Low.Low;
  const auto lowCarry = Unsigned128(low < a.Low.Low);
  // At most one of the two additions wraps: the first leaves at most 2^128 - 2 when it does.
  const Unsigned128 partial = a.Low.High + b.Low.High;
  const Unsigned128 middle = partial + lowCarry;
  const auto carry = Unsigned128(partial < a.Low.High || middle < partial);
  return { a.High + b.High + Integer256{ 0, carry }, { middle, low } };
}

DELAUNAYFLIP_HOST_DEVICE inline int SignOf(Integer128 value)
{
  return int(value > 0) - int(value < 0);
}

DELAUNAYFLIP_HOST_DEVICE inline int SignOf(const Integer256& value)
{
  if (value.High < 0)
  {
    return -1;
  }
  return int((value.High | static_cast<Integer128>(value.Low)) != 0);
}

DELAUNAYFLIP_HOST_DEVICE inline int SignOf(const Integer512& value)
{
  const int high = SignOf(value.High);
  if (high != 0)
  {
    return high;
  }
  return int((value.Low.High | value.Low.Low) != 0);
}

DELAUNAYFLIP_HOST_DEVICE inline Integer128 Multiply(std::int64_t a, std::int64_t b)
{
  return Integer128(a) * b;
}

/// -2^126 <= a, b < 2^126: the high halves are from -2^62 to 2^62 - 1, so that the middle, two
/// products and what the low one carries, stays between -2^127 and 2^127.
DELAUNAYFLIP_HOST_DEVICE inline Integer256 Multiply(Integer128 a, Integer128 b)
{
  const auto aHigh = static_cast<std::int64_t>(a >> 64);
  const auto bHigh = static_cast<std::int64_t>(b >> 64);
  const auto aLow = static_cast<std::uint64_t>(a);
  const auto bLow = static_cast<std::uint64_t>(b);
  const Unsigned128 low = Unsigned128(aLow) * bLow;
  const Integer128 middle = Integer128(aHigh) * Integer128(bLow) +
    Integer128(bHigh) * Integer128(aLow) + static_cast<Integer128>(low >> 64);
  return { Integer128(aHigh) * bHigh + (middle >> 64),
    (static_cast<Unsigned128>(middle) << 64) | static_cast<std::uint64_t>(low) };
}

/// For any a and b: a sum of two numbers below 2^64 and a product of two such numbers is below
/// 2^128.
DELAUNAYFLIP_HOST_DEVICE inline Unsigned256 MultiplyUnsigned(Unsigned128 a, Unsigned128 b)
{
  const auto aHigh = static_cast<std::uint64_t>(a >> 64);
  const auto bHigh = static_cast<std::uint64_t>(b >> 64);
  const auto aLow = static_cast<std::uint64_t>(a);
  const auto bLow = static_cast<std::uint64_t>(b);
  const Unsigned128 low = Unsigned128(aLow) * bLow;
  const Unsigned128 first = Unsigned128(aHigh) * bLow + (low >> 64);
  const Unsigned128 second = Unsigned128(bHigh) * aLow + static_cast<std::uint64_t>(first);
  return { Unsigned128(aHigh) * bHigh + (first >> 64) + (second >> 64),
    (second << 64) | static_cast<std::uint64_t>(low) };
}

/// For any a and b. The bits of a negative a, read as unsigned, are 2^128 too many.
DELAUNAYFLIP_HOST_DEVICE inline Integer256 MultiplyMixed(Integer128 a, Unsigned128 b)
{
  Unsigned256 product = MultiplyUnsigned(static_cast<Unsigned128>(a), b);
  if (a < 0)
  {
    product.High -= b;
  }
  return { static_cast<Integer128>(product.High), product.Low };
}

/// -2^254 <= a, b < 2^254: as for 128 bits, the high halves suit Multiply and the middle stays
/// between -2^255 and 2^255.
DELAUNAYFLIP_HOST_DEVICE inline Integer512 Multiply(const Integer256& a, const Integer256& b)
{
  const Unsigned256 low = MultiplyUnsigned(a.Low, b.Low);
  const Integer256 middle =
    MultiplyMixed(a.High, b.Low) + MultiplyMixed(b.High, a.Low) + Integer256{ 0, low.High };
  // middle.High goes up with its sign.
  const Integer128 sign = -Integer128(middle.High < 0);
  const Integer256 carried = { sign, static_cast<Unsigned128>(middle.High) };
  return { Multiply(a.High, b.High) + carried, { middle.Low, low.Low } };
}

/// Converts a number to an integer with twice as many bits.
DELAUNAYFLIP_HOST_DEVICE inline Integer128 Widen(std::int64_t a) { return a; }

DELAUNAYFLIP_HOST_DEVICE inline Integer256 Widen(Integer128 a)
{
  return { -Integer128(a < 0), static_cast<Unsigned128>(a) };
}

/// A finite double taken apart: +-Mantissa * 2^Exponent. Zero is 0 * 2^-1074.
struct DoubleParts
{
  static constexpr int MantissaBits = 53;

  std::uint64_t Mantissa;
  int Exponent;
  bool Negative;

  DELAUNAYFLIP_HOST_DEVICE explicit DoubleParts(double value)
  {
    constexpr std::uint64_t HiddenBit = std::uint64_t(1) << (MantissaBits - 1);
    constexpr int Bias = 1075;
    const std::uint64_t bits = GetBits(value);
    const int biased = static_cast<int>(bits >> (MantissaBits - 1)) & 0x7FF;
    this->Mantissa = bits & (HiddenBit - 1);
    this->Exponent = biased - Bias;
    this->Negative = (bits >> 63) != 0;
    if (biased == 0)
    {
      this->Exponent = 1 - Bias; // zero and subnormal numbers have that of the smallest normal ones
    }
    else
    {
      this->Mantissa |= HiddenBit;
    }
  }

  DELAUNAYFLIP_HOST_DEVICE int CountTrailingZeros() const
  {
    const std::uint64_t stop = this->Mantissa | (std::uint64_t(1) << 63);
#if defined(__CUDA_ARCH__)
    return __ffsll(static_cast<long long>(stop)) - 1;
#else
    return __builtin_ctzll(stop);
#endif
  }

private:
  DELAUNAYFLIP_HOST_DEVICE static std::uint64_t GetBits(double value)
  {
#if defined(__CUDA_ARCH__)
    return static_cast<std::uint64_t>(__double_as_longlong(value));
#else
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
#endif
  }
};

/// The largest power of two of which all included doubles are multiples.
class FixedPointUnit
{
public:
  /// Finds the unit of the coordinates of points, W too if `tilted`.
  template <typename... Points>
  DELAUNAYFLIP_HOST_DEVICE explicit FixedPointUnit(bool tilted, const Points&... points)
  {
    ((this->Include(points.U), this->Include(points.V)), ...);
    if (tilted)
    {
      (this->Include(points.W), ...);
    }
  }

  DELAUNAYFLIP_HOST_DEVICE void Include(double value)
  {
    const DoubleParts parts(value);
    const int lastBit = parts.Exponent + parts.CountTrailingZeros();
    const bool isLower = parts.Mantissa != 0 && lastBit < this->Exponent;
    this->Exponent = isLower ? lastBit : this->Exponent;
  }

  /// An included value in units, if that is below 2^125 in magnitude; otherwise clears `fits`.
  DELAUNAYFLIP_HOST_DEVICE Integer128 Convert(double value, bool& fits) const
  {
    constexpr int LargestShift = 125 - DoubleParts::MantissaBits;
    const DoubleParts parts(value);
    const int shift = parts.Exponent - this->Exponent;
    const bool inRange = shift <= LargestShift;
    fits = fits && inRange;
    // Selections instead of branches, which would be mispredicted. A shift to the right loses only
    // zeros, because the value is a multiple of the unit. The mask is for zero itself, since its
    // exponent may be lower by any amount.
    const int down = shift < 0 ? -shift & 63 : 0;
    const int up = shift > 0 && inRange ? shift : 0;
    const auto magnitude = static_cast<Integer128>(Unsigned128(parts.Mantissa >> down) << up);
    return parts.Negative ? -magnitude : magnitude;
  }

private:
  int Exponent = 1024; ///< More than any double has.
};

//------------------------------------------------------------------------------

/// Wide-integer signs, for any finite coordinates; on the CPU only.
int WideOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
int WideInCircle(const PlanePoint (&points)[4], bool tilted);
int WideOrientation3D(const PlanePoint (&points)[4]);

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
      Tilted(tilted),
      W(this->ConvertW(origin))
  {
  }

  DELAUNAYFLIP_HOST_DEVICE FixedPointOffset<Integer> OffsetOf(const PlanePoint& p)
  {
    const Integer128 w = this->ConvertW(p);
    return { this->Narrow(this->Unit.Convert(p.U, this->Fits) - this->U),
      this->Narrow(this->Unit.Convert(p.V, this->Fits) - this->V), this->Narrow(w - this->W),
      this->Narrow(w + this->W) };
  }

  /// Like OffsetOf, but without WSum, which is not needed and may not fit.
  DELAUNAYFLIP_HOST_DEVICE FixedPointOffset<Integer> OffsetInSpace(const PlanePoint& p)
  {
    return { this->Narrow(this->Unit.Convert(p.U, this->Fits) - this->U),
      this->Narrow(this->Unit.Convert(p.V, this->Fits) - this->V),
      this->Narrow(this->ConvertW(p) - this->W), Integer(0) };
  }

  DELAUNAYFLIP_HOST_DEVICE bool AllFit() const { return this->Fits; }

private:
  /// W of a point in units; 0 if it does not belong to the lift.
  DELAUNAYFLIP_HOST_DEVICE Integer128 ConvertW(const PlanePoint& p)
  {
    if (!this->Tilted)
    {
      return 0;
    }
    return this->Unit.Convert(p.W, this->Fits);
  }

  DELAUNAYFLIP_HOST_DEVICE Integer Narrow(Integer128 value)
  {
    constexpr Integer128 Largest = Integer128(1) << (8 * sizeof(Integer) - 2);
    this->Fits = this->Fits && -Largest <= value && value <= Largest;
    return static_cast<Integer>(value);
  }

  bool Fits = true;
  const FixedPointUnit Unit;
  const Integer128 U, V;
  const bool Tilted;
  const Integer128 W;
};

/// The orientation of a, b, c in (u, v), or UncertainSign if they do not fit. Here and below points
/// are passed by value, because compilers for GPUs store what a call refers to in memory.
///
/// Multiply accepts offsets below 2^126; the difference of their products is below 2^253.
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE inline int FixedPointOrientation(
  PlanePoint a, PlanePoint b, PlanePoint c)
{
  const FixedPointUnit unit(false, a, b, c);
  FixedPointFrame<Integer128> frame(unit, c, false);
  const auto first = frame.OffsetOf(a);
  const auto second = frame.OffsetOf(b);
  if (!frame.AllFit())
  {
    return UncertainSign;
  }
  return SignOf(MinorOf(first, second));
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
  const FixedPointUnit unit(tilted, a, b, c, d);
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
  if (sign != UncertainSign)
  {
    return sign;
  }
  return FixedPointInCircleIn<Integer128>(points[0], points[1], points[2], points[3], tilted);
}

/// Sign of the determinant with rows a - d, b - d and c - d, or UncertainSign where their offsets
/// do not fit Integer.
///
/// If offsets are at most 2^k, minors are at most 2^(2k + 1), the products of a minor and an offset
/// 2^(3k + 1), and the sum of three products is less than 2^(3k + 3). 64-bit offsets have k = 62:
/// minors of at most 2^125 are in the range of Multiply, and sums below 2^189 fit 256 bits. 128-bit
/// offsets have k = 126: minors are at most 2^253, and sums below 2^381 fit 512 bits.
template <typename Integer>
DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_NO_INLINE int FixedPointOrientation3DIn(
  PlanePoint a, PlanePoint b, PlanePoint c, PlanePoint d)
{
  const FixedPointUnit unit(true, a, b, c, d);
  FixedPointFrame<Integer> frame(unit, d, true);
  const auto first = frame.OffsetInSpace(a);
  const auto second = frame.OffsetInSpace(b);
  const auto third = frame.OffsetInSpace(c);
  if (!frame.AllFit())
  {
    return UncertainSign;
  }
  const auto firstTerm = Multiply(MinorOf(second, third), Widen(first.W));
  const auto secondTerm = Multiply(MinorOf(third, first), Widen(second.W));
  const auto thirdTerm = Multiply(MinorOf(first, second), Widen(third.W));
  return SignOf(firstTerm + secondTerm + thirdTerm);
}

/// Computes with 64 bits if the offsets fit, else with 128; UncertainSign if neither suffices.
DELAUNAYFLIP_HOST_DEVICE inline int FixedPointOrientation3D(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const int sign = FixedPointOrientation3DIn<std::int64_t>(a, b, c, d);
  if (sign != UncertainSign)
  {
    return sign;
  }
  return FixedPointOrientation3DIn<Integer128>(a, b, c, d);
}

/// Orientation of a, b, c in (u, v). UncertainSign only on a device, where wide integers are
/// needed.
DELAUNAYFLIP_HOST_DEVICE inline int ExactOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FixedPointOrientation(a, b, c);
#if !defined(__CUDA_ARCH__)
  if (sign == UncertainSign)
  {
    return WideOrientation(a, b, c);
  }
#endif
  return sign;
}

/// Sign of the in-circle determinant; `tilted` adds W to the lift. UncertainSign as above.
DELAUNAYFLIP_HOST_DEVICE inline int ExactInCircle(const PlanePoint (&points)[4], bool tilted)
{
  const int sign = FixedPointInCircle(points, tilted);
#if !defined(__CUDA_ARCH__)
  if (sign == UncertainSign)
  {
    return WideInCircle(points, tilted);
  }
#endif
  return sign;
}

/// Sign of the determinant with rows a - d, b - d and c - d. UncertainSign as for ExactOrientation.
DELAUNAYFLIP_HOST_DEVICE inline int ExactOrientation3D(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const int sign = FixedPointOrientation3D(a, b, c, d);
#if !defined(__CUDA_ARCH__)
  if (sign == UncertainSign)
  {
    return WideOrientation3D({ a, b, c, d });
  }
#endif
  return sign;
}

/// Orientation of a, b, c in (u, v), filtered, then exact: for coordinates of any size.
/// UncertainSign only on a device.
DELAUNAYFLIP_HOST_DEVICE inline int FindOrientation(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const int sign = FilteredOrientation(a, b, c);
  const bool certain =
    sign != UncertainSign && IsInFilterRange(a) && IsInFilterRange(b) && IsInFilterRange(c);
  if (certain)
  {
    return sign;
  }
  return ExactOrientation(a, b, c);
}

/// Sign of the determinant with rows a - d, b - d and c - d, in the same way as FindOrientation.
DELAUNAYFLIP_HOST_DEVICE inline int FindOrientation3D(
  const PlanePoint& a, const PlanePoint& b, const PlanePoint& c, const PlanePoint& d)
{
  const int sign = FilteredOrientation3D(a, b, c, d);
  const bool certain = sign != UncertainSign && IsInFilterRange3D(a) && IsInFilterRange3D(b) &&
    IsInFilterRange3D(c) && IsInFilterRange3D(d);
  if (certain)
  {
    return sign;
  }
  return ExactOrientation3D(a, b, c, d);
}

}

#endif
