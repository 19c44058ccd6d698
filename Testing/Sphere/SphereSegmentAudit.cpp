// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "SphereSegmentAudit.h"

#include "References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace delaunayflip
{

namespace
{
using PointPair = std::pair<std::int64_t, std::int64_t>;

/// Whether the segments a-b and c-d have one point in common, which is an end of neither.
bool DoCross(const Point3& a, const Point3& b, const Point3& c, const Point3& d)
{
  const int ofC = FindSphereSide(a, b, c), ofA = FindSphereSide(c, d, a);
  return ofC * FindSphereSide(a, b, d) < 0 && ofA * FindSphereSide(c, d, b) < 0 && ofA == -ofC;
}

/// Whether p is on the way from a to b, or at b. All are on one great circle. Seen along an axis
/// that is not in its plane, the ways around the origin are the same.
bool IsOnWay(const Point3& a, const Point3& b, const Point3& p)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto turn = [axis](const Point3& from, const Point3& to)
    {
      Point3 along{};
      along[axis] = 1.0;
      return FindSphereSide(from, to, along);
    };
    const int whole = turn(a, b);
    if (whole != 0)
    {
      return turn(a, p) == whole && (turn(p, b) == whole || p == b);
    }
  }
  return false;
}

/// The points of a segment after its first end, in their order.
std::vector<std::int64_t> ListOnWay(const std::vector<Point3>& points,
  const std::set<std::int64_t>& corners, std::int64_t from, std::int64_t to)
{
  std::vector<std::int64_t> found;
  const Point3 &a = points[from], &b = points[to];
  std::copy_if(corners.begin(), corners.end(), std::back_inserter(found),
    [&](std::int64_t i)
    { return FindSphereSide(a, b, points[i]) == 0 && IsOnWay(a, b, points[i]); });
  std::sort(found.begin(), found.end(),
    [&](std::int64_t i, std::int64_t j) { return i != j && IsOnWay(a, points[j], points[i]); });
  return found;
}
}

SegmentResult TriangulateOnSphere(const PointInput& input, const PointOptions& options)
{
  const FlipSession session = FlipPoints(input, options);
  SegmentResult result;
  result.Report = session.GetReport();
  result.Triangles = StoreTriangles(session);
  result.Neighbors.resize(result.Triangles.size());
  session.StoreNeighbors(result.Neighbors.data());
  result.Used.resize(input.Points.Count);
  session.StoreUsedPoints(result.Used.data());
  result.Edges = session.ListSegmentEdges();
  result.SegmentsOfEdges = session.ListSegmentsOfEdges();
  return result;
}

int FindSphereSide(const Point3& a, const Point3& b, const Point3& p)
{
  double sum = 0.0, magnitude = 0.0; // of the terms of a determinant
  for (int axis = 0; axis < 3; ++axis)
  {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double minor = b[next] * p[last] - b[last] * p[next];
    sum += a[axis] * minor;
    magnitude += std::fabs(a[axis]) * (std::fabs(b[next] * p[last]) + std::fabs(b[last] * p[next]));
  }
  // A product of two coordinates may underflow, and then be multiplied by a large one.
  double largest = 1.0;
  for (const Point3* point : { &a, &b, &p })
  {
    for (const double coordinate : *point)
    {
      largest = std::max(largest, std::fabs(coordinate));
    }
  }
  const bool isCertain = magnitude > 1e-200 * largest && std::fabs(sum) > 1e-14 * magnitude;
  if (isCertain) // nearly always, and without rational numbers
  {
    return sum > 0.0 ? 1 : -1;
  }
  return RationalOrientation3D(a, b, p, { 0.0, 0.0, 0.0 });
}

void ExpectDelaunayOnSphere(const std::vector<Point3>& points, const SegmentResult& result)
{
  const std::set<VertexPair> kept = ToEdges(result.Edges);
  EXPECT_EQ(2 * kept.size(), result.Edges.size());
  std::map<PointPair, std::int32_t> apexes; // by side, the third corner to the left
  for (std::size_t i = 0; i < result.Triangles.size(); ++i)
  {
    const std::int32_t* ids = &result.Triangles[i - i % 3];
    const PointPair side(ids[(i + 1) % 3], ids[(i + 2) % 3]);
    EXPECT_TRUE(apexes.emplace(side, ids[i % 3]).second);
  }
  std::size_t found = 0;
  for (const auto& [side, apex] : apexes)
  {
    const Point3 &a = points[side.first], &b = points[side.second], &c = points[apex];
    EXPECT_EQ(1, FindSphereSide(a, b, c));
    const auto across = apexes.find({ side.second, side.first });
    const bool isKept = kept.count(Sorted(side.first, side.second)) > 0;
    const bool isFirst = across == apexes.end() || side.first < side.second;
    found += isKept && isFirst ? 1 : 0;
    if (across != apexes.end() && !isKept)
    {
      EXPECT_LE(0, RationalOrientation3D(a, b, c, points[across->second]));
    }
  }
  EXPECT_EQ(kept.size(), found) << "edges of segments are edges of triangles";
}

void ExpectSegmentsOnSphere(const std::vector<Point3>& points,
  const std::vector<std::int64_t>& segments, const SegmentResult& result)
{
  const std::set<VertexPair> edges = ToEdges(result.Edges);
  const std::set<std::int64_t> corners(result.Triangles.begin(), result.Triangles.end());
  std::int64_t refused = 0;
  for (std::size_t i = 0; i < segments.size(); i += 2)
  {
    const std::int64_t from = result.Used[segments[i]], to = result.Used[segments[i + 1]];
    bool isRefused = corners.count(from) == 0 || corners.count(to) == 0;
    for (std::size_t k = 0; k < result.Edges.size() && !isRefused; k += 2)
    {
      const bool isEarlier = result.SegmentsOfEdges[k / 2] < static_cast<std::int64_t>(i / 2);
      isRefused = isEarlier &&
        DoCross(points[from], points[to], points[result.Edges[k]], points[result.Edges[k + 1]]);
    }
    if (isRefused)
    {
      ++refused;
      continue;
    }
    std::int64_t last = from;
    for (const std::int64_t next : ListOnWay(points, corners, from, to))
    {
      EXPECT_EQ(1u, edges.count(Sorted(last, next))) << "segment " << i / 2;
      last = next;
    }
    EXPECT_EQ(to, last);
  }
  EXPECT_EQ(refused, result.Report.FromPoints.RefusedSegments);
}

std::set<std::set<Point3>> ListTrianglePlaces(
  const std::vector<Point3>& points, const std::vector<std::int32_t>& triangles)
{
  std::set<std::set<Point3>> places;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    places.insert({ points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]] });
  }
  return places;
}

}
