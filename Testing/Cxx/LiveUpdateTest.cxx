// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live updates: some iterations at a time, and the same mesh in the end.

#include "FilterTestSupport.h"

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
#include <vector>

namespace
{

vtkSmartPointer<vtkPolyData> MakeBadPlane()
{
  return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(400, 3));
}

vtkSmartPointer<vtkPolyData> MakeBadSphere()
{
  return ToPolyData(delaunayflip::MakeBadSphere(40, 20, 4));
}

/// The cells of a run without live update.
Cells FlipAtOnce(vtkPolyData* mesh, double featureAngle = 30.0)
{
  WatchedFilter filter(mesh);
  filter->SetFeatureAngle(featureAngle);
  return GetCells(RunCleanly(filter)->GetPolys());
}

class LiveFilter : public WatchedFilter
{
public:
  explicit LiveFilter(vtkPolyData* input)
    : WatchedFilter(input)
  {
    (*this)->LiveUpdateOn();
  }

  /// Updates until there is nothing left to do. @returns the number of updates.
  int RunToTheEnd()
  {
    constexpr int Most = 1000; // a run that does not end fails its test
    int updates = 0;
    do
    {
      this->Run();
      ++updates;
    } while ((*this)->Advance() && updates < Most);
    return updates;
  }

  Cells GetTriangles() { return GetCells((*this)->GetOutput()->GetPolys()); }
};

/// Moves the points in place: a shear, which makes other edges bad.
void Shear(vtkPolyData* mesh, double factor)
{
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    mesh->GetPoints()->SetPoint(point, x[0] + factor * x[1], x[1], x[2]);
  }
  mesh->GetPoints()->Modified();
}

/// The flips of every iteration.
std::vector<double> GetFlips(vtkDelaunayFlip* filter)
{
  vtkDataArray* flipped = filter->GetOutput()->GetFieldData()->GetArray("DelaunayFlip:Flipped");
  std::vector<double> flips;
  for (vtkIdType i = 0; i < flipped->GetNumberOfTuples(); ++i)
  {
    flips.push_back(flipped->GetTuple1(i));
  }
  return flips;
}

vtkIdType CountFixedEdges(vtkDelaunayFlip* filter)
{
  return static_cast<vtkIdType>(
    filter->GetOutput()->GetFieldData()->GetArray("DelaunayFlip:FixedEdges")->GetTuple1(0));
}

}

TEST(LiveUpdate, IsOffByDefault)
{
  WatchedFilter filter(MakeBadPlane());
  EXPECT_FALSE(filter->GetLiveUpdate());
  EXPECT_EQ(filter->GetIterationsPerUpdate(), 1);
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

TEST(LiveUpdate, EndsWithTheSameBits)
{
  for (const auto& mesh : { MakeBadPlane(), MakeBadSphere() })
  {
    for (const vtkIdType step : { 1, 4, 1000 })
    {
      WatchedFilter once(mesh);
      once->GenerateFlipCountOn();
      vtkSmartPointer<vtkPolyData> expected = RunCleanly(once);
      LiveFilter live(mesh);
      live->GenerateFlipCountOn();
      live->SetIterationsPerUpdate(step);
      const int updates = live.RunToTheEnd();
      EXPECT_EQ(updates, (once->GetNumberOfIterations() + step - 1) / step);
      EXPECT_EQ(live.GetTriangles(), GetCells(expected->GetPolys()));
      EXPECT_EQ(GetNumbers(live->GetOutput()->GetCellData(), "vtkDelaunayFlipCount"),
        GetNumbers(expected->GetCellData(), "vtkDelaunayFlipCount"));
      EXPECT_EQ(GetFlips(live.Get()), GetFlips(once.Get()));
      EXPECT_EQ(live->GetTotalFlips(), once->GetTotalFlips());
    }
  }
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

TEST(LiveUpdate, MovedPointsStartWarmly)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  const int updates = filter.RunToTheEnd();
  Shear(mesh, 0.05);
  EXPECT_LT(filter.RunToTheEnd(), updates);
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_EQ(filter->GetOutput()->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(CountViolations(filter->GetOutput()), 0);
  EXPECT_LT(filter->GetTotalFlips(), mesh->GetNumberOfPoints());
}

TEST(LiveUpdate, MovedPointsKeepTheirSlots)
{
  auto mesh = MakeBadSphere();
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  LiveFilter filter(mesh);
  filter.RunToTheEnd();
  const Cells before = filter.GetTriangles();
  Shear(mesh, 0.0);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(filter.GetTriangles(), before);
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetCellData(), "Number")[7], 7);
}

TEST(LiveUpdate, FixedEdgesTravelWithMovedPoints)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(mesh);
  filter->SetFeatureAngle(12.0);
  filter.RunToTheEnd();
  const vtkIdType fixedBefore = CountFixedEdges(filter.Get());
  ASSERT_GT(fixedBefore, 0);
  for (int i = 0; i < 2; ++i)
  {
    Shear(mesh, 0.3);
    filter.RunToTheEnd();
    EXPECT_EQ(CountFixedEdges(filter.Get()), fixedBefore);
  }
  EXPECT_GT(filter->GetTotalFlips(), 0);
}

TEST(LiveUpdate, FeatureEdgesStayWhenFlattened)
{
  // A roof along 0-2, then flat: the ridge stays though a flat rhombus would flip it.
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(1, 0.0, -1.0, -1.0);
  mesh->GetPoints()->SetPoint(3, 0.0, 1.0, -1.0);
  LiveFilter filter(mesh);
  filter->SetGeometryToSurface();
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
  mesh->GetPoints()->SetPoint(1, 0.0, -1.0, 0.0);
  mesh->GetPoints()->SetPoint(3, 0.0, 1.0, 0.0);
  mesh->GetPoints()->Modified();
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
  filter->Restart();
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
}

TEST(LiveUpdate, PlaneThatBecomesASurfaceStartsAgain)
{
  auto mesh = MakeRhombus();
  LiveFilter filter(mesh);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  mesh->GetPoints()->SetPoint(1, 0.0, -1.0, -1.0);
  mesh->GetPoints()->SetPoint(3, 0.0, 1.0, -1.0);
  mesh->GetPoints()->Modified();
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_SURFACE);
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));
}

TEST(LiveUpdate, QuadsStartWarmly)
{
  auto mesh =
    MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  LiveFilter filter(mesh);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  Shear(mesh, 0.01);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
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
  filter->SetTolerance(-1.0);
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

TEST(LiveUpdate, PiecesAreFlippedAtOnce)
{
  LiveFilter filter(MakeBadPlane());
  filter->UpdatePiece(0, 2, 0);
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_FALSE(filter->GetNeedsUpdate());
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
