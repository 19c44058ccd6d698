// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_CORNERVECTORS_H
#define DELAUNAYFLIP_CORNERVECTORS_H

#include <vtkType.h>

#include <cstdint>
#include <string>
#include <vector>

class vtkPolyData;

namespace delaunayflip
{

struct FileMesh;

/// Vectors for the corners of the polygons of a mesh, cell by cell: texture coordinates or normals.
struct CornerVectors
{
  std::vector<double> Values;
  int Components = 0;
  std::vector<std::int64_t> OfCorner; ///< The number of its vector, or None.

  static constexpr std::int64_t None = -1;

  /// Whether two corners have the same vector. A corner without one agrees with any.
  bool Agree(std::int64_t first, std::int64_t second) const;
};

/// Turns texture coordinates into point data. If corners at a point have different ones, as on a
/// seam of the texture, leaves them out, with a warning: points are never split.
void AttachTexture(FileMesh& file, const std::string& name, const CornerVectors& texture);

/// Turns normals into point data if all corners of each point agree, into data of the polygons if
/// all corners of each polygon agree; otherwise leaves them out, with a note.
void AttachNormals(FileMesh& file, const std::string& name, const CornerVectors& normals);

}

#endif
