// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_SPHERESEGMENTAUDIT_H
#define DELAUNAYFLIP_SPHERESEGMENTAUDIT_H

#include "FlipTestSupport.h"
#include "PointTriangulation.h"

#include <cstdint>
#include <set>
#include <vector>

/// @file
/// Triangulations on a sphere with segments, judged by rational numbers.

namespace delaunayflip
{

struct SegmentResult
{
  std::vector<std::int32_t> Triangles, Neighbors;
  std::vector<std::int64_t> Used, Edges, SegmentsOfEdges;
  FlipReport Report;
};

SegmentResult TriangulateOnSphere(const PointInput& input, const PointOptions& options);

/// The side of the great circle from a to b on which p is: 1, left; -1, right; 0, on it.
int FindSphereSide(const Point3& a, const Point3& b, const Point3& p);

/// All triangles face away from the origin, no two overlap along an edge, and all edges but those
/// of segments are convex.
void ExpectDelaunayOnSphere(const std::vector<Point3>& points, const SegmentResult& result);

/// Each segment is a chain of edges, or it has an end without a triangle, or crosses an earlier
/// one.
/// @param segments pairs of ids; no two ends are opposite.
void ExpectSegmentsOnSphere(const std::vector<Point3>& points,
  const std::vector<std::int64_t>& segments, const SegmentResult& result);

/// Triangles as sets of places, which do not depend on the ids of points.
std::set<std::set<Point3>> ListTrianglePlaces(
  const std::vector<Point3>& points, const std::vector<std::int32_t>& triangles);

}

#endif
