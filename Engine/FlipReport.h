// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPREPORT_H
#define DELAUNAYFLIP_FLIPREPORT_H

#include "EngineExport.h"
#include "FlipOptions.h"
#include "PointTriangulation.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// @file
/// A FlipReport says what a run did, and what it found in the input:
///
///     const double xyz[] = { 0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0 };
///     std::int32_t ids[] = { 0, 1, 2, 0, 2, 3 };
///     TriangleMesh mesh;
///     mesh.Points = PointArray(xyz, 4);
///     mesh.Triangles = TriangleArray(ids, 2);
///     const FlipReport report = FlipToDelaunay(mesh, {}, MutableTriangleArray(ids, 2));
///     report.NonDelaunayBefore; // 1
///     report.NonDelaunayAfter; // 0
///     report.Edges.Boundary; // 4
///     report.Defects.empty(); // true
///     Count(report.TotalFlips, "flip"); // "1 flip"
///
/// Summarize writes it in lines of text.

namespace delaunayflip
{

enum class StopReasonKind
{
  NotStarted,
  Converged, ///< An iteration found no edge that may flip.
  IterationLimit, ///< FlipOptions::MaximumIterations, or the safety limit of surfaces.
  Aborted, ///< An observer stopped the run.
  Running ///< FlipSession::Advance made the requested iterations; there is more to do.
};

/// One iteration of the loop. NonDelaunay = Flipped + Excluded + Blocked.
struct IterationRecord
{
  std::int64_t Iteration = 0; ///< 1, 2, ...
  std::int64_t Tested = 0; ///< Edges judged.
  std::int64_t NonDelaunay = 0; ///< Bad edges when the iteration chose; fixed edges never count.
  std::int64_t Flipped = 0;
  std::int64_t Excluded = 0; ///< Bad and free, but a neighbour flipped, or between chunks.
  /// Bad, but the flip would fold the mesh over, move it too far, or repeat an edge.
  std::int64_t Blocked = 0;
  double MinimumAngle = 0.0; ///< In degrees, after the iteration; NaN if not computed.
  double Seconds = 0.0;
};

/// Edges of the input by kind. An edge is a pair of distinct vertices and counts once, but may be
/// of several kinds.
struct EdgeCounts
{
  std::int64_t Edges = 0;
  std::int64_t Boundary = 0; ///< One incident triangle.
  std::int64_t NonManifold = 0; ///< Three or more incident triangles.
  std::int64_t WronglyWound = 0; ///< Two incident triangles that run through it the same way.
  std::int64_t Feature = 0; ///< Sharper than FlipOptions::FeatureAngle.
  std::int64_t Constraint = 0; ///< Given by the caller and present in the mesh.
  std::int64_t Region = 0; ///< Between triangles of different regions.
  std::int64_t Fixed = 0; ///< Edges that never flip, for any reason.
};

/// What the ids of a defect refer to.
enum class DefectIds
{
  Triangles, ///< The caller's triangle slots.
  Points,
  PointPairs, ///< Two ids for each: ends of edges, in the caller's order.
  Rings, ///< The caller's numbers.
  Seeds ///< The numbers of region seeds.
};

/// What a segment or constraint would cross, although it stays.
struct CrossedEdge
{
  /// The number of an earlier segment, or of another constraint, among the caller's; -1: an edge of
  /// the mesh that stays for another reason.
  std::int64_t Number = -1;
  std::int64_t Ends[2] = { -1, -1 }; ///< The points between which it lies.
};

constexpr std::int64_t MostNamedIds = 3; ///< How many of each kind of defect.

/// What is wrong with the input, or was left out. DescribeDefects has the words.
enum class DefectKind
{
  Other, ///< Defect::Detail says it.
  PointsNotFinite,
  RepeatedIds, ///< Triangles that name a point twice. They have no edges.
  TrianglesWithoutArea,
  TurnedFromMost, ///< Triangles of a plane that face the other way than most.
  DuplicateTriangles,
  TurnedFromAbove, ///< This one and the next two keep a mesh from being a height field.
  FlatFromAbove,
  OverlapFromAbove,
  TurnedByFlips, ///< Triangles in x and y, of a mesh that was a height field or nearly one.
  SeparateTriangles, ///< No two share an edge.
  ConstraintsNotEdges, ///< Constraints that are not edges, and were not to be inserted.
  ConstraintsLeaveMesh, ///< This one and the next five cannot be inserted.
  ConstraintsLeavePart,
  ConstraintsCross, ///< Defect::Crossed says what.
  ConstraintsMeetOverlap,
  ConstraintsNeedGuard,
  ConstraintsOnSurface,
  PointsRepeated,
  PointsTooNear,
  SegmentsCross, ///< Defect::Crossed says what.
  SegmentsNotFinite,
  SegmentsWithoutTriangles,
  HoleSeedsOutside,
  RingsWithoutArea,
  RingsRepeated, ///< With the edges of an earlier one.
  RingsRunAgain, ///< With a loop that is run more than once.
  HolePointsOutside, ///< Points of holes on the convex hull, beyond all other points.
  PointsWithoutTriangles, ///< There are fewer than three places, or all are on one line.
  NothingLeft, ///< Points of which none is left when triangles are removed.
  PolygonsTooSmall, ///< With fewer than three different points.
  ConstraintsNotInMesh, ///< Those of a filter's second input.
  PointsWithoutHeights, ///< Those of segments, where other points have heights.
  RegionSeedsOutside, ///< In no triangle that is kept.
  TrianglesNotRefined, ///< Triangles that do not reach the goals of refinement.
  PointLimitReached, ///< Refinement has reached it.
  PointsInside, ///< On a sphere: points inside of the convex hull.
  PointsInOnePlane, ///< On a sphere: no points have triangles; Detail says why.
  SegmentsInside, ///< On a sphere: an end is inside of the convex hull.
  RegionSeedsRepeated, ///< In the same part as an earlier one, with another label or area.
  OptionsWithoutGoal, ///< Options of refinement, where no goal asks for it.
  TrianglesNotJudged, ///< Refinement has not begun, because FlipOptions::MaximumIterations ends it.
  SegmentsRemoved ///< An end was removed.
};

/// A kind of defect in the input: how often it occurs, and where first.
struct Defect
{
  Defect() = default;
  DELAUNAYFLIP_EXPORT explicit Defect(
    DefectKind kind, std::int64_t count = 0, std::vector<std::int64_t> firstIds = {});
  /// One of another kind, in words.
  Defect(std::string words, std::int64_t count)
    : Count(count),
      Detail(std::move(words))
  {
  }

  DefectKind Kind = DefectKind::Other;
  std::int64_t Count = 0; ///< How many.
  std::vector<std::int64_t> FirstIds; ///< At most three, ascending; empty if ids would not help.
  DefectIds Ids = DefectIds::Triangles;
  std::vector<CrossedEdge> Crossed; ///< By pair of ids; empty if the reason is another one.
  std::string Detail; ///< Follows the words of the kind, such as numbers; mostly empty.

  /// Whether both are told as one, with the sum of the counts.
  bool IsLike(const Defect& other) const
  {
    return this->Kind == other.Kind && this->Detail == other.Detail;
  }
};

struct FlipReport
{
  std::int64_t Points = 0;
  std::int64_t Triangles = 0;
  EdgeCounts Edges;
  std::int64_t UnmatchedConstraints = 0; ///< Constraint edges that are not edges of the mesh and
                                         ///< were not inserted.
  std::int64_t InsertedConstraints = 0; ///< Constraint edges that flips turned into edges, or
                                        ///< chains of edges, before the first iteration.
  std::int64_t ConstraintFlips = 0; ///< How many flips that took. Not in TotalFlips or Iterations.
  /// Used points - edges + triangles that name no point twice; flips keep it.
  std::int64_t EulerCharacteristic = 0;

  GeometryKind GeometryUsed = GeometryKind::Auto; ///< Never Auto after a run.
  /// Why it was used, in words; also says if FlipOptions::FeatureAngle has no effect.
  std::string GeometryReason;
  /// "automatic", the value (e.g. "1e-09"), or "none" if the in-circle predicate decides.
  std::string Tolerance;
  std::string Backend; ///< E.g. "Threads: 8" or "CUDA: NVIDIA H200".
  std::string Fallback; ///< Why the CPU replaced a GPU that exists; else empty.

  std::vector<IterationRecord> Iterations;
  std::int64_t TotalFlips = 0;
  std::int64_t TotalExcluded = 0;
  std::int64_t TotalBlocked = 0;
  std::int64_t NonDelaunayBefore = 0; ///< Bad edges before the first iteration that are not fixed.
  std::int64_t NonDelaunayAfter = 0; ///< Bad edges that are left, blocked or not.
  std::int64_t BlockedByShape = 0; ///< Bad edges left: their flip would fold the mesh over.
  std::int64_t BlockedByDeviation = 0; ///< Bad edges left: a bound on deviation blocks them.
  std::int64_t BlockedByEdge = 0; ///< Bad edges left: their flip would repeat an edge.
  double MinimumAngleBefore = 0.0; ///< Degrees; 0 with a degenerate triangle; NaN without
                                   ///< triangles, and of a session from points.
  double MinimumAngleAfter = 0.0;
  std::int64_t TrianglesBelow10Before = 0; ///< Triangles with an angle below 10 degrees; or without
                                           ///< area. 0 of a session from points.
  std::int64_t TrianglesBelow10After = 0;
  std::int64_t TrianglesBelow20Before = 0;
  std::int64_t TrianglesBelow20After = 0;
  std::int64_t TrianglesBelow30Before = 0;
  std::int64_t TrianglesBelow30After = 0;
  /// Whether feature edges or constraints keep one of the ten triangles with the smallest angles at
  /// the end, with an angle below 5 degrees. False for points, and for meshes in parts.
  bool KeepsSliver = false;
  // What hides bad edges; 0 for points, and for meshes in parts.
  std::int64_t DuplicateTriangles = 0; ///< Triangles with the three points of an earlier one.
  /// Edges that are wrongly wound at the end, and have opposite angles of more than pi together.
  std::int64_t HiddenByWinding = 0;
  /// Angles above 90 degrees opposite to non-manifold edges before the first flip. An edge that
  /// would be bad has one.
  std::int64_t ObtuseAtNonManifold = 0;

  StopReasonKind StopReason = StopReasonKind::NotStarted;
  bool Converged() const { return this->StopReason == StopReasonKind::Converged; }

  PointCounts FromPoints; ///< For sessions from points.

  double BuildSeconds = 0.0; ///< From the caller's arrays to the edge mesh.
  double FlipSeconds = 0.0; ///< The loop.

  /// Empty for a clean mesh. The last one may be triangles that flips in space have turned over in
  /// x and y; it is added when a run has stopped.
  std::vector<Defect> Defects;
};

// The members that are summed when reports are joined, and the texts that are listed. The numbers
// of the report itself are those of ForEachNumber.

constexpr std::int64_t EdgeCounts::*EdgeKinds[] = { &EdgeCounts::Edges, &EdgeCounts::Boundary,
  &EdgeCounts::NonManifold, &EdgeCounts::WronglyWound, &EdgeCounts::Feature,
  &EdgeCounts::Constraint, &EdgeCounts::Region, &EdgeCounts::Fixed };

constexpr std::int64_t IterationRecord::*IterationTotals[] = { &IterationRecord::Tested,
  &IterationRecord::NonDelaunay, &IterationRecord::Flipped, &IterationRecord::Excluded,
  &IterationRecord::Blocked };

constexpr std::string FlipReport::*ReportTexts[] = { &FlipReport::GeometryReason,
  &FlipReport::Tolerance, &FlipReport::Backend, &FlipReport::Fallback };

/// Which numbers of a report belong together.
enum class NumberKind
{
  Main, ///< Every mesh has it, and VTK's field data.
  Mesh, ///< Every mesh has it.
  Whole, ///< A mesh that is not in parts has it; else it is 0.
  Points, ///< A mesh that was made from points has it; else it is 0.
  Seconds ///< A time, which differs between runs.
};

/// Whether the number of a mesh in parts is the sum over the parts.
inline bool IsSummed(NumberKind kind)
{
  return kind == NumberKind::Main || kind == NumberKind::Mesh;
}

/// Calls visit(name, kind, number...) for each number, with those of all reports side by side.
///
/// The name is that of the C struct, of Python and of the command's JSON. Field data has it in
/// upper camel case. The order is that of delaunayflip_report, which needs it.
template <typename Visit, typename... Reports>
void ForEachNumber(const Visit& visit, Reports&... reports)
{
  constexpr NumberKind main = NumberKind::Main;
  constexpr NumberKind mesh = NumberKind::Mesh;
  constexpr NumberKind whole = NumberKind::Whole;
  constexpr NumberKind points = NumberKind::Points;
  constexpr NumberKind seconds = NumberKind::Seconds;
  visit("total_flips", main, reports.TotalFlips...);
  visit("total_excluded", mesh, reports.TotalExcluded...);
  visit("total_blocked", mesh, reports.TotalBlocked...);
  visit("non_delaunay_before", mesh, reports.NonDelaunayBefore...);
  visit("non_delaunay_after", main, reports.NonDelaunayAfter...);
  visit("blocked_by_shape", main, reports.BlockedByShape...);
  visit("blocked_by_edge", main, reports.BlockedByEdge...);
  visit("edges", mesh, reports.Edges.Edges...);
  visit("boundary_edges", mesh, reports.Edges.Boundary...);
  visit("non_manifold_edges", main, reports.Edges.NonManifold...);
  visit("wrongly_wound_edges", mesh, reports.Edges.WronglyWound...);
  visit("feature_edges", mesh, reports.Edges.Feature...);
  visit("constraint_edges", main, reports.Edges.Constraint...);
  visit("region_edges", mesh, reports.Edges.Region...);
  visit("fixed_edges", main, reports.Edges.Fixed...);
  visit("unmatched_constraints", main, reports.UnmatchedConstraints...);
  visit("inserted_constraints", main, reports.InsertedConstraints...);
  visit("constraint_flips", main, reports.ConstraintFlips...);
  visit("euler_characteristic", mesh, reports.EulerCharacteristic...);
  visit("minimum_angle_before", mesh, reports.MinimumAngleBefore...);
  visit("minimum_angle_after", mesh, reports.MinimumAngleAfter...);
  visit("build_seconds", seconds, reports.BuildSeconds...);
  visit("flip_seconds", seconds, reports.FlipSeconds...);
  visit("points", mesh, reports.Points...);
  visit("triangles", mesh, reports.Triangles...);
  visit("points_not_finite", points, reports.FromPoints.NotFinite...);
  visit("repeated_points", points, reports.FromPoints.Repeated...);
  visit("points_too_near", points, reports.FromPoints.TooNear...);
  visit("segment_edges", points, reports.FromPoints.SegmentEdges...);
  visit("refused_segments", points, reports.FromPoints.RefusedSegments...);
  visit("crossings", points, reports.FromPoints.Crossings...);
  visit("largest_shift", points, reports.FromPoints.LargestShift...);
  visit("outside_triangles", points, reports.FromPoints.OutsideTriangles...);
  visit("large_triangles", points, reports.FromPoints.LargeTriangles...);
  visit("keeps_sliver", whole, reports.KeepsSliver...);
  visit("blocked_by_deviation", main, reports.BlockedByDeviation...);
  visit("duplicate_triangles", whole, reports.DuplicateTriangles...);
  visit("hidden_by_winding", whole, reports.HiddenByWinding...);
  visit("obtuse_at_non_manifold", whole, reports.ObtuseAtNonManifold...);
  visit("used_points", points, reports.FromPoints.Used...);
  visit("triangles_below_10_before", main, reports.TrianglesBelow10Before...);
  visit("triangles_below_10_after", main, reports.TrianglesBelow10After...);
  visit("triangles_below_20_before", main, reports.TrianglesBelow20Before...);
  visit("triangles_below_20_after", main, reports.TrianglesBelow20After...);
  visit("triangles_below_30_before", main, reports.TrianglesBelow30Before...);
  visit("triangles_below_30_after", main, reports.TrianglesBelow30After...);
  visit("left_out_rings", points, reports.FromPoints.LeftOutRings...);
  visit("refinement_points", main, reports.FromPoints.RefinementPoints...);
  visit("refinement_rounds", main, reports.FromPoints.RefinementRounds...);
  visit("unrefined_triangles", main, reports.FromPoints.UnrefinedTriangles...);
  visit("reached_point_limit", main, reports.FromPoints.ReachedPointLimit...);
  visit("removed_points", whole, reports.FromPoints.Removed...);
  visit("move_rounds", points, reports.FromPoints.MoveRounds...);
  visit("points_inside", points, reports.FromPoints.Inside...);
}

/// Called on the calling thread for every iteration; returning false aborts the run. Some
/// iterations run in batches: the first 12 of large planar meshes, and on a GPU up to 128, but no
/// more than fit into a tenth of a second. The calls for a batch follow at its end, and an abort
/// takes effect there. It is not called for rounds of refinement; a ProgressObserver is.
using FlipObserver = std::function<bool(const IterationRecord&)>;

/// Called on the calling thread with the share of the work that is done, from 0 to 1, which never
/// decreases; returning false aborts the run. The share is an estimate of time: the build and the
/// first test of all edges are half of it (0.65 on surfaces), and the rest is estimated from the
/// flips made and expected. It is 1 when there is nothing more to do.
using ProgressObserver = std::function<bool(double)>;

/// Thrown by functions without a report when a progress observer wants to stop them.
struct RunAborted
{
};

/// "converged", "iteration limit", "aborted", "running" or "not started".
DELAUNAYFLIP_EXPORT const char* ToString(StopReasonKind reason);

/// "auto", "planar", "planar-xy", "surface", "sphere" or "mixed".
DELAUNAYFLIP_EXPORT const char* ToString(GeometryKind geometry);

/// E.g. "TotalFlips" for "total_flips".
DELAUNAYFLIP_EXPORT std::string ToCamelCase(const std::string& name);

/// FlipReport::Tolerance of a run with these options in that geometry.
DELAUNAYFLIP_EXPORT std::string DescribeTolerance(const FlipOptions& options, GeometryKind used);

/// The defects as one sentence, e.g. "12 zero-area triangles (first: 3, 8, 11); ..."; empty if
/// none.
DELAUNAYFLIP_EXPORT std::string DescribeDefects(const std::vector<Defect>& defects);

/// Why a segment cannot be inserted, e.g. "crosses segment 12 (points 1 and 4)".
/// @param kind SegmentsCross or ConstraintsCross.
std::string DescribeCrossed(const CrossedEdge& crossed, DefectKind kind);

/// What a caller adds to the text about a run.
struct SummaryNotes
{
  double WantedAngle = 0.0; ///< The smallest angle that was asked for, in degrees; 0: none.
  std::string Hint; ///< One line, which stands before the geometry, with its end; mostly empty.
  std::int64_t Iterations = -1; ///< Their number; -1: as many as the report has records of.
};

/// What was done, in lines of a title, ": " and a text; "" without triangles.
DELAUNAYFLIP_EXPORT std::string Summarize(
  const FlipReport& report, const SummaryNotes& notes = SummaryNotes());

/// E.g. "1,234,567 points"; the number alone without a noun.
DELAUNAYFLIP_EXPORT std::string Count(std::int64_t number, const std::string& singular = "");

/// A number with a point, whatever language the program has chosen.
DELAUNAYFLIP_EXPORT std::string FormatNumber(double value, int digits);

//------------------------------------------------------------------------------
/// Adds the report of another mesh, flipped after this one. Counts are summed, those of iterations
/// row by row; the stop reason is the worse of the two, and angles are the smaller ones. Ids of
/// defects are kept for the first mesh alone, and dropped by the next: they mean nothing outside
/// their mesh.
DELAUNAYFLIP_EXPORT void AddReport(FlipReport& sum, const FlipReport& other);

/// Adds the members above, the smallest angles and the defects too. An angle that is NaN does not
/// count.
void AddTotals(FlipReport& sum, const FlipReport& part);

/// Adds the counts of an iteration to those of the same number.
IterationRecord& AddIteration(FlipReport& sum, const IterationRecord& row);

/// @param factor 1 to add, -1 to subtract.
void AddCounts(EdgeCounts& sum, const EdgeCounts& part, std::int64_t factor);

/// Adds a defect, or to the count of the same one. Ids mean nothing outside their rank or part.
void AddDefect(const Defect& defect, std::vector<Defect>& defects);

}

#endif
