// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Quads, polygons, strips and cells with too few points.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

namespace
{

const Points Grid = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 2, 1, 0 },
  { 0, 2, 0 }, { 1, 2, 0 }, { 2, 2, 0 } };

std::vector<int> RunAndGetNumbers(vtkPolyData* mesh)
{
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  return GetNumbers(RunCleanly(filter)->GetCellData(), "Number");
}

}

TEST(VtkDelaunayFlip, QuadsSplitAlongTheirFirstDiagonal)
{
  auto mesh = MakeMesh(Grid, { { 0, 1, 4, 3 }, { 1, 2, 5, 4 } });
  EXPECT_EQ(RunAndGetNumbers(mesh), std::vector<int>({ 0, 0, 1, 1 }));
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_TRUE(HasEdge(output, 0, 4));
  EXPECT_TRUE(HasEdge(output, 1, 5));
  EXPECT_EQ(filter->GetTotalFlips(), 0); // both quads are ties
}

TEST(VtkDelaunayFlip, ConcaveQuadsSplitInside)
{
  // An arrow head: because of its reflex corner, point 3, diagonal 0-2 runs outside.
  auto mesh = MakeMesh({ { 0, 0, 0 }, { 2, 1, 0 }, { 0, 2, 0 }, { 1, 1, 0 } }, { { 0, 1, 2, 3 } });
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetNumberOfCells(), 2);
  EXPECT_TRUE(HasEdge(output, 1, 3));
}

TEST(VtkDelaunayFlip, CellDataFollowMixedPolygons)
{
  auto mesh = MakeMesh(Grid, { { 0, 1, 4, 3 }, { 1, 2, 4 }, { 4, 2, 5, 8, 7 }, { 3, 4, 7, 6 } });
  EXPECT_EQ(RunAndGetNumbers(mesh), std::vector<int>({ 0, 0, 1, 2, 2, 2, 3, 3 }));
}

TEST(VtkDelaunayFlip, StringCellDataFollowToo)
{
  auto mesh = MakeMesh(Grid, { { 0, 1, 4, 3 }, { 1, 2, 5, 4 } });
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  names->InsertNextValue("left");
  names->InsertNextValue("right");
  mesh->GetCellData()->AddArray(names);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  auto* copy = vtkStringArray::SafeDownCast(output->GetCellData()->GetAbstractArray("Name"));
  ASSERT_NE(copy, nullptr);
  ASSERT_EQ(copy->GetNumberOfValues(), 4);
  EXPECT_EQ(copy->GetValue(1), "left");
  EXPECT_EQ(copy->GetValue(2), "right");
}

TEST(VtkDelaunayFlip, StripsFollowThePolygons)
{
  auto mesh = MakeMesh(Grid, { { 3, 4, 6 }, { 4, 7, 6 } });
  mesh->SetVerts(MakeCells({ { 8 } }));
  mesh->SetStrips(MakeCells({ { 3, 0, 4, 1, 5, 2 } }));
  EXPECT_EQ(RunAndGetNumbers(mesh), std::vector<int>({ 0, 1, 2, 3, 3, 3, 3 }));

  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetNumberOfStrips(), 0);
  // All have the same winding: that of a strip's odd triangles is reversed.
  EXPECT_EQ(GetCell(output, 3), Cell({ 3, 0, 4 }));
  EXPECT_EQ(GetCell(output, 4), Cell({ 4, 0, 1 }));
  EXPECT_EQ(filter->GetNumberOfNonDelaunayEdges(), 0);
}

TEST(VtkDelaunayFlip, TrianglesOfQuadsFlip)
{
  // The rhombus as one quad, which is first split along 0-2.
  auto mesh =
    MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
  EXPECT_TRUE(HasEdge(output, 1, 3));
}

TEST(VtkDelaunayFlip, CellsOfTooFewPointsPass)
{
  auto mesh = MakeRhombus();
  mesh->SetPolys(MakeCells({ { 0, 1 }, { 0, 1, 2 }, {}, { 0, 2, 3 }, { 2 } }));
  mesh->SetStrips(MakeCells({ { 1, 2 }, { 3 } }));
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  const Cells polygons = GetCells(output->GetPolys());
  ASSERT_EQ(polygons.size(), 5u);
  EXPECT_EQ(polygons[0], Cell({ 0, 1 }));
  EXPECT_EQ(polygons[2], Cell());
  EXPECT_EQ(polygons[4], Cell({ 2 }));
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 1, 2 }, { 3 } }));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 0, 1, 2, 3, 4, 5, 6 }));
}

TEST(VtkDelaunayFlip, StripsOfTooFewPointsPassAlone)
{
  for (const bool triangulate : { false, true })
  {
    auto mesh = MakeMesh(Grid, {});
    mesh->SetStrips(MakeCells({ { 1, 2 }, { 3 }, {} }));
    AddNumbers(mesh->GetCellData(), "Number", 3, 5);
    WatchedFilter filter(mesh);
    filter->SetTriangulate(triangulate);
    auto output = RunCleanly(filter);
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 1, 2 }, { 3 }, {} }));
    EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 5, 6, 7 }));
    EXPECT_TRUE(filter->GetConverged());
  }
}

TEST(VtkDelaunayFlip, AQuadThatFoldsIsSplitTheOtherWay)
{
  auto mesh =
    MakeMesh({ { 0, 4, 0 }, { -1, 0, 2 }, { 0, -4, 0 }, { 1, 0, 2 } }, { { 0, 1, 2, 3 } });
  WatchedFilter filter(mesh);
  filter->SetMaximumIterations(0);
  EXPECT_TRUE(HasEdge(RunCleanly(filter), 1, 3));
}

TEST(VtkDelaunayFlip, TriangulateOffKeepsOtherCells)
{
  // The rhombus with a quad below its left side and a strip above its right side.
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { -3, -3, 0 },
                         { 0, -3, 0 }, { 3, 3, 0 }, { 0, 4, 0 } },
    { { 4, 5, 1, 0 }, { 0, 1, 2 }, { 0, 2, 3 } });
  mesh->SetStrips(MakeCells({ { 2, 6, 3, 7 } }));
  AddNumbers(mesh->GetCellData(), "Number", 4, 0);
  WatchedFilter filter(mesh);
  filter->TriangulateOff();
  filter->GenerateFlipCountOn();
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 1);
  EXPECT_EQ(GetCell(output, 0), Cell({ 4, 5, 1, 0 }));
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(GetCells(output->GetStrips()), Cells({ { 2, 6, 3, 7 } }));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>({ 0, 1, 2, 3 }));
  EXPECT_EQ(
    GetNumbers(output->GetCellData(), "vtkDelaunayFlipCount"), std::vector<int>({ 0, 1, 1, 0 }));
}

TEST(VtkDelaunayFlip, TriangulateOffFixesTheirEdges)
{
  // A flat quad, and a triangle at its side 0-2. This edge is bad, but stays.
  auto mesh =
    MakeMesh({ { -3, 0, 0 }, { 3, 0, 0 }, { 0, 0.5, 0 }, { 1, -0.5, 0 }, { -1, -0.5, 0 } },
      { { 0, 1, 2 }, { 1, 0, 4, 3 } });
  WatchedFilter filter(mesh);
  RunCleanly(filter);
  EXPECT_GT(filter->GetTotalFlips(), 0);
  filter->TriangulateOff();
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(GetCells(output->GetPolys()), GetCells(mesh->GetPolys()));
}
