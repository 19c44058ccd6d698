// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LEGACYREADER_H
#define DELAUNAYFLIP_LEGACYREADER_H

#include "FileMesh.h"
#include "InputFile.h"

#include <string>

namespace delaunayflip
{

/// Reads a legacy .vtk, versions 1 to 5, text or binary: the polygonal data with all attributes and
/// field data. Numbers in text are read as the type that the file names.
/// @throws CommandError (BadFile) with the file, the line and the reason.
FileMesh ReadLegacy(const InputFile& file);

/// Throws an error: the file has another type of data.
[[noreturn]] void FailOnType(const InputFile& file, const std::string& type);

}

#endif
