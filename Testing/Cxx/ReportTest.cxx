// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The table, the field data, the methods that return results, and the tolerance.

#include "FilterTestSupport.h"

#include "FlipReport.h"
#include "TestBackend.h"

#include "vtkCellData.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkFieldData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <tuple>

namespace
{

const char* const Columns[] = { "Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded",
  "Blocked", "MinimumAngle", "Seconds" };

/// Adds field data.
void AddText(vtkPolyData* mesh, const std::string& name)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue("of the user");
  mesh->GetFieldData()->AddArray(array);
}

/// 6 triangles. Their iterations make 1, 2, 3, 2 and 1 flips.
Mesh MakeWorstCase() { return ToPolyData(delaunayflip::MakeWorstCaseMesh(4)); }

}

TEST(Report, TableHasARowPerIterationWhichFieldDataRepeat)
{
  WatchedFilter filter(MakeWorstCase());
  auto output = RunCleanly(filter);
  vtkTable* table = filter->GetIterations();
  ASSERT_EQ(table->GetNumberOfColumns(), 8);
  ASSERT_EQ(table->GetNumberOfRows(), 5);
  const double flipped[] = { 1, 2, 3, 2, 1 };
  for (vtkIdType row = 0; row < 5; ++row)
  {
    for (int column = 0; column < 8; ++column)
    {
      EXPECT_STREQ(table->GetColumnName(column), Columns[column]);
      const double value = GetTotal(output, Columns[column], row);
      const double expected = filter.GetRow(Columns[column], row);
      EXPECT_EQ(value, expected) << Columns[column] << " of row " << row;
    }
    EXPECT_EQ(filter.GetRow("Iteration", row), row + 1);
    EXPECT_EQ(filter.GetRow("Flipped", row), flipped[row]);
    EXPECT_EQ(filter.GetRow("NonDelaunay", row),
      filter.GetRow("Flipped", row) + filter.GetRow("Excluded", row) +
        filter.GetRow("Blocked", row));
    EXPECT_EQ(filter.GetRow("MinimumAngle", row) == -1.0, 0 < row && row < 4);
  }
  filter->TrackQualityOn();
  RunCleanly(filter);
  EXPECT_GT(filter.GetRow("MinimumAngle", 2), 0.0);
}

/// VTK's readers of files of text stop at NaN.
TEST(Report, FieldDataHoldFiniteNumbers)
{
  WatchedFilter ofMesh(MakeWorstCase());
  Watched<vtkDelaunayFlipPoints> ofPoints(MakeBadPlane());
  for (WatchedAlgorithm* filter : std::initializer_list<WatchedAlgorithm*>{ &ofMesh, &ofPoints })
  {
    const auto output = RunCleanly(*filter);
    ASSERT_GT(filter->GetAlgorithm()->GetNumberOfIterations(), 2);
    vtkFieldData* data = output->GetFieldData();
    EXPECT_NE(data->GetArray("DelaunayFlip:MinimumAngle"), nullptr);
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = data->GetArray(i); // null if it has texts
      for (vtkIdType row = 0; array && row < array->GetNumberOfTuples(); ++row)
      {
        EXPECT_TRUE(std::isfinite(array->GetTuple1(row))) << array->GetName() << ' ' << row;
      }
    }
  }
}

TEST(Report, TotalsAreReadBackAndInTheFieldData)
{
  WatchedFilter filter(MakeWorstCase());
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_NOT_STARTED);
  EXPECT_STREQ(filter->GetStopReasonAsString(), "not started");
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_STREQ(filter->GetErrorMessage(), "");
  EXPECT_STREQ(filter->GetBackendUsed(), "");
  EXPECT_STREQ(filter->GetGeometryReason(), "");
  EXPECT_STREQ(filter->GetSummary(), "");
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_EQ(filter->GetReport().Edges.Edges, 13);
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_PLANAR);
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_CONVERGED);
  const std::pair<const char*, double> totals[] = { { "Converged", 1 }, { "TotalFlips", 9 },
    { "NonDelaunayAfter", 0 }, { "TrianglesBelow10Before", 6 }, { "TrianglesBelow10After", 4 },
    { "FixedEdges", 8 }, { "NonManifoldEdges", 0 } }; // 8 of 13
  for (const auto& [name, value] : totals)
  {
    EXPECT_EQ(GetTotal(output, name), value) << name;
  }
  EXPECT_EQ(filter->GetTotalFlips(), 9);
  EXPECT_EQ(filter->GetNonDelaunayAfter(), 0);
  EXPECT_TRUE(filter->GetConverged());
  const std::tuple<const char*, std::string, const char*> texts[] = {
    { "StopReason", "converged", filter->GetStopReasonAsString() },
    { "GeometryUsed", "planar", filter->GetGeometryUsedAsString() },
    { "GeometryReason", "all points lie in one plane; the feature angle has no effect",
      filter->GetGeometryReason() },
    { "Backend", filter->GetReport().Backend, filter->GetBackendUsed() },
    { "Summary",
      "bad edges: 1 -> 0\nsmallest angle: 1.909 -> 4.764 degrees\nsmall angles: 6 -> 4 triangles "
      "below 10 degrees, 6 -> 6 below 20, 6 -> 6 below 30\nflips: 9 in 5 iterations, converged\n"
      "mesh: 8 points, 6 triangles, 13 edges\nkept edges: 8 (8 boundary)\ngeometry: planar: all "
      "points lie in one plane; the feature angle has no effect\n",
      filter->GetSummary() }
  };
  for (const auto& [name, text, readBack] : texts)
  {
    EXPECT_EQ(GetText(output, name), text) << name;
    EXPECT_EQ(readBack, text) << name;
  }
  EXPECT_EQ(filter->GetReport().Backend.find(delaunayflip::GetTestBackendName()), 0u);
}

/// Even arrays with the names of the table's columns, but not results of an earlier run.
TEST(Report, FieldDataOfTheInputPass)
{
  auto mesh = MakeWorstCase();
  for (const std::string name : Columns)
  {
    AddText(mesh, name);
  }
  AddText(mesh, "DelaunayFlip:TotalFlips");
  AddText(mesh, "DelaunayFlip:Rounds");
  AddNumbers(mesh->GetCellData(), "Smallest angle after (degrees)", mesh->GetNumberOfCells(), 0);
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  for (const char* name : Columns)
  {
    EXPECT_EQ(
      output->GetFieldData()->GetAbstractArray(name), mesh->GetFieldData()->GetAbstractArray(name))
      << name;
  }
  EXPECT_EQ(GetTotal(output, "TotalFlips"), 9.0);
  EXPECT_EQ(output->GetFieldData()->GetAbstractArray("DelaunayFlip:Rounds"), nullptr);
  EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(mesh->GetCellData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 10);
  EXPECT_EQ(GetText(mesh, "TotalFlips"), "of the user");
}

/// Also if it is the same for several blocks, and in every step of a live run.
TEST(Tolerance, WithoutEffectIsWarnedOfOnce)
{
  const std::string expected = "Tolerance has no effect on the in-circle criterion";
  for (const bool isLive : { false, true })
  {
    WatchedFilter filter(MakeRhombus());
    filter->SetTolerance(0.0);
    filter->SetLiveUpdate(isLive);
    for (int i = 0; i < 3; ++i)
    {
      ExpectHolds(RunToWarning(filter), expected);
      filter->Advance();
    }
  }
  WatchedFilter blocks(MakeBlocks({ MakeRhombus(), MakeRhombus() }));
  blocks->SetTolerance(0.5);
  ExpectHolds(RunToWarning(blocks), "block 1, block 2: " + expected);
}
