// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_VTKINTEGERS_H
#define DELAUNAYFLIP_VTKINTEGERS_H

#include <string>
#include <string_view>

/// @file
/// Integers in the text of a .vtk or a .vtp. VTK wraps those that do not fit into their types.

namespace delaunayflip
{

class InputFile;

/// @param name of the array, with quotes, or what it is of.
/// @param type as a .vtp or a .vtk names it; any type but those of integers is passed over.
/// @throws CommandError (BadFile) with the first of the words that does not fit into the type.
void RequireIntegers(
  const InputFile& file, const std::string& name, std::string_view type, std::string_view text);

/// Does so for all arrays of a .vtk in text that VTK can read.
void RequireIntegersOfLegacy(const InputFile& file);

}

#endif
