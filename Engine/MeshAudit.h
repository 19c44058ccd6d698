// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHAUDIT_H
#define DELAUNAYFLIP_MESHAUDIT_H

#include "EngineExport.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

#include <cstdint>

/// @file
/// The invariants of a triangle mesh as functions, computed from the triangles alone (by sorting
/// vertex pairs), so that they check the flip engine from outside.

namespace delaunayflip
{

/// Edges by the number and direction of their incident triangles; the kinds that depend on options
/// or on the caller (Feature, Constraint, Region, Fixed) are 0.
DELAUNAYFLIP_EXPORT EdgeCounts CountEdges(const TriangleArray& triangles);

/// Used points - edges + triangles.
DELAUNAYFLIP_EXPORT std::int64_t EulerCharacteristic(const TriangleArray& triangles);

/// Vertex pairs that are an edge of `after` more often than of `before` and belong to three or more
/// triangles there: what flips without a duplicate-edge guard produce. 0 after a correct run.
DELAUNAYFLIP_EXPORT std::int64_t CountDuplicateEdgesGained(
  const TriangleArray& before, const TriangleArray& after);

/// Edges of two consistently wound triangles that violate the criterion: in-circle, exactly, in
/// planar geometry, the opposite-angle sum on surfaces and with CriterionKind::OppositeAngles.
/// Constraint, region, frozen and feature edges of `mesh` (judged on `mesh` itself) do not count.
/// GeometryKind::Auto is resolved as a run does.
DELAUNAYFLIP_EXPORT std::int64_t CountNonDelaunayEdges(
  const TriangleMesh& mesh, const FlipOptions& options);

/// Smallest angle of any triangle in degrees, in space or (PlanarXY) in the projection; NaN without
/// triangles, 0 with a degenerate one; triangles with NaN or infinite coordinates do not count.
DELAUNAYFLIP_EXPORT double MinimumAngle(const TriangleMesh& mesh, GeometryKind geometry);

}

#endif
