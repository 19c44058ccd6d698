// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLANESCALE_H
#define DELAUNAYFLIP_PLANESCALE_H

#include "HostDevice.h"
#include "MeshSurvey.h"
#include "SurfaceAngles.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

/// Scales by a power of two, in two steps, so that the largest coordinate is in 1 .. 2 and lengths
/// neither overflow nor vanish. The same on every backend.
struct PlaneScale
{
  double Factors[2] = { 1.0, 1.0 }; ///< Their product may be beyond the range of double.

  explicit PlaneScale(const BoundingBox& box)
  {
    double largest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      largest = std::max({ largest, std::fabs(box.Lower[axis]), std::fabs(box.Upper[axis]) });
    }
    const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
    this->Factors[0] = std::scalbn(1.0, exponent / 2);
    this->Factors[1] = std::scalbn(1.0, exponent - exponent / 2);
  }

  DELAUNAYFLIP_HOST_DEVICE Vector3 operator()(double x, double y, double z) const
  {
    return { x * this->Factors[0] * this->Factors[1], y * this->Factors[0] * this->Factors[1],
      z * this->Factors[0] * this->Factors[1] };
  }
};

}

#endif
