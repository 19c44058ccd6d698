// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HILBERTCURVE_H
#define DELAUNAYFLIP_HILBERTCURVE_H

#include "HostDevice.h"

#include <algorithm>
#include <cstdint>

namespace delaunayflip
{

/// Position along the Hilbert curve of a cell, each coordinate of `bits` bits (Skilling,
/// Programming the Hilbert curve, 2004).
template <int Axes>
DELAUNAYFLIP_HOST_DEVICE std::uint32_t HilbertIndex(std::uint32_t (&cell)[Axes], int bits)
{
  for (int level = bits - 1; level > 0; --level)
  {
    const std::uint32_t lower = (1u << level) - 1;
    for (std::uint32_t& x : cell)
    {
      // All ones where the bit of this level is set: invert the first axis, else exchange with it.
      const std::uint32_t invert = 0u - ((x >> level) & 1u);
      const std::uint32_t exchange = (cell[0] ^ x) & lower & ~invert;
      cell[0] ^= (lower & invert) | exchange;
      x ^= exchange;
    }
  }
  std::uint32_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
  {
    for (const std::uint32_t x : cell)
    {
      index = (index << 1) | ((x >> bit) & 1);
    }
  }
  // Every bit becomes the parity of itself and all above it.
  for (int distance = 1; distance < 32; distance *= 2)
  {
    index ^= index >> distance;
  }
  return index;
}

/// Cell, of 2^bits, of a coordinate in [lower, lower + width]; 0 for what is not in it (NaN).
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t CellOf(double x, double lower, double width, int bits)
{
  const double cells = static_cast<double>(1u << bits);
  const double position = width > 0.0 ? (x - lower) / width * cells : 0.0;
  return position > 0.0 ? static_cast<std::uint32_t>(std::min(position, cells - 1.0)) : 0;
}

}

#endif
