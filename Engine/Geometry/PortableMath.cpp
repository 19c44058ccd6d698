// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PortableMath.h"

#include "SineAndCosine.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cmath>

namespace delaunayflip
{

namespace
{
using Wide = boost::multiprecision::cpp_bin_float_quad; // of integers, so the same everywhere
}

double Sine(double radians) { return static_cast<double>(sin(Wide(radians))); }

double Cosine(double radians) { return static_cast<double>(cos(Wide(radians))); }

double Tangent(double radians) { return static_cast<double>(tan(Wide(radians))); }

SineAndCosine FindSineAndCosine(double radians)
{
  SineAndCosine found{};
  FindSineAndCosine(radians, found.Sine, found.Cosine);
  return found;
}

}
