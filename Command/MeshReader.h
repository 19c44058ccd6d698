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

/// Reads a surface mesh. A corrupt file may end the process, by a crash of VTK's reader or by
/// ReadingLimits: to be called in a child process.
/// @param repeated what to do with points that .stl repeats for every triangle, and .obj often for
/// texture coordinates and normals
/// @throws CommandError (BadFile) that names the file and the reason.
FileMesh ReadMesh(
  const std::string& path, MeshFormat format, RepeatedPoints repeated, VTKMessages& messages);

}

#endif
