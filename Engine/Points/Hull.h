// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULL_H
#define DELAUNAYFLIP_HULL_H

#include "Mountains.h"

#include <cstdint>
#include <vector>

/// @file
/// The third part of a triangulation of points: what lies between the outermost chains and
/// diagonals and the convex hull.
///
/// The parts of the outer boundary are the lowest chain, the highest one, and the two ends of every
/// gap. First the chains of each part are cut into short pieces, which are filled alone, on a
/// backend: of a ring, half of the points are in them. What is left is short, so the host does the
/// rest for every backend. It fills each part alone. Then the whole boundary rises from its lowest
/// point to its highest and falls back, so that cutting ears along all of it ends at the convex
/// hull. Without filling the parts first that is not valid: triangles would overlap.

namespace delaunayflip
{

/// A part of the outer boundary, which is counter-clockwise: places of a chain and, joined to them
/// by a diagonal, perhaps one of another chain.
struct BoundaryPart
{
  std::uint32_t First, Last; ///< Of the chain.
  bool Rises; ///< Whether the boundary goes from First to Last, so that it is below the chain.
  bool OtherIsFirst;
  std::uint32_t Other = NoVertex;
  CornerId Diagonal = NoCorner; ///< Its label.
};

/// @param starts, gaps as in ChainView.
std::vector<BoundaryPart> ListBoundary(
  const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps);

/// Cuts the chains of all parts into pieces.
std::vector<BoundaryPiece> CutIntoPieces(const std::vector<BoundaryPart>& parts);

/// The outer boundary.
struct Boundary
{
  std::vector<std::uint32_t> Places;
  std::vector<CornerId> Labels; ///< Of the edge before each place in its part.
  std::vector<std::size_t> PartEnds; ///< A part begins with the place where the one before ends.
};

/// The boundary after its pieces have been filled.
/// @param left of all pieces.
Boundary JoinPieces(
  const std::vector<BoundaryPart>& parts, const std::vector<LabelledVertex>& left);

/// The triangles outside of all mountains and pieces.
struct HullTriangles
{
  /// Vertices are places, half-edges are labels of the edges, corners as in the whole mesh.
  std::vector<TriangleRecord> Triangles;
  std::int64_t HullEdges = 0;
};

/// @param places the coordinates of boundary.Places.
/// @param firstTriangle the number of the first triangle to make.
HullTriangles FillHull(const Boundary& boundary, const std::vector<CoordinatePair<double>>& places,
  TriangleId firstTriangle);

}

#endif
