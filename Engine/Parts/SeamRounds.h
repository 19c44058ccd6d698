// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMROUNDS_H
#define DELAUNAYFLIP_SEAMROUNDS_H

#include "FlipReport.h"
#include "PartMesh.h"
#include "SeamSurvey.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

/// @file
/// What happens in a round: all seam edges are tested, triangles at bad ones move, and ranks flip.

namespace delaunayflip
{

/// A bad seam edge, as seen from one of its two ranks.
struct BadSeam
{
  std::int64_t Triangle; ///< The triangle of this rank.
  PointPair Ends; ///< Keys.
  PointPair Opposite; ///< Keys of the points that the flip would join.
  /// Coordinates of the end with the lower key. Both ranks of the edge get the same values, even if
  /// they have the point elsewhere.
  double Place[3];
  std::int32_t OtherRank;
};

/// Counts an edge that was judged, if it is bad or blocked.
void CountState(EdgeState state, FlipReport& counts);

/// The result of a test of all seam edges.
struct SeamTest
{
  std::vector<BadSeam> Bad; ///< Those of this rank. Each is in the lists of both of its ranks.
  FlipReport Counts; ///< The states of the edges that have their home here (CountState).
  std::int64_t BadOfAll; ///< How many may flip, over all ranks, each counted once.
};

/// Finds the bad seam edges that may flip, as far as the shape of their quads tells. Keeps the seam
/// edges that have their home on this rank. So ranks send only triangles that have changed, and
/// good edges are not tested again.
class SeamTester
{
public:
  /// All ranks must call this together, after BeginRounds.
  /// @param changed PartMesh::TakeChanged.
  SeamTest Run(PartMesh& mesh, const std::vector<std::int64_t>& changed, const QuadJudge& judge,
    PieceGroup& group);

private:
  void Update(PartMesh& mesh, const std::vector<std::int64_t>& changed, PieceGroup& group);

  /// By the keys of the edge's ends and by rank. An edge is tested if one of its triangles is to be
  /// tested.
  std::map<std::pair<PointPair, std::int32_t>, SeamTriangle> Sides;
};

/// The rule that chooses the receiver of a bad seam edge: the one of its two ranks that gets its
/// triangles.
struct MoveRule
{
  bool ToLower; ///< The lower one, else the higher.
  /// Whether this holds only for the first half of the edges between two ranks, and for the second
  /// half it is the other way round.
  bool InHalves;
};

/// Moves triangles so that at least one bad seam edge becomes an inner edge. A triangle with
/// several bad edges goes to the lowest of their receivers (ToLower), or to the highest.
///
/// Consider the bad edges with the lowest receiver of all. Both triangles of each go to that rank,
/// so these edges become inner edges.
/// @param bad the bad seam edges of this rank.
/// @param moved receives the number of triangles that have moved, over all ranks.
/// @returns the triangles of this rank that have edges to judge now.
std::vector<std::int64_t> MoveTriangles(PartMesh& mesh, const std::vector<BadSeam>& bad,
  const MoveRule& rule, PieceGroup& group, std::int64_t& moved);

/// The flips of a rank in a round. They are made one by one, starting from some triangles and going
/// on as long as an edge of a changed triangle is bad. Other triangles take no time.
class RoundFlips
{
public:
  /// @param needsGuard PartSurvey::NeedsGuard. If true, an edge does not flip if this rank has, or
  /// another rank may have, the edge that the flip would make.
  RoundFlips(PartMesh& mesh, const QuadJudge& judge, bool needsGuard)
    : Mesh(mesh),
      Rule(judge),
      NeedsGuard(needsGuard)
  {
  }

  /// Adds a triangle. Its edges will be judged.
  void Add(std::int64_t triangle);
  /// Adds the triangles at the first end of an edge that is gone. Some of their edges could not
  /// flip while the rank had it.
  void AddFreed(const PointPair& edge);

  /// Whether no edge is left to be judged.
  bool AreDone() const { return this->Next.empty(); }

  /// Judges the edges of these triangles and flips the bad ones, but changes each triangle at most
  /// once. Triangles that have changed are the next ones.
  /// @returns the record of the iteration, without its number and the smallest angle.
  IterationRecord Iterate();

  /// Whether an edge of them is bad and may flip.
  bool HasBad();

  /// Judges the edge that is opposite to both corners.
  EdgeState Judge(const PartCorner& one, const PartCorner& other) const;

private:
  void Visit(std::int64_t triangle, IterationRecord& record);

  PartMesh& Mesh;
  const QuadJudge& Rule;
  bool NeedsGuard;
  std::vector<std::int64_t> Next;
};

}

#endif
