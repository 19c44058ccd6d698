// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_HEIGHTFIELD_H
#define DELAUNAYFLIP_HEIGHTFIELD_H

class vtkPolyData;

namespace delaunayflip
{

/// Whether all triangles of `mesh` turn the same way when seen along z, none of them edge-on: then
/// the mesh may be a terrain. False without triangles and with cells of more corners.
bool IsHeightField(vtkPolyData* mesh);

}

#endif
