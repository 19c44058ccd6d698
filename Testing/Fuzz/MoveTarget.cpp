// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "FuzzTarget.h"
#include "GrowTestSupport.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>

/// @file
/// Sequences of motions, insertions and removals of points, with and without segments, as a target
/// for fuzzers. After each step the triangulation must be that of a new session; the last one is
/// judged by rational numbers.

namespace delaunayflip
{
namespace
{

enum class StepKind : std::uint8_t
{
  MoveAll,
  MoveSome,
  Insert,
  Remove,
  Compact,
  End
};

struct Step
{
  StepKind Kind;
  Places Points; ///< The new places, or those to insert.
  std::vector<std::int64_t> Ids; ///< Those of the points to move or to remove.
};

struct MoveCase
{
  Drawing Input;
  PointOptions Options;
  std::vector<Step> Steps;
};

/// A place on a grid of 9 columns and rows, or on a finer one.
Place DrawPlace(ByteSource& source, std::uint32_t fineness)
{
  const auto draw = [&] { return double(source.Draw(8 * fineness + 1)) / fineness; };
  return { draw(), draw() };
}

void DrawSegments(ByteSource& source, Drawing& drawing)
{
  if (source.Once(3))
  {
    const double x = source.Draw(5), y = source.Draw(5), size = 1.0 + source.Draw(4);
    drawing.AddRing({ { x, y }, { x + size, y }, { x + size, y + size }, { x, y + 0.5 * size } });
  }
  const auto drawPoint = [&]
  { return std::int64_t(source.Draw(static_cast<std::uint32_t>(drawing.Points.size()))); };
  for (std::uint32_t left = source.Draw(7); left > 0; --left)
  {
    drawing.Segments.push_back({ drawPoint(), drawPoint() });
    drawing.Rings.push_back(-1);
  }
  drawing.FirstHole = source.Once(2) ? 0 : INT32_MAX;
  if (source.Once(4))
  {
    const Place seed = DrawPlace(source, 8);
    drawing.Seeds = { seed[0], seed[1] };
  }
}

/// Moves each point by up to one of some sizes, on a grid or not.
void Shake(ByteSource& source, Place& point, std::uint32_t size)
{
  const double sizes[] = { 0.0, 1e-9, 1e-3, 0.01, 0.05, 0.25, 1.0, 4.0 };
  for (double& coordinate : point)
  {
    coordinate += sizes[size] * (static_cast<double>(source.Draw(33)) / 16.0 - 1.0);
  }
}

/// @param points where the points are.
Step DrawStep(ByteSource& source, const Places& points)
{
  const auto count = static_cast<std::uint32_t>(points.size());
  Step step{ StepKind::MoveAll, points, {} };
  const std::uint32_t kind = source.Draw(12);
  if (kind < 5)
  {
    const std::uint32_t size = source.Draw(8);
    for (Place& point : step.Points)
    {
      Shake(source, point, size);
    }
    return step;
  }
  step.Points.clear();
  const bool areMany = kind == 10 && source.Once(2);
  for (std::uint32_t left = areMany ? 1 + count / 2 : 1 + source.Draw(3); left > 0; --left)
  {
    step.Ids.push_back(source.Draw(count));
  }
  if (kind < 8)
  {
    step.Kind = StepKind::MoveSome;
    const std::uint32_t size = source.Draw(8);
    for (const std::int64_t id : step.Ids)
    {
      Place to = points[id];
      Shake(source, to, size);
      step.Points.push_back(source.Once(5) ? points[source.Draw(count)] : to);
    }
    return step;
  }
  step.Kind = kind < 11 ? StepKind::Remove : StepKind::Compact;
  if (kind < 10)
  {
    step.Kind = StepKind::Insert;
    step.Ids.clear();
    for (std::uint32_t left = 1 + source.Draw(4); left > 0; --left)
    {
      step.Points.push_back(DrawPlace(source, 2));
    }
  }
  return step;
}

/// Does a step with places. Those of removed points stay NaN.
void Follow(const Step& step, std::vector<bool>& removed, Places& points)
{
  const Place none = { NAN, NAN };
  switch (step.Kind)
  {
    case StepKind::MoveAll:
      points = step.Points;
      break;
    case StepKind::MoveSome:
      for (std::size_t i = 0; i < step.Ids.size(); ++i)
      {
        points[step.Ids[i]] = step.Points[i];
      }
      break;
    case StepKind::Insert:
      points.insert(points.end(), step.Points.begin(), step.Points.end());
      removed.resize(points.size());
      break;
    case StepKind::Remove:
      for (const std::int64_t id : step.Ids)
      {
        removed[id] = true;
      }
      break;
    default:
      Places left;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        if (!removed[i])
        {
          left.push_back(points[i]);
        }
      }
      points = left;
      removed.assign(points.size(), false);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = removed[i] ? none : points[i];
  }
}

MoveCase MakeMoveCase(const std::uint8_t* bytes, std::size_t size)
{
  ByteSource source(bytes, size);
  MoveCase drawn;
  const std::uint32_t fineness = source.Once(3) ? 1 : 1024;
  for (std::uint32_t left = 4 + source.Draw(source.Once(8) ? 120 : 24); left > 0; --left)
  {
    drawn.Input.Points.push_back(DrawPlace(source, fineness));
  }
  if (!source.Once(3))
  {
    DrawSegments(source, drawn.Input);
  }
  const double lengths[] = { 0.0, 0.0, 0.0, 0.0, 2.0, 4.0 };
  drawn.Options.Alpha = lengths[source.Draw(6)];
  drawn.Options.LongestEdge = lengths[source.Draw(6)];
  drawn.Options.RingRule = static_cast<RingRuleKind>(source.Draw(3));
  drawn.Options.NumberOfThreads = source.Once(4) ? 3 : 1;
  Places points = drawn.Input.Points;
  std::vector<bool> removed(points.size());
  for (std::uint32_t left = 2 + source.Draw(10); left > 0 && !points.empty(); --left)
  {
    Step step = DrawStep(source, points);
    if (step.Kind == StepKind::Compact && !drawn.Input.Segments.empty())
    {
      continue;
    }
    Follow(step, removed, points);
    drawn.Steps.push_back(std::move(step));
  }
  return drawn;
}

void Do(const Step& step, FlipSession& session)
{
  const auto count = static_cast<std::int64_t>(step.Ids.size());
  switch (step.Kind)
  {
    case StepKind::MoveAll:
      EXPECT_TRUE(session.Move({ View(step.Points) }));
      break;
    case StepKind::MoveSome:
      EXPECT_TRUE(session.Move({ View(step.Points), step.Ids.data() }));
      break;
    case StepKind::Insert:
      EXPECT_TRUE(session.Insert(View(step.Points)));
      break;
    case StepKind::Remove:
      EXPECT_TRUE(session.Remove(step.Ids.data(), count));
      break;
    default:
      EXPECT_TRUE(session.Compact());
  }
}

/// What a session has made.
Triangulation Fetch(const FlipSession& session, std::size_t points)
{
  Triangulation made;
  made.Report = session.GetReport();
  made.Triangles = StoreTriangles(session);
  made.Neighbors.resize(made.Triangles.size());
  session.StoreNeighbors(made.Neighbors.data());
  made.UsedPoints.resize(points);
  session.StoreUsedPoints(made.UsedPoints.data());
  const std::vector<std::int64_t> edges = session.ListSegmentEdges();
  for (std::size_t i = 0; i < edges.size(); i += 2)
  {
    made.Edges.push_back({ edges[i], edges[i + 1] });
  }
  return made;
}

/// What a report says of the mesh, whatever has led there.
std::vector<std::pair<std::string, std::int64_t>> ListCounts(const FlipReport& report)
{
  const PointCounts& counts = report.FromPoints;
  std::vector<std::pair<std::string, std::int64_t>> listed{ { "triangles", report.Triangles },
    { "edges", report.Edges.Edges }, { "boundary", report.Edges.Boundary },
    { "fixed", report.Edges.Fixed }, { "Euler", report.EulerCharacteristic },
    { "bad", report.NonDelaunayAfter }, { "inserted", report.InsertedConstraints },
    { "used", counts.Used }, { "repeated", counts.Repeated },
    { "not finite", counts.NotFinite + counts.Removed }, { "of segments", counts.SegmentEdges },
    { "refused", counts.RefusedSegments }, { "outside", counts.OutsideTriangles },
    { "large", counts.LargeTriangles }, { "left out", counts.LeftOutRings },
    { "stop", static_cast<std::int64_t>(report.StopReason) } };
  std::int64_t withoutEnd = 0; // segments at points that are not finite or removed
  for (const Defect& defect : report.Defects)
  {
    if (defect.Kind == DefectKind::SegmentsNotFinite || defect.Kind == DefectKind::SegmentsRemoved)
    {
      withoutEnd += defect.Count;
    }
    else if (defect.Kind != DefectKind::PointsNotFinite) // removed points are none of these
    {
      listed.emplace_back(
        "defect " + std::to_string(static_cast<int>(defect.Kind)) + ": " + defect.Detail,
        defect.Count);
    }
  }
  listed.emplace_back("without end", withoutEnd);
  return listed;
}

/// Two triangulations with the same triangles, perhaps in another order.
void ExpectSame(const Triangulation& expected, const Triangulation& made)
{
  EXPECT_EQ(Normalize(expected.Triangles), Normalize(made.Triangles));
  EXPECT_EQ(expected.UsedPoints, made.UsedPoints);
  EXPECT_EQ(expected.Edges, made.Edges);
  EXPECT_EQ(ListCounts(expected.Report), ListCounts(made.Report));
  const double angle = expected.Report.MinimumAngleAfter;
  if (std::isfinite(angle))
  {
    EXPECT_NEAR(angle, made.Report.MinimumAngleAfter, 1e-6 * angle + 1e-12);
  }
  ExpectNeighbors(made);
}

void JudgeMoveCase(const MoveCase& drawn)
{
  Drawing now = drawn.Input;
  std::vector<bool> removed(now.Points.size());
  FlipSession session = [&]
  {
    try
    {
      return FlipPoints(drawn.Input.View(), drawn.Options);
    }
    catch (const InvalidMesh&) // a ring is crossed: begin without segments
    {
      now.Segments.clear();
      now.Rings.clear();
      return FlipPoints(now.View(), drawn.Options);
    }
  }();
  for (const Step& step : drawn.Steps)
  {
    const Drawing before = now;
    const std::vector<bool> removedBefore = removed;
    Follow(step, removed, now.Points);
    try
    {
      Do(step, session);
    }
    catch (const InvalidMesh&)
    {
      EXPECT_THROW(Triangulate(now, drawn.Options), InvalidMesh);
      now = before; // all points are where they were
      removed = removedBefore;
      session.Advance();
    }
    ExpectSame(Triangulate(now, drawn.Options), Fetch(session, now.Points.size()));
  }
  const bool mayLack = drawn.Options.Alpha + drawn.Options.LongestEdge > 0.0;
  Triangulation made = Fetch(session, now.Points.size());
  if (!mayLack)
  {
    const EdgeMap edges = CollectEdges(ViewTriangles(made.Triangles));
    EXPECT_TRUE(std::all_of(made.Edges.begin(), made.Edges.end(),
      [&](const auto& edge) { return edges.count(Sorted(edge[0], edge[1])) > 0; }));
  }
  ExpectConstrainedDelaunay(now.Points, made);
}

}
}

using namespace delaunayflip;

void SetUpTarget(int* argc, char** argv)
{
  testing::InitGoogleTest(argc, argv);
  testing::GTEST_FLAG(throw_on_failure) = true;
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  JudgeMoveCase(MakeMoveCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const MoveCase drawn = MakeMoveCase(bytes, size);
  const char* const names[] = { "move all", "move", "insert", "remove", "compact" };
  const auto print = [](const Places& points)
  {
    for (const Place& point : points)
    {
      std::cout << ' ' << point[0] << ',' << point[1];
    }
    std::cout << '\n';
  };
  std::cout.precision(17);
  std::cout << "points";
  print(drawn.Input.Points);
  for (std::size_t i = 0; i < drawn.Input.Segments.size(); ++i)
  {
    const auto& segment = drawn.Input.Segments[i];
    std::cout << "segment " << segment[0] << ' ' << segment[1] << " of ring "
              << drawn.Input.Rings[i] << '\n';
  }
  std::cout << "ring rule " << static_cast<int>(drawn.Options.RingRule) << ", first hole "
            << drawn.Input.FirstHole << ", seeds " << drawn.Input.Seeds.size() / 2 << ", alpha "
            << drawn.Options.Alpha << ", longest edge " << drawn.Options.LongestEdge << ", threads "
            << drawn.Options.NumberOfThreads << '\n';
  for (const Step& step : drawn.Steps)
  {
    std::cout << names[static_cast<int>(step.Kind)];
    for (const std::int64_t id : step.Ids)
    {
      std::cout << ' ' << id;
    }
    std::cout << ':';
    print(step.Points);
  }
}
