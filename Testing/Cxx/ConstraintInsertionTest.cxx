// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Constraints that are not edges of the mesh become edges: InsertConstraints, InsertLines.

#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <sstream>

namespace
{

using Mesh = vtkSmartPointer<vtkPolyData>;

/// A lattice of 7 x 7 unit squares, all cut along the same diagonal; point 8 y + x.
Mesh MakeLattice() { return ToPolyData(delaunayflip::MakeGridMesh(7, 7)); }

/// Lines in ids of the mesh.
Mesh MakeLines(const Cells& lines)
{
  auto mesh = Mesh::New();
  mesh->SetLines(MakeCells(lines));
  return mesh;
}

bool HasEdges(vtkPolyData* mesh, const Cell& chain)
{
  bool all = true;
  for (std::size_t i = 1; i < chain.size(); ++i)
  {
    all = all && HasEdge(mesh, chain[i - 1], chain[i]);
  }
  return all;
}

vtkIdType GetField(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
  return array ? static_cast<vtkIdType>(array->GetTuple1(0)) : -1;
}

const Cells Lines = { { 0, 50, 7 }, { 16, 39 }, { 3, 3 } }; // 16-39 crosses both parts of the first
const Cell FirstChain = { 0, 25, 50 }; // by ids: (0, 0), (1, 3), (2, 6)

}

TEST(ConstraintInsertion, OfTheSecondInputByDefault)
{
  Mesh mesh = MakeLattice();
  AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(MakeLines(Lines));
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(HasEdges(output, FirstChain));
  EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), GetNumbers(mesh->GetCellData(), "Number"));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 2);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 1);
  EXPECT_GE(filter->GetNumberOfConstraintEdges(), 3);
  EXPECT_GT(filter->GetNumberOfConstraintFlips(), 0);
  EXPECT_EQ(GetField(output, "DelaunayFlip:InsertedConstraintEdges"), 2);
  EXPECT_EQ(GetField(output, "DelaunayFlip:ConstraintFlips"), filter->GetNumberOfConstraintFlips());
  vtkIdType flips = 0;
  for (vtkIdType row = 0; row < filter->GetIterations()->GetNumberOfRows(); ++row)
  {
    flips += filter->GetIterations()->GetValueByName(row, "Flipped").ToInt();
  }
  EXPECT_EQ(flips, filter->GetTotalFlips());
}

TEST(ConstraintInsertion, NamesOnceWhatIsNotInserted)
{
  WatchedFilter filter(MakeLattice());
  filter->SetConstraintsData(MakeLines(Lines));
  filter.Run();
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_NE(filter.GetWarnings()[0].find("1 constraint edge"), std::string::npos);
  EXPECT_NE(filter.GetWarnings()[0].find("(first: 16-39)"), std::string::npos)
    << filter.GetWarnings()[0];
}

TEST(ConstraintInsertion, CanBeTurnedOff)
{
  WatchedFilter filter(MakeLattice());
  filter->InsertConstraintsOff();
  filter->SetConstraintsData(MakeLines(Lines));
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 0);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 3);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
}

TEST(ConstraintInsertion, OfLinesOnRequest)
{
  Mesh mesh = MakeLattice();
  mesh->SetLines(MakeCells(Lines));
  WatchedFilter filter(mesh);
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 3);
  filter->InsertLinesOn();
  EXPECT_TRUE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 1);
  filter->LinesAsConstraintsOff();
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfConstraintEdges(), 0);
}

TEST(ConstraintInsertion, FollowsTheOrderOfTheInput)
{
  Mesh mesh = MakeLattice();
  mesh->SetLines(MakeCells({ { 16, 39 } }));
  WatchedFilter filter(mesh);
  filter->InsertLinesOn(); // which come before the second input
  filter->SetConstraintsData(MakeLines({ { 50, 7 }, { 0, 50 } }));
  EXPECT_FALSE(HasEdges(filter.Run(), FirstChain));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 1);
  EXPECT_NE(filter.GetWarnings()[0].find("(first: 7-50, 0-50)"), std::string::npos)
    << filter.GetWarnings()[0];
}

TEST(ConstraintInsertion, ByPlaceInTheOrderOfTheInput)
{
  Mesh lines = MakeMesh({ { 7, 4, 9 }, { 0, 2, 9 }, { 0, 0, 9 }, { 2, 6, 9 } }, {});
  lines->SetLines(MakeCells({ { 1, 0 }, { 2, 3 } }));
  Mesh mesh = MakeLattice();
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    mesh->GetPoints()->SetPoint(point, x[0], x[1], 9);
  }
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(lines);
  vtkPolyData* output = filter.Run();
  EXPECT_FALSE(HasEdges(output, FirstChain));
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 1);
  EXPECT_NE(filter.GetWarnings()[0].find("(first: 0-50)"), std::string::npos);
}

TEST(ConstraintInsertion, NotOnSurfaces)
{
  Mesh mesh = MakeBadSphere();
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(MakeLines({ { 4, 40 } }));
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 1);
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 0);
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_NE(filter.GetWarnings()[0].find("on a surface (first: 4-40)"), std::string::npos)
    << filter.GetWarnings()[0];
}

TEST(ConstraintInsertion, FlipCountsHoldItsFlips)
{
  Mesh mesh = MakeBadPlane();
  WatchedFilter filter(mesh);
  filter->SetConstraintsData(MakeLines({ { 0, 300 }, { 1, 250 } }));
  filter->GenerateFlipCountOn();
  const std::vector<int> counts = GetNumbers(filter.Run()->GetCellData(), "vtkDelaunayFlipCount");
  vtkIdType sum = 0;
  for (const int count : counts)
  {
    sum += count;
  }
  EXPECT_GT(filter->GetNumberOfConstraintFlips(), 0);
  EXPECT_EQ(sum, 2 * (filter->GetTotalFlips() + filter->GetNumberOfConstraintFlips()));
}

TEST(ConstraintInsertion, LiveRunsEndWithTheSameMesh)
{
  Mesh mesh = MakeBadPlane();
  Mesh lines = MakeLines({ { 0, 300 }, { 1, 250 }, { 17, 200 }, { 5, 399 } });
  WatchedFilter atOnce(mesh);
  atOnce->SetConstraintsData(lines);
  const Cells expected = GetCells(atOnce.Run()->GetPolys());
  LiveFilter live(mesh);
  live->SetConstraintsData(lines);
  live.Run();
  EXPECT_EQ(live->GetNumberOfIterations(), 1);
  EXPECT_EQ(live->GetNumberOfConstraintFlips(), atOnce->GetNumberOfConstraintFlips());
  EXPECT_GT(live.RunToTheEnd(), 3);
  EXPECT_EQ(live.GetTriangles(), expected);
  EXPECT_EQ(live->GetNumberOfConstraintFlips(), atOnce->GetNumberOfConstraintFlips());
  live->InsertConstraintsOff(); // starts again
  live.RunToTheEnd();
  EXPECT_EQ(live->GetNumberOfConstraintFlips(), 0);
}

TEST(ConstraintInsertion, WarmStartsKeepTheChains)
{
  Mesh mesh = MakeLattice();
  LiveFilter filter(mesh);
  filter->SetConstraintsData(MakeLines(Lines));
  filter.RunToTheEnd();
  const vtkIdType flips = filter->GetNumberOfConstraintFlips();
  for (int move = 0; move < 2; ++move)
  {
    Shear(mesh, move == 0 ? 0.8 : -1.6);
    filter.RunToTheEnd();
    EXPECT_TRUE(HasEdges(filter->GetOutput(), FirstChain));
    EXPECT_GT(filter->GetTotalFlips(), 0);
    EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 2);
    EXPECT_EQ(filter->GetNumberOfConstraintFlips(), flips);
    EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 1);
  }
}

TEST(ConstraintInsertion, SumsUpBlocks)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeLattice());
  blocks->SetBlock(1, MakeLattice());
  WatchedFilter filter;
  filter->SetInputDataObject(blocks);
  filter->SetConstraintsData(MakeLines(Lines));
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfInsertedConstraintEdges(), 4);
  EXPECT_EQ(filter->GetNumberOfUnmatchedConstraintEdges(), 2);
  EXPECT_EQ(filter->GetNumberOfConstraintFlips() % 2, 0);
  EXPECT_GT(filter->GetNumberOfConstraintFlips(), 0);
}

TEST(ConstraintInsertion, IsPrinted)
{
  WatchedFilter filter(MakeLattice());
  filter->InsertLinesOn();
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("InsertLines: 1"), std::string::npos);
  EXPECT_NE(text.str().find("InsertConstraints: 1"), std::string::npos);
}
