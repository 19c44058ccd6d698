// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live updates: a few iterations at a time, at any pace, with points that move, and with steps
/// that leave the mesh in the session.

#include "FilterTestSupport.h"

#include "DelaunayFlip.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

namespace
{

/// The triangles of a mesh after a single update by x and y.
Cells FlipAtOnceXY(vtkPolyData* mesh)
{
  return FlipAtOnce(mesh, [](vtkDelaunayFlip* filter) { filter->SetGeometryToPlanarXY(); });
}

/// Bends the rhombus along its long diagonal, or flattens it.
void Bend(vtkPolyData* rhombus, double height)
{
  MovePoints(rhombus, [height](double* x) { x[2] = x[1] == 0.0 ? 0.0 : -height; });
}

/// The triangles that the session has now.
Cells GetSessionCells(LiveFilter& filter)
{
  const std::int64_t count = filter->GetSession()->GetReport().Triangles;
  std::vector<std::int64_t> ids(3 * count);
  filter->GetSession()->StoreTriangles(delaunayflip::MutableTriangleArray(ids.data(), count));
  Cells cells;
  for (std::int64_t i = 0; i < 3 * count; i += 3)
  {
    cells.push_back({ ids[i], ids[i + 1], ids[i + 2] });
  }
  return cells;
}

/// The polygons after some updates, each a step.
Cells MakeSteps(vtkPolyData* mesh, int steps)
{
  LiveFilter filter(mesh);
  for (int i = 0; i < steps; ++i)
  {
    filter.Run();
    filter->Advance();
  }
  return filter.GetPolygons();
}

}

TEST(LiveUpdate, EveryStepGivesAValidMesh)
{
  LiveFilter filter(MakeBadPlane());
  vtkIdType iterations = 0, flips = 0;
  do
  {
    vtkPolyData* output = RunCleanly(filter);
    EXPECT_EQ(filter->GetNumberOfIterations(), ++iterations);
    EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), iterations);
    EXPECT_EQ(GetTotal(output, "Iteration", iterations - 1), iterations);
    EXPECT_GT(filter->GetTotalFlips(), flips);
    flips = filter->GetTotalFlips();
    EXPECT_EQ(CountViolations(output), filter->GetNonDelaunayAfter());
    EXPECT_EQ(filter->GetConverged(), filter->GetNonDelaunayAfter() == 0);
    EXPECT_STREQ(filter->GetStopReasonAsString(), filter->GetConverged() ? "converged" : "running");
    filter.Run(); // nobody asks for another step
    EXPECT_EQ(filter->GetNumberOfIterations(), iterations);
  } while (filter->Advance());
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_GT(iterations, 5);
}

/// Each round of refinement is a step. If points move, the update begins anew.
TEST(LiveUpdate, ShowsRoundsOfRefinement)
{
  const auto refine = [](vtkDelaunayFlip* flip) { flip->SetMaximumArea(1e-4); };
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  refine(filter.Get());
  std::vector<vtkIdType> triangles;
  do
  {
    vtkPolyData* output = RunCleanly(filter);
    EXPECT_EQ(CountViolations(output), filter->GetNonDelaunayAfter());
    triangles.push_back(output->GetNumberOfPolys());
  } while (filter->Advance());
  EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
  EXPECT_LT(filter->GetNumberOfIterations() + 3, static_cast<vtkIdType>(triangles.size()));
  EXPECT_LT(2 * triangles.front(), triangles.back());
  EXPECT_EQ(filter.GetPolygons(), FlipAtOnce(mesh, refine));
  EXPECT_EQ(filter->GetSession(), nullptr); // its triangles have points that the input lacks
  auto moved = MakeBadPlane();
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    const double* point = mesh->GetPoint(i);
    moved->GetPoints()->SetPoint(i, 1.5 * point[0], 1.5 * point[1], point[2]);
  }
  filter->SetInputData(moved);
  filter->Restart();
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetPolygons(), FlipAtOnce(moved, refine));
}

/// Each run gives them again, and so do updates without steps.
TEST(LiveUpdate, GivesEachWarningOnce)
{
  const auto mesh = MakeBadPlane();
  vtkNew<vtkPolyData> strip;
  strip->SetStrips(MakeCells({ { 0, 1, 2 } }));
  strip->SetLines(MakeCells({ { 0, 399 } }));
  LiveFilter filter(mesh);
  filter.Run();
  filter->SetConstraintsData(strip); // another run
  EXPECT_GT(filter.RunToTheEnd(), 2);
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  ExpectHolds(filter.GetWarnings()[0], "second input: triangle strips ignored");
  filter->SetTieRuleToCanonical();
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetWarnings().size(), 2u);
  filter->LiveUpdateOff();
  filter.Run();
  EXPECT_EQ(filter.GetWarnings().size(), 3u);
}

TEST(LiveUpdate, GivesWarningsOfPointsOnce)
{
  Watched<vtkDelaunayFlipPoints> points(MakeBadPlane());
  points->DegreesOn();
  points->LiveUpdateOn();
  EXPECT_GT(RunToTheEnd(points), 2);
  ASSERT_EQ(points.GetWarnings().size(), 1u);
  ExpectHolds(points.GetWarnings()[0], "Degrees has no effect");
}

TEST(LiveUpdate, OtherOptionsInputsAndCellsStartAgain)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(MakeBadPlane());
  const auto expectStart = [&filter](const Cells& expected)
  {
    filter.Run();
    EXPECT_EQ(filter->GetNumberOfIterations(), 1);
    filter->Advance();
    filter.RunToTheEnd();
    EXPECT_EQ(filter.GetPolygons(), expected);
  };
  filter.RunToTheEnd();
  filter->SetInputData(mesh);
  expectStart(FlipAtOnce(mesh));
  const auto setAngle = [](vtkDelaunayFlip* flip) { flip->SetFeatureAngle(180.0); };
  setAngle(filter.Get());
  expectStart(FlipAtOnce(mesh, setAngle));
  filter->Restart();
  EXPECT_FALSE(filter->GetNeedsUpdate());
  expectStart(FlipAtOnce(mesh, setAngle));
  auto rhombus = MakeRhombus();
  filter->SetInputData(rhombus);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  rhombus->SetPolys(MakeCells({ { 0, 1, 2 } }));
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetPolygons(), (Cells{ { 0, 1, 2 } }));
  rhombus->SetPolys(MakeCells({ { 0, 1, 2 }, { 0, 2, 3 } }));
  rhombus->SetLines(MakeCells({ { 0, 2 } }));
  filter.RunToTheEnd();
  EXPECT_FALSE(HasEdge(filter->GetOutput(), 1, 3));
  filter->SetInputData(vtkNew<vtkPolyData>());
  EXPECT_EQ(filter.RunToTheEnd(), 1);
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
}

TEST(LiveUpdate, OtherStepsOutputsAndAttributesGoOn)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  filter->SetIterationsPerUpdate(2);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 3);
  filter->GenerateFlipCountOn();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_NE(filter->GetOutput()->GetCellData()->GetArray("vtkDelaunayFlipCount"), nullptr);
  AddNumbers(mesh->GetPointData(), "Number", mesh->GetNumberOfPoints(), 100);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 7);
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetPointData(), "Number")[0], 100);
  filter->LiveUpdateOff(); // flips at once
  filter.Run();
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter.GetPolygons(), FlipAtOnce(mesh));
}

TEST(LiveUpdate, OtherVertsStartAgain)
{
  auto mesh = MakeQuadAndTriangle();
  LiveFilter filter(mesh);
  for (const Cells& verts : { Cells{ { 0 } }, Cells{ { 0 }, { 1 }, { 2 } } })
  {
    mesh->SetVerts(MakeCells(verts));
    AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
    filter.RunToTheEnd();
  }
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetCellData(), "Number"),
    (std::vector<int>{ 0, 1, 2, 3, 3, 4 }));
}

TEST(LiveUpdate, GoesOnWhereInputsAreMadeAgain)
{
  auto mesh = MakeBadPlane();
  vtkNew<vtkStringArray> regions;
  regions->SetName("Region");
  regions->SetNumberOfValues(mesh->GetNumberOfCells());
  mesh->GetCellData()->AddArray(regions);
  vtkNew<vtkCleanPolyData> makers[2];
  makers[0]->SetInputData(mesh);
  makers[1]->SetInputData(MakeLines({ { -9, 0, 0 }, { -9, 1, 0 } }, { { 0, 1 } }));
  makers[0]->Update();
  const Cells expected = FlipAtOnce(makers[0]->GetOutput());
  LiveFilter filter(mesh);
  filter->SetRegionArray("Region");
  for (int port = 0; port < 2; ++port)
  {
    makers[port]->ReleaseDataFlagOn(); // so that every update executes it
    filter->SetInputConnection(port, makers[port]->GetOutputPort());
  }
  filter.RunToTheEnd();
  EXPECT_GT(filter->GetNumberOfIterations(), 5);
  EXPECT_EQ(filter.GetPolygons(), expected);
  Shear(mesh, 0.05);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  regions->SetValue(0, "other");
  regions->Modified();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter->Advance();
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 2);
}

TEST(LiveUpdate, RestartsAfterTheUpdateAtWork)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter->Advance();
  OnProgress(filter.Get(),
    [&filter]()
    {
      if (filter->GetProgress() > 0.0 && filter->GetProgress() < 1.0)
      {
        filter->Restart();
      }
    });
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 2);
  filter->RemoveAllObservers();
  EXPECT_TRUE(filter->Advance());
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
}

TEST(LiveUpdate, EndsWithoutAMesh)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter->SetInputDataObject(vtkNew<vtkMultiBlockDataSet>());
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetSession(), nullptr);
}

TEST(LiveUpdate, BlocksAreFlippedAtOnce)
{
  WatchedFilter filter(MakeBlocks({ MakeBadPlane() }));
  filter->LiveUpdateOn();
  ExpectHolds(RunToWarning(filter), "LiveUpdate");
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_FALSE(filter->GetNeedsUpdate());
  EXPECT_FALSE(filter->Advance());
}

TEST(LivePace, AsManyIterationsAsFit)
{
  // 97 iterations of a few microseconds each. If the machine stalls, a second update is allowed.
  LiveFilter fast(ToPolyData(delaunayflip::MakeWorstCaseMesh(50)));
  fast->SetIterationsPerUpdate(0);
  EXPECT_LT(fast.RunToTheEnd(), 48);
  EXPECT_EQ(fast->GetNumberOfIterations(), 97);

  LiveFilter filter(MakeBadPlane());
  filter->SetIterationsPerUpdate(0);
  OnProgress(filter.Get(), []() { std::this_thread::sleep_for(std::chrono::milliseconds(60)); });
  for (vtkIdType iterations = 1; iterations <= 3; ++iterations)
  {
    filter.Run();
    EXPECT_EQ(filter->GetNumberOfIterations(), iterations);
    filter->Advance();
  }
  OnProgress(filter.Get(), [&]() { filter->SetAbortExecute(filter->GetNumberOfIterations() > 3); });
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 4);
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

TEST(MovedPoints, WarmStart)
{
  auto mesh = MakeBadPlane();
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  LiveFilter filter(mesh);
  const int updates = filter.RunToTheEnd();
  const Cells before = filter.GetPolygons();
  Shear(mesh, 0.0);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(filter.GetPolygons(), before);
  EXPECT_EQ(GetNumbers(filter->GetOutput()->GetCellData(), "Number")[7], 7);
  Shear(mesh, 0.05);
  EXPECT_LT(filter.RunToTheEnd(), updates);
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_LT(filter->GetTotalFlips(), mesh->GetNumberOfPoints());
  EXPECT_EQ(filter->GetOutput()->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(CountViolations(filter->GetOutput()), 0);
}

TEST(MovedPoints, FixedEdgesTravelAlong)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(mesh);
  filter->SetFeatureAngle(12.0);
  filter->SetBackendToThreads(); // on a GPU every move begins another session
  filter.RunToTheEnd();
  const double fixedBefore = GetTotal(filter->GetOutput(), "FixedEdges");
  const auto countSharp = [&filter] { return filter->GetSession()->GetReport().Edges.Feature; };
  const std::int64_t sharpBefore = countSharp();
  ASSERT_GT(sharpBefore, 0);
  for (int i = 0; i < 2; ++i)
  {
    Shear(mesh, 0.3);
    filter.RunToTheEnd();
    EXPECT_EQ(GetTotal(filter->GetOutput(), "FixedEdges"), fixedBefore);
    // The session has kept its mesh: a new one would know that they stay, but not why.
    EXPECT_EQ(countSharp(), sharpBefore);
  }
  EXPECT_GT(filter->GetTotalFlips(), 0);
  ReplacePoints<vtkFloatArray>(mesh); // in another session, with the same edges
  filter.RunToTheEnd();
  EXPECT_EQ(countSharp(), 0);
  EXPECT_EQ(GetTotal(filter->GetOutput(), "FixedEdges"), fixedBefore);

  // A roof that becomes flat: the ridge stays, although in a flat rhombus it would flip.
  auto roof = MakeRhombus();
  Bend(roof, 1.0);
  LiveFilter flat(roof);
  flat->SetGeometryToSurface();
  flat.RunToTheEnd();
  EXPECT_TRUE(HasEdge(flat->GetOutput(), 0, 2));
  Bend(roof, 0.0);
  flat.RunToTheEnd();
  EXPECT_TRUE(HasEdge(flat->GetOutput(), 0, 2));
  flat->Restart();
  flat.RunToTheEnd();
  EXPECT_TRUE(HasEdge(flat->GetOutput(), 1, 3));
}

TEST(MovedPoints, OfAnotherGeometryStartAgain)
{
  auto rhombus = MakeRhombus();
  LiveFilter filter(rhombus);
  filter.RunToTheEnd();
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  Bend(rhombus, 1.0);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_SURFACE);
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 0, 2));

  // Flips in space turn triangles over in x and y. So a run that changes to x and y must start from
  // the input, not from the flipped triangles.
  const auto scale = [](vtkPolyData* mesh, double height)
  {
    int point = 0;
    MovePoints(mesh, [&](double* x) { x[2] = height * (point++ % 7) / 7.0; });
  };
  auto hills = MakeBadPlane();
  scale(hills, 0.5);
  filter->SetInputData(hills);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_SURFACE);
  EXPECT_GT(filter->GetTotalFlips(), 0);
  scale(hills, 1e-5);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_PLANAR_XY);
  EXPECT_EQ(FlipAtOnceXY(hills), filter.GetPolygons());
}

TEST(MovedPoints, KeepTheirPrecision)
{
  // 400 points in 10 x 10 m, at 1e7 m, where floats are 1 m apart: rounding would make most
  // coincide.
  auto mesh = MakeBadPlane();
  MovePoints(mesh,
    [](double* x)
    {
      x[2] = x[0] * x[1];
      x[0] = 10.0 * x[0] + 1e7;
      x[1] = 10.0 * x[1] + 1e7;
    });
  LiveFilter filter(mesh);
  filter->SetGeometryToPlanarXY();
  filter->SetIterationsPerUpdate(3);
  filter.Run();
  for (const double factor : { 0.3, -0.5 })
  {
    Shear(mesh, factor); // the first time in the middle of a run
    filter.RunToTheEnd();
    EXPECT_TRUE(filter->GetConverged());
    EXPECT_GT(filter->GetTotalFlips(), 0);
    EXPECT_EQ(filter->GetNonDelaunayAfter(), 0);
    EXPECT_EQ(FlipAtOnceXY(filter->GetOutput()), filter.GetPolygons());
  }
  EXPECT_TRUE(filter.GetWarnings().empty());
}

TEST(WithheldMesh, IsPutOutByTheNextUpdate)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  EXPECT_EQ(filter->GetSession(), nullptr);
  EXPECT_TRUE(filter->AdvanceSession()); // the first step is put out
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter.GetPolygons(), MakeSteps(mesh, 1));
  ASSERT_NE(filter->GetSession(), nullptr);
  EXPECT_EQ(filter->GetSession()->GetReport().Iterations.size(), 1u);
  for (int steps = 2; steps < 6; ++steps)
  {
    EXPECT_TRUE(filter->AdvanceSession());
    EXPECT_TRUE(filter->GetMeshIsWithheld());
    EXPECT_EQ(GetCells(filter->GetOutput()->GetPolys()), MakeSteps(mesh, 1)); // as it was
    EXPECT_EQ(filter->GetNumberOfIterations(), steps);
    EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), steps);
    EXPECT_EQ(GetSessionCells(filter), MakeSteps(mesh, steps));
  }
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_EQ(GetCells(filter.Run()->GetPolys()), MakeSteps(mesh, 5));
    EXPECT_FALSE(filter->GetMeshIsWithheld());
    EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  }
  EXPECT_TRUE(filter->AdvanceSession());
  EXPECT_TRUE(filter->Advance()); // a step that is asked for is made
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), MakeSteps(mesh, 7));
  int steps = 7;
  while (filter->GetStopReason() == vtkDelaunayFlip::STOP_REASON_RUNNING)
  {
    filter->AdvanceSession();
    ASSERT_EQ(filter->GetNumberOfIterations(), ++steps);
  }
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), FlipAtOnce(mesh));
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_FALSE(filter->Advance());
  EXPECT_TRUE(filter.GetErrors().empty() && filter.GetWarnings().empty());
}

TEST(WithheldMesh, NotOfOtherRunsAndFailures)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  const auto expectStep = [&filter](bool isWithheld)
  {
    filter->AdvanceSession();
    EXPECT_EQ(filter->GetMeshIsWithheld(), isWithheld);
  };
  expectStep(false);
  expectStep(true);
  filter->SetTieRuleToCanonical();
  expectStep(false);
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  expectStep(true);
  Shear(mesh, 0.5);
  expectStep(false);
  expectStep(true);
  filter->Restart();
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter->GetSession(), nullptr);
  expectStep(false);
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  expectStep(true);
  filter->SetGeometryToSurface(); // where ties cannot be canonical
  expectStep(false);
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
  EXPECT_EQ(filter->GetSession(), nullptr);
  filter->SetGeometryToAuto();
  filter->LiveUpdateOff();
  EXPECT_TRUE(filter->AdvanceSession());
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter->GetSession(), nullptr);
}
