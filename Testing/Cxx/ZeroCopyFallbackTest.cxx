// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views that cannot draw without copies, or no longer.

#include "TestFiller.h"
#include "ZeroCopyTestSupport.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkProperty.h"

#include <gtest/gtest.h>

namespace
{

/// A run that is drawn from copies for a reason, with the right pictures.
void ExpectCopies(const std::string& reason, vtkPolyData* mesh = MakeBadPlane())
{
  ViewPair views(mesh);
  bool goesOn = true;
  while (goesOn)
  {
    goesOn = views.Copying->Step();
    EXPECT_EQ(views.Sharing->Step(), goesOn);
    EXPECT_EQ(views.Sharing.GetStatus(), views.Copying.GetStatus());
    EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  }
  EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: " + reason);
  EXPECT_TRUE(views.Sharing.Errors.empty());
  EXPECT_EQ(GetCells(views.Sharing.Filter->GetOutput()->GetPolys()), FlipAtOnce(mesh));
}

}

TEST(ZeroCopyFallback, AnObstacleIsTold)
{
  TestFiller& filler = TestFiller::Install();
  filler.Obstacle = "OpenGL is elsewhere";
  ExpectCopies("OpenGL is elsewhere");
  EXPECT_EQ(filler.Registers, 0);
  RunView view;
  EXPECT_NE(
    view.Print().find("Drawing: drawn from copies: no step has been made yet"), std::string::npos);
  view->ShowDrawingOn();
  view->Step();
  EXPECT_NE(view.GetStatus().find("\ndrawn from copies: OpenGL is elsewhere"), std::string::npos)
    << view.GetStatus();
  EXPECT_NE(
    view.Print().find("Drawing: drawn from copies: OpenGL is elsewhere"), std::string::npos);
}

TEST(ZeroCopyFallback, ARegistrationFails)
{
  TestFiller::Install().FailingRegister = 1;
  ExpectCopies("no registration");
}

TEST(ZeroCopyFallback, AFillingFails)
{
  for (const int call : { 1, 2, 3 })
  {
    TestFiller& filler = TestFiller::Install();
    filler.FailingFill = call;
    ExpectCopies("no filling");
    EXPECT_FALSE(filler.IsRegistered);
  }
}

TEST(ZeroCopyFallback, AMappingFails)
{
  for (const int call : { 1, 2 })
  {
    TestFiller& filler = TestFiller::Install();
    filler.FailingMap = call;
    ExpectCopies("no mapping");
    EXPECT_FALSE(filler.IsRegistered);
  }
}

TEST(ZeroCopyFallback, AnUnmappingFails)
{
  TestFiller& filler = TestFiller::Install();
  filler.FailingUnmap = 1;
  ExpectCopies("no unmapping");
  EXPECT_FALSE(filler.IsRegistered);
}

TEST(ZeroCopyFallback, ALostContextDoesNotComeBack)
{
  TestFiller& filler = TestFiller::Install();
  filler.FailingRegister = 2;
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (int i = 0; i < 4; ++i)
  {
    views.Step();
    EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
    if (i == 1)
    {
      views.Sharing.GetActor()->GetMapper()->ReleaseGraphicsResources(views.Sharing.Window);
    }
  }
  EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: no registration");
}

TEST(ZeroCopyFallback, BuffersThatAreMadeAgainFail)
{
  TestFiller& filler = TestFiller::Install();
  filler.FailingRegister = 2;
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (RunView* view : { &views.Copying, &views.Sharing })
  {
    (*view)->Step();
    (*view)->Step();
    (*view)->SetEdgeVisibilityToOff(); // VTK makes other buffers
    (*view)->Render();
  }
  EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: no registration");
}

TEST(ZeroCopyFallback, OtherMeshesAreCopied)
{
  const TestFiller& filler = TestFiller::Install();
  auto quads =
    MakeMesh({ { -3, 0, 0 }, { 0, -1, 0 }, { 3, 0, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } });
  RunView quad(quads);
  quad.Filter->TriangulateOff();
  quad->Step();
  EXPECT_EQ(quad->GetDrawing(), "drawn from copies: the mesh has other cells than triangles");
  EXPECT_EQ(filler.Registers, 0);
}

TEST(ZeroCopyFallback, WireframesAreCopied)
{
  TestFiller::Install();
  RunView view;
  view->Step();
  view.GetActor()->GetProperty()->SetRepresentationToWireframe();
  view->Step();
  EXPECT_EQ(view->GetDrawing().find("drawn from copies: VTK draws no surface"), 0u);
  while (view->Step())
  {
  }
  EXPECT_TRUE(view->GetConverged());
}

TEST(ZeroCopyFallback, AFailureOfTheFilterKeepsTheMesh)
{
  TestFiller::Install();
  RunView view;
  view->ShowStatisticsOff();
  view->Step();
  view->Step();
  const Bytes before = view.GetPicture();
  view.Filter->SetTieRuleToCanonical();
  view.Filter->SetGeometryToSurface();
  view->Step();
  EXPECT_EQ(view.GetStatus().find("failed: "), 0u);
  EXPECT_LT(Compare(view.GetPicture(), before), 0.1); // the text
  view.Filter->SetTieRuleToKeep();
  view.Filter->SetGeometryToAuto();
  view->Step();
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopyFallback, OnThreadsThereAreCopies)
{
  TestFiller::Remove();
  WatchedView view;
  view.Filter->SetBackendToThreads();
  view->Step();
#ifdef DELAUNAYFLIP_HAS_CUDA
  const std::string reason = "the filter works on CPU threads";
#else
  const std::string reason = "this build has no CUDA backend";
#endif
  EXPECT_EQ(view->GetDrawing(), "drawn from copies: " + reason);
}
