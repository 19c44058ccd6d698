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
/// The invariants of a triangle mesh as functions. They are computed from the triangles alone, by
/// sorting vertex pairs, and so check the flip engine independently.
///
///     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     CountEdges(mesh.Triangles).Boundary; // 4
///     EulerCharacteristic(mesh.Triangles); // 1
///     CountNonDelaunayEdges(mesh, {}); // 1
///     FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, 2));
///     CountNonDelaunayEdges(mesh, {}); // 0

namespace delaunayflip
{

/// Counts edges by the number and direction of their incident triangles, without those triangles
/// that name a point twice. The kinds that depend on options or on the caller (Feature, Constraint,
/// Region, Fixed) are 0.
DELAUNAYFLIP_EXPORT EdgeCounts CountEdges(const TriangleArray& triangles);

/// Used points - edges + triangles that name no point twice.
DELAUNAYFLIP_EXPORT std::int64_t EulerCharacteristic(const TriangleArray& triangles);

/// Counts edges with three or more triangles in `after` and fewer in `before`, such as flips
/// without a guard would make. 0 after a correct run.
DELAUNAYFLIP_EXPORT std::int64_t CountDuplicateEdgesGained(
  const TriangleArray& before, const TriangleArray& after);

/// Counts bad edges: edges of two consistently wound triangles that violate the criterion, which is
/// the exact in-circle predicate in planar geometry, and the opposite-angle sum on surfaces and
/// with CriterionKind::OppositeAngles. On a sphere it is the exact orientation of four points.
/// Constraint edges, region borders, edges of frozen triangles, and feature edges of `mesh` itself
/// do not count. Ties do not count either, although with TieRuleKind::Canonical a report counts
/// those that are blocked. GeometryKind::Auto chooses as in a run.
DELAUNAYFLIP_EXPORT std::int64_t CountNonDelaunayEdges(
  const TriangleMesh& mesh, const FlipOptions& options);

/// The smallest angle of all triangles in degrees, in space or, with PlanarXY, in the projection.
/// NaN without triangles; 0 if a triangle has no area. Triangles with NaN or infinite coordinates
/// do not count.
DELAUNAYFLIP_EXPORT double MinimumAngle(const TriangleMesh& mesh, GeometryKind geometry);

}

#endif
