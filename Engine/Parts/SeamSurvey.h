// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "ConstraintInsertion.h"
#include "EdgeMesh.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "FlipRules.h"
#include "PartMesh.h"
#include "PartSurvey.h"
#include "SpatialOrder.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <map>
#include <vector>

namespace delaunayflip
{

/// The options for flipping a part of the whole mesh. The geometry has been chosen for the whole
/// mesh, and the fixed edges must be given.
FlipOptions GetPartOptions(const PartSurvey& survey, const FlipOptions& options);

/// A triangle at an edge between two shared points, as its rank sends it to the home of the edge,
/// with all that decides whether the edge is fixed.
struct SeamTriangle
{
  PointPair Ends; ///< Keys of the ends of the edge.
  std::int64_t Opposite; ///< Key of the point opposite to the edge.
  std::int64_t Corner; ///< 3 * triangle + slot of the opposite point, on its rank.
  double Places[3][3]; ///< Both ends, in the same order for both triangles; the opposite point.
  std::int32_t Region;
  std::int32_t Rank; ///< The rank that has it.
  bool RunsForward; ///< It runs through the edge from the first end to the second.
  bool IsFrozen;
  bool IsConstraint; ///< Whether its rank knows of a constraint along the edge.
  bool IsToTest; ///< For SeamTester: it has not been tested, or was not good.

  /// The one of the two ends, 0 or 1, from which it runs through the edge.
  int GetStart() const { return this->RunsForward ? 0 : 1; }
};

/// The triangle, for its edge opposite to corner `slot`. It is not frozen and in no region.
SeamTriangle MakeSeamTriangle(const PartMesh& mesh, std::int64_t triangle, int slot);

/// Judges single edges by the rules of the engine (FlipRules.h).
class QuadJudge
{
public:
  QuadJudge(const PartSurvey& survey, const FlipOptions& options);

  /// @param apqb x, y and z of the points a, p, q and b of a quad (picture in EdgeFlip.h).
  /// @returns Good, Bad, BlockedByShape or BlockedByDeviation.
  EdgeState Judge(const double (&apqb)[4][3]) const;

  /// Judges the edge of two triangles. They must run through it in opposite directions.
  EdgeState Judge(const SeamTriangle& one, const SeamTriangle& other) const;

  /// Judges the edge that is opposite to both corners.
  EdgeState Judge(const PartMesh& mesh, const PartCorner& one, const PartCorner& other) const;

private:
  PackingPlan Plan;
  RuleChoice Rule;
};

/// What is known about the edges with triangles on several ranks before the first flip. It is
/// decided once for all ranks.
struct SeamSurvey
{
  MarkedEdges Marks; ///< The marks of those that have triangles on this rank.
  /// Two ids for each of those that have two triangles here and are fixed because of others.
  std::vector<std::int64_t> ToFix;
  FlipReport Totals; ///< Edges to be added to the counts of this rank (AddEdges).
  std::int64_t Seams = 0; ///< Those that have triangles on two ranks and may flip, over all ranks.
};

/// The mesh that the first flips start from, and its seams. In planar geometry, this is the
/// caller's mesh after insertion of the constraints that are to be inserted; otherwise the caller's
/// mesh.
///
/// Each rank inserts the constraints that stay within its part. Several ranks may have the two
/// points of a constraint if these are shared, so each of them tries it. A constraint that no rank
/// inserts counts as unmatched, once. Where flips need a guard, ranks insert nothing.
class PartConstraints
{
public:
  /// All ranks must call this together.
  /// @param part receives the changed triangles.
  PartConstraints(const PartJob& job, PartMesh& part);

  TriangleMesh Mesh; ///< Views of the caller's arrays and of arrays of this object.
  SeamSurvey Seams;
  bool IsAborted = false; ///< Whether an observer of any rank has stopped the insertion.
  double Share = 0.0; ///< How much of the run is done after the insertion.

  /// Adds what is known of constraints on this rank.
  void AddTo(FlipReport& report) const;
  /// Adds the flips that inserted them, by triangle slot.
  void AddFlipCounts(std::int32_t* counts) const { this->Insertion.AddFlipCounts(counts); }

private:
  /// Whether the constraints between shared points are to be inserted, by the keys of their ends.
  /// Any rank may have given them.
  using SharedConstraints = std::map<PointPair, bool>;

  SharedConstraints List(const PartJob& job, const PartMesh& part);
  void Insert(const PartJob& job);
  void FindFates(const PartMesh& part);
  void CountShared(const SharedConstraints& shared, const std::vector<char>& fates);

  std::vector<std::int64_t> Ends; ///< The ends of the constraints that this rank can look up.
  std::vector<unsigned char> ToInsert; ///< One flag for each of them.
  ConstraintInsertion Insertion;
  PairMap<char> Fates; ///< What became of those between shared points, by keys.
  std::vector<std::int64_t> Edges; ///< The ends of the constraints that Mesh has.
  std::int64_t NumberInserted = 0;
  std::int64_t Unmatched = 0; ///< That were not to be inserted.
  std::vector<RefusedConstraint> Refused; ///< Those that this rank counts.
};

}

#endif
