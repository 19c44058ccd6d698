// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointStars.h"

namespace delaunayflip
{

void PointStars::Begin(std::int64_t triangles, std::int64_t capacity, std::int64_t points)
{
  this->First.assign(points, None);
  this->Links.reserve(3 * capacity);
  this->Links.resize(3 * triangles);
}

void PointStars::Add(const PieceCorner& corner, std::int32_t point)
{
  const auto number = static_cast<std::uint32_t>(3 * corner.Triangle + corner.Slot);
  if (number >= this->Links.size())
  {
    this->Links.resize(number + std::size_t(1));
  }
  if (static_cast<std::size_t>(point) >= this->First.size())
  {
    this->First.resize(static_cast<std::size_t>(point) + 1, None);
  }
  const std::uint32_t next = this->First[point];
  this->Links[number] = { next, None };
  this->First[point] = number;
  if (next != None)
  {
    this->Links[next].Previous = number;
  }
}

void PointStars::Remove(const PieceCorner& corner, std::int32_t point)
{
  const Link link = this->Links[3 * corner.Triangle + corner.Slot];
  (link.Previous != None ? this->Links[link.Previous].Next : this->First[point]) = link.Next;
  if (link.Next != None)
  {
    this->Links[link.Next].Previous = link.Previous;
  }
}

}
