// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSETS_H
#define DELAUNAYFLIP_POINTSETS_H

#include <array>
#include <cstdint>
#include <random>
#include <vector>

/// @file
/// Sets of points on which triangulations differ in cost, the same on every machine.

namespace delaunayflip
{

using Place = std::array<double, 2>;

struct PointSet
{
  const char* Name;
  Place (*Make)(std::mt19937_64& random, double i, double n); ///< Point i of n.
  bool IsHard = false; ///< Without care it takes quadratic time.
};

/// Most of the curves are taken over by divide and conquer.
const std::vector<PointSet>& ListPointSets();

/// So many points of a set, in random order. Some may be at the same place.
std::vector<Place> MakePlaces(const PointSet& set, std::int64_t count);

}

#endif
