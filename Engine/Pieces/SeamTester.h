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

/// A bad seam edge, as seen from one of its two ranks.
struct BadSeam
{
  std::int64_t Triangle; ///< The triangle of this rank.
  PointPair Ends; ///< Keys.
  PointPair Opposite; ///< Keys of the points that the flip would join.
  /// Of the end with the lower key. Both ranks of the edge get the same values, even if they have
  /// the point elsewhere.
  double Place[3];
  std::int32_t OtherRank;
};

/// The result of a test of all seam edges.
struct SeamTest
{
  std::vector<BadSeam> Bad; ///< Those of this rank. Each is in the lists of both of its ranks.
  std::int64_t BadOfAll = 0; ///< The number of bad seam edges over all ranks, each counted once.
  std::int64_t BlockedOfAll = 0; ///< Other ones, whose flip would fold the mesh over.
};

/// Finds the bad seam edges that may flip, as far as the shape of their quads tells. Keeps the seam
/// edges whose home is this rank. So ranks send only triangles that have changed, and good edges
/// are not tested again.
class SeamTester
{
public:
  /// All ranks must call this together, after BeginRounds.
  SeamTest Run(PieceMesh& mesh, const QuadJudge& judge, PieceGroup& group);

private:
  /// One of the two triangles of a seam edge.
  struct Side
  {
    PointPair Ends; ///< Keys of the ends of the edge.
    std::int32_t Rank; ///< The rank that has the triangle.
    std::uint32_t Place; ///< The index in Seams.
    bool IsToTest; ///< The edge is tested if this is true of one of its sides.
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

  std::vector<Side> Sides; ///< Sorted by edge, then by rank.
  std::vector<SeamTriangle> Seams; ///< The triangles of Sides, kept apart so that Sides are small.
  std::vector<std::uint32_t> Free; ///< Places in Seams that are free.
};

}

#endif
