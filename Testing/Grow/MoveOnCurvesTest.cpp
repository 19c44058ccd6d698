// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTestSupport.h"

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

/// The next triangles of a circle that waves have nothing in common with the last ones.
TEST(MoveOnCurves, BeginsAnewIfThatTakesFewerFlips)
{
  const auto makeWave = [](int frame)
  {
    const auto radius = [=](double angle) { return 1.0 + 0.01 * std::sin(7.0 * angle + frame); };
    return MakeRing(20000, radius);
  };
  Moving moving(ToDrawing(makeWave(0)));
  Places shifted = moving.Now.Points;
  for (Place& point : shifted)
  {
    point[0] += 1.0 / 64.0;
  }
  moving.GoTo(shifted);
  EXPECT_EQ(1, moving.InPlace);
  for (int frame = 1; frame < 4; ++frame)
  {
    moving.GoTo(makeWave(frame));
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

}
}
