// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: FlipTerrain [FOLDER]
///
/// Makes badly triangulated terrain, flips it, and writes to FOLDER (default: the current one)
/// FlipTerrain.vtp, the Delaunay mesh, and FlipTerrain.png, a picture of the mesh before (left) and
/// after (right), with triangles coloured by their smallest angles.

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkDelaunayFlip.h>
#include <vtkLookupTable.h>
#include <vtkMeshQuality.h>
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

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace
{

double GetHeight(double x, double y)
{
  return 0.1 * std::sin(5.0 * x) * std::cos(4.0 * y) + 0.03 * std::sin(11.0 * x + 7.0 * y);
}

using Triangle = std::array<vtkIdType, 3>;

/// Whether point `p` lies to the left of a -> b, seen from above.
bool IsLeft(vtkPoints* points, vtkIdType a, vtkIdType b, vtkIdType p)
{
  double u[3], v[3], w[3];
  points->GetPoint(a, u);
  points->GetPoint(b, v);
  points->GetPoint(p, w);
  return (v[0] - u[0]) * (w[1] - u[1]) > (v[1] - u[1]) * (w[0] - u[0]);
}

/// A fan from the middle of a square to the points along its boundary.
std::vector<Triangle> MakeFan(vtkPoints* points, int pointsPerSide)
{
  const auto addPoint = [points](double x, double y)
  { points->InsertNextPoint(x, y, GetHeight(x, y)); };
  addPoint(0.5, 0.5);
  const double corners[5][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };
  for (int i = 0; i < 4 * pointsPerSide; ++i)
  {
    const double* from = corners[i / pointsPerSide];
    const double* to = corners[i / pointsPerSide + 1];
    const double t = static_cast<double>(i % pointsPerSide) / pointsPerSide;
    addPoint(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1]));
  }
  std::vector<Triangle> triangles;
  for (vtkIdType i = 0; i < 4 * pointsPerSide; ++i)
  {
    triangles.push_back({ 0, 1 + i, 1 + (i + 1) % (4 * pointsPerSide) });
  }
  return triangles;
}

/// Random points, each joined to the corners of the triangle that contains it, which makes long
/// thin triangles.
vtkSmartPointer<vtkPolyData> MakeTerrain(int numberOfPoints)
{
  vtkNew<vtkPoints> points;
  std::vector<Triangle> triangles = MakeFan(points, 20);
  std::mt19937 random(1);
  const auto number = [&random]() { return random() / 4294967296.0; };
  while (points->GetNumberOfPoints() < numberOfPoints)
  {
    const double x = number();
    const double y = number();
    const vtkIdType p = points->InsertNextPoint(x, y, GetHeight(x, y));
    const auto holdsPoint = [&points, p](const Triangle& t)
    {
      return IsLeft(points, t[0], t[1], p) && IsLeft(points, t[1], t[2], p) &&
        IsLeft(points, t[2], t[0], p);
    };
    const auto found = std::find_if(triangles.begin(), triangles.end(), holdsPoint);
    if (found != triangles.end())
    {
      const Triangle t = *found;
      *found = { t[0], t[1], p };
      triangles.push_back({ t[1], t[2], p });
      triangles.push_back({ t[2], t[0], p });
    }
  }
  vtkNew<vtkCellArray> cells;
  for (const Triangle& triangle : triangles)
  {
    cells->InsertNextCell(3, triangle.data());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

/// One half of the picture. Red is a smallest angle of 0, blue of 60 degrees.
vtkSmartPointer<vtkRenderer> MakeView(vtkAlgorithmOutput* mesh, double left)
{
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputConnection(mesh);
  quality->SetTriangleQualityMeasureToMinAngle();
  vtkNew<vtkLookupTable> colors;
  colors->SetHueRange(0.0, 0.6);
  colors->SetSaturationRange(0.6, 0.6);
  colors->SetValueRange(1.0, 1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(quality->GetOutputPort());
  mapper->SetLookupTable(colors);
  mapper->SetScalarRange(0.0, 60.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.3);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.15, 0.15, 0.15);
  auto view = vtkSmartPointer<vtkRenderer>::New();
  view->SetViewport(left, 0.0, left + 0.5, 1.0);
  view->SetBackground(1.0, 1.0, 1.0);
  view->AddActor(actor);
  view->GetActiveCamera()->SetPosition(0.0, -1.0, 1.3);
  view->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  view->ResetCamera();
  view->GetActiveCamera()->Zoom(1.35);
  return view;
}

bool WriteMesh(vtkDelaunayFlip* flip, const std::string& file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // ParaView 5.11 with a newer expat fails on appended data
  writer->SetInputConnection(flip->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

bool WritePicture(vtkDelaunayFlip* flip, const std::string& file)
{
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetSize(1400, 600);
  window->AddRenderer(MakeView(flip->GetInputConnection(0, 0), 0.0));
  window->AddRenderer(MakeView(flip->GetOutputPort(), 0.5));
  window->Render();
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->SetFileName(file.c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

}

int main(int argc, char* argv[])
{
  std::string folder = ".";
  CLI::App app(
    "Flips badly triangulated terrain; writes FOLDER/FlipTerrain.vtp and FOLDER/FlipTerrain.png.",
    "FlipTerrain");
  app.footer("Exit status: 0 done; 2 wrong usage; 3 a file cannot be written.");
  app.add_option("FOLDER", folder, "Where to write (default: the current folder)");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return app.exit(error) == 0 ? 0 : 2;
  }

  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(MakeTerrain(900));
  flip->SetGeometryToPlanarXY(); // terrain: only x and y decide
  flip->Update();
  std::cout << flip->GetTotalFlips() << " flips in " << flip->GetNumberOfIterations()
            << " iterations, " << flip->GetNumberOfNonDelaunayEdges() << " bad edges left\n";

  const bool isWritten = WriteMesh(flip, folder + "/FlipTerrain.vtp");
  if (!isWritten || !WritePicture(flip, folder + "/FlipTerrain.png"))
  {
    std::cerr << "error: " << folder << ": cannot be written to\n";
    return 3;
  }
  return flip->GetConverged() ? 0 : 1;
}
