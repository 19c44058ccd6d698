// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: LiveFlip [MESH] [--geometry auto|planar|planar-xy|surface] [--frames PREFIX]
///
/// Shows in a window how flips make a mesh Delaunay, by default a generated bad one. The window
/// explains the keys. With --frames no window opens: every step is written as PREFIX0000.png,
/// PREFIX0001.png and so on, and the last mesh as PREFIX.vtp.
#include "ExampleFiles.h"

#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

int main(int argc, char* argv[])
{
  ExampleFiles files;
  if (const auto status = files.ReadArguments(argc, argv))
  {
    return *status;
  }
  const auto mesh = files.ReadMesh();
  if (!mesh)
  {
    return BadFile;
  }
  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(mesh);
  flip->SetGeometry(files.GetGeometry());
  vtkNew<vtkRenderWindow> window;
  window->SetWindowName("Delaunay flips");
  window->SetSize(700, 700);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(vtkNew<vtkInteractorStyleTrackballCamera>());
  vtkNew<vtkDelaunayFlipLiveView> view;
  view->SetFilter(flip);
  view->SetInteractor(interactor);
  if (!files.GetFramePrefix().empty())
  {
    return files.WriteFrames(view, window);
  }
  view->SetFrameInterval(200); // milliseconds
  view->Run();
  interactor->Start();
  return Done;
}
