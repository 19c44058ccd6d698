// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEARRAYS_H
#define DELAUNAYFLIP_PIECEARRAYS_H

#include "PieceMesh.h"
#include "QuadSoup.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Arrays that replace the caller's when the triangles of a piece have changed.
class PieceArrays
{
public:
  explicit PieceArrays(bool areFloats)
    : Points(areFloats)
  {
  }

  void AddConstraint(std::int64_t from, std::int64_t to);
  void TakeTriangles(const PieceMesh& mesh);
  void TakePoints(const PieceMesh& mesh);

  /// Gives a mesh views of the arrays that were taken, and of all constraints. None of these is to
  /// be inserted.
  void AddTo(TriangleMesh& mesh) const;

private:
  std::vector<std::int64_t> Constraints;
  std::vector<std::int32_t> Ids;
  PointList Points;
};

}

#endif
