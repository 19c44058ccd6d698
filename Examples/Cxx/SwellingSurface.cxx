// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: SwellingSurface [--points N] [--frames N] [--backend auto|threads|cuda] [--threads N]
///                        [--window]
///
/// A hill swells on a plane and sinks again, and the mesh is kept Delaunay: every frame moves the
/// points and continues from the triangles of the frame before, so that few flips are left to do.
/// Prints the frames per second; with --window it also draws them, and keeps the window until q is
/// pressed.
#include "MovingSurface.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace
{

/// Lifts the points for a moment of the animation, which repeats itself every 100 frames.
void Swell(const MovingSurface& surface, int frame)
{
  constexpr double turn = 6.283185307179586;
  const double height = 0.4 * std::sin(turn * frame / 100.0);
  double* const xyz = surface.GetCoordinates();
  for (vtkIdType i = 0; i < surface.Points->GetNumberOfPoints(); ++i)
  {
    const double x = xyz[3 * i] - 0.5, y = xyz[3 * i + 1] - 0.5;
    xyz[3 * i + 2] = height * std::exp(-16.0 * (x * x + y * y));
  }
  surface.Points->Modified();
}

/// Shows every frame. @returns seconds.
double Animate(MovingSurface& surface, int frames)
{
  const auto start = std::chrono::steady_clock::now();
  for (int frame = 1; frame <= frames; ++frame)
  {
    Swell(surface, frame);
    surface.Show();
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}

int main(int argc, char* argv[])
{
  int points = 20000, frames = 120, threads = 0, backend = vtkDelaunayFlip::BACKEND_AUTO;
  bool hasWindow = false;
  CLI::App app("Keeps a surface Delaunay while its points move.\n"
               "Exit status: 0 done, 2 wrong usage, 3 the filter failed.");
  app.add_option("--points", points, "the number of points, about")
    ->check(CLI::Range(4, 100000000));
  app.add_option("--frames", frames, "the number of frames")->check(CLI::PositiveNumber);
  app.add_option("--threads", threads, "of the CPU; 0: all")->check(CLI::NonNegativeNumber);
  const std::map<std::string, int> backends = { { "auto", vtkDelaunayFlip::BACKEND_AUTO },
    { "threads", vtkDelaunayFlip::BACKEND_THREADS }, { "cuda", vtkDelaunayFlip::BACKEND_CUDA } };
  app.add_option("--backend", backend, "where the flips are made")
    ->transform(CLI::CheckedTransformer(backends));
  app.add_flag("--window", hasWindow, "draw the frames, and wait for the key q");
  const int status = ReadArguments(app, argc, argv);
  if (status >= 0)
  {
    return status;
  }
  MovingSurface surface(points, [](double, double) { return 0.0; });
  surface.Flip->SetBackend(backend);
  surface.Flip->SetNumberOfThreads(threads);
  if (hasWindow)
  {
    surface.OpenWindow("A swelling surface");
  }
  surface.Show(); // the input, which takes longer
  const double seconds = Animate(surface, frames);
  if (surface.HasFailed())
  {
    return 3;
  }
  std::printf("%d frames of %lld points in %.2f s: %.0f per second; %lld flips, %lld bad edges "
              "left, %s\n",
    frames, static_cast<long long>(surface.Points->GetNumberOfPoints()), seconds, frames / seconds,
    static_cast<long long>(surface.Flips),
    static_cast<long long>(surface.Flip->GetNonDelaunayAfter()), surface.Flip->GetBackendUsed());
  if (hasWindow)
  {
    std::fflush(stdout);
    surface.Interactor->Start();
  }
  return 0;
}
