// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: LiveFlip [MESH.vtp] [--frames PREFIX]
///
/// Shows in a window how a mesh, by default a bad one made here, flips its way to Delaunay; the
/// window names the keys. With --frames no window opens: every step is written as PREFIX0000.png,
/// PREFIX0001.png and so on, and the last mesh as PREFIX.vtp.

#include "BadMesh.h"

#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{

/// Off screen, step by step.
bool WriteFrames(vtkDelaunayFlipLiveView* view, vtkRenderWindow* window, const std::string& prefix)
{
  window->OffScreenRenderingOn();
  window->SetMultiSamples(0);
  window->SetSize(360, 360);
  view->SetFramePrefix(prefix.c_str());
  while (view->Step())
  {
  }
  std::cout << view->GetFrameNumber() << " steps, " << view->GetFilter()->GetTotalFlips()
            << " flips\n";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // ParaView 5.11 with a newer expat fails on appended data
  writer->SetInputConnection(view->GetFilter()->GetOutputPort());
  writer->SetFileName((prefix + ".vtp").c_str());
  writer->Write();
  return writer->GetErrorCode() == 0 && view->GetConverged();
}

}

int main(int argc, char* argv[])
{
  std::vector<std::string> arguments(argv + 1, argv + argc);
  std::string prefix;
  if (arguments.size() > 1 && arguments[arguments.size() - 2] == "--frames")
  {
    prefix = arguments.back();
    arguments.resize(arguments.size() - 2);
  }

  vtkNew<vtkXMLPolyDataReader> reader;
  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(MakeBadMesh());
  if (!arguments.empty())
  {
    reader->SetFileName(arguments[0].c_str());
    flip->SetInputConnection(reader->GetOutputPort());
  }

  vtkNew<vtkRenderWindow> window;
  window->SetWindowName("Delaunay flips");
  window->SetSize(700, 700);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  vtkNew<vtkDelaunayFlipLiveView> view;
  view->SetFilter(flip);
  view->SetInteractor(interactor);
  if (!prefix.empty())
  {
    return WriteFrames(view, window, prefix) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  view->SetFrameInterval(200);
  view->Run();
  interactor->Start();
  return EXIT_SUCCESS;
}
