// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DivideAndConquer.h"
#include "PointSets.h"
#include "PointTestSupport.h"
#include "RandomInputs.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

/// @file
/// Triangulations of points, judged by CGAL, rational numbers and the flips of other
/// triangulations.

namespace delaunayflip
{
namespace
{

/// By rational numbers: all triangles are right, and no place is inside a circle.
void ExpectDelaunay(const Places& points, const Triangulation& result)
{
  const std::set<Place> places(points.begin(), points.end());
  for (std::size_t i = 0; i < result.Triangles.size(); i += 3)
  {
    const Point3 a = ToPoint(points[result.Triangles[i]]);
    const Point3 b = ToPoint(points[result.Triangles[i + 1]]);
    const Point3 c = ToPoint(points[result.Triangles[i + 2]]);
    for (const Place& place : places)
    {
      ASSERT_GE(0, RationalInCircle(a, b, c, ToPoint(place)));
    }
  }
  ExpectConstrainedDelaunay(points, result);
  ExpectRightNumber(places, result);
}

//------------------------------------------------------------------------------
/// All sets of six points of a lattice of 3 by 3. Symmetric sets are not alike to the strips.
TEST(PointTriangulation, AllOrdersOfSixPoints)
{
  std::array<int, 9> isChosen{ 0, 0, 0, 1, 1, 1, 1, 1, 1 };
  int sets = 0;
  do
  {
    Places points;
    for (int i = 0; i < 9; ++i)
    {
      if (isChosen[i])
      {
        points.push_back({ static_cast<double>(i / 3), static_cast<double>(i % 3) });
      }
    }
    ExpectDelaunay(points, Triangulate(points));
    const auto expected = ByPlaces(Triangulate(points).Triangles, points);
    std::int64_t order = 0; // points are sorted, so next_permutation finds every order
    do
    {
      ASSERT_TRUE(
        order++ % Reduction != 0 || expected == ByPlaces(Triangulate(points).Triangles, points))
        << "order " << order << " of set " << sets;
    } while (std::next_permutation(points.begin(), points.end()));
    ++sets;
  } while (std::next_permutation(isChosen.begin(), isChosen.end()));
  EXPECT_EQ(84, sets);
}

class PointFamiliesTest : public testing::TestWithParam<PointFamily>
{
};

TEST_P(PointFamiliesTest, AreDelaunay)
{
  std::mt19937 random(3);
  for (int i = 0; i < 60 / Reduction; ++i)
  {
    Places points;
    for (std::uint32_t draws = 1 + random() % 8; draws > 0; --draws)
    {
      for (const Point3& point : GetParam().Draw(random))
      {
        if (std::isfinite(point[0]) && std::isfinite(point[1]))
        {
          points.push_back({ point[0], point[1] });
        }
      }
    }
    ExpectDelaunay(points, Triangulate(points));
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
  Draws, PointFamiliesTest, testing::ValuesIn(ListPointFamilies()), GetCaseName);

//------------------------------------------------------------------------------
class PointSetsTest : public testing::TestWithParam<PointSet>
{
protected:
  /// Without repeated ones.
  static Places Draw(std::int64_t count)
  {
    const Places all = MakePlaces(GetParam(), count);
    const std::set<Place> places(all.begin(), all.end());
    Places points(places.begin(), places.end());
    std::shuffle(points.begin(), points.end(), std::mt19937(4));
    return points;
  }
};

TEST_P(PointSetsTest, EqualCgal)
{
  const Places points = Draw(30000 / Reduction);
  const Triangulation result = Triangulate(points);
  const OwnedMesh<double> mesh = ToMesh(points, result.Triangles);
  EXPECT_EQ(MakeCgalDelaunay(mesh.View().Points).size(), result.Triangles.size() / 3);
  EXPECT_EQ(0, CountCgalViolations(mesh.View()));
  ExpectNeighbors(result);
  ExpectRightNumber({ points.begin(), points.end() }, result);
}

TEST_P(PointSetsTest, DependOnThePointsAlone)
{
  const Places points = Draw(20000 / Reduction);
  const Triangulation one = Triangulate(points, WithThreads(1));
  const Triangulation many = Triangulate(points, WithThreads(5));
  EXPECT_EQ(one.Triangles, many.Triangles);
  EXPECT_EQ(one.Report.TotalFlips, many.Report.TotalFlips);
  Places shuffled = points;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
  EXPECT_EQ(ByPlaces(one.Triangles, points), ByPlaces(Triangulate(shuffled).Triangles, shuffled));
}

INSTANTIATE_TEST_SUITE_P(Sets, PointSetsTest, testing::ValuesIn(ListPointSets()), GetCaseName);

/// Where flips would be a long chain, divide and conquer takes over before the first one.
TEST_P(PointSetsTest, OnlySomeTakeFlips)
{
  static const std::set<std::string> divided = { "ring", "ellipse", "parabola", "hyperbola",
    "spiral", "scan_lines", "survey_lines", "profiles", "wide", "circle", "two_circles",
    "line_and_point", "two_rows" };
  // The strips of 2,000 points depend on which ones are sampled, and so on their order. It is
  // another one in other standard libraries.
  static const std::set<std::string> dependOnOrder = { "clusters", "power", "profiles" };
  const std::string name = GetParam().Name;
  for (const std::int64_t count : { 2000, 20000 })
  {
    if (count > 2000 || dependOnOrder.count(name) == 0)
    {
      const FlipReport report = Triangulate(Draw(count)).Report;
      EXPECT_EQ(divided.count(name) > 0, report.TotalFlips == 0)
        << count << ": " << report.TotalFlips;
    }
  }
}

/// Whichever way they take, and whatever triangulation flips begin with.
TEST_P(PointSetsTest, EqualCanonicalFlips)
{
  const Places points = Draw(1000 / Reduction);
  const OwnedMesh<double> swept = MakeSweptMesh(points);
  const FlipResult flipped = Flip(swept.View(), InPlane(TieRuleKind::Canonical));
  EXPECT_EQ(ByPlaces(flipped.Triangles, points), ByPlaces(Triangulate(points).Triangles, points));
}

/// The last three sets, on which flips or cutting ears may take quadratic time.
class HardPointSetsTest : public PointSetsTest
{
};

TEST_P(HardPointSetsTest, WorkGrowsWithThePoints)
{
  const auto work = [](std::uint32_t count)
  {
    const FlipReport report = Triangulate(Draw(count)).Report;
    constexpr std::int64_t FlipsPerIteration = 256; // that take as long as one
    return report.TotalFlips +
      FlipsPerIteration * static_cast<std::int64_t>(report.Iterations.size()) + count;
  };
  EXPECT_LE(2 * work(40000 / Reduction), 5 * work(20000 / Reduction));
}

INSTANTIATE_TEST_SUITE_P(Hard, HardPointSetsTest,
  testing::ValuesIn(ListPointSets().end() - 3, ListPointSets().end()), GetCaseName);

/// Ties are decided as by flips of any other triangulation.
TEST(PointTriangulation, EqualsCanonicalFlips)
{
  std::mt19937 random(6);
  for (int i = 0; i < 40 / Reduction; ++i)
  {
    const Places points = DrawDistinct(random, 400, 20, 30);
    const OwnedMesh<double> swept = MakeSweptMesh(points);
    const FlipResult flipped = Flip(swept.View(), InPlane(TieRuleKind::Canonical));
    EXPECT_EQ(ByPlaces(flipped.Triangles, points), ByPlaces(Triangulate(points).Triangles, points));
  }
}

/// Ties are also decided if divide and conquer takes over after many flips.
TEST(PointTriangulation, TiesAfterManyFlips)
{
  constexpr int Radius = 1105; // this circle goes through 108 points of the lattice
  Places points;
  for (int x = -Radius; x <= Radius; ++x)
  {
    const double y = std::sqrt(double(Radius * Radius - x * x));
    if (y == std::floor(y))
    {
      for (const double far : { 0.0, 1e6 })
      {
        points.push_back({ x + far, far - y });
        points.push_back({ x + far, far + y });
      }
    }
  }
  const Triangulation made = Triangulate(points);
  EXPECT_EQ(StopReasonKind::Converged, made.Report.StopReason);
  EXPECT_EQ(0, made.Report.NonDelaunayAfter);
  const OwnedMesh<double> swept = MakeSweptMesh(points);
  const FlipResult flipped = Flip(swept.View(), InPlane(TieRuleKind::Canonical));
  EXPECT_EQ(ByPlaces(flipped.Triangles, points), ByPlaces(made.Triangles, points));
}

//------------------------------------------------------------------------------
TEST(PointTriangulation, EqualPlacesAreOnePoint)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Places points = { { 1, 0 }, { 0.0, 0 }, { nan, 0 }, { -0.0, 0.0 }, { 0, 1 }, { 1, 0 },
    { 1, 1 }, { 2, std::numeric_limits<double>::infinity() } };
  const Triangulation result = Triangulate(points);
  EXPECT_EQ(2, result.Report.Triangles);
  const std::vector<std::int64_t> used = { 0, 1, -1, 1, 4, 0, 6, -1 };
  EXPECT_EQ(used, result.UsedPoints);
  ASSERT_EQ(2u, result.Report.Defects.size());
  EXPECT_EQ(2, result.Report.Defects[0].Count);
  EXPECT_EQ(2, result.Report.Defects[1].Count);
}

TEST(PointTriangulation, OfNothing)
{
  for (const Places& points : { Places{}, Places{ { 1, 2 } }, Places{ { 1, 2 }, { 3, 4 } },
         Places(1000, { 5, 5 }), Places{ { 0, 0 }, { 1, 1 }, { 2, 2 }, { 3, 3 } } })
  {
    const Triangulation result = Triangulate(points);
    EXPECT_EQ(0, result.Report.Triangles);
    EXPECT_EQ(StopReasonKind::Converged, result.Report.StopReason);
    const std::string why = DescribeDefects(result.Report.Defects);
    EXPECT_EQ(!points.empty(), why.find("without a triangle") != std::string::npos) << why;
  }
}

/// Nearly all of the points are in one strip, which several threads sort.
TEST(PointTriangulation, OneLongStrip)
{
  std::mt19937 random(12);
  Places points = { { 0.5, 1.0 } };
  for (int i = 0; i < 200000; ++i)
  {
    points.push_back({ DrawIndex(random, 1 << 30) * 0x1p-30, 0.0 });
  }
  const std::set<Place> places(points.begin(), points.end());
  const Triangulation result = Triangulate(points);
  ExpectRightNumber(places, result);
  EXPECT_EQ(static_cast<std::int64_t>(places.size()), CountBorder(result));
}

/// Floats are judged as the floats they are; other numbers between points do not matter.
TEST(PointTriangulation, FloatsAndStrides)
{
  std::mt19937 random(7);
  std::vector<float> floats;
  Places points;
  for (int i = 0; i < 5000; ++i)
  {
    floats.push_back(static_cast<float>(random()) * 0x1p-32f);
    floats.push_back(static_cast<float>(random()) * 0x1p-32f);
    floats.push_back(std::numeric_limits<float>::quiet_NaN()); // z does not matter
    points.push_back({ floats[3 * i], floats[3 * i + 1] });
  }
  const Triangulation result = Triangulate(PointInput{ PlaneArray(floats.data(), 5000, 3) });
  EXPECT_EQ(ToTriangleSet(Triangulate(points).Triangles), ToTriangleSet(result.Triangles));
}

TEST(PointTriangulation, CanBeStopped)
{
  std::mt19937 random(9);
  const Places points = DrawOnGrid(random, 20000, 1 << 20, 1 << 20);
  for (const double limit : { 0.0, 0.3, 0.45 })
  {
    FlipSession session(PointInput{ View(points) }, PointOptions{ OnTestBackend({}) },
      [=](double share) { return share <= limit; });
    EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
    EXPECT_FALSE(session.Advance(-1, {}, {}));
    EXPECT_EQ(StopReasonKind::Converged, session.GetReport().StopReason);
    EXPECT_EQ(Triangulate(points).Triangles, StoreTriangles(session));
  }
}

/// Strips may have any number of places, also one.
TEST(PointTriangulation, DivideAndConquerOfSmallGrids)
{
  std::mt19937 random(11);
  for (int i = 0; i < 1000 / Reduction; ++i)
  {
    Places points =
      DrawDistinct(random, 3 + random() % 40, 1 + DrawIndex(random, 9), 1 + DrawIndex(random, 30));
    int stripOf[30] = {}; // by y
    for (int y = 1; y < 30; ++y)
    {
      stripOf[y] = stripOf[y - 1] + DrawIndex(random, 2);
    }
    std::stable_sort(points.begin(), points.end(),
      [&](const auto& a, const auto& b)
      { return stripOf[static_cast<int>(a[1])] < stripOf[static_cast<int>(b[1])]; });
    if (points.size() < 3)
    {
      continue;
    }
    HostMemory memory;
    const PointTriangles divided = DivideAndConquer(static_cast<std::int64_t>(points.size()),
      { [](std::int64_t size, const std::function<void(std::int64_t)>& work)
        {
          for (std::int64_t task = 0; task < size; ++task)
          {
            work(task);
          }
        },
        [&](std::int64_t first, std::int64_t end, NumberedPlace* to)
        {
          for (std::int64_t place = first; place < end; ++place, ++to)
          {
            *to = { points[place][0], points[place][1], static_cast<std::uint32_t>(place) };
          }
        },
        [](double) {}, memory });
    Triangulation result;
    for (std::size_t t = 0; t < divided.Triangles.Size(); ++t)
    {
      const TriangleRecord& triangle = divided.Triangles[t];
      for (int slot = 0; slot < 3; ++slot)
      {
        const CornerId across = triangle.HalfEdges[slot];
        result.Triangles.push_back(static_cast<std::int32_t>(triangle.Vertices[slot]));
        result.Neighbors.push_back(
          across == NoCorner ? -1 : static_cast<std::int32_t>(TriangleOf(across)));
      }
    }
    result.Report.Triangles = static_cast<std::int64_t>(divided.Triangles.Size());
    result.Report.StopReason = StopReasonKind::Converged;
    ExpectDelaunay(points, result);
    ASSERT_TRUE(result.Triangles.empty() || CountBorder(result) == divided.HullEdges);
    ASSERT_FALSE(HasFailure()) << "case " << i;
  }
}

/// The calling thread is asked while other threads work, whatever they do, and hears how far they
/// are; what it throws ends their work.
TEST(PointTriangulation, DivideAndConquerAsks)
{
  constexpr int Columns = 200, Rows = 150;
  std::mt19937 random(10);
  std::vector<CoordinatePair<double>> places;
  for (int i = 0; i < Columns * Rows; ++i)
  {
    places.push_back({ i % Columns + 1e-4 * DrawIndex(random, 9000),
      i / Columns + 1e-4 * DrawIndex(random, 9000) });
  }
  std::vector<double> told;
  std::atomic<std::size_t> count{ 0 };
  int tasks = 0;
  std::size_t most = 1000;
  double patience = 20.0;
  const auto run = [&](std::int64_t size, const std::function<void(std::int64_t)>& work)
  {
    for (std::int64_t task = 0; task < size; ++task)
    {
      work(task);
      ++tasks;
      // Until the calling thread is asked, if it is, or the work stops.
      const StopWatch watch;
      const std::size_t before = count;
      while (count == before && watch.GetSeconds() < patience)
      {
        std::this_thread::yield();
      }
      patience = count == before ? 0.0 : (count < most ? patience : 1.0);
    }
  };
  const auto getPlaces = [&](std::int64_t first, std::int64_t end, NumberedPlace* to)
  {
    for (std::int64_t i = first; i < end; ++i, ++to)
    {
      *to = { places[i].U, places[i].V, static_cast<std::uint32_t>(i) };
    }
  };
  const auto tell = [&](double share)
  {
    told.push_back(share);
    if (++count == most)
    {
      throw RunAborted();
    }
  };
  HostMemory memory;
  const DivideAndConquerCaller caller{ run, getPlaces, tell, memory };
  const PointTriangles divided = DivideAndConquer(static_cast<std::int64_t>(places.size()), caller);
  EXPECT_EQ(2 * places.size() - 2 - divided.HullEdges, divided.Triangles.Size());
  const int all = tasks;
  ASSERT_LE(static_cast<std::size_t>(all), told.size());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LE(4u, std::set<double>(told.begin(), told.end()).size());
  EXPECT_EQ(1.0, told.back());
  most = count + 2;
  tasks = 0;
  EXPECT_THROW(DivideAndConquer(static_cast<std::int64_t>(places.size()), caller), RunAborted);
  EXPECT_GT(all / 2, tasks);
}

/// Exact arithmetic decides all, so that few points take long; the calling thread does it alone.
TEST(PointTriangulation, FewPlacesThatTakeLong)
{
  std::mt19937 random(13);
  Places points;
  const auto draw = [&]
  {
    return std::ldexp(
      1.0 + DrawIndex(random, 1000), static_cast<int>(DrawIndex(random, 1900)) - 950);
  };
  for (int i = 0; i < 4000; ++i) // fewer would not take long enough
  {
    points.push_back({ draw(), draw() });
  }
  std::vector<double> told;
  std::size_t most = 1000000;
  const auto tell = [&](double share)
  {
    told.push_back(share);
    return told.size() < most;
  };
  PointOptions onThreads;
  onThreads.Backend = BackendKind::Threads; // a GPU has other steps
  const Places few(points.begin(), points.begin() + 300);
  FlipSession(PointInput{ View(few) }, onThreads, tell);
  const std::size_t steps = told.size();
  told.clear();
  FlipSession session(PointInput{ View(points) }, onThreads, tell);
  EXPECT_LT(steps, told.size()) << "it asks within the step that takes long";
  EXPECT_EQ(0, session.GetReport().NonDelaunayBefore) << "nothing is left for flips";
  most = steps + 1; // not more, because how often it asks depends on how long it takes
  told.clear();
  const FlipSession stopped(PointInput{ View(points) }, onThreads, tell);
  EXPECT_EQ(StopReasonKind::Aborted, stopped.GetReport().StopReason);
  EXPECT_EQ(most, told.size());
}

TEST(PointTriangulation, TooManyPoints)
{
  const double one[2] = { 0.0, 0.0 };
  const PointInput points{ PlaneArray(one, std::int64_t(1) << 30, 2) };
  EXPECT_THROW(FlipSession(points, PointOptions()), MeshTooLarge);
}

/// Once all triangles of a mesh are removed, its iterations have no angle.
TEST(PointTriangulation, WithoutTrianglesHasNoAngle)
{
  Places points;
  for (int i = 0; i < 50; ++i)
  {
    points.push_back({ 10.0 * i, 0.3 * std::fmod(17.0 * i, 50.0) });
  }
  const FlipReport some = Triangulate(points).Report;
  const FlipReport none =
    Triangulate(PointInput{ View(points) }, With(&PointOptions::LongestEdge, 1e-3)).Report;
  ASSERT_LT(0u, none.Iterations.size());
  FlipReport sum;
  AddReport(sum, none);
  EXPECT_TRUE(std::isnan(sum.Iterations[0].MinimumAngle));
  AddReport(sum, some);
  EXPECT_EQ(some.MinimumAngleAfter, sum.Iterations.back().MinimumAngle);
  EXPECT_EQ(some.TrianglesBelow20After, sum.TrianglesBelow20After);
  AddReport(sum, some);
  EXPECT_LT(0, some.TrianglesBelow20After);
  EXPECT_EQ(2 * some.TrianglesBelow20After, sum.TrianglesBelow20After);
}

/// They are measured after the last iteration, and when a report is asked for.
TEST(PointTriangulation, AnglesAreMeasuredAtTheEnd)
{
  std::mt19937 random(4);
  Places points;
  for (int i = 0; i < 300; ++i)
  {
    const double x = DrawIndex(random, 1000);
    points.push_back({ x, DrawIndex(random, 1000) + 0.001 * i });
  }
  const FlipReport report = Triangulate(points).Report;
  ASSERT_LT(1u, report.Iterations.size());
  EXPECT_TRUE(std::isnan(report.Iterations.front().MinimumAngle));
  EXPECT_EQ(report.MinimumAngleAfter, report.Iterations.back().MinimumAngle);
  FlipSession session(PointInput{ View(points) }, PointOptions());
  const double first = session.GetReport().MinimumAngleAfter;
  EXPECT_LT(0.0, first);
  EXPECT_LT(first, report.MinimumAngleAfter);
}

/// Nobody has seen the triangles that flips begin with.
TEST(PointTriangulation, AnglesBeforeAreUnknown)
{
  Places points;
  for (int i = 0; i < 50; ++i)
  {
    points.push_back({ 10.0 * i, 0.3 * std::fmod(17.0 * i, 50.0) });
  }
  const Triangulation result = Triangulate(points);
  const FlipReport& report = result.Report;
  ASSERT_LT(0, report.TotalFlips);
  EXPECT_TRUE(std::isnan(report.MinimumAngleBefore));
  EXPECT_EQ(0, report.TrianglesBelow30Before);
  EXPECT_LT(0, report.TrianglesBelow30After);
  const std::string summary = Summarize(report);
  EXPECT_EQ(0u, summary.rfind("mesh: 50 points, ", 0)) << summary;
  EXPECT_NE(std::string::npos, summary.find("\npoints: 50 used\n")) << summary;
  EXPECT_EQ(std::string::npos, summary.find("bad edges")) << summary;
  EXPECT_EQ(std::string::npos, summary.find("->")) << summary;
}

}
}
