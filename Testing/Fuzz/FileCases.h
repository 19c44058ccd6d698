// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILECASES_H
#define DELAUNAYFLIP_FILECASES_H

#include "ByteSource.h"

#include <string>
#include <vector>

namespace delaunayflip
{

struct SeedFile
{
  std::string Extension; ///< "vtk", "vtp", "ply", "stl", "obj" or "csv".
  std::string Bytes;
};

/// Small valid files of every format that the command reads, in each of its encodings, with all
/// that the format can hold besides triangles. VTK's writers make them in a separate process: they
/// start threads, and a process that forks must not have any.
/// @param folder for temporary files.
std::vector<SeedFile> MakeSeedFiles(const std::string& folder);

/// A file with a few faults: bits, bytes, numbers, lines, a cut, or a piece of `other`.
std::string MutateFile(std::string bytes, const std::string& other, ByteSource& source);

}

#endif
