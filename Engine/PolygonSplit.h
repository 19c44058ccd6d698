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

namespace delaunayflip
{

/// Splits one polygon of `count` >= 3 vertices into triangles that keep its winding, and appends
/// their vertex ids, three each, to `triangles`. Of more than three vertices, those that repeat the
/// one before them are dropped first, and the last ones if they repeat the first: triangles are
/// often written as quads, and rings closed by their first point. If n vertices are left there are
/// n - 2 triangles, or none if n < 3. Three vertices are one triangle, as given.
/// A quad is divided along its 0-2 diagonal;
/// along 1-3 if 0-2 runs outside it, or if only along 0-2 the normals of its two triangles have no
/// positive dot product: they fold. A larger polygon becomes a fan from its first vertex if it
/// is convex; else its ears are clipped. Works in the plane of the polygon's area vector. A polygon
/// that crosses itself or has no area still gives n - 2 triangles (a fan).
/// @param ids the polygon's vertex ids, valid indices into `points`.
/// @param progress told the share of this polygon; called about every millisecond while ears are
/// clipped.
/// @returns false if `progress` returned false; then nothing is appended.
DELAUNAYFLIP_EXPORT bool SplitPolygon(const PointArray& points, const std::int64_t* ids,
  std::int64_t count, std::vector<std::int64_t>& triangles, const ProgressObserver& progress = {});

/// The unit normal of a triangle by the right-hand rule; (0, 0, 0) for a triangle without area.
DELAUNAYFLIP_EXPORT void TriangleNormal(
  const PointArray& points, const std::int64_t ids[3], double normal[3]);

}

#endif
