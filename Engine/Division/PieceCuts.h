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

/// Divides a mesh into pieces with about the same number of triangles by recursive bisection. Each
/// cut is perpendicular to the axis along which the part is longest.
///
/// The cuts of a large mesh are computed from a sample of its triangles. Which triangles are in the
/// sample depends only on their number.
class PieceCuts
{
public:
  /// @param axes the coordinate axes to cut across, ascending.
  PieceCuts(const TriangleMesh& mesh, const std::vector<int>& axes, int pieces);

  /// The piece, 0 to pieces - 1, in which the centre of a triangle lies.
  int FindPiece(const TriangleMesh& mesh, std::int64_t triangle) const;

private:
  using Center = std::array<double, 3>;

  /// Centres whose coordinate is below the value belong to the first of the two parts. A part is
  /// the index of another cut or, if negative, the piece ~part.
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
  int First; ///< The part that is the whole mesh.
};

}

#endif
