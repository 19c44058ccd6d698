// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTriangulation.h"

#include "PortableMath.h"

#include <cmath>

namespace delaunayflip
{

namespace
{
constexpr double Pi = 3.14159265358979323846;

/// Finds the sine and the cosine of an angle in degrees. They are exact at multiples of 90, because
/// the angle is first reduced by such multiples, without rounding.
void TurnByDegrees(double degrees, double& sine, double& cosine)
{
  const double turned = std::fmod(degrees, 360.0);
  const double quarters = std::floor(turned / 90.0 + 0.5);
  const double rest = (turned - 90.0 * quarters) * (Pi / 180.0);
  const auto [first, second] = FindSineAndCosine(rest);
  switch (static_cast<int>(quarters) & 3)
  {
    case 0:
      sine = first;
      cosine = second;
      break;
    case 1:
      sine = second;
      cosine = -first;
      break;
    case 2:
      sine = -first;
      cosine = -second;
      break;
    default:
      sine = -second;
      cosine = first;
  }
}
}

void PlaceOnSphere(double longitude, double latitude, double xyz[3])
{
  double sine = 0.0, cosine = 0.0, ofEast = 0.0, toPole = 0.0;
  TurnByDegrees(longitude, sine, cosine);
  TurnByDegrees(latitude, toPole, ofEast);
  xyz[0] = ofEast * cosine + 0.0; // never -0.0
  xyz[1] = ofEast * sine + 0.0;
  xyz[2] = toPole + 0.0;
}

}
