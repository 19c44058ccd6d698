// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The filter in a pipeline: progress, abort, limits.

#include "FilterTestSupport.h"

#include "TestBackend.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{

vtkSmartPointer<vtkPolyData> MakeLongRun()
{
  return ToPolyData(delaunayflip::MakeWorstCaseMesh(20)); // 37 iterations
}

/// A fan of 18 triangles whose points lie on one circle.
vtkSmartPointer<vtkPolyData> MakeCircle(std::mt19937& random)
{
  constexpr double Turn = 2.0 * 3.14159265358979323846;
  std::array<double, 20> angles;
  for (double& angle : angles)
  {
    angle = Turn * random() / random.max();
  }
  std::sort(angles.begin(), angles.end());
  Points points;
  for (const double angle : angles)
  {
    points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
  }
  Cells triangles;
  for (vtkIdType point = 2; point < 20; ++point)
  {
    triangles.push_back({ 0, point - 1, point });
  }
  return MakeMesh(points, triangles);
}

}

TEST(VtkDelaunayFlip, ProgressRisesWithTheIterations)
{
  if (delaunayflip::IsTestBackendCuda())
  {
    GTEST_SKIP() << "the GPU tells of batches of iterations: FilterProgress";
  }
  WatchedFilter filter(MakeLongRun());
  std::vector<double> progress;
  std::vector<vtkIdType> iterations;
  auto record = [&]()
  {
    progress.push_back(filter->GetProgress());
    iterations.push_back(filter->GetNumberOfIterations());
  };
  OnProgress(filter.Get(), record);
  RunCleanly(filter);
  ASSERT_GE(progress.size(), 37u);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_LE(progress.back(), 1.0);
  EXPECT_GT(progress[10], 0.0);
  EXPECT_LT(progress[10], 1.0);
  EXPECT_NE(std::find(iterations.begin(), iterations.end(), 10), iterations.end());
}

TEST(VtkDelaunayFlip, AbortLeavesAValidMesh)
{
  if (delaunayflip::IsTestBackendCuda())
  {
    GTEST_SKIP() << "the GPU aborts at the end of a batch of iterations: FilterProgress, BatchTest";
  }
  auto mesh = MakeLongRun();
  WatchedFilter filter(mesh);
  auto stop = [&]()
  {
    if (filter->GetNumberOfIterations() == 5)
    {
      filter->SetAbortExecute(1);
    }
  };
  OnProgress(filter.Get(), stop);
  vtkPolyData* output = filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_GT(filter->GetNumberOfNonDelaunayEdges(), 0);
  EXPECT_EQ(CountViolations(output), filter->GetNumberOfNonDelaunayEdges());
  EXPECT_EQ(output->GetNumberOfCells(), mesh->GetNumberOfCells());
}

TEST(VtkDelaunayFlip, RequestedLimitGivesNoWarning)
{
  auto mesh = MakeLongRun();
  WatchedFilter filter(mesh);
  filter->SetMaximumIterations(5);
  vtkSmartPointer<vtkPolyData> output = RunCleanly(filter);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_GT(filter->GetNumberOfNonDelaunayEdges(), 0);
  EXPECT_EQ(CountViolations(output), filter->GetNumberOfNonDelaunayEdges());
}

TEST(VtkDelaunayFlip, SafetyLimitWarns)
{
  // Without a tolerance, rounding makes both diagonals of some quads bad, and flips never end.
  std::mt19937 random(1);
  WatchedFilter filter;
  filter->SetGeometryToSurface();
  filter->SetTolerance(0.0);
  for (int mesh = 0; mesh < 1000 && filter.GetWarnings().empty(); ++mesh)
  {
    filter->SetInputData(MakeCircle(random));
    filter.Run();
  }
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
  EXPECT_EQ(filter->GetNumberOfIterations(), 1018);
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_NE(filter.GetWarnings()[0].find("stopped by the safety limit of 1018 iterations"),
    std::string::npos)
    << filter.GetWarnings()[0];

  // With the automatic tolerance no edge flips because of rounding alone.
  WatchedFilter automatic(vtkPolyData::SafeDownCast(filter->GetInput()));
  automatic->SetGeometryToSurface();
  RunCleanly(automatic);
  EXPECT_TRUE(automatic->GetConverged());
}

TEST(VtkDelaunayFlip, NoIterationsNoFlips)
{
  auto mesh = MakeLongRun();
  WatchedFilter filter(mesh);
  filter->SetMaximumIterations(0);
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), GetCells(mesh->GetPolys()));
  EXPECT_GT(filter->GetNumberOfNonDelaunayEdges(), 0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
}

TEST(VtkDelaunayFlip, ExecutesOnlyWhenModified)
{
  WatchedFilter filter(MakeLongRun());
  int executions = 0;
  auto count = [&]() { executions += filter->GetProgress() == 0.0 ? 1 : 0; };
  OnProgress(filter.Get(), count);
  RunCleanly(filter);
  RunCleanly(filter);
  EXPECT_EQ(executions, 1);
  filter->SetGeometryToPlanar();
  RunCleanly(filter);
  EXPECT_EQ(executions, 2);
}

TEST(VtkDelaunayFlip, FollowsAnotherFilter)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(MakeRhombus());
  WatchedFilter filter;
  filter->SetInputConnection(append->GetOutputPort());
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
}
