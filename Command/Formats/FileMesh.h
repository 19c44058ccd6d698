// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILEMESH_H
#define DELAUNAYFLIP_FILEMESH_H

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace delaunayflip
{

/// A surface mesh that was read from a file, or is to be written to one.
struct FileMesh
{
  vtkSmartPointer<vtkPolyData> Mesh = vtkSmartPointer<vtkPolyData>::New();
  std::vector<std::string> Notes; ///< What reading changed or left out, one line each.
  std::vector<std::string> Warnings; ///< What may be wrong with the file.
};

}

#endif
