// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SINEANDCOSINE_H
#define DELAUNAYFLIP_SINEANDCOSINE_H

#include "HostDevice.h"

#include <cstddef>

/// @file
/// Sines and cosines of many angles, with the same bits on all systems and on a GPU.

namespace delaunayflip
{

/// The unevaluated sum of two doubles, the lower one at most half a unit of the higher one.
struct DoublePair
{
  double High, Low;
};

/// @param smaller at most as large as the other.
DELAUNAYFLIP_HOST_DEVICE inline DoublePair AddExactly(double larger, double smaller)
{
  const double sum = larger + smaller;
  return { sum, smaller - (sum - larger) };
}

DELAUNAYFLIP_HOST_DEVICE inline DoublePair MultiplyExactly(double a, double b)
{
  constexpr double Splitter = 0x1p27 + 1.0; // Dekker's
  const auto getUpper = [](double x)
  {
    const double large = Splitter * x;
    return large - (large - x);
  };
  const double product = a * b, ah = getUpper(a), bh = getUpper(b), al = a - ah, bl = b - bh;
  return { product, al * bl - (((product - ah * bh) - al * bh) - ah * bl) };
}

/// @param b at most as large as a.
DELAUNAYFLIP_HOST_DEVICE inline DoublePair operator+(const DoublePair& a, const DoublePair& b)
{
  const DoublePair sum = AddExactly(a.High, b.High);
  return AddExactly(sum.High, sum.Low + (a.Low + b.Low));
}

DELAUNAYFLIP_HOST_DEVICE inline DoublePair operator*(const DoublePair& a, const DoublePair& b)
{
  const DoublePair product = MultiplyExactly(a.High, b.High);
  return AddExactly(product.High, product.Low + (a.High * b.Low + a.Low * b.High));
}

/// @returns the value of a polynomial. The first coefficient is that of the highest power.
template <std::size_t Size>
DELAUNAYFLIP_HOST_DEVICE double FindPolynomial(const double (&coefficients)[Size], double x)
{
  double sum = 0.0;
  for (const double coefficient : coefficients)
  {
    sum = sum * x + coefficient;
  }
  return sum;
}

/// For points. Both errors are below 0.501 units in the last place. The series of Taylor; what
/// decides the last bit is computed with pairs.
/// @param radians from -pi/4 to pi/4.
DELAUNAYFLIP_HOST_DEVICE inline void FindSineAndCosine(double radians, double& sine, double& cosine)
{
  constexpr DoublePair Of6 = { -0x1.5555555555555p-3, -0x1.5555555555555p-57 };
  constexpr DoublePair Of24 = { 0x1.5555555555555p-5, 0x1.5555555555555p-59 };
  constexpr DoublePair Of720 = { -0x1.6c16c16c16c17p-10, 0x1.f49f49f49f49fp-65 };
  constexpr DoublePair Of120 = { 0x1.1111111111111p-7, 0x1.1111111111111p-63 };
  constexpr double SineEnd[] = { 1.0 / 355687428096000.0, -1.0 / 1307674368000.0,
    1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0 };
  constexpr double CosineEnd[] = { -1.0 / 6402373705728000.0, 1.0 / 20922789888000.0,
    -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0 };
  const DoublePair angle = { radians, 0.0 }, one = { 1.0, 0.0 }, half = { -0.5, 0.0 };
  const DoublePair square = MultiplyExactly(radians, radians);
  const double sineEnd = FindPolynomial(SineEnd, square.High);
  const double cosineEnd = FindPolynomial(CosineEnd, square.High);
  const DoublePair third = Of120 + DoublePair{ square.High * sineEnd, 0.0 };
  sine = (angle + angle * (square * (Of6 + square * third))).High;
  const DoublePair fourth = Of720 + DoublePair{ square.High * cosineEnd, 0.0 };
  cosine = (one + square * (half + square * (Of24 + square * fourth))).High;
}

}

#endif
