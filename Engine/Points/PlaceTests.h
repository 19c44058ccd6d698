// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLACE_TESTS_H
#define DELAUNAYFLIP_PLACE_TESTS_H

#include "DivideAndConquer.h"
#include "ExactPredicates.h"
#include "FilteredPredicates.h"

#include <cmath>
#include <cstdint>

/// @file
/// The exact tests of divide and conquer.

namespace delaunayflip
{

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
};

/// Signs by filtered arithmetic, and by exact arithmetic where the filter cannot decide. What is
/// inlined has a coarser bound that is found faster: the magnitudes of the products of two offsets
/// sum up to half of the sum of their squares at most. It decides nearly always, so that its branch
/// is predicted.
struct PlaceTests
{
  explicit PlaceTests(const NumberedPlace* places)
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

  /// From the same origin to another place.
  Base MakeBase(const Base& base, const PlaceBeside& to) const
  {
    return { base.From, to.At, base.Origin, to.U, to.V, to.Square };
  }

  PlaceBeside See(const Base& base, std::uint32_t place) const
  {
    const double u = this->Places[place].U - base.Origin.U;
    const double v = this->Places[place].V - base.Origin.V;
    return { place, u, v, u * u + v * v, base.U * v - base.V * u };
  }

  /// Whether the place is to the right of the base.
  bool IsOnRight(const Base& base, const PlaceBeside& place) const
  {
    const double squares = base.Square + place.Square;
    if (std::fabs(place.Side) > GetBound(this->SideBound * squares))
    {
      return place.Side < 0.0;
    }
    return this->FindSide(base.From, base.To, place.At) < 0;
  }

  /// Whether `d` is in the circle through the ends of the base and `c`. The determinant is that of
  /// FilteredInCircle, relative to the origin of the base.
  bool IsInCircle(const Base& base, const PlaceBeside& c, const PlaceBeside& d) const
  {
    const double value =
      base.Square * (c.U * d.V - c.V * d.U) - c.Square * d.Side + d.Square * c.Side;
    const double magnitude = base.Square * (c.Square + d.Square) + c.Square * d.Square;
    if (std::fabs(value) > GetBound(this->CircleBound * magnitude))
    {
      return value > 0.0;
    }
    return this->DecideInCircle(base.From, base.To, c.At, d.At);
  }

  /// Leaves all decisions to exact arithmetic.
  void StopFilters()
  {
    this->FiltersApply = false;
    this->SideBound = this->CircleBound = INFINITY;
  }

private:
  // What is needed seldom is not inlined, so that it takes no registers.
  DELAUNAYFLIP_NO_INLINE int FindSide(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    return this->Orient(a, b, c);
  }
  DELAUNAYFLIP_NO_INLINE int DecideSide(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    const PlanePoint points[3] = { this->GetPoint(a), this->GetPoint(b), this->GetPoint(c) };
    const auto areEqual = [&](double PlanePoint::*axis)
    { return points[0].*axis == points[1].*axis && points[1].*axis == points[2].*axis; };
    if (areEqual(&PlanePoint::U) || areEqual(&PlanePoint::V)) // as in rows
    {
      return 0;
    }
    return ExactOrientation(points[0], points[1], points[2]);
  }
  DELAUNAYFLIP_NO_INLINE bool DecideInCircle(
    std::uint32_t from, std::uint32_t to, std::uint32_t c, std::uint32_t d) const
  {
    const PlanePoint points[4] = { this->GetPoint(to), this->GetPoint(from), this->GetPoint(c),
      this->GetPoint(d) };
    const int sign = FilteredInCircle(points[0], points[1], points[2], points[3]);
    if (sign != UncertainSign && this->FiltersApply)
    {
      return sign > 0;
    }
    return ExactInCircle(points, false) > 0;
  }

  const NumberedPlace* Places;
  bool FiltersApply = true;
  /// They bound errors, relative to sums and products of squares.
  double SideBound = 0.5 * OrientationBound, CircleBound = InCircleBound;
};

}

#endif
