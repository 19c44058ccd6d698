// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "Predicates.h"

#include "ExactPredicates.h"

namespace delaunayflip
{

namespace
{
int DecideInCircle(const PlanePoint (&points)[4], bool tilted)
{
  bool inRange = true, finite = true;
  for (const PlanePoint& p : points)
  {
    inRange = inRange && IsInFilterRange(p) && std::fabs(p.W) <= LargestFilteredCoordinate;
    finite = finite && IsFinite(p);
  }
  if (inRange)
  {
    const auto filter = tilted ? FilteredInCircleTilted : FilteredInCircle;
    const int sign = filter(points[0], points[1], points[2], points[3]);
    if (sign != UncertainSign)
    {
      return sign;
    }
  }
  return finite ? ExactInCircle(points, tilted) : 0;
}
}

int Orientation(const double a[2], const double b[2], const double c[2])
{
  const PlanePoint points[3] = { { a[0], a[1], 0.0 }, { b[0], b[1], 0.0 }, { c[0], c[1], 0.0 } };
  const bool finite = IsFinite(points[0]) && IsFinite(points[1]) && IsFinite(points[2]);
  return finite ? FindOrientation(points[0], points[1], points[2]) : 0;
}

int InCircle(const double a[2], const double b[2], const double c[2], const double d[2])
{
  return DecideInCircle(
    { { a[0], a[1], 0.0 }, { b[0], b[1], 0.0 }, { c[0], c[1], 0.0 }, { d[0], d[1], 0.0 } }, false);
}

int InCircleTilted(const double a[3], const double b[3], const double c[3], const double d[3])
{
  return DecideInCircle(
    { { a[0], a[1], a[2] }, { b[0], b[1], b[2] }, { c[0], c[1], c[2] }, { d[0], d[1], d[2] } },
    true);
}

}
