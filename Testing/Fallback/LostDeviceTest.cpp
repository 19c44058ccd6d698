// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FakeDevice.h"
#include "FlipError.h"
#include "FlipTestSupport.h"
#include "Interpolation.h"
#include "RandomNumbers.h"
#include "TestDevice.h"
#include "delaunayflip_c.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

/// @file
/// What a session promises its caller where a GPU fails or an observer stops a run on it.

namespace delaunayflip
{
namespace
{

class LostDeviceTest : public testing::Test
{
protected:
  /// So many that BackendKind::Auto takes a GPU.
  static constexpr std::int64_t Many = 11000;

  ~LostDeviceTest() override
  {
    CallsToFailure = 0;
    IsDeviceLost = false;
  }

  static std::vector<double> MakeSpiral()
  {
    std::vector<double> xy;
    for (int i = 0; i < Many; ++i)
    {
      xy.insert(xy.end(), { std::cos(2.4 * i) * std::sqrt(i), std::sin(2.4 * i) * std::sqrt(i) });
    }
    return xy;
  }

  /// Points on a sphere.
  static std::vector<double> DrawSphere()
  {
    std::mt19937 random(7);
    std::vector<double> points(3 * Many);
    for (std::int64_t i = 0; i < Many; ++i)
    {
      PlaceOnSphere(
        DrawReal(random, -180.0, 180.0), DrawReal(random, -90.0, 90.0), points.data() + 3 * i);
    }
    return points;
  }

  static FlipSession OpenSphere(const std::vector<double>& points, BackendKind backend)
  {
    PointInput input;
    input.Points = PlaneArray(points.data(), Many, 3);
    PointOptions options{ OnBackend(backend) };
    options.Projection = ProjectionKind::Sphere;
    return FlipSession(input, options);
  }
};

/// Threads cannot read the memory of a device.
TEST_F(LostDeviceTest, TheHostAnswersFromCopies)
{
  const std::vector<double> xy = MakeSpiral();
  const DeviceValues<double> places(xy);
  const DeviceValues<std::int32_t> triangles(std::vector<std::int32_t>(Many, 77));
  PlaceQuery query;
  query.Places = PlaneArray(places.Data(), Many, 2);
  query.Triangles = triangles.Data();
  query.OnDevice = true;
  for (const bool isStopped : { false, true })
  {
    CallsToFailure = 1000000;
    FlipSession session(PointInput{ PlaneArray(xy.data(), Many, 2) },
      PointOptions{ OnBackend(BackendKind::Auto) },
      [&](double) { return !isStopped || CallsToFailure > 0; });
    session.Advance();
    const auto countCopied = [&]
    {
      const std::int64_t before = CopiedBytes;
      EXPECT_TRUE(session.Ask(query));
      return CopiedBytes - before;
    };
    EXPECT_EQ(0, countCopied());
    const std::vector<std::int32_t> expected = triangles.Get();
    EXPECT_LE(0, *std::min_element(expected.begin(), expected.end()));
    triangles.Set(std::vector<std::int32_t>(Many, 77));
    CallsToFailure = 1;
    EXPECT_EQ(Many * 20, countCopied()) << "of the places, and of the numbers of triangles";
    EXPECT_EQ(0, CallsToFailure);
    const std::vector<std::int32_t> outside(Many, -1);
    EXPECT_TRUE((isStopped ? outside : expected) == triangles.Get());
  }
}

/// Refinement that has begun is part of what the CPU repeats, also if it adds no point, because all
/// triangles are good or there may be no more points.
TEST_F(LostDeviceTest, RefinementMayAddNothing)
{
  const std::vector<double> xy = MakeSpiral();
  for (const double area : { 1e9, 1e-3 })
  {
    const auto run = [&](BackendKind backend, int call)
    {
      CallsToFailure = call;
      PointOptions options{ OnBackend(backend) };
      options.MaximumArea = area;
      options.KeepBoundary = true;
      options.PointLimit = Many;
      FlipSession session(PointInput{ PlaneArray(xy.data(), Many, 2) }, options);
      session.Advance();
      const PointCounts& counts = session.GetReport().FromPoints;
      EXPECT_EQ(0, counts.RefinementPoints);
      EXPECT_EQ(area<1.0, counts.UnrefinedTriangles> 0);
      EXPECT_EQ(area<1.0, counts.ReachedPointLimit> 0);
      return session;
    };
    const FlipSession expected = run(BackendKind::Threads, 0);
    ForEachFailingCall(8, run,
      [&](const FlipSession& session)
      {
        ASSERT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
        ExpectSameStatistics(expected.GetReport(), session.GetReport());
      });
  }
}

/// The caller may free the memory as soon as Advance has returned.
TEST_F(LostDeviceTest, NoPageIsTouchedAfterAStop)
{
  constexpr std::int64_t Page = 4096, Pages = 1000, Bytes = Page * Pages + 1, Often = 10000;
  const OwnedMesh<double> mesh = MakeRandomBadMeshDouble(1000, 35);
  std::vector<char> memory(Bytes), last(Bytes, 'x');
  const ProgressObserver stop = [](double) { return false; };
  FlipSession session(mesh.View(), OnBackend(BackendKind::CUDA), stop);
  for (std::int64_t i = 0; i < Often; ++i)
  {
    session.Expect(memory.data(), Bytes);
  }
  session.Expect(last.data(), Bytes);
  EXPECT_FALSE(session.Advance(-1, {}, stop));
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(Pages + 1, std::count(last.begin(), last.end(), 0));
}

TEST_F(LostDeviceTest, ASphereIsMadeAgainOnTheHost)
{
  const std::vector<double> points = DrawSphere();
  FlipSession expected = OpenSphere(points, BackendKind::Threads);
  expected.Advance();
  FlipSession session = OpenSphere(points, BackendKind::Auto);
  session.Advance();
  EXPECT_EQ("CUDA: fake", session.GetReport().Backend);
  IsDeviceLost = true;
  EXPECT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
  ExpectSameStatistics(expected.GetReport(), session.GetReport());
  EXPECT_EQ(std::string::npos, session.GetReport().Backend.find("CUDA"));
  EXPECT_EQ("as the test wants it", session.GetReport().Fallback);
}

/// If nothing may replace the GPU, the session begins anew.
TEST_F(LostDeviceTest, ASphereIsForgotten)
{
  const std::vector<double> points = DrawSphere();
  FlipSession session = OpenSphere(points, BackendKind::CUDA);
  session.Advance();
  const std::int64_t count = session.CountTriangles();
  std::vector<std::int32_t> ids(3 * count);
  const MutableTriangleArray triangles(ids.data(), count);
  IsDeviceLost = true;
  EXPECT_THROW(session.StoreTriangles(triangles), BackendUnavailable);
  EXPECT_EQ(0, session.CountTriangles());
  IsDeviceLost = false;
  session.Advance();
  EXPECT_EQ(count, session.CountTriangles());
  session.StoreTriangles(triangles);
  FlipSession expected = OpenSphere(points, BackendKind::Threads);
  expected.Advance();
  EXPECT_TRUE(StoreTriangles(expected) == ids);
}

/// The functions of a C program need not live longer than the call.
TEST_F(LostDeviceTest, CallbacksAreCalledDuringTheirCallAlone)
{
  const std::vector<double> xy = MakeSpiral();
  delaunayflip_points points;
  delaunayflip_points_init(&points);
  points.points = xy.data();
  points.number_of_points = Many;
  int calls = 0;
  delaunayflip_callbacks callbacks;
  delaunayflip_callbacks_init(&callbacks);
  callbacks.progress = [](double, void* user) { return ++*static_cast<int*>(user); };
  callbacks.user = &calls;
  delaunayflip_session* session = nullptr;
  ASSERT_EQ(DELAUNAYFLIP_OK, delaunayflip_open_points(&points, nullptr, &callbacks, &session));
  EXPECT_LT(0, calls);
  ASSERT_EQ(DELAUNAYFLIP_OK, delaunayflip_advance(session, -1, nullptr, nullptr));
  calls = 0;
  IsDeviceLost = true;
  std::vector<std::int32_t> triangles(6 * Many);
  delaunayflip_report report;
  delaunayflip_report_init(&report);
  EXPECT_EQ(
    DELAUNAYFLIP_OK, delaunayflip_store_triangles(session, triangles.data(), DELAUNAYFLIP_INT32));
  EXPECT_EQ(DELAUNAYFLIP_OK, delaunayflip_get_report(session, &report));
  EXPECT_STREQ("as the test wants it", report.fallback);
  EXPECT_EQ(0, calls);
  delaunayflip_close(session);
}

}
}
