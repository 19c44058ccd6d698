// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ByteSource.h"
#include "FuzzTarget.h"
#include "PointTestSupport.h"
#include "PrintDrawing.h"
#include "RandomInputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>
#include <string>

/// @file
/// Triangulations of points with segments as a target for fuzzers, judged by rational numbers. With
/// --answers only queries about places are judged, which is faster.

namespace delaunayflip
{
namespace
{

bool judgesAnswersOnly = false;

struct PointCase
{
  Drawing Input;
  PointOptions Options;
};

/// Hard cases for refinement: segments that meet at small angles, and segments that nearly touch.
void AddHardSegments(ByteSource& source, Drawing& drawing)
{
  const auto add = [&](double x, double y)
  {
    drawing.Points.push_back({ x, y });
    return static_cast<std::int64_t>(drawing.Points.size()) - 1;
  };
  const auto connect = [&](std::int64_t from, std::int64_t to)
  {
    drawing.Segments.push_back({ from, to });
    drawing.Rings.push_back(-1);
  };
  const double angles[] = { 0.01, 0.018, 0.05, 0.2, 0.6 }, gaps[] = { 1e-2, 1e-4, 1e-7, 1e-10 };
  const double x = source.Draw(12), y = source.Draw(12);
  const std::int64_t corner = add(x, y);
  double angle = 0.1 * source.Draw(63);
  for (std::uint32_t left = 2 + source.Draw(4); left > 0; --left)
  {
    const double length = 1.0 + source.Draw(8);
    connect(corner, add(x + length * std::cos(angle), y + length * std::sin(angle)));
    angle += angles[source.Draw(5)];
  }
  const double u = source.Draw(12), v = source.Draw(12);
  connect(add(u, v), add(u + 3.0, v));
  connect(add(u + 1.3, v + gaps[source.Draw(4)]), add(u + source.Draw(4), v + 2.0));
}

/// Squares within each other, and a spike with a sharp tip, as rings.
void AddNestedRings(ByteSource& source, Drawing& drawing)
{
  const auto addRing = [&](const Places& corners)
  {
    const auto first = static_cast<std::int64_t>(drawing.Points.size());
    const auto count = static_cast<std::int64_t>(corners.size());
    const auto ring = 1 + static_cast<std::int32_t>(drawing.Segments.size()); // a new number
    for (std::int64_t i = 0; i < count; ++i)
    {
      drawing.Points.push_back(corners[i]);
      drawing.Segments.push_back({ first + i, first + (i + 1) % count });
      drawing.Rings.push_back(ring);
    }
  };
  const double x = source.Draw(4), y = source.Draw(4);
  for (double inset = 0.0; inset < 6.0; inset += 1.0 + source.Draw(2))
  {
    const double a = inset, b = 13.0 - inset;
    addRing({ { x + a, y + a }, { x + b, y + a }, { x + b, y + b }, { x + a, y + b } });
  }
  const double widths[] = { 0.05, 0.2, 1.0 };
  addRing({ { 20, 20 }, { 28, 20 }, { 28, 20 + widths[source.Draw(3)] } });
}

/// Points on small grids or of a family of hard points, with exponents and defects; segments; one
/// ring in four cases.
PointCase MakePointCase(const std::uint8_t* bytes, std::size_t size)
{
  ByteSource source(bytes, size);
  PointCase drawn;
  Places& points = drawn.Input.Points;
  const std::uint32_t count = 1 + source.Draw(source.Once(8) ? 200 : 24);
  if (source.Once(2))
  {
    const std::uint32_t columns = 1 + source.Draw(12), rows = 1 + source.Draw(12);
    const int exponents[] = { 0, 0, 0, 40, -40, 600, -600 };
    const double scale = std::ldexp(1.0, exponents[source.Draw(7)]);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      points.push_back({ scale * source.Draw(columns), scale * source.Draw(rows) });
    }
  }
  else
  {
    std::mt19937 random = source.MakeRandom();
    const std::vector<PointFamily> families = ListPointFamilies();
    const PointFamily& family = families[source.Draw(static_cast<std::uint32_t>(families.size()))];
    while (points.size() < count)
    {
      for (const Point3& point : family.Draw(random))
      {
        points.push_back({ point[0], point[1] });
      }
    }
  }
  if (source.Once(8))
  {
    points[source.Draw(static_cast<std::uint32_t>(points.size()))][source.Draw(2)] = NAN;
  }
  const auto drawPoint = [&]()
  { return std::int64_t(source.Draw(static_cast<std::uint32_t>(points.size()))); };
  if (source.Once(4))
  {
    const std::int64_t corners[] = { drawPoint(), drawPoint(), drawPoint(), drawPoint() };
    for (int i = 0; i < 4; ++i)
    {
      drawn.Input.Segments.push_back({ corners[i], corners[(i + 1) % 4] });
    }
    drawn.Input.Rings.assign(4, 0);
  }
  for (std::uint32_t left = source.Draw(source.Once(8) ? 200 : 10); left > 0; --left)
  {
    drawn.Input.Segments.push_back({ drawPoint(), drawPoint() });
    drawn.Input.Rings.push_back(-1);
  }
  drawn.Options.SplitCrossings = source.Once(3);
  drawn.Options.RingRule = static_cast<RingRuleKind>(source.Draw(3));
  drawn.Input.FirstHole = source.Once(4) ? 0 : INT32_MAX;
  const double lengths[] = { 0.0, 0.0, 0.0, 1.0, 3.0 };
  drawn.Options.Alpha = lengths[source.Draw(5)];
  drawn.Options.LongestEdge = lengths[source.Draw(5)];
  drawn.Options.PointTolerance = source.Once(6) ? 1.5 : 0.0;
  if (source.Once(3))
  {
    const double angles[] = { 0.0, 15.0, 25.0, 30.0 }, areas[] = { 0.0, 0.0, 0.5, 3.0 };
    drawn.Options.MinimumAngle = angles[source.Draw(4)];
    drawn.Options.MaximumArea = areas[source.Draw(4)];
    drawn.Options.KeepBoundary = source.Once(4);
    drawn.Options.PointLimit = 1000;
    if (source.Once(2))
    {
      AddHardSegments(source, drawn.Input);
    }
    if (source.Once(4))
    {
      AddNestedRings(source, drawn.Input);
    }
  }
  return drawn;
}

/// Unless triangles were removed, none is left over or twice.
void ExpectRightNumber(const PointCase& drawn, const Places& points, const Triangulation& result)
{
  const PointCounts& counts = result.Report.FromPoints;
  std::set<Place> places;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const bool isUsed =
      i >= drawn.Input.Points.size() || result.UsedPoints[i] == static_cast<std::int64_t>(i);
    if (isUsed)
    {
      places.insert({ points[i][0] + 0.0, points[i][1] + 0.0 });
    }
  }
  if (counts.OutsideTriangles + counts.LargeTriangles == 0)
  {
    ExpectRightNumber(places, result);
  }
}

/// Whether a place is in the box around three points.
bool IsInBox(const Place& a, const Place& b, const Place& c, const Place& place)
{
  bool isInside = true;
  for (int axis = 0; axis < 2; ++axis)
  {
    const auto [low, high] = std::minmax({ a[axis], b[axis], c[axis] });
    isInside = isInside && place[axis] >= low && place[axis] <= high;
  }
  return isInside;
}

/// By rational numbers, the first triangle that has a place.
std::int32_t FindTriangle(
  const Places& points, const std::vector<std::int32_t>& triangles, const Place& place)
{
  for (std::size_t t = 0; t < triangles.size() / 3; ++t)
  {
    const std::int32_t* corners = &triangles[3 * t];
    bool hasPlace =
      IsInBox(points[corners[0]], points[corners[1]], points[corners[2]], place); // saves most
    for (int i = 0; i < 3 && hasPlace; ++i)
    {
      const Place& a = points[triangles[3 * t + i]];
      const Place& b = points[triangles[3 * t + (i + 1) % 3]];
      hasPlace = RationalTurn(ToPoint(a), ToPoint(b), ToPoint(place)) >= 0;
    }
    if (hasPlace)
    {
      return static_cast<std::int32_t>(t);
    }
  }
  return -1;
}

/// -1 for places that are not finite.
std::vector<std::int32_t> FindTriangles(
  const Places& points, const std::vector<std::int32_t>& triangles, const Places& places)
{
  std::vector<std::int32_t> found;
  for (const Place& place : places)
  {
    const bool isFinite = std::isfinite(place[0]) && std::isfinite(place[1]);
    found.push_back(isFinite ? FindTriangle(points, triangles, place) : -1);
  }
  return found;
}

/// Places are found in their triangles, and coordinates, as values, are interpolated right there.
void ExpectRightAnswers(
  const FlipSession& session, const Places& points, const std::vector<std::int32_t>& triangles)
{
  std::mt19937 random(static_cast<std::uint32_t>(points.size()));
  const auto pick = [&] { return points[DrawIndex(random, points.size())]; };
  Places places;
  for (int i = 0; i < 4; ++i)
  {
    const Place a = pick(), b = pick(), c = pick();
    places.push_back(a);
    places.push_back({ a[0], b[1] });
    places.push_back({ 0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1] });
    places.push_back(
      { 0.5 * a[0] + 0.25 * b[0] + 0.25 * c[0], 0.5 * a[1] + 0.25 * b[1] + 0.25 * c[1] });
    if (!triangles.empty()) // in the middle of an edge, and of its shorter and longer part
    {
      const std::size_t corner = DrawIndex(random, triangles.size());
      const Place& from = points[triangles[corner]];
      const Place& to = points[triangles[corner % 3 == 2 ? corner - 2 : corner + 1]];
      const double share = 0.25 * (i % 3 + 1);
      places.push_back(
        { (1.0 - share) * from[0] + share * to[0], (1.0 - share) * from[1] + share * to[1] });
    }
  }
  const std::vector<std::int32_t> expected = FindTriangles(points, triangles, places);
  double size = 0.0;
  for (const Place& point : points)
  {
    if (std::isfinite(point[0]) && std::isfinite(point[1]))
    {
      size = std::max({ size, std::fabs(point[0]), std::fabs(point[1]) });
    }
  }
  // Sums of values near the largest numbers may overflow, and the smallest have few digits.
  size = std::max(size, 1e-300);
  const double scale = std::scalbn(1.0, -std::clamp(std::ilogb(size), -1000, 1000));
  // The last value is 0 or 1.
  std::vector<std::array<double, 3>> values;
  for (const Place& point : points)
  {
    values.push_back(
      { point[0] * scale, point[1] * scale, static_cast<double>(values.size() % 2) });
  }
  for (const InterpolationKind method : { InterpolationKind::Linear, InterpolationKind::Natural })
  {
    std::vector<std::int32_t> found(places.size());
    std::vector<std::array<double, 3>> results(places.size());
    PlaceQuery query;
    query.Places = View(places);
    query.Triangles = found.data();
    query.Values = values.front().data();
    query.Components = 3;
    query.Method = method;
    query.Results = results.front().data();
    EXPECT_TRUE(session.Ask(query));
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      EXPECT_EQ(expected[i], found[i]) << places[i][0] << ' ' << places[i][1];
      for (int axis = 0; axis < 2; ++axis)
      {
        EXPECT_EQ(expected[i] < 0, std::isnan(results[i][axis]))
          << places[i][0] << " " << places[i][1];
        if (expected[i] >= 0)
        {
          EXPECT_NEAR(places[i][axis] * scale, results[i][axis], 1e-8 * size * scale)
            << places[i][0] << ' ' << places[i][1] << ": " << results[i][axis];
        }
      }
      if (expected[i] >= 0)
      {
        // Natural weights may be a little negative beside segments.
        constexpr double Beyond = 1.0 / 64.0 + 1e-9;
        EXPECT_NEAR(0.5, results[i][2], 0.5 + Beyond) << places[i][0] << ' ' << places[i][1];
      }
    }
  }
}

/// How many triangles have an angle below one in degrees, by more than rounding.
std::int64_t CountSharp(
  const Places& points, const std::vector<std::int32_t>& triangles, double angle)
{
  const long double cosine = std::cos((angle - 1e-7) * M_PI / 180.0);
  std::set<std::size_t> sharp;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const std::size_t first = i - i % 3;
    const Place& a = points[triangles[i]];
    const Place& b = points[triangles[first + (i + 1) % 3]];
    const Place& c = points[triangles[first + (i + 2) % 3]];
    const long double u1 = (long double)(b[0]) - a[0], v1 = (long double)(b[1]) - a[1];
    const long double u2 = (long double)(c[0]) - a[0], v2 = (long double)(c[1]) - a[1];
    if (u1 * u2 + v1 * v2 > cosine * std::hypot(u1, v1) * std::hypot(u2, v2))
    {
      sharp.insert(first);
    }
  }
  return static_cast<std::int64_t>(sharp.size());
}

/// Only triangles that the report counts have smaller angles than wanted.
void ExpectRefined(const PointCase& drawn, const Places& points, const Triangulation& result)
{
  bool isUsual = true; // squares of products of coordinates neither overflow nor underflow
  for (const Place& point : points)
  {
    for (const double coordinate : point)
    {
      const double size = std::fabs(coordinate);
      isUsual = isUsual && (size == 0.0 || std::isnan(size) || (size > 1e-60 && size < 1e60));
    }
  }
  if (drawn.Options.MinimumAngle > 0.0 && isUsual)
  {
    EXPECT_GE(result.Report.FromPoints.UnrefinedTriangles,
      CountSharp(points, result.Triangles, drawn.Options.MinimumAngle));
  }
}

/// The triangles, whatever their order.
std::set<std::set<std::int32_t>> ListTriangles(const std::vector<std::int32_t>& ids)
{
  std::set<std::set<std::int32_t>> triangles;
  for (std::size_t i = 0; i < ids.size(); i += 3)
  {
    triangles.insert({ ids[i], ids[i + 1], ids[i + 2] });
  }
  return triangles;
}

/// After points have moved by steps of several sizes, and one was removed, the triangles are those
/// of a triangulation of the points where they are.
void ExpectMotion(const PointCase& drawn)
{
  const PointOptions options = WithThreads(1, drawn.Options);
  FlipSession session(drawn.Input.View(), options);
  session.Advance();
  PointCase now = drawn;
  Places& points = now.Input.Points;
  std::mt19937 random(static_cast<std::uint32_t>(points.size()));
  double size = 0.0;
  for (const Place& point : points)
  {
    const double sum = std::fabs(point[0]) + std::fabs(point[1]);
    size = std::isfinite(sum) ? std::max(size, sum) : size;
  }
  for (const double share : { 0.0, 1e-7, 1e-4, 1e-3, 0.01, 0.1, 1e-3, -1.0 })
  {
    try
    {
      if (share < 0.0)
      {
        const auto id = static_cast<std::int64_t>(DrawIndex(random, points.size()));
        points[id] = { NAN, NAN };
        EXPECT_TRUE(session.Remove(&id, 1));
      }
      else
      {
        for (Place& point : points)
        {
          point[0] += share * size * (static_cast<double>(DrawIndex(random, 2001)) / 1000.0 - 1.0);
          point[1] += share * size * (static_cast<double>(DrawIndex(random, 2001)) / 1000.0 - 1.0);
        }
        EXPECT_TRUE(session.Move({ View(points) }));
      }
    }
    catch (const InvalidMesh&)
    {
      EXPECT_THROW(Triangulate(now.Input, options), InvalidMesh);
      return;
    }
    const Triangulation expected = Triangulate(now.Input, options);
    EXPECT_EQ(ListTriangles(expected.Triangles), ListTriangles(StoreTriangles(session)));
    std::vector<std::int64_t> used(points.size());
    session.StoreUsedPoints(used.data());
    EXPECT_EQ(expected.UsedPoints, used);
  }
}

/// Judges answers to queries alone, without refinement.
void JudgeAnswers(const PointCase& drawn)
{
  const FlipSession session = FlipPoints(drawn.Input.View(), WithThreads(1, drawn.Options));
  Places points = drawn.Input.Points;
  for (const AddedPoint& added : session.GetAddedPoints()) // by refinement, or where segments cross
  {
    points.push_back({ added.X, added.Y });
  }
  ExpectRightAnswers(session, points, StoreTriangles(session));
}

/// Reports a failure of GoogleTest for each promise that is broken: the result is the same on one
/// thread and on several; triangles turn left and are constrained Delaunay; their number is right;
/// queries about places are answered correctly; and it follows points that move. An open ring, or
/// one that crosses a segment, is an error.
void JudgePointCase(const PointCase& drawn)
{
  Triangulation result;
  try
  {
    if (judgesAnswersOnly)
    {
      JudgeAnswers(drawn);
      return;
    }
    result = Triangulate(drawn.Input, WithThreads(1, drawn.Options));
  }
  catch (const InvalidMesh&)
  {
    const std::vector<std::int32_t>& rings = drawn.Input.Rings;
    EXPECT_TRUE(
      std::any_of(rings.begin(), rings.end(), [](std::int32_t ring) { return ring >= 0; }));
    return;
  }
  const Triangulation other = Triangulate(drawn.Input, WithThreads(3, drawn.Options));
  EXPECT_EQ(result.Triangles, other.Triangles);
  EXPECT_EQ(result.Neighbors, other.Neighbors);
  EXPECT_EQ(result.UsedPoints, other.UsedPoints);
  EXPECT_EQ(result.Edges, other.Edges);
  ExpectSameStatistics(result.Report, other.Report);
  EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
  EXPECT_EQ(static_cast<std::int64_t>(result.Triangles.size()) / 3, result.Report.Triangles);
  Places points = drawn.Input.Points;
  for (const AddedPoint& added : result.Added)
  {
    points.push_back({ added.X, added.Y });
  }
  Triangulation kept = result;
  const EdgeMap edges = CollectEdges(ViewTriangles(result.Triangles));
  const bool mayLack = result.Report.FromPoints.OutsideTriangles > 0;
  kept.Edges.erase(
    std::remove_if(kept.Edges.begin(), kept.Edges.end(),
      [&](const auto& edge) { return mayLack && edges.count(Sorted(edge[0], edge[1])) == 0; }),
    kept.Edges.end());
  ExpectConstrainedDelaunay(points, kept);
  ExpectRefined(drawn, points, result);
  if (result.Report.FromPoints.RefinementPoints ==
    0) // else the hull has places beside it by rounding
  {
    ExpectRightAnswers(
      FlipPoints(drawn.Input.View(), WithThreads(2, drawn.Options)), points, result.Triangles);
  }
  ExpectRightNumber(drawn, points, result);
  if (points.size() % 4 == 0) // for a part of the cases, because it takes long
  {
    ExpectMotion(drawn);
  }
}

}
}

using namespace delaunayflip;

void SetUpTarget(int* argc, char** argv)
{
  testing::InitGoogleTest(argc, argv);
  testing::GTEST_FLAG(throw_on_failure) = true;
  char** const end = std::remove_if(
    argv + 1, argv + *argc, [](const char* word) { return std::string(word) == "--answers"; });
  judgesAnswersOnly = end != argv + *argc;
  *argc = static_cast<int>(end - argv);
}

void RunTarget(const std::uint8_t* bytes, std::size_t size)
{
  JudgePointCase(MakePointCase(bytes, size));
}

void PrintTarget(const std::uint8_t* bytes, std::size_t size)
{
  const PointCase drawn = MakePointCase(bytes, size);
  PrintDrawing(drawn.Input);
  std::cout << "split " << drawn.Options.SplitCrossings << ", ring rule "
            << static_cast<int>(drawn.Options.RingRule) << ", first hole " << drawn.Input.FirstHole
            << ", alpha " << drawn.Options.Alpha << ", longest edge " << drawn.Options.LongestEdge
            << ", tolerance " << drawn.Options.PointTolerance << ", minimum angle "
            << drawn.Options.MinimumAngle << ", maximum area " << drawn.Options.MaximumArea
            << ", keep boundary " << drawn.Options.KeepBoundary << '\n';
}
