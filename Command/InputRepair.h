// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_INPUTREPAIR_H
#define DELAUNAYFLIP_INPUTREPAIR_H

#include "MeshFiles.h"

#include <string>

/// @file
/// What is done to an input on request, before it is flipped: defects that keep edges from flipping
/// are removed.

namespace delaunayflip
{

/// A mesh that has been repaired.
struct RepairedMesh
{
  FileMesh Result;
  std::string Note; ///< What was done, for the user.
};

/// Joins the points of a mesh that lie at the same place, and leaves out those that no cell has. A
/// point has the data of the first of those that it was. Polygons with fewer than three different
/// corners are left out: they have collapsed. A polygon of more than three corners has corners that
/// are the same as the one before them only once.
RepairedMesh MergeEqualPoints(vtkPolyData* mesh);

/// Leaves out triangles and polygons with the corners of an earlier one, in the same order or
/// backwards, as on the two sides of a thin part. Strips become triangles.
RepairedMesh DropDuplicates(vtkPolyData* mesh);

/// Turns triangles and polygons over so that those on two sides of an edge are wound the same way.
/// In each connected part the fewer ones are turned over. Strips become triangles.
RepairedMesh Orient(vtkPolyData* mesh);

}

#endif
