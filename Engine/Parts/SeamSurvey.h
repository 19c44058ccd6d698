// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEAMSURVEY_H
#define DELAUNAYFLIP_SEAMSURVEY_H

#include "ConstraintInsertion.h"
#include "EdgeMesh.h"
#include "FlipLoopChoice.h"
#include "FlipOptions.h"
#include "FlipReport.h"
#include "PartMesh.h"
#include "PartSurvey.h"
#include "Records.h"
#include "SpatialOrder.h"
#include "SurfaceAngles.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <tuple>
#include <vector>

namespace delaunayflip
{

/// One of the two triangles of an edge, with all that decides whether the edge is fixed.
struct SeamSide
{
  double Ends[2][3]; ///< Of the edge, in the same order for both triangles.
  double Opposite[3];
  bool RunsForward; ///< The triangle runs through the edge from the first end to the second.
  bool IsFrozen;
  std::int32_t Region;
};

/// The options for flipping a part of the whole mesh. The geometry has been chosen for the whole
/// mesh, and the fixed edges must be given.
FlipOptions GetPartOptions(const PartSurvey& survey, const FlipOptions& options);

/// A triangle at an edge between two shared points, as its rank sends it to the home of the edge.
struct SeamTriangle
{
  PointPair Ends; ///< Keys of the ends of the edge.
  std::int64_t Opposite; ///< Key of the point opposite to the edge.
  std::int64_t Corner; ///< 3 * triangle + slot of the opposite point, on its rank.
  SeamSide Side;
  std::int32_t Rank; ///< The rank that has it, as SortByEdge sets it.
  bool IsToTest; ///< For SeamTester.

  std::int64_t GetTriangle() const { return this->Corner / 3; }
  int GetSlot() const { return static_cast<int>(this->Corner % 3); }
};

/// The triangle, for its edge opposite to corner `slot`. Takes it as not frozen and in no region.
SeamTriangle MakeSeamTriangle(const PartMesh& mesh, std::int64_t triangle, int slot);

/// Orders by edge, then by rank.
inline bool IsBefore(const SeamTriangle& a, const SeamTriangle& b)
{
  return std::tie(a.Ends, a.Rank) < std::tie(b.Ends, b.Rank);
}

/// The triangles that all ranks have sent, by edge, then by rank. All are to be tested.
std::vector<SeamTriangle> SortByEdge(const RecordLists<SeamTriangle>& lists);

/// Judges single edges by the rules of the engine (FlipRules.h).
class QuadJudge
{
public:
  QuadJudge(const PartSurvey& survey, const FlipOptions& options);

  /// @param apqb x, y and z of the points a, p, q and b of a quad (picture in EdgeFlip.h).
  /// @returns Good, Bad, BlockedByShape or BlockedByDeviation.
  EdgeState Judge(const double (&apqb)[4][3]) const;

  /// The same for the two triangles of an edge. They must run through it in opposite directions.
  EdgeState Judge(const SeamSide& one, const SeamSide& other) const;

  /// The same for the edge that is opposite to both corners.
  EdgeState Judge(const PartMesh& mesh, const PartCorner& one, const PartCorner& other) const;

private:
  PackingPlan Plan;
  RuleChoice Rule;
};

/// Counts of seam edges, and of constraints between shared points.
struct SeamCounts
{
  EdgeCounts Edges; ///< A correction to the sum of the counts of all ranks; may be negative.
  std::int64_t Seams = 0; ///< Seam edges: those with triangles on two ranks that are not fixed.
  std::int64_t NonDelaunay = 0; ///< Seam edges that are bad.
  std::int64_t MissingConstraints = 0; ///< Constraints between shared points, edges on no rank.
  std::int64_t MissingToInsert = 0; ///< Of these, the ones that are to be inserted.
  /// Other constraints to be inserted, which one rank can look up alone.
  std::int64_t ToInsert = 0;

  SeamCounts& operator+=(const SeamCounts& part);
};

/// A mark for the edge opposite to a corner of a triangle of this rank.
struct MarkedCorner
{
  std::int64_t Triangle;
  std::int32_t Slot;
  EdgeMark Mark;
};

/// What is known about the edges with triangles on several ranks before the first flip. Decided
/// once for all ranks.
struct SeamSurvey
{
  std::vector<MarkedCorner> Marks;
  /// Two ids for each edge: first those that have two triangles here and are fixed because of
  /// triangles or constraints of other ranks; then the constraints of the caller that this rank can
  /// look up alone.
  std::vector<std::int64_t> Constraints;
  std::size_t NumberToFix = 0; ///< Of the first ones.
  std::vector<unsigned char> ToInsert; ///< One flag for each of them.
  /// The constraints of all ranks between shared points that are to be inserted: keys, ascending.
  std::vector<PointPair> Missing;
  SeamCounts Counts; ///< Sums over all ranks.
};

/// The mesh that the first flips start from, and its seams. In planar geometry, this is the
/// caller's mesh after insertion of the constraints that are to be inserted; otherwise the caller's
/// mesh.
///
/// Each rank inserts the constraints that stay within its part. Of those between shared points,
/// which several ranks may have, it tries all whose two points it has. A constraint that no rank
/// inserts counts as unmatched, once. Where flips need a guard, ranks insert nothing.
class PartConstraints
{
public:
  /// All ranks must call this together.
  /// @param mesh before BeginRounds; receives the changed triangles.
  PartConstraints(const PartJob& job, PartMesh& mesh);

  MeshPiece Piece; ///< Views of the caller's arrays and of arrays of this object.
  SeamSurvey Seams;
  bool IsAborted = false; ///< Whether an observer of any rank has stopped the insertion.
  double Share = 0.0; ///< Of the run that is done after the insertion.

  /// Adds the constraints that this rank has inserted and refused.
  void AddTo(FlipReport& report) const;

private:
  void Run();
  void Count(const ConstraintInsertion& insertion, std::vector<char> fates);
  void Keep(const ConstraintInsertion& insertion, const TriangleMesh& mesh);

  PartJob Job;
  PartMesh& Mesh;
  std::int64_t Inserted = 0;
  std::int64_t Flips = 0;
  std::vector<RefusedConstraint> Refused; ///< Those that this rank counts.

  // What Piece views:
  std::vector<std::int64_t> Constraints;
  std::vector<std::int32_t> Ids;
};

}

#endif
