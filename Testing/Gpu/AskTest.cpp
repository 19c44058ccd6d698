// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "GpuTestSupport.h"
#include "PointSets.h"
#include "PointTestSupport.h"
#include "TestDevice.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

/// @file
/// Queries about places and points that come later, on a GPU, with the bits of the CPU.

namespace delaunayflip
{
namespace
{

constexpr int Components = 2;

struct Answers
{
  std::vector<std::int32_t> Triangles;
  std::vector<double> Results;

  explicit Answers(std::int64_t count)
    : Triangles(count, -2),
      Results(Components * count, -1.0)
  {
  }

  void ExpectEqual(const Answers& other) const
  {
    EXPECT_EQ(this->Triangles, other.Triangles);
    EXPECT_EQ(
      0, std::memcmp(this->Results.data(), other.Results.data(), sizeof(double) * Results.size()));
  }
};

/// A triangulation on each backend, and queries of all kinds about it.
class TwoSessions
{
public:
  explicit TwoSessions(const Drawing& drawing)
    : Threads(Make(drawing, BackendKind::Threads)),
      Gpu(Make(drawing, BackendKind::CUDA))
  {
    EXPECT_TRUE(IsOnGpu(this->Gpu.GetReport())) << this->Gpu.GetReport().Backend;
    Places points = drawing.Points;
    for (const AddedPoint& point : this->Threads.GetAddedPoints())
    {
      points.push_back({ point.X, point.Y });
    }
    for (const Place& point : points)
    {
      this->Values.push_back(std::sin(point[0]) + point[1]);
      this->Values.push_back(point[0] * point[1]);
    }
  }

  /// @param query its places.
  void ExpectAgreement(PlaceQuery query) const
  {
    for (const InterpolationKind method : { InterpolationKind::Linear, InterpolationKind::Natural })
    {
      for (const OutsideKind outside : { OutsideKind::NotANumber, OutsideKind::Nearest })
      {
        query.Method = method;
        query.Outside = outside;
        const Answers expected = this->Ask(this->Threads, query);
        this->Ask(this->Gpu, query).ExpectEqual(expected);
        this->AskOnDevice(this->Gpu, query).ExpectEqual(expected);
      }
    }
    EXPECT_TRUE(IsOnGpu(this->Gpu.GetReport())) << this->Gpu.GetReport().Backend;
  }

  /// A session on threads copies arrays that are on a GPU.
  void ExpectThreadsTakeDeviceArrays(const PlaceQuery& query) const
  {
    this->AskOnDevice(this->Threads, query).ExpectEqual(this->Ask(this->Threads, query));
  }

private:
  static FlipSession Make(const Drawing& drawing, BackendKind backend)
  {
    PointOptions options;
    static_cast<FlipOptions&>(options) = OnBackend(backend);
    FlipSession session(drawing.View(), options);
    session.Advance();
    return session;
  }

  Answers Ask(const FlipSession& session, PlaceQuery query) const
  {
    Answers answers(query.CountPlaces());
    query.Values = this->Values.data();
    query.Components = Components;
    query.Results = answers.Results.data();
    query.Triangles = answers.Triangles.data();
    EXPECT_TRUE(session.Ask(query));
    return answers;
  }

  Answers AskOnDevice(const FlipSession& session, PlaceQuery query) const
  {
    Answers answers(query.CountPlaces());
    const DeviceValues<double> values(this->Values);
    const DeviceValues<double> results(answers.Results);
    const DeviceValues<std::int32_t> triangles(answers.Triangles);
    std::vector<double> coordinates;
    for (std::int64_t i = 0; i < query.Places.Count; ++i)
    {
      coordinates.push_back(query.Places.Get(i, 0));
      coordinates.push_back(query.Places.Get(i, 1));
    }
    const DeviceValues<double> places(coordinates);
    query.Places = PlaneArray(places.Data(), query.Places.Count, 2);
    query.Values = values.Data();
    query.Components = Components;
    query.Results = results.Data();
    query.Triangles = triangles.Data();
    query.OnDevice = true;
    EXPECT_TRUE(session.Ask(query));
    answers.Results = results.Get();
    answers.Triangles = triangles.Get();
    return answers;
  }

  FlipSession Threads, Gpu;
  std::vector<double> Values;
};

/// In the box of points and beside it, at points, and where no place is.
Places DrawPlaces(const Places& points, std::size_t count)
{
  std::mt19937 random(5);
  // The last two need more bits than a GPU has.
  Places places = { { NAN, 0.0 }, { INFINITY, 1.0 }, { 1e300, -1e300 }, { 1e-300, 0.5 },
    { 0.25, 3e-310 } };
  while (places.size() < count)
  {
    const Place& a = points[DrawIndex(random, points.size())];
    const Place& b = points[DrawIndex(random, points.size())];
    const double share = DrawIndex(random, 1025) / 1024.0;
    places.push_back(a);
    places.push_back({ a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]) });
    places.push_back({ a[0], b[1] });
  }
  return places;
}

void ExpectAgreement(std::size_t points, std::size_t places)
{
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    Drawing drawing;
    drawing.Points = MakePlaces(set, static_cast<std::int64_t>(points));
    const TwoSessions sessions(drawing);
    const Places asked = DrawPlaces(drawing.Points, places);
    PlaceQuery query;
    query.Places = View(asked);
    sessions.ExpectAgreement(query);
    query.Raster.Columns = 37;
    query.Raster.Rows = 29;
    query.Raster.Step[0] = 0.03;
    query.Raster.Step[1] = -0.04;
    query.Raster.Origin[1] = 1.0;
    sessions.ExpectAgreement(query);
  }
}

class AskTest : public GpuTest
{
};

TEST_F(AskTest, TheGpuGivesTheCpusAnswers) { ExpectAgreement(3000, 50000); }

/// Inserts the last fifth of points, in batches, on both backends.
void ExpectInsertionAgrees(const Places& points)
{
  const auto all = SizeOf(points);
  const std::int64_t start = all - all / 5;
  const std::int64_t batch =
    std::min<std::int64_t>(all / 25 + 1, 500); // so few are inserted in place
  const auto run = [&](BackendKind backend)
  {
    PointOptions options;
    static_cast<FlipOptions&>(options) = OnBackend(backend);
    FlipSession session(PointInput{ PlaneArray(points.front().data(), start, 2) }, options);
    session.Advance();
    for (std::int64_t first = start; first < all; first += batch)
    {
      const std::int64_t count = std::min(batch, all - first);
      EXPECT_TRUE(session.Insert(PlaneArray(points[first].data(), count, 2)));
    }
    return session;
  };
  const FlipSession expected = run(BackendKind::Threads);
  const FlipSession actual = run(BackendKind::CUDA);
  EXPECT_TRUE(IsOnGpu(actual.GetReport())) << actual.GetReport().Backend;
  EXPECT_EQ(StoreTriangles(expected), StoreTriangles(actual));
  EXPECT_EQ(expected.GetReport().FromPoints.Repeated, actual.GetReport().FromPoints.Repeated);
  EXPECT_EQ(expected.GetReport().MinimumAngleAfter, actual.GetReport().MinimumAngleAfter);
}

/// With corners around all, so that points are inserted in place.
void ExpectInsertionAgrees(std::int64_t count)
{
  for (const PointSet& set : ListPointSets())
  {
    SCOPED_TRACE(set.Name);
    Places points = { { -1e5, -1e5 }, { 1e7, -1e5 }, { 1e7, 1e7 }, { -1e5, 1e7 } };
    const Places more = MakePlaces(set, count);
    points.insert(points.end(), more.begin(), more.end());
    ExpectInsertionAgrees(points);
  }
}

TEST_F(AskTest, PointsThatComeLaterAreInsertedAlike) { ExpectInsertionAgrees(20000); }

/// Expects that sessions on threads and on a GPU have the same triangles.
void ExpectSameSessions(const std::vector<FlipSession>& sessions)
{
  const FlipReport& expected = sessions[0].GetReport();
  const FlipReport& actual = sessions[1].GetReport();
  EXPECT_EQ(expected.FromPoints.MoveRounds, actual.FromPoints.MoveRounds);
  EXPECT_EQ(expected.TotalFlips, actual.TotalFlips);
  EXPECT_EQ(expected.MinimumAngleAfter, actual.MinimumAngleAfter);
  EXPECT_TRUE(IsOnGpu(actual)) << actual.Backend;
  EXPECT_EQ(StoreTriangles(sessions[0]), StoreTriangles(sessions[1]));
  EXPECT_EQ(StoreOrderedTriangles(sessions[0]), StoreOrderedTriangles(sessions[1]));
}

void ExpectSameMove(std::vector<FlipSession>& sessions, const Places& points)
{
  for (FlipSession& session : sessions)
  {
    EXPECT_TRUE(session.Move({ PlaneArray(points.front().data(), SizeOf(points), 2) }));
  }
  ExpectSameSessions(sessions);
}

/// Points are moved and removed in place on both backends, with the same bits. The boundary
/// changes, too.
void ExpectLifeAgrees(std::size_t count)
{
  std::mt19937 random(7);
  Places points;
  while (points.size() < count)
  {
    points.push_back({ static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 20),
      static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 20) });
  }
  std::vector<FlipSession> sessions;
  for (const BackendKind backend : { BackendKind::Threads, BackendKind::CUDA })
  {
    PointOptions options;
    static_cast<FlipOptions&>(options) = OnBackend(backend);
    sessions.emplace_back(
      PointInput{ PlaneArray(points.front().data(), SizeOf(points), 2) }, options);
    sessions.back().Advance();
  }
  Places moved = points;
  for (const double share : { 0.01, 0.03, 0.05, 1.0, 0.01 })
  {
    for (double *end = moved.back().data() + 2, *x = moved.front().data(); x < end; ++x)
    {
      const double way = static_cast<double>(DrawIndex(random, 2001)) / 1000.0 - 1.0;
      *x += share * way / std::sqrt(static_cast<double>(count));
    }
    ExpectSameMove(sessions, moved);
    const bool isInPlace = sessions[0].GetReport().FromPoints.MoveRounds > 0;
    EXPECT_TRUE(isInPlace == (share < 0.5) || count < 1000); // small ones move in place more often
  }
  Places strange = moved;
  for (const double coordinate : { double(NAN), double(INFINITY), 1e-40, moved[count / 2][0] })
  {
    SCOPED_TRACE(coordinate);
    strange[count / 2][0] = coordinate;
    ExpectSameMove(sessions, strange);
  }
  const auto remove = [&](const std::vector<std::int64_t>& ids)
  {
    for (FlipSession& session : sessions)
    {
      EXPECT_TRUE(session.Remove(ids.data(), SizeOf(ids)));
    }
    EXPECT_LT(0, sessions[0].GetReport().FromPoints.MoveRounds);
    ExpectSameSessions(sessions);
  };
  std::vector<std::int64_t> scattered, clustered;
  for (std::size_t i = 0; i < count / 40; ++i)
  {
    scattered.push_back(static_cast<std::int64_t>(DrawIndex(random, count)));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    if (std::hypot(moved[i][0] - 0.5, moved[i][1] - 0.5) < 0.09)
    {
      clustered.push_back(static_cast<std::int64_t>(i));
    }
  }
  remove(scattered);
  remove(clustered);
  Places back;
  for (std::size_t i = 0; i < clustered.size(); i += 2)
  {
    back.push_back(moved[clustered[i]]);
  }
  for (FlipSession& session : sessions)
  {
    EXPECT_TRUE(session.Insert(View(back)));
  }
  ExpectSameSessions(sessions);
}

/// Points come between segments, where triangles are removed.
void ExpectInsertionBetweenSegmentsAgrees(int count)
{
  std::mt19937 random(8);
  const auto draw = [&] { return static_cast<double>(DrawIndex(random, 1 << 20)) / (1 << 20); };
  Drawing drawing;
  for (int i = 0; i < count; ++i)
  {
    drawing.Points.push_back({ draw(), draw() });
  }
  drawing.AddRing({ { 0.05, 0.05 }, { 0.95, 0.1 }, { 0.9, 0.9 }, { 0.1, 0.95 } });
  drawing.FirstHole = 1;
  drawing.AddRing({ { 0.4, 0.4 }, { 0.6, 0.4 }, { 0.5, 0.7 } });
  std::vector<FlipSession> sessions;
  for (const BackendKind backend : { BackendKind::Threads, BackendKind::CUDA })
  {
    PointOptions options;
    static_cast<FlipOptions&>(options) = OnBackend(backend);
    sessions.emplace_back(drawing.View(), options);
    sessions.back().Advance();
  }
  for (int batch = 0; batch < 3; ++batch)
  {
    Places more;
    for (int i = 0; i < count / 40; ++i)
    {
      more.push_back({ 0.2 + 0.15 * draw(), 0.2 + 0.5 * draw() });
    }
    for (FlipSession& session : sessions)
    {
      EXPECT_TRUE(session.Insert(View(more)));
    }
    EXPECT_TRUE(IsOnGpu(sessions[1].GetReport()));
    EXPECT_EQ(StoreTriangles(sessions[0]), StoreTriangles(sessions[1]));
    EXPECT_EQ(sessions[0].ListSegmentEdges(), sessions[1].ListSegmentEdges());
  }
}

TEST_F(AskTest, PointsComeBetweenSegmentsAlike) { ExpectInsertionBetweenSegmentsAgrees(50000); }

TEST_F(AskTest, PointsMoveAndGoAlike)
{
  ExpectLifeAgrees(3000);
  ExpectLifeAgrees(100000);
}

TEST_F(AskTest, WithSegmentsAndRemovedTriangles)
{
  std::mt19937 random(6);
  Drawing drawing;
  for (int i = 0; i < 2000; ++i)
  {
    drawing.Points.push_back(
      { DrawIndex(random, 1000) / 1000.0, DrawIndex(random, 1000) / 1000.0 });
  }
  drawing.AddRing({ { 0.05, 0.05 }, { 0.95, 0.1 }, { 0.9, 0.9 }, { 0.1, 0.95 } });
  drawing.FirstHole = 1;
  drawing.AddRing({ { 0.4, 0.4 }, { 0.6, 0.4 }, { 0.5, 0.7 } });
  const TwoSessions sessions(drawing);
  const Places asked = DrawPlaces(drawing.Points, 100000);
  PlaceQuery query;
  query.Places = View(asked);
  sessions.ExpectAgreement(query);
  sessions.ExpectThreadsTakeDeviceArrays(query);
}

/// run.sh runs these under compute-sanitizer.
class SmallAskTest : public GpuTest
{
};

TEST_F(SmallAskTest, EveryKindOfQuery) { ExpectAgreement(60, 300); }

TEST_F(SmallAskTest, PointsThatComeLater) { ExpectInsertionAgrees(100); }

TEST_F(SmallAskTest, PointsThatMoveAndGo) { ExpectLifeAgrees(300); }

TEST_F(SmallAskTest, PointsBetweenSegments) { ExpectInsertionBetweenSegmentsAgrees(300); }

}
}
