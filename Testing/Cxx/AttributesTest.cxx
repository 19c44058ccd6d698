// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What happens to points, point data and cell data.

#include "FilterTestSupport.h"

#include "FlipReport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

/// The rhombus with a vert, a line along its boundary, and cells numbered 10, 11, 12, 13.
vtkSmartPointer<vtkPolyData> MakeMixedRhombus()
{
  auto mesh = MakeRhombus();
  mesh->SetVerts(MakeCells({ { 3 } }));
  mesh->SetLines(MakeCells({ { 0, 1 } }));
  AddNumbers(mesh->GetCellData(), "Number", 4, 10);
  return mesh;
}

void SetCellNormals(vtkPolyData* mesh, double z)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    normals->InsertNextTuple3(0.0, 0.0, z);
  }
  mesh->GetCellData()->SetNormals(normals);
}

/// Two triangles over the square -1..1, folded by about 20 degrees along the diagonal 0-2, and a
/// third, level one without edges that may flip.
vtkSmartPointer<vtkPolyData> MakeFoldedRhombus()
{
  return MakeMesh({ { -3, 0, 0 }, { 0, -1, 0.1 }, { 3, 0, 0 }, { 0, 1, 0.1 }, { 10, 0, 0 },
                    { 11, 0, 0 }, { 10, 1, 0 } },
    { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 } });
}

constexpr double Degrees = 180.0 / 3.14159265358979323846;

void ExpectAngles(vtkPolyData* mesh, const char* name, const std::vector<double>& expected)
{
  auto* angles = vtkDoubleArray::SafeDownCast(mesh->GetCellData()->GetArray(name));
  ASSERT_NE(angles, nullptr) << name;
  ASSERT_EQ(angles->GetNumberOfTuples(), static_cast<vtkIdType>(expected.size()));
  for (std::size_t cell = 0; cell < expected.size(); ++cell)
  {
    const double angle = angles->GetValue(static_cast<vtkIdType>(cell));
    const bool areBothNaN = std::isnan(angle) && std::isnan(expected[cell]);
    EXPECT_TRUE(areBothNaN || std::fabs(angle - expected[cell]) < 1e-12)
      << name << " of " << cell << ": " << angle << " is not " << expected[cell];
  }
}

}

TEST(VtkDelaunayFlip, PointsAreTheSameObject)
{
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(200, 1));
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_GT(CountViolations(mesh), 0);
  EXPECT_EQ(CountViolations(output), 0);
}

TEST(VtkDelaunayFlip, PointDataPass)
{
  auto mesh = MakeRhombus();
  AddNumbers(mesh->GetPointData(), "Depth", 4, 5);
  mesh->GetPointData()->SetActiveScalars("Depth");
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  names->SetNumberOfValues(4);
  mesh->GetPointData()->AddArray(names);

  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPointData()->GetScalars(), mesh->GetPointData()->GetScalars());
  EXPECT_EQ(output->GetPointData()->GetAbstractArray("Name"), names);
}

TEST(VtkDelaunayFlip, CellDataStayWithTheirSlots)
{
  auto mesh = MakeMixedRhombus();
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_FALSE(HasEdge(output, 0, 2));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 10, 11, 12, 13 }));
}

TEST(VtkDelaunayFlip, VertsAndLinesPass)
{
  auto mesh = MakeMixedRhombus();
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(GetCells(output->GetVerts()), Cells({ { 3 } }));
  EXPECT_EQ(GetCells(output->GetLines()), Cells({ { 0, 1 } }));
  EXPECT_EQ(output->GetNumberOfCells(), 4);
}

TEST(VtkDelaunayFlip, InputIsUntouched)
{
  auto mesh = MakeMixedRhombus();
  SetCellNormals(mesh, 1.0);
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(mesh);
  WatchedFilter filter(mesh);
  filter->GenerateFlipCountOn();
  RunCleanly(filter);
  EXPECT_EQ(GetCells(mesh->GetPolys()), GetCells(copy->GetPolys()));
  EXPECT_EQ(mesh->GetCellData()->GetNumberOfArrays(), copy->GetCellData()->GetNumberOfArrays());
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 0);
}

TEST(VtkDelaunayFlip, NormalsOfChangedTrianglesAreRenewed)
{
  auto mesh = MakeFoldedRhombus();
  SetCellNormals(mesh, 0.5); // not of unit length, unlike computed normals
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  ASSERT_EQ(filter->GetTotalFlips(), 1);
  vtkDataArray* normals = output->GetCellData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  // (0, 1, 3) and (1, 2, 3) rise from z = 0 at x = -3 and 3 to 0.1 at x = 0.
  for (vtkIdType cell = 0; cell < 2; ++cell)
  {
    const Cell ids = GetCell(output, cell);
    const double left = std::count(ids.begin(), ids.end(), 0) ? -1.0 : 1.0;
    EXPECT_NEAR(normals->GetComponent(cell, 0), left * 0.1 / std::sqrt(9.01), 1e-6);
    EXPECT_NEAR(normals->GetComponent(cell, 1), 0.0, 1e-6);
    EXPECT_NEAR(normals->GetComponent(cell, 2), 3.0 / std::sqrt(9.01), 1e-6);
  }
  EXPECT_DOUBLE_EQ(normals->GetComponent(2, 2), 0.5);
  EXPECT_DOUBLE_EQ(mesh->GetCellData()->GetNormals()->GetComponent(0, 2), 0.5);
}

TEST(VtkDelaunayFlip, NormalsKeepTheirSide)
{
  auto mesh = MakeRhombus();
  SetCellNormals(mesh, -1.0); // against the winding
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_DOUBLE_EQ(output->GetCellData()->GetNormals()->GetComponent(0, 2), -1.0);
  EXPECT_DOUBLE_EQ(output->GetCellData()->GetNormals()->GetComponent(1, 2), -1.0);
}

TEST(VtkDelaunayFlip, FlipCountsPerTriangle)
{
  auto mesh = MakeMixedRhombus();
  WatchedFilter filter(mesh);
  EXPECT_EQ(RunCleanly(filter)->GetCellData()->GetArray("vtkDelaunayFlipCount"), nullptr);
  filter->GenerateFlipCountOn();
  auto output = RunCleanly(filter);
  EXPECT_EQ(
    GetNumbers(output->GetCellData(), "vtkDelaunayFlipCount"), std::vector<int>({ 0, 0, 1, 1 }));
}

TEST(VtkDelaunayFlip, AnglesPerTriangle)
{
  // Half of the rhombus, and a triangle of 1-3 and an end, whose sides are 2, sqrt 10, sqrt 10.
  const double before = std::atan(1.0 / 3.0) * Degrees, after = 2.0 * before;
  auto mesh = MakeMixedRhombus();
  WatchedFilter filter(mesh);
  vtkCellData* data = RunCleanly(filter)->GetCellData();
  EXPECT_EQ(data->GetArray("vtkDelaunayFlipAngleBefore"), nullptr);
  EXPECT_EQ(data->GetArray("vtkDelaunayFlipAngleAfter"), nullptr);
  filter->GenerateQualityOn();
  auto output = RunCleanly(filter);
  ExpectAngles(output, "vtkDelaunayFlipAngleBefore", { NAN, NAN, before, before });
  ExpectAngles(output, "vtkDelaunayFlipAngleAfter", { NAN, NAN, after, after });
}

TEST(VtkDelaunayFlip, AnglesOfSplitAndOtherCells)
{
  // The rhombus as a quad, a quad that stays, a degenerate triangle, and one with a NaN.
  const Points points = { { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 9, 0, 0 },
    { 10, 0, 0 }, { 11, 0, 0 }, { NAN, 1, 0 } };
  const double before = std::atan(1.0 / 3.0) * Degrees, after = 2.0 * before;
  WatchedFilter filter(MakeMesh(points, { { 0, 1, 2, 3 }, { 4, 5, 6 }, { 5, 6, 7 }, { 4, 5 } }));
  filter->GenerateQualityOn();
  filter->SetGeometryToPlanarXY();
  ExpectAngles(filter.Run(), "vtkDelaunayFlipAngleBefore", { before, before, 0, NAN, NAN });
  ExpectAngles(filter.Run(), "vtkDelaunayFlipAngleAfter", { after, after, 0, NAN, NAN });
  filter->TriangulateOff();
  ExpectAngles(filter.Run(), "vtkDelaunayFlipAngleAfter", { NAN, 0, NAN, NAN });
}

TEST(VtkDelaunayFlip, AnglesOfTerrainAreThoseOfItsProjection)
{
  auto mesh = MakeRhombus();
  mesh->GetPoints()->SetPoint(1, 0, -1, 50);
  WatchedFilter filter(mesh);
  filter->SetGeometryToPlanarXY();
  filter->GenerateQualityOn();
  const double angle = std::atan(1.0 / 3.0) * Degrees;
  auto output = RunCleanly(filter);
  ExpectAngles(output, "vtkDelaunayFlipAngleBefore", { angle, angle });
  vtkDataArray* after = output->GetCellData()->GetArray("vtkDelaunayFlipAngleAfter");
  EXPECT_DOUBLE_EQ(filter->GetReport().MinimumAngleAfter, after->GetRange()[0]);
}

TEST(VtkDelaunayFlip, GlobalIdsStayWhereNoCellIsSplit)
{
  auto mesh = MakeRhombus();
  AddNumbers(mesh->GetCellData(), "Id", 2, 7);
  mesh->GetCellData()->SetActiveGlobalIds("Id");
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_NE(output->GetCellData()->GetGlobalIds(), nullptr);
  EXPECT_EQ(output->GetCellData()->GetPedigreeIds(), nullptr);
}

TEST(VtkDelaunayFlip, GlobalIdsBecomePedigreeIdsWhereACellIsSplit)
{
  auto mesh = MakeMesh({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 }, { 1, 3, 0 } },
    { { 3, 2, 4 }, { 0, 1, 2, 3 } });
  AddNumbers(mesh->GetCellData(), "Id", 2, 7);
  mesh->GetCellData()->SetActiveGlobalIds("Id");
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetCellData()->GetGlobalIds(), nullptr);
  ASSERT_NE(output->GetCellData()->GetPedigreeIds(), nullptr);
  EXPECT_STREQ(output->GetCellData()->GetPedigreeIds()->GetName(), "Id");
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Id"), std::vector<int>({ 7, 8, 8 }));
  EXPECT_NE(mesh->GetCellData()->GetGlobalIds(), nullptr);
}
