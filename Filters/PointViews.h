// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointViews_h
#define PointViews_h

#include "TriangleMesh.h"

#include <vector>

class vtkPolyData;

namespace delaunayflip
{

/// The points in place where they lie as the engine wants them, else a copy in `storage`.
PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage);

/// Whether both are as many and have the same bits.
bool HaveSameBits(const PointArray& points, const PointArray& others);

}

#endif
