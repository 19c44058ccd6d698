// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_LEGACYREADER_H
#define DELAUNAYFLIP_LEGACYREADER_H

#include "FileMesh.h"
#include "InputFile.h"

#include <string>

namespace delaunayflip
{

class VTKMessages;

/// Reads a legacy .vtk with VTK: the polygonal data with all attributes and field data.
/// @throws CommandError (BadFile) with the file and the reason.
FileMesh ReadLegacy(const InputFile& file, VTKMessages& messages);

/// Throws an error: the file has another type of data.
[[noreturn]] void FailOnType(const InputFile& file, const std::string& type);

}

#endif
