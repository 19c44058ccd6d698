// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CGALDELAUNAY_H
#define DELAUNAYFLIP_CGALDELAUNAY_H

#include "GeneratedMeshes.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

struct CgalTime
{
  double Seconds; ///< For inserting the points as a range, without copying them to CGAL's type.
  std::int64_t Triangles;
};

/// Times CGAL's Delaunay_triangulation_2, with exact predicates, of a mesh's points. Inserting a
/// range is CGAL's fastest way, because it sorts the points in space first.
CgalTime TimeCgalDelaunay(const OwnedMesh<float>& mesh);

/// The triangles of that triangulation: three ids each.
std::vector<std::int32_t> MakeCgalTriangles(const OwnedMesh<float>& mesh);

}

#endif
