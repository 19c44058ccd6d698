// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HULL_H
#define DELAUNAYFLIP_HULL_H

#include "Mountains.h"

#include <cstdint>
#include <vector>

/// @file
/// The third step of a triangulation of points fills what lies between the outermost chains and
/// diagonals and the convex hull.
///
/// The sections of the outer boundary are the lowest chain, the highest one, and the two ends of
/// every gap. First the chain of each section is cut into short stretches, which are filled alone,
/// on a backend. Where the points are a ring, half of them are in stretches. What is left is short,
/// so the host does the rest for every backend. It fills each section alone. Then the whole
/// boundary rises from its lowest point to its highest and falls back, so that cutting ears along
/// all of it ends at the convex hull. Triangles would overlap if the sections were not filled
/// first.

namespace delaunayflip
{

/// A section of the outer boundary, which runs counter-clockwise. It has places of one chain. A
/// diagonal may join them to one place of another chain.
struct BoundarySection
{
  std::uint32_t First, Last; ///< The places of the chain.
  bool Rises; ///< Whether the boundary goes from First to Last, so that it is below the chain.
  bool OtherIsFirst; ///< Whether the boundary reaches Other before the places of the chain.
  std::uint32_t Other = NoVertex; ///< The place of the other chain, if there is one.
  CornerId Diagonal = NoCorner; ///< The label of the diagonal.
};

/// @param starts, gaps as in ChainView.
std::vector<BoundarySection> ListBoundary(
  const std::vector<std::uint32_t>& starts, const std::vector<Gap>& gaps);

/// Cuts the chains of all sections into stretches.
std::vector<BoundaryStretch> CutIntoStretches(const std::vector<BoundarySection>& sections);

/// The outer boundary.
struct Boundary
{
  std::vector<std::uint32_t> Places;
  std::vector<CornerId> Labels; ///< By place: the label of the edge before it in its section.
  /// A section begins with the place where the one before ends.
  std::vector<std::size_t> SectionEnds;
};

/// The boundary after its stretches have been filled.
/// @param left what is left of all stretches.
Boundary JoinStretches(
  const std::vector<BoundarySection>& sections, const std::vector<LabelledVertex>& left);

/// The triangles outside of all mountains and stretches.
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
