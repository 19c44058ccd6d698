// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The automatic tolerance, with the output of VTK's own sources.

#include "FilterTestSupport.h"

#include "vtkAlgorithm.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

namespace
{

/// A sphere whose quads are divided along a diagonal; both diagonals are tied.
vtkSmartPointer<vtkPolyData> MakeSphere(int precision, double x, double y)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(300);
  source->SetPhiResolution(100);
  source->SetRadius(100.0);
  source->SetCenter(x, y, 0.0);
  source->SetOutputPointsPrecision(precision);
  source->Update();
  return source->GetOutput();
}

}

TEST(VtkDelaunayFlip, SpheresOfVtkStayAsTheyAre)
{
  for (const int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION })
  {
    for (const double distance : { 0.0, 5e6 })
    {
      SCOPED_TRACE(testing::Message() << "precision " << precision << ", distance " << distance);
      auto sphere = MakeSphere(precision, 0.1 * distance, distance);
      WatchedFilter filter(sphere);
      filter->SetGeometryToSurface();
      // Far away, rounding to float leaves triangles without area at the poles, which gives a
      // warning.
      vtkPolyData* output = filter.Run();
      EXPECT_TRUE(filter.GetErrors().empty());
      EXPECT_EQ(filter->GetTotalFlips(), 0);
      EXPECT_EQ(filter->GetNumberOfNonDelaunayEdges(), 0);
      EXPECT_EQ(GetCells(output->GetPolys()), GetCells(sphere->GetPolys()));
    }
  }
}

TEST(VtkDelaunayFlip, SmallToleranceFlipsWhatRoundingMade)
{
  WatchedFilter filter(MakeSphere(vtkAlgorithm::SINGLE_PRECISION, 0.0, 0.0));
  filter->SetTolerance(1e-9);
  RunCleanly(filter);
  EXPECT_GT(filter->GetTotalFlips(), 10000);
}

/// Also if it is the same for several blocks, and in every step of a live run.
TEST(VtkDelaunayFlip, AToleranceWithoutEffectIsWarnedOfOnce)
{
  const std::string expected = "Tolerance has no effect on the in-circle criterion";
  for (const bool isLive : { false, true })
  {
    WatchedFilter filter(MakeRhombus());
    filter->SetTolerance(0.0);
    filter->SetLiveUpdate(isLive);
    for (int i = 0; i < 3; ++i)
    {
      filter.Run();
      filter->Advance();
    }
    ASSERT_EQ(filter.GetWarnings().size(), 1u);
    EXPECT_TRUE(Holds(filter.GetWarnings()[0], expected)) << filter.GetWarnings()[0];
  }
  WatchedFilter blocks;
  vtkNew<vtkMultiBlockDataSet> two;
  two->SetBlock(0, MakeRhombus());
  two->SetBlock(1, MakeRhombus());
  blocks->SetInputDataObject(two);
  blocks->SetTolerance(0.5);
  blocks->Update();
  ASSERT_EQ(blocks.GetWarnings().size(), 1u);
  EXPECT_TRUE(Holds(blocks.GetWarnings()[0], "block 1, block 2: " + expected))
    << blocks.GetWarnings()[0];
  WatchedFilter filter(MakeRhombus());
  filter->SetTolerance(0.5);
  filter->SetCriterionToOppositeAngles();
  RunCleanly(filter);
}
