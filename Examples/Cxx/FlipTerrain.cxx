// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Usage: FlipTerrain [FOLDER]
///
/// Makes badly triangulated terrain, flips it, and writes to FOLDER (default: the current one)
/// FlipTerrain.vtp, the Delaunay mesh, and FlipTerrain.png, a picture of the mesh before (left) and
/// after (right), with triangles coloured by their smallest angles.

#include "BadMesh.h"

#include <vtkActor.h>
#include <vtkCamera.h>
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

#include <cmath>
#include <iostream>
#include <string>

namespace
{

/// Slivers on hills.
vtkSmartPointer<vtkPolyData> MakeTerrain()
{
  const vtkSmartPointer<vtkPolyData> mesh = MakeBadMesh(6, 900);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    p[2] =
      0.1 * std::sin(5.0 * p[0]) * std::cos(4.0 * p[1]) + 0.03 * std::sin(11.0 * p[0] + 7.0 * p[1]);
    mesh->GetPoints()->SetPoint(i, p);
  }
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
  flip->SetInputData(MakeTerrain());
  flip->SetGeometryToPlanarXY(); // terrain: only x and y decide
  flip->Update();
  std::cout << flip->GetTotalFlips() << " flips in " << flip->GetNumberOfIterations()
            << " iterations, " << flip->GetNonDelaunayAfter() << " bad edges left\n";

  const bool isWritten = WriteMesh(flip, folder + "/FlipTerrain.vtp");
  if (!isWritten || !WritePicture(flip, folder + "/FlipTerrain.png"))
  {
    std::cerr << "error: " << folder << ": cannot be written to\n";
    return 3;
  }
  return flip->GetConverged() ? 0 : 1;
}
