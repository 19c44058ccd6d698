// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The automatic tolerance, with the output of VTK's own sources.

#include "FilterTestSupport.h"

#include "vtkAlgorithm.h"
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
