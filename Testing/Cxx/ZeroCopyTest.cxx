// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views that draw without copies: the same pictures and meshes as with copies; and those that
/// cannot, or no longer.

#include "LiveViewTestSupport.h"
#include "TestFiller.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCellPicker.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <gtest/gtest.h>

namespace
{

const std::string WithoutCopies = "drawn without copies";

/// The triangles of the run as they are now.
Cells GetTriangles(WatchedView& view)
{
  vtkNew<vtkPolyData> mesh;
  EXPECT_TRUE(view.Filter->StoreMesh(mesh));
  return GetCells(mesh->GetPolys());
}

void ExpectSameStep(ViewPair& views)
{
  views.Step();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

/// A run that is drawn from copies for a reason, with the right pictures.
void ExpectCopies(const std::string& reason)
{
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  while (views.Step())
  {
  }
  EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: " + reason);
  EXPECT_TRUE(views.Sharing.Errors.empty());
  EXPECT_EQ(views.Sharing.Filter.GetPolygons(), FlipAtOnce(mesh));
}

}

TEST(ZeroCopy, SamePicturesAndMesh)
{
  for (const int colorBy :
    { vtkDelaunayFlipLiveView::COLOR_BY_SOLID, vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE,
      vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT })
  {
    TestFiller::Install();
    auto mesh = MakeBadPlane();
    ViewPair views(mesh);
    for (WatchedView* view : { &views.Copying, &views.Sharing })
    {
      (*view)->SetColorBy(colorBy);
      (*view)->SetEdgeVisibility(colorBy == vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT
          ? vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF
          : vtkDelaunayFlipLiveView::EDGE_VISIBILITY_ON);
    }
    while (views.Step())
    {
      EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
    }
    EXPECT_EQ(views.Copying->GetDrawing(), "drawn from copies: ZeroCopy is off");
    EXPECT_TRUE(views.Sharing->GetConverged());
    EXPECT_EQ(views.Sharing->GetFrameNumber(), views.Sharing.Filter->GetNumberOfIterations());
    EXPECT_EQ(views.Sharing.Filter.GetPolygons(), FlipAtOnce(mesh));
    EXPECT_FALSE(views.Sharing->Step());
  }
}

TEST(ZeroCopy, TheBuffersAreMappedDuringAStep)
{
  const TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  ExpectSameStep(views);
  const Bytes before = views.Sharing.GetPicture();
  int steps = 0;
  OnEvent(views.Sharing.Filter.Get(), vtkCommand::StartEvent,
    [&]()
    {
      EXPECT_TRUE(filler.AreMapped);
      if (++steps == 1) // what is drawn then is the mesh before
      {
        views.Sharing.Window->Render();
        EXPECT_FALSE(filler.AreMapped);
        EXPECT_EQ(before, views.Sharing.GetPicture());
      }
    });
  ExpectSameStep(views);
  EXPECT_NE(before, views.Sharing.GetPicture());
  ExpectSameStep(views);
  EXPECT_EQ(steps, 2);
  EXPECT_FALSE(filler.AreMapped);
  EXPECT_EQ(filler.Fills, 3);
}

TEST(ZeroCopy, TheOutputIsThereOnDemand)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  WatchedFilter reference(mesh);
  reference->LiveUpdateOn();
  for (int i = 0; i < 3; ++i)
  {
    view->Step();
    reference.Run();
    reference->Advance();
  }
  EXPECT_EQ(view.Filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(GetCells(view.Filter.Run()->GetPolys()), GetCells(reference->GetOutput()->GetPolys()));
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 3);
  view->Step();
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 4);
  EXPECT_EQ(view->GetFrameNumber(), 4);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, RestartBeginsAtTheInput)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  view->Start();
  const Bytes input = view.GetPicture();
  view->Step();
  const Bytes first = view.GetPicture();
  view->Step();
  view->Restart();
  EXPECT_EQ(view.GetPicture(), input);
  view->Step();
  EXPECT_EQ(view.GetPicture(), first);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
  view.StepToTheEnd();
  EXPECT_EQ(view.Filter.GetPolygons(), FlipAtOnce(mesh));
}

TEST(ZeroCopy, ResizingAndEdges)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (WatchedView* view : { &views.Copying, &views.Sharing })
  {
    (*view)->Step();
    (*view)->Step();
    (*view)->SetEdgeVisibilityToOff();
    (*view)->Render();
    view->Window->SetSize(300, 250);
    (*view)->Render();
    (*view)->Step();
    (*view)->SetEdgeVisibilityToOn();
    (*view)->Render();
  }
  views.ExpectSamePicture();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, PickersAndSelectionsSeeTheTrianglesThatAreDrawn)
{
  TestFiller::Install();
  WatchedView view;
  view->ShowStatisticsOff();
  vtkNew<vtkCellPicker> picker;
  for (int step = 0; step < 4; ++step)
  {
    view->Step();
    picker->Pick(100, 90, 0, view->GetRenderer());
    ASSERT_GE(picker->GetCellId(), 0);
    auto* picked = vtkPolyData::SafeDownCast(picker->GetDataSet());
    EXPECT_EQ(GetCells(picked->GetPolys()), GetTriangles(view));
  }
  view->Step();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(view->GetRenderer());
  selector->SetArea(100, 90, 100, 90);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
  auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
  auto* drawn = vtkPolyData::SafeDownCast(view.GetActor()->GetMapper()->GetInput());
  EXPECT_EQ(GetCells(drawn->GetPolys()), GetTriangles(view));
  picker->Pick(100, 90, 0, view->GetRenderer());
  EXPECT_EQ(ids->GetValue(0), picker->GetCellId());
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 5);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, NormalsOfCellsAreNotThoseOfFlippedTriangles)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  const auto normals = MakeArray<vtkFloatArray>("Normals", mesh->GetNumberOfCells(), 3);
  normals->Fill(0.5);
  mesh->GetCellData()->SetNormals(normals);
  ViewPair views(mesh);
  WatchedView plain;
  for (int i = 0; i < 3; ++i)
  {
    ExpectSameStep(views);
    plain->Step();
    EXPECT_LE(Compare(views.Copying.GetPicture(), plain.GetPicture()), 0.001);
  }
}

TEST(ZeroCopy, MovedPointsAreDrawnInTheSameBuffers)
{
  // Far away, OpenGL's single precision would show nothing if VTK did not shift the points.
  for (const double far : { 0.0, 1e7 })
  {
    const TestFiller& filler = TestFiller::Install();
    auto mesh = MakeBadPlane();
    MovePoints(mesh, [far](double* x) { x[0] += far; });
    ViewPair views(mesh);
    ExpectSameStep(views);
    ExpectSameStep(views);
    MovePoints(mesh, [far](double* x) { x[0] = far + 0.8 * (x[0] - far) * (x[0] - far); });
    ExpectSameStep(views);
    ExpectSameStep(views);
    EXPECT_EQ(filler.Registers, 1);
    EXPECT_EQ(views.Sharing->GetFrameNumber(), 4);
  }
}

TEST(ZeroCopy, AnotherMeshOfTheSameSizeTakesTheSameBuffers)
{
  const TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  ExpectSameStep(views);
  auto next = MakeBadPlane();
  next->GetPoints()->SetPoint(0, -0.2, -0.1, 0.0);
  int registers = 1;
  for (const Mesh& mesh : { next, ToPolyData(delaunayflip::MakeRandomBadMeshDouble(700, 3)) })
  {
    views.Copying.Filter->SetInputData(mesh);
    views.Sharing.Filter->SetInputData(mesh);
    ExpectSameStep(views);
    EXPECT_EQ(filler.Registers, registers++);
  }
}

TEST(ZeroCopy, LostResourcesAreMadeAgain)
{
  TestFiller& filler = TestFiller::Install();
  ViewPair views(MakeBadPlane());
  views.Step();
  views.Step();
  views.Sharing.GetActor()->GetMapper()->ReleaseGraphicsResources(views.Sharing.Window);
  EXPECT_FALSE(filler.IsRegistered);
  views.Sharing.Window->Render();
  EXPECT_TRUE(filler.IsRegistered);
  views.ExpectSamePicture();
  views.Step();
  views.ExpectSamePicture();
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, EverythingIsReleased)
{
  TestFiller& filler = TestFiller::Install();
  {
    WatchedView view;
    view->Step();
    view->Step();
    EXPECT_TRUE(filler.IsRegistered);
    view->SetFilter(nullptr);
    EXPECT_FALSE(filler.IsRegistered);
  }
  WatchedView view;
  view->Step();
  vtkSmartPointer<vtkMapper> mapper = view.GetActor()->GetMapper();
  view.View = nullptr; // while someone still has the mapper
  EXPECT_FALSE(filler.IsRegistered);
  EXPECT_EQ(filler.Registers, filler.Releases);
  mapper->Update();
  mapper->GetBounds();
}

TEST(ZeroCopy, AWindowMayGoFirst)
{
  TestFiller& filler = TestFiller::Install();
  WatchedView view;
  view->Step();
  view->Step();
  view.Interactor = nullptr;
  view.Window = nullptr;
  EXPECT_FALSE(filler.IsRegistered);
  EXPECT_FALSE(view->Step());
}

TEST(ZeroCopyFallback, AnObstacleIsTold)
{
  TestFiller& filler = TestFiller::Install();
  filler.Obstacle = "OpenGL is elsewhere";
  ExpectCopies("OpenGL is elsewhere");
  EXPECT_EQ(filler.Registers, 0);
  WatchedView view;
  view->ShowDrawingOn();
  view->Step();
  ExpectHolds(view.GetStatus(), "\ndrawn from copies: OpenGL is elsewhere");
}

TEST(ZeroCopyFallback, AnyCallMayFail)
{
  const struct
  {
    int TestFiller::*Failing;
    int Calls; ///< Each of the first calls fails in turn.
    const char* Reason;
  } cases[] = { { &TestFiller::FailingRegister, 1, "no registration" },
    { &TestFiller::FailingFill, 3, "no filling" }, { &TestFiller::FailingMap, 2, "no mapping" },
    { &TestFiller::FailingUnmap, 1, "no unmapping" } };
  for (const auto& given : cases)
  {
    for (int call = 1; call <= given.Calls; ++call)
    {
      TestFiller& filler = TestFiller::Install();
      filler.*given.Failing = call;
      ExpectCopies(given.Reason);
      EXPECT_FALSE(filler.IsRegistered);
    }
  }
}

TEST(ZeroCopyFallback, BuffersThatAreMadeAgainFail)
{
  for (const bool isLost : { false, true })
  {
    TestFiller::Install().FailingRegister = 2;
    ViewPair views(MakeBadPlane());
    views.Step();
    views.Step();
    if (isLost)
    {
      views.Sharing.GetActor()->GetMapper()->ReleaseGraphicsResources(views.Sharing.Window);
    }
    for (WatchedView* view : { &views.Copying, &views.Sharing })
    {
      (*view)->SetEdgeVisibilityToOff(); // VTK makes other buffers
      (*view)->Render();
    }
    views.ExpectSamePicture();
    views.Step();
    EXPECT_EQ(views.Sharing->GetDrawing(), "drawn from copies: no registration");
  }
}

TEST(ZeroCopyFallback, OtherCellsAndWireframesAreCopied)
{
  const TestFiller& filler = TestFiller::Install();
  WatchedView quad(MakeQuadAndTriangle());
  quad.Filter->TriangulateOff();
  quad->Step();
  EXPECT_EQ(quad->GetDrawing(), "drawn from copies: the mesh has other cells than triangles");
  EXPECT_EQ(filler.Registers, 0);
  WatchedView view;
  view->Step();
  view.GetActor()->GetProperty()->SetRepresentationToWireframe();
  view->Step();
  EXPECT_EQ(view->GetDrawing().find("drawn from copies: VTK draws no surface"), 0u);
  view.StepToTheEnd();
  EXPECT_TRUE(view->GetConverged());
}

TEST(ZeroCopyFallback, AFailureOfTheFilterKeepsTheMesh)
{
  TestFiller::Install();
  WatchedView view;
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
