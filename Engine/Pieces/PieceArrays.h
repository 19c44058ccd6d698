// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_PIECEARRAYS_H
#define DELAUNAYFLIP_PIECEARRAYS_H

#include "ConstraintMove.h"
#include "PieceMesh.h"
#include "QuadSoup.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

std::vector<TriangleLabel> ListLabels(const TriangleMesh& mesh);

/// Arrays that take the place of the caller's after triangles of a piece have changed.
class PieceArrays
{
public:
  explicit PieceArrays(bool areFloats)
    : Points(areFloats)
  {
  }

  void AddConstraint(std::int64_t from, std::int64_t to);
  void TakeTriangles(const PieceMesh& mesh);
  /// Takes the labels of those triangles that have not left.
  /// @param labels one per place.
  void TakeLabels(const PieceMesh& mesh, const std::vector<TriangleLabel>& labels);
  void TakePoints(const PieceMesh& mesh);

  /// Gives a mesh views of what was taken, and of all constraints, none of which is to be inserted.
  void AddTo(TriangleMesh& mesh) const;

private:
  std::vector<std::int64_t> Constraints;
  std::vector<std::int32_t> Ids;
  std::vector<std::int32_t> Regions;
  std::vector<unsigned char> Frozen;
  PointList Points;
};

}

#endif
