// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHWRITER_H
#define DELAUNAYFLIP_MESHWRITER_H

#include "MeshFormat.h"

#include <string>

class vtkPolyData;

namespace delaunayflip
{

class VTKMessages;

/// Writes `mesh` to `path`, binary where the format can be, and reads the file back to see that it
/// is whole: the writers of some formats do not notice a full disk. May die on that, as VTK's
/// readers do: to be called in a child process.
/// @throws CommandError (BadFile) with the reason.
void WriteMesh(
  vtkPolyData* mesh, const std::string& path, MeshFormat format, VTKMessages& messages);

}

#endif
