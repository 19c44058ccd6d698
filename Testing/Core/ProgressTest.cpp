// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "TestBackend.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace delaunayflip
{
namespace
{

std::vector<std::int32_t> Store(const FlipSession& session)
{
  std::vector<std::int32_t> triangles(3 * session.GetReport().Triangles);
  session.StoreTriangles(MutableTriangleArray(triangles.data(), session.GetReport().Triangles));
  return triangles;
}

/// Records what it is told, and ends the run at a given call.
class Watcher
{
public:
  explicit Watcher(std::size_t lastCall = SIZE_MAX)
    : LastCall(lastCall)
  {
  }

  ProgressObserver GetObserver()
  {
    return [this](double fraction)
    {
      EXPECT_EQ(this->Caller, std::this_thread::get_id());
      EXPECT_LE(this->Told.empty() ? 0.0 : this->Told.back(), fraction);
      EXPECT_LE(fraction, 1.0);
      this->Told.push_back(fraction);
      return this->Told.size() < this->LastCall;
    };
  }

  std::vector<double> Told;

private:
  std::size_t LastCall;
  std::thread::id Caller = std::this_thread::get_id();
};

struct NamedMesh
{
  const char* Name;
  OwnedMesh<double> (*Make)();
};

void PrintTo(const NamedMesh& mesh, std::ostream* stream) { *stream << mesh.Name; }

OwnedMesh<double> MakeSmallPlane() { return MakeRandomBadMeshDouble(2000, 61); }
/// Large enough for chunks.
OwnedMesh<double> MakeLargePlane() { return MakeRandomBadMeshDouble(40000, 62); }
OwnedMesh<double> MakeSurface() { return MakeBadSphere(80, 40, 63); }

class ProgressTest : public testing::TestWithParam<NamedMesh>
{
protected:
  void SetUp() override
  {
    this->Mesh = GetParam().Make();
    this->Options = OnTestBackend({});
    this->Options.FeatureAngle = 180.0;
  }

  /// Runs to the end, or until `watcher` ends it.
  FlipSession Run(Watcher& watcher) const
  {
    FlipSession session(this->Mesh.View(), this->Options, watcher.GetObserver());
    if (session.GetReport().StopReason != StopReasonKind::Aborted)
    {
      session.Advance(-1, {}, watcher.GetObserver());
    }
    return session;
  }

  FlipResult FlipTo(std::int64_t iterations) const
  {
    FlipOptions options = this->Options;
    options.MaximumIterations = iterations;
    return Flip(this->Mesh.View(), options);
  }

  OwnedMesh<double> Mesh;
  FlipOptions Options;
};

TEST_P(ProgressTest, IsToldFromTheBuildToTheEnd)
{
  Watcher watcher;
  FlipSession session(this->Mesh.View(), this->Options, watcher.GetObserver());
  const std::size_t inBuild = watcher.Told.size();
  EXPECT_LE(5u, inBuild);
  EXPECT_LT(0.4, watcher.Told.back());
  EXPECT_GT(0.7, watcher.Told.back());
  EXPECT_EQ(StopReasonKind::NotStarted, session.GetReport().StopReason);
  session.Advance(-1, {}, watcher.GetObserver());
  EXPECT_TRUE(session.GetReport().Converged());
  EXPECT_EQ(1.0, watcher.Told.back());
  ASSERT_LE(2u, watcher.Told.size());
  EXPECT_GT(1.0, watcher.Told[watcher.Told.size() - 2]);
  EXPECT_TRUE(IsTestBackendCuda() || watcher.Told.size() > inBuild + 2);
}

TEST_P(ProgressTest, ChangesNothing)
{
  Watcher watcher;
  const FlipSession session = this->Run(watcher);
  const FlipResult unwatched = Flip(this->Mesh.View(), this->Options);
  EXPECT_TRUE(unwatched.Triangles == Store(session));
  ExpectSameStatistics(unwatched.Report, session.GetReport());
}

/// After an abort the mesh is that of a run with the same number of iterations.
TEST_P(ProgressTest, EndsTheRunAtAnyCall)
{
  Watcher whole;
  this->Run(whole);
  bool endedBeforeFlips = false;
  for (std::size_t call = 1; call < whole.Told.size(); ++call)
  {
    Watcher watcher(call);
    const FlipSession session = this->Run(watcher);
    const FlipReport& report = session.GetReport();
    if (report.Converged())
    {
      continue; // in fewer, longer batches than before
    }
    ASSERT_EQ(StopReasonKind::Aborted, report.StopReason) << call;
    ASSERT_EQ(call, watcher.Told.size());
    endedBeforeFlips = endedBeforeFlips || report.Iterations.empty();
    const FlipResult cut = this->FlipTo(static_cast<std::int64_t>(report.Iterations.size()));
    ASSERT_TRUE(cut.Triangles == Store(session)) << call;
    ASSERT_TRUE(!report.Iterations.empty() || cut.Triangles == this->Mesh.Triangles);
    EXPECT_EQ(cut.Report.TotalFlips, report.TotalFlips);
  }
  EXPECT_TRUE(endedBeforeFlips);
}

TEST_P(ProgressTest, LetsTheRunContinue)
{
  const FlipResult unwatched = Flip(this->Mesh.View(), this->Options);
  for (std::size_t call : { 1, 4, 12 })
  {
    Watcher watcher(call);
    FlipSession session = this->Run(watcher);
    Watcher second(1);
    session.Advance(-1, {}, second.GetObserver());
    EXPECT_EQ(1u, second.Told.size());
    session.Advance();
    EXPECT_TRUE(session.GetReport().Converged());
    EXPECT_TRUE(unwatched.Triangles == Store(session)) << call;
    EXPECT_EQ(unwatched.Report.Iterations.size(), session.GetReport().Iterations.size());
    EXPECT_EQ(unwatched.Report.TotalFlips, session.GetReport().TotalFlips);
  }
}

TEST_P(ProgressTest, SaysWhatIsKnownAfterAnAbortOfTheBuild)
{
  Watcher watcher(2);
  const FlipSession session(this->Mesh.View(), this->Options, watcher.GetObserver());
  const FlipReport& report = session.GetReport();
  EXPECT_EQ(StopReasonKind::Aborted, report.StopReason);
  EXPECT_EQ(this->Mesh.NumberOfPoints(), report.Points);
  EXPECT_EQ(this->Mesh.NumberOfTriangles(), report.Triangles);
  EXPECT_TRUE(report.Iterations.empty());
  std::vector<std::int32_t> counts(static_cast<std::size_t>(report.Triangles), 7);
  session.StoreFlipCounts(counts.data());
  EXPECT_EQ(std::vector<std::int32_t>(counts.size(), 0), counts);
}

TEST_P(ProgressTest, ExceptionsOfTheObserverPass)
{
  const auto throwing = [](double) -> bool { throw std::logic_error("from the observer"); };
  EXPECT_THROW(FlipSession(this->Mesh.View(), this->Options, throwing), std::logic_error);
  Watcher watcher(1);
  FlipSession session(this->Mesh.View(), this->Options, watcher.GetObserver());
  EXPECT_THROW(session.Advance(-1, {}, throwing), std::logic_error);
  EXPECT_TRUE(this->Mesh.Triangles == Store(session));
  session.Advance();
  EXPECT_TRUE(session.GetReport().Converged());
}

INSTANTIATE_TEST_SUITE_P(Meshes, ProgressTest,
  testing::Values(NamedMesh{ "SmallPlane", MakeSmallPlane },
    NamedMesh{ "LargePlane", MakeLargePlane }, NamedMesh{ "Surface", MakeSurface }),
  [](const auto& test) { return std::string(test.param.Name); });

TEST(ProgressOfAllInOne, IsToldAndEndsTheRun)
{
  const OwnedMesh<double> mesh = MakeSmallPlane();
  std::vector<std::int32_t> triangles(mesh.Triangles.size());
  const MutableTriangleArray target(triangles.data(), mesh.NumberOfTriangles());
  Watcher all;
  FlipReport report = FlipToDelaunay(mesh.View(), OnTestBackend({}), target, {}, all.GetObserver());
  EXPECT_TRUE(report.Converged());
  EXPECT_EQ(1.0, all.Told.back());
  EXPECT_FALSE(mesh.Triangles == triangles);

  Watcher first(1);
  report = FlipToDelaunay(mesh.View(), OnTestBackend({}), target, {}, first.GetObserver());
  EXPECT_EQ(StopReasonKind::Aborted, report.StopReason);
  EXPECT_EQ(1u, first.Told.size());
  EXPECT_TRUE(mesh.Triangles == triangles);
}

/// Invalid options are an error even if the observer would stop the run at once.
TEST(ProgressOfAllInOne, ComesAfterTheChecks)
{
  OwnedMesh<double> mesh = MakeSmallPlane();
  mesh.Triangles[30] = 1000000;
  Watcher watcher(1);
  EXPECT_THROW(FlipSession(mesh.View(), OnTestBackend({}), watcher.GetObserver()), InvalidMesh);
  EXPECT_TRUE(watcher.Told.empty());
}

/// With an iteration limit n, progress after iteration n - 1 is at least (n - 1) / n of the loop's.
TEST(ProgressOfAllInOne, FollowsTheIterationLimit)
{
  const OwnedMesh<double> mesh = MakeWorstCaseMesh(300);
  FlipOptions options;
  options.Backend = BackendKind::Threads;
  options.MaximumIterations = 10;
  Watcher watcher;
  FlipSession session(mesh.View(), options, watcher.GetObserver());
  const double begin = watcher.Told.back();
  session.Advance(-1, {}, watcher.GetObserver());
  EXPECT_EQ(StopReasonKind::IterationLimit, session.GetReport().StopReason);
  ASSERT_LE(2u, watcher.Told.size());
  EXPECT_LE(begin + 0.9 * (1.0 - begin), watcher.Told[watcher.Told.size() - 2] + 1e-12);
  EXPECT_EQ(1.0, watcher.Told.back());
}

}
}
