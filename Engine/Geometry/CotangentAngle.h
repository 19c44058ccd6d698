// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_COTANGENTANGLE_H
#define DELAUNAYFLIP_COTANGENTANGLE_H

#include "SurfaceAngles.h"

#include <cmath>
#include <limits>

namespace delaunayflip
{

/// The angle in degrees of a LargestSquaredCotangent; NaN if there is none.
inline double ToDegrees(double squaredCotangent)
{
  if (squaredCotangent == -INFINITY)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return squaredCotangent == INFINITY
    ? 0.0
    : std::atan2(1.0, std::sqrt(squaredCotangent)) / DegreesToRadians;
}

}

#endif
