// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OBJREADER_H
#define DELAUNAYFLIP_OBJREADER_H

#include "FileMesh.h"
#include "InputFile.h"

namespace delaunayflip
{

/// Reads a Wavefront .obj in double precision, with a point for every vertex of the file.
///
/// Point data: TCoords, Normals and Colors, if the file has them. CornerVectors.h says what happens
/// if the corners at a point differ. Cell data, for the keywords that the file uses: MaterialIds,
/// GroupIds, ObjectIds and SmoothingIds. Each is an index into the names in the field data
/// MaterialNames, GroupNames, ObjectNames or SmoothingNames, or -1 before the first name. The field
/// data also have MaterialLibraries. Lines with other keywords are left out, with a note.
/// @throws CommandError (BadFile) with the file, the line and the reason.
FileMesh ReadObj(const InputFile& file);

}

#endif
