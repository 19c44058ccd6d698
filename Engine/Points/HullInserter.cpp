// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "HullInserter.h"

#include "ExactPredicates.h"

#include <unordered_map>
#include <utility>

namespace delaunayflip
{

HullInserter::HullInserter(
  const SpacePoints& points, const PlanePoint& center, std::vector<std::int32_t> triangles)
  : Points(points),
    Center(center),
    Triangles(std::move(triangles)),
    Neighbors(FindNeighbors(this->Triangles, static_cast<std::int64_t>(points.size()))),
    IsSeen(this->Triangles.size() / 3)
{
}

void HullInserter::Insert(std::int32_t point)
{
  const std::int32_t below = this->Locate(point);
  if (this->IsVisible(below, point))
  {
    this->CollectVisible(below, point);
    this->ReplaceVisible(point);
  }
}

/// Walks to the triangle through which the ray from the center to the point goes. In a convex hull
/// a walk ends, and visits no triangle twice.
std::int32_t HullInserter::Locate(std::int32_t point) const
{
  std::int32_t t = this->Last;
  for (std::size_t steps = 0; steps < this->IsSeen.size(); ++steps)
  {
    const std::int32_t* ids = this->Triangles.data() + std::size_t(3) * t;
    int slot = 0;
    while (slot < 3 &&
      FindOrientation3D(this->Points[ids[(slot + 1) % 3]], this->Points[ids[(slot + 2) % 3]],
        this->Points[point], this->Center) >= 0)
    {
      ++slot;
    }
    if (slot == 3)
    {
      return t;
    }
    t = this->Neighbors[std::size_t(3) * t + slot];
  }
  return t;
}

bool HullInserter::IsVisible(std::int32_t triangle, std::int32_t point) const
{
  const std::int32_t* ids = this->Triangles.data() + std::size_t(3) * triangle;
  return FindOrientation3D(this->Points[ids[0]], this->Points[ids[1]], this->Points[ids[2]],
           this->Points[point]) < 0;
}

void HullInserter::CollectVisible(std::int32_t first, std::int32_t point)
{
  this->Visible = { first };
  this->IsSeen[first] = 1;
  for (std::size_t next = 0; next < this->Visible.size(); ++next)
  {
    const std::int32_t t = this->Visible[next];
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t across = this->Neighbors[std::size_t(3) * t + slot];
      if (this->IsSeen[across] == 0 && this->IsVisible(across, point))
      {
        this->IsSeen[across] = 1;
        this->Visible.push_back(across);
      }
    }
  }
}

/// Replaces the visible triangles by triangles from the point to the edges of their boundary.
void HullInserter::ReplaceVisible(std::int32_t point)
{
  std::unordered_map<std::int32_t, std::int32_t> triangleFrom; // by the first end of its outer edge
  std::vector<std::int32_t> made;
  for (const std::int32_t t : this->Visible)
  {
    for (int slot = 0; slot < 3; ++slot)
    {
      const std::int32_t across = this->Neighbors[std::size_t(3) * t + slot];
      if (this->IsSeen[across] != 0)
      {
        continue;
      }
      const std::int32_t from = this->Triangles[std::size_t(3) * t + (slot + 1) % 3];
      const std::int32_t to = this->Triangles[std::size_t(3) * t + (slot + 2) % 3];
      const auto number = static_cast<std::int32_t>(this->IsSeen.size());
      this->Triangles.insert(this->Triangles.end(), { from, to, point });
      this->Neighbors.insert(this->Neighbors.end(), { -1, -1, across });
      this->IsSeen.push_back(0);
      for (int other = 0; other < 3; ++other)
      {
        std::int32_t& back = this->Neighbors[std::size_t(3) * across + other];
        const std::int32_t opposite = this->Triangles[std::size_t(3) * across + other];
        if (back == t && opposite != from && opposite != to)
        {
          back = number;
        }
      }
      triangleFrom[from] = number;
      made.push_back(number);
    }
  }
  for (const std::int32_t number : made)
  {
    const std::int32_t to = this->Triangles[std::size_t(3) * number + 1];
    const std::int32_t next = triangleFrom.at(to);
    this->Neighbors[std::size_t(3) * number] = next;
    this->Neighbors[std::size_t(3) * next + 1] = number;
  }
  for (const std::int32_t t : this->Visible)
  {
    this->Triangles[std::size_t(3) * t] = -1;
  }
  this->Last = made.front();
}

std::vector<std::int32_t> HullInserter::ListTriangles() const
{
  std::vector<std::int32_t> listed;
  for (std::size_t first = 0; first < this->Triangles.size(); first += 3)
  {
    if (this->Triangles[first] >= 0)
    {
      listed.insert(listed.end(), &this->Triangles[first], &this->Triangles[first] + 3);
    }
  }
  return listed;
}

}
