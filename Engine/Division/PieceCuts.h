// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECECUTS_H
#define DELAUNAYFLIP_PIECECUTS_H

#include "TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Cuts between pieces next to each other that have about the same number of triangles: each across
/// the longest side of what it cuts.
///
/// Of large meshes they are those of a sample, which depends on the number of triangles only.
class PieceCuts
{
public:
  /// @param axes of coordinates that matter, ascending.
  PieceCuts(const TriangleMesh& mesh, const std::vector<int>& axes, int pieces);

  /// The piece of a triangle, 0 to pieces - 1, by its centre.
  int FindPiece(const TriangleMesh& mesh, std::int64_t triangle) const;

private:
  using Center = std::array<double, 3>;

  /// What lies below the value along an axis belongs to the first of two parts. A part is another
  /// cut or, if negative, the piece ~part.
  struct Cut
  {
    int Axis;
    double Value;
    int Parts[2];
  };

  static Center GetCenter(const TriangleMesh& mesh, std::int64_t triangle);
  int FindLongestAxis(const Center* begin, const Center* end) const;
  int Divide(Center* begin, Center* end, int firstPiece, int pieces);

  std::vector<int> Axes;
  std::vector<Cut> Cuts;
  int First; ///< The part that is everything.
};

}

#endif
