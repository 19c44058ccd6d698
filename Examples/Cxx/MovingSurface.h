// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef MOVINGSURFACE_H
#define MOVINGSURFACE_H

#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <functional>
#include <string>

namespace CLI
{
class App;
}

/// A square of points that move. After each move the filter continues from its last triangles, so
/// that few flips are left to do.
class MovingSurface
{
public:
  /// Makes about so many points, somewhat off a lattice from 0 to 1.
  MovingSurface(int points, const std::function<double(double, double)>& height);

  void OpenWindow(const char* title);

  /// Opens no window, but writes what it would show as PREFIX0000.png, PREFIX0001.png and so on.
  void WriteFrames(const std::string& prefix);

  /// Flips until no edge is bad, and draws if there is a window.
  void Show();

  /// x, y and z by point. Call Points->Modified() when they have changed.
  double* GetCoordinates() const;

  /// Prints an error if the filter has failed. @returns whether it has.
  bool HasFailed() const;

  vtkNew<vtkPoints> Points;
  vtkNew<vtkDelaunayFlip> Flip;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkIdType Flips = 0; ///< Since the second call of Show.

private:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkDelaunayFlipLiveView> View;
  bool HasWindow = false, IsShown = false;
};

/// @returns the exit status for the command line, or -1 to go on.
int ReadArguments(CLI::App& app, int argc, char* argv[]);

#endif
