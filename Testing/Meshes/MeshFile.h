// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MESHFILE_H
#define DELAUNAYFLIP_MESHFILE_H

#include "TriangleMesh.h"

#include <cstdint>
#include <string>
#include <vector>

/// @file
/// Reads real meshes on machines without VTK. Testing/Gpu/export_meshes.py writes the files. All
/// numbers are little endian:
///
///     8 bytes       "DFMESH01"
///     int64 * 5     bytes of a coordinate (4 or 8), points, triangles, constraint edges, and 1 for
///                   a height field (all triangles turn the same way seen from above) or 0
///     coordinates   x, y, z per point
///     int32         three ids per triangle
///     int64         two ids per constraint edge

namespace delaunayflip
{

/// A mesh from a file. Either Floats or Doubles is empty.
struct FileMesh
{
  std::string Name; ///< That of the file, without folder and suffix.
  std::vector<float> Floats;
  std::vector<double> Doubles;
  std::vector<std::int32_t> Triangles;
  std::vector<std::int64_t> ConstraintEdges;
  bool IsHeightField = false;

  TriangleMesh View() const;
};

/// The .dfmesh files in a folder, sorted by name; none if there is no such folder.
std::vector<std::string> ListMeshFiles(const std::string& folder);

/// @throws std::runtime_error for an incomplete file.
FileMesh ReadMeshFile(const std::string& path);

}

#endif
