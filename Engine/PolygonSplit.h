// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_POLYGONSPLIT_H
#define DELAUNAYFLIP_POLYGONSPLIT_H

#include "EngineExport.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

/// @file
/// Splits polygons into triangles, without new points.
///
///     const double xyz[] = { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 };
///     const std::int64_t square[] = { 0, 1, 2, 3 };
///     const PointArray points(xyz, 4);
///     std::vector<std::int64_t> ids;
///     SplitPolygon(points, square, 4, ids);
///     ids == std::vector<std::int64_t>{ 0, 1, 2, 0, 2, 3 }; // true
///     double normal[3];
///     TriangleNormal(points, ids.data(), normal);
///     normal[2]; // 1.0

namespace delaunayflip
{

/// Splits one polygon of `count` >= 3 vertices into triangles that keep its winding, and appends
/// their vertex ids, three each, to `triangles`.
///
/// Three vertices are one triangle, as given. If there are more, but fewer than three different
/// ones, there is no triangle. Vertices that repeat the one before them are dropped first, and the
/// last ones if they repeat the first: triangles are often written as quads, and rings closed by
/// their first point. If n vertices are left there are n - 2 triangles.
///
/// A quad is divided along its 0-2 diagonal. It is divided along 1-3 if 0-2 runs outside it, or if
/// its two triangles fold, because their normals have no positive dot product, only along 0-2. A
/// larger polygon becomes a fan from its first vertex if it is convex. Otherwise its ears are
/// clipped, in the plane of the polygon's area vector. A polygon that crosses itself or has no area
/// still gives n - 2 triangles (a fan).
/// @param ids the polygon's vertex ids, valid indices into `points`.
/// @param progress receives the share of this polygon that is done. It is called about every
/// millisecond while ears are clipped.
/// @returns false if `progress` returned false; then nothing is appended.
DELAUNAYFLIP_EXPORT bool SplitPolygon(const PointArray& points, const std::int64_t* ids,
  std::int64_t count, std::vector<std::int64_t>& triangles, const ProgressObserver& progress = {});

/// The unit normal of a triangle by the right-hand rule; (0, 0, 0) for a triangle without area.
DELAUNAYFLIP_EXPORT void TriangleNormal(
  const PointArray& points, const std::int64_t ids[3], double normal[3]);

}

#endif
