// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReadMeshFile_h
#define ReadMeshFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

/// Whether the extension is one of .vtk, .vtp, .ply, .stl and .obj, in upper or lower case.
bool HasKnownExtension(const std::string& file);

/// Reads the mesh in a file.
/// @throws std::runtime_error with the file and what is wrong with it.
vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& file);

#endif
