// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: TerrainFromPoints [FOLDER]
///
/// Makes the mesh of a terrain from scattered points and two breaklines, the edges of a slope,
/// within an outline. Writes to FOLDER (default: the current one) TerrainFromPoints.vtp, the
/// mesh, and TerrainFromPoints.png, a picture of the mesh without (left) and with the breaklines
/// (right).

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDelaunayFlipPoints.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

namespace
{

/// The middle of the slope.
double GetMiddle(double x) { return 0.5 + 0.15 * std::sin(6.0 * x); }

constexpr double HalfWidth = 0.02; ///< Half the width of the slope.

/// Hills that a steep slope divides.
double GetHeight(double x, double y)
{
  const double slope = std::clamp((y - GetMiddle(x)) / HalfWidth, -1.0, 1.0);
  return 0.08 * slope + 0.02 * std::sin(9.0 * x) * std::cos(7.0 * y);
}

vtkSmartPointer<vtkPolyData> MakePoints()
{
  vtkNew<vtkPoints> points;
  std::mt19937 random(3);
  const auto number = [&random]() { return random() / 4294967296.0; };
  for (int i = 0; i < 600; ++i)
  {
    const double x = number();
    const double y = number();
    points->InsertNextPoint(x, y, GetHeight(x, y));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  return cloud;
}

/// The upper and the lower edge of the slope as lines, and the outline of the mesh as a polygon.
vtkSmartPointer<vtkPolyData> MakeSegments()
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines, outline;
  const auto add = [&](double x, double y)
  { return points->InsertNextPoint(x, y, GetHeight(x, y)); };
  for (const double side : { -1.0, 1.0 })
  {
    lines->InsertNextCell(51);
    for (int i = 0; i <= 50; ++i)
    {
      const double x = 0.02 * i;
      lines->InsertCellPoint(add(x, GetMiddle(x) + side * HalfWidth));
    }
  }
  outline->InsertNextCell(60);
  for (int i = 0; i < 60; ++i)
  {
    const double angle = 2.0 * 3.14159265358979 * i / 60;
    outline->InsertCellPoint(add(0.5 + 0.46 * std::cos(angle), 0.5 + 0.46 * std::sin(angle)));
  }
  auto segments = vtkSmartPointer<vtkPolyData>::New();
  segments->SetPoints(points);
  segments->SetLines(lines);
  segments->SetPolys(outline);
  return segments;
}

/// One half of the picture.
vtkSmartPointer<vtkRenderer> MakeView(vtkAlgorithmOutput* mesh, double left)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetColor(0.75, 0.85, 0.65);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.3, 0.3, 0.3);
  auto view = vtkSmartPointer<vtkRenderer>::New();
  view->SetViewport(left, 0.0, left + 0.5, 1.0);
  view->SetBackground(1.0, 1.0, 1.0);
  view->AddActor(actor);
  view->GetActiveCamera()->SetPosition(0.0, -1.0, 1.3);
  view->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  view->ResetCamera();
  view->GetActiveCamera()->Zoom(1.4);
  return view;
}

}

int main(int argc, char* argv[])
{
  const std::string folder = argc > 1 ? argv[1] : ".";
  if (argc > 2 || folder[0] == '-')
  {
    std::cerr << "usage: " << argv[0] << " [FOLDER]\nWrites TerrainFromPoints.vtp, a mesh, and "
              << "TerrainFromPoints.png, a picture, to FOLDER.\n";
    return folder == "--help" ? 0 : 2;
  }
  const auto points = MakePoints();
  vtkNew<vtkDelaunayFlipPoints> plain, terrain;
  plain->SetInputData(points);
  terrain->SetInputData(points);
  terrain->SetSegmentsData(MakeSegments());
  terrain->SplitCrossingsOn(); // the breaklines leave the outline
  terrain->Update();
  std::cout << terrain->GetOutput()->GetNumberOfPolys() << " triangles, "
            << terrain->GetNumberOfSegmentEdges() << " edges along segments\n";

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // ParaView 5.11 with a newer expat fails on appended data
  writer->SetInputConnection(terrain->GetOutputPort());
  writer->SetFileName((folder + "/TerrainFromPoints.vtp").c_str());
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetSize(1400, 600);
  window->AddRenderer(MakeView(plain->GetOutputPort(), 0.0));
  window->AddRenderer(MakeView(terrain->GetOutputPort(), 0.5));
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> picture;
  picture->SetInputConnection(image->GetOutputPort());
  picture->SetFileName((folder + "/TerrainFromPoints.png").c_str());
  picture->Write();
  if (!writer->Write() || picture->GetErrorCode() != 0)
  {
    std::cerr << "error: " << folder << ": cannot be written to\n";
    return 3;
  }
  return terrain->GetConverged() ? 0 : 1;
}
