// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MovingSurface.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPolyData.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

MovingSurface::MovingSurface(int points, const std::function<double(double, double)>& height)
{
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(points))));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.35, 0.35);
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(this->Points);
  mesh->SetPolys(vtkNew<vtkCellArray>());
  this->Points->SetDataTypeToDouble();
  for (vtkIdType id = 0; id < side * side; ++id)
  {
    const auto column = static_cast<double>(id % side), row = static_cast<double>(id / side);
    const double x = (column + jitter(random)) / (side - 1);
    const double y = (row + jitter(random)) / (side - 1);
    this->Points->InsertNextPoint(x, y, height(x, y));
    if (id % side + 1 < side && id / side + 1 < side)
    {
      mesh->GetPolys()->InsertNextCell({ id, id + 1, id + side + 1 });
      mesh->GetPolys()->InsertNextCell({ id, id + side + 1, id + side });
    }
  }
  this->Flip->SetInputData(mesh);
  this->Flip->SetGeometryToSurface();
  this->Flip->SetFeatureAngle(180.0); // no edge stays because it is sharp
  this->Flip->LiveUpdateOn(); // which lets a run continue from the triangles of the last one
  this->Flip->SetIterationsPerUpdate(1000000); // each move to its end
}

void MovingSurface::OpenWindow(const char* title)
{
  this->Renderer->SetBackground(1.0, 1.0, 1.0);
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(0.5, -1.5, 1.3);
  camera->SetFocalPoint(0.5, 0.5, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  this->Window->AddRenderer(this->Renderer);
  this->Window->SetSize(900, 700);
  this->Window->SetWindowName(title);
  this->Interactor->SetRenderWindow(this->Window);
  this->View->SetFilter(this->Flip);
  this->View->SetInteractor(this->Interactor);
  this->View->ShowKeysOff();
  this->HasWindow = true;
}

void MovingSurface::WriteFrames(const std::string& prefix)
{
  this->Window->OffScreenRenderingOn();
  this->Window->SetMultiSamples(0);
  this->OpenWindow("");
  this->Window->SetSize(480, 330);
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(0.5, 0.45, -0.1); // which leaves a place for the colour scale
  camera->Zoom(1.25);
  this->View->ShowStatisticsOff();
  this->View->SetFramePrefix(prefix.c_str());
}

void MovingSurface::Show()
{
  if (this->HasWindow)
  {
    this->View->Step();
  }
  else
  {
    this->Flip->Update();
  }
  if (this->IsShown)
  {
    this->Flips += this->Flip->GetTotalFlips();
  }
  this->IsShown = true;
}

double* MovingSurface::GetCoordinates() const
{
  return static_cast<double*>(this->Points->GetVoidPointer(0));
}

bool MovingSurface::HasFailed() const
{
  if (this->Flip->GetFailure() == vtkDelaunayFlip::FAILURE_NONE)
  {
    return false;
  }
  std::fprintf(stderr, "error: %s\n", this->Flip->GetErrorMessage());
  return true;
}

int ReadArguments(CLI::App& app, int argc, char* argv[])
{
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
