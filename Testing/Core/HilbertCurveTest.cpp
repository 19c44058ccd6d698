// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HilbertCurve.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace delaunayflip
{
namespace
{

using Cell = std::array<std::uint32_t, 3>;

/// The cells of a cube or square in the order of the curve. Those of a square have z = 0.
template <typename IndexOf>
std::vector<Cell> WalkCurve(std::uint32_t side, std::uint32_t depth, const IndexOf& indexOf)
{
  std::vector<Cell> cells(side * side * depth, Cell{ side, side, side });
  for (std::uint32_t u = 0; u < side; ++u)
  {
    for (std::uint32_t v = 0; v < side; ++v)
    {
      for (std::uint32_t w = 0; w < depth; ++w)
      {
        cells.at(indexOf(u, v, w)) = { u, v, w };
      }
    }
  }
  return cells;
}

int Distance(const Cell& a, const Cell& b)
{
  int distance = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    distance += std::abs(static_cast<int>(a[axis]) - static_cast<int>(b[axis]));
  }
  return distance;
}

/// Every cell is visited, and each is next to the one before it.
void ExpectHilbertCurve(const std::vector<Cell>& cells)
{
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    ASSERT_EQ(Distance(cells[i - 1], cells[i]), 1) << "at " << i << " of " << cells.size();
  }
}

TEST(HilbertCurve, FillsSquares)
{
  for (int bits = 1; bits <= 7; ++bits)
  {
    ExpectHilbertCurve(WalkCurve(1u << bits, 1,
      [bits](std::uint32_t u, std::uint32_t v, std::uint32_t)
      { return HilbertIndex(u, v, bits); }));
  }
}

TEST(HilbertCurve, FillsCubes)
{
  for (int bits = 1; bits <= 5; ++bits)
  {
    ExpectHilbertCurve(WalkCurve(1u << bits, 1u << bits,
      [bits](std::uint32_t u, std::uint32_t v, std::uint32_t w)
      {
        std::uint32_t cell[3] = { u, v, w };
        return HilbertIndex(cell, bits);
      }));
  }
}

TEST(HilbertCurve, IsTheSameByLevelsAndByDoubling)
{
  std::uint32_t random = 1;
  for (int i = 0; i < 100000; ++i)
  {
    random = random * 1664525u + 1013904223u;
    const int bits = 1 + i % 16;
    const std::uint32_t mask = (1u << bits) - 1;
    std::uint32_t cell[2] = { (random >> 16) & mask, (random * 2654435761u >> 16) & mask };
    const std::uint32_t byDoubling = HilbertIndex(cell[0], cell[1], bits);
    ASSERT_EQ(byDoubling, HilbertIndex(cell, bits)) << "bits " << bits;
  }
}

}
}
