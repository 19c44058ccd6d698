// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The pace of a live run: as many iterations as fit into a time, pause, and step.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace
{

/// Apart from the seconds.
void ExpectSameTables(vtkDelaunayFlip* filter, vtkDelaunayFlip* other)
{
  vtkTable* table = filter->GetIterations();
  vtkTable* expected = other->GetIterations();
  ASSERT_EQ(table->GetNumberOfRows(), expected->GetNumberOfRows());
  for (vtkIdType column = 0; column < expected->GetNumberOfColumns() - 1; ++column)
  {
    for (vtkIdType row = 0; row < expected->GetNumberOfRows(); ++row)
    {
      EXPECT_EQ(table->GetValue(row, column).ToString(), expected->GetValue(row, column).ToString())
        << expected->GetColumnName(column) << " " << row;
    }
  }
}

}

TEST(LivePace, AsManyIterationsAsFitEndWithTheSameBits)
{
  for (const auto& mesh : { MakeBadPlane(), MakeBadSphere() })
  {
    WatchedFilter once(mesh);
    vtkSmartPointer<vtkPolyData> expected = RunCleanly(once);
    LiveFilter live(mesh);
    live->SetIterationsPerUpdate(0);
    EXPECT_LE(live.RunToTheEnd(), once->GetNumberOfIterations());
    EXPECT_EQ(live.GetTriangles(), GetCells(expected->GetPolys()));
    ExpectSameTables(live.Get(), once.Get());
  }
}

TEST(LivePace, SlowIterationsComeOneByOne)
{
  LiveFilter filter(MakeBadPlane());
  filter->SetIterationsPerUpdate(0);
  auto wait = []() { std::this_thread::sleep_for(std::chrono::milliseconds(60)); };
  OnProgress(filter.Get(), wait);
  for (vtkIdType iterations = 1; iterations <= 3; ++iterations)
  {
    filter.Run();
    EXPECT_EQ(filter->GetNumberOfIterations(), iterations);
    filter->Advance();
  }
}

TEST(LivePace, FastIterationsComeTogether)
{
  // 97 iterations of a few microseconds each. If the machine stalls, a second update is allowed.
  LiveFilter filter(ToPolyData(delaunayflip::MakeWorstCaseMesh(50)));
  filter->SetIterationsPerUpdate(0);
  EXPECT_LT(filter.RunToTheEnd(), 48);
  EXPECT_EQ(filter->GetNumberOfIterations(), 97);
}

TEST(LivePace, AnAbortEndsIt)
{
  LiveFilter filter(MakeBadPlane());
  filter->SetIterationsPerUpdate(0);
  auto stop = [&filter]() { filter->SetAbortExecute(filter->GetNumberOfIterations() > 0); };
  OnProgress(filter.Get(), stop);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
}

TEST(LivePace, PausedIsNotPolled)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter->PausedOn();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1); // pausing makes no step
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_TRUE(filter->Advance());
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 2);
  EXPECT_TRUE(filter->Step());
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 3);
  filter->PausedOff();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 3);
  EXPECT_TRUE(filter->GetNeedsUpdate());
  filter.RunToTheEnd();
  EXPECT_FALSE(filter->Step());
}
