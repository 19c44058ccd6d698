// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYWRITER_H
#define DELAUNAYFLIP_PLYWRITER_H

#include "FileMesh.h"
#include "PlyPlan.h"

namespace delaunayflip
{

/// Writes points, polygons, lines as edges, and all arrays that properties can hold, in binary.
/// Points that were repeated for a texture become one vertex again, with `texcoord` of the corners.
/// @throws CommandError (BadFile).
void WritePly(const FileMesh& file, const std::string& path);

/// How the point data and the data of the polygons are written. In `mesh`, cell data have the order
/// verts, lines, polygons.
PlyPlan PlanPlyVertices(vtkPolyData* mesh);
PlyPlan PlanPlyFaces(vtkPolyData* mesh);

}

#endif
