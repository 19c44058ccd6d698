// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_GUARDROUND_H
#define DELAUNAYFLIP_GUARDROUND_H

#include "PieceMesh.h"
#include "QuadJudge.h"
#include "SeamRound.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// What a rank has flipped in the guarded part of a round.
///
/// The guard keeps a flip from making an edge that another rank has. Such an edge could only join
/// two shared points. So when ranks flip alone, they do not flip an edge whose flip would join two
/// shared points: the edge waits. Afterwards all ranks are asked whether the new edge exists. If it
/// does not, one rank may make it.
struct GuardRound
{
  std::int64_t Flipped = 0; ///< Edges that this rank has flipped.
  std::int64_t FreeOfAll = 0; ///< How many edges may flip, on all ranks and between them.
  std::vector<std::int64_t> Changed; ///< The triangles of the flipped edges.
  std::vector<PointPair> Gone; ///< The ends of the flipped edges before the flip.
};

/// An inner edge of a rank, given by the two corners opposite to it.
struct InnerQuad
{
  PieceCorner One, Other;
};

/// The edges of a rank that wait (see GuardRound).
class WaitingEdges
{
public:
  /// Flips waiting edges of `mesh` as far as the guard allows. Removes from `test` the seam edges
  /// whose flip would make an edge that exists or that another flip makes, and those whose triangle
  /// has just changed. All ranks must call this together.
  /// @param mayFlip if false, it only finds how many edges may flip.
  GuardRound Flip(
    PieceMesh& mesh, const QuadJudge& judge, SeamTest& test, PieceGroup& group, bool mayFlip);

private:
  void Find(PieceMesh& mesh, const QuadJudge& judge);

  bool IsFirst = true;
  std::vector<InnerQuad> Bad;
  /// The triangles of `Bad`. Other edges can have become bad only where triangles have changed.
  std::vector<std::int64_t> Triangles;
};

}

#endif
