// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTCHECKS_H
#define DELAUNAYFLIP_INPUTCHECKS_H

#include "FlipOptions.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <string>

namespace delaunayflip
{

/// @throws InvalidOptions for values out of range.
void CheckOptions(const FlipOptions& options);

/// @throws InvalidOptions if the tie rule does not apply to the geometry.
void CheckTieRule(const FlipOptions& options, GeometryKind geometry);

/// Whether options ask for refinement.
bool HasGoals(const FlipOptions& options);

/// Whether options, sizes of points or areas of regions ask for refinement.
bool HasGoals(const FlipOptions& options, const FixedEdges& mesh);

/// Whether a region has a largest area.
bool HasAreas(const RegionSeed* regions, std::int64_t count);

/// Checks the geometry and the criterion, if refinement is asked for, and the geometry for region
/// seeds.
/// @param isInXY whether geometry is planar in x and y.
/// @throws InvalidOptions.
void CheckRefinement(
  const FlipOptions& options, const FixedEdges& mesh, GeometryKind geometry, bool isInXY);

/// Checks that the sizes of points, if there are any, are above 0 or NaN. @throws InvalidOptions.
void CheckSizes(const double* sizes, std::int64_t points);

/// Checks that region seeds are finite, and their areas finite and not negative.
/// @throws InvalidOptions.
void CheckRegions(const RegionSeed* regions, std::int64_t count);

/// @param what cannot be refined, for the message.
/// @throws InvalidOptions if refinement or labels of regions are asked for.
void RefuseRefinement(const FlipOptions& options, const FixedEdges& mesh, const char* what);

/// @throws InvalidOptions if a mesh of this geometry must be flipped in one piece.
void RefuseParts(GeometryKind geometry);

/// In how many pieces a mesh is flipped.
/// @throws MeshTooLarge if it has too many triangles for these.
int CountPieces(const FlipOptions& options, std::int64_t triangles);

/// Throws MeshTooLarge if the mesh has too many triangles for 32-bit half-edges. Allocates nothing.
/// @param remedy the end of the message: where that is the limit, and what to do.
void CheckMeshSize(std::int64_t triangles, std::int64_t points,
  const char* remedy = "in one piece; flip the mesh in more pieces");

/// How many points can be added to a mesh before CheckMeshSize would refuse it. Each adds two
/// triangles.
std::int64_t CountPointsThatFit(std::int64_t triangles, std::int64_t points);

/// Throws MeshTooLarge if the triangulation of this many points may have too many triangles for
/// 32-bit half-edges.
void CheckPointCount(std::int64_t points);

/// Which points there are, for a message: "points 0 to 9" or "no points".
inline std::string DescribePoints(std::int64_t points)
{
  return points > 0 ? "points 0 to " + std::to_string(points - 1) : "no points";
}

}

#endif
