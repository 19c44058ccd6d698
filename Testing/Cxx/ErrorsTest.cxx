// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// What the filter reports after an error, and that the next update works.

#include "LiveTestSupport.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

namespace
{

constexpr int Ten = 10;

/// Options that fail for a surface, one after the other.
void SetWrong(vtkDelaunayFlip* filter, int which)
{
  filter->SetGeometry(
    which % 3 == 0 ? vtkDelaunayFlip::GEOMETRY_PLANAR : vtkDelaunayFlip::GEOMETRY_SURFACE);
  filter->SetTieRule(
    which % 3 == 1 ? vtkDelaunayFlip::TIE_RULE_CANONICAL : vtkDelaunayFlip::TIE_RULE_KEEP);
  filter->SetRegionArray(which % 3 == 2 ? ("Region" + std::to_string(which)).c_str() : "");
}

void SetRight(vtkDelaunayFlip* filter)
{
  filter->SetGeometryToAuto();
  filter->SetTieRuleToKeep();
  filter->SetRegionArray("");
}

void ExpectFailed(WatchedFilter& filter)
{
  EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_OPTIONS);
  EXPECT_EQ(filter->GetErrorCode(),
    static_cast<unsigned long>(vtkErrorCode::UserError + vtkDelaunayFlip::FAILURE_OPTIONS));
  EXPECT_EQ(filter->GetStopReason(), vtkDelaunayFlip::STOP_REASON_FAILED);
  const std::string why = filter->GetErrorMessage();
  EXPECT_NE(why, "");
  EXPECT_EQ(filter->GetStopReasonAsString(), "failed: " + why);
  EXPECT_NE(filter.GetErrors().back().find(why), std::string::npos);
  EXPECT_FALSE(filter->GetConverged());
  EXPECT_EQ(filter->GetTotalFlips(), 0);
  EXPECT_EQ(filter->GetNumberOfIterations(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
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

TEST(Errors, NoneBeforeTheFirstUpdate)
{
  vtkNew<vtkDelaunayFlip> filter;
  EXPECT_STREQ(filter->GetErrorMessage(), "");
  EXPECT_STREQ(filter->GetStopReasonAsString(), "not started");
}

TEST(Errors, TenInARow)
{
  auto mesh = MakeBadSphere();
  WatchedFilter filter(mesh);
  for (int i = 0; i < Ten; ++i)
  {
    SetWrong(filter.Get(), i);
    filter.Run();
    EXPECT_EQ(filter.GetErrors().size(), i + 1u);
    ExpectFailed(filter);
  }
  EXPECT_TRUE(filter.GetExecutiveErrors().empty());
  SetRight(filter.Get());
  ExpectWorks(filter, FlipAtOnce(mesh));
}

TEST(Errors, TenBetweenUpdatesThatWork)
{
  auto mesh = MakeBadSphere();
  const Cells expected = FlipAtOnce(mesh);
  WatchedFilter filter(mesh);
  for (int i = 0; i < Ten; ++i)
  {
    SetWrong(filter.Get(), i);
    filter.Run();
    ExpectFailed(filter);
    SetRight(filter.Get());
    ExpectWorks(filter, expected);
  }
}

TEST(Errors, AreTriedAgainWhenModified)
{
  WatchedFilter filter(MakeBadSphere());
  filter->SetGeometryToPlanar();
  for (const int piece : { 0, 1 })
  {
    const std::size_t before = filter.GetErrors().size();
    filter->UpdatePiece(piece, 2, 0);
    filter->UpdatePiece(piece, 2, 0); // nothing has changed
    EXPECT_EQ(filter.GetErrors().size(), before + 1);
    filter->Modified();
    filter->UpdatePiece(piece, 2, 0);
    EXPECT_EQ(filter.GetErrors().size(), before + 2);
  }
}

TEST(Errors, OfAMeshEndWithTheMesh)
{
  auto mesh = MakeRhombus();
  const vtkSmartPointer<vtkCellArray> right = mesh->GetPolys();
  WatchedFilter filter(mesh);
  for (int i = 0; i < Ten; ++i)
  {
    mesh->SetPolys(MakeCells({ { 0, 1, 2 }, { 0, 2, 44 } }));
    filter.Run();
    EXPECT_EQ(filter->GetFailure(), vtkDelaunayFlip::FAILURE_MESH);
    EXPECT_EQ(filter->GetErrorCode(),
      static_cast<unsigned long>(vtkErrorCode::UserError + vtkDelaunayFlip::FAILURE_MESH));
    mesh->SetPolys(right);
    ExpectWorks(filter, FlipAtOnce(mesh));
  }
}

TEST(Errors, LetDownstreamFiltersExecute)
{
  WatchedFilter filter(MakeBadSphere());
  vtkNew<vtkAppendPolyData> below;
  below->AddInputConnection(filter->GetOutputPort());
  for (int i = 0; i < Ten; ++i)
  {
    SetWrong(filter.Get(), i);
    EXPECT_EQ(below->GetExecutive()->Update(), 1);
    EXPECT_EQ(below->GetOutput()->GetNumberOfCells(), 0);
    SetRight(filter.Get());
    below->Update();
    EXPECT_EQ(below->GetOutput()->GetNumberOfCells(), filter->GetOutput()->GetNumberOfCells());
    EXPECT_GT(below->GetOutput()->GetNumberOfCells(), 0);
  }
}

TEST(Errors, InALiveRunLetTheNextBegin)
{
  auto mesh = MakeBadSphere();
  LiveFilter filter(mesh);
  filter.Run();
  for (int i = 0; i < Ten; ++i)
  {
    SetWrong(filter.Get(), i);
    filter.Run();
    ExpectFailed(filter);
    EXPECT_FALSE(filter->Advance());
    EXPECT_FALSE(filter->GetNeedsUpdate());
  }
  SetRight(filter.Get());
  filter.Run();
  EXPECT_EQ(filter->GetNumberOfIterations(), 1);
  filter->Advance();
  filter.RunToTheEnd();
  EXPECT_EQ(filter.GetTriangles(), FlipAtOnce(mesh));
}
