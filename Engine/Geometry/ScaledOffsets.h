// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SCALEDOFFSETS_H
#define DELAUNAYFLIP_SCALEDOFFSETS_H

#include "HostDevice.h"
#include "TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delaunayflip
{

/// The points of a polygon relative to its first one, scaled by a power of two such that products
/// of two offsets neither overflow nor vanish. Offsets may be of any type indexed by [i][axis]; the
/// first `axes` coordinates are loaded.
template <typename Offsets>
DELAUNAYFLIP_HOST_DEVICE void LoadScaledOffsets(
  const PointArray& points, const std::int64_t* ids, std::int64_t count, int axes, Offsets& offsets)
{
  const auto forEach = [&](const auto& work)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int axis = 0; axis < axes; ++axis)
      {
        work(offsets[i][axis], points.Get(ids[i], axis), points.Get(ids[0], axis));
      }
    }
  };
  double largest = 0.0;
  forEach([&](double&, double x, double) { largest = std::max(largest, std::fabs(x)); });
  // The difference of two finite numbers may be infinite, that of their halves may not.
  const double unit = largest > 0.5 * std::numeric_limits<double>::max() ? 0.5 : 1.0;
  largest = 0.0;
  forEach(
    [&](double& offset, double x, double origin)
    {
      offset = unit * x - unit * origin;
      largest = std::max(largest, std::fabs(offset));
    });
  const int exponent = largest > 0.0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  const double scale = std::scalbn(1.0, -exponent); // infinite if all offsets are subnormal
  forEach([&](double& offset, double, double)
    { offset = std::isfinite(scale) ? scale * offset : std::scalbn(offset, -exponent); });
}

}

#endif
