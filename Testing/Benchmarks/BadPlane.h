// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_BADPLANE_H
#define DELAUNAYFLIP_BADPLANE_H

#include "GeneratedMeshes.h"

#include <cmath>

namespace delaunayflip
{

/// The largest mesh, in points, that is made in one piece; larger ones are tiled.
constexpr std::int64_t LargestUntiledMesh = 5000000;

/// A random bad mesh of any size.
inline OwnedMesh<float> MakePlaneMesh(std::int64_t points)
{
  constexpr std::uint32_t Seed = 2013;
  constexpr double PointsOfTile = 250000.0;
  const double tiles = static_cast<double>(points) / PointsOfTile;
  return points <= LargestUntiledMesh
    ? MakeRandomBadMesh(points, Seed)
    : MakeTiledBadMesh(points, static_cast<std::int32_t>(std::ceil(std::sqrt(tiles))), Seed);
}

}

#endif
