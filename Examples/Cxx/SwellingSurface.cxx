// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: SwellingSurface [--points N] [--frames N] [--backend auto|threads|cuda] [--threads N]
///                        [--window]
///
/// A hill swells on a plane and sinks again, and the mesh is kept Delaunay: every frame moves the
/// points and continues from the triangles of the frame before, so that few flips are left to do.
/// Prints the frames per second; with --window it also draws them, and keeps the window until q is
/// pressed.
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDelaunayFlip.h>
#include <vtkDelaunayFlipLiveView.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>

namespace
{

struct Settings
{
  int Points = 20000;
  int Frames = 120;
  int Threads = 0;
  int Backend = vtkDelaunayFlip::BACKEND_AUTO;
  bool HasWindow = false;
};

/// A unit square of about so many points, somewhat off a lattice.
vtkSmartPointer<vtkPolyData> MakePlane(int points)
{
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(points))));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.35, 0.35);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(vtkNew<vtkPoints>());
  mesh->GetPoints()->SetDataTypeToDouble();
  mesh->SetPolys(vtkNew<vtkCellArray>());
  for (vtkIdType id = 0; id < side * side; ++id)
  {
    const auto column = static_cast<double>(id % side), row = static_cast<double>(id / side);
    const double x = (column + jitter(random)) / (side - 1),
                 y = (row + jitter(random)) / (side - 1);
    mesh->GetPoints()->InsertNextPoint(x, y, 0.0);
    if (id % side + 1 < side && id / side + 1 < side)
    {
      mesh->GetPolys()->InsertNextCell({ id, id + 1, id + side + 1 });
      mesh->GetPolys()->InsertNextCell({ id, id + side + 1, id + side });
    }
  }
  return mesh;
}

/// Lifts the points for a moment of the animation, which repeats itself every 100 frames.
void Swell(vtkPoints* points, int frame)
{
  constexpr double turn = 6.283185307179586;
  const double height = 0.4 * std::sin(turn * frame / 100.0);
  auto* xyz = static_cast<double*>(points->GetVoidPointer(0));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const double x = xyz[3 * i] - 0.5, y = xyz[3 * i + 1] - 0.5;
    xyz[3 * i + 2] = height * std::exp(-16.0 * (x * x + y * y));
  }
  points->Modified();
}

/// Calls show() for every frame, with the points moved. @returns seconds.
double Animate(vtkPoints* points, int frames, const std::function<void()>& show)
{
  const auto start = std::chrono::steady_clock::now();
  for (int frame = 1; frame <= frames; ++frame)
  {
    Swell(points, frame);
    show();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A window that looks at the hill from the side and from above.
void OpenWindow(vtkRenderWindow* window)
{
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->GetActiveCamera()->SetPosition(0.5, -1.5, 1.3);
  renderer->GetActiveCamera()->SetFocalPoint(0.5, 0.5, 0.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  window->AddRenderer(renderer);
  window->SetSize(900, 700);
  window->SetWindowName("A swelling surface");
}

/// @returns the exit status for the command line, or -1 to go on.
int ReadArguments(int argc, char* argv[], Settings& settings)
{
  CLI::App app("Keeps a surface Delaunay while its points move.\n"
               "Exit status: 0 done, 2 wrong usage, 3 the filter failed.");
  app.add_option("--points", settings.Points, "the number of points, about")
    ->check(CLI::Range(4, 100000000));
  app.add_option("--frames", settings.Frames, "the number of frames")->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.Threads, "of the CPU; 0: all")
    ->check(CLI::NonNegativeNumber);
  const std::map<std::string, int> backends = { { "auto", vtkDelaunayFlip::BACKEND_AUTO },
    { "threads", vtkDelaunayFlip::BACKEND_THREADS }, { "cuda", vtkDelaunayFlip::BACKEND_CUDA } };
  app.add_option("--backend", settings.Backend, "where the flips are made")
    ->transform(CLI::CheckedTransformer(backends));
  app.add_flag("--window", settings.HasWindow, "draw the frames, and wait for the key q");
  try
  {
    app.parse(argc, argv);
    return -1;
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? 0 : 2;
  }
}

}

int main(int argc, char* argv[])
{
  Settings settings;
  const int status = ReadArguments(argc, argv, settings);
  if (status >= 0)
  {
    return status;
  }
  const vtkSmartPointer<vtkPolyData> mesh = MakePlane(settings.Points);
  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(mesh);
  flip->SetGeometryToSurface();
  flip->SetFeatureAngle(180.0); // no edge stays because it is sharp
  flip->SetBackend(settings.Backend);
  flip->SetNumberOfThreads(settings.Threads);
  flip->LiveUpdateOn(); // which lets a run continue from the triangles of the last one
  flip->SetIterationsPerUpdate(1000000); // each frame to its end
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkDelaunayFlipLiveView> view;
  vtkIdType flips = 0;
  std::function<void()> show = [&]() { flip->Update(); };
  if (settings.HasWindow)
  {
    OpenWindow(window);
    interactor->SetRenderWindow(window);
    view->SetFilter(flip);
    view->SetInteractor(interactor);
    view->ShowKeysOff();
    show = [&]() { view->Step(); };
  }
  show(); // the input, which takes longer
  const double seconds = Animate(mesh->GetPoints(), settings.Frames,
    [&]()
    {
      show();
      flips += flip->GetTotalFlips();
    });
  if (flip->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
  {
    std::fprintf(stderr, "error: %s\n", flip->GetErrorMessage());
    return 3;
  }
  std::printf("%d frames of %lld points in %.2f s: %.0f per second; %lld flips, %lld bad edges "
              "left, %s\n",
    settings.Frames, static_cast<long long>(mesh->GetNumberOfPoints()), seconds,
    settings.Frames / seconds, static_cast<long long>(flips),
    static_cast<long long>(flip->GetNonDelaunayAfter()), flip->GetBackendUsed());
  if (settings.HasWindow)
  {
    std::fflush(stdout);
    interactor->Start();
  }
  return 0;
}
