// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FlipTestSupport.h"
#include "MeshAudit.h"
#include "TestBackend.h"

#include <gtest/gtest.h>

#include <cmath>
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

class ObserverTest : public testing::Test
{
protected:
  void SetUp() override { this->Complete = Flip(this->Mesh.View()); }

  /// Checks that the session's mesh is valid and that its report counts the bad edges that are
  /// left.
  void ExpectValid(const FlipSession& session) const
  {
    const std::vector<std::int32_t> triangles = Store(session);
    ExpectSameTopology(this->Mesh.View().Triangles, triangles, session.GetReport());
    ExpectConsistentStatistics(session.GetReport());
    EXPECT_EQ(CountNonDelaunayEdges(WithTriangles(this->Mesh.View(), triangles), FlipOptions()),
      session.GetReport().NonDelaunayAfter);
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
  EXPECT_FALSE(session.GetReport().Converged());
  EXPECT_EQ(3u, session.GetReport().Iterations.size());
  EXPECT_LT(0, session.GetReport().NonDelaunayAfter);
  this->ExpectValid(session);

  EXPECT_FALSE(session.Advance());
  EXPECT_TRUE(session.GetReport().Converged());
  EXPECT_TRUE(this->Complete.Triangles == Store(session));
}

TEST_F(ObserverTest, AbortStopsTheOneCallDoorToo)
{
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
  // On a GPU the whole batch is in the report before the observer is called.
  const std::size_t done = session.GetReport().Iterations.size();
  EXPECT_TRUE(done == 2 || (IsTestBackendCuda() && done > 2)) << done;
  this->ExpectValid(session);
  session.Advance();
  EXPECT_TRUE(session.GetReport().Converged());
  EXPECT_TRUE(this->Complete.Triangles == Store(session));
}

TEST_F(ObserverTest, NothingIsWrittenWhenAnExceptionLeaves)
{
  std::vector<std::int32_t> triangles = this->Mesh.Triangles;
  EXPECT_THROW(FlipToDelaunay(this->Mesh.View(), OnTestBackend({}),
                 MutableTriangleArray(triangles.data(), this->Mesh.NumberOfTriangles()),
                 [](const IterationRecord&) -> bool { throw std::logic_error("at once"); }),
    std::logic_error);
  EXPECT_TRUE(this->Mesh.Triangles == triangles);
}

TEST_F(ObserverTest, TheIterationLimitHolds)
{
  const auto needed = static_cast<std::int64_t>(this->Complete.Report.Iterations.size());
  ASSERT_LT(5, needed);
  for (std::int64_t limit : { std::int64_t(0), std::int64_t(1), std::int64_t(5), needed - 1 })
  {
    FlipOptions options;
    options.MaximumIterations = limit;
    FlipSession session = MakeSession(this->Mesh.View(), options);
    EXPECT_FALSE(session.Advance());
    EXPECT_EQ(StopReasonKind::IterationLimit, session.GetReport().StopReason);
    EXPECT_EQ(limit, static_cast<std::int64_t>(session.GetReport().Iterations.size()));
    EXPECT_LT(0, session.GetReport().NonDelaunayAfter);
    this->ExpectValid(session);
    EXPECT_TRUE(limit > 0 || this->Mesh.Triangles == Store(session));
  }
  for (std::int64_t limit : { needed, needed + 1, std::int64_t(-1) })
  {
    FlipOptions options;
    options.MaximumIterations = limit;
    const FlipResult result = Flip(this->Mesh.View(), options);
    EXPECT_TRUE(result.Report.Converged()) << limit;
    EXPECT_TRUE(this->Complete.Triangles == result.Triangles);
  }
}

TEST_F(ObserverTest, ReportsHaveTheAngleOfEveryStop)
{
  FlipSession session = MakeSession(this->Mesh.View());
  for (int stop = 0; stop < 3; ++stop)
  {
    ASSERT_TRUE(session.Advance(1));
    ASSERT_TRUE(session.Advance(1)); // the angle before it was not requested
    const std::vector<std::int32_t> triangles = Store(session);
    EXPECT_NEAR(MinimumAngle(WithTriangles(this->Mesh.View(), triangles), GeometryKind::Planar),
      session.GetReport().MinimumAngleAfter, 1e-9);
    EXPECT_EQ(stop > 0, std::isnan(session.GetReport().Iterations[2 * stop].MinimumAngle));
    EXPECT_TRUE(std::isnan(session.GetReport().Iterations.back().MinimumAngle));
  }
  session.Advance();
  EXPECT_EQ(this->Complete.Report.MinimumAngleAfter, session.GetReport().MinimumAngleAfter);
  EXPECT_EQ(
    this->Complete.Report.MinimumAngleAfter, session.GetReport().Iterations.back().MinimumAngle);
}

TEST_F(ObserverTest, AnglesAreMeasuredAtBothEndsOrEverywhere)
{
  const std::vector<IterationRecord>& rows = this->Complete.Report.Iterations;
  EXPECT_FALSE(std::isnan(rows.front().MinimumAngle));
  EXPECT_FALSE(std::isnan(rows.back().MinimumAngle));
  EXPECT_TRUE(std::isnan(rows[rows.size() / 2].MinimumAngle));
  EXPECT_EQ(this->Complete.Report.MinimumAngleAfter, rows.back().MinimumAngle);
  EXPECT_LT(this->Complete.Report.MinimumAngleBefore, rows.back().MinimumAngle);

  FlipOptions options;
  options.TrackQuality = true;
  FlipSession session = MakeSession(this->Mesh.View(), options);
  while (session.Advance(1))
  {
    const std::vector<std::int32_t> triangles = Store(session);
    EXPECT_NEAR(MinimumAngle(WithTriangles(this->Mesh.View(), triangles), GeometryKind::Planar),
      session.GetReport().Iterations.back().MinimumAngle, 1e-9);
  }
}

}
}
