// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConstraintEdges_h
#define ConstraintEdges_h

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// Pairs of point ids, the smaller first, ascending, none twice.
using ConstraintEdges = std::vector<std::array<std::int64_t, 2>>;

/// The edges along the lines of `mesh` (unless null) and along the lines and polygons of
/// `constraints` (unless null), whose ids are those of the mesh's points.
/// @throws InvalidMesh when one names a point outside 0 .. numberOfPoints - 1.
ConstraintEdges CollectConstraintEdges(
  vtkPolyData* mesh, vtkPolyData* constraints, vtkIdType numberOfPoints);

}

#endif
