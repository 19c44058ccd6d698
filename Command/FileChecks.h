// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILECHECKS_H
#define DELAUNAYFLIP_FILECHECKS_H

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What VTK's readers do not check: whether a file is as long as its header says, and whether its
/// indices exist. Every function throws a CommandError (BadFile) with the file and the reason.

namespace delaunayflip
{

/// Checks that a binary .stl has 84 + 50 n bytes, where n is from its header. Text files pass,
/// because VTK parses them strictly.
void CheckStl(const std::string& path);

/// What the header of a .ply says.
struct PlyHeader
{
  std::int64_t Vertices = 0;
  std::int64_t Faces = 0;
  bool DoublePoints = false;
};

/// Reads the header of a .ply, and checks that its counts are possible in a file of this length.
PlyHeader CheckPly(const std::string& path);

/// What a .obj consists of.
struct ObjSummary
{
  std::int64_t Vertices = 0;
  std::int64_t TextureCoordinates = 0;
  std::int64_t Normals = 0;
  std::int64_t Groups = 0;
};

/// Checks that every index in a .obj exists in it, and that every face has at least three corners.
ObjSummary CheckObj(const std::string& path);

}

#endif
