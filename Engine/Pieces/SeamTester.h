// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMTESTER_H
#define DELAUNAYFLIP_SEAMTESTER_H

#include "PieceMesh.h"
#include "QuadJudge.h"
#include "Records.h"
#include "SeamTriangle.h"

#include <cstdint>
#include <vector>

namespace delaunayflip
{

/// A bad edge between two ranks, as each of them is told.
struct BadSeam
{
  std::int64_t Triangle; ///< The rank's own.
  PointPair Ends; ///< Keys.
  PointPair Opposite; ///< Keys of the points that its flip would join.
  std::int32_t OtherRank;
};

/// What a test of all edges between ranks has found.
struct SeamTest
{
  std::vector<BadSeam> Bad; ///< Of this rank; each is known to both of its ranks.
  std::int64_t BadOfAll = 0; ///< Edges of all ranks.
  std::int64_t BlockedOfAll = 0; ///< Bad, but the flip would fold the mesh over.
};

/// Finds the bad edges between ranks that may flip, as far as their shape tells. Remembers the
/// edges whose home this rank is, so that ranks send only what has changed, and good edges are not
/// tested again.
class SeamTester
{
public:
  /// All ranks call it together, after BeginRounds.
  SeamTest Run(PieceMesh& mesh, const QuadJudge& judge, PieceGroup& group);

private:
  /// A triangle at an edge.
  struct Side
  {
    PointPair Ends; ///< Of the edge: keys.
    std::int32_t Rank;
    std::uint32_t Place; ///< In Seams.
    bool IsToTest; ///< Unless neither side is, the edge is tested.
  };

  struct Found
  {
    RecordLists<BadSeam> ToRank;
    std::int64_t Bad = 0;
    std::int64_t Blocked = 0;
  };

  void Update(const std::vector<RankedTriangle>& news);
  std::uint32_t Keep(const SeamTriangle& seam);
  std::vector<std::size_t> ListToTest() const;
  void TellBad(std::size_t one, std::size_t other, RecordLists<BadSeam>& toRank) const;
  Found Judge(const QuadJudge& judge, int ranks);
  const SeamTriangle& GetSeam(std::size_t side) const { return this->Seams[Sides[side].Place]; }

  std::vector<Side> Sides; ///< Those of an edge next to each other, by rank.
  std::vector<SeamTriangle> Seams; ///< So that Sides are small.
  std::vector<std::uint32_t> Free; ///< Places of Seams that may be used again.
};

}

#endif
