// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTriangulation.h"

#include "SphereMesh.h"

namespace delaunayflip
{

void PlaceOnSphere(double longitude, double latitude, double xyz[3])
{
  const PlanePoint place = FindPlaceOnSphere(longitude, latitude);
  xyz[0] = place.U;
  xyz[1] = place.V;
  xyz[2] = place.W;
}

}
