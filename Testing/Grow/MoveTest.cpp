// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTestSupport.h"
#include "PointSets.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Points that move, are inserted and are removed.

namespace delaunayflip
{
namespace
{

/// The boundary also changes in nearly every frame.
TEST(Move, ByStepsOfAllSizes)
{
  std::mt19937 random(1);
  for (const double share : { 0.001, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0 })
  {
    SCOPED_TRACE(share);
    const Places points = DrawPlaces(random, 2000);
    const double size = share * FindSpacing(points);
    Moving moving(ToDrawing(points));
    for (int frame = 0; frame < CountFrames(10); ++frame)
    {
      Places next = moving.Now.Points;
      Shake(random, size, next);
      moving.GoTo(next);
      if (HasFailure())
      {
        return;
      }
    }
    if (share < 0.05)
    {
      EXPECT_LT(0.9 * moving.Frames, moving.InPlace);
    }
    RecordProperty("InPlace" + std::to_string(share),
      std::to_string(moving.InPlace) + " of " + std::to_string(moving.Frames));
  }
}

TEST(Move, PointSets)
{
  std::mt19937 random(2);
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    Moving moving(ToDrawing(MakePlaces(set, 1000 / Reduction)));
    const double spacing = FindSpacing(moving.Now.Points);
    const double steps[] = { 0.0, 0.001, 0.01, 0.05, 0.0, 3.0, 0.001, 0.01 };
    for (int frame = 0; frame < CountFrames(8); ++frame)
    {
      Places next = moving.Now.Points;
      Shake(random, steps[frame % 8] * spacing, next);
      moving.GoTo(next);
      if (HasFailure())
      {
        return;
      }
    }
  }
}

/// Two clusters pass through each other, and some points pass all others.
TEST(Move, ThroughEachOther)
{
  std::mt19937 random(3);
  for (const double speed : { 0.0005, 0.02 })
  {
    Places points = DrawPlaces(random, 600);
    for (std::size_t i = 0; i < 300; ++i)
    {
      points[i] = { 0.3 * points[i][0] - 1.0, 0.3 * points[i][1] + 0.35 };
    }
    Moving moving(ToDrawing(points));
    for (int frame = 0; frame < CountFrames(120); ++frame)
    {
      const double way = frame % 240 < 120 ? speed : -speed;
      Places next = moving.Now.Points;
      for (std::size_t i = 0; i < 300; ++i)
      {
        next[i][0] += way;
      }
      next[400][0] -= 10.0 * way; // one point goes faster
      moving.GoTo(next);
      ASSERT_FALSE(HasFailure()) << frame;
    }
    EXPECT_LT(0, moving.InPlace);
  }
}

/// Ties, and points that meet others and part again.
TEST(Move, OnLattices)
{
  std::mt19937 random(4);
  Places points;
  for (int i = 0; i < 900; ++i)
  {
    points.push_back({ static_cast<double>(i % 30), static_cast<double>(i / 30) });
  }
  Moving moving(ToDrawing(points));
  const auto shift = [&](std::size_t every, double x, double y)
  {
    Places next = moving.Now.Points;
    for (std::size_t i = 0; i < next.size(); i += every)
    {
      next[i] = { next[i][0] + x, next[i][1] + y };
    }
    moving.GoTo(next);
  };
  shift(1, 1.0, 0.0); // all points, by the same step
  EXPECT_EQ(1, moving.InPlace);
  shift(1, 0.0, 0.0);
  EXPECT_EQ(2, moving.InPlace);
  shift(30, 0.25, 0.0); // a side of the boundary
  shift(30, -0.5, 0.0);
  EXPECT_EQ(4, moving.InPlace);
  shift(7, 0.5, 0.5); // some points, to the middle of cells
  shift(7, -0.5, -0.5);
  shift(2, 1.0, 0.0); // some points, to the places of others
  EXPECT_LT(0, moving.Sessions[0].GetReport().FromPoints.Repeated);
  shift(2, -1.0, 0.0);
  EXPECT_EQ(0, moving.Sessions[0].GetReport().FromPoints.Repeated);
  for (int frame = 0; frame < CountFrames(40); ++frame)
  {
    Places next = moving.Now.Points;
    for (int i = 0; i < 20; ++i)
    {
      Place& point = next[DrawIndex(random, next.size())];
      point[0] += 0.5 * (static_cast<double>(DrawIndex(random, 3)) - 1.0);
      point[1] += 0.5 * (static_cast<double>(DrawIndex(random, 3)) - 1.0);
    }
    moving.GoTo(next);
    ASSERT_FALSE(HasFailure()) << frame;
  }
}

/// Two points at one place move together, which is done in place, and then apart.
TEST(Move, PointsAtOnePlace)
{
  std::mt19937 random(5);
  Places points = DrawPlaces(random, 300);
  points.push_back(points[7]);
  points.push_back({ NAN, 0.0 });
  Moving moving(ToDrawing(points));
  for (Place& point : points)
  {
    point[0] += 0.125;
  }
  moving.GoTo(points);
  EXPECT_EQ(1, moving.InPlace);
  points[300][0] += 0.01;
  moving.GoTo(points);
  EXPECT_EQ(1, moving.InPlace);
  points[301] = { 0.5, 0.5 };
  moving.GoTo(points);
  points[17][0] = INFINITY;
  moving.GoTo(points);
  points[17][0] = 0.5;
  moving.GoTo(points);
}

/// Points on the boundary move inwards and outwards, all of them or only a few, also along a line.
TEST(Move, TheBoundary)
{
  std::mt19937 random(6);
  Places points;
  for (int i = 0; i < 200; ++i)
  {
    points.push_back({ std::cos(0.1 * M_PI * i / 10.0), std::sin(0.1 * M_PI * i / 10.0) });
  }
  const Places inner = DrawPlaces(random, 200);
  for (const Place& point : inner)
  {
    points.push_back({ point[0] - 0.5, point[1] - 0.5 });
  }
  Moving moving(ToDrawing(points));
  for (int frame = 0; frame < CountFrames(60); ++frame)
  {
    Places next = points;
    for (int i = 0; i < 200; ++i)
    {
      const double wave = 1.0 + 0.02 * std::sin(0.3 * frame + 7.0 * i) * int(frame % 7 > 3);
      next[i] = { wave * points[i][0], wave * points[i][1] };
    }
    moving.GoTo(next);
    ASSERT_FALSE(HasFailure()) << frame;
  }
  EXPECT_LT(0, moving.InPlace);
}

/// Where triangles have been removed, and where many have the same lowest id.
TEST(Move, StoresTrianglesInOrder)
{
  Drawing wheel;
  wheel.Points.push_back({ 0.0, 0.0 });
  for (int i = 0; i < 6000; ++i)
  {
    wheel.Points.push_back({ std::cos(0.001 * i * i), std::sin(0.001 * i * i) });
  }
  Drawing ring = ToDrawing(wheel.Points);
  ring.AddRing({ { 0.3, 0.0 }, { 0.6, 0.2 }, { 0.1, 0.5 } });
  for (const Drawing& drawing : { wheel, ring })
  {
    FlipSession session(drawing.View(), PointOptions());
    session.Advance();
    EXPECT_LT(0, session.CountTriangles());
    EXPECT_EQ(Normalize(StoreTriangles(session)), ToTriples(StoreOrderedTriangles(session)));
    std::vector<std::int64_t> ids(3 * session.CountTriangles());
    session.StoreOrderedTriangles(MutableTriangleArray(ids.data(), session.CountTriangles()));
    EXPECT_TRUE(std::equal(ids.begin(), ids.end(), StoreOrderedTriangles(session).begin()));
  }
}

/// The points without the removed ones.
class Changing
{
public:
  explicit Changing(Places points)
    : Points(std::move(points)),
      Start(Points),
      Session(PointInput{ View(Start) }, PointOptions{ WithThreads(1) })
  {
    this->Session.Advance();
    this->Removed.resize(this->Points.size());
  }

  void Expect() const
  {
    Places left = this->Points;
    for (std::size_t i = 0; i < left.size(); ++i)
    {
      if (this->Removed[i])
      {
        left[i] = { NAN, NAN };
      }
    }
    const Triangulation expected = Triangulate(left);
    ASSERT_EQ(Normalize(expected.Triangles), Normalize(StoreTriangles(this->Session)));
    std::vector<std::int64_t> used(left.size());
    this->Session.StoreUsedPoints(used.data());
    ASSERT_EQ(expected.UsedPoints, used);
    const PointCounts& counts = this->Session.GetReport().FromPoints;
    ASSERT_EQ(std::count(this->Removed.begin(), this->Removed.end(), true), counts.Removed);
    ASSERT_EQ(expected.Report.FromPoints.NotFinite, counts.NotFinite + counts.Removed);
    ASSERT_EQ(this->Session.GetReport().Triangles, this->Session.CountTriangles());
  }

  Places Points, Start;
  std::vector<bool> Removed;
  FlipSession Session;
};

/// Points are moved, inserted and removed, in any order.
TEST(Move, ComeAndGo)
{
  std::mt19937 random(8);
  for (int trial = 0; trial < CountFrames(300); ++trial)
  {
    const int grid = 2 + static_cast<int>(DrawIndex(random, trial % 2 == 0 ? 6 : 1000));
    const auto draw = [&](std::size_t count)
    {
      Places points;
      while (points.size() < count)
      {
        points.push_back({ static_cast<double>(DrawIndex(random, grid)),
          static_cast<double>(DrawIndex(random, grid)) });
      }
      return points;
    };
    Changing all(draw(DrawIndex(random, 40)));
    for (int change = 0; change < 8; ++change)
    {
      const std::size_t count = all.Points.size();
      std::vector<std::int64_t> ids;
      ids.reserve(1); // so that data() is not null
      for (std::size_t i = 0; i < std::min<std::size_t>(count, DrawIndex(random, 5)); ++i)
      {
        ids.push_back(static_cast<std::int64_t>(DrawIndex(random, count)));
      }
      switch (DrawIndex(random, 5))
      {
        case 0:
        {
          const Places more = draw(DrawIndex(random, 5));
          EXPECT_TRUE(all.Session.Insert(View(more)));
          all.Points.insert(all.Points.end(), more.begin(), more.end());
          all.Removed.resize(all.Points.size());
          break;
        }
        case 1:
          EXPECT_TRUE(all.Session.Remove(ids.data(), static_cast<std::int64_t>(ids.size())));
          for (const std::int64_t id : ids)
          {
            all.Removed[id] = true;
          }
          break;
        case 2:
        {
          const Places places = draw(ids.size());
          PointMove move{ View(places) };
          move.Ids = ids.data();
          EXPECT_TRUE(all.Session.Move(move));
          for (std::size_t i = 0; i < ids.size(); ++i)
          {
            all.Points[ids[i]] = places[i];
          }
          break;
        }
        case 3:
          Shake(random, 0.02, all.Points);
          EXPECT_TRUE(all.Session.Move({ View(all.Points) }));
          break;
        default:
        {
          EXPECT_TRUE(all.Session.Compact());
          Places left;
          for (std::size_t i = 0; i < count; ++i)
          {
            if (!all.Removed[i])
            {
              left.push_back(all.Points[i]);
            }
          }
          all.Points = left;
          all.Removed.assign(left.size(), false);
        }
      }
      all.Expect();
      ASSERT_FALSE(HasFailure()) << trial << ' ' << change;
    }
  }
}

/// Points are removed in place: inside, on the boundary, on lattices, and with many triangles.
TEST(Move, PointsGoInPlace)
{
  std::mt19937 random(13);
  Places lattice, wheel = { { 0.0, 0.0 } };
  for (int i = 0; i < 900; ++i)
  {
    lattice.push_back({ static_cast<double>(i % 30), static_cast<double>(i / 30) });
  }
  for (int i = 0; i < 40; ++i)
  {
    wheel.push_back({ std::cos(0.05 * M_PI * i), std::sin(0.05 * M_PI * i) });
  }
  int inPlace = 0, all = 0;
  for (const Places& points : { DrawPlaces(random, 2000), lattice, wheel, DrawPlaces(random, 20) })
  {
    std::vector<FlipSession> sessions;
    for (const int threads : { 1, 3 })
    {
      sessions.emplace_back(PointInput{ View(points) }, PointOptions{ WithThreads(threads) });
      sessions.back().Advance();
    }
    Places left = points;
    for (int frame = 0; frame < 20; ++frame)
    {
      std::vector<std::int64_t> ids;
      for (std::size_t i = 0; i < (frame % 3 == 0 ? 1 : points.size() / 40); ++i)
      {
        ids.push_back(static_cast<std::int64_t>(DrawIndex(random, points.size())));
      }
      for (FlipSession& session : sessions)
      {
        EXPECT_TRUE(session.Remove(ids.data(), static_cast<std::int64_t>(ids.size())));
      }
      for (const std::int64_t id : ids)
      {
        left[id] = { NAN, NAN };
      }
      const Triangulation expected = Triangulate(left);
      ASSERT_EQ(Normalize(expected.Triangles), Normalize(StoreTriangles(sessions[0]))) << frame;
      ASSERT_EQ(StoreTriangles(sessions[0]), StoreTriangles(sessions[1]));
      std::vector<std::int64_t> used(points.size());
      sessions[0].StoreUsedPoints(used.data());
      ASSERT_EQ(expected.UsedPoints, used);
      const FlipReport& report = sessions[0].GetReport();
      ASSERT_EQ(expected.Report.Edges.Boundary, report.Edges.Boundary);
      ASSERT_EQ(expected.Report.EulerCharacteristic, report.EulerCharacteristic);
      inPlace += report.FromPoints.MoveRounds > 0 ? 1 : 0;
      ++all;
    }
  }
  EXPECT_LT(0.7 * all, inPlace);
}

/// Many points are removed in place: here and there, next to each other, and from a lattice.
TEST(Move, ManyPointsGoInPlace)
{
  std::mt19937 random(14);
  Places lattice;
  for (int i = 0; i < 8100; ++i)
  {
    lattice.push_back({ static_cast<double>(i % 90), static_cast<double>(i / 90) });
  }
  for (const Places& points : { DrawPlaces(random, 8000), lattice })
  {
    Moving moving(ToDrawing(points));
    const double size = std::max(points[89][0], 1.0);
    const auto remove = [&](const auto& isRemoved)
    {
      std::vector<std::int64_t> ids;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Place& place = moving.Now.Points[i];
        if (std::isfinite(place[0]) && isRemoved(place[0] / size - 0.5, place[1] / size - 0.5))
        {
          ids.push_back(static_cast<std::int64_t>(i));
        }
      }
      EXPECT_LT(100, ids.size());
      for (FlipSession& session : moving.Sessions)
      {
        EXPECT_TRUE(session.Remove(ids.data(), static_cast<std::int64_t>(ids.size())));
      }
      for (const std::int64_t id : ids)
      {
        moving.Now.Points[id] = { NAN, NAN };
      }
      moving.Expect();
    };
    remove([&](double, double) { return DrawIndex(random, 40) == 0; });
    remove([&](double x, double y) { return x * x + y * y < 0.01; });
    remove([&](double x, double y) { return std::fabs(x - 0.2) < 0.013 && std::fabs(y) < 0.49; });
    EXPECT_EQ(3, moving.InPlace);
    remove([&](double x, double y) { return x < -0.48 && std::fabs(y) < 0.4; }); // a side
    ASSERT_FALSE(HasFailure());
  }
}

/// After a stop, and after an error, all points are where they were.
TEST(Move, AnObserverMayStop)
{
  std::mt19937 random(9);
  const Places points = DrawPlaces(random, 3000), others = DrawPlaces(random, 3000);
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  const Triples expected = Normalize(StoreTriangles(session));
  for (int calls = 0; calls < 4; ++calls)
  {
    int left = calls;
    EXPECT_FALSE(session.Move({ View(others) }, [&](double) { return left-- > 0; }));
    EXPECT_EQ(expected, Normalize(StoreTriangles(session)));
    EXPECT_TRUE(session.GetReport().Converged());
  }
  EXPECT_TRUE(session.Move({ View(others) }));
  EXPECT_EQ(Normalize(Triangulate(others).Triangles), Normalize(StoreTriangles(session)));
  const Places few = { { 0.0, 0.0 } };
  EXPECT_THROW(session.Move({ View(few) }), InvalidOptions);
  const std::int64_t beyond = 3000;
  EXPECT_THROW(session.Remove(&beyond, 1), InvalidOptions);
  EXPECT_EQ(Normalize(Triangulate(others).Triangles), Normalize(StoreTriangles(session)));
}

TEST(Move, Floats)
{
  std::mt19937 random(10);
  std::vector<float> coordinates;
  Places points = DrawPlaces(random, 3000);
  for (const Place& point : points)
  {
    coordinates.insert(
      coordinates.end(), { static_cast<float>(point[0]), static_cast<float>(point[1]), 7.0F });
  }
  FlipSession session(PointInput{ PlaneArray(coordinates.data(), 3000, 3) }, PointOptions());
  session.Advance();
  for (int frame = 0; frame < 10; ++frame)
  {
    Shake(random, 1e-4, points);
    EXPECT_TRUE(session.Move({ View(points) })); // rounds the doubles to floats
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      coordinates[3 * i] = static_cast<float>(points[i][0]);
      coordinates[3 * i + 1] = static_cast<float>(points[i][1]);
    }
    const Triangulation expected =
      Triangulate(PointInput{ PlaneArray(coordinates.data(), 3000, 3) });
    ASSERT_EQ(Normalize(expected.Triangles), Normalize(StoreTriangles(session)));
    EXPECT_LT(0, session.GetReport().FromPoints.MoveRounds);
    EXPECT_TRUE(session.Move({ PlaneArray(coordinates.data(), 3000, 3) }));
    EXPECT_EQ(0, session.GetReport().TotalFlips);
  }
}

/// The fourth point goes through the boundary. The first three have a thin triangle, which is not
/// inverted if they go at the same pace. At unequal paces each round made steps that were half as
/// long as those of the one before.
TEST(Move, GoesThroughTheBoundaryBesideAThinTriangle)
{
  Places points{ { 0.993, 0.016 }, { 0.998, 0.609 }, { 0.997838783, 0.59 }, { 0.9923, 0.307 },
    { 0.0, 0.0 }, { 0.0, 1.0 }, { 0.98, 1.0 }, { 0.98, 0.0 }, { 0.5, 0.5 } };
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  const double xs[4] = { 0.997, 0.987, 0.982, 0.9925 };
  for (int i = 0; i < 4; ++i)
  {
    points[i][0] = xs[i];
  }
  EXPECT_TRUE(session.Move({ View(points) }));
  EXPECT_EQ(2, session.GetReport().FromPoints.MoveRounds);
  const Triangulation expected = Triangulate(PointInput{ View(points) });
  EXPECT_EQ(Normalize(expected.Triangles), Normalize(StoreTriangles(session)));
}

/// Places in the mesh are found after points have moved, and more points can be inserted.
TEST(Move, AsksAndGrows)
{
  std::mt19937 random(11);
  Places points = DrawPlaces(random, 2000);
  FlipSession session(PointInput{ View(points) }, PointOptions());
  session.Advance();
  for (int frame = 0; frame < 6; ++frame)
  {
    Places moved = points;
    Shake(random, 2e-4, moved);
    points = moved;
    EXPECT_TRUE(session.Move({ View(points) }));
    EXPECT_LT(0, session.GetReport().FromPoints.MoveRounds);
    Places more = DrawPlaces(random, 50);
    for (Place& place : more)
    {
      place = { 0.1 + 0.8 * place[0], 0.1 + 0.8 * place[1] };
    }
    std::vector<double> values, results(more.size());
    for (const Place& point : points)
    {
      values.push_back(point[0]);
    }
    PlaceQuery query;
    query.Places = View(more);
    query.Values = values.data();
    query.Results = results.data();
    query.Method = InterpolationKind::Natural;
    EXPECT_TRUE(session.Ask(query));
    for (std::size_t i = 0; i < more.size(); ++i)
    {
      EXPECT_NEAR(more[i][0], results[i], 1e-10);
    }
    EXPECT_TRUE(session.Insert(View(more)));
    points.insert(points.end(), more.begin(), more.end());
    ASSERT_EQ(Normalize(Triangulate(points).Triangles), Normalize(StoreTriangles(session)));
  }
}

#if !defined(DELAUNAYFLIP_REDUCED_TESTS) // sanitizers keep what is freed
/// The memory of this process, in pages. It is 0 where the system does not say.
std::int64_t MeasureMemory()
{
  std::ifstream file("/proc/self/statm");
  std::int64_t pages = 0, resident = 0;
  file >> pages >> resident;
  return resident;
}

/// Whether QEMU runs this program. Then the memory for translated code counts, too.
bool IsEmulated()
{
  std::ifstream file("/proc/self/comm");
  std::string name;
  file >> name;
  return name.rfind("qemu-", 0) == 0;
}

/// Frames take no more memory than the first ones: of points alone, some of which come and go, and
/// of points with segments.
TEST(Move, TakesNoMoreMemory)
{
  if (MeasureMemory() == 0 || IsEmulated())
  {
    GTEST_SKIP() << "the system does not say how much memory this process alone takes";
  }
  std::mt19937 random(12);
  const int frames = CountFrames(300);
  const int count = frames > 1000 ? 500 : 5000;
  const Places points = DrawPlaces(random, count);
  Drawing drawing = ToDrawing(points);
  drawing.AddRing({ { -1.0, -1.0 }, { 2.0, -1.0 }, { 0.5, 3.0 } });
  FlipSession session(PointInput{ View(points) }, PointOptions{ WithThreads(2) });
  FlipSession segmented(drawing.View(), PointOptions{ WithThreads(2) });
  session.Advance();
  segmented.Advance();
  std::int64_t before = 0;
  for (int frame = 0; frame < frames; ++frame)
  {
    Places next = drawing.Points;
    Shake(random, frame % 10 == 9 ? 0.1 : 0.0002, next);
    EXPECT_TRUE(segmented.Move({ View(next) }));
    next.resize(count);
    EXPECT_TRUE(session.Move({ View(next) }));
    const std::int64_t removed = frame % count;
    EXPECT_TRUE(session.Remove(&removed, 1));
    EXPECT_TRUE(session.Insert(View(Places{ { 0.5, 0.5 } })));
    EXPECT_TRUE(session.Compact());
    if (frame == 60)
    {
      before = MeasureMemory();
    }
  }
  EXPECT_GT(1.3 * static_cast<double>(before), static_cast<double>(MeasureMemory()));
}
#endif

}
}
