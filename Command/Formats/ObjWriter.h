// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OBJWRITER_H
#define DELAUNAYFLIP_OBJWRITER_H

#include <string>

class vtkPolyData;

namespace delaunayflip
{

/// Writes points, lines, polygons and verts, and what ObjPlan holds.
/// @throws CommandError (BadFile).
void WriteObj(vtkPolyData* mesh, const std::string& path);

}

#endif
