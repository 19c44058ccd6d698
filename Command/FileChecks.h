// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FILECHECKS_H
#define DELAUNAYFLIP_FILECHECKS_H

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// What VTK's readers do not look at: whether a file is as long as its header says, and whether its
/// indices exist. Every function throws CommandError (BadFile) that names the file and the reason.

namespace delaunayflip
{

/// A binary .stl must have 84 + 50 n bytes, n from its header. Text files pass: VTK parses those
/// strictly.
void CheckStl(const std::string& path);

/// What the header of a .ply promises.
struct PlyHeader
{
  std::int64_t Vertices = 0;
  std::int64_t Faces = 0;
  bool DoublePoints = false;
};

/// Reads the header of a .ply; its counts must be possible in a file of that length.
PlyHeader CheckPly(const std::string& path);

/// What a .obj consists of.
struct ObjSummary
{
  std::int64_t Vertices = 0;
  std::int64_t TextureCoordinates = 0;
  std::int64_t Normals = 0;
  std::int64_t Groups = 0;
};

/// Every index in a .obj must name something that the file has, and every face have three corners.
ObjSummary CheckObj(const std::string& path);

}

#endif
