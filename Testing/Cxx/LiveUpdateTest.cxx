// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live updates: a few iterations at a time.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <limits>

TEST(LiveUpdate, IsOffByDefault)
{
  WatchedFilter filter(MakeBadPlane());
  EXPECT_FALSE(filter->GetLiveUpdate());
  EXPECT_EQ(filter->GetIterationsPerUpdate(), 1);
  EXPECT_FALSE(filter->GetPaused());
  RunCleanly(filter);
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_FALSE(filter->Advance());
  EXPECT_FALSE(filter->GetNeedsUpdate());
}

TEST(LiveUpdate, EveryStepGivesAValidMesh)
{
  LiveFilter filter(MakeBadPlane());
  vtkIdType iterations = 0;
  vtkIdType flips = 0;
  do
  {
    vtkPolyData* output = RunCleanly(filter);
    EXPECT_EQ(filter->GetNumberOfIterations(), ++iterations);
    EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), iterations);
    EXPECT_EQ(
      output->GetFieldData()->GetArray("DelaunayFlip:Flipped")->GetNumberOfTuples(), iterations);
    EXPECT_GT(filter->GetTotalFlips(), flips);
    flips = filter->GetTotalFlips();
    EXPECT_EQ(CountViolations(output), filter->GetNumberOfNonDelaunayEdges());
    EXPECT_EQ(filter->GetConverged(), filter->GetNumberOfNonDelaunayEdges() == 0);
    if (!filter->GetConverged())
    {
      EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_RUNNING);
      EXPECT_STREQ(filter->GetStopReasonAsString(), "running");
    }
  } while (filter->Advance());
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_GT(iterations, 5);
}

TEST(LiveUpdate, NothingIsDoneWhenNobodyAsks)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
}

TEST(LiveUpdate, PollingEndsWithConvergence)
{
  LiveFilter filter(MakeBadPlane());
  EXPECT_FALSE(filter->GetNeedsUpdate());
  filter.Run();
  int updates = 1;
  while (filter->GetNeedsUpdate())
  {
    filter.Run();
    EXPECT_EQ(filter->GetNumberOfIterations(), ++updates);
  }
  EXPECT_TRUE(filter->GetConverged());
  const vtkMTimeType time = filter->GetMTime();
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_FALSE(filter->Advance());
  EXPECT_EQ(filter->GetMTime(), time);
}

TEST(LiveUpdate, AnotherOptionStartsAgain)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(mesh);
  filter.Run();
  filter->Advance();
  filter.Run();
  filter->SetFeatureAngle(180.0);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh, 180.0));
}

TEST(LiveUpdate, AnotherStepGoesOn)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter->SetIterationsPerUpdate(2);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 3);
  filter->GenerateFlipCountOn();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_NE(filter->GetOutput()->GetCellData()->GetArray("vtkDelaunayFlipCount"), nullptr);
}

TEST(LiveUpdate, AnotherInputStartsAgain)
{
  LiveFilter filter(MakeBadPlane());
  filter.RunToTheEnd();
  auto mesh = MakeBadSphere();
  filter->SetInputData(mesh);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, OtherCellsStartAgain)
{
  auto mesh = MakeRhombus();
  LiveFilter filter(mesh);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  mesh->SetPolys(MakeCells({ { 0, 1, 2 } }));
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetTriangles(), (Cells{ { 0, 1, 2 } }));
  mesh->SetPolys(MakeCells({ { 0, 1, 2 }, { 0, 2, 3 } }));
  mesh->SetLines(MakeCells({ { 0, 2 } }));
  filter.RunToTheEnd();
  EXPECT_FALSE(HasEdge(filter->GetOutput(), 1, 3));
}

TEST(LiveUpdate, RestartStartsAgain)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  const int updates = filter.RunToTheEnd();
  filter->Restart();
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_EQ(filter.RunToTheEnd(), updates);
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, TurnedOffFlipsAtOnce)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  filter->LiveUpdateOff();
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, AttributesPassOnTheWay)
{
  auto mesh = MakeBadPlane();
  AddNumbers(mesh->GetPointData(), "Number", mesh->GetNumberOfPoints(), 0);
  LiveFilter filter(mesh);
  filter.Run();
  AddNumbers(mesh->GetPointData(), "Number", mesh->GetNumberOfPoints(), 100);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 2);
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetPointData(), "Number")[0], 100);
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, EndsAtTheIterationLimit)
{
  LiveFilter filter(MakeBadPlane());
  filter->SetMaximumIterations(5);
  filter->SetIterationsPerUpdate(2);
  EXPECT_EQ(filter.RunToTheEnd(), 3);
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_TRUE(filter.GetWarnings().empty());
}

TEST(LiveUpdate, WarnsOnce)
{
  auto mesh = MakeBadPlane();
  mesh->GetPoints()->SetPoint(40, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  LiveFilter filter(mesh);
  EXPECT_GT(filter.RunToTheEnd(), 2);
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
}

TEST(LiveUpdate, GoesOnAfterAnAbort)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter->SetIterationsPerUpdate(4);
  auto stop = [&filter]() { filter->SetAbortExecute(1); };
  OnProgress(filter.Get(), stop);
  filter.Run();
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ABORTED);
  EXPECT_FALSE(filter->GetNeedsUpdate());
  filter->RemoveAllObservers();
  filter->SetAbortExecute(0);
  EXPECT_TRUE(filter->Advance());
  filter.RunToTheEnd();
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, AnErrorEndsIt)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  filter->SetTolerance(1.0);
  filter.Run();
  EXPECT_EQ(filter.GetErrors().empty(), false);
  EXPECT_FALSE(filter->Advance());
  EXPECT_FALSE(filter->GetNeedsUpdate());
}

TEST(LiveUpdate, CompositeInputIsFlippedAtOnce)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBadPlane());
  blocks->SetBlock(1, MakeBadPlane());
  WatchedFilter filter;
  filter->SetInputDataObject(blocks);
  filter->LiveUpdateOn();
  for (unsigned int update = 1; update <= 2; ++update)
  {
    filter->Modified();
    filter->Update();
    EXPECT_TRUE(filter->GetConverged());
    EXPECT_FALSE(filter->GetNeedsUpdate());
    EXPECT_FALSE(filter->Advance());
    EXPECT_EQ(filter.GetWarnings().size(), update);
  }
}

TEST(LiveUpdate, EmptyInputHasNothingToDo)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  EXPECT_TRUE(filter->GetNeedsUpdate());
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  EXPECT_EQ(filter.RunToTheEnd(), 1);
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
}
