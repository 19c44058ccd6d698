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

/// A surface mesh as its file has it.
struct MeshFile
{
  vtkSmartPointer<vtkPolyData> Mesh;
  std::vector<std::string> Notes; ///< What reading changed, one line each.
  bool RepeatsPoints = false; ///< The format had to repeat points.
};

/// Reads a surface mesh, with one point a place where the format repeats points for every triangle
/// (.stl) or for every texture coordinate and normal (.obj). May die on a corrupt file, as VTK's
/// readers do: to be called in a child process.
/// @throws CommandError (BadFile) that names the file and the reason.
MeshFile ReadMesh(const std::string& path, MeshFormat format, VTKMessages& messages);

/// The same with the points as VTK's reader gives them.
MeshFile ReadUnmerged(const std::string& path, MeshFormat format, VTKMessages& messages);

}

#endif
