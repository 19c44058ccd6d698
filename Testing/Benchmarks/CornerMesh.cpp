// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerMesh.h"

#include <algorithm>
#include <utility>

namespace delaunayflip
{

namespace
{

struct Side
{
  std::uint64_t Ends; ///< The smaller vertex id in the upper half, the larger one in the lower.
  std::int32_t Corner;
};

}

CornerMesh::CornerMesh(std::vector<std::int32_t> triangles)
  : Vertices(std::move(triangles)),
    Twins(this->Vertices.size(), -1)
{
  std::vector<Side> sides;
  sides.reserve(this->Vertices.size());
  for (std::int32_t corner = 0; corner < this->CountCorners(); ++corner)
  {
    const auto [low, high] =
      std::minmax({ this->Vertices[Next(corner)], this->Vertices[Previous(corner)] });
    sides.push_back({ std::uint64_t(low) << 32 | std::uint64_t(high), corner });
  }
  std::sort(
    sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.Ends < b.Ends; });
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next)
  {
    while (next < sides.size() && sides[next].Ends == sides[i].Ends)
    {
      ++next;
    }
    const std::int32_t a = sides[i].Corner;
    const std::int32_t b = sides[next - 1].Corner;
    if (next == i + 2 && this->Vertices[Next(a)] == this->Vertices[Previous(b)])
    {
      this->Link(a, b);
    }
  }
}

}
