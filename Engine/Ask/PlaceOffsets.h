// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACEOFFSETS_H
#define DELAUNAYFLIP_PLACEOFFSETS_H

#include "HostDevice.h"

#include <cmath>
#include <cstdint>
#include <cstring>

/// @file
/// Vectors between places, their scale, and areas that stay right where products nearly cancel.

namespace delaunayflip
{

/// A vector.
struct PlaceOffset
{
  double U, V;
};

/// The length of a vector, by the sum of its components.
DELAUNAYFLIP_HOST_DEVICE inline double FindSize(const PlaceOffset& offset)
{
  return std::fabs(offset.U) + std::fabs(offset.V);
}

/// The power of two by which a number that is not negative comes to be between 1 and 2; the largest
/// one that is finite for the smallest numbers.
DELAUNAYFLIP_HOST_DEVICE inline double InvertPowerOfTwo(double number)
{
  constexpr int MantissaBits = 52;
  constexpr std::uint64_t TwiceTheBias = 2046;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  std::uint64_t exponent = bits >> MantissaBits;
  if (exponent >= TwiceTheBias) // its inverse would be too small to be a normal number
  {
    exponent = TwiceTheBias - 1;
  }
  const std::uint64_t inverse = (TwiceTheBias - exponent) << MantissaBits;
  double power = 0.0;
  std::memcpy(&power, &inverse, sizeof(power));
  return power;
}

/// A point, scaled so that products of differences neither overflow nor underflow.
struct ScaledPoint
{
  double U, V;
};

/// a - origin, rounded.
DELAUNAYFLIP_HOST_DEVICE inline PlaceOffset Subtract(
  const ScaledPoint& a, const ScaledPoint& origin)
{
  return { a.U - origin.U, a.V - origin.V };
}

/// The rounding error of the difference a - b, exactly (Knuth).
DELAUNAYFLIP_HOST_DEVICE inline double GetDifferenceError(double a, double b, double difference)
{
  const double subtracted = a - difference;
  return (a - (difference + subtracted)) + (subtracted - b);
}

/// Dekker's product: the rounding error of a b, if nothing overflows or underflows.
DELAUNAYFLIP_HOST_DEVICE inline double GetProductError(double a, double b, double product)
{
  constexpr double Splitter = 134217729.0; // 2^27 + 1
  const double aBig = Splitter * a, bBig = Splitter * b;
  const double aHigh = aBig - (aBig - a), bHigh = bBig - (bBig - b);
  const double aLow = a - aHigh, bLow = b - bHigh;
  return aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
}

/// The cross product of two vectors.
class CrossProduct
{
public:
  CrossProduct() = default;
  DELAUNAYFLIP_HOST_DEVICE CrossProduct(const PlaceOffset& a, const PlaceOffset& b)
    : Left(a.U * b.V),
      Right(a.V * b.U),
      Value(Left - Right)
  {
  }

  static constexpr double Cancelled = 1e-3;

  /// Whether the value has lost more than three of 16 digits.
  DELAUNAYFLIP_HOST_DEVICE bool IsCancelled() const
  {
    return !(std::fabs(this->Value) > Cancelled * this->GetMagnitude());
  }

  /// What the rounding of the two products has taken from the value (Kahan).
  DELAUNAYFLIP_HOST_DEVICE double GetRest(const PlaceOffset& a, const PlaceOffset& b) const
  {
    return GetProductError(a.U, b.V, this->Left) - GetProductError(a.V, b.U, this->Right);
  }

  /// What the error of the value is relative to.
  DELAUNAYFLIP_HOST_DEVICE double GetMagnitude() const
  {
    return std::fabs(this->Left) + std::fabs(this->Right);
  }

  double Left, Right, Value;
};

/// A point as seen from another one.
struct SeenPoint
{
  SeenPoint() = default;
  DELAUNAYFLIP_HOST_DEVICE SeenPoint(const ScaledPoint& point, const ScaledPoint& origin)
    : Point(point),
      Offset(Subtract(point, origin)),
      Square(Offset.U * Offset.U + Offset.V * Offset.V)
  {
  }

  ScaledPoint Point;
  PlaceOffset Offset;
  double Square; ///< That of the distance.
};

/// The least area that is used, relative to the magnitude of its cross product. FindTwiceArea finds
/// fewer than nine digits of a smaller area. A sliver with such an area is taken for its longest
/// edge. Squares of sizes would not do: where x and y have different units, areas are small, but
/// have all digits.
constexpr double MeasurableArea = 1e-22;
/// Below this area products underflow, and digits are lost without having cancelled.
constexpr double SmallestArea = 0x1p-1022;

/// Twice the area of a triangle. Its error is about 1e-32 of the magnitude of the cross product, if
/// that is more than a few roundings.
/// @param seenA, seenB as seen from the origin. @param cross of their offsets.
DELAUNAYFLIP_HOST_DEVICE inline double FindTwiceArea(const ScaledPoint& origin,
  const SeenPoint& seenA, const SeenPoint& seenB, const CrossProduct& cross)
{
  if (!cross.IsCancelled())
  {
    return cross.Value;
  }
  const ScaledPoint& a = seenA.Point;
  const ScaledPoint& b = seenB.Point;
  const PlaceOffset& toA = seenA.Offset;
  const PlaceOffset& toB = seenB.Offset;
  const double restUOfA = GetDifferenceError(a.U, origin.U, toA.U);
  const double restVOfA = GetDifferenceError(a.V, origin.V, toA.V);
  const double restUOfB = GetDifferenceError(b.U, origin.U, toB.U);
  const double restVOfB = GetDifferenceError(b.V, origin.V, toB.V);
  const double ofDifferences =
    (toA.U * restVOfB - toA.V * restUOfB) + (restUOfA * toB.V - restVOfA * toB.U);
  return cross.Value + (cross.GetRest(toA, toB) + ofDifferences);
}
DELAUNAYFLIP_HOST_DEVICE inline double FindTwiceArea(
  const ScaledPoint& origin, const SeenPoint& seenA, const SeenPoint& seenB)
{
  return FindTwiceArea(origin, seenA, seenB, CrossProduct(seenA.Offset, seenB.Offset));
}

}

#endif
