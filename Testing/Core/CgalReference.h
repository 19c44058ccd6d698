// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CGALREFERENCE_H
#define DELAUNAYFLIP_CGALREFERENCE_H

#include "FlipTestSupport.h"

/// @file
/// CGAL as the reference for planar results, in x and y.

namespace delaunayflip
{

/// Delaunay triangulation of all points, which must be distinct. Ties are broken by CGAL's symbolic
/// perturbation.
TriangleSet MakeCgalDelaunay(const PointArray& points);

/// Constrained Delaunay triangulation. Constraints must meet only at points. Ties are left as CGAL
/// happens to decide them.
TriangleSet MakeCgalConstrainedDelaunay(const TriangleMesh& mesh);

/// Edges of two triangles that CGAL's exact in-circle predicate rejects, for counter-clockwise
/// meshes without degenerate triangles.
std::int64_t CountCgalViolations(const TriangleMesh& mesh);

/// A valid but bad triangulation of the convex hull of distinct points, which are inserted in the
/// order of x without regard to shape. z is 0.
OwnedMesh<double> MakeSweptMesh(const std::vector<std::array<double, 2>>& points);

}

#endif
