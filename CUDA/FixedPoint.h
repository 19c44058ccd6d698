// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FIXEDPOINT_H
#define DELAUNAYFLIP_FIXEDPOINT_H

#include "HostDevice.h"

#include <cstdint>
#include <cstring>

/// @file
/// Doubles as integers times a common power of two, and products of such integers in 256 bits.
/// Everything has a fixed size and fits the registers of a GPU: no loops, no arrays.

namespace delaunayflip
{

__extension__ typedef __int128 Integer128; // NOLINT(modernize-use-using)
__extension__ typedef unsigned __int128 Unsigned128; // NOLINT(modernize-use-using)

/// High * 2^128 + Low, in two's complement.
struct Integer256
{
  Integer128 High;
  Unsigned128 Low;

  DELAUNAYFLIP_HOST_DEVICE int Sign() const
  {
    const int notZero = this->High != 0 || this->Low != 0 ? 1 : 0;
    return this->High < 0 ? -1 : notZero;
  }
};

DELAUNAYFLIP_HOST_DEVICE inline Integer256 Add(const Integer256& a, const Integer256& b)
{
  const Unsigned128 low = a.Low + b.Low;
  const Integer128 carry = low < a.Low ? 1 : 0;
  return { a.High + b.High + carry, low };
}

/// |a|, |b| < 2^126, so that the two middle products together stay below 2^127.
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
    const bool subnormal = biased == 0; // or zero; has the exponent of the smallest normal numbers
    this->Mantissa = (bits & (HiddenBit - 1)) | (subnormal ? 0 : HiddenBit);
    this->Exponent = (subnormal ? 1 : biased) - Bias;
    this->Negative = (bits >> 63) != 0;
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
  DELAUNAYFLIP_HOST_DEVICE void Include(double value)
  {
    const DoubleParts parts(value);
    const int lastBit = parts.Exponent + parts.CountTrailingZeros();
    this->Exponent = parts.Mantissa != 0 && lastBit < this->Exponent ? lastBit : this->Exponent;
  }

  /// An included value in units, below 2^126 in magnitude; what could reach more clears `fits`.
  DELAUNAYFLIP_HOST_DEVICE Integer128 Convert(double value, bool& fits) const
  {
    constexpr int LargestShift = 126 - DoubleParts::MantissaBits;
    const DoubleParts parts(value);
    const int shift = parts.Exponent - this->Exponent;
    const bool inRange = shift <= LargestShift;
    fits = fits && inRange;
    // Down, what falls out is 0, for the value is a multiple. The mask is for zero itself, whose
    // exponent may lie any distance below.
    const int down = shift < 0 ? -shift & 63 : 0;
    const int up = shift > 0 && inRange ? shift : 0;
    const auto magnitude = static_cast<Integer128>(Unsigned128(parts.Mantissa >> down) << up);
    return parts.Negative ? -magnitude : magnitude;
  }

private:
  int Exponent = 1024; ///< More than any double has.
};

}

#endif
