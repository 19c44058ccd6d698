// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Composite datasets: each block is flipped separately, and results are summed.

#include "FilterTestSupport.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

Mesh MakeWorstCase(int size) { return ToPolyData(delaunayflip::MakeWorstCaseMesh(size)); }

Mesh MakeBrokenMesh()
{
  auto mesh = MakeRhombus();
  mesh->SetPolys(MakeCells({ { 0, 1, 2 }, { 0, 2, 44 } }));
  return mesh;
}

}

TEST(Composite, EveryBlockIsFlipped)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1.0, 2.0, 3.0);
  grid->SetPoints(points);
  const vtkIdType vertex = 0;
  grid->InsertNextCell(VTK_VERTEX, 1, &vertex);
  vtkNew<vtkPolyData> empty;
  auto inner = MakeBlocks({ MakeWorstCase(20), nullptr });
  auto blocks = MakeBlocks({ MakeRhombus(), nullptr, inner, grid, empty });
  WatchedFilter filter(blocks);
  ExpectHolds(RunToWarning(filter), "block 6: not a surface, passed unchanged");
  EXPECT_TRUE(HasEdge(filter.GetBlock(0), 1, 3));
  EXPECT_EQ(GetTotal(filter.GetBlock(0), "TotalFlips"), 1.0);
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetNumberOfBlocks(), 5u);
  EXPECT_EQ(output->GetBlock(1), nullptr);
  auto* inside = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(2));
  EXPECT_EQ(CountViolations(vtkPolyData::SafeDownCast(inside->GetBlock(0))), 0);
  EXPECT_EQ(inside->GetBlock(1), nullptr);
  auto* passed = vtkUnstructuredGrid::SafeDownCast(output->GetBlock(3));
  ASSERT_NE(passed, nullptr);
  EXPECT_EQ(passed->GetPoints(), points);
  EXPECT_EQ(filter.GetBlock(4)->GetNumberOfCells(), 0);
}

TEST(Composite, BlockedEdgesAreSums)
{
  const delaunayflip::OwnedMesh<double> tetrahedron = {
    { -2, 0, 0, 2, 0, 0, 0, -1, 0.1, 0, 1, 0.1 }, { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2 }
  };
  const delaunayflip::OwnedMesh<double> folded = { { -4, 0, 0, 4, 0, 0, -3, 2, 0, 3, 3, 1 },
    { 2, 0, 1, 3, 1, 0 } };
  const delaunayflip::OwnedMesh<double> bent = { { 0, 1, 0.25, -4, 0, 0, 4, 0, 0, 0, -1, 0.25 },
    { 0, 1, 2, 3, 2, 1 } };
  WatchedFilter filter(MakeBlocks(
    { ToPolyData(tetrahedron), ToPolyData(folded), ToPolyData(tetrahedron), ToPolyData(bent) }));
  filter->SetGeometryToSurface();
  filter->SetFeatureAngle(180.0);
  filter->SetMaximumDeviation(0.2);
  filter.Run();
  EXPECT_EQ(filter->GetNonDelaunayAfter(), 4);
  EXPECT_EQ(GetTotal(filter.GetBlock(3), "BlockedByDeviation"), 1.0);
  EXPECT_EQ(filter->GetBlockedByDeviation(), 1);
  EXPECT_EQ(GetTotal(filter.GetBlock(2), "BlockedByEdge"), 1.0);
  EXPECT_EQ(GetTotal(filter.GetBlock(1), "BlockedByShape"), 1.0);
  EXPECT_EQ(filter->GetBlockedByEdge(), 2);
  EXPECT_EQ(filter->GetBlockedByShape(), 1);
  filter->SetMaximumDeviation(0.25);
  filter.Run();
  EXPECT_EQ(filter->GetNonDelaunayAfter(), 3);
  EXPECT_EQ(filter->GetBlockedByDeviation(), 0);
  filter->SetMaximumDeviation(-1.0);
  filter->Update();
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
  EXPECT_NE(std::string(filter->GetErrorMessage()).find("deviation"), std::string::npos);
}

TEST(Composite, OneTableSumsBlocks)
{
  WatchedFilter filter(MakeBlocks({ MakeWorstCase(4), MakeBadPlane(), MakeRhombus() }));
  filter->TrackQualityOn();
  filter.Run();
  vtkTable* table = filter->GetIterations();
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->GetNumberOfRows(), filter->GetNumberOfIterations());
  ASSERT_GT(table->GetNumberOfRows(), 5);
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(filter.GetRow("Iteration", row), row + 1.0);
    for (const char* column : { "Tested", "NonDelaunay", "Flipped", "Excluded", "Blocked" })
    {
      double sum = 0.0;
      for (const unsigned int block : { 0, 1, 2 })
      {
        sum += GetTotal(filter.GetBlock(block), column, row);
      }
      EXPECT_EQ(filter.GetRow(column, row), sum) << column << row;
    }
    double angle = 60.0; // that of a block which has ended stays
    for (const unsigned int block : { 0, 1, 2 })
    {
      const auto rows = static_cast<vtkIdType>(GetTotal(filter.GetBlock(block), "Iteration", row));
      angle = rows == row + 1
        ? std::min(angle, GetTotal(filter.GetBlock(block), "MinimumAngle", row))
        : angle;
    }
    EXPECT_LE(filter.GetRow("MinimumAngle", row), angle);
    EXPECT_GT(filter.GetRow("MinimumAngle", row), 0.0);
  }
}

TEST(Composite, TheWorstStopReasonCounts)
{
  WatchedFilter filter(MakeBlocks({ MakeWorstCase(20), MakeRhombus(), MakeBadSphere() }));
  filter->SetMaximumIterations(3);
  filter.Run();
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_MIXED);
  EXPECT_STREQ(filter->GetGeometryUsedAsString(), "mixed");
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_ITERATION_LIMIT);
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_EQ(GetTotal(filter.GetBlock(0), "NonDelaunayAfter"), CountViolations(filter.GetBlock(0)));
  EXPECT_EQ(filter->GetNonDelaunayAfter(),
    GetTotal(filter.GetBlock(0), "NonDelaunayAfter") +
      GetTotal(filter.GetBlock(2), "NonDelaunayAfter"));
}

TEST(Composite, ABlockThatFailsLeavesTheOthers)
{
  auto blocks = MakeBlocks({ MakeRhombus(), MakeBrokenMesh(), MakeWorstCase(4) });
  blocks->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "wing");
  WatchedFilter filter(blocks);
  for (unsigned int update = 1; update <= 3; ++update)
  {
    filter->Modified();
    filter.Run();
    EXPECT_EQ(filter.GetErrors().size(), update);
    EXPECT_TRUE(HasEdge(filter.GetBlock(0), 1, 3));
    EXPECT_EQ(CountViolations(filter.GetBlock(2)), 0);
    ASSERT_NE(filter.GetBlock(1), nullptr);
    EXPECT_EQ(filter.GetBlock(1)->GetNumberOfPoints(), 0);
  }
  const std::string why = filter->GetErrorMessage();
  EXPECT_EQ(why.find("block 2 (wing): Invalid mesh: cell 1 names point 44"), 0u) << why;
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_FAILED);
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_EQ(filter->GetTotalFlips(), 10);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 5);
  EXPECT_TRUE(filter.GetExecutiveErrors().empty());

  blocks->SetBlock(1, MakeRhombus());
  filter.Run();
  EXPECT_EQ(filter.GetErrors().size(), 3u);
  EXPECT_TRUE(HasEdge(filter.GetBlock(1), 1, 3));
  EXPECT_EQ(filter->GetTotalFlips(), 11);
  EXPECT_STREQ(filter->GetErrorMessage(), "");
  EXPECT_TRUE(filter->GetConverged());
}

TEST(Composite, ProgressRisesOverBlocks)
{
  auto blocks = MakeBlocks({ MakeWorstCase(20), MakeRhombus(), MakeWorstCase(20) });
  WatchedFilter filter(blocks);
  std::vector<double> progress;
  OnProgress(filter.Get(), [&]() { progress.push_back(filter->GetProgress()); });
  filter.Run();
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(progress.back(), 1.0);
  EXPECT_EQ(std::count(progress.begin(), progress.end(), 1.0), 1);
  EXPECT_TRUE(std::any_of(
    progress.begin(), progress.end(), [](double part) { return 0.6 < part && part < 1.0; }));
  EXPECT_TRUE(std::any_of(
    progress.begin(), progress.end(), [](double part) { return 0.0 < part && part < 0.4; }));
  EXPECT_EQ(filter->GetProgressShift(), 0.0);
  EXPECT_EQ(filter->GetProgressScale(), 1.0);
}

TEST(Composite, ConstraintsForAllOrForEachBlock)
{
  const Mesh line = MakeLines({ { 0, 2 } });
  auto blocks = MakeBlocks({ MakeRhombus(), MakeRhombus() });
  WatchedFilter filter(blocks);
  filter->SetConstraintsData(line);
  filter.Run();
  EXPECT_FALSE(HasEdge(filter.GetBlock(0), 1, 3) || HasEdge(filter.GetBlock(1), 1, 3));
  filter->SetInputDataObject(1, MakeBlocks({ nullptr, line }));
  filter.Run();
  EXPECT_TRUE(HasEdge(filter.GetBlock(0), 1, 3));
  EXPECT_FALSE(HasEdge(filter.GetBlock(1), 1, 3));
}

TEST(Composite, WhatIsIgnoredOfTheSecondInputIsToldOf)
{
  vtkNew<vtkPolyData> line, strip;
  line->SetLines(MakeCells({ { 0, 2 } }));
  strip->SetStrips(MakeCells({ { 0, 1, 2 } }));
  vtkNew<vtkUnstructuredGrid> grid;
  const vtkIdType ends[] = { 0, 2 };
  grid->InsertNextCell(VTK_LINE, 2, ends);
  const auto warn = [](vtkDataObject* input, vtkDataObject* constraints)
  {
    WatchedFilter filter(input);
    filter->SetInputDataObject(1, constraints);
    return RunToWarning(filter);
  };
  ExpectHolds(warn(MakeBlocks({ MakeRhombus() }), MakeBlocks({ MakeBlocks({ line }) })),
    "block 2 of the second input: ignored, because the first input has nothing at this place");
  ExpectHolds(warn(MakeBlocks({ MakeRhombus(), MakeRhombus() }), MakeBlocks({ line, grid })),
    "block 2 of the second input: not a vtkPolyData, ignored");
  ExpectHolds(warn(MakeRhombus(), strip), "second input: triangle strips ignored");
  LiveFilter live(MakeWorstCase(20));
  live->SetConstraintsData(strip);
  EXPECT_GT(live.RunToTheEnd(), 2);
  EXPECT_EQ(live.GetWarnings().size(), 1u);
}
