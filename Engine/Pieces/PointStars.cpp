// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointStars.h"

#include <cstddef>
#include <utility>

namespace delaunayflip
{

void PointStars::AddAll(const PieceTriangles& triangles, std::int64_t points)
{
  this->First.assign(points, None);
  this->Next.reserve(3 * triangles.capacity());
  this->Next.assign(3 * triangles.size(), None);
  for (std::size_t t = triangles.size(); t-- > 0;) // so that lists begin with their first triangle
  {
    this->Add(triangles, static_cast<std::int64_t>(t));
  }
}

void PointStars::Add(const PieceTriangles& triangles, std::int64_t triangle)
{
  const auto corner = static_cast<std::uint32_t>(3 * triangle);
  if (corner + std::size_t(3) > this->Next.size())
  {
    this->Next.resize(corner + std::size_t(3), None);
  }
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

void PointStars::Remove(const PieceTriangles& triangles, const std::vector<std::int64_t>& removed)
{
  this->Removed.Resize(triangles.size());
  for (const std::int64_t t : removed)
  {
    this->Removed.Add(t);
  }
  for (const std::int64_t t : removed)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      if (this->Next[3 * t + slot] != Unlisted)
      {
        this->Clean(triangles[t].Points[slot]);
      }
    }
  }
  this->Removed.Clear();
}

/// Takes those of Removed from the list of a point.
void PointStars::Clean(std::int32_t point)
{
  std::uint32_t* link = &this->First[point];
  while (*link != None)
  {
    std::uint32_t& next = this->Next[*link];
    if (this->Removed.Has(*link / 3))
    {
      *link = std::exchange(next, Unlisted);
    }
    else
    {
      link = &next;
    }
  }
}

}
