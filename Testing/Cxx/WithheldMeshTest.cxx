// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Steps of a live run that leave the mesh in the session.

#include "DelaunayFlip.h"
#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

namespace
{

Cells StoreMesh(LiveFilter& filter)
{
  vtkNew<vtkPolyData> mesh;
  EXPECT_TRUE(filter->StoreMesh(mesh));
  return GetCells(mesh->GetPolys());
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
  return GetCells(filter->GetOutput()->GetPolys());
}

}

TEST(WithheldMesh, TheFirstStepIsPutOut)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  EXPECT_EQ(filter->GetSession(), nullptr);
  EXPECT_FALSE(filter->StoreMesh(vtkNew<vtkPolyData>()));
  EXPECT_TRUE(filter->AdvanceSession());
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(GetCells(filter->GetOutput()->GetPolys()), MakeSteps(mesh, 1));
  ASSERT_NE(filter->GetSession(), nullptr);
  EXPECT_EQ(filter->GetSession()->GetReport().Iterations.size(), 1u);
}

TEST(WithheldMesh, TheNextUpdatePutsItOut)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  for (int steps = 2; steps < 6; ++steps)
  {
    EXPECT_TRUE(filter->AdvanceSession());
    EXPECT_TRUE(filter->GetMeshIsWithheld());
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetNumberOfIterations(), steps);
    EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), steps);
    EXPECT_EQ(StoreMesh(filter), MakeSteps(mesh, steps));
  }
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), MakeSteps(mesh, 5));
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_TRUE(filter->Advance());
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 6);
}

TEST(WithheldMesh, RunsEndAsUsual)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  int steps = 1;
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

TEST(WithheldMesh, AStepThatIsAskedForIsMade)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  filter->AdvanceSession();
  EXPECT_TRUE(filter->Advance());
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), MakeSteps(mesh, 3));
}

TEST(WithheldMesh, OtherRunsArePutOut)
{
  auto mesh = MakeBadPlane();
  LiveFilter filter(mesh);
  filter.Run();
  filter->AdvanceSession();
  filter->SetTieRuleToCanonical();
  filter->AdvanceSession();
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter->AdvanceSession();
  EXPECT_TRUE(filter->GetMeshIsWithheld());
  Shear(mesh, 0.5);
  filter->AdvanceSession();
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  filter->AdvanceSession();
  filter->Restart();
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter->GetSession(), nullptr);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
}

TEST(WithheldMesh, AFailureWithholdsNothing)
{
  LiveFilter filter(MakeBadPlane());
  filter.Run();
  filter->AdvanceSession();
  filter->SetTieRuleToCanonical();
  filter->SetGeometryToSurface();
  filter->AdvanceSession();
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_EQ(filter->GetSession(), nullptr);
}

TEST(WithheldMesh, NotWithoutLiveUpdate)
{
  WatchedFilter filter(MakeBadPlane());
  EXPECT_TRUE(filter->AdvanceSession());
  EXPECT_FALSE(filter->GetMeshIsWithheld());
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter->GetSession(), nullptr);
}
