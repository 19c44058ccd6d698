// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PLYPROPERTIES_H
#define DELAUNAYFLIP_PLYPROPERTIES_H

#include <vtkDataSetAttributes.h>
#include <vtkType.h>

#include <string>
#include <utility>
#include <vector>

class vtkDataArray;

/// @file
/// What the reader and the writer of .ply know: a header lists elements (vertex, face, edge) with
/// their number and properties; their values follow as text or as binary numbers of either byte
/// order.

namespace delaunayflip
{

/// The types, each by two names; the first is written. The last two are only read.
inline constexpr std::pair<const char*, int> PlyTypes[] = { { "char", VTK_SIGNED_CHAR },
  { "int8", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
  { "short", VTK_SHORT }, { "int16", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
  { "uint16", VTK_UNSIGNED_SHORT }, { "int", VTK_INT }, { "int32", VTK_INT },
  { "uint", VTK_UNSIGNED_INT }, { "uint32", VTK_UNSIGNED_INT }, { "float", VTK_FLOAT },
  { "float32", VTK_FLOAT }, { "double", VTK_DOUBLE }, { "float64", VTK_DOUBLE },
  { "int64", VTK_LONG_LONG }, { "uint64", VTK_UNSIGNED_LONG_LONG } };

inline bool IsInteger(int type) { return type != VTK_FLOAT && type != VTK_DOUBLE; }

using Names = std::vector<std::string>;

/// Properties that together are an array.
struct PlyGroup
{
  std::string Array;
  Names Properties;
  int Attribute; ///< What the array is for VTK.
};

/// Larger groups first.
inline const PlyGroup PlyGroups[] = {
  { "Normals", { "nx", "ny", "nz" }, vtkDataSetAttributes::NORMALS },
  { "RGBA", { "red", "green", "blue", "alpha" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "red", "green", "blue" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "diffuse_red", "diffuse_green", "diffuse_blue" }, vtkDataSetAttributes::SCALARS },
  { "TCoords", { "u", "v" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "s", "t" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "texture_u", "texture_v" }, vtkDataSetAttributes::TCOORDS },
};

struct PlyProperty
{
  std::string Name;
  int Type;
  vtkDataArray* Array = nullptr; ///< Has the numbers of vertices.
  int Component = 0;
  int CountType = VTK_VOID; ///< For a list, the type of its length.
  bool IsOfCell = false; ///< Whether its values are points of a face or an edge.
};

}

#endif
