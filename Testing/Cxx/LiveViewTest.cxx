// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Live views: timer, keys and states, also in case of failures.

#include "LiveViewTestSupport.h"

#include "vtkGenericRenderWindowInteractor.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPoints.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

namespace
{

Cells FlipAtOnce(vtkPolyData* mesh)
{
  WatchedFilter filter(mesh);
  return GetCells(RunCleanly(filter)->GetPolys());
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

Cells GetTriangles(WatchedView& view) { return GetCells(view.Filter->GetOutput()->GetPolys()); }

}

TEST(LiveView, TimerRunsItToTheEnd)
{
  auto mesh = MakeBadPlane();
  WatchedView view(mesh, false);
  OnEvent(view.View, vtkCommand::EndEvent, [&view]() { view.Interactor->TerminateApp(); });
  view->Run();
  view.Interactor->Start();
  EXPECT_TRUE(view->GetConverged());
  EXPECT_FALSE(view->IsRunning());
  EXPECT_EQ(view.Ends, 1);
  EXPECT_EQ(view.Starts, 1);
  EXPECT_GT(view->GetFrameNumber(), 5);
  EXPECT_EQ(view->GetFrameNumber(), view.Filter->GetNumberOfIterations());
  EXPECT_EQ(view.Frames, view->GetFrameNumber() + 1);
  EXPECT_EQ(GetTriangles(view), FlipAtOnce(mesh));
  EXPECT_TRUE(view.Filter.GetErrors().empty() && view.Filter.GetWarnings().empty());
}

TEST(LiveView, NoTimerIsLeftAfterTheEnd)
{
  WatchedView view(MakeBadPlane(), false);
  int timerEvents = 0;
  OnEvent(view.Interactor, vtkCommand::TimerEvent, [&timerEvents]() { ++timerEvents; });
  view->Run();
  const int others = view.RunUntilItStops();
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(timerEvents, view->GetFrameNumber() + others);
}

TEST(LiveView, StepByStep)
{
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  EXPECT_EQ(view->GetFrameNumber(), -1);
  view->Start();
  EXPECT_EQ(view->GetFrameNumber(), 0);
  int steps = 1;
  while (view->Step())
  {
    EXPECT_EQ(view->GetFrameNumber(), steps++);
    EXPECT_FALSE(view->GetConverged());
  }
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), steps);
  EXPECT_EQ(view.Frames, steps + 1);
  EXPECT_EQ(view.Ends, 1);
  EXPECT_EQ(GetTriangles(view), FlipAtOnce(mesh));
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view.Frames, steps + 1);
  EXPECT_EQ(view.Ends, 1);
}

TEST(LiveView, SeveralIterationsAStep)
{
  WatchedView view;
  view.Filter->SetIterationsPerUpdate(4);
  view->Step();
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 4);
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
  view->Step();
  view.Filter->Advance();
  view.Window->Render();
  view->Render();
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 1);
  EXPECT_EQ(view->GetFrameNumber(), 1);
}

TEST(LiveView, SaysWhyItDrawsFromCopies)
{
  const std::string copies = "drawn from copies: ";
  WatchedView view(MakeBadPlane(), false);
  view.Filter->SetBackendToThreads();
  EXPECT_EQ(view->GetDrawing(), copies + "no step has been made yet");
  view->Step();
  const std::string drawing = view->GetDrawing();
  EXPECT_EQ(drawing.find(copies), 0u);
  EXPECT_GT(drawing.size(), copies.size() + 10);
  EXPECT_EQ(Unwrap(view.GetStatus()).find(copies), std::string::npos);
  view.Press("d");
  EXPECT_NE(Unwrap(view.GetStatus()).find(drawing), std::string::npos) << view.GetStatus();
  view->ZeroCopyOff();
  view->Step();
  EXPECT_EQ(view->GetDrawing(), copies + "ZeroCopy is off");
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

TEST(LiveView, RestartKeepsItsPace)
{
  WatchedView view(MakeBadPlane(), false);
  view->Step();
  view->Restart();
  EXPECT_EQ(view->GetFrameNumber(), 0);
  EXPECT_FALSE(view->IsRunning());
  view->Run();
  view->Restart();
  EXPECT_TRUE(view->IsRunning());
  view.RunToTheEnd();
  const int steps = view->GetFrameNumber();
  view->Restart();
  EXPECT_TRUE(view->IsRunning());
  EXPECT_FALSE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), 0);
  while (view->Step())
  {
  }
  EXPECT_EQ(view->GetFrameNumber(), steps);
}

TEST(LiveView, MovedPointsContinueAfterTheEnd)
{
  auto mesh = MakeBadPlane();
  WatchedView view(mesh);
  while (view->Step())
  {
  }
  const int steps = view->GetFrameNumber();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* x = mesh->GetPoint(i);
    mesh->GetPoints()->SetPoint(i, x[0] + 0.3 * x[1], x[1], x[2]);
  }
  mesh->GetPoints()->Modified();
  while (view->Step())
  {
  }
  EXPECT_GT(view->GetFrameNumber(), steps);
  EXPECT_EQ(CountViolations(view.Filter->GetOutput()), 0);
}

TEST(LiveView, CompositeInputTakesOneStep)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeBadPlane());
  blocks->SetBlock(1, MakeRhombus());
  WatchedView view;
  view.Filter->SetInputDataObject(blocks);
  view.Filter->LiveUpdateOn();
  view->Start();
  EXPECT_FALSE(view->Step());
  EXPECT_TRUE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_EQ(view.GetNumberOfTriangles(), MakeBadPlane()->GetNumberOfCells() + 2);
  EXPECT_EQ(view.GetStatus().find("all blocks in one step, converged\n"), 0u);
  EXPECT_NE(view.GetStatus().find(" flips, 0 bad edges left\n"), std::string::npos);
  EXPECT_TRUE(view.Filter.GetWarnings().empty());
}

TEST(LiveView, IterationLimitEndsIt)
{
  WatchedView view;
  view.Filter->SetMaximumIterations(2);
  EXPECT_TRUE(view->Step());
  EXPECT_FALSE(view->Step());
  EXPECT_FALSE(view->GetConverged());
  EXPECT_EQ(view.Ends, 1);
  EXPECT_EQ(view.GetStatus().find("iteration 2, iteration limit"), 0u);
}

TEST(LiveView, AnAbortPausesIt)
{
  WatchedView view(MakeBadPlane(), false);
  auto stop = [&view]()
  { view.Filter->SetAbortExecute(view.Filter->GetNumberOfIterations() == 2); };
  OnProgress(view.Filter.Get(), stop);
  OnEvent(view.Filter.Get(), vtkCommand::AbortCheckEvent, []() {});
  view->Run();
  view.RunUntilItStops();
  EXPECT_FALSE(view->IsRunning());
  EXPECT_EQ(view->GetFrameNumber(), 2);
  EXPECT_EQ(view.GetStatus().find("iteration 2, aborted"), 0u);
  view.Filter->SetAbortExecute(0);
  while (view->Step())
  {
  }
  EXPECT_TRUE(view->GetConverged());
}

TEST(LiveView, AFailureEndsTheRun)
{
  WatchedView view(MakeBadPlane(), false);
  view->Step();
  view.Filter->SetTolerance(2.0);
  view.RunToTheEnd();
  EXPECT_FALSE(view->IsRunning());
  EXPECT_FALSE(view->GetConverged());
  EXPECT_EQ(view->GetFrameNumber(), 1);
  EXPECT_EQ(view.GetNumberOfTriangles(), MakeBadPlane()->GetNumberOfCells());
  EXPECT_EQ(
    Unwrap(view.GetStatus())
      .find("failed: " + std::string(view.Filter->GetErrorMessage()) + " the mesh of frame 1"),
    0u);
  EXPECT_EQ(view.Filter.GetErrors().size(), 1u);
  view.Filter->SetTolerance(0.0);
  EXPECT_TRUE(view->Step());
  EXPECT_EQ(view->GetFrameNumber(), 2);
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
  auto restart = [&view]() { view->Restart(); };
  OnProgress(view.Filter.Get(), restart); // ignored while the filter executes
  view->Step();
  view->Step();
  EXPECT_EQ(view->GetFrameNumber(), 2);
  auto drop = [&view]() { view->SetFilter(nullptr); };
  OnProgress(view.Filter.Get(), drop);
  EXPECT_FALSE(view->Step());
  EXPECT_EQ(view->GetFrameNumber(), -1);
  EXPECT_FALSE(view->IsRunning());
}

TEST(LiveView, MayBeDeletedByAnObserver)
{
  WatchedView view(MakeBadPlane(), false);
  view->Start();
  OnEvent(view.View, vtkCommand::UpdateEvent, [&view]() { view.View = nullptr; });
  view.Press("n");
  EXPECT_EQ(view.View, nullptr);
  EXPECT_EQ(view.Filter->GetNumberOfIterations(), 1);
}
