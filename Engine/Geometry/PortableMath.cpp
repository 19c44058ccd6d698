// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PortableMath.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>
#include <cstddef>

namespace delaunayflip
{

namespace
{
using Wide = boost::multiprecision::cpp_bin_float_quad; // of integers, so the same everywhere

/// The unevaluated sum of two doubles, the lower one at most half a unit of the higher one.
struct Pair
{
  double High, Low;
};

/// @param smaller at most as large as the other.
Pair AddExactly(double larger, double smaller)
{
  const double sum = larger + smaller;
  return { sum, smaller - (sum - larger) };
}

Pair MultiplyExactly(double a, double b)
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
Pair operator+(const Pair& a, const Pair& b)
{
  const Pair sum = AddExactly(a.High, b.High);
  return AddExactly(sum.High, sum.Low + (a.Low + b.Low));
}

Pair operator*(const Pair& a, const Pair& b)
{
  const Pair product = MultiplyExactly(a.High, b.High);
  return AddExactly(product.High, product.Low + (a.High * b.Low + a.Low * b.High));
}

/// @returns the value of a polynomial. The first coefficient is that of the highest power.
template <std::size_t Size>
double FindPolynomial(const double (&coefficients)[Size], double x)
{
  double sum = 0.0;
  for (const double coefficient : coefficients)
  {
    sum = sum * x + coefficient;
  }
  return sum;
}
}

double Sine(double radians) { return static_cast<double>(sin(Wide(radians))); }

double Cosine(double radians) { return static_cast<double>(cos(Wide(radians))); }

double Tangent(double radians) { return static_cast<double>(tan(Wide(radians))); }

/// The series of Taylor. What decides the last bit is computed with pairs.
SineAndCosine FindSineAndCosine(double radians)
{
  constexpr Pair Of6 = { -0x1.5555555555555p-3, -0x1.5555555555555p-57 };
  constexpr Pair Of24 = { 0x1.5555555555555p-5, 0x1.5555555555555p-59 };
  constexpr Pair Of720 = { -0x1.6c16c16c16c17p-10, 0x1.f49f49f49f49fp-65 };
  constexpr Pair Of120 = { 0x1.1111111111111p-7, 0x1.1111111111111p-63 };
  constexpr double SineEnd[] = { 1.0 / 355687428096000.0, -1.0 / 1307674368000.0,
    1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0 };
  constexpr double CosineEnd[] = { -1.0 / 6402373705728000.0, 1.0 / 20922789888000.0,
    -1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0 };
  const Pair angle = { radians, 0.0 }, one = { 1.0, 0.0 }, half = { -0.5, 0.0 };
  const Pair square = MultiplyExactly(radians, radians);
  const double sineEnd = FindPolynomial(SineEnd, square.High);
  const double cosineEnd = FindPolynomial(CosineEnd, square.High);
  const Pair third = Of120 + Pair{ square.High * sineEnd, 0.0 };
  const Pair sine = angle + angle * (square * (Of6 + square * third));
  const Pair fourth = Of720 + Pair{ square.High * cosineEnd, 0.0 };
  const Pair cosine = one + square * (half + square * (Of24 + square * fourth));
  return { sine.High, cosine.High };
}

}
