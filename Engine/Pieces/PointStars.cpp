// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointStars.h"

#include <algorithm>
#include <cstddef>

namespace delaunayflip
{

void PointStars::AddAll(std::vector<PieceTriangle>& triangles, std::int64_t points)
{
  this->First.assign(points, None);
  this->Next.reserve(3 * triangles.capacity());
  this->Next.assign(3 * triangles.size(), None);
  for (std::size_t t = triangles.size(); t-- > 0;) // so that lists begin with their first triangle
  {
    this->Add(triangles, static_cast<std::int64_t>(t));
  }
}

void PointStars::Add(std::vector<PieceTriangle>& triangles, std::int64_t triangle)
{
  const auto corner = static_cast<std::uint32_t>(3 * triangle);
  if (corner + std::size_t(3) > this->Next.size())
  {
    this->Next.resize(corner + std::size_t(3), None);
  }
  triangles[triangle].IsInStars = true;
  for (std::uint32_t slot = 0; slot < 3; ++slot)
  {
    const auto point = static_cast<std::size_t>(triangles[triangle].Points[slot]);
    if (point >= this->First.size())
    {
      this->First.resize(point + 1, None);
    }
    this->Next[corner + slot] = this->First[point];
    this->First[point] = corner + slot;
  }
}

void PointStars::Remove(
  std::vector<PieceTriangle>& triangles, const std::vector<std::int64_t>& removed)
{
  std::vector<std::int32_t> points;
  for (const std::int64_t t : removed)
  {
    triangles[t].IsInStars = false;
    points.insert(points.end(), triangles[t].Points, triangles[t].Points + 3);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const std::int32_t point : points)
  {
    std::uint32_t* link = &this->First[point];
    while (*link != None)
    {
      if (triangles[*link / 3].IsInStars)
      {
        link = &this->Next[*link];
      }
      else
      {
        *link = this->Next[*link];
      }
    }
  }
}

}
