// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The progress events of an update, and that observers can stop it at any of them.

#include "FilterTestSupport.h"
#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

constexpr int Side = 120; ///< Quads per side: enough for several progress events during the split.

/// Quads with numbered cells, many of which are split along the wrong diagonal.
vtkSmartPointer<vtkPolyData> MakeQuads()
{
  Points points;
  Cells quads;
  for (int y = 0; y <= Side; ++y)
  {
    for (int x = 0; x <= Side; ++x)
    {
      points.push_back({ x + 0.3 * (y % 2), y + 0.2 * std::sin(x * y), 0.0 });
    }
  }
  for (vtkIdType y = 0; y < Side; ++y)
  {
    for (vtkIdType x = 0; x < Side; ++x)
    {
      const vtkIdType corner = y * (Side + 1) + x;
      quads.push_back({ corner, corner + 1, corner + Side + 2, corner + Side + 1 });
    }
  }
  auto mesh = MakeMesh(points, quads);
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  return mesh;
}

vtkSmartPointer<vtkPolyData> MakeLongRun()
{
  return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(300, 1));
}

/// Records the progress events of an update, and stops it at one of them.
class ProgressWatch
{
public:
  explicit ProgressWatch(WatchedFilter& filter, std::size_t lastEvent = SIZE_MAX)
    : Filter(filter.Get()),
      LastEvent(lastEvent)
  {
    OnProgress(this->Filter, *this);
  }

  void operator()()
  {
    if (this->Filter->GetProgress() == 0.0)
    {
      return; // an event of the executive, before the filter runs
    }
    this->Progress.push_back(this->Filter->GetProgress());
    this->Iterations.push_back(this->Filter->GetNumberOfIterations());
    if (this->Progress.size() == this->LastEvent)
    {
      this->Filter->SetAbortExecute(1);
    }
  }

  std::vector<double> Progress;
  std::vector<vtkIdType> Iterations;

private:
  vtkDelaunayFlip* Filter;
  std::size_t LastEvent;
};

Cells FlipTo(vtkPolyData* mesh, vtkIdType iterations)
{
  WatchedFilter filter(mesh);
  filter->SetMaximumIterations(iterations);
  return GetCells(RunCleanly(filter)->GetPolys());
}

/// Stops updates of a mesh at each of their events in turn.
void ExpectToStopAnywhere(vtkPolyData* mesh)
{
  bool hasStoppedEarly = false;
  bool hasConverged = false;
  for (std::size_t event = 1; !hasConverged; ++event)
  {
    WatchedFilter filter(mesh);
    ProgressWatch watch(filter, event);
    vtkPolyData* output = filter.Run();
    ASSERT_TRUE(filter.GetErrors().empty());
    ASSERT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_NONE);
    hasConverged = filter->GetConverged();
    if (!hasConverged)
    {
      ASSERT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED) << event;
      ASSERT_EQ(watch.Progress.size(), event);
    }
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    ASSERT_EQ(GetCells(output->GetPolys()), FlipTo(mesh, filter->GetNumberOfIterations())) << event;
    hasStoppedEarly = hasStoppedEarly || filter->GetNumberOfIterations() == 0;
  }
  EXPECT_TRUE(hasStoppedEarly);
}

}

TEST(FilterProgress, BeginsBeforeTheFirstIteration)
{
  WatchedFilter filter(MakeLongRun());
  ProgressWatch watch(filter);
  RunCleanly(filter);
  EXPECT_TRUE(std::is_sorted(watch.Progress.begin(), watch.Progress.end()));
  EXPECT_LT(watch.Progress.front(), 0.1);
  EXPECT_EQ(watch.Progress.back(), 1.0);
  const auto early = std::count(watch.Iterations.begin(), watch.Iterations.end(), 0);
  ASSERT_GE(early, 5);
  EXPECT_GT(watch.Progress[early - 1], 0.4);
  EXPECT_LT(watch.Progress[early - 1], 0.7);
  EXPECT_EQ(watch.Iterations.back(), filter->GetNumberOfIterations());
}

TEST(FilterProgress, AbortsAnywhere) { ExpectToStopAnywhere(MakeLongRun()); }

TEST(FilterProgress, IsToldWhilePolygonsAreSplit)
{
  WatchedFilter filter(MakeQuads());
  ProgressWatch watch(filter);
  RunCleanly(filter);
  EXPECT_TRUE(std::is_sorted(watch.Progress.begin(), watch.Progress.end()));
  const auto isOfSplit = [](double progress) { return progress <= 0.3; };
  EXPECT_GE(std::count_if(watch.Progress.begin(), watch.Progress.end(), isOfSplit), 3);
}

TEST(FilterProgress, AbortedWhilePolygonsAreSplitTheInputPasses)
{
  auto mesh = MakeQuads();
  WatchedFilter filter(mesh);
  ProgressWatch watch(filter, 1);
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  EXPECT_TRUE(filter.GetWarnings().empty());
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_EQ(watch.Progress.size(), 1u);
  EXPECT_EQ(output->GetPolys(), mesh->GetPolys());
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), GetNumbers(mesh->GetCellData(), "Number"));
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
}

TEST(FilterProgress, AbortedAfterTheSplitTrianglesPass)
{
  auto mesh = MakeQuads();
  WatchedFilter filter(mesh);
  auto stop = [&filter]() { filter->SetAbortExecute(filter->GetProgress() > 0.31); };
  OnProgress(filter.Get(), stop);
  vtkPolyData* output = filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_EQ(filter->GetNumberOfIterations(), 0);
  EXPECT_EQ(output->GetNumberOfPolys(), 2 * mesh->GetNumberOfPolys());
  EXPECT_EQ(GetCells(output->GetPolys()), FlipTo(mesh, 0));
  const std::vector<int> numbers = GetNumbers(output->GetCellData(), "Number");
  ASSERT_EQ(numbers.size(), 2u * Side * Side);
  EXPECT_EQ(numbers[2 * 700], 700);
  EXPECT_EQ(numbers[2 * 700 + 1], 700);
}

TEST(FilterProgress, AnAbortedUpdateIsFollowedByAWholeOne)
{
  WatchedFilter filter(MakeQuads());
  auto stop = [&filter]() { filter->SetAbortExecute(1); };
  OnProgress(filter.Get(), stop);
  filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  filter->RemoveAllObservers();
  filter->Modified();
  RunCleanly(filter);
  EXPECT_TRUE(filter->GetConverged());
}

/// Wherever it is stopped, a live run continues with the next update.
TEST(FilterProgress, LiveRunsGoOn)
{
  for (const vtkSmartPointer<vtkPolyData>& input : { MakeQuads(), MakeLongRun() })
  {
    for (std::size_t event : { 1, 3, 4, 6, 9, 10 })
    {
      LiveFilter filter(input);
      filter->SetIterationsPerUpdate(2);
      ProgressWatch watch(filter, event);
      filter.Run();
      ASSERT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED) << event;
      filter->RemoveAllObservers();
      EXPECT_TRUE(filter->Advance());
      filter.RunToTheEnd();
      EXPECT_TRUE(filter->GetConverged());
      EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(input)) << event;
    }
  }
}
