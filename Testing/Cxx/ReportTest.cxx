// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// The table, the field data and the methods that return results.

#include "FilterTestSupport.h"

#include "FlipReport.h"
#include "TestBackend.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

const char* const Columns[] = { "Iteration", "Tested", "NonDelaunay", "Flipped", "Excluded",
  "Blocked", "MinimumAngle", "Seconds" };

const char* const Totals[] = { "Converged", "StopReason", "TotalFlips", "NonDelaunayEdges",
  "BlockedByShape", "BlockedByEdge", "FixedEdges", "NonManifoldEdges", "GeometryUsed",
  "GeometryReason", "Tolerance", "Backend" };

/// Adds field data.
void AddText(vtkPolyData* mesh, const std::string& name)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue("of the user");
  mesh->GetFieldData()->AddArray(array);
}

/// 6 triangles, whose iterations make 1, 2, 3, 2 and 1 flips.
vtkSmartPointer<vtkPolyData> MakeWorstCase()
{
  return ToPolyData(delaunayflip::MakeWorstCaseMesh(4));
}

double GetTotal(vtkPolyData* mesh, const std::string& name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(("DelaunayFlip:" + name).c_str());
  EXPECT_NE(array, nullptr) << name;
  EXPECT_EQ(array->GetNumberOfTuples(), 1) << name;
  return array->GetComponent(0, 0);
}

std::string GetText(vtkPolyData* mesh, const std::string& name)
{
  auto* array = vtkStringArray::SafeDownCast(
    mesh->GetFieldData()->GetAbstractArray(("DelaunayFlip:" + name).c_str()));
  EXPECT_NE(array, nullptr) << name;
  return array->GetValue(0);
}

}

TEST(VtkDelaunayFlip, TableHasOneRowPerIteration)
{
  WatchedFilter filter(MakeWorstCase());
  RunCleanly(filter);
  vtkTable* table = filter->GetIterations();
  ASSERT_EQ(table->GetNumberOfColumns(), 8);
  for (int column = 0; column < 8; ++column)
  {
    EXPECT_STREQ(table->GetColumnName(column), Columns[column]);
  }
  std::vector<int> flipped;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(table->GetValueByName(row, "Iteration").ToInt(), row + 1);
    EXPECT_EQ(table->GetValueByName(row, "NonDelaunay").ToInt(),
      table->GetValueByName(row, "Flipped").ToInt() +
        table->GetValueByName(row, "Excluded").ToInt() +
        table->GetValueByName(row, "Blocked").ToInt());
    flipped.push_back(table->GetValueByName(row, "Flipped").ToInt());
  }
  EXPECT_EQ(flipped, std::vector<int>({ 1, 2, 3, 2, 1 }));
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
}

TEST(VtkDelaunayFlip, FieldDataRepeatTheTable)
{
  WatchedFilter filter(MakeWorstCase());
  auto output = RunCleanly(filter);
  for (const std::string column : Columns)
  {
    vtkDataArray* array = output->GetFieldData()->GetArray(("DelaunayFlip:" + column).c_str());
    ASSERT_NE(array, nullptr) << column;
    ASSERT_EQ(array->GetNumberOfTuples(), 5);
    auto* other =
      vtkDataArray::SafeDownCast(filter->GetIterations()->GetColumnByName(column.c_str()));
    for (vtkIdType row = 0; row < 5; ++row)
    {
      const double value = array->GetComponent(row, 0);
      const double expected = other->GetComponent(row, 0);
      EXPECT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected)))
        << column << " of row " << row << ": " << value << " instead of " << expected;
    }
  }
}

TEST(VtkDelaunayFlip, TotalsAreFieldData)
{
  WatchedFilter filter(MakeWorstCase());
  auto output = RunCleanly(filter);
  EXPECT_EQ(GetTotal(output, "Converged"), 1.0);
  EXPECT_EQ(GetTotal(output, "TotalFlips"), 9.0);
  EXPECT_EQ(GetTotal(output, "NonDelaunayEdges"), 0.0);
  EXPECT_EQ(GetTotal(output, "FixedEdges"), 8.0); // 13 edges, 5 of them inside
  EXPECT_EQ(GetTotal(output, "NonManifoldEdges"), 0.0);
  EXPECT_EQ(GetText(output, "StopReason"), "converged");
  EXPECT_EQ(GetText(output, "GeometryUsed"), "planar");
  EXPECT_EQ(GetText(output, "GeometryReason"),
    "all points lie in one plane; the feature angle has no effect");
  EXPECT_EQ(GetText(output, "Tolerance"), "none"); // in-circle
  EXPECT_EQ(GetText(output, "Backend"), filter->GetReport().Backend);
}

/// A tetrahedron, of which every flip would repeat an edge, and a sheet folded on itself, whose
/// flip would fold it over, beside each other.
TEST(VtkDelaunayFlip, TellsWhyEdgesAreLeft)
{
  const delaunayflip::OwnedMesh<double> mesh = { { -2, 0, 0, 2, 0, 0, 0, -1, 0.1, 0, 1, 0.1, -4, 9,
                                                   0, 4, 9, 0, -3, 11, 0, 3, 12, 1 },
    { 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 6, 4, 5, 7, 5, 4 } };
  WatchedFilter filter(ToPolyData(mesh));
  filter->SetGeometryToSurface();
  filter->SetFeatureAngle(180.0);
  auto output = RunCleanly(filter);
  EXPECT_EQ(filter->GetNumberOfNonDelaunayEdges(), 2);
  EXPECT_EQ(filter->GetNumberOfEdgesBlockedByEdge(), 1);
  EXPECT_EQ(filter->GetNumberOfEdgesBlockedByShape(), 1);
  EXPECT_EQ(GetTotal(output, "BlockedByEdge"), 1.0);
  EXPECT_EQ(GetTotal(output, "BlockedByShape"), 1.0);
}

TEST(VtkDelaunayFlip, FieldDataTellTheTolerance)
{
  WatchedFilter filter(MakeWorstCase());
  filter->SetCriterionToOppositeAngles();
  EXPECT_EQ(filter->GetTolerance(), -1.0);
  EXPECT_EQ(GetText(RunCleanly(filter), "Tolerance"), "automatic");
  filter->SetTolerance(1e-9);
  EXPECT_EQ(GetText(RunCleanly(filter), "Tolerance"), "1e-09");
  filter->SetCriterionToInCircle();
  filter->SetGeometryToSurface();
  EXPECT_EQ(GetText(RunCleanly(filter), "Tolerance"), "1e-09");
}

TEST(VtkDelaunayFlip, FieldDataOfTheInputPass)
{
  // Even arrays with the names of the table's columns.
  std::vector<std::string> names(std::begin(Columns), std::end(Columns));
  names.insert(names.end(), std::begin(Totals), std::end(Totals));
  auto mesh = MakeWorstCase();
  for (const std::string& name : names)
  {
    AddText(mesh, name);
  }
  WatchedFilter filter(mesh);
  auto output = RunCleanly(filter);
  for (const std::string& name : names)
  {
    EXPECT_EQ(output->GetFieldData()->GetAbstractArray(name.c_str()),
      mesh->GetFieldData()->GetAbstractArray(name.c_str()))
      << name;
  }
}

TEST(VtkDelaunayFlip, FieldDataOfAnEarlierRunAreReplaced)
{
  auto mesh = MakeWorstCase();
  AddText(mesh, "DelaunayFlip:TotalFlips");
  WatchedFilter filter(mesh);
  EXPECT_EQ(GetTotal(RunCleanly(filter), "TotalFlips"), 9.0);
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 1);
  EXPECT_EQ(GetText(mesh, "TotalFlips"), "of the user");
}

TEST(VtkDelaunayFlip, TrackQualityGivesEveryAngle)
{
  WatchedFilter filter(MakeWorstCase());
  RunCleanly(filter);
  const auto isNan = [&filter](int row)
  { return std::isnan(filter->GetIterations()->GetValueByName(row, "MinimumAngle").ToDouble()); };
  EXPECT_FALSE(isNan(0));
  EXPECT_TRUE(isNan(2));
  EXPECT_FALSE(isNan(4));
  filter->TrackQualityOn();
  RunCleanly(filter);
  EXPECT_FALSE(isNan(2));
}

TEST(VtkDelaunayFlip, ReadBack)
{
  WatchedFilter filter(MakeWorstCase());
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_NOT_STARTED);
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_STREQ(filter->GetBackendUsed(), "");
  EXPECT_STREQ(filter->GetGeometryReason(), "");
  RunCleanly(filter);
  EXPECT_EQ(filter->GetNumberOfIterations(), 5);
  EXPECT_EQ(filter->GetTotalFlips(), 9);
  EXPECT_EQ(filter->GetNumberOfNonDelaunayEdges(), 0);
  EXPECT_TRUE(filter->GetConverged());
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_CONVERGED);
  EXPECT_STREQ(filter->GetStopReasonAsString(), "converged");
  EXPECT_EQ(filter->GetGeometryUsed(), vtkDelaunayFlip::GEOMETRY_PLANAR);
  EXPECT_STREQ(filter->GetGeometryUsedAsString(), "planar");
  EXPECT_EQ(std::string(filter->GetGeometryReason()).rfind("all points lie in one plane", 0), 0u);
  EXPECT_EQ(std::string(filter->GetBackendUsed()).find(delaunayflip::GetTestBackendName()), 0u);
  EXPECT_EQ(filter->GetReport().Edges.Edges, 13);
}
