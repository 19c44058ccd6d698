// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACE_TESTS_H
#define DELAUNAYFLIP_PLACE_TESTS_H

#include "ExactPredicates.h"
#include "FilteredPredicates.h"

#include <cmath>
#include <cstdint>

/// @file
/// The exact tests of divide and conquer.

namespace delaunayflip
{

struct Place
{
  double U, V;
  std::uint32_t Number;
};

/// The directed edge between two sets on which the next triangle is made. Coordinates are relative
/// to its origin, so that one test can use what an earlier one has computed.
struct Base
{
  std::uint32_t From, To; ///< Places.
  PlanePoint Origin;
  double U, V, Square; ///< The offset of the destination, and its squared length.
};

/// A place beside a base.
struct PlaceBeside
{
  std::uint32_t At;
  double U, V, Square; ///< The offset from the base's origin, and its squared length.
  double Side; ///< Twice the area of the triangle with the base; > 0 if the place is on the left.
  double Magnitude; ///< The sum of the magnitudes of the two products of Side.
};

/// Signs by filtered arithmetic, and by exact arithmetic where the filter cannot decide.
struct PlaceTests
{
  explicit PlaceTests(const Place* places)
    : Places(places)
  {
  }

  PlanePoint GetPoint(std::uint32_t place) const
  {
    return { this->Places[place].U, this->Places[place].V, 0.0 };
  }

  /// 1: counter-clockwise; -1: clockwise; 0: in one line.
  int Orient(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    const PlanePoint points[3] = { this->GetPoint(a), this->GetPoint(b), this->GetPoint(c) };
    const int sign = FilteredOrientation(points[0], points[1], points[2]);
    if (sign != UncertainSign && this->FiltersApply)
    {
      return sign;
    }
    return this->DecideSide(a, b, c);
  }

  Base MakeBase(std::uint32_t from, std::uint32_t to) const
  {
    const PlanePoint origin = this->GetPoint(from);
    const double u = this->Places[to].U - origin.U, v = this->Places[to].V - origin.V;
    return { from, to, origin, u, v, u * u + v * v };
  }

  PlaceBeside See(const Base& base, std::uint32_t place) const
  {
    const double u = this->Places[place].U - base.Origin.U;
    const double v = this->Places[place].V - base.Origin.V;
    const double first = base.U * v, second = base.V * u;
    return { place, u, v, u * u + v * v, first - second, std::fabs(first) + std::fabs(second) };
  }

  /// Whether the place is to the right of the base. As in IsInCircle, filters decide nearly always,
  /// so that the branch is predicted.
  bool IsOnRight(const Base& base, const PlaceBeside& place) const
  {
    if (std::fabs(place.Side) > GetBound(OrientationBound * place.Magnitude) && this->FiltersApply)
    {
      return place.Side < 0.0;
    }
    return this->DecideSide(base.From, base.To, place.At) < 0;
  }

  /// Whether `d` is in the circle through the ends of the base and `c`. The determinant is that of
  /// FilteredInCircle, relative to the origin of the base.
  bool IsInCircle(const Base& base, const PlaceBeside& c, const PlaceBeside& d) const
  {
    const double first = c.U * d.V, second = c.V * d.U;
    const double value = base.Square * (first - second) - c.Square * d.Side + d.Square * c.Side;
    const double magnitude = base.Square * (std::fabs(first) + std::fabs(second)) +
      c.Square * d.Magnitude + d.Square * c.Magnitude;
    if (std::fabs(value) > GetBound(InCircleBound * magnitude) && this->FiltersApply)
    {
      return value > 0.0;
    }
    return this->DecideInCircle(base.From, base.To, c.At, d.At);
  }

  const Place* Places;
  bool FiltersApply = true;

private:
  // What is needed seldom is not inlined, so that it takes no registers.
  DELAUNAYFLIP_NO_INLINE int DecideSide(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    return ExactOrientation(this->GetPoint(a), this->GetPoint(b), this->GetPoint(c));
  }
  DELAUNAYFLIP_NO_INLINE bool DecideInCircle(
    std::uint32_t from, std::uint32_t to, std::uint32_t c, std::uint32_t d) const
  {
    const PlanePoint points[4] = { this->GetPoint(to), this->GetPoint(from), this->GetPoint(c),
      this->GetPoint(d) };
    return ExactInCircle(points, false) > 0;
  }
};

}

#endif
