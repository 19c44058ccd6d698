// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULL_H
#define DELAUNAYFLIP_HULL_H

#include "Mountains.h"

#include <cstdint>
#include <vector>

/// @file
/// The third part of a triangulation of points: what lies between the outermost chains and
/// diagonals and the convex hull. For uniform points that is a path of about 6 sqrt(n) points, so
/// the host does it, for every backend.
///
/// First each part of the outer boundary is filled alone: the lowest chain, the highest one, and
/// the two ends of every gap. Then the whole boundary rises from its lowest point to its highest
/// and falls back, so that cutting ears along all of it ends at the convex hull. Without the first
/// pass that is not valid: triangles would overlap.

namespace delaunayflip
{

/// Names a side of an open edge: word 2 * place + side of the edges of chains, or, complemented,
/// word 2 * slot + side of the diagonals.
using SideWord = std::int64_t;

/// The outer boundary, counter-clockwise.
struct Boundary
{
  std::vector<std::uint32_t> Places;
  std::vector<SideWord> SideAfter; ///< Of the edge from each place to the next one of its part.
  std::vector<std::size_t> PartEnds; ///< A part begins with the place where the one before ends.
};

/// @param starts, gaps as in ChainView.
Boundary ListBoundary(const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps);

/// The triangles outside all mountains.
struct HullTriangles
{
  std::vector<TriangleRecord> Triangles; ///< Vertices are places, corners as in the whole mesh.
  std::vector<SideWord> Sides; ///< The open edges that got a triangle,
  std::vector<CornerId> Corners; ///< and its corner there.
  std::int64_t HullEdges = 0;
};

/// @param places the coordinates of boundary.Places.
/// @param firstTriangle the number of the first triangle to make.
HullTriangles FillHull(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places,
  std::int64_t firstTriangle);

}

#endif
