// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_OBJPARSER_H
#define DELAUNAYFLIP_OBJPARSER_H

#include "CornerVectors.h"
#include "TextCursor.h"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace delaunayflip
{

/// A keyword that names the group, the material or the like of the cells after it.
struct ObjLabel
{
  const char* Keyword;
  const char* Ids; ///< The array of the cells.
  const char* Names; ///< The array of the names.
};

constexpr std::array<ObjLabel, 4> ObjLabels = { {
  { "usemtl", "MaterialIds", "MaterialNames" },
  { "g", "GroupIds", "GroupNames" },
  { "o", "ObjectIds", "ObjectNames" },
  { "s", "SmoothingIds", "SmoothingNames" },
} };

/// The cells of one kind.
struct ObjCells
{
  std::vector<vtkIdType> Points;
  std::vector<vtkIdType> Ends; ///< Where the points of each cell end.
  std::vector<std::int64_t> Textures; ///< Of each corner; shorter if the last ones have none.
  std::vector<std::int64_t> Normals; ///< Likewise.
  std::array<std::vector<int>, ObjLabels.size()> Labels; ///< Of each cell; empty if unused.
};

/// The contents of a .obj, with numbers from 0.
struct ObjContent
{
  std::vector<double> Positions; ///< 3 per vertex.
  std::vector<double> Colors; ///< 3 per vertex; shorter if the last ones have none.
  std::vector<double> Textures; ///< 3 each.
  std::vector<double> Normals; ///< 3 each.
  ObjCells Verts;
  ObjCells Lines;
  ObjCells Faces;
  std::array<std::vector<std::string>, ObjLabels.size()> Names;
  std::vector<std::string> Libraries;
  std::map<std::string, std::int64_t> Unknown; ///< The number of lines by unknown keyword.
};

/// @throws CommandError (BadFile) with the file, the line and the reason.
ObjContent ParseObj(const InputFile& file);

}

#endif
