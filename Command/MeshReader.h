// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHREADER_H
#define DELAUNAYFLIP_MESHREADER_H

#include "MeshFormat.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

class VTKMessages;

/// A surface mesh that was read from a file.
struct MeshFile
{
  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<std::string> Notes; ///< What reading changed, one line each.
  bool RepeatsPoints = false; ///< Whether the format repeats points.
};

/// Reads a surface mesh. Merges coincident points where the format repeats points, for every
/// triangle (.stl) or for every texture coordinate and normal (.obj). Call this in a child process:
/// VTK's readers may crash on a corrupt file.
/// @throws CommandError (BadFile) with the file and the reason.
MeshFile ReadMesh(const std::string& path, MeshFormat format, VTKMessages& messages);

/// The same, with the points as VTK's reader returns them.
MeshFile ReadUnmerged(const std::string& path, MeshFormat format, VTKMessages& messages);

}

#endif
