// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHREADER_H
#define DELAUNAYFLIP_MESHREADER_H

#include "FileMesh.h"
#include "MeshFormat.h"

#include <string>

namespace delaunayflip
{

class VTKMessages;

/// Reads a surface mesh. Call this in a child process: a corrupt file may crash VTK's reader, or
/// ReadingLimits may end the process.
/// @throws CommandError (BadFile) that names the file and the reason.
FileMesh ReadMesh(const std::string& path, MeshFormat format, VTKMessages& messages);

}

#endif
