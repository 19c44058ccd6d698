// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_STLREADER_H
#define DELAUNAYFLIP_STLREADER_H

#include "FileMesh.h"
#include "InputFile.h"

namespace delaunayflip
{

/// Reads a .stl: binary, in the single precision that it has, or text, in double precision.
///
/// Cell data: Attributes, the two bytes after every triangle of a binary file, if some are not
/// zero; and SolidIds, if a text has several solids, an index into the names in the field data
/// SolidNames.
///
/// The format repeats the points for every triangle; `repeated` says whether points at the same
/// place are merged.
/// @throws CommandError (BadFile) that names the file, the line and the reason.
FileMesh ReadStl(const InputFile& file);

}

#endif
