// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERERINGS_H
#define DELAUNAYFLIP_SPHERERINGS_H

#include "Outline.h"
#include "SphereSegments.h"
#include "SphereStart.h"

#include <cstdint>
#include <vector>

/// @file
/// Finds the triangles on a sphere that do not belong to the result, because of rings and seeds.
///
/// On a sphere a ring has two sides, and no place is infinitely far away. The inside of a ring is
/// the smaller one of its sides, or the one to its left with RingRuleKind::Orientation.

namespace delaunayflip
{

/// Triangles that face away from the origin, and edges of segments.
struct SphereMeshView
{
  const SpacePoints& Points;
  const std::vector<std::int32_t>& Triangles;
  const std::vector<std::int32_t>& Neighbors; ///< The list of FindNeighbors.
  const std::vector<SphereEdge>& Edges;
};

/// @param rings by segment, its ring or -1.
/// @param kept receives which rings are left out.
/// @returns by triangle, whether it is inside the holes or not inside the outline.
std::vector<unsigned char> FindOutside(const SphereMeshView& mesh,
  const std::vector<std::int32_t>& rings, std::int32_t firstHole, RingRuleKind rule,
  KeptTriangles& kept);

/// Removes what can be reached from places without crossing a segment.
/// @param isRemoved by triangle. @returns how many of the places are in no triangle.
std::int64_t RemoveAround(const SphereMeshView& mesh, const std::vector<PlanePoint>& seeds,
  std::vector<unsigned char>& isRemoved);

}

#endif
