// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "TestBackend.h"
#include "ThreadBackend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

namespace delaunayflip
{
namespace
{

struct NamedMesh
{
  const char* Name;
  OwnedMesh<double> (*Make)();
  GeometryKind Geometry;
};

/// Large enough for several chunks, even where tests are reduced.
OwnedMesh<double> MakeLargePlane() { return MakeRandomBadMeshDouble(90000, 41); }

OwnedMesh<double> MakeTiltedPlane()
{
  const AffineMap map = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 2, -3, 0, 0 } } };
  return Transform(MakeRandomBadMeshDouble(50000 / Reduction, 42), map);
}

OwnedMesh<double> MakeSurface()
{
  return MakeBadSphere(300 / static_cast<int>(Reduction), 150 / static_cast<int>(Reduction), 43);
}

OwnedMesh<double> MakeStrip()
{
  return MakeMoebiusStrip(2000 / static_cast<int>(Reduction), 8, 44);
}

OwnedMesh<double> MakeDirtySurface() { return RepeatTriangles(MakeSurface()); }

class DeterminismTest : public testing::TestWithParam<NamedMesh>
{
protected:
  void SetUp() override
  {
    this->Mesh = GetParam().Make();
    this->Options.Geometry = GetParam().Geometry;
    this->Options.FeatureAngle = 180.0;
    this->Options.TrackQuality = true;
    this->Options.Backend = BackendKind::Threads;
    this->Options.NumberOfThreads = 1;
    this->Expected = Flip(this->Mesh.View(), this->Options);
    ASSERT_LT(0, this->Expected.Report.TotalFlips);
  }

  OwnedMesh<double> Mesh;
  FlipOptions Options;
  FlipResult Expected;
};

TEST_P(DeterminismTest, AnyNumberOfThreadsGivesTheSameBits)
{
  ExpectConsistentStatistics(this->Expected.Report);
  for (int threads : { 1, 2, 3, 4, 4, 16, 0 })
  {
    this->Options.NumberOfThreads = threads;
    ExpectSameResult(this->Expected, Flip(this->Mesh.View(), this->Options));
    ASSERT_FALSE(HasFailure()) << threads << " threads";
  }
}

TEST_P(DeterminismTest, MoreThreadsThanCanHelpAreReduced)
{
  this->Options.NumberOfThreads = std::numeric_limits<int>::max();
  const FlipResult result = Flip(this->Mesh.View(), this->Options);
  ExpectSameResult(this->Expected, result);
  if (!IsTestBackendCuda())
  {
    const int most = std::max(16, 2 * static_cast<int>(std::thread::hardware_concurrency()));
    EXPECT_LE(std::stoi(result.Report.Backend.substr(std::string("Threads: ").size())), most);
  }
}

TEST_P(DeterminismTest, RunsOfFewAndOfManyThreadsGoTogetherWithoutAWarning)
{
  testing::internal::CaptureStderr();
  this->Options.NumberOfThreads = 2;
  const FlipSession few = MakeSession(this->Mesh.View(), this->Options);
  this->Options.NumberOfThreads = 16;
  ExpectSameResult(this->Expected, Flip(this->Mesh.View(), this->Options));
  EXPECT_EQ("", testing::internal::GetCapturedStderr());
}

TEST_P(DeterminismTest, SingleStepsGiveTheSameBits)
{
  this->Options.NumberOfThreads = 3;
  FlipSession session = MakeSession(this->Mesh.View(), this->Options);
  std::size_t steps = 0;
  while (session.Advance(1))
  {
    ++steps;
    ASSERT_EQ(steps, session.GetReport().Iterations.size());
    ASSERT_EQ(StopReasonKind::Running, session.GetReport().StopReason);
  }
  ExpectSameResult(
    this->Expected, { StoreTriangles(session), StoreFlipCounts(session), session.GetReport() });
  EXPECT_FALSE(session.Advance());
  ExpectSameStatistics(this->Expected.Report, session.GetReport());
}

INSTANTIATE_TEST_SUITE_P(Meshes, DeterminismTest,
  testing::Values(NamedMesh{ "Plane", MakeLargePlane, GeometryKind::Auto },
    NamedMesh{ "TiltedPlane", MakeTiltedPlane, GeometryKind::Auto },
    NamedMesh{ "Terrain", MakeTiltedPlane, GeometryKind::PlanarXY },
    NamedMesh{ "PlaneAsSurface", MakeTiltedPlane, GeometryKind::Surface },
    NamedMesh{ "Sphere", MakeSurface, GeometryKind::Auto },
    NamedMesh{ "MoebiusStrip", MakeStrip, GeometryKind::Auto },
    NamedMesh{ "DirtySphere", MakeDirtySurface, GeometryKind::Auto }),
  GetCaseName);

TEST(ThreadBackend, TasksMayHaveTasksAndFail)
{
  const ThreadBackend backend(4);
  for (int round = 0; round < 200; ++round)
  {
    std::atomic<int> calls{ 0 };
    backend.ForTasks(8, [&](std::int64_t) { backend.ForTasks(8, [&](std::int64_t) { ++calls; }); });
    ASSERT_EQ(64, calls);
    ASSERT_THROW(backend.ForTasks(8,
                   [&](std::int64_t task)
                   {
                     if (task == 5)
                     {
                       throw std::runtime_error("of a task");
                     }
                   }),
      std::runtime_error);
  }
}

}
}
