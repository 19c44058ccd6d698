// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GROWTESTSUPPORT_H
#define DELAUNAYFLIP_GROWTESTSUPPORT_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

using Triples = std::vector<std::array<std::int32_t, 3>>;

/// Triangles in a fixed order, each from its smallest vertex on.
inline Triples Normalize(const std::vector<std::int32_t>& ids)
{
  Triples triangles;
  for (std::size_t i = 0; i < ids.size(); i += 3)
  {
    std::array<std::int32_t, 3> triangle = { ids[i], ids[i + 1], ids[i + 2] };
    std::rotate(
      triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}

#endif
