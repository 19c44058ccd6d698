// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PORTABLEMATH_H
#define DELAUNAYFLIP_PORTABLEMATH_H

/// @file
/// What decisions take instead of the functions of the C library, whose last bits differ between
/// systems and between releases. On the host only.

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

/// The length of a vector that is not NaN, without overflow or underflow on the way. The error is
/// below one unit in the last place.
double PlaneLength(double x, double y);

}

#endif
