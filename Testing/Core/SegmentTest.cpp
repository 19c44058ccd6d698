// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

/// @file
/// Triangulations of points with segments, outlines and holes, judged by rational numbers.

namespace delaunayflip
{
namespace
{

/// Whether two segments have one place in common that is an end of neither, and no point is there.
bool DoCross(const Places& points, const std::array<std::int64_t, 2>& first,
  const std::array<std::int64_t, 2>& second)
{
  const auto areApart = [&](const auto& line, const auto& other) {
    return Turn(points, line[0], line[1], other[0]) * Turn(points, line[0], line[1], other[1]) < 0;
  };
  bool cross = areApart(first, second) && areApart(second, first);
  for (std::int64_t i = 0; cross && i < static_cast<std::int64_t>(points.size()); ++i)
  {
    cross = Turn(points, first[0], first[1], i) != 0 || Turn(points, second[0], second[1], i) != 0;
  }
  return cross;
}

Drawing DrawRandom(std::mt19937& random, std::size_t points, std::size_t segments, int size)
{
  Drawing drawing;
  drawing.Points = DrawOnGrid(random, points, size, size);
  for (std::size_t i = 0; i < segments; ++i)
  {
    const auto count = static_cast<int>(points);
    drawing.Segments.push_back({ DrawIndex(random, count), DrawIndex(random, count) });
  }
  return drawing;
}

/// The segments that are refused: those that cross an earlier one that is not.
/// @param crossed receives for each the number of the first one that it crosses.
Pairs ListRefused(const Drawing& drawing, std::vector<std::int64_t>* crossed = nullptr)
{
  Pairs refused;
  std::vector<std::int64_t> taken;
  for (std::size_t i = 0; i < drawing.Segments.size(); ++i)
  {
    const auto& segment = drawing.Segments[i];
    const auto found = std::find_if(taken.begin(), taken.end(),
      [&](std::int64_t j) { return DoCross(drawing.Points, drawing.Segments[j], segment); });
    if (found == taken.end())
    {
      taken.push_back(static_cast<std::int64_t>(i));
      continue;
    }
    refused.push_back(segment);
    if (crossed)
    {
      crossed->push_back(*found);
    }
  }
  return refused;
}

/// The report names the first segments that are refused, and which ones they cross.
void ExpectNamed(const Drawing& drawing, const FlipReport& report)
{
  std::vector<std::int64_t> crossed;
  const Pairs refused = ListRefused(drawing, &crossed);
  ASSERT_EQ(static_cast<std::int64_t>(refused.size()), report.FromPoints.RefusedSegments);
  const auto defect = std::find_if(report.Defects.begin(), report.Defects.end(),
    [](const Defect& one) { return !one.Crossed.empty(); });
  ASSERT_EQ(refused.empty(), defect == report.Defects.end());
  const std::size_t named = std::min<std::size_t>(refused.size(), 3);
  ASSERT_EQ(named, refused.empty() ? 0 : defect->Crossed.size());
  for (std::size_t i = 0; i < named; ++i)
  {
    const auto& other = drawing.Segments[crossed[i]];
    EXPECT_EQ(crossed[i], defect->Crossed[i].Number);
    EXPECT_EQ(other[0], defect->Crossed[i].Ends[0]);
    EXPECT_EQ(other[1], defect->Crossed[i].Ends[1]);
    EXPECT_EQ(refused[i][0], defect->FirstIds[2 * i]);
    EXPECT_EQ(refused[i][1], defect->FirstIds[2 * i + 1]);
  }
}

/// The area of triangles, times two. Exact for small integers.
double SumArea(const Places& points, const std::vector<std::int32_t>& triangles)
{
  return SumAreas(ToMesh(points, triangles).View());
}

double Measure(const Places& points, std::int64_t a, std::int64_t b)
{
  return std::hypot(points[a][0] - points[b][0], points[a][1] - points[b][1]);
}

/// All edges of whole grids. All places are used, so that few or many edges pass through points.
TEST(Segments, OnSmallGrids)
{
  std::mt19937 random(1);
  for (int i = 0; i < 2000 / Reduction; ++i)
  {
    const Drawing drawing =
      DrawRandom(random, 4 + random() % 30, random() % 12, 2 + DrawIndex(random, 9));
    const Triangulation result = Triangulate(drawing);
    ExpectRightNumber({ drawing.Points.begin(), drawing.Points.end() }, result);
    if (!result.Triangles.empty())
    {
      ExpectConstrainedDelaunay(drawing.Points, result);
      ExpectNamed(drawing, result.Report);
    }
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

/// Progress goes on while segments are inserted, some thousands at a time.
TEST(Segments, InsertionTellsProgress)
{
  std::mt19937 random(8);
  Drawing drawing = DrawRandom(random, 30000 / Reduction, 0, 1 << 20);
  const std::vector<std::int32_t> triangles = Triangulate(drawing).Triangles;
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    drawing.Segments.push_back({ triangles[i], triangles[i + 1] });
  }
  std::vector<double> told;
  const auto tell = [&](double share)
  {
    told.push_back(share);
    return true;
  };
  FlipSession session(drawing.View(), PointOptions{ OnTestBackend({}) }, tell);
  session.Advance(-1, {}, tell);
  EXPECT_EQ(0, session.GetReport().FromPoints.RefusedSegments);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  const std::set<double> shares(told.begin(), told.end());
  constexpr std::size_t FirstBatch = 4096;
  const double first = double(FirstBatch) / static_cast<double>(drawing.Segments.size());
  EXPECT_EQ(drawing.Segments.size() > FirstBatch, shares.count(1.0 - 0.25 * (1.0 - first)) == 1);
}

/// The triangles depend on the places and the segments, not on the order of the points.
TEST(Segments, InAnyOrderOfPoints)
{
  std::mt19937 random(2);
  for (int i = 0; i < 200 / Reduction; ++i)
  {
    const Drawing drawing = DrawRandom(random, 40, 12, 8);
    std::vector<std::int64_t> order(drawing.Points.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    Drawing shuffled;
    shuffled.Points.resize(order.size());
    for (std::size_t k = 0; k < order.size(); ++k)
    {
      shuffled.Points[order[k]] = drawing.Points[k];
    }
    for (const auto& segment : drawing.Segments)
    {
      shuffled.Segments.push_back({ order[segment[0]], order[segment[1]] });
    }
    const auto list = [](const Drawing& given)
    { return ByPlaces(Triangulate(given).Triangles, given.Points); };
    ASSERT_EQ(list(drawing), list(shuffled)) << i;
  }
}

/// Many segments in many points: short ones, and some that cross half of the points.
TEST(Segments, InManyPoints)
{
  std::mt19937 random(3);
  const int size = 1 << 20;
  Drawing drawing = DrawRandom(random, 10000 / Reduction, 20, size);
  for (int i = 0; i < 300 / Reduction; ++i)
  {
    const auto count = static_cast<int>(drawing.Points.size());
    const std::int64_t from = DrawIndex(random, count);
    std::int64_t to = from;
    double nearest = INFINITY;
    for (int k = 0; k < 200; ++k)
    {
      const std::int64_t other = DrawIndex(random, count);
      const double distance = Measure(drawing.Points, from, other);
      to = distance > 0.0 && distance < nearest ? other : to;
      nearest = to == other ? distance : nearest;
    }
    drawing.Segments.push_back({ from, to });
  }
  const Triangulation result = Triangulate(drawing);
  ExpectConstrainedDelaunay(drawing.Points, result);
  const Pairs refused = ListRefused(drawing);
  ExpectNamed(drawing, result.Report);

  // No four points lie on a circle, so CGAL's mesh must be the same.
  std::vector<std::int64_t> taken;
  for (const auto& segment : drawing.Segments)
  {
    const bool isTaken = std::find(refused.begin(), refused.end(), segment) == refused.end();
    taken.insert(taken.end(), segment.begin(), isTaken ? segment.end() : segment.begin());
  }
  const OwnedMesh<double> mesh = ToMesh(drawing.Points);
  EXPECT_TRUE(MakeCgalConstrainedDelaunay(WithConstraints(mesh.View(), taken)) ==
    ToTriangleSet(result.Triangles));
}

TEST(Segments, NameWhatIsWrong)
{
  Drawing drawing;
  drawing.Points = { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 }, { NAN, 0 } };
  drawing.Segments = { { 0, 2 }, { 3, 1 }, { 0, 4 }, { 1, 1 } };
  const FlipReport report = Triangulate(drawing).Report;
  EXPECT_EQ(2, report.FromPoints.RefusedSegments);
  EXPECT_EQ(1, report.FromPoints.SegmentEdges);
  EXPECT_EQ(
    "1 point with NaN or infinite coordinates (first: 4); 1 segment that crosses an earlier "
    "one: with SplitCrossings both get a point where they cross (first: 3-1 crosses segment "
    "0 (points 0 and 2)); 1 segment that ends at a point that is not finite (first: 0-4)",
    DescribeDefects(report.Defects));
  Drawing line;
  line.Points = { { 0, 0 }, { 1, 1 }, { 2, 2 } };
  line.Segments = { { 0, 2 } };
  EXPECT_EQ(
    "1 segment between points without a triangle (first: 0-2); 3 points without a triangle: "
    "there are fewer than three places, or all are on one line",
    DescribeDefects(Triangulate(line).Report.Defects));
  drawing.Segments = { { 0, 5 } };
  EXPECT_EQ("segment 0 names point 5, but there are points 0 to 4",
    GetMessage<InvalidMesh>([&] { Triangulate(drawing); }));
  drawing.Rings = { 3 };
  EXPECT_EQ("ring 3 names point 5, but there are points 0 to 4",
    GetMessage<InvalidMesh>([&] { Triangulate(drawing); }));
}

//------------------------------------------------------------------------------
/// The added points of random crossing segments are the exact crossings, rounded.
TEST(SplitCrossings, LeavesNoCrossing)
{
  std::mt19937 random(4);
  const PointOptions options = With(&PointOptions::SplitCrossings, true);
  for (int i = 0; i < 300 / Reduction; ++i)
  {
    const Drawing drawing =
      DrawRandom(random, 4 + random() % 20, 2 + random() % 10, i % 2 == 0 ? 8 : 1 << 24);
    const Triangulation result = Triangulate(drawing, options);
    Places points = drawing.Points;
    for (const AddedPoint& added : result.Added)
    {
      ASSERT_LT(added.From, static_cast<std::int64_t>(points.size()));
      ASSERT_LT(added.To, static_cast<std::int64_t>(points.size()));
      const auto& from = points[added.From];
      const auto& to = points[added.To];
      ASSERT_NEAR(from[0] + added.Share * (to[0] - from[0]), added.X, 1e-6);
      ASSERT_NEAR(from[1] + added.Share * (to[1] - from[1]), added.Y, 1e-6);
      points.push_back({ added.X, added.Y });
    }
    ExpectConstrainedDelaunay(points, result);
    ASSERT_EQ(0, result.Report.FromPoints.RefusedSegments);
    // Every segment is a path of edges from its start to its end.
    std::map<std::int64_t, std::set<std::int64_t>> next;
    for (const auto& edge : result.Edges)
    {
      next[edge[0]].insert(edge[1]);
      next[edge[1]].insert(edge[0]);
    }
    for (const auto& segment : drawing.Segments)
    {
      std::set<std::int64_t> seen = { result.UsedPoints[segment[0]] };
      for (std::vector<std::int64_t> stack(seen.begin(), seen.end()); !stack.empty();)
      {
        const std::int64_t at = stack.back();
        stack.pop_back();
        for (const std::int64_t to : next[at])
        {
          if (seen.insert(to).second)
          {
            stack.push_back(to);
          }
        }
      }
      ASSERT_EQ(1u, seen.count(result.UsedPoints[segment[1]]) + (result.Triangles.empty() ? 1 : 0));
    }
    ASSERT_FALSE(HasFatalFailure()) << "case " << i;
  }
}

/// A point that is too near to another one is not used, also where segments cross.
TEST(SplitCrossings, UsesNoPointThatIsNotUsed)
{
  Drawing drawing;
  drawing.Points = { { 0, 0 }, { 2, 2 }, { 0, 2 }, { 2, 0 }, { 1.0625, 1 }, { 1, 1 } };
  drawing.Segments = { { 0, 1 }, { 2, 3 } };
  PointOptions options = With(&PointOptions::SplitCrossings, true);
  options.PointTolerance = 0.125;
  const Triangulation result = Triangulate(drawing, options);
  EXPECT_EQ((std::vector<std::int64_t>{ 0, 1, 2, 3, 4, 4 }), result.UsedPoints);
  EXPECT_EQ(0, result.Report.FromPoints.RefusedSegments);
  EXPECT_EQ((Pairs{ { 0, 6 }, { 6, 1 }, { 2, 6 }, { 6, 3 } }), result.Edges);
}

/// Segments along a line, but for rounding, get ever more crossings. A segment of which pieces are
/// refused counts once.
TEST(SplitCrossings, EndsWhereCrossingsMultiply)
{
  std::mt19937 random(1);
  Drawing drawing;
  for (int i = 0; i < 28; ++i)
  {
    const auto y = static_cast<double>(random() % 200);
    drawing.Points.push_back({ y / 3.0, y });
    if (i > 0)
    {
      drawing.Segments.push_back({ i - 1, i });
    }
  }
  drawing.Points.push_back({ 0.0, 200.0 });
  const Triangulation result = Triangulate(drawing, With(&PointOptions::SplitCrossings, true));
  EXPECT_LT(result.Added.size(), 20000u);
  EXPECT_LT(0, result.Report.FromPoints.RefusedSegments);
  EXPECT_GE(27, result.Report.FromPoints.RefusedSegments);
  const std::vector<std::int64_t>& named = result.Report.Defects.back().FirstIds;
  ASSERT_EQ(6u, named.size());
  EXPECT_TRUE(named[0] < named[2] && named[2] < named[4]);
}

TEST(SplitCrossings, RoundsOnceAndUsesPointsThatAreThere)
{
  const PointOptions options = With(&PointOptions::SplitCrossings, true);
  Drawing drawing;
  drawing.Points = { { 0, 0 }, { 3, 1 }, { 0, 1 }, { 1, 0 }, { 4, 4 }, { 6, 6 }, { 4, 6 }, { 6, 4 },
    { 5, 5 } };
  drawing.Segments = { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 } };
  const Triangulation result = Triangulate(drawing, options);
  ASSERT_EQ(1u, result.Added.size()); // (3/4, 1/4); (5, 5) is there
  EXPECT_EQ(0.75, result.Added[0].X);
  EXPECT_EQ(0.25, result.Added[0].Y);
  EXPECT_EQ(0.25, result.Added[0].Share);
  EXPECT_EQ(0, result.Added[0].From);
  EXPECT_EQ(1, result.Added[0].To);
  EXPECT_EQ(0.0, result.Report.FromPoints.LargestShift);
  EXPECT_EQ(8, result.Report.FromPoints.SegmentEdges);

  drawing.Points = { { 0, 0 }, { 3, 1 }, { 0, 1 }, { 3, 0.5 } }; // cross at (2, 2/3)
  drawing.Segments = { { 0, 1 }, { 2, 3 } };
  const Triangulation rounded = Triangulate(drawing, options);
  ASSERT_EQ(1u, rounded.Added.size());
  EXPECT_EQ(2.0, rounded.Added[0].X);
  EXPECT_EQ(2.0 / 3.0, rounded.Added[0].Y);
  EXPECT_NEAR(3.7e-17, rounded.Report.FromPoints.LargestShift, 1e-18);
}

/// The smallest numbers have fewer bits than others.
TEST(SplitCrossings, RoundsSubnormalNumbersOnce)
{
  constexpr float Unit = std::numeric_limits<float>::denorm_min();
  const std::int64_t segments[] = { 0, 1, 2, 3 };
  const auto triangulate = [&](float size)
  {
    const float far = size * Unit; // the segments cross in the middle of a square
    const float coordinates[] = { 0, 0, far, far, 0, far, far, 0, 2 * far, 0 };
    PointInput input{ PlaneArray(coordinates, 5, 2) };
    input.Segments = segments;
    input.NumberOfSegments = 2;
    return Triangulate(input, With(&PointOptions::SplitCrossings, true));
  };
  const Triangulation three = triangulate(3);
  ASSERT_EQ(1u, three.Added.size());
  EXPECT_EQ(2.0, three.Added[0].X / Unit);
  EXPECT_EQ(2.0, three.Added[0].Y / Unit);
  EXPECT_NEAR(0.7071, three.Report.FromPoints.LargestShift / Unit, 1e-4);
  const Triangulation one = triangulate(1);
  EXPECT_EQ(0u, one.Added.size()); // (1/2, 1/2) becomes (0, 0), which is there
}

//------------------------------------------------------------------------------
Places Square(double left, double lower, double size, bool isClockwise = false)
{
  Places corners = { { left, lower }, { left + size, lower }, { left + size, lower + size },
    { left, lower + size } };
  if (isClockwise)
  {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

struct OutlineCase
{
  const char* Name;
  RingRuleKind Rule;
  std::vector<Places> Rings;
  double Area;
  std::int32_t FirstHole = INT32_MAX;
};

class OutlineTest : public testing::TestWithParam<OutlineCase>
{
};

/// In a field of 20 x 20 = 400.
TEST_P(OutlineTest, KeepsWhatIsInside)
{
  std::mt19937 random(5);
  Drawing drawing = DrawRandom(random, 300, 0, 21);
  for (const auto& corner : Square(0, 0, 20))
  {
    drawing.Points.push_back(corner);
  }
  for (const Places& ring : GetParam().Rings)
  {
    drawing.Rings.resize(drawing.Segments.size(), -1);
    drawing.AddRing(ring);
  }
  drawing.FirstHole = GetParam().FirstHole;
  const Triangulation result = Triangulate(drawing, With(&PointOptions::RingRule, GetParam().Rule));
  ExpectConstrainedDelaunay(drawing.Points, result);
  EXPECT_EQ(2.0 * GetParam().Area, SumArea(drawing.Points, result.Triangles));
  const FlipReport& report = result.Report;
  EXPECT_EQ(CountBorder(result), report.Edges.Boundary);
  const EdgeMap edges = CollectEdges(ViewTriangles(result.Triangles));
  EXPECT_EQ(static_cast<std::int64_t>(edges.size()), report.Edges.Edges);
  EXPECT_EQ(static_cast<std::int64_t>(result.Triangles.size()) / 3, report.Triangles);
}

INSTANTIATE_TEST_SUITE_P(Outlines, OutlineTest,
  testing::Values(OutlineCase{ "Square", RingRuleKind::EvenOdd, { Square(2, 2, 10) }, 100 },
    OutlineCase{ "Hole", RingRuleKind::EvenOdd, { Square(2, 2, 10), Square(4, 4, 3) }, 91 },
    OutlineCase{
      "Island", RingRuleKind::EvenOdd, { Square(2, 2, 12), Square(4, 4, 8), Square(5, 5, 2) }, 84 },
    OutlineCase{ "SharedSide", RingRuleKind::EvenOdd, { Square(2, 2, 4), Square(6, 2, 4) }, 32 },
    OutlineCase{ "Orientation", RingRuleKind::Orientation,
      { Square(2, 2, 10), Square(4, 4, 3, true), Square(5, 5, 1) }, 92 },
    OutlineCase{ "Nested", RingRuleKind::Orientation, { Square(2, 2, 10), Square(4, 4, 3) }, 100 },
    OutlineCase{ "LongArms", RingRuleKind::Orientation, // not told by corners without lengths
      { { { 9, 7 }, { 15, 7 }, { 15, 9 }, { 9, 9 }, { 9, 15 }, { 7, 15 }, { 7, 9 }, { 1, 9 },
        { 1, 7 }, { 7, 7 }, { 7, 1 }, { 9, 1 } } },
      52 },
    OutlineCase{ "OnlyHoles", RingRuleKind::Orientation,
      { Square(2, 2, 3, true), Square(8, 8, 4, true) }, 375 },
    OutlineCase{
      "NestedNonZero", RingRuleKind::NonZero, { Square(2, 2, 10), Square(4, 4, 3) }, 100 },
    OutlineCase{ "LakeAndIslandNonZero", RingRuleKind::NonZero,
      { Square(2, 2, 12, true), Square(4, 4, 8), Square(5, 5, 2, true) }, 84 },
    OutlineCase{ "HolesInNonZero", RingRuleKind::NonZero,
      { Square(2, 2, 10), Square(4, 4, 6, true), Square(5, 5, 2, true) }, 64, 1 },
    OutlineCase{ "NestedHoles", RingRuleKind::EvenOdd,
      { Square(2, 2, 10), Square(4, 4, 6, true), Square(5, 5, 2, true) }, 68, 1 },
    OutlineCase{ "OnlyNestedHoles", RingRuleKind::EvenOdd,
      { Square(2, 2, 3), Square(8, 8, 4, true), Square(9, 9, 2) }, 379, 0 },
    OutlineCase{ "OnlyHolesWithOrientation", RingRuleKind::Orientation,
      { Square(2, 2, 3), Square(8, 8, 4, true) }, 375, 0 },
    OutlineCase{ "EvenOddAndHole", RingRuleKind::EvenOdd,
      { Square(2, 2, 10), Square(4, 4, 6), Square(3, 3, 8) }, 36, 2 },
    OutlineCase{ "BowTie", RingRuleKind::NonZero,
      { { { 4, 4 }, { 8, 4 }, { 6, 6 }, { 4, 8 }, { 8, 8 }, { 6, 6 } } }, 8 },
    OutlineCase{ "OnlyRingsWithoutArea", RingRuleKind::EvenOdd, { { { 4, 4 }, { 6, 6 } } }, 400 }),
  GetCaseName);

TEST(Outline, ReportsBrokenRings)
{
  Drawing drawing;
  drawing.AddRing(Square(0, 0, 4));
  drawing.Segments.back()[1] = 1;
  EXPECT_EQ("ring 0 is not closed at point 0: close it, or make its segments part of no ring",
    GetMessage<InvalidMesh>([&] { Triangulate(drawing); }));
  drawing = Drawing();
  drawing.AddRing(Square(0, 0, 4));
  drawing.AddRing(Square(2, 2, 4));
  EXPECT_EQ("the segment of ring 1 from point 4 to point 5 crosses segment 1 (points 1 and "
            "2): with SplitCrossings both get a point where they cross",
    GetMessage<InvalidMesh>([&] { Triangulate(drawing); }));
  drawing.Points[5][1] = NAN;
  EXPECT_EQ(
    "the segment of ring 1 from point 4 to point 5 cannot be inserted: a coordinate of an end "
    "is NaN or infinite",
    GetMessage<InvalidMesh>([&] { Triangulate(drawing); }));
}

TEST(Outline, SegmentsOfARingMayRunInAnyDirection)
{
  std::mt19937 random(9);
  for (const auto rule :
    { RingRuleKind::EvenOdd, RingRuleKind::NonZero, RingRuleKind::Orientation })
  {
    for (int i = 0; i < 20; ++i)
    {
      Drawing drawing;
      drawing.Points = Square(0, 0, 20);
      drawing.AddRing({ { 2, 2 }, { 10, 2 }, { 14, 9 }, { 10, 10 }, { 5, 12 } });
      for (std::size_t k = 1; k < drawing.Segments.size(); ++k)
      {
        if (random() % 2 == 0)
        {
          std::swap(drawing.Segments[k][0], drawing.Segments[k][1]);
        }
      }
      std::shuffle(drawing.Segments.begin() + 1, drawing.Segments.end(), random);
      const Triangulation result = Triangulate(drawing, With(&PointOptions::RingRule, rule));
      EXPECT_EQ(152.0, SumArea(drawing.Points, result.Triangles)) << "case " << i;
      EXPECT_EQ(5, result.Report.FromPoints.SegmentEdges);
    }
  }
}

/// Where products of lengths overflow or underflow.
TEST(Outline, TheSmallestAngleIsThatOfWhatIsLeft)
{
  for (const double scale : { 1.0, 1e-100, 1e110 })
  {
    Drawing drawing;
    drawing.Points = { { 9 * scale, 0 }, { 0, 9 * scale } };
    drawing.AddRing({ { 0, 0 }, { scale, 0 }, { 0, scale } });
    const FlipReport report = Triangulate(drawing).Report;
    EXPECT_NEAR(45.0, report.MinimumAngleAfter, 1e-9) << scale;
    EXPECT_EQ(0, report.TrianglesBelow30After) << scale;
  }
}

/// Where areas overflow, underflow, or are lost in the distance to other points.
TEST(Outline, DirectionOfHugeTinyAndFarRings)
{
  std::mt19937 random(8);
  const PointOptions options = With(&PointOptions::RingRule, RingRuleKind::Orientation);
  for (int i = 0; i < 60; ++i)
  {
    const double scales[] = { 1e160, 1e-165, 1e-3 };
    const double scale = scales[i % 3];
    const double far = i % 3 == 2 ? 1e6 + DrawIndex(random, 8000000) : 0.0;
    Drawing drawing;
    drawing.Points = { { 0, 0 } };
    Places ring = { { 1, 1 }, { 5, 2 }, { 4, 6 }, { 2, 5 } };
    for (auto& corner : ring)
    {
      corner = { far + scale * corner[0], far + scale * corner[1] };
    }
    drawing.AddRing(ring);
    EXPECT_EQ(2, Triangulate(drawing, options).Report.Triangles) << "case " << i;
  }
}

TEST(Outline, RingsWithoutAreaAreLeftOut)
{
  PointOptions options = With(&PointOptions::PointTolerance, 0.5);
  const std::pair<Places, int> cases[] = { { { { 4, 4 }, { 8, 8 }, { 6, 6 } }, 2 },
    { Square(4, 4, 0.1), 0 }, { { { 4, 4 } }, 0 }, { { { 4, 4 }, { 8, 9 } }, 1 },
    { { { 4, 4 }, { 8, 9 }, { 4, 8 }, { 8, 9 } }, 2 }, // there and back
    { { { 12, 8 }, { 18, 8 }, { 13, 8 } }, 1 } }; // crosses another ring
  for (const auto& [ring, edges] : cases)
  {
    Drawing drawing;
    drawing.Points = Square(0, 0, 20);
    drawing.AddRing(Square(2, 2, 14));
    drawing.AddRing(ring);
    options.SplitCrossings = edges == 0; // then nothing is left of the ring
    const Triangulation result = Triangulate(drawing, options);
    EXPECT_EQ(2.0 * 196, SumArea(drawing.Points, result.Triangles));
    EXPECT_EQ(4 + edges, result.Report.FromPoints.SegmentEdges);
    EXPECT_EQ(1, result.Report.FromPoints.LeftOutRings);
    EXPECT_EQ("1 ring without an area, left out (first: 1)",
      DescribeDefects({ result.Report.Defects.back() }));
  }
}

/// By every rule, also where the second one runs the other way and has more corners or a spike.
TEST(Outline, RingsThatAreGivenTwiceCountOnce)
{
  Drawing drawing;
  drawing.Points = Square(0, 0, 20);
  Places again = Square(2, 2, 10, true);
  again.insert(again.begin() + 1, { { 6, 12 }, { 6, 14 }, { 6, 12 } });
  const Places hole = Square(4, 4, 3);
  const Places once = Square(8, 8, 2);
  Places twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  for (const Places& ring : { Square(2, 2, 10), again, hole, hole, Square(4, 4, 3, true), twice })
  {
    drawing.AddRing(ring);
  }
  drawing.FirstHole = 2;
  for (const RingRuleKind rule :
    { RingRuleKind::EvenOdd, RingRuleKind::NonZero, RingRuleKind::Orientation })
  {
    const Triangulation result = Triangulate(drawing, With(&PointOptions::RingRule, rule));
    EXPECT_EQ(2.0 * 87, SumArea(drawing.Points, result.Triangles));
    std::vector<Defect> defects = result.Report.Defects;
    defects.erase(defects.begin()); // points of equal places
    EXPECT_EQ(3, result.Report.FromPoints.LeftOutRings);
    EXPECT_EQ("3 rings with the edges of an earlier one, left out (first: 1, 3, 4); 1 ring with a "
              "loop that is run more than once, counted once (first: 5)",
      DescribeDefects(defects));
  }
}

/// Edges of two segments, those of the boundary, and removed ones.
TEST(Outline, EdgesAreCountedOnce)
{
  Drawing drawing;
  drawing.Points = Square(0, 0, 8);
  drawing.Segments = { { 0, 2 }, { 0, 1 }, { 2, 0 } };
  const Triangulation all = Triangulate(drawing);
  EXPECT_EQ((Pairs{ { 0, 2 }, { 0, 1 } }), all.Edges);
  EXPECT_EQ(2, all.Report.FromPoints.SegmentEdges);
  EXPECT_EQ(2, all.Report.Edges.Constraint);
  EXPECT_EQ(5, all.Report.Edges.Fixed);
  drawing.Rings = { -1, -1, -1 };
  drawing.AddRing({ { 20, 20 }, { 22, 20 }, { 20, 22 } });
  drawing.Segments.push_back({ 5, 4 });
  drawing.Rings.push_back(-1);
  const Triangulation few = Triangulate(drawing);
  EXPECT_EQ((Pairs{ { 4, 5 }, { 5, 6 }, { 6, 4 } }), few.Edges);
  EXPECT_EQ(3, few.Report.FromPoints.SegmentEdges);
  EXPECT_EQ(3, few.Report.Edges.Fixed);
}

TEST(Outline, SeedsRemoveHoles)
{
  Drawing drawing;
  drawing.Points = Square(0, 0, 20);
  for (const auto& square : { Square(2, 2, 4), Square(10, 10, 5) })
  {
    drawing.AddRing(square);
  }
  drawing.Rings.clear(); // all are breaklines
  drawing.Seeds = { 3, 3, 11, 11, 30, 30 };
  const Triangulation result = Triangulate(drawing);
  EXPECT_EQ(2.0 * (400 - 16 - 25), SumArea(drawing.Points, result.Triangles));
  EXPECT_EQ("1 hole seed outside of all triangles", DescribeDefects(result.Report.Defects));
}

TEST(Outline, AlphaAndLongestEdgeKeepSegments)
{
  std::mt19937 random(6);
  Drawing drawing = DrawRandom(random, 400, 0, 1 << 10);
  drawing.Segments = { { 0, 1 }, { 2, 3 } };
  for (const bool byAlpha : { true, false })
  {
    const Triangulation all = Triangulate(drawing);
    const auto limit = byAlpha ? &PointOptions::Alpha : &PointOptions::LongestEdge;
    const Triangulation kept = Triangulate(drawing, With(limit, 60.0));
    const auto list = [&](const Triangulation& from, bool onlySmall)
    {
      std::set<VertexPair> segments;
      for (const auto& edge : from.Edges)
      {
        segments.insert(Sorted(edge[0], edge[1]));
      }
      std::set<std::array<std::int32_t, 3>> triangles;
      for (std::size_t t = 0; t < from.Triangles.size(); t += 3)
      {
        double product = 1.0, longest = 0.0;
        bool stays = false;
        for (int slot = 0; slot < 3; ++slot)
        {
          const std::int32_t a = from.Triangles[t + slot], b = from.Triangles[t + (slot + 1) % 3];
          const double length = Measure(drawing.Points, a, b);
          product *= length;
          longest = std::max(longest, length);
          stays = stays || segments.count(Sorted(a, b)) > 0;
        }
        const std::vector<std::int32_t> ids(&from.Triangles[t], &from.Triangles[t] + 3);
        const double radius = product / (2.0 * SumArea(drawing.Points, ids));
        if (!onlySmall || stays || (byAlpha ? radius : longest) <= 60.0)
        {
          triangles.insert({ ids[0], ids[1], ids[2] });
        }
      }
      return triangles;
    };
    EXPECT_EQ(list(all, true), list(kept, false));
    EXPECT_EQ(static_cast<std::int64_t>(all.Triangles.size() - kept.Triangles.size()) / 3,
      kept.Report.FromPoints.LargeTriangles);
    EXPECT_LT(0, kept.Report.FromPoints.LargeTriangles);
    EXPECT_EQ(all.Edges, kept.Edges);
  }
}

/// Each point that is not used has one that is used, with a lower id, nearer than the tolerance;
/// and no two points that are used are so near.
TEST(PointTolerance, MergesNearPoints)
{
  std::mt19937 random(7);
  const Drawing drawing = DrawRandom(random, 500, 0, 100);
  const Triangulation result = Triangulate(drawing, With(&PointOptions::PointTolerance, 5.0));
  std::int64_t near = 0;
  for (std::size_t i = 0; i < drawing.Points.size(); ++i)
  {
    const auto used = static_cast<std::size_t>(result.UsedPoints[i]);
    ASSERT_LE(used, i);
    ASSERT_EQ(static_cast<std::int64_t>(used), result.UsedPoints[used]);
    near += used != i ? 1 : 0;
    for (std::size_t k = 0; k < i; ++k)
    {
      const bool isNear =
        result.UsedPoints[k] == static_cast<std::int64_t>(k) && Measure(drawing.Points, i, k) < 5.0;
      ASSERT_FALSE(isNear && (used == i || k < used)) << i << ' ' << k;
    }
    ASSERT_GT(used == i ? 1.0 : 5.0, Measure(drawing.Points, i, used));
  }
  const PointCounts& counts = result.Report.FromPoints;
  EXPECT_EQ(near, counts.TooNear + counts.Repeated);
  const std::set<std::array<double, 2>> places(drawing.Points.begin(), drawing.Points.end());
  EXPECT_GE(static_cast<std::int64_t>(drawing.Points.size() - places.size()), counts.Repeated);
  EXPECT_LT(0, counts.Repeated);
  EXPECT_EQ(0, result.Report.FromPoints.NotFinite);
  for (const std::int32_t id : result.Triangles)
  {
    ASSERT_EQ(id, result.UsedPoints[id]);
  }
}

/// An observer that stops the insertion leaves a mesh; the next call goes on.
TEST(Segments, CanBeStopped)
{
  std::mt19937 random(8);
  Drawing drawing = DrawRandom(random, 4000, 6000, 1 << 20);
  EXPECT_EQ(0,
    FlipSession(drawing.View(), PointOptions{ OnTestBackend({}) }).GetReport().InsertedConstraints);
  const Triangulation expected = Triangulate(drawing);
  int calls = 0;
  FlipSession session(drawing.View(), PointOptions{ OnTestBackend({}) });
  const auto stop = [&](double) { return ++calls % 3 != 0; };
  int stops = 0;
  while (session.Advance(-1, {}, stop) || session.GetReport().StopReason == StopReasonKind::Aborted)
  {
    ++stops;
    ASSERT_GT(1000, stops);
    EXPECT_TRUE(2 * 4000 >= session.GetReport().Triangles);
    session.ListSegmentEdges();
  }
  EXPECT_LT(0, stops);
  EXPECT_EQ(expected.Triangles, StoreTriangles(session));
  EXPECT_EQ(expected.Report.FromPoints.SegmentEdges, session.GetReport().FromPoints.SegmentEdges);
}

}
}
