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
  std::vector<std::int64_t> OfCorner; ///< The number of its vector; None where it has none.

  static constexpr std::int64_t None = -1;

  /// Whether two corners have the same vector; one that has none agrees with any.
  bool Agree(std::int64_t first, std::int64_t second) const;
};

/// Makes texture coordinates data of the points. A point whose corners have different ones, on a
/// seam of the texture, is repeated at the end of the points, so that each has its own: edges on
/// seams become boundary edges, and nothing flips across them. A note says how many.
void AttachTexture(FileMesh& file, const std::string& name, const CornerVectors& texture);

/// Makes normals data of the points where all corners of each point agree, data of the polygons
/// where all corners of each polygon do, and else leaves them out, with a note.
void AttachNormals(FileMesh& file, const std::string& name, const CornerVectors& normals);

}

#endif
