// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views: timer, keys, states, failures; the picture, the texts and the files.

#include "LiveViewTestSupport.h"
#include "TemporaryFolder.h"
#include "TestWindow.h"

#include "vtkCamera.h"
#include "vtkDelaunayFlipPoints.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkImageData.h"
#include "vtkPNGReader.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <stdexcept>

vtkSmartPointer<vtkRenderWindow> MakeTestWindow()
{
  return vtkSmartPointer<vtkRenderWindow>::New();
}

vtkSmartPointer<vtkRenderWindowInteractor> MakeTestInteractor()
{
  return vtkSmartPointer<vtkRenderWindowInteractor>::New();
}

namespace
{

namespace fs = std::filesystem;
using delaunayflip::TemporaryFolder;

Bytes ReadPicture(const std::string& file)
{
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  const auto* first = static_cast<unsigned char*>(image->GetScalarPointer());
  return Bytes(first, first + image->GetNumberOfPoints() * image->GetNumberOfScalarComponents());
}

/// Timers that fire only when the test makes them fire.
void EnableTimers(vtkGenericRenderWindowInteractor* interactor)
{
  OnEvent(interactor, vtkCommand::CreateTimerEvent,
    [interactor]() { interactor->SetTimerEventPlatformId(7); });
}

/// The text in one line.
std::string Unwrap(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}

TEST(LiveView, TimerRunsItToTheEndAndIsGoneThen)
{
  auto mesh = MakeBadPlane();
  WatchedView view(mesh, false);
  int timerEvents = 0;
  OnEvent(view.Interactor, vtkCommand::TimerEvent, [&timerEvents]() { ++timerEvents; });
  view->Run();
  const int others = view.RunUntilItStops();
  EXPECT_EQ(timerEvents, view->GetFrameNumber() + others);
  EXPECT_TRUE(view->GetConverged());
  EXPECT_FALSE(view->IsRunning());
  EXPECT_EQ(view.Ends, 1);
  EXPECT_EQ(view.Starts, 1);
  EXPECT_GT(view->GetFrameNumber(), 5);
  EXPECT_EQ(view->GetFrameNumber(), view.Filter->GetNumberOfIterations());
  EXPECT_EQ(view.Frames, view->GetFrameNumber() + 1);
  EXPECT_EQ(view.Filter.GetPolygons(), FlipAtOnce(mesh));
  EXPECT_TRUE(view.Filter.GetErrors().empty() && view.Filter.GetWarnings().empty());
  const int steps = view->GetFrameNumber();
  view->Restart();
  EXPECT_TRUE(view->IsRunning());
  EXPECT_FALSE(view->GetConverged());
  for (int step = 1; view->Step(); ++step)
  {
    EXPECT_EQ(view->GetFrameNumber(), step);
  }
  EXPECT_EQ(view->GetFrameNumber(), steps);
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view.Ends, 2);
  view->Restart(); // paused, as the step left it
  EXPECT_FALSE(view->IsRunning());
}

TEST(LiveView, PauseStopsTheTimer)
{
  WatchedView view(MakeBadPlane(), false);
  OnEvent(view.View, vtkCommand::UpdateEvent,
    [&view]()
    {
      if (view->GetFrameNumber() == 3)
      {
        view->Pause();
      }
    });
  view->Run();
  EXPECT_TRUE(view->IsRunning());
  view.RunUntilItStops();
  EXPECT_EQ(view->GetFrameNumber(), 3);
  EXPECT_FALSE(view->IsRunning());
  EXPECT_EQ(view.GetStatus().find("iteration 3, paused"), 0u);
}

TEST(LiveView, DrawingDoesNotExecuteTheFilter)
{
  WatchedView view;
  view.Filter->SetIterationsPerUpdate(4);
  view->Step();
  view.Filter->Advance();
  view.Window->Render();
  view->Render();
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 4);
  EXPECT_EQ(view->GetFrameNumber(), 1);
}

TEST(LiveView, Keys)
{
  WatchedView view(MakeBadPlane(), false);
  view->Start();
  EXPECT_FALSE(view.Press("space"));
  EXPECT_TRUE(view->IsRunning());
  view.Press("space");
  EXPECT_FALSE(view->IsRunning());
  EXPECT_FALSE(view.Press("n"));
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_FALSE(view.Press("b"));
  EXPECT_EQ(view->GetFrameNumber(), 0);
  EXPECT_FALSE(view.Press("k"));
  EXPECT_EQ(view->GetColorBy(), vtkDelaunayFlipLiveView::COLOR_BY_FLIP_COUNT);
  view.Press("k");
  EXPECT_EQ(view->GetColorBy(), vtkDelaunayFlipLiveView::COLOR_BY_SOLID);
  EXPECT_FALSE(view.Press("g"));
  EXPECT_FALSE(view.HasEdges());
  view.Press("g");
  EXPECT_TRUE(view.HasEdges());
  EXPECT_FALSE(view.Press("i"));
  EXPECT_FALSE(view->GetShowStatistics());
  EXPECT_EQ(view.GetStatus(), "");
  view.Press("i");
  EXPECT_NE(view.GetStatus(), "");
  EXPECT_FALSE(view.Press("d"));
  ExpectHolds(Unwrap(view.GetStatus()), view->GetDrawing());
}

TEST(LiveView, OtherKeysReachTheStyle)
{
  WatchedView view;
  view->Start();
  for (const char* key : { "w", "s", "p", "r", "q", "Left" })
  {
    EXPECT_TRUE(view.Press(key));
  }
  view.Interactor->SetControlKey(1);
  EXPECT_TRUE(view.Press("n"));
  EXPECT_EQ(view->GetFrameNumber(), 0);
}

TEST(LiveView, MovedPointsContinueAfterTheEnd)
{
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  view.StepToTheEnd();
  const int steps = view->GetFrameNumber();
  Shear(mesh, 0.3);
  view.StepToTheEnd();
  EXPECT_GT(view->GetFrameNumber(), steps);
  EXPECT_EQ(CountViolations(view.Filter->GetOutput()), 0);
}

/// The first frame has no triangles, but looks at the place of the others.
TEST(LiveView, ShowsHowPointsGetTriangles)
{
  auto mesh = MakeBadPlane();
  vtkNew<vtkDelaunayFlipPoints> points;
  points->SetInputData(mesh);
  WatchedView view;
  view->SetFilter(points);
  view->Start();
  EXPECT_EQ(view.GetStatus(), "input, running\n400 points");
  EXPECT_EQ(view.GetMapper()->GetNumberOfTriangles(), 0);
  view->Step();
  EXPECT_EQ(view.GetStatus().find("iteration 1, running"), 0u);
  view.StepToTheEnd();
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), points->GetNumberOfIterations());
  EXPECT_TRUE(view.Errors.empty());

  vtkNew<vtkDelaunayFlipPoints> atOnce;
  atOnce->SetInputData(mesh);
  atOnce->Update();
  EXPECT_EQ(GetTriangles(points->GetOutput()), GetTriangles(atOnce->GetOutput()));
  WatchedView still(atOnce->GetOutput());
  for (WatchedView* each : { &view, &still })
  {
    (*each)->ShowStatisticsOff();
    (*each)->Render();
  }
  still->Start();
  EXPECT_EQ(Compare(still.GetPicture(), view.GetPicture()), 0.0);
}

TEST(LiveView, CompositeInputTakesOneStep)
{
  WatchedView view;
  view.Filter->SetInputDataObject(MakeBlocks({ MakeBadPlane(), MakeRhombus() }));
  view.Filter->LiveUpdateOn();
  view->Start();
  EXPECT_FALSE(view->Step());
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_EQ(view.GetMapper()->GetNumberOfTriangles(), MakeBadPlane()->GetNumberOfCells() + 2);
  EXPECT_EQ(view.GetStatus().find("all blocks in one step, converged\n"), 0u);
  EXPECT_NE(view.GetStatus().find(" flips, 0 bad edges left\n"), std::string::npos);
  EXPECT_TRUE(view.Filter.GetWarnings().empty());
}

TEST(LiveView, AnAbortPausesIt)
{
  WatchedView view(MakeBadPlane(), false);
  OnProgress(view.Filter.Get(),
    [&view]() { view.Filter->SetAbortExecute(view.Filter->GetNumberOfIterations() == 2); });
  OnEvent(view.Filter.Get(), vtkCommand::AbortCheckEvent, []() {});
  view->Run();
  view.RunUntilItStops();
  EXPECT_FALSE(view->IsRunning());
  EXPECT_EQ(view->GetFrameNumber(), 2);
  EXPECT_EQ(view.GetStatus().find("iteration 2, aborted"), 0u);
  EXPECT_FALSE(view->Step());
  view.Filter->SetAbortExecute(0);
  view.StepToTheEnd();
  EXPECT_TRUE(view->GetConverged());
}

TEST(LiveView, AFailureEndsTheRun)
{
  WatchedView view(MakeBadPlane(), false);
  view->Step();
  view->ShowStatisticsOff(); // but a failure is shown
  view.Filter->SetTolerance(2.0);
  view.RunToTheEnd();
  EXPECT_FALSE(view->IsRunning());
  EXPECT_FALSE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_EQ(view.GetMapper()->GetNumberOfTriangles(), MakeBadPlane()->GetNumberOfCells());
  EXPECT_EQ(
    Unwrap(view.GetStatus())
      .find("failed: " + std::string(view.Filter->GetErrorMessage()) + " the mesh of frame 1"),
    0u);
  EXPECT_EQ(view.Filter.GetErrors().size(), 1u);
  view.Filter->SetTolerance(0.0);
  EXPECT_TRUE(view->Step());
  EXPECT_EQ(view->GetFrameNumber(), 2);
}

TEST(LiveView, AMeshThatCannotBeDrawnFails)
{
  auto broken = MakeRhombus();
  broken->SetPolys(MakeCells({ { 0, 1, 2, 1000000000 } }));
  const auto blocks = MakeBlocks({ broken, MakeRhombus() });
  for (vtkDataObject* input : std::initializer_list<vtkDataObject*>{ broken, blocks })
  {
    WatchedView view(nullptr);
    view.Filter->SetInputDataObject(input);
    view->Start();
    EXPECT_EQ(view.GetMapper()->GetNumberOfTriangles(), input == broken.Get() ? 0 : 2);
    EXPECT_FALSE(view->Step());
    ExpectHolds(view.GetStatus(), "failed: ");
  }
}

TEST(LiveView, WhatIsMissingIsAnError)
{
  WatchedView view;
  view->SetFilter(nullptr);
  view->Run();
  EXPECT_EQ(view.Errors.size(), 1u);
  vtkNew<vtkDelaunayFlip> idle;
  view->SetFilter(idle);
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view.Errors.size(), 2u);
  view->SetFilter(view.Filter.Get());
  view->SetInteractor(nullptr);
  view->Restart();
  EXPECT_EQ(view.Errors.size(), 3u);
  view->SetInteractor(view.Interactor);
  view->Start();
  EXPECT_EQ(view.Errors.size(), 3u);
  EXPECT_EQ(view->GetFrameNumber(), 0);
}

TEST(LiveView, TimersOfOthersAreLeftAlone)
{
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  WatchedView view;
  interactor->SetRenderWindow(view.Window);
  interactor->Initialize();
  interactor->TimerEventResetsTimerOff();
  view->SetInteractor(interactor);
  view->Run();
  EXPECT_EQ(view.Errors.size(), 1u); // nothing makes timers
  EXPECT_FALSE(view->IsRunning());
  EnableTimers(interactor);
  view->Run();
  ASSERT_TRUE(view->IsRunning());
  int mine = interactor->GetTimerEventId();
  int other = mine + 1;
  interactor->InvokeEvent(vtkCommand::TimerEvent, &other);
  EXPECT_EQ(view->GetFrameNumber(), 0);
  interactor->InvokeEvent(vtkCommand::TimerEvent, &mine);
  EXPECT_EQ(view->GetFrameNumber(), 1);
}

TEST(LiveView, AnyOrderOfDeletion)
{
  WatchedView other; // A virtual display resets when its last window is closed.
  other->Start();
  std::array<int, 4> order = { 0, 1, 2, 3 };
  do
  {
    auto view = vtkSmartPointer<vtkDelaunayFlipLiveView>::New();
    auto filter = vtkSmartPointer<vtkDelaunayFlip>::New();
    auto interactor = vtkSmartPointer<vtkGenericRenderWindowInteractor>::New();
    auto window = vtkSmartPointer<vtkRenderWindow>::New();
    window->OffScreenRenderingOn();
    interactor->SetRenderWindow(window);
    EnableTimers(interactor);
    filter->SetInputData(MakeRhombus());
    view->SetFilter(filter);
    view->SetInteractor(interactor);
    view->Run();
    EXPECT_TRUE(view->IsRunning());
    for (const int which : order)
    {
      view = which == 0 ? nullptr : view;
      filter = which == 1 ? nullptr : filter;
      interactor = which == 2 ? nullptr : interactor;
      window = which == 3 ? nullptr : window;
      if (interactor)
      {
        interactor->SetKeySym("n");
        interactor->InvokeEvent(vtkCommand::KeyPressEvent);
        interactor->InvokeEvent(vtkCommand::TimerEvent);
      }
      if (view)
      {
        view->Step();
        view->Pause();
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(LiveView, LeavesNothingBehind)
{
  WatchedView view;
  view.Interactor->SetInteractorStyle(nullptr);
  view->Start();
  vtkRenderer* renderer = view->GetRenderer();
  EXPECT_EQ(renderer->GetViewProps()->GetNumberOfItems(), 4);
  view.View = nullptr;
  EXPECT_EQ(renderer->GetViewProps()->GetNumberOfItems(), 0);
  EXPECT_FALSE(view.Interactor->HasObserver(vtkCommand::TimerEvent));
  EXPECT_FALSE(view.Interactor->HasObserver(vtkCommand::KeyPressEvent));
  EXPECT_FALSE(view.Interactor->HasObserver(vtkCommand::CharEvent));
}

TEST(LiveView, ObserversMayDoAnything)
{
  WatchedView view(MakeBadPlane(), false);
  OnProgress(view.Filter.Get(), [&view]() { view->Restart(); }); // ignored while it executes
  view->Step();
  view->Step();
  EXPECT_EQ(view->GetFrameNumber(), 2);
  OnProgress(view.Filter.Get(), [&view]() { view->SetFilter(nullptr); });
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view->GetFrameNumber(), -1);
  EXPECT_FALSE(view->IsRunning());
}

TEST(LiveView, ObserversOfTheStartMayDoAnything)
{
  WatchedView view;
  OnEvent(view.Filter.Get(), vtkCommand::ModifiedEvent, [&view]() { view->Restart(); });
  view->Start();
  EXPECT_EQ(view->GetFrameNumber(), 0);
  OnEvent(view.Filter.Get(), vtkCommand::ModifiedEvent, [&view]() { view->SetFilter(nullptr); });
  view->Restart();
  EXPECT_EQ(view->GetFrameNumber(), -1);
}

TEST(LiveView, AnObserverMayThrow)
{
  WatchedView view;
  view->Start();
  int calls = 0;
  OnProgress(view.Filter.Get(),
    [&calls]() { calls++ == 0 ? throw std::runtime_error("by an observer") : void(); });
  EXPECT_THROW(view->Step(), std::runtime_error);
  view.StepToTheEnd();
  EXPECT_TRUE(view->GetConverged());
}

TEST(LiveView, AnObserverOfTheRendererMayEndTheRun)
{
  WatchedView view;
  view->ShowDrawingOn(); // another text at the first step: drawn twice
  view->Start();
  OnEvent(view->GetRenderer(), vtkCommand::EndEvent, [&view]() { view->SetFilter(nullptr); });
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view->GetFrameNumber(), -1);
}

TEST(LiveView, MayBeDeletedByAnObserver)
{
  using Call = void (*)(WatchedView&);
  for (const Call call :
    { Call([](WatchedView& view) { view->Start(); }), Call([](WatchedView& view) { view->Run(); }),
      Call([](WatchedView& view) { view->Step(); }),
      Call([](WatchedView& view) { view->Restart(); }),
      Call([](WatchedView& view) { view->Pause(); }),
      Call([](WatchedView& view) { view.Press("n"); }) })
  {
    WatchedView view;
    view->Start();
    const vtkWeakPointer<vtkDelaunayFlipLiveView> same(view.View);
    OnEvent(view->GetRenderer(), vtkCommand::EndEvent,
      [&]()
      {
        view.View = nullptr;
        EXPECT_NE(same.Get(), nullptr);
      });
    call(view);
    EXPECT_EQ(same.Get(), nullptr);
  }
}

TEST(LiveViewPicture, Texts)
{
  WatchedView view(MakeRhombus(), false);
  view->Start();
  EXPECT_EQ(view.GetStatus(), "input, paused\n2 triangles\nsmallest angle 18.43 degrees");
  EXPECT_EQ(view.GetKeys().find("space: run/pause"), 0u);
  EXPECT_NE(view.GetKeys().find("\n"), std::string::npos); // the window is narrow
  view->Run();
  EXPECT_EQ(view.GetStatus().find("input, running"), 0u);
  view->Step();
  EXPECT_EQ(view.GetStatus(),
    "iteration 1, converged\n1 flip, 0 bad edges left\nsmallest angle 36.87 degrees");
  view->ShowKeysOff();
  view->Render();
  EXPECT_EQ(view.GetKeys(), "");
}

TEST(LiveViewPicture, StatisticsCanBeTurnedOff)
{
  WatchedView view;
  view->Step();
  const Bytes before = view.GetPicture();
  view->ShowStatisticsOff();
  view->Render();
  EXPECT_EQ(view.GetStatus(), "");
  EXPECT_EQ(view.GetKeys(), ""); // in a window off the screen
  EXPECT_NE(view.GetPicture(), before);
  view->ShowStatisticsOn();
  view->Render();
  EXPECT_EQ(view.GetPicture(), before);
}

TEST(LiveViewPicture, Colors)
{
  WatchedView view;
  std::set<Bytes> pictures;
  view->Step();
  pictures.insert(view.GetPicture());
  view->SetColorByToFlipCount();
  view->Render();
  pictures.insert(view.GetPicture());
  view->SetColorByToSolid();
  view->Render();
  pictures.insert(view.GetPicture());
  view->SetEdgeVisibilityToOff();
  view->Render();
  EXPECT_FALSE(view.HasEdges());
  pictures.insert(view.GetPicture());
  EXPECT_EQ(pictures.size(), 4u);
}

TEST(LiveViewPicture, EdgesOfLargeMeshesAreHidden)
{
  WatchedView view(ToPolyData(delaunayflip::MakeRandomBadMeshDouble(10100, 3)));
  view->Start();
  EXPECT_EQ(view.GetStatus().find("input, running\n20,"), 0u) << view.GetStatus();
  EXPECT_FALSE(view.HasEdges());
  view->SetEdgeVisibilityToOn();
  view->Render();
  EXPECT_TRUE(view.HasEdges());
}

TEST(LiveViewPicture, LooksAtFlatMeshesFromTheirSide)
{
  const int up[3] = { 2, 2, 1 };
  for (int axis = 0; axis < 3; ++axis)
  {
    auto mesh = MakeRhombus();
    MovePoints(mesh, [axis](double* x) { std::swap(x[2], x[axis]); });
    WatchedView view(mesh);
    view->Start();
    vtkCamera* camera = view->GetRenderer()->GetActiveCamera();
    EXPECT_NEAR(std::abs(camera->GetDirectionOfProjection()[axis]), 1.0, 1e-9);
    EXPECT_NEAR(camera->GetViewUp()[up[axis]], 1.0, 1e-9);
  }
}

TEST(LiveViewPicture, KeepsACamera)
{
  WatchedView view;
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.1, 0.1, 0.2);
  renderer->GetActiveCamera()->SetPosition(0.0, -5.0, 1.0);
  view.Window->AddRenderer(renderer);
  view->Step();
  EXPECT_EQ(view->GetRenderer(), renderer.Get());
  EXPECT_EQ(renderer->GetActiveCamera()->GetPosition()[1], -5.0);
}

TEST(LiveViewPicture, EveryFrameIsWritten)
{
  const TemporaryFolder folder;
  WatchedView view;
  view->SetFramePrefix((folder / "run_").c_str());
  while (view->Step())
  {
    const std::string number = std::to_string(1000000 + view->GetFrameNumber()).substr(3);
    EXPECT_EQ(ReadPicture(folder / ("run_" + number + ".png").c_str()), view.GetPicture());
  }
  EXPECT_EQ(folder.CountFiles(), view->GetFrameNumber() + 1);
  EXPECT_TRUE(fs::exists(folder / "run_0000.png"));
  EXPECT_TRUE(view.Errors.empty());
  view->Restart();
  EXPECT_EQ(folder.CountFiles(), view.Filter->GetNumberOfIterations() + 1);
}

TEST(LiveViewPicture, AFrameThatCannotBeWrittenEndsTheWriting)
{
  const TemporaryFolder folder;
  const bool canBeFull = fs::exists("/dev/full");
  if (canBeFull)
  {
    fs::create_symlink("/dev/full", folder / "full0001.png");
  }
  for (const char* prefix : { "missing/f", "full" })
  {
    WatchedView view;
    view->SetFramePrefix((folder / prefix).c_str());
    view.StepToTheEnd();
    EXPECT_TRUE(view->GetConverged());
    if (prefix[0] == 'm' || canBeFull)
    {
      ASSERT_EQ(view.Errors.size(), 1u);
      ExpectHolds(view.Errors[0], prefix);
    }
    view->SetFramePrefix((folder / "f").c_str());
    view->Restart();
    EXPECT_TRUE(fs::exists(folder / "f0000.png"));
  }
  EXPECT_FALSE(canBeFull && fs::exists(folder / "full0002.png"));
}
