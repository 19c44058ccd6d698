// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
/// Draws a random bad mesh before (left) and after (right), coloured by the smallest angle of each
/// triangle, and compares the picture with the baseline.

#include "GeneratedMeshes.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDelaunayFlip.h"
#include "vtkLookupTable.h"
#include "vtkMeshQuality.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"

#include <cstdlib>

namespace
{

vtkSmartPointer<vtkPolyData> MakeBadMesh()
{
  const auto owned = delaunayflip::MakeRandomBadMesh(80, 7);
  vtkNew<vtkPoints> points;
  for (std::size_t i = 0; i < owned.Points.size(); i += 3)
  {
    points->InsertNextPoint(&owned.Points[i]);
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t i = 0; i < owned.Triangles.size(); i += 3)
  {
    triangles->InsertNextCell(
      { owned.Triangles[i], owned.Triangles[i + 1], owned.Triangles[i + 2] });
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

/// Red where the smallest angle is 0, blue where it is 60 degrees.
vtkSmartPointer<vtkLookupTable> MakeColors()
{
  auto colors = vtkSmartPointer<vtkLookupTable>::New();
  colors->SetHueRange(0.0, 0.6);
  colors->SetSaturationRange(0.5, 0.5);
  colors->SetValueRange(1.0, 1.0);
  return colors;
}

vtkSmartPointer<vtkRenderer> MakeView(vtkAlgorithmOutput* mesh, double left)
{
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputConnection(mesh);
  quality->SetTriangleQualityMeasureToMinAngle();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(quality->GetOutputPort());
  mapper->SetLookupTable(MakeColors());
  mapper->SetScalarRange(0.0, 60.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.1, 0.1, 0.1);
  auto view = vtkSmartPointer<vtkRenderer>::New();
  view->SetViewport(left, 0.0, left + 0.5, 1.0);
  view->SetBackground(1.0, 1.0, 1.0);
  view->AddActor(actor);
  view->GetActiveCamera()->ParallelProjectionOn();
  view->ResetCamera();
  view->GetActiveCamera()->Zoom(1.4);
  return view;
}

}

int main(int argc, char* argv[])
{
  vtkNew<vtkDelaunayFlip> flip;
  flip->SetInputData(MakeBadMesh());
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0);
  window->SetSize(360, 180);
  window->AddRenderer(MakeView(flip->GetInputConnection(0, 0), 0.0));
  window->AddRenderer(MakeView(flip->GetOutputPort(), 0.5));
  window->Render();
  return vtkRegressionTestImage(window) == vtkTesting::PASSED ? EXIT_SUCCESS : EXIT_FAILURE;
}
