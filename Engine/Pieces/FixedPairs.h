// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FIXEDPAIRS_H
#define DELAUNAYFLIP_FIXEDPAIRS_H

#include "PieceTriangle.h"
#include "TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// The marks (EdgeMark, of slot 0) of the edges of a piece, by the ends of the edges. So the marks
/// can be applied again after flips have changed the triangles.
class MarkedEdges
{
public:
  void Add(const PointPair& edge, unsigned char marks);
  /// The marks of the edge between two points; 0 if it has none.
  unsigned char Get(std::int32_t a, std::int32_t b) const
  {
    return this->IsEnd(a) && this->IsEnd(b) ? this->Find(MakePair(a, b)) : 0;
  }

  /// Marks the edges of all triangles. All earlier marks are lost.
  void Apply(PieceTriangles& triangles) const;

private:
  bool IsEnd(std::int32_t point) const
  {
    return static_cast<std::size_t>(point) < this->Ends.size() && this->Ends[point] != 0;
  }
  unsigned char Find(const PointPair& edge) const;

  PairMap<unsigned char> Marks;
  std::vector<unsigned char> Ends; ///< One flag per point: whether it is an end of a marked edge.
};

/// The edges that three or more triangles share, in the order of the triangles.
std::vector<PointPair> FindCrowdedEdges(const TriangleArray& triangles);

}

#endif
