// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHWRITER_H
#define DELAUNAYFLIP_MESHWRITER_H

#include "MeshFormat.h"

#include <functional>
#include <string>

class vtkPolyData;

namespace delaunayflip
{

class VTKMessages;

/// Called with the share that has been written, 0 .. 1, if writing the format takes long.
using WriteObserver = std::function<void(double)>;

/// Writes a mesh to `path`, in binary where the format allows it. Then reads the file back to check
/// that it is complete, because the writers of some formats do not notice a full disk. Call this in
/// a child process: VTK's readers may crash on an incomplete file.
/// @throws CommandError (BadFile) with the reason.
void WriteMesh(vtkPolyData* mesh, const std::string& path, MeshFormat format, VTKMessages& messages,
  const WriteObserver& tell);

}

#endif
