// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHFORMAT_H
#define DELAUNAYFLIP_MESHFORMAT_H

#include <string>

/// @file
/// The file formats, recognised by their extensions.

namespace delaunayflip
{

enum class MeshFormat
{
  VTK, ///< Legacy .vtk
  VTP, ///< VTK's XML .vtp
  PLY,
  STL,
  OBJ
};

/// The format of `path`, from its extension in upper or lower case.
/// @throws CommandError (WrongUsage) that lists the known extensions.
MeshFormat FormatOf(const std::string& path);

}

#endif
