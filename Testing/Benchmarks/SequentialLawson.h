// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEQUENTIALLAWSON_H
#define DELAUNAYFLIP_SEQUENTIALLAWSON_H

#include "CornerMesh.h"
#include "GeneratedMeshes.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace delaunayflip
{

/// The textbook algorithm: a stack of edges to test, one flip at a time.
/// @param mesh is flipped in place. Afterwards it has no bad edges, unless the limit was reached.
/// @param isBad whether the edge of a corner with a twin is bad.
/// @param maximumFlips a limit, for criteria with which the flips may never end.
/// @returns the number of flips.
template <typename IsBad>
std::int64_t RunLawson(CornerMesh& mesh, const IsBad& isBad, std::int64_t maximumFlips)
{
  std::vector<std::int32_t> stack;
  std::vector<char> isStacked(mesh.Vertices.size(), 0);
  const auto push = [&](std::int32_t corner)
  {
    if (mesh.Twins[corner] >= 0 && !isStacked[corner])
    {
      isStacked[corner] = 1;
      stack.push_back(corner);
    }
  };
  for (std::int32_t corner = 0; corner < mesh.CountCorners(); ++corner)
  {
    if (mesh.IsInterior(corner))
    {
      push(corner);
    }
  }
  std::int64_t flips = 0;
  while (!stack.empty() && flips < maximumFlips)
  {
    const std::int32_t corner = stack.back();
    stack.pop_back();
    isStacked[corner] = 0;
    if (mesh.Twins[corner] >= 0 && isBad(corner))
    {
      const std::int32_t twin = mesh.Twins[corner];
      mesh.Flip(corner);
      ++flips;
      for (const std::int32_t outer :
        { corner, CornerMesh::Previous(corner), twin, CornerMesh::Previous(twin) })
      {
        push(outer);
      }
    }
  }
  return flips;
}

/// For planar, counter-clockwise meshes without overlaps. Edges are judged by x and y, exactly.
class SequentialLawson
{
public:
  explicit SequentialLawson(const OwnedMesh<float>& mesh);

  /// @returns the number of flips.
  std::int64_t Run();

  const std::vector<std::int32_t>& GetTriangles() const { return this->Mesh.Vertices; }

private:
  std::vector<double> Points; ///< x, y.
  CornerMesh Mesh;
};

}

#endif
