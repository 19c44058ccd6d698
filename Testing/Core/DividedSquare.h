// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_DIVIDEDSQUARE_H
#define DELAUNAYFLIP_DIVIDEDSQUARE_H

#include "PointTestSupport.h"

#include <cmath>

namespace delaunayflip
{

/// A square turned around its first corner. Further points divide its sides. They are on the sides
/// only within rounding: some are outside of the square, and some inside.
/// @param angle in radians. @param pieces of each side.
inline Places MakeDividedSquare(double angle, int pieces)
{
  const Place corners[] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  Places ring;
  for (int i = 0; i < 4 * pieces; ++i)
  {
    const Place &from = corners[i / pieces], &to = corners[(i / pieces + 1) % 4];
    const double share = double(i % pieces) / pieces;
    const double x = from[0] + share * (to[0] - from[0]);
    const double y = from[1] + share * (to[1] - from[1]);
    ring.push_back(
      { x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle) });
  }
  return ring;
}

}

#endif
