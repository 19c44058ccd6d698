// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFormat.h"

#include "CommandError.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

namespace delaunayflip
{

MeshFormat FormatOf(const std::string& path)
{
  static const std::map<std::string, MeshFormat> formats = { { ".vtk", MeshFormat::VTK },
    { ".vtp", MeshFormat::VTP }, { ".ply", MeshFormat::PLY }, { ".stl", MeshFormat::STL },
    { ".obj", MeshFormat::OBJ } };
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const auto found = formats.find(extension);
  if (found == formats.end())
  {
    throw CommandError(ExitCode::WrongUsage,
      path + ": unknown file extension; known are .vtk, .vtp, .ply, .stl and .obj");
  }
  return found->second;
}

}
