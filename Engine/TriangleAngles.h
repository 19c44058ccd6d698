// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_TRIANGLEANGLES_H
#define DELAUNAYFLIP_TRIANGLEANGLES_H

#include "EngineExport.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "TriangleMesh.h"

/// @file
/// Looks at the triangles of a mesh one by one: at their point ids and their quality.
///
///     const double xyz[] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
///     const std::int32_t ids[] = { 0, 1, 2 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 3);
///     mesh.Triangles = TriangleArray(ids, 1);
///     RequireValidIds(mesh);
///     double degrees;
///     FindSmallestAngles(mesh, GeometryKind::Surface, 1, &degrees);
///     std::round(degrees); // 45.0

namespace delaunayflip
{

/// @throws InvalidMesh when a triangle names a point that does not exist.
DELAUNAYFLIP_EXPORT void RequireValidIds(const TriangleMesh& mesh);

/// Writes the smallest angle of every triangle in degrees, 0 to 60: mesh.Triangles.Count numbers.
/// It is 0 for a triangle without area, and NaN for one with a coordinate that is NaN or infinite.
/// @param mesh the points and triangles; nothing else of it matters.
/// @param geometry PlanarXY measures in the projection, all others in space.
/// @param threads the number of threads; 0: as many as the machine has. The result does not depend
/// on it.
/// @throws InvalidMesh when a triangle names a point that does not exist; RunAborted.
DELAUNAYFLIP_EXPORT void FindSmallestAngles(const TriangleMesh& mesh, GeometryKind geometry,
  int threads, double* degrees, const ProgressObserver& progress = {});

}

#endif
