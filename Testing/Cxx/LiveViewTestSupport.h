// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef LiveViewTestSupport_h
#define LiveViewTestSupport_h

#include "FilterTestSupport.h"

#include "vtkDelaunayFlipLiveView.h"
#include "vtkDelaunayFlipMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"

#include <string>
#include <vector>

class vtkActor;

/// Helpers for the tests of vtkDelaunayFlipLiveView.

using Bytes = std::vector<unsigned char>;

/// A view with a filter, an interactor and a window, which records events and errors.
class WatchedView
{
public:
  explicit WatchedView(vtkPolyData* input = MakeBadPlane(), bool isOffScreen = true);
  WatchedView(const WatchedView&) = delete;
  WatchedView& operator=(const WatchedView&) = delete;

  vtkDelaunayFlipLiveView* operator->() { return this->View; }

  /// Runs the event loop until the end of the run; reports a failure after a minute. This and
  /// RunUntilItStops() can be used once per process: event loops visit all X interactors, even
  /// deleted ones.
  void RunToTheEnd();

  /// Runs the event loop while the view runs, a minute at most, and then for 300 to 600 ms, in
  /// which nothing should follow. @returns how many TimerEvents it caused itself.
  int RunUntilItStops();

  /// Simulates a key press in the window. @returns whether other observers received it.
  bool Press(const char* key);

  /// The statistics in the window; "" if there are none.
  std::string GetStatus();
  std::string GetKeys();

  /// The pixels of the window.
  Bytes GetPicture();

  bool HasEdges();
  vtkActor* GetActor();
  vtkDelaunayFlipMapper* GetMapper();

  /// Makes steps until the run ends.
  void StepToTheEnd();

  WatchedFilter Filter;
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkRenderWindowInteractor> Interactor;
  vtkSmartPointer<vtkDelaunayFlipLiveView> View;
  int Frames = 0; ///< UpdateEvents.
  int Starts = 0;
  int Ends = 0;
  std::vector<std::string> Errors;
};

/// A run that is drawn twice: from the host, and without copies as far as possible.
struct ViewPair
{
  explicit ViewPair(vtkPolyData* mesh);

  /// A step of both, which must give the same picture and status. @returns whether another can
  /// follow.
  bool Step();

  void ExpectSamePicture();

  WatchedView Copying, Sharing;
};

/// The share of pixels with a component that differs by more than 8 of 255.
double Compare(const Bytes& a, const Bytes& b);

#endif
