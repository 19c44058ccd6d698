// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SEGMENTCROSSINGS_H
#define DELAUNAYFLIP_SEGMENTCROSSINGS_H

#include "PointTriangulation.h"
#include "TriangleMesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace delaunayflip
{

/// A segment between two points.
struct Segment
{
  std::int64_t From, To; ///< Ids of points.
  std::int32_t Ring; ///< -1: none.
  std::int64_t Number; ///< The number of the caller's segment.
};

/// Segments that do not cross each other.
struct SplitSegments
{
  std::vector<Segment> Segments; ///< In the order of the given segments.
  std::vector<AddedPoint> Added; ///< The points at which segments were split.
  double LargestShift = 0.0; ///< How far rounding has moved a point at most.
};

/// What these functions need of their caller.
struct CrossingsCaller
{
  /// Calls work(task) for task = 0 .. count - 1, on threads.
  std::function<void(std::int64_t count, const std::function<void(std::int64_t)>& work)> Run;
  /// Is called now and then, on the calling thread. It may throw, which ends the work.
  std::function<void()> Check;
};

/// Splits segments where they cross each other, and there also at points that are on them. New
/// points are rounded, so the parts may cross again; up to ten rounds split them. It ends early
/// where crossings multiply, as if segments overlap nearly along a line. Segments that meet at a
/// point, or overlap, do not cross.
SplitSegments SplitCrossings(
  const PlaneArray& points, std::vector<Segment> segments, const CrossingsCaller& caller);

/// Splits segments at points that are beside them within rounding. Refinement needs that: it splits
/// segments at rounded places, and the parts could pass such points on the other side.
std::vector<Segment> SplitAtNearPoints(
  const PlaneArray& points, std::vector<Segment> segments, const CrossingsCaller& caller);

}

#endif
