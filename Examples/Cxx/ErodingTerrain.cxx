// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: ErodingTerrain [--points N] [--strokes N] [--window]
///
/// A brush digs a river into terrain, and the surface is kept Delaunay: every stroke lowers points
/// and continues from the triangles of the stroke before. Prints the number of flips. With --window
/// it draws the strokes; then the key l lowers the terrain under the mouse, u lifts it, and q
/// closes the window.
#include <vtkCallbackCommand.h>
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
#include <vtkWorldPointPicker.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

namespace
{

struct Settings
{
  int Points = 20000;
  int Strokes = 120;
  bool HasWindow = false;
};

/// Hills on a unit square, of about so many points.
vtkSmartPointer<vtkPolyData> MakeTerrain(int points)
{
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(points))));
  std::mt19937 random(11);
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
    const double z =
      0.06 * std::sin(7.0 * x + 1.0) * std::cos(5.0 * y) + 0.01 * std::sin(40.0 * x * y);
    mesh->GetPoints()->InsertNextPoint(x, y, z);
    if (id % side + 1 < side && id / side + 1 < side)
    {
      mesh->GetPolys()->InsertNextCell({ id, id + 1, id + side + 1 });
      mesh->GetPolys()->InsertNextCell({ id, id + side + 1, id + side });
    }
  }
  return mesh;
}

/// Moves the points around (x, y) by up to `height`, in a bell-shaped brush.
void Brush(vtkPoints* points, double x, double y, double height)
{
  constexpr double Width = 0.04;
  auto* xyz = static_cast<double*>(points->GetVoidPointer(0));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    const double dx = xyz[3 * i] - x, dy = xyz[3 * i + 1] - y;
    const double distance = (dx * dx + dy * dy) / (Width * Width);
    xyz[3 * i + 2] += distance < 9.0 ? height * std::exp(-distance) : 0.0;
  }
  points->Modified();
}

/// One stroke along a river that winds through the terrain.
void DigRiver(vtkPoints* points, int stroke, int strokes)
{
  const double y = static_cast<double>(stroke) / strokes;
  Brush(points, 0.5 + 0.25 * std::sin(7.0 * y), y, -0.5 / strokes); // many strokes overlap
}

/// Lowers or lifts the terrain under the mouse when a key is pressed.
struct MouseBrush
{
  vtkRenderer* Renderer;
  vtkPoints* Points;
  vtkDelaunayFlipLiveView* View;

  static void Press(vtkObject* caller, unsigned long, void* self, void*)
  {
    auto* interactor = static_cast<vtkRenderWindowInteractor*>(caller);
    const char key = interactor->GetKeyCode();
    if (key == 'l' || key == 'u')
    {
      static_cast<MouseBrush*>(self)->Move(interactor, key == 'l' ? -0.02 : 0.02);
    }
  }

  void Move(vtkRenderWindowInteractor* interactor, double height) const
  {
    const int* mouse = interactor->GetEventPosition();
    vtkNew<vtkWorldPointPicker> picker;
    picker->Pick(mouse[0], mouse[1], 0.0, this->Renderer);
    const double* place = picker->GetPickPosition();
    Brush(this->Points, place[0], place[1], height);
    this->View->Step();
  }
};

void OpenWindow(vtkRenderWindow* window, vtkRenderer* renderer)
{
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->GetActiveCamera()->SetPosition(0.5, -1.0, 1.2);
  renderer->GetActiveCamera()->SetFocalPoint(0.5, 0.45, 0.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  window->AddRenderer(renderer);
  window->SetSize(900, 700);
  window->SetWindowName("Eroding terrain: l lowers, u lifts, q ends");
}

/// @returns the exit status for the command line, or -1 to go on.
int ReadArguments(int argc, char* argv[], Settings& settings)
{
  CLI::App app("Digs a river into terrain and keeps the surface Delaunay.\n"
               "Exit status: 0 done, 2 wrong usage, 3 the filter failed.");
  app.add_option("--points", settings.Points, "the number of points, about")
    ->check(CLI::Range(4, 100000000));
  app.add_option("--strokes", settings.Strokes, "the number of strokes of the brush")
    ->check(CLI::PositiveNumber);
  app.add_flag("--window", settings.HasWindow, "draw, and wait for the keys l, u and q");
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
  const vtkSmartPointer<vtkPolyData> mesh = MakeTerrain(settings.Points);
  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(mesh);
  flip->SetGeometryToSurface();
  flip->SetFeatureAngle(180.0); // banks of the river may flip, too
  flip->LiveUpdateOn(); // which lets a run continue from the triangles of the last one
  flip->SetIterationsPerUpdate(1000000); // each stroke to its end
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkDelaunayFlipLiveView> view;
  std::function<void()> show = [&]() { flip->Update(); };
  if (settings.HasWindow)
  {
    OpenWindow(window, renderer);
    interactor->SetRenderWindow(window);
    view->SetFilter(flip);
    view->SetInteractor(interactor);
    view->ShowKeysOff();
    show = [&]() { view->Step(); };
  }
  show();
  vtkIdType flips = 0;
  for (int stroke = 0; stroke < settings.Strokes; ++stroke)
  {
    DigRiver(mesh->GetPoints(), stroke, settings.Strokes);
    show();
    flips += flip->GetTotalFlips();
  }
  if (flip->GetFailure() != vtkDelaunayFlip::FAILURE_NONE)
  {
    std::fprintf(stderr, "error: %s\n", flip->GetErrorMessage());
    return 3;
  }
  std::printf("%d strokes on %lld points, %lld flips, %lld bad edges left\n", settings.Strokes,
    static_cast<long long>(mesh->GetNumberOfPoints()), static_cast<long long>(flips),
    static_cast<long long>(flip->GetNonDelaunayAfter()));
  if (settings.HasWindow)
  {
    std::fflush(stdout);
    MouseBrush brush{ renderer, mesh->GetPoints(), view };
    vtkNew<vtkCallbackCommand> press;
    press->SetCallback(MouseBrush::Press);
    press->SetClientData(&brush);
    interactor->AddObserver(vtkCommand::CharEvent, press);
    interactor->Start();
  }
  return 0;
}
