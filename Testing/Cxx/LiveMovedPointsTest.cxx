// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live updates of a mesh whose points move.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"

#include <gtest/gtest.h>

namespace
{

vtkIdType CountFixedEdges(vtkDelaunayFlip* filter)
{
  return static_cast<vtkIdType>(
    filter->GetOutput()->GetFieldData()->GetArray("DelaunayFlip:FixedEdges")->GetTuple1(0));
}

/// The triangles of a mesh after a single update by x and y.
Cells FlipAtOnceXY(vtkPolyData* mesh)
{
  WatchedFilter filter(mesh);
  filter->SetGeometryToPlanarXY();
  return GetCells(RunCleanly(filter)->GetPolys());
}

}

TEST(LiveUpdate, MovedPointsWarmStart)
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
  // A roof along 0-2 that becomes flat: the ridge stays, although in a flat rhombus it would flip.
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

TEST(LiveUpdate, SteepHillsThatBecomeGentleStartAgain)
{
  // Flips in space turn triangles over in x and y. So a run that changes to x and y must start from
  // the input, not from the flipped triangles.
  const auto scale = [](vtkPolyData* mesh, double height)
  {
    for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
    {
      double x[3];
      mesh->GetPoint(point, x);
      mesh->GetPoints()->SetPoint(point, x[0], x[1], height * static_cast<double>(point % 7) / 7.0);
    }
    mesh->GetPoints()->Modified();
  };
  auto mesh = MakeBadPlane();
  scale(mesh, 0.5);
  LiveFilter filter(mesh);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_SURFACE);
  EXPECT_GT(filter->GetTotalFlips(), 0);
  scale(mesh, 1e-5);
  filter.RunToTheEnd();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_PLANAR_XY);
  EXPECT_EQ(FlipAtOnceXY(mesh), filter.GetTriangles());
}

TEST(LiveUpdate, QuadsWarmStart)
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

TEST(LiveUpdate, MovedPointsKeepTheirPrecision)
{
  // 400 points in 10 x 10 m, at 1e7 m, where floats are 1 m apart: rounding would make most
  // coincide.
  auto mesh = MakeBadPlane();
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    mesh->GetPoints()->SetPoint(point, 10.0 * x[0] + 1e7, 10.0 * x[1] + 1e7, x[0] * x[1]);
  }
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
    EXPECT_EQ(filter->GetNumberOfNonDelaunayEdges(), 0);
    EXPECT_EQ(FlipAtOnceXY(filter->GetOutput()), filter.GetTriangles());
  }
  EXPECT_TRUE(filter.GetWarnings().empty());
}
