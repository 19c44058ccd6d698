// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Observers of refinement: what they are told, and what is left after they have stopped it.

#include "DelaunayFlip.h"
#include "FlipTestSupport.h"
#include "RandomNumbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace delaunayflip
{
namespace
{

/// Points with segments that cross, and a goal.
class StoppedRefine : public testing::Test
{
protected:
  StoppedRefine()
  {
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i)
    {
      this->Places.push_back(DrawReal(random, 0.1, 0.9));
    }
    this->Options.SplitCrossings = true;
    this->Options.MinimumAngle = 20.0;
    this->Options.NumberOfThreads = 1;
    this->Options.Backend = BackendKind::Threads;
  }

  /// @param points how many of them.
  PointInput View(std::int64_t points) const
  {
    PointInput input;
    input.Points = PlaneArray(this->Places.data(), points, 2);
    input.Segments = this->Segments.data();
    input.NumberOfSegments = 2;
    return input;
  }

  static constexpr std::int64_t All = 104, Fewer = 100;
  std::vector<double> Places = { 0, 0, 1, 1, 0, 1, 1, 0 };
  std::vector<std::int64_t> Segments = { 0, 1, 2, 3 };
  PointOptions Options;
};

void ExpectSame(const FlipSession& expected, const FlipSession& session)
{
  ExpectSameStatistics(expected.GetReport(), session.GetReport());
  EXPECT_EQ(1, session.GetReport().FromPoints.Crossings);
  EXPECT_EQ(expected.GetAddedPoints().size(), session.GetAddedPoints().size());
  EXPECT_TRUE(StoreTriangles(expected) == StoreTriangles(session));
}

/// Also while points and segments are prepared.
TEST_F(StoppedRefine, BeginsAnewAfterAStop)
{
  FlipSession expected(this->View(All), this->Options);
  expected.Advance();
  EXPECT_LT(0, expected.GetReport().FromPoints.RefinementPoints);
  bool wasStopped = true;
  for (int stop = 1; wasStopped && !HasFailure(); ++stop)
  {
    int calls = 0;
    FlipSession session(this->View(All), this->Options, [&](double) { return ++calls != stop; });
    wasStopped = session.GetReport().StopReason == StopReasonKind::Aborted;
    EXPECT_TRUE(wasStopped || stop > 2);
    session.Advance();
    ExpectSame(expected, session);
  }
}

TEST_F(StoppedRefine, BeginsAnewAfterAStoppedInsertion)
{
  FlipSession expected(this->View(All), this->Options);
  expected.Advance();
  bool wasStopped = true;
  for (int stop = 1; wasStopped && !HasFailure(); ++stop)
  {
    FlipSession session(this->View(Fewer), this->Options);
    session.Advance();
    int calls = 0;
    const PlaneArray more(this->Places.data() + 2 * Fewer, All - Fewer, 2);
    wasStopped = !session.Insert(more, [&](double) { return ++calls != stop; });
    EXPECT_TRUE(wasStopped || stop > 5);
    session.Advance();
    ExpectSame(expected, session);
  }
}

/// The progress is 1 at the end, and not before.
TEST_F(StoppedRefine, ProgressGoesOnInAllStages)
{
  std::vector<double> told;
  const ProgressObserver tell = [&](double share)
  {
    told.push_back(share);
    return true;
  };
  FlipSession session(this->View(All), this->Options, tell);
  session.Advance(-1, {}, tell);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(1.0, told.back());
  EXPECT_EQ(1, std::count(told.begin(), told.end(), 1.0));
  const auto isOfRefinement = [](double share) { return share > 0.5 && share < 1.0; };
  EXPECT_LT(3, std::count_if(told.begin(), told.end(), isOfRefinement));
}

}
}
