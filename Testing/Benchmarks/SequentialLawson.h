// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEQUENTIALLAWSON_H
#define DELAUNAYFLIP_SEQUENTIALLAWSON_H

#include "GeneratedMeshes.h"

#include <cstdint>

namespace delaunayflip
{

/// The textbook way to the same mesh: triangles with neighbours, a stack of edges to look at, one
/// flip at a time. For planar, counter-clockwise, embedded meshes; by x and y.
class SequentialLawson
{
public:
  /// Finds the neighbours by sorting vertex pairs.
  explicit SequentialLawson(const OwnedMesh<float>& mesh);

  /// @returns the number of flips.
  std::int64_t Run();

  const std::vector<std::int32_t>& GetTriangles() const { return this->Vertices; }

private:
  void FindNeighbors();
  bool IsBad(std::int32_t corner) const;
  void Flip(std::int32_t corner);
  void Link(std::int32_t corner, std::int32_t twin);
  void Push(std::int32_t corner);

  std::vector<double> Points; ///< x, y.
  std::vector<std::int32_t> Vertices; ///< One a corner, three corners a triangle.
  std::vector<std::int32_t> Twins; ///< The corner across the edge opposite a corner, or -1.
  std::vector<std::int32_t> Stack; ///< Corners whose opposite edge must be judged.
  std::vector<char> IsStacked; ///< By corner.
};

}

#endif
