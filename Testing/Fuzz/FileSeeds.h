// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILESEEDS_H
#define DELAUNAYFLIP_FILESEEDS_H

#include <string>
#include <vector>

namespace delaunayflip
{

struct SeedFile
{
  std::string Extension; ///< "vtk", "vtp", "ply", "stl" or "obj".
  std::string Bytes;
};

/// Small valid files of every format that the command reads, in each of its encodings, with what
/// the format can hold beside triangles. VTK's writers make them in a process of its own, because
/// they start threads, which a process that forks must not have.
/// @param folder where they may put files for a moment.
std::vector<SeedFile> MakeSeedFiles(const std::string& folder);

}

#endif
