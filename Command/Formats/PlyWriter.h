// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYWRITER_H
#define DELAUNAYFLIP_PLYWRITER_H

#include "PlyPlan.h"

class vtkPolyData;

namespace delaunayflip
{

/// Writes points, polygons, lines as edges, and all arrays that properties can hold, in binary.
/// @throws CommandError (BadFile).
void WritePly(vtkPolyData* mesh, const std::string& path);

/// How the point data and the data of the polygons are written. In `mesh`, cell data have the order
/// verts, lines, polygons.
PlyPlan PlanPlyVertices(vtkPolyData* mesh);
PlyPlan PlanPlyFaces(vtkPolyData* mesh);

}

#endif
