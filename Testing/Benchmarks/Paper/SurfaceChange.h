// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SURFACECHANGE_H
#define DELAUNAYFLIP_SURFACECHANGE_H

#include "FlipOptions.h"
#include "GeneratedMeshes.h"

#include <cstdint>
#include <vector>

/// @file
/// What flips have changed on a closed surface, and which bad edges they have left.

namespace delaunayflip
{

/// How far a surface is from another one over the same points.
struct SurfaceChange
{
  double Distance = 0.0; ///< See MeasureChange; relative to the bounding box's diagonal.
  double Volume = 0.0; ///< Change of the enclosed volume, relative to that of the first surface.
};

/// The distance is the largest one from the middle of an edge that only one of the surfaces has to
/// the other surface.
SurfaceChange MeasureChange(
  const OwnedMesh<double>& before, const std::vector<std::int32_t>& after);

/// Bad edges of a result, by the first reason that applies.
struct ViolationReasons
{
  std::int64_t Fixed = 0; ///< Feature, non-manifold or boundary edges of the input.
  std::int64_t Duplicate = 0; ///< The flip would make an edge that exists.
  std::int64_t Fold = 0; ///< The flip would fold the surface over.
  std::int64_t Other = 0;
};

/// @param options with which `before` was flipped.
/// @param tolerance in radians, of the opposite-angle sum.
ViolationReasons FindReasons(const OwnedMesh<double>& before,
  const std::vector<std::int32_t>& after, const FlipOptions& options, double tolerance);

}

#endif
