// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_EXPANSION_H
#define DELAUNAYFLIP_EXPANSION_H

#include "HostDevice.h"

#include <cmath>

/// @file
/// Exact sums, differences and products of doubles as expansions: nonoverlapping components of
/// increasing magnitude whose sum is the value (Shewchuk, Adaptive Precision Floating-Point
/// Arithmetic and Fast Robust Geometric Predicates, 1997). Exact as long as no product overflows or
/// loses bits to underflow, which callers ensure by scaling.

namespace delaunayflip
{

/// Rounded sum and its rounding error.
DELAUNAYFLIP_HOST_DEVICE inline double TwoSum(double a, double b, double& error)
{
  const double sum = a + b;
  const double bVirtual = sum - a;
  error = (a - (sum - bVirtual)) + (b - bVirtual);
  return sum;
}

/// High half of a double's bits (Veltkamp); |a| < 2^996.
DELAUNAYFLIP_HOST_DEVICE inline double HighHalf(double a)
{
  constexpr double Splitter = 134217729.0; // 2^27 + 1
  const double c = Splitter * a;
  return c - (c - a);
}

/// Rounded product and its rounding error (Dekker: the same bits with and without a fused
/// multiply-add unit).
DELAUNAYFLIP_HOST_DEVICE inline double TwoProduct(double a, double b, double& error)
{
  const double product = a * b;
  const double aHigh = HighHalf(a);
  const double aLow = a - aHigh;
  const double bHigh = HighHalf(b);
  const double bLow = b - bHigh;
  error = aLow * bLow - (((product - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
  return product;
}

/// At most `Capacity` components; zeros are not stored. An aggregate.
template <int Capacity>
struct Expansion
{
  double Components[Capacity];
  int Size;

  DELAUNAYFLIP_HOST_DEVICE void Append(double component)
  {
    if (component != 0.0)
    {
      this->Components[this->Size++] = component;
    }
  }

  /// The largest component carries the sign.
  DELAUNAYFLIP_HOST_DEVICE int Sign() const
  {
    if (this->Size == 0)
    {
      return 0;
    }
    return this->Components[this->Size - 1] > 0.0 ? 1 : -1;
  }

  DELAUNAYFLIP_HOST_DEVICE void Negate()
  {
    for (int i = 0; i < this->Size; ++i)
    {
      this->Components[i] = -this->Components[i];
    }
  }
};

DELAUNAYFLIP_HOST_DEVICE inline Expansion<2> SumOf(double a, double b)
{
  Expansion<2> result{};
  double error = 0.0;
  const double sum = TwoSum(a, b, error);
  result.Append(error);
  result.Append(sum);
  return result;
}

DELAUNAYFLIP_HOST_DEVICE inline Expansion<2> DifferenceOf(double a, double b)
{
  return SumOf(a, -b);
}

/// Sum of two expansions: components merged by magnitude, carries swept through once. `result` must
/// have room for e.Size + f.Size components.
template <int N, int M, int K>
DELAUNAYFLIP_HOST_DEVICE void AddInto(
  const Expansion<N>& e, const Expansion<M>& f, Expansion<K>& result)
{
  result.Size = 0;
  int i = 0;
  int j = 0;
  double carry = 0.0;
  while (i < e.Size || j < f.Size)
  {
    const bool takeE =
      j == f.Size || (i < e.Size && std::fabs(e.Components[i]) < std::fabs(f.Components[j]));
    const double next = takeE ? e.Components[i++] : f.Components[j++];
    double error = 0.0;
    carry = TwoSum(carry, next, error);
    result.Append(error);
  }
  result.Append(carry);
}

template <int N, int M>
DELAUNAYFLIP_HOST_DEVICE Expansion<N + M> Add(const Expansion<N>& e, const Expansion<M>& f)
{
  Expansion<N + M> result;
  result.Size = 0;
  AddInto(e, f, result);
  return result;
}

/// Expansion times a double.
template <int N>
DELAUNAYFLIP_HOST_DEVICE Expansion<2 * N> Scale(const Expansion<N>& e, double factor)
{
  Expansion<2 * N> result;
  result.Size = 0;
  double carry = 0.0;
  for (int i = 0; i < e.Size; ++i)
  {
    double low = 0.0;
    double error = 0.0;
    const double high = TwoProduct(e.Components[i], factor, low);
    const double middle = TwoSum(carry, low, error);
    result.Append(error);
    carry = TwoSum(high, middle, error);
    result.Append(error);
  }
  result.Append(carry);
  return result;
}

/// Product of two expansions: the sum of `e` scaled by each component of `f`.
template <int N, int M>
DELAUNAYFLIP_HOST_DEVICE Expansion<2 * N * M> Multiply(const Expansion<N>& e, const Expansion<M>& f)
{
  // After j of the M summands at most 2 N j components are in use, so each sum fits.
  Expansion<2 * N * M> sums[2];
  sums[0].Size = 0;
  for (int j = 0; j < f.Size; ++j)
  {
    AddInto(sums[j % 2], Scale(e, f.Components[j]), sums[(j + 1) % 2]);
  }
  return sums[f.Size % 2];
}

/// a * d - b * c.
template <int N, int M>
DELAUNAYFLIP_HOST_DEVICE Expansion<4 * N * M> Determinant(
  const Expansion<N>& a, const Expansion<M>& b, const Expansion<N>& c, const Expansion<M>& d)
{
  Expansion<2 * N* M> minor = Multiply(c, b);
  minor.Negate();
  return Add(Multiply(a, d), minor);
}

}

#endif
