// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "TestBackend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

/// @file
/// Observers of iterations and of progress: what they see, and how they end a run.

namespace delaunayflip
{
namespace
{

class ObserverTest : public testing::Test
{
protected:
  void SetUp() override { this->Complete = Flip(this->Mesh.View()); }

  /// Checks that the session's mesh is valid and that its report is that of this mesh.
  void ExpectValid(const FlipSession& session) const
  {
    const std::vector<std::int32_t> triangles = StoreTriangles(session);
    const TriangleMesh mesh = WithTriangles(this->Mesh.View(), triangles);
    const FlipReport& report = session.GetReport();
    ExpectSameTopology(this->Mesh.View().Triangles, triangles, report);
    ExpectConsistentStatistics(report);
    EXPECT_EQ(CountNonDelaunayEdges(mesh, FlipOptions()), report.NonDelaunayAfter);
    EXPECT_NEAR(MinimumAngle(mesh, GeometryKind::Planar), report.MinimumAngleAfter, 1e-9);
  }

  void ExpectCompletion(FlipSession& session) const
  {
    this->ExpectValid(session);
    EXPECT_FALSE(session.Advance(std::numeric_limits<std::int64_t>::max()));
    EXPECT_TRUE(session.GetReport().Converged());
    EXPECT_TRUE(this->Complete.Triangles == StoreTriangles(session));
  }

  OwnedMesh<double> Mesh = MakeRandomBadMeshDouble(5000, 51);
  FlipResult Complete;
};

TEST_F(ObserverTest, SeesEveryIterationOnTheCallingThread)
{
  std::vector<IterationRecord> seen;
  const std::thread::id caller = std::this_thread::get_id();
  FlipSession session = MakeSession(this->Mesh.View());
  session.Advance(-1,
    [&](const IterationRecord& record)
    {
      EXPECT_EQ(caller, std::this_thread::get_id());
      seen.push_back(record);
      return true;
    });
  const std::vector<IterationRecord>& rows = session.GetReport().Iterations;
  ASSERT_EQ(rows.size(), seen.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    EXPECT_EQ(rows[i].Iteration, seen[i].Iteration);
    EXPECT_EQ(rows[i].Flipped, seen[i].Flipped);
    EXPECT_EQ(rows[i].NonDelaunay, seen[i].NonDelaunay);
  }
  EXPECT_EQ(this->Complete.Report.Iterations.size(), seen.size());
}

TEST_F(ObserverTest, MayAbortAndTheRunCanContinue)
{
  if (IsTestBackendCuda())
  {
    GTEST_SKIP() << "the GPU aborts at the end of a batch of iterations: BatchTest";
  }
  FlipSession session = MakeSession(this->Mesh.View());
  session.Advance(-1, [](const IterationRecord& record) { return record.Iteration < 3; });
  EXPECT_EQ(StopReasonKind::Aborted, session.GetReport().StopReason);
  EXPECT_EQ(3u, session.GetReport().Iterations.size());
  EXPECT_LT(0, session.GetReport().NonDelaunayAfter);
  this->ExpectCompletion(session);

  std::vector<std::int32_t> triangles(this->Mesh.Triangles.size());
  const FlipReport report = FlipToDelaunay(this->Mesh.View(), OnTestBackend({}),
    MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()),
    [](const IterationRecord&) { return false; });
  EXPECT_EQ(StopReasonKind::Aborted, report.StopReason);
  EXPECT_EQ(1u, report.Iterations.size());
  ExpectSameTopology(this->Mesh.View().Triangles, triangles, report);
}

TEST_F(ObserverTest, ExceptionsPassAndLeaveTheSessionUsable)
{
  FlipSession session = MakeSession(this->Mesh.View());
  const auto throwing = [](const IterationRecord& record) -> bool
  {
    if (record.Iteration == 2)
    {
      throw std::logic_error("from the observer");
    }
    return true;
  };
  EXPECT_THROW(session.Advance(-1, throwing), std::logic_error);
  EXPECT_TRUE(session.GetReport().Iterations.empty());
  session.Advance(0);
  this->ExpectCompletion(session);

  std::vector<std::int32_t> triangles = this->Mesh.Triangles;
  EXPECT_THROW(FlipToDelaunay(this->Mesh.View(), OnTestBackend({}),
                 MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()), throwing),
    std::logic_error);
  EXPECT_TRUE(this->Mesh.Triangles == triangles);
}

TEST_F(ObserverTest, TheIterationLimitHolds)
{
  const auto needed = static_cast<std::int64_t>(this->Complete.Report.Iterations.size());
  ASSERT_LT(5, needed);
  FlipOptions options;
  for (std::int64_t limit : { std::int64_t(0), std::int64_t(1), std::int64_t(5), needed - 1 })
  {
    options.MaximumIterations = limit;
    FlipSession session = MakeSession(this->Mesh.View(), options);
    EXPECT_FALSE(session.Advance());
    EXPECT_EQ(StopReasonKind::IterationLimit, session.GetReport().StopReason);
    EXPECT_EQ(limit, static_cast<std::int64_t>(session.GetReport().Iterations.size()));
    EXPECT_LT(0, session.GetReport().NonDelaunayAfter);
    this->ExpectValid(session);
    EXPECT_TRUE(limit > 0 || this->Mesh.Triangles == StoreTriangles(session));
  }
  for (std::int64_t limit : { needed, needed + 1 })
  {
    options.MaximumIterations = limit;
    const FlipResult result = Flip(this->Mesh.View(), options);
    EXPECT_TRUE(result.Report.Converged()) << limit;
    EXPECT_TRUE(this->Complete.Triangles == result.Triangles);
  }
}

/// Those of the first and the last iteration are known; all of them if quality is tracked, or if
/// they were asked for.
TEST_F(ObserverTest, AnglesAreMeasuredAtBothEndsOrEverywhere)
{
  const std::vector<IterationRecord>& rows = this->Complete.Report.Iterations;
  for (const IterationRecord& row : rows)
  {
    const bool isEnd = &row == &rows.front() || &row == &rows.back();
    EXPECT_EQ(!isEnd, std::isnan(row.MinimumAngle)) << row.Iteration;
  }
  EXPECT_EQ(this->Complete.Report.MinimumAngleAfter, rows.back().MinimumAngle);
  EXPECT_LT(this->Complete.Report.MinimumAngleBefore, rows.back().MinimumAngle);

  FlipSession plain = MakeSession(this->Mesh.View());
  FlipSession tracked = MakeSession(this->Mesh.View(), With(&FlipOptions::TrackQuality, true));
  for (int stop = 0; stop < 3; ++stop)
  {
    ASSERT_TRUE(plain.Advance(1));
    ASSERT_TRUE(plain.Advance(1)); // the angle before it was not requested
    this->ExpectValid(plain);
    EXPECT_EQ(stop > 0, std::isnan(plain.GetReport().Iterations[2 * stop].MinimumAngle));
    EXPECT_TRUE(std::isnan(plain.GetReport().Iterations.back().MinimumAngle));
    ASSERT_TRUE(tracked.Advance(2));
    for (const std::size_t i : { 2 * stop, 2 * stop + 1 })
    {
      EXPECT_FALSE(std::isnan(tracked.GetReport().Iterations[i].MinimumAngle));
    }
    EXPECT_EQ(
      plain.GetReport().MinimumAngleAfter, tracked.GetReport().Iterations.back().MinimumAngle);
    EXPECT_LT(0, plain.GetReport().TrianglesBelow30After);
    EXPECT_EQ(plain.GetReport().TrianglesBelow30After, tracked.GetReport().TrianglesBelow30After);
  }
}

//------------------------------------------------------------------------------
/// Records the progress that it is told, and ends the run at a given call.
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

class ProgressTest : public testing::TestWithParam<NamedMesh>
{
protected:
  void SetUp() override
  {
    this->Mesh = GetParam().Make();
    this->Options = OnTestBackend({});
    this->Options.FeatureAngle = 180.0;
    this->Unwatched = Flip(this->Mesh.View(), this->Options);
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

  OwnedMesh<double> Mesh;
  FlipOptions Options;
  FlipResult Unwatched;
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
  EXPECT_EQ(1.0, watcher.Told.back());
  ASSERT_LE(2u, watcher.Told.size());
  EXPECT_GT(1.0, watcher.Told[watcher.Told.size() - 2]);
  EXPECT_TRUE(IsTestBackendCuda() || watcher.Told.size() > inBuild + 2);
  EXPECT_TRUE(this->Unwatched.Triangles == StoreTriangles(session));
  ExpectSameStatistics(this->Unwatched.Report, session.GetReport());
}

/// After an abort the mesh is that of a run with the same number of iterations, and the run can
/// continue.
TEST_P(ProgressTest, EndsTheRunAtAnyCall)
{
  Watcher whole;
  this->Run(whole);
  bool endedBeforeFlips = false;
  for (std::size_t call = 1; call < whole.Told.size(); ++call)
  {
    Watcher watcher(call);
    FlipSession session = this->Run(watcher);
    const FlipReport& report = session.GetReport();
    if (report.Converged())
    {
      continue; // in fewer, longer batches than before
    }
    ASSERT_EQ(StopReasonKind::Aborted, report.StopReason) << call;
    ASSERT_EQ(call, watcher.Told.size());
    EXPECT_EQ(this->Mesh.NumberOfPoints(), report.Points);
    endedBeforeFlips = endedBeforeFlips || report.Iterations.empty();
    FlipOptions options = this->Options;
    options.MaximumIterations = static_cast<std::int64_t>(report.Iterations.size());
    const FlipResult cut = Flip(this->Mesh.View(), options);
    ASSERT_TRUE(cut.Triangles == StoreTriangles(session)) << call;
    ASSERT_TRUE(cut.FlipCounts == StoreFlipCounts(session)) << call;
    EXPECT_EQ(cut.Report.TotalFlips, report.TotalFlips);
    if (call % 4 == 1)
    {
      Watcher second(1);
      session.Advance(-1, {}, second.GetObserver());
      EXPECT_EQ(1u, second.Told.size());
      if (report.Iterations.empty()) // The run begins anew.
      {
        EXPECT_GE(watcher.Told.front(), second.Told.front());
      }
      session.Advance();
      EXPECT_TRUE(session.GetReport().Converged());
      ASSERT_TRUE(this->Unwatched.Triangles == StoreTriangles(session)) << call;
      EXPECT_EQ(this->Unwatched.Report.TotalFlips, session.GetReport().TotalFlips);
    }
  }
  EXPECT_TRUE(endedBeforeFlips);
}

/// Whenever an observer throws, the next call ends the run as if nothing had happened.
TEST_P(ProgressTest, ExceptionsMayComeAtAnyCall)
{
  const auto always = [](double) -> bool { throw std::logic_error("from the observer"); };
  EXPECT_THROW(FlipSession(this->Mesh.View(), this->Options, always), std::logic_error);
  for (const int pieces : { 1, 3 })
  {
    this->Options.NumberOfPieces = pieces;
    const FlipResult expected = Flip(this->Mesh.View(), this->Options);
    bool hasThrown = true;
    for (int call = 1; hasThrown; call += 1 + call / 4)
    {
      int asked = 0;
      hasThrown = false;
      const auto throwing = [&](double)
      {
        hasThrown = ++asked == call;
        return hasThrown ? throw std::logic_error("from the observer") : true;
      };
      FlipSession session(this->Mesh.View(), this->Options);
      try
      {
        session.Advance(-1, {}, throwing);
      }
      catch (const std::logic_error&)
      {
        session.Advance();
      }
      ASSERT_TRUE(session.GetReport().Converged()) << call;
      ASSERT_TRUE(expected.Triangles == StoreTriangles(session)) << call;
      ASSERT_EQ(expected.Report.TotalFlips, session.GetReport().TotalFlips) << call;
    }
  }
}

OwnedMesh<double> MakeSmallPlane() { return MakeRandomBadMeshDouble(2000, 61); }

INSTANTIATE_TEST_SUITE_P(Meshes, ProgressTest,
  testing::Values(NamedMesh{ "SmallPlane", MakeSmallPlane },
    NamedMesh{ "Chunks", [] { return MakeRandomBadMeshDouble(40000, 62); } },
    NamedMesh{ "Surface", [] { return MakeBadSphere(80, 40, 63); } }),
  GetCaseName);

/// Also of the whole run in one call. Invalid input is an error before.
TEST(Progress, IsToldAndEndsTheRun)
{
  OwnedMesh<double> mesh = MakeSmallPlane();
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
  mesh.Triangles[30] = 1000000;
  Watcher none(1);
  EXPECT_THROW(FlipSession(mesh.View(), OnTestBackend({}), none.GetObserver()), InvalidMesh);
  EXPECT_TRUE(none.Told.empty());
}

/// With an iteration limit n, progress after iteration n - 1 is at least (n - 1) / n of the loop's.
TEST(Progress, FollowsTheIterationLimit)
{
  const OwnedMesh<double> mesh = MakeWorstCaseMesh(300);
  FlipOptions options = OnBackend(BackendKind::Threads);
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
