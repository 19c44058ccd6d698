// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OBJWRITER_H
#define DELAUNAYFLIP_OBJWRITER_H

#include "FileMesh.h"

namespace delaunayflip
{

/// Writes points, lines, polygons and verts, and what ObjPlan holds. Points that were repeated for
/// a texture become one vertex again.
/// @throws CommandError (BadFile).
void WriteObj(const FileMesh& file, const std::string& path);

}

#endif
