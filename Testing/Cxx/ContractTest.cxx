// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What the documentation promises for unusual input, where no other test is about it.

#include "FlipReport.h"
#include "LiveTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

/// How often each edge is one of a triangle, ascending.
std::vector<std::pair<Cell, int>> CountEdges(vtkPolyData* mesh)
{
  std::vector<Cell> edges;
  for (const Cell& cell : GetCells(mesh->GetPolys()))
  {
    for (std::size_t i = 0; i < cell.size(); ++i)
    {
      const vtkIdType from = cell[i], to = cell[(i + 1) % cell.size()];
      edges.push_back({ std::min(from, to), std::max(from, to) });
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::pair<Cell, int>> counts;
  for (const Cell& edge : edges)
  {
    if (counts.empty() || counts.back().first != edge)
    {
      counts.emplace_back(edge, 0);
    }
    ++counts.back().second;
  }
  return counts;
}

/// The edges that not two triangles have, with how many have them.
std::vector<std::pair<Cell, int>> FindRims(vtkPolyData* mesh)
{
  auto counts = CountEdges(mesh);
  counts.erase(std::remove_if(counts.begin(), counts.end(),
                 [](const std::pair<Cell, int>& edge) { return edge.second == 2; }),
    counts.end());
  return counts;
}

/// The rhombus as a quad behind a triangle, with a cell array of two values.
void ExpectCopied(vtkDataArray* values)
{
  auto mesh = MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, { 10, 0, 0 },
                         { 11, 0, 0 }, { 10, 1, 0 } },
    { { 4, 5, 6 }, { 0, 1, 2, 3 } });
  values->SetName("Value");
  values->SetNumberOfComponents(1); // an SOA array has none yet
  values->SetNumberOfTuples(2);
  values->SetComponent(0, 0, 1.0);
  values->SetComponent(1, 0, 0.0);
  mesh->GetCellData()->AddArray(values);
  WatchedFilter filter(mesh);
  vtkDataArray* copied = RunCleanly(filter)->GetCellData()->GetArray("Value");
  ASSERT_NE(copied, nullptr) << values->GetClassName();
  EXPECT_EQ(copied->GetDataType(), values->GetDataType());
  ASSERT_EQ(copied->GetNumberOfTuples(), 3);
  EXPECT_EQ(copied->GetComponent(0, 0), 1.0) << values->GetClassName();
  EXPECT_EQ(copied->GetComponent(1, 0), 0.0) << values->GetClassName();
  EXPECT_EQ(copied->GetComponent(2, 0), 0.0) << values->GetClassName();
}

}

TEST(Contract, PointsAlonePass)
{
  auto mesh = MakeMesh({ { 0, 0, 0 }, { 1, 0, 0 } }, {});
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(output->GetNumberOfCells(), 0);
}

TEST(Contract, CoincidentPointsAreNotMerged)
{
  // Points 4 and 5 lie at one place; the edge between them has no length.
  const Points points = { { 10, 0, 0 }, { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 } };
  auto mesh = MakeRhombusAnd(points, { { 4, 5, 6 }, { 4, 6, 7 }, { 5, 4, 7 } });
  WatchedFilter filter(mesh);
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_TRUE(Holds(filter.GetWarnings()[0], "without area")) << filter.GetWarnings()[0];
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(output->GetNumberOfPoints(), 8);
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_EQ(FindRims(output), FindRims(mesh));
}

TEST(Contract, PointsOfALatticeThatLieOnOneCircleStay)
{
  // 3-4-5: twelve points of the lattice at distance 5 from the origin.
  Points points;
  for (const auto& [x, y] : { std::pair<int, int>{ 5, 0 }, { 4, 3 }, { 3, 4 }, { 0, 5 }, { -3, 4 },
         { -4, 3 }, { -5, 0 }, { -4, -3 }, { -3, -4 }, { 0, -5 }, { 3, -4 }, { 4, -3 } })
  {
    points.push_back({ static_cast<double>(x), static_cast<double>(y), 0.0 });
  }
  Cells fan;
  for (vtkIdType i = 1; i < 11; ++i)
  {
    fan.push_back({ 0, i, i + 1 });
  }
  WatchedFilter filter(MakeMesh(points, fan));
  EXPECT_EQ(GetCells(RunCleanly(filter)->GetPolys()), fan);
  EXPECT_EQ(filter->GetTotalFlips(), 0);
}

TEST(Contract, MoebiusStripsKeepTheirRim)
{
  auto mesh = ToPolyData(delaunayflip::MakeMoebiusStrip(40, 6, 1));
  WatchedFilter filter(mesh);
  filter->SetFeatureAngle(180.0);
  vtkPolyData* output = filter.Run();
  EXPECT_TRUE(filter.GetErrors().empty());
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_GT(filter->GetTotalFlips(), 0);
  EXPECT_GT(filter->GetReport().Edges.WronglyWound, 0);
  EXPECT_EQ(FindRims(output), FindRims(mesh));
}

TEST(Contract, BowTieVerticesKeepTheirTriangles)
{
  // A second rhombus that hangs on point 2 of the first.
  const Points points = { { 6, -1, 0 }, { 9, 0, 0 }, { 6, 1, 0 } };
  auto mesh = MakeRhombusAnd(points, { { 2, 4, 5 }, { 2, 5, 6 } });
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetTotalFlips(), 2);
  EXPECT_TRUE(HasEdge(output, 1, 3) && HasEdge(output, 4, 6));
  EXPECT_EQ(FindRims(output), FindRims(mesh));
}

TEST(Contract, OverlapsInTheProjectionNeverFlip)
{
  // The third triangle is folded back over the first: both have edge 0-1.
  const Points points = { { 10, 0, 0 }, { 16, 0, 0 }, { 13, 1, 0 }, { 13, 2, 5 } };
  auto mesh = MakeRhombusAnd(points, { { 4, 5, 6 }, { 5, 4, 7 } });
  WatchedFilter filter(mesh);
  filter->SetGeometryToPlanarXY();
  vtkPolyData* output = filter.Run();
  ASSERT_EQ(filter.GetWarnings().size(), 1u);
  EXPECT_TRUE(Holds(filter.GetWarnings()[0], "the other way than most")) << filter.GetWarnings()[0];
  EXPECT_TRUE(HasEdge(output, 1, 3));
  EXPECT_TRUE(HasEdge(output, 4, 5));
  EXPECT_EQ(filter->GetTotalFlips(), 1);
}

TEST(Contract, FieldDataPass)
{
  auto mesh = MakeRhombus();
  vtkNew<vtkStringArray> author;
  author->SetName("Seconds"); // as a column of the table
  author->InsertNextValue("mine");
  mesh->GetFieldData()->AddArray(author);
  WatchedFilter filter(mesh);
  EXPECT_EQ(RunCleanly(filter)->GetFieldData()->GetAbstractArray("Seconds"), author);
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 1);
}

TEST(Contract, CellDataOfAllTypesFollowTheirCells)
{
  for (const int type : { VTK_BIT, VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE })
  {
    ExpectCopied(vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type)));
  }
  ExpectCopied(vtkSmartPointer<vtkSOADataArrayTemplate<float>>::New());
}

TEST(Contract, GhostsOfBlocksStay)
{
  auto ghost = MakeRhombus();
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->InsertNextValue(0);
  ghosts->InsertNextValue(vtkDataSetAttributes::DUPLICATECELL);
  ghost->GetCellData()->AddArray(ghosts);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, ghost);
  blocks->SetBlock(1, MakeRhombus());
  blocks->SetBlock(3, vtkNew<vtkPolyData>());
  WatchedFilter filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_TRUE(HasEdge(vtkPolyData::SafeDownCast(output->GetBlock(0)), 0, 2));
  EXPECT_TRUE(HasEdge(vtkPolyData::SafeDownCast(output->GetBlock(1)), 1, 3));
  EXPECT_EQ(output->GetBlock(2), nullptr);
  EXPECT_NE(output->GetBlock(3), nullptr);
}
