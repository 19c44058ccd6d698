// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FIXEDPAIRS_H
#define DELAUNAYFLIP_FIXEDPAIRS_H

#include "PieceMesh.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// Edges of a piece by their marks (EdgeMark, of slot 0), to mark the triangles of another time.
class MarkedEdges
{
public:
  void Add(const PointPair& edge, EdgeMark mark);

  /// Marks the edges of all triangles; those that had other marks lose them.
  void Apply(std::vector<PieceTriangle>& triangles) const;

private:
  PairMap<unsigned char> Marks;
  std::vector<unsigned char> Ends; ///< One flag per point: whether it is the end of such an edge.
};

/// The edges with three or more triangles, in the order of the triangles.
std::vector<PointPair> FindCrowdedEdges(const TriangleArray& triangles);

}

#endif
