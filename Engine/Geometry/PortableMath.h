// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PORTABLEMATH_H
#define DELAUNAYFLIP_PORTABLEMATH_H

#include "HostDevice.h"

#include <algorithm>
#include <cmath>

/// @file
/// What decisions take instead of the functions of the C library, since their last bits differ
/// between systems and between releases. Angles are for the host only.

namespace delaunayflip
{

/// Correctly rounded, except perhaps where the exact value is within 2^-110 of the middle of two
/// doubles. These take microseconds: they are for options, not for points.
double Sine(double radians);
double Cosine(double radians);
double Tangent(double radians);

struct SineAndCosine
{
  double Sine, Cosine;
};

/// For points. Both errors are below 0.501 units in the last place. @param radians from -pi/4 to
/// pi/4.
SineAndCosine FindSineAndCosine(double radians);

/// sqrt(larger^2 + smaller^2), where neither square overflows or underflows. A step of Newton's
/// method follows, with the residual from differences that are exact or nearly so: Borges, "An
/// Improved Algorithm for hypot(a,b)", 2019.
DELAUNAYFLIP_HOST_DEVICE inline double FindHypotenuse(double larger, double smaller)
{
  const double first = std::sqrt(larger * larger + smaller * smaller);
  double residual = 0.0;
  if (first <= 2.0 * smaller)
  {
    const double delta = first - smaller;
    residual = larger * (2.0 * delta - larger) + (delta - 2.0 * (larger - smaller)) * delta;
  }
  else
  {
    const double delta = first - larger;
    const double inner = (4.0 * delta - smaller) * smaller + delta * delta;
    residual = 2.0 * delta * (larger - 2.0 * smaller) + inner;
  }
  return first - residual / (2.0 * first);
}

/// The length of a vector that is not NaN, without overflow or underflow on the way. The error is
/// below one unit in the last place.
DELAUNAYFLIP_HOST_DEVICE inline double PlaneLength(double x, double y)
{
  constexpr double Largest = 0x1p511, Smallest = 0x1p-459, Step = 0x1p600;
  const double larger = std::max(std::fabs(x), std::fabs(y));
  const double smaller = std::min(std::fabs(x), std::fabs(y));
  if (!(larger <= 0x1.fffffffffffffp1023) || smaller <= 0x1p-54 * larger)
  {
    return larger + smaller; // also infinity and zero
  }
  if (larger > Largest)
  {
    return FindHypotenuse(larger / Step, smaller / Step) * Step;
  }
  if (smaller < Smallest)
  {
    return FindHypotenuse(larger * Step, smaller * Step) / Step;
  }
  return FindHypotenuse(larger, smaller);
}

}

#endif
