// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYREADER_H
#define DELAUNAYFLIP_PLYREADER_H

#include "FileMesh.h"
#include "InputFile.h"

namespace delaunayflip
{

/// Reads a .ply: vertices, faces, triangle strips and edges with all their scalar properties, and
/// texture coordinates of corners (the list texcoord). Other elements are left out, with a note, if
/// they have no lists. If they have, they may hold polygons, so the file is refused.
/// @throws CommandError (BadFile) that names the file, the place and the reason.
FileMesh ReadPly(const InputFile& file);

}

#endif
