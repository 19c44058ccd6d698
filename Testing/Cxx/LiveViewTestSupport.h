// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveViewTestSupport_h
#define LiveViewTestSupport_h

#include "FilterTestSupport.h"

#include "vtkDelaunayFlipLiveView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <functional>
#include <string>
#include <vector>

/// What the tests of vtkDelaunayFlipLiveView share.

vtkSmartPointer<vtkPolyData> MakeBadPlane();

/// Calls a function at every event of an object.
void OnEvent(vtkObject* object, unsigned long event, const std::function<void()>& action);

/// A view with a filter, an interactor and a window, and with all that it tells.
class WatchedView
{
public:
  explicit WatchedView(vtkPolyData* input = MakeBadPlane(), bool isOffScreen = true);
  WatchedView(const WatchedView&) = delete;
  WatchedView& operator=(const WatchedView&) = delete;

  vtkDelaunayFlipLiveView* operator->() { return this->View; }

  /// Runs, in the event loop, until the run has ended; a failure when that takes a minute. Like
  /// RunFor() once a process: X interactors are listed for all event loops, also when deleted.
  void RunToTheEnd();

  /// The event loop for some milliseconds.
  void RunFor(unsigned long milliseconds);

  /// As if a key were pressed in the window. @returns whether others heard of it.
  bool Press(const char* key);

  /// What the window says; "" where it says nothing.
  std::string GetStatus();
  std::string GetKeys();

  /// The array that triangles are coloured by, or "".
  std::string GetColorArray();
  bool HasEdges();
  vtkIdType GetNumberOfTriangles();

  WatchedFilter Filter;
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkRenderWindowInteractor> Interactor;
  vtkSmartPointer<vtkDelaunayFlipLiveView> View;
  int Frames = 0; ///< UpdateEvents.
  int Starts = 0;
  int Ends = 0;
  std::vector<std::string> Errors;
};

#endif
