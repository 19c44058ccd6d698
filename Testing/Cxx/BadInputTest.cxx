// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Input that is wrong, dirty or empty.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkTypeInt32Array.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// The only error for a mesh, whose output must be empty.
std::string GetError(WatchedFilter& filter)
{
  vtkPolyData* output = filter.Run();
  EXPECT_EQ(output->GetNumberOfCells(), 0);
  EXPECT_EQ(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_FAILED);
  EXPECT_EQ(filter.GetErrors().size(), 1u);
  return filter.GetErrors().empty() ? "" : filter.GetErrors()[0];
}

std::string GetWarning(WatchedFilter& filter)
{
  filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  EXPECT_EQ(filter.GetWarnings().size(), 1u);
  return filter.GetWarnings().empty() ? "" : filter.GetWarnings()[0];
}

}

TEST(VtkDelaunayFlip, EmptyInputPasses)
{
  vtkNew<vtkPolyData> empty;
  WatchedFilter filter(empty);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfColumns(), 8);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
  EXPECT_TRUE(filter->GetConverged());
}

TEST(VtkDelaunayFlip, InputWithoutPolygonsPasses)
{
  auto mesh = MakeMesh({ { 0, 0, 0 }, { 1, 0, 0 } }, {});
  mesh->SetLines(MakeCells({ { 0, 1 } }));
  AddNumbers(mesh->GetCellData(), "Number", 1, 4);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(output->GetNumberOfLines(), 1);
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 4 }));
}

TEST(VtkDelaunayFlip, TriangleOutOfRangeIsAnError)
{
  for (const vtkIdType id : { 4, -1, 1 << 30 })
  {
    auto mesh = MakeRhombusAnd({}, { { 0, 1, id } });
    mesh->SetVerts(MakeCells({ { 0 } })); // so that the ids of polygons do not start at 0
    WatchedFilter filter(mesh);
    const std::string error = GetError(filter);
    EXPECT_TRUE(Holds(error, "cell 3")) << error;
    EXPECT_TRUE(Holds(error, "point " + std::to_string(id))) << error;
  }
}

TEST(VtkDelaunayFlip, PolygonOutOfRangeIsAnError)
{
  for (const vtkIdType id : { 4, -1, 1 << 30 })
  {
    WatchedFilter filter(MakeRhombusAnd({}, { { 0, 1, id, 3, 2 } }));
    const std::string error = GetError(filter);
    EXPECT_TRUE(Holds(error, "cell 2")) << error;
    EXPECT_TRUE(Holds(error, "point " + std::to_string(id))) << error;
  }
}

TEST(VtkDelaunayFlip, StripOutOfRangeIsAnError)
{
  auto mesh = MakeRhombus();
  mesh->SetStrips(MakeCells({ { 0, 1, 2, 77 } }));
  WatchedFilter filter(mesh);
  const std::string error = GetError(filter);
  EXPECT_TRUE(Holds(error, "cell 2") && Holds(error, "point 77")) << error;
}

TEST(VtkDelaunayFlip, ConstraintOutOfRangeIsAnError)
{
  auto mesh = MakeRhombus();
  mesh->SetLines(MakeCells({ { 0, 2 }, { 1, -5 } }));
  WatchedFilter filter(mesh);
  const std::string error = GetError(filter);
  EXPECT_TRUE(Holds(error, "cell 1") && Holds(error, "point -5")) << error;

  vtkNew<vtkPolyData> constraints;
  constraints->SetPolys(MakeCells({ { 0, 1, 9 } }));
  WatchedFilter second(MakeRhombus());
  second->SetConstraintsData(constraints);
  const std::string other = GetError(second);
  EXPECT_TRUE(Holds(other, "constraint") && Holds(other, "point 9")) << other;
}

TEST(VtkDelaunayFlip, CellsWithoutPointsAreAnError)
{
  vtkNew<vtkPolyData> mesh;
  mesh->SetPolys(MakeCells({ { 0, 1, 2 } }));
  WatchedFilter filter(mesh);
  EXPECT_TRUE(Holds(GetError(filter), "point 0"));
}

TEST(VtkDelaunayFlip, BrokenOffsetsAreAnError)
{
  vtkNew<vtkTypeInt32Array> offsets;
  vtkNew<vtkTypeInt32Array> connectivity;
  for (const int offset : { 0, 3, 600 })
  {
    offsets->InsertNextValue(offset);
  }
  for (const int id : { 0, 1, 2, 0, 2, 3 })
  {
    connectivity->InsertNextValue(id);
  }
  auto mesh = MakeRhombus();
  mesh->GetPolys()->SetData(offsets, connectivity);
  WatchedFilter filter(mesh);
  EXPECT_TRUE(Holds(GetError(filter), "offsets"));
}

TEST(VtkDelaunayFlip, ErrorIsOverWhenTheInputIs)
{
  auto mesh = MakeRhombusAnd({}, { { 0, 1, 99 } });
  WatchedFilter filter(mesh);
  GetError(filter);
  filter->SetInputData(MakeRhombus());
  EXPECT_EQ(filter.Run()->GetNumberOfCells(), 2);
  EXPECT_TRUE(filter->GetConverged());
}

TEST(VtkDelaunayFlip, RepeatedIdsWarnAndStay)
{
  WatchedFilter filter(MakeRhombusAnd({}, { { 1, 1, 2 } }));
  EXPECT_TRUE(Holds(GetWarning(filter), "1 triangle with a repeated point id"));
  EXPECT_EQ(GetCell(filter->GetOutput(), 2), Cell({ 1, 1, 2 }));
}

TEST(VtkDelaunayFlip, DuplicateTrianglesWarnAndStay)
{
  const Points far = { { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 } };
  WatchedFilter filter(MakeRhombusAnd(far, { { 4, 5, 6 }, { 6, 5, 4 } }));
  const std::string warning = GetWarning(filter);
  EXPECT_TRUE(Holds(warning, "1 triangle that repeats another")) << warning;
  EXPECT_EQ(GetCell(filter->GetOutput(), 3), Cell({ 6, 5, 4 }));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
}

TEST(VtkDelaunayFlip, NaNPointsWarnAndStay)
{
  const Points far = { { 10, 0, 0 }, { 11, NAN, 0 }, { 10, 1, INFINITY } };
  auto mesh = MakeRhombusAnd(far, { { 4, 5, 6 } });
  WatchedFilter filter(mesh);
  EXPECT_TRUE(Holds(GetWarning(filter), "2 points with NaN or infinite coordinates"));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
  EXPECT_EQ(filter->GetOutput()->GetPoints(), mesh->GetPoints());
}

TEST(VtkDelaunayFlip, ZeroAreaWarns)
{
  const Points far = { { 10, 0, 0 }, { 11, 0, 0 }, { 12, 0, 0 } };
  WatchedFilter filter(MakeRhombusAnd(far, { { 4, 5, 6 } }));
  EXPECT_TRUE(Holds(GetWarning(filter), "without area"));
  EXPECT_TRUE(HasEdge(filter->GetOutput(), 1, 3));
}

TEST(VtkDelaunayFlip, WarningNamesAPolygonOnce)
{
  const Points far = { { 10, 0, 0 }, { 11, 0, 0 }, { 12, 0, 0 }, { 13, 0, 0 } };
  WatchedFilter filter(MakeRhombusAnd(far, { { 4, 5, 6, 7 } }));
  const std::string warning = GetWarning(filter);
  EXPECT_TRUE(Holds(warning, "2 triangles without area (first: 2)")) << warning;
}

TEST(VtkDelaunayFlip, InvertedTrianglesWarn)
{
  auto mesh = ToPolyData(delaunayflip::MakeGridMesh(4, 4));
  mesh->GetPoints()->SetPoint(12, 20.0, 20.0, 0.0); // the middle, far outside
  WatchedFilter filter(mesh);
  EXPECT_TRUE(Holds(GetWarning(filter), "turn the other way"));
}

TEST(VtkDelaunayFlip, TiesStayBitIdentical)
{
  auto mesh = ToPolyData(delaunayflip::MakeGridMesh(8, 5));
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(GetCells(output->GetPolys()), GetCells(mesh->GetPolys()));
}

TEST(VtkDelaunayFlip, ClockwiseInputStaysClockwise)
{
  auto mesh = MakeMesh(
    { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 2, 1, 0 }, { 3, 2, 0 } });
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  for (const Cell& cell : GetCells(output->GetPolys()))
  {
    double a[3], b[3], c[3];
    output->GetPoint(cell[0], a);
    output->GetPoint(cell[1], b);
    output->GetPoint(cell[2], c);
    EXPECT_LT((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]), 0.0);
  }
}

TEST(VtkDelaunayFlip, WronglyWoundPairsStay)
{
  auto mesh = MakeMesh(
    { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 3, 2 } });
  WatchedFilter filter(mesh);
  EXPECT_TRUE(HasEdge(filter.Run(), 0, 2));
  EXPECT_EQ(filter->GetTotalFlips(), 0);
}

TEST(VtkDelaunayFlip, NonManifoldEdgesStay)
{
  auto mesh = MakeRhombusAnd({ { 0, 0, 2 } }, { { 0, 2, 4 } });
  WatchedFilter filter(mesh);
  filter->SetFeatureAngle(180.0);
  vtkPolyData* output = filter.Run();
  EXPECT_EQ(GetCells(output->GetPolys()), GetCells(mesh->GetPolys()));
  EXPECT_EQ(
    output->GetFieldData()->GetArray("DelaunayFlip:NonManifoldEdges")->GetComponent(0, 0), 1.0);
}

TEST(VtkDelaunayFlip, IsolatedPointsStay)
{
  auto mesh = MakeRhombusAnd({ { 5, 5, 0 }, { 6, 5, 0 } }, {});
  WatchedFilter filter(mesh);
  EXPECT_EQ(RunCleanly(filter)->GetNumberOfPoints(), 6);
}

TEST(VtkDelaunayFlip, UnstructuredGridIsATypeError)
{
  vtkNew<vtkUnstructuredGrid> grid;
  WatchedFilter filter;
  filter->SetInputDataObject(grid);
  filter->Update(); // the executive refuses it
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_NOT_STARTED);
}

TEST(VtkDelaunayFlip, ContradictingOptionsAreErrors)
{
  WatchedFilter canonical(MakeRhombus());
  canonical->SetGeometryToSurface();
  canonical->SetTieRuleToCanonical();
  EXPECT_FALSE(GetError(canonical).empty());

  WatchedFilter tolerance(MakeRhombus());
  tolerance->SetTolerance(1.0);
  EXPECT_FALSE(GetError(tolerance).empty());

  auto bent = MakeRhombus();
  bent->GetPoints()->SetPoint(3, 0, 1, 1);
  WatchedFilter planar(bent);
  planar->SetGeometryToPlanar();
  EXPECT_TRUE(Holds(GetError(planar), "plane"));
}
