// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTSETS_H
#define DELAUNAYFLIP_POINTSETS_H

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace delaunayflip
{

using Place = std::array<double, 2>;
using Places = std::vector<Place>;

/// Points on which triangulations differ in cost; most of the curves are taken over by divide and
/// conquer.
struct PointSet
{
  const char* Name;
  Place (*Make)(std::mt19937_64& random, double i, double n); ///< Point i of n.
  bool IsHard = false; ///< Flips or cutting ears may take quadratic time.
};

const std::vector<PointSet>& ListPointSets();

/// Points of a set in random order.
Places MakePlaces(const PointSet& set, std::int64_t count);

}

#endif
