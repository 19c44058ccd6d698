// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: ErodingTerrain [--points N] [--strokes N] [--window | --frames PREFIX]
///
/// A brush digs a river into terrain, and the surface is kept Delaunay: every stroke lowers points
/// and continues from the triangles of the stroke before. Prints the number of flips. With --window
/// it draws the strokes; then the key l lowers the terrain under the mouse, u lifts it, and q
/// closes the window. With --frames it opens no window and writes every stroke as a picture:
/// PREFIX0000.png and so on.
#include "MovingSurface.h"

#include <vtkCallbackCommand.h>
#include <vtkWorldPointPicker.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <string>

namespace
{

double FindHeight(double x, double y)
{
  const double hills = std::sin(7.0 * x + 1.0) * std::cos(5.0 * y);
  return 0.06 * hills + 0.01 * std::sin(40.0 * x * y);
}

/// Moves the points around (x, y) by up to `height`, in a bell-shaped brush.
void Brush(const MovingSurface& surface, double x, double y, double height)
{
  constexpr double Width = 0.04;
  double* const xyz = surface.GetCoordinates();
  for (vtkIdType i = 0; i < surface.Points->GetNumberOfPoints(); ++i)
  {
    const double dx = (xyz[3 * i] - x) / Width, dy = (xyz[3 * i + 1] - y) / Width;
    xyz[3 * i + 2] += height * std::exp(-dx * dx - dy * dy);
  }
  surface.Points->Modified();
}

/// Makes a stroke along a river that winds through the terrain. Neighbouring strokes overlap.
void DigRiver(const MovingSurface& surface, int stroke, int strokes)
{
  const double y = static_cast<double>(stroke) / strokes;
  Brush(surface, 0.5 + 0.25 * std::sin(7.0 * y), y, -0.5 / strokes);
}

/// Lowers or lifts the terrain under the mouse when a key is pressed.
void Press(vtkObject*, unsigned long, void* data, void*)
{
  auto& surface = *static_cast<MovingSurface*>(data);
  const char key = surface.Interactor->GetKeyCode();
  if (key != 'l' && key != 'u')
  {
    return;
  }
  const int* const mouse = surface.Interactor->GetEventPosition();
  vtkNew<vtkWorldPointPicker> picker;
  picker->Pick(mouse[0], mouse[1], 0.0, surface.Renderer);
  const double* const place = picker->GetPickPosition();
  Brush(surface, place[0], place[1], key == 'l' ? -0.02 : 0.02);
  surface.Show();
}

}

int main(int argc, char* argv[])
{
  int points = 20000, strokes = 120;
  bool hasWindow = false;
  std::string prefix;
  CLI::App app("Digs a river into terrain and keeps the surface Delaunay.\n"
               "Exit status: 0 done, 2 wrong usage, 3 the filter failed.");
  app.add_option("--points", points, "the number of points, about")
    ->check(CLI::Range(4, 100000000));
  app.add_option("--strokes", strokes, "the number of strokes of the brush")
    ->check(CLI::PositiveNumber);
  auto* window = app.add_flag("--window", hasWindow, "draw, and wait for the keys l, u and q");
  app.add_option("--frames", prefix, "how the names of the pictures begin")->excludes(window);
  const int status = ReadArguments(app, argc, argv);
  if (status >= 0)
  {
    return status;
  }
  MovingSurface surface(points, FindHeight);
  if (hasWindow)
  {
    surface.OpenWindow("Eroding terrain: l lowers, u lifts, q closes");
  }
  else if (!prefix.empty())
  {
    surface.WriteFrames(prefix);
  }
  surface.Show();
  for (int stroke = 0; stroke < strokes; ++stroke)
  {
    DigRiver(surface, stroke, strokes);
    surface.Show();
  }
  if (surface.HasFailed())
  {
    return 3;
  }
  std::printf("%d strokes on %lld points, %lld flips, %lld bad edges left\n", strokes,
    static_cast<long long>(surface.Points->GetNumberOfPoints()),
    static_cast<long long>(surface.Flips),
    static_cast<long long>(surface.Flip->GetNonDelaunayAfter()));
  if (hasWindow)
  {
    std::fflush(stdout);
    vtkNew<vtkCallbackCommand> press;
    press->SetCallback(Press);
    press->SetClientData(&surface);
    surface.Interactor->AddObserver(vtkCommand::CharEvent, press);
    surface.Interactor->Start();
  }
  return 0;
}
