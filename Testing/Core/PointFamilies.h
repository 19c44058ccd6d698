// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POINTFAMILIES_H
#define DELAUNAYFLIP_POINTFAMILIES_H

#include "ExactReference.h"

#include <array>
#include <ostream>
#include <random>
#include <vector>

/// @file
/// Four points at a time on which predicates go wrong: ties, near ties, and exponents at the limits
/// of each kind of arithmetic.

namespace delaunayflip
{

using FourPoints = std::array<Point3, 4>;

/// Whether fixed-point integers hold the coordinates of a family.
enum class Fit
{
  Sometimes,
  Always,
  Never
};

struct PointFamily
{
  const char* Name;
  FourPoints (*Draw)(std::mt19937&);
  Fit FixedPoint;
};

inline void PrintTo(const PointFamily& family, std::ostream* stream) { *stream << family.Name; }

std::vector<PointFamily> ListPointFamilies();

/// Coordinates 0 to 3, so that most cases have ties.
FourPoints DrawSmallGrid(std::mt19937& random);

/// Lattice points on one circle.
FourPoints DrawCircle(std::mt19937& random);

}

#endif
