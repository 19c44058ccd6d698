// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef DELAUNAYFLIP_MOVETESTSUPPORT_H
#define DELAUNAYFLIP_MOVETESTSUPPORT_H

#include "GrowTestSupport.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

/// @file
/// Points that move. DELAUNAYFLIP_FRAMES is the number of frames for each family.

namespace delaunayflip
{

inline int CountFrames(int usual)
{
  const char* wanted = std::getenv("DELAUNAYFLIP_FRAMES");
  return wanted ? std::atoi(wanted) : usual / Reduction;
}

inline Triples ToTriples(const std::vector<std::int32_t>& ids)
{
  Triples triples;
  for (std::size_t i = 0; i < ids.size(); i += 3)
  {
    triples.push_back({ ids[i], ids[i + 1], ids[i + 2] });
  }
  return triples;
}

inline Drawing ToDrawing(const Places& points)
{
  Drawing drawing;
  drawing.Points = points;
  return drawing;
}

/// Sessions of the same points on different numbers of threads. All must have the same triangles.
class Moving
{
public:
  explicit Moving(Drawing drawing, const PointOptions& options = {})
    : Now(std::move(drawing)),
      Options(options)
  {
    for (const int threads : { 1, 2, 3, 16 })
    {
      this->Sessions.emplace_back(this->Now.View(), WithThreads(threads, options));
      this->Sessions.back().Advance();
    }
  }

  /// Moves all points, and expects the triangles of a new triangulation.
  void GoTo(const Places& points)
  {
    this->Now.Points = points;
    for (FlipSession& session : this->Sessions)
    {
      EXPECT_TRUE(session.Move({ View(points) }));
    }
    this->Expect();
  }

  void Expect()
  {
    const Triangulation expected = Triangulate(this->Now, this->Options);
    const FlipReport& report = this->Sessions.front().GetReport();
    const std::vector<std::int32_t> triangles = StoreTriangles(this->Sessions.front());
    ASSERT_EQ(Normalize(expected.Triangles), Normalize(triangles));
    for (const FlipSession& session : this->Sessions)
    {
      ASSERT_EQ(triangles, StoreTriangles(session));
      ASSERT_EQ(Normalize(triangles), ToTriples(StoreOrderedTriangles(session)));
      ASSERT_EQ(report.FromPoints.MoveRounds, session.GetReport().FromPoints.MoveRounds);
    }
    std::vector<std::int64_t> used(this->Now.Points.size());
    this->Sessions.front().StoreUsedPoints(used.data());
    ASSERT_EQ(expected.UsedPoints, used);
    ASSERT_EQ(StopReasonKind::Converged, report.StopReason);
    ASSERT_EQ(expected.Report.Edges.Edges, report.Edges.Edges);
    ASSERT_EQ(expected.Report.Edges.Boundary, report.Edges.Boundary);
    ASSERT_EQ(expected.Report.Edges.Fixed, report.Edges.Fixed);
    ASSERT_EQ(expected.Report.FromPoints.SegmentEdges, report.FromPoints.SegmentEdges);
    ASSERT_EQ(expected.Report.FromPoints.RefusedSegments, report.FromPoints.RefusedSegments);
    std::vector<std::int64_t> ends;
    for (const auto& edge : expected.Edges)
    {
      ends.insert(ends.end(), edge.begin(), edge.end());
    }
    ASSERT_EQ(ends, this->Sessions.front().ListSegmentEdges());
    ASSERT_EQ(expected.Report.FromPoints.Used, report.FromPoints.Used);
    ASSERT_EQ(expected.Report.FromPoints.Repeated, report.FromPoints.Repeated);
    const double angle = expected.Report.MinimumAngleAfter;
    ASSERT_NEAR(angle, report.MinimumAngleAfter, 1e-9 * angle);
    ++this->Frames;
    this->InPlace += report.FromPoints.MoveRounds > 0 ? 1 : 0;
  }

  Drawing Now;
  PointOptions Options;
  std::vector<FlipSession> Sessions;
  int Frames = 0, InPlace = 0;
};

inline double DrawStep(std::mt19937& random, double size)
{
  // The sum of three is nearly normal.
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    sum += static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 19) - 1.0;
  }
  return sum * size;
}

inline void Shake(std::mt19937& random, double size, Places& points)
{
  for (Place& point : points)
  {
    point[0] += DrawStep(random, size);
    point[1] += DrawStep(random, size);
  }
}

/// About the distance between neighbours.
inline double FindSpacing(const Places& points)
{
  Place low = points.front(), high = points.front();
  for (const Place& point : points)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
  return std::sqrt((high[0] - low[0]) * (high[1] - low[1]) / static_cast<double>(points.size()));
}

inline Places DrawPlaces(std::mt19937& random, int count)
{
  Places points;
  for (int i = 0; i < count; ++i)
  {
    points.push_back({ static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 20),
      static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 20) });
  }
  return points;
}

}

#endif
