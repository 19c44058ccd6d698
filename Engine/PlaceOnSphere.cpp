// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTriangulation.h"

#include "SphereMesh.h"

#include <algorithm>
#include <cmath>

namespace delaunayflip
{

void PlaceOnSphere(double longitude, double latitude, double xyz[3])
{
  if (!std::isfinite(longitude) || !std::isfinite(latitude))
  {
    std::fill_n(xyz, 3, NAN);
    return;
  }
  const PlanePoint place = FindPlaceOnSphere(longitude, latitude);
  xyz[0] = place.U;
  xyz[1] = place.V;
  xyz[2] = place.W;
}

}
