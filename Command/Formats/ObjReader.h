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
/// Point data: TCoords, Normals and Colors, if the file has them; see CornerVectors.h for corners
/// of a point that differ. Cell data: MaterialIds, GroupIds, ObjectIds and SmoothingIds,
/// for the keywords that the file uses; each counts the names in the field data MaterialNames,
/// GroupNames, ObjectNames or SmoothingNames, and is -1 before the first. Field data also:
/// MaterialLibraries. Lines of other keywords are left out, with a note.
///
/// Files with texture coordinates or normals often repeat vertices because of these; `repeated`
/// says whether vertices at the same place are merged.
/// @throws CommandError (BadFile) with the file, the line and the reason.
FileMesh ReadObj(const InputFile& file, RepeatedPoints repeated);

}

#endif
