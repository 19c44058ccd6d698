// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_REFUSEDSEGMENTS_H
#define DELAUNAYFLIP_REFUSEDSEGMENTS_H

#include "FlipReport.h"
#include "Outline.h"
#include "SegmentCrossings.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace delaunayflip
{

/// Why a segment is not inserted.
enum class RefusalKind : char
{
  CrossesEarlier, ///< It crosses a segment that was inserted before it.
  NotFinite, ///< A coordinate of an end is NaN or infinite.
  NoTriangulation, ///< There are fewer than three places, or all are on one line.
  EndInside, ///< On a sphere: an end is inside of the convex hull, so it has no triangle.
  Removed ///< An end was removed.
};

struct RefusedSegment
{
  Segment Refused;
  std::uint32_t Index; ///< Among the prepared segments.
  RefusalKind Why = RefusalKind::CrossesEarlier;
  /// Known only for segments that a message names. It is the first edge by the number of its
  /// segment, so it does not depend on the order in which threads or a GPU inserted segments.
  CrossedEdge Crossed = {};
};

/// @param edges what segments have become, in the order of the segments.
/// @returns the first segment before a refused one that crosses it; its index.
std::uint32_t FindCrossed(const PointMeshView& mesh, const PlaneArray& points,
  const std::vector<SegmentEdge>& edges, const RefusedSegment& refused);

/// What helps where segments cross in the plane; follows the words of the defect.
const char* GetRemedy(bool wereSplit);

/// Adds a defect for every reason, which names the first segments.
/// @param refused by their numbers. @param ends of the caller's segments, pairs of point ids.
/// @param remedy what helps where segments cross.
void AddDefects(const std::vector<RefusedSegment>& refused, const std::int64_t* ends,
  const char* remedy, std::vector<Defect>& defects);

/// Says why a segment of a ring is refused.
std::string DescribeRefusal(
  const RefusedSegment& ofRing, const std::int64_t* ends, const char* remedy);

}

#endif
