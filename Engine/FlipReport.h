// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_FLIPREPORT_H
#define DELAUNAYFLIP_FLIPREPORT_H

#include "EngineExport.h"
#include "FlipOptions.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// @file
/// What a run did, and what it met in the input.

namespace delaunayflip
{

enum class StopReasonKind
{
  NotStarted,
  Converged, ///< An iteration found nothing that it may flip.
  IterationLimit, ///< FlipOptions::MaximumIterations, or the safety limit of surfaces.
  Aborted, ///< The observer said so.
  Running ///< No end yet: FlipSession::Advance made the iterations that it was to make.
};

/// One iteration of the loop. NonDelaunay = Flipped + Excluded + Blocked.
struct IterationRecord
{
  std::int64_t Iteration = 0; ///< 1, 2, ...
  std::int64_t Tested = 0; ///< Edges judged.
  std::int64_t NonDelaunay = 0; ///< Bad edges known when the iteration chose (never fixed ones).
  std::int64_t Flipped = 0;
  std::int64_t Excluded = 0; ///< Wanted to flip; a neighbour did, or it lay between chunks.
  std::int64_t Blocked = 0; ///< Bad, but the flip would fold the mesh or duplicate an edge.
  double MinimumAngle = 0.0; ///< Degrees, after the iteration; NaN where it was not computed.
  double Seconds = 0.0;
};

/// Edges of the input by kind, each a pair of distinct vertices counted once. An edge may be of
/// several kinds; FixedEdges counts it once.
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

/// What the ids of a defect number.
enum class DefectIds
{
  Triangles, ///< The caller's triangle slots.
  Points
};

/// A kind of dirt met in the input, with how often and where first.
struct Defect
{
  std::string What; ///< For people, e.g. "triangles with a repeated point id".
  std::int64_t Count = 0; ///< How many.
  std::vector<std::int64_t> FirstIds; ///< At most three, ascending; empty where ids do not help.
  DefectIds Ids = DefectIds::Triangles;
};

struct FlipReport
{
  std::int64_t Points = 0;
  std::int64_t Triangles = 0;
  EdgeCounts Edges;
  std::int64_t UnmatchedConstraints = 0; ///< Given by the caller, and not an edge of the mesh.
  std::int64_t EulerCharacteristic = 0; ///< Used points - edges + triangles; flips keep it.

  GeometryKind GeometryUsed = GeometryKind::Auto; ///< Never Auto after a run.
  std::string GeometryReason; ///< Why it was used, for people; also says where
                              ///< FlipOptions::FeatureAngle has no effect.
  std::string Tolerance; ///< "automatic", the value asked for (e.g. "1e-09"), or "none" where the
                         ///< in-circle predicate decides.
  std::string Backend; ///< E.g. "Threads: 8" or "CUDA: NVIDIA H200".
  std::string Fallback; ///< Why the CPU stood in for a GPU that is there; else empty.

  std::vector<IterationRecord> Iterations;
  std::int64_t TotalFlips = 0;
  std::int64_t TotalExcluded = 0;
  std::int64_t TotalBlocked = 0;
  std::int64_t NonDelaunayBefore = 0; ///< Bad edges of the input that are not fixed.
  std::int64_t NonDelaunayAfter = 0; ///< Bad edges left, flippable or blocked.
  double MinimumAngleBefore =
    0.0; ///< Degrees; 0 with a degenerate triangle; NaN without triangles.
  double MinimumAngleAfter = 0.0;

  StopReasonKind StopReason = StopReasonKind::NotStarted;
  bool Converged() const { return this->StopReason == StopReasonKind::Converged; }

  double BuildSeconds = 0.0; ///< From the caller's arrays to the edge mesh.
  double FlipSeconds = 0.0; ///< The loop.

  /// Empty for a clean mesh. The last may be triangles that flips in space have turned over in x
  /// and y, known when a run has stopped.
  std::vector<Defect> Defects;
};

/// Called on the calling thread after every iteration; false aborts the run. Where iterations run
/// together, their calls come one after the other when all of them are done, and an abort takes
/// effect there: the first 12 of large planar meshes, and on a GPU up to 128, but no more than fit
/// a tenth of a second.
using FlipObserver = std::function<bool(const IterationRecord&)>;

/// Called on the calling thread with the share of the work that is done, 0 .. 1, which never falls;
/// false aborts the run. The share is an estimate of time: the build and the first test of all
/// edges are half of it, 0.65 on surfaces, and the rest follows the flips made and those expected.
/// 1 is told when there is nothing more to do.
using ProgressObserver = std::function<bool(double)>;

/// "converged", "iteration limit", "aborted", "running" or "not started".
DELAUNAYFLIP_EXPORT const char* ToString(StopReasonKind reason);

/// "auto", "planar", "planar-xy" or "surface".
DELAUNAYFLIP_EXPORT const char* ToString(GeometryKind geometry);

/// FlipReport::Tolerance of a run with these options in that geometry.
DELAUNAYFLIP_EXPORT std::string DescribeTolerance(const FlipOptions& options, GeometryKind used);

/// The defects as one sentence, e.g. "12 zero-area triangles (first: 3, 8, 11); ..."; empty if
/// none.
DELAUNAYFLIP_EXPORT std::string DescribeDefects(const std::vector<Defect>& defects);

}

#endif
