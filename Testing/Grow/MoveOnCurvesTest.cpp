// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTestSupport.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

/// @file
/// Points on curves that move. There a small motion may take very many flips.

namespace delaunayflip
{
namespace
{

/// Points around the origin. @param radius by angle.
template <typename Radius>
Places MakeRing(int count, const Radius& radius)
{
  Places ring;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * M_PI * i / count;
    ring.push_back({ radius(angle) * std::cos(angle), radius(angle) * std::sin(angle) });
  }
  return ring;
}

/// A circle that waves.
Places MakeWave(int frame)
{
  return MakeRing(20000, [=](double angle) { return 1.0 + 0.01 * std::sin(7.0 * angle + frame); });
}

/// Its next triangles have nothing in common with the last ones.
TEST(MoveOnCurves, BeginsAnewIfThatTakesFewerFlips)
{
  Moving moving(ToDrawing(MakeWave(0)));
  Places shifted = moving.Now.Points;
  for (Place& point : shifted)
  {
    point[0] += 1.0 / 64.0;
  }
  moving.GoTo(shifted);
  EXPECT_EQ(1, moving.InPlace);
  for (int frame = 1; frame < 4; ++frame)
  {
    moving.GoTo(MakeWave(frame));
    EXPECT_EQ(0, moving.Sessions.front().GetReport().FromPoints.MoveRounds);
    ASSERT_FALSE(HasFailure()) << frame;
  }
}

/// A point comes between a ring and its circle, but not in the first round, because another point
/// passes it. Then all circumcircles in the ring contain it, and one edge after the other flips:
/// more iterations than one group of threads makes in a round.
TEST(MoveOnCurves, GoesOnAfterAGroupOfThreads)
{
  std::mt19937 random(31);
  constexpr int Count = 320;
  Places points = MakeRing(Count, [](double angle) { return 1.0 + 1e-9 * std::cos(2.0 * angle); });
  for (const Place& point : DrawPlaces(random, 20000))
  {
    const Place place{ 8.0 * point[0] - 4.0, 8.0 * point[1] - 4.0 };
    if (std::hypot(place[0], place[1]) > 1.1)
    {
      points.push_back(place);
    }
  }
  const double angle = M_PI / Count; // of the middle of a chord
  const auto place = [&](double radius, double turn) {
    return Place{ radius * std::cos(angle + turn), radius * std::sin(angle + turn) };
  };
  points.push_back(place(1.02, 0.0));
  points.push_back(place(1.03, -0.02));
  Moving moving(ToDrawing(points));
  const std::size_t last = points.size() - 1;
  points[last - 1] = place((1.0 + std::cos(angle)) / 2.0, 0.0);
  points[last] = place(1.03, 0.02);
  moving.GoTo(points);
  EXPECT_EQ(1, moving.InPlace);
  EXPECT_LT(1, moving.Sessions.front().GetReport().FromPoints.MoveRounds);
  EXPECT_LT(Count - 4, moving.Sessions.front().GetReport().TotalFlips);
}

/// The middle of a ring is late, and has more triangles than one group of threads lists.
TEST(MoveOnCurves, MovesAPointWithVeryManyTriangles)
{
  constexpr int Count = 70000;
  for (const double way : { 0.006, -0.006 })
  {
    Places points = MakeRing(Count, [](double) { return 1.0; });
    points.push_back({ 0.0, 0.0 });
    points.push_back({ 0.99999, 0.0 });
    FlipSession session(PointInput{ View(points) }, PointOptions());
    session.Advance();
    points[Count] = { 1e-7, 1e-7 };
    points[Count + 1] = { 0.99999 * std::cos(way), 0.99999 * std::sin(way) };
    EXPECT_TRUE(session.Move({ View(points) }));
    EXPECT_LT(1, session.GetReport().FromPoints.MoveRounds);
    const Triangulation expected = Triangulate(PointInput{ View(points) });
    EXPECT_TRUE(Normalize(expected.Triangles) == Normalize(StoreTriangles(session)));
  }
}

/// Moves the points of a session. @returns what an observer is told that stops it at one call.
std::vector<double> StopAt(std::size_t call, const Places& places, FlipSession& session)
{
  std::vector<double> shares;
  const auto observe = [&](double share)
  {
    shares.push_back(share);
    return shares.size() != call;
  };
  const bool isThere = session.Move({ View(places) }, observe);
  EXPECT_EQ(shares.size() < call, isThere);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  return shares;
}

/// An observer stops a motion during its flips, and between its rounds. All points are then where
/// they were.
TEST(MoveOnCurves, AnObserverMayStopFlips)
{
  const Places wave = MakeWave(0);
  FlipSession waving(PointInput{ View(wave) }, PointOptions());
  waving.Advance();
  const Triples before = Normalize(StoreTriangles(waving));
  const std::vector<double> shares = StopAt(2, MakeWave(1), waving);
  EXPECT_LT(0.2, shares[1]); // the rest, if all is made anew, begins with about 0.02
  EXPECT_GT(0.5, shares[1]);
  EXPECT_TRUE(before == Normalize(StoreTriangles(waving)));
  EXPECT_TRUE(waving.GetReport().Converged());
  EXPECT_EQ(1.0, StopAt(1000, MakeWave(1), waving).back());
  const Places next = MakeWave(1);
  const Triangulation expected = Triangulate(PointInput{ View(next) });
  EXPECT_TRUE(Normalize(expected.Triangles) == Normalize(StoreTriangles(waving)));

  std::mt19937 random(32);
  const Places points = DrawPlaces(random, 3000);
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  const Triples first = Normalize(StoreTriangles(session));
  Places shaken = points;
  Shake(random, 0.02 * FindSpacing(points), shaken);
  EXPECT_EQ((std::vector<double>{ 0.0, 0.5 }), StopAt(2, shaken, session));
  EXPECT_TRUE(first == Normalize(StoreTriangles(session)));
  StopAt(1000, shaken, session);
  EXPECT_LT(1, session.GetReport().FromPoints.MoveRounds);
}

}
}
