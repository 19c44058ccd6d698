// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointPlaces.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace delaunayflip
{

std::size_t PointPlaces::Hash::operator()(const Bits& bits) const
{
  // Coordinates on a lattice differ only in a few high bits: multiply, then fold those down.
  std::uint64_t hash = 0;
  for (const std::uint64_t word : bits)
  {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15u; // 2^64 / golden ratio, odd
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

bool PointPlaces::Read(const PointArray& points, std::int64_t point, Bits& bits) const
{
  const double largest =
    this->AsFloats ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    double x = points.Get(point, axis);
    if (!(std::fabs(x) <= largest))
    {
      return false;
    }
    x = this->AsFloats ? static_cast<double>(static_cast<float>(x)) : x;
    x = x == 0.0 ? 0.0 : x;
    std::memcpy(&bits[axis], &x, sizeof(x));
  }
  return true;
}

std::int64_t PointPlaces::Add(const PointArray& points, std::int64_t point)
{
  Bits bits;
  if (!this->Read(points, point, bits))
  {
    return this->NumberOfPlaces++;
  }
  const auto added = this->Numbers.emplace(bits, this->NumberOfPlaces);
  this->NumberOfPlaces += added.second ? 1 : 0;
  return added.first->second;
}

std::int64_t PointPlaces::Find(const PointArray& points, std::int64_t point) const
{
  Bits bits;
  if (!this->Read(points, point, bits))
  {
    return None;
  }
  const auto found = this->Numbers.find(bits);
  return found == this->Numbers.end() ? None : found->second;
}

}
