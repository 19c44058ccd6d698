// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Input that is wrong, dirty, unusual or empty; and that the update after an error works.

#include "FilterTestSupport.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

/// Options that fail for a surface, one after the other; -1: options that work.
void SetWrong(WatchedFilter& filter, int which)
{
  filter->SetGeometry(which < 0 ? vtkDelaunayFlip::GEOMETRY_AUTO
      : which % 3 == 0          ? vtkDelaunayFlip::GEOMETRY_PLANAR
                                : vtkDelaunayFlip::GEOMETRY_SURFACE);
  filter->SetTieRule(
    which % 3 == 1 ? vtkDelaunayFlip::TIE_RULE_CANONICAL : vtkDelaunayFlip::TIE_RULE_KEEP);
  filter->SetRegionArray(which % 3 == 2 ? ("Region" + std::to_string(which)).c_str() : "");
}

void ExpectError(WatchedFilter& filter, int failure)
{
  const std::string error = RunToError(filter, failure);
  ExpectHolds(error, filter->GetErrorMessage());
  EXPECT_STREQ(vtkErrorCode::GetStringFromErrorCode(filter->GetErrorCode()), "UnknownError");
  EXPECT_STRNE(filter->GetErrorMessage(), "");
  EXPECT_EQ(filter->GetStopReasonAsString(), "failed: " + std::string(filter->GetErrorMessage()));
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(filter->GetNumberOfIterations(), 0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfRows(), 0);
  EXPECT_EQ(filter->GetIterations()->GetNumberOfColumns(), 8);
}

void ExpectWorks(WatchedFilter& filter, const Cells& triangles)
{
  const std::size_t errors = filter.GetErrors().size();
  EXPECT_EQ(GetCells(filter.Run()->GetPolys()), triangles);
  EXPECT_EQ(filter.GetErrors().size(), errors);
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_NONE);
  EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
  EXPECT_STREQ(filter->GetErrorMessage(), "");
  EXPECT_STREQ(filter->GetStopReasonAsString(), "converged");
}

}

TEST(BadInput, WithoutPolygonsPasses)
{
  WatchedFilter none(vtkNew<vtkPolyData>().Get());
  EXPECT_EQ(RunCleanly(none)->GetNumberOfCells(), 0);
  EXPECT_EQ(none->GetIterations()->GetNumberOfColumns(), 8);
  EXPECT_EQ(none->GetIterations()->GetNumberOfRows(), 0);
  EXPECT_TRUE(none->GetConverged());
  for (const Cells& lines : { Cells{}, Cells{ { 0, 1 } } })
  {
    auto mesh = MakeLines({ { 0, 0, 0 }, { 1, 0, 0 } }, lines);
    AddNumbers(mesh->GetCellData(), "Number", mesh->GetNumberOfCells(), 4);
    WatchedFilter filter(mesh);
    auto output = RunCleanly(filter);
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    EXPECT_EQ(GetCells(output->GetLines()), lines);
    EXPECT_EQ(GetNumbers(output->GetCellData(), "Number"), std::vector<int>(lines.size(), 4));
  }
  WatchedFilter isolated(MakeRhombusAnd({ { 5, 5, 0 }, { 6, 5, 0 } }, {}));
  EXPECT_EQ(RunCleanly(isolated)->GetNumberOfPoints(), 6);
}

TEST(BadInput, IdsOutOfRangeAreErrorsThatNameCellAndPoint)
{
  for (const vtkIdType id : { 6, -1, 1 << 30 })
  {
    const std::string point = "point " + std::to_string(id);
    auto triangle = MakeRhombusAnd({ { 9, 9, 0 }, { 8, 8, 0 } }, { { 0, 1, id } });
    triangle->SetVerts(MakeCells({ { 0 } })); // so that the ids of polygons do not start at 0
    auto polygon = MakeRhombusAnd({ { 9, 9, 0 }, { 8, 8, 0 } }, { { 0, 1, id, 3, 2 } });
    auto strip = MakeRhombusAnd({ { 9, 9, 0 }, { 8, 8, 0 } }, {});
    strip->SetStrips(MakeCells({ { 0, 1, 2, id } }));
    auto line = MakeRhombusAnd({ { 9, 9, 0 }, { 8, 8, 0 } }, {});
    line->SetLines(MakeCells({ { 0, 2 }, { 1, id } }));
    const std::pair<Mesh, const char*> cases[] = { { triangle, "cell 3" }, { polygon, "cell 2" },
      { strip, "cell 2" }, { line, "cell 1" } };
    for (const auto& [mesh, cell] : cases)
    {
      WatchedFilter filter(mesh);
      const std::string error = RunToError(filter);
      ExpectHolds(error, cell);
      ExpectHolds(error, point);
    }
    auto constraints = MakeLines({ { -3, 0, 0 }, { 3, 0, 0 } }, { { 0, id } });
    for (int i = 0; i < 2; ++i)
    {
      WatchedFilter filter(MakeRhombus());
      filter->SetConstraintsData(constraints);
      const std::string error = RunToError(filter);
      ExpectHolds(error, "constraint");
      ExpectHolds(error, point);
      constraints->SetPoints(nullptr); // then the ids are those of the mesh
    }
  }
  vtkNew<vtkPolyData> pointless;
  pointless->SetPolys(MakeCells({ { 0, 1, 2 } }));
  WatchedFilter filter(pointless);
  ExpectHolds(RunToError(filter), "point 0");
}

/// Beside each, the rhombus is flipped.
TEST(BadInput, DirtyCellsStayWithOneWarning)
{
  const Points line = { { 10, 0, 0 }, { 11, 0, 0 }, { 12, 0, 0 }, { 13, 0, 0 } };
  const struct
  {
    const char* Warning;
    Points Others;
    Cells Polygons;
    bool IsHeightField;
  } cases[] = { { "1 triangle with a repeated point id", {}, { { 1, 1, 2 } }, false },
    { "2 triangles with a repeated point id (first: 2, 3)", {}, { { 0, 0, 2 }, { 2, 0, 2 } },
      false }, // at the edge that flips
    { "1 triangle that repeats another", { { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 } },
      { { 4, 5, 6 }, { 6, 5, 4 } }, false },
    { "2 points with NaN or infinite coordinates",
      { { 10, 0, 0 }, { 11, NAN, 0 }, { 10, 1, INFINITY } }, { { 4, 5, 6 } }, false },
    { "without area", line, { { 4, 5, 6 } }, false },
    { "2 triangles without area (first: 2)", line, { { 4, 5, 6, 7 } }, false },
    // 4 and 5 lie at one place, and are not merged.
    { "without area", { { 10, 0, 0 }, { 10, 0, 0 }, { 11, 0, 0 }, { 10, 1, 0 } },
      { { 4, 5, 6 }, { 4, 6, 7 }, { 5, 4, 7 } }, false },
    // Folded back over the other one.
    { "faces the other way than most", { { 10, 0, 0 }, { 16, 0, 0 }, { 13, 1, 0 }, { 13, 2, 5 } },
      { { 4, 5, 6 }, { 5, 4, 7 } }, true } };
  for (const auto& given : cases)
  {
    auto mesh = MakeRhombusAnd(given.Others, given.Polygons);
    WatchedFilter filter(mesh);
    filter->SetGeometry(
      given.IsHeightField ? vtkDelaunayFlip::GEOMETRY_PLANAR_XY : vtkDelaunayFlip::GEOMETRY_AUTO);
    ExpectHolds(RunToWarning(filter), given.Warning);
    vtkPolyData* output = filter->GetOutput();
    EXPECT_TRUE(filter->GetConverged());
    EXPECT_TRUE(HasEdge(output, 1, 3));
    EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
    if (given.Polygons.front().size() == 3) // else it is split
    {
      const Cells cells = GetCells(output->GetPolys());
      EXPECT_EQ(Cells(cells.begin() + 2, cells.end()), given.Polygons);
    }
  }
}

TEST(BadInput, AMissingOrWrongOneIsTold)
{
  auto mesh = MakeRhombus();
  WatchedFilter filter(mesh);
  const auto expectRefusal = [&filter](const std::string& why)
  {
    filter->Update(); // the executive refuses it
    EXPECT_EQ(filter->GetErrorMessage(), why);
    EXPECT_EQ(filter->GetStopReasonAsString(), "failed: " + why);
    EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
    EXPECT_EQ(filter->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::UnknownError));
    EXPECT_EQ(filter->GetTotalFlips(), 0);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0); // nor what the update before has made
  };
  const Cells flipped = GetCells(filter.Run()->GetPolys());
  filter->SetInputDataObject(0, vtkNew<vtkUnstructuredGrid>());
  expectRefusal(
    "the input is a vtkUnstructuredGrid; it must be a vtkPolyData or vtkCompositeDataSet");
  filter->SetInputConnection(vtkNew<vtkCleanPolyData>()->GetOutputPort()); // which has no input
  expectRefusal("an input was not made: see the errors of what makes it");
  filter->RemoveAllInputConnections(0);
  expectRefusal("there is no input");
  filter->SetInputData(mesh);
  filter->AddInputData(mesh);
  expectRefusal("the input has 2 connections; it takes one");
  filter->SetInputData(mesh);
  for (int i = 0; i < 3; ++i)
  {
    filter->AddInputData(1, mesh);
  }
  expectRefusal("the second input has 3 connections; it takes one");
  filter->SetInputDataObject(1, vtkNew<vtkUnstructuredGrid>());
  expectRefusal(
    "the second input is a vtkUnstructuredGrid; it must be a vtkPolyData or vtkCompositeDataSet");
  filter->RemoveAllInputConnections(1);
  filter->Update();
  EXPECT_EQ(GetCells(filter->GetOutput()->GetPolys()), flipped);
  EXPECT_STREQ(filter->GetErrorMessage(), "");
}

TEST(Errors, OfOptionsEndWithTheOptions)
{
  auto mesh = MakeBadSphere();
  const Cells expected = FlipAtOnce(mesh);
  WatchedFilter filter(mesh);
  vtkNew<vtkAppendPolyData> below; // executes after an error, too
  below->AddInputConnection(filter->GetOutputPort());
  for (int i = 0; i < 12; ++i)
  {
    SetWrong(filter, i);
    ExpectError(filter, vtkDelaunayFlip::FAILURE_OPTIONS);
    EXPECT_EQ(below->GetExecutive()->Update(), 1);
    EXPECT_EQ(below->GetOutput()->GetNumberOfCells(), 0);
    if (i % 4 != 0) // else the next error follows
    {
      SetWrong(filter, -1);
      ExpectWorks(filter, expected);
      below->Update();
      EXPECT_EQ(below->GetOutput()->GetNumberOfCells(), mesh->GetNumberOfCells());
    }
  }
  EXPECT_TRUE(filter.GetExecutiveErrors().empty());
  filter->SetGeometryToPlanar();
  ExpectHolds(RunToError(filter, vtkDelaunayFlip::FAILURE_OPTIONS), "plane");
  WatchedFilter tolerance(MakeRhombus());
  tolerance->SetTolerance(1.0);
  ExpectError(tolerance, vtkDelaunayFlip::FAILURE_OPTIONS);
}

TEST(Errors, InALiveRunLetTheNextBegin)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(mesh);
  filter.Run();
  for (int i = 0; i < 3; ++i)
  {
    SetWrong(filter, i);
    ExpectError(filter, vtkDelaunayFlip::FAILURE_OPTIONS);
    EXPECT_FALSE(filter->Advance());
    EXPECT_FALSE(filter->GetNeedsUpdate());
  }
  SetWrong(filter, -1);
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter->Advance();
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetPolygons(), FlipAtOnce(mesh));
}
