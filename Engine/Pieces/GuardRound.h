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

/// What ranks do where a flip could make an edge that another rank has. A run on one rank does not
/// flip edges whose flip would join two shared points: they wait. After it all ranks are asked
/// whether the edge exists; if not, one rank may make it.
struct GuardRound
{
  std::int64_t Flipped = 0; ///< Edges that this rank has flipped.
  std::int64_t FreeOfAll = 0; ///< Not 0 if some rank had an edge that may flip.
  std::vector<std::int64_t> Changed; ///< Their triangles.
  std::vector<PointPair> Gone; ///< What they were.
};

/// An inner edge of a rank: its two corners.
struct InnerQuad
{
  PieceCorner One, Other;
};

/// The edges of a rank that wait.
class WaitingEdges
{
public:
  /// Flips edges of `mesh` that have waited, and removes the edges from `test` whose flip would
  /// make an edge that exists or that another flip makes.
  GuardRound Flip(PieceMesh& mesh, const QuadJudge& judge, SeamTest& test, PieceGroup& group);

private:
  void Find(PieceMesh& mesh, const QuadJudge& judge);

  bool IsFirst = true;
  std::vector<InnerQuad> Bad;
  std::vector<std::int64_t> Triangles; ///< Of those; other edges are bad only if they have changed.
};

}

#endif
