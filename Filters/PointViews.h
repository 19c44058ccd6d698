// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointViews_h
#define PointViews_h

#include "TriangleMesh.h"

#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// A view of the points if the engine can read their layout, else of a copy in `storage`.
/// @throws InvalidMesh if points do not have three coordinates.
PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage);

/// Whether both have the same number of points and the same bits.
bool HaveSameBits(const PointArray& points, const PointArray& others);

}

#endif
