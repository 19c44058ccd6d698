// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_RANDOMNUMBERS_H
#define DELAUNAYFLIP_RANDOMNUMBERS_H

#include <cstddef>
#include <iterator>
#include <random>
#include <utility>

/// @file
/// What std::shuffle and the distributions of <random> do, but with the same result in every
/// standard library: only the generators are the same everywhere.

namespace delaunayflip
{

/// A number in [low, high).
inline double DrawReal(std::mt19937& random, double low, double high)
{
  return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
}

/// Nearly normal, with deviation 1, and without functions that mathematical libraries round
/// differently: the sum of twelve numbers.
inline double DrawNormal(std::mt19937& random)
{
  double sum = 0.0;
  for (int i = 0; i < 12; ++i)
  {
    sum += DrawReal(random, -0.5, 0.5);
  }
  return sum;
}

template <typename Iterator, typename Generator>
void Shuffle(Iterator first, Iterator last, Generator&& random)
{
  for (auto count = std::distance(first, last); count > 1; --count)
  {
    const auto other = static_cast<std::size_t>(random()) % static_cast<std::size_t>(count);
    using Distance = decltype(count);
    std::swap(*(first + (count - 1)), *(first + static_cast<Distance>(other)));
  }
}

}

#endif
