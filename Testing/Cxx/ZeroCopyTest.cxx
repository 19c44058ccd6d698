// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views that draw without copies: the same pictures and meshes as with copies.

#include "TemporaryFolder.h"
#include "TestFiller.h"
#include "ZeroCopyTestSupport.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCellPicker.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMapper.h"
#include "vtkPNGReader.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"

#include <gtest/gtest.h>

namespace
{

/// Makes all steps with both ways of drawing, and compares the pictures.
void ExpectSamePictures(int colorBy, bool hasEdges)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (RunView* view : { &views.Copying, &views.Sharing })
  {
    (*view)->SetColorBy(colorBy);
    (*view)->SetEdgeVisibility(hasEdges ? vtkDelaunayFlipLiveView::EDGE_VISIBILITY_ON
                                        : vtkDelaunayFlipLiveView::EDGE_VISIBILITY_OFF);
  }
  bool goesOn = true;
  while (goesOn)
  {
    goesOn = views.Copying->Step();
    EXPECT_EQ(views.Sharing->Step(), goesOn);
    EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
    EXPECT_EQ(views.Sharing.GetStatus(), views.Copying.GetStatus());
    EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance)
      << "frame " << views.Sharing->GetFrameNumber();
  }
  EXPECT_EQ(views.Copying->GetDrawing(), "drawn from copies: ZeroCopy is off");
}

template <typename Change>
void Move(vtkPolyData* mesh, const Change& change)
{
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double x[3];
    mesh->GetPoint(i, x);
    change(x);
    mesh->GetPoints()->SetPoint(i, x);
  }
  mesh->GetPoints()->Modified();
}

void ExpectSameStep(ViewPair& views)
{
  views.Step();
  EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

}

TEST(ZeroCopy, SamePicturesBySmallestAngle)
{
  ExpectSamePictures(vtkDelaunayFlipLiveView::COLOR_BY_SMALLEST_ANGLE, true);
}

TEST(ZeroCopy, SamePicturesByFlipCount)
{
  ExpectSamePictures(vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT, false);
}

TEST(ZeroCopy, SamePicturesWithoutColors)
{
  ExpectSamePictures(vtkDelaunayFlipLiveView::COLOR_BY_SOLID, true);
}

TEST(ZeroCopy, FillsOncePerStep)
{
  const TestFiller& filler = TestFiller::Install();
  RunView view;
  view->Step();
  EXPECT_EQ(filler.Registers, 1);
  EXPECT_EQ(filler.Fills, 1);
  view->Step();
  view->Step();
  EXPECT_EQ(filler.Fills, 3);
  view->Render();
  view.Window->Render();
  EXPECT_EQ(filler.Fills, 3);
  EXPECT_EQ(filler.Registers, 1);
}

TEST(ZeroCopy, TheBuffersAreMappedDuringAStep)
{
  const TestFiller& filler = TestFiller::Install();
  RunView view;
  view->Step();
  int steps = 0;
  const auto look = [&]() { steps += filler.AreMapped ? 1 : 0; };
  OnEvent(view.Filter.Get(), vtkCommand::StartEvent, look);
  view->Step();
  view->Step();
  EXPECT_EQ(steps, 2);
  EXPECT_FALSE(filler.AreMapped);
  EXPECT_EQ(filler.Fills, 3);
}

TEST(ZeroCopy, WhatIsDrawnDuringAStepIsTheMeshBefore)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  views.Step();
  const Bytes before = views.Sharing.GetPicture();
  int drawn = 0;
  const auto draw = [&]()
  {
    views.Sharing.Window->Render();
    EXPECT_FALSE(filler.AreMapped);
    EXPECT_EQ(before, views.Sharing.GetPicture());
    ++drawn;
  };
  OnEvent(views.Sharing.Filter.Get(), vtkCommand::StartEvent, draw);
  ExpectSameStep(views);
  EXPECT_EQ(drawn, 1);
  EXPECT_NE(before, views.Sharing.GetPicture());
}

TEST(ZeroCopy, SameMesh)
{
  TestFiller::Install();
  auto mesh = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(3000, 5));
  RunView view(mesh);
  while (view->Step())
  {
    EXPECT_EQ(view->GetDrawing(), WithoutCopies);
  }
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), view.Filter->GetNumberOfIterations());
  EXPECT_EQ(GetCells(view.Filter->GetOutput()->GetPolys()), FlipAtOnce(mesh));
  EXPECT_FALSE(view->Step());
}

TEST(ZeroCopy, TheOutputIsThereOnDemand)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  RunView view(mesh);
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
  RunView view(mesh);
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
  while (view->Step())
  {
  }
  EXPECT_EQ(GetCells(view.Filter->GetOutput()->GetPolys()), FlipAtOnce(mesh));
}

TEST(ZeroCopy, ColorsChangeInPlace)
{
  const TestFiller& filler = TestFiller::Install();
  RunView view;
  view->Step();
  view->Step();
  const Bytes byAngle = view.GetPicture();
  view->SetColorByToFlipCount();
  view->Render();
  EXPECT_GT(Compare(view.GetPicture(), byAngle), 0.1);
  view->SetColorByToSmallestAngle();
  view->Render();
  EXPECT_EQ(view.GetPicture(), byAngle);
  EXPECT_EQ(filler.Registers, 1);
}

TEST(ZeroCopy, ResizingAndEdges)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (RunView* view : { &views.Copying, &views.Sharing })
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
  EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, SeveralRenderers)
{
  TestFiller::Install();
  RunView view;
  view->Step();
  view->GetRenderer()->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> other;
  other->SetViewport(0.5, 0.0, 1.0, 1.0);
  other->SetActiveCamera(view->GetRenderer()->GetActiveCamera());
  other->AddActor(view.GetActor());
  view.Window->AddRenderer(other);
  view->Step();
  const Bytes two = view.GetPicture();
  view->Step();
  EXPECT_GT(Compare(view.GetPicture(), two), 0.01);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, FramesAreWritten)
{
  TestFiller::Install();
  RunView view;
  const delaunayflip::TemporaryFolder folder;
  const std::string prefix = folder / "frame";
  view->SetFramePrefix(prefix.c_str());
  view->Step();
  view->Step();
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((prefix + "0002.png").c_str());
  reader->Update();
  const auto* first = static_cast<unsigned char*>(reader->GetOutput()->GetScalarPointer());
  const Bytes frame(first, first + 3 * 200 * 200);
  EXPECT_EQ(frame, view.GetPicture());
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, PickersSeeTheTrianglesThatAreDrawn)
{
  TestFiller::Install();
  RunView view;
  vtkNew<vtkCellPicker> picker;
  for (int step = 0; step < 4; ++step)
  {
    view->Step();
    picker->Pick(100, 90, 0, view->GetRenderer());
    ASSERT_GE(picker->GetCellId(), 0);
    auto* picked = vtkPolyData::SafeDownCast(picker->GetDataSet());
    EXPECT_EQ(GetCells(picked->GetPolys()), view.GetTriangles());
  }
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 4);
  EXPECT_EQ(view->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, SelectionsSeeTheTrianglesThatAreDrawn)
{
  TestFiller::Install();
  RunView view;
  view->ShowStatisticsOff();
  view->Step();
  view->Step();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(view->GetRenderer());
  selector->SetArea(100, 90, 100, 90);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
  auto* ids = vtkIdTypeArray::SafeDownCast(selection->GetNode(0)->GetSelectionList());
  auto* drawn = vtkPolyData::SafeDownCast(view.GetActor()->GetMapper()->GetInput());
  EXPECT_EQ(GetCells(drawn->GetPolys()), view.GetTriangles());
  vtkNew<vtkCellPicker> picker;
  picker->Pick(100, 90, 0, view->GetRenderer());
  EXPECT_EQ(ids->GetValue(0), picker->GetCellId());
}

TEST(ZeroCopy, NormalsOfCellsAreNotThoseOfFlippedTriangles)
{
  TestFiller::Install();
  auto mesh = MakeBadPlane();
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(mesh->GetNumberOfCells());
  normals->Fill(0.5);
  mesh->GetCellData()->SetNormals(normals);
  ViewPair views(mesh);
  RunView plain;
  for (int i = 0; i < 3; ++i)
  {
    ExpectSameStep(views);
    plain->Step();
    EXPECT_LE(Compare(views.Copying.GetPicture(), plain.GetPicture()), Tolerance);
  }
}

TEST(ZeroCopy, MovedPointsAreDrawnInTheSameBuffers)
{
  // Far away, OpenGL's single precision would show nothing if VTK did not shift the points.
  for (const double far : { 0.0, 1e7 })
  {
    const TestFiller& filler = TestFiller::Install();
    auto mesh = MakeBadPlane();
    Move(mesh, [far](double* x) { x[0] += far; });
    ViewPair views(mesh);
    ExpectSameStep(views);
    ExpectSameStep(views);
    Move(mesh, [far](double* x) { x[0] = far + 0.8 * (x[0] - far) * (x[0] - far); });
    ExpectSameStep(views);
    ExpectSameStep(views);
    EXPECT_EQ(filler.Registers, 1);
    EXPECT_EQ(views.Sharing->GetFrameNumber(), 4);
  }
}

TEST(ZeroCopy, AnotherMeshOfTheSameSizeTakesTheSameBuffers)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  ExpectSameStep(views);
  auto next = MakeBadPlane();
  next->GetPoints()->SetPoint(0, -0.2, -0.1, 0.0);
  views.Copying.Filter->SetInputData(next);
  views.Sharing.Filter->SetInputData(next);
  ExpectSameStep(views);
  EXPECT_EQ(filler.Registers, 1);
}

TEST(ZeroCopy, AMeshOfAnotherSizeGetsBuffersOfItsOwn)
{
  const TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  ExpectSameStep(views);
  auto next = ToPolyData(delaunayflip::MakeRandomBadMeshDouble(700, 3));
  views.Copying.Filter->SetInputData(next);
  views.Sharing.Filter->SetInputData(next);
  ExpectSameStep(views);
  EXPECT_EQ(filler.Registers, 2);
}

TEST(ZeroCopy, LostResourcesAreMadeAgain)
{
  TestFiller& filler = TestFiller::Install();
  auto mesh = MakeBadPlane();
  ViewPair views(mesh);
  for (int i = 0; i < 3; ++i)
  {
    views.Step();
  }
  views.Sharing.GetActor()->GetMapper()->ReleaseGraphicsResources(views.Sharing.Window);
  EXPECT_FALSE(filler.IsRegistered);
  views.Sharing.Window->Render();
  EXPECT_TRUE(filler.IsRegistered);
  EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  views.Step();
  EXPECT_LE(Compare(views.Sharing.GetPicture(), views.Copying.GetPicture()), Tolerance);
  EXPECT_EQ(views.Sharing->GetDrawing(), WithoutCopies);
}

TEST(ZeroCopy, EverythingIsReleased)
{
  TestFiller& filler = TestFiller::Install();
  {
    RunView view;
    view->Step();
    view->Step();
    EXPECT_TRUE(filler.IsRegistered);
    view->SetFilter(nullptr);
    EXPECT_FALSE(filler.IsRegistered);
  }
  RunView view;
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
  RunView view;
  view->Step();
  view->Step();
  view.Interactor = nullptr;
  view.Window = nullptr;
  EXPECT_FALSE(filler.IsRegistered);
  EXPECT_FALSE(view->Step());
}
