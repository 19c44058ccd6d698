// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HILBERTCURVE_H
#define DELAUNAYFLIP_HILBERTCURVE_H

#include "HostDevice.h"

#include <algorithm>
#include <cstdint>

namespace delaunayflip
{

/// Moves bit i to bit Axes * i.
template <int Axes>
DELAUNAYFLIP_HOST_DEVICE std::uint32_t SpreadBits(std::uint32_t x)
{
  static_assert(Axes == 2 || Axes == 3, "bits move by 1 or 2 times 8, 4, 2 and 1");
  constexpr bool IsPlane = Axes == 2;
  x = (x | (x << 8 * (Axes - 1))) & (IsPlane ? 0x00ff00ffu : 0x030000ffu);
  x = (x | (x << 4 * (Axes - 1))) & (IsPlane ? 0x0f0f0f0fu : 0x0300f00fu);
  x = (x | (x << 2 * (Axes - 1))) & (IsPlane ? 0x33333333u : 0x030c30c3u);
  return (x | (x << (Axes - 1))) & (IsPlane ? 0x55555555u : 0x09249249u);
}

/// Position along the Hilbert curve of a cell, each coordinate of `bits` bits (Skilling,
/// Programming the Hilbert curve, 2004), level after level.
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
  for (const std::uint32_t x : cell)
  {
    index = (index << 1) | SpreadBits<Axes>(x);
  }
  // Every bit becomes the parity of itself and all above it.
  for (int distance = 1; distance < 32; distance *= 2)
  {
    index ^= index >> distance;
  }
  return index;
}

/// How the plane's Hilbert curve is turned from level to level, for all levels at once: bit i of
/// every word belongs to level i. A turn has two bits: E, whether it exchanges the axes, and I,
/// whether it inverts both. Each level maps the turn that it finds by an affine map over the field
/// of two elements:
///
///     E' = EE E + EI I + E0,  I' = IE E + II I + I0
struct HilbertTurns
{
  std::uint32_t EE, EI, E0, IE, II, I0;

  /// Composes every level's map with that of the level `distance` above it, so that maps span twice
  /// the distance.
  DELAUNAYFLIP_HOST_DEVICE DELAUNAYFLIP_ALWAYS_INLINE HilbertTurns Follow(int distance) const
  {
    // Levels above the first leave the turn as it is.
    const std::uint32_t ee = ~(~this->EE >> distance), ii = ~(~this->II >> distance);
    const std::uint32_t ei = this->EI >> distance, ie = this->IE >> distance;
    const std::uint32_t e0 = this->E0 >> distance, i0 = this->I0 >> distance;
    return { (this->EE & ee) ^ (this->EI & ie), (this->EE & ei) ^ (this->EI & ii),
      (this->EE & e0) ^ (this->EI & i0) ^ this->E0, (this->IE & ee) ^ (this->II & ie),
      (this->IE & ei) ^ (this->II & ii), (this->IE & e0) ^ (this->II & i0) ^ this->I0 };
  }
};

/// The same in the plane, by doubling the distance over which turns are known, in a third of the
/// time.
/// @param u, v of at most 16 bits.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t HilbertIndex(
  std::uint32_t u, std::uint32_t v, int bits)
{
  const std::uint32_t levels = (std::uint32_t(1) << bits) - 1;
  // A cell in the lower half of the second axis, once this is turned, exchanges the axes; in the
  // upper half of the first, too, it also inverts both.
  const std::uint32_t differ = u ^ v;
  HilbertTurns turns{ ~differ, levels, ~v & levels, differ, ~differ, differ & ~v };
  for (int distance = 1; distance < bits; distance *= 2)
  {
    turns = turns.Follow(distance);
  }
  const std::uint32_t exchanged = turns.E0 >> 1;
  const std::uint32_t inverted = turns.I0 >> 1;
  const std::uint32_t turnedU = u ^ inverted ^ (exchanged & differ);
  return (SpreadBits<2>(turnedU) << 1) | SpreadBits<2>(differ);
}

/// The cell, of 2^bits, of a coordinate in [lower, lower + width]; 0 if it is not in it or NaN.
DELAUNAYFLIP_HOST_DEVICE inline std::uint32_t CellOf(double x, double lower, double width, int bits)
{
  const double cells = static_cast<double>(1u << bits);
  const double position = width > 0.0 ? (x - lower) / width * cells : 0.0;
  return position > 0.0 ? static_cast<std::uint32_t>(std::min(position, cells - 1.0)) : 0;
}

}

#endif
