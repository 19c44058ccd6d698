// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LiveTestSupport.h"

#include "vtkPoints.h"

vtkSmartPointer<vtkPolyData> MakeBadPlane()
{
  return ToPolyData(delaunayflip::MakeRandomBadMeshDouble(400, 3));
}

vtkSmartPointer<vtkPolyData> MakeBadSphere()
{
  return ToPolyData(delaunayflip::MakeBadSphere(40, 20, 4));
}

Cells FlipAtOnce(vtkPolyData* mesh, double featureAngle)
{
  WatchedFilter filter(mesh);
  filter->SetFeatureAngle(featureAngle);
  return GetCells(RunCleanly(filter)->GetPolys());
}

LiveFilter::LiveFilter(vtkPolyData* input)
  : WatchedFilter(input)
{
  (*this)->LiveUpdateOn();
}

int LiveFilter::RunToTheEnd()
{
  constexpr int Most = 1000; // updates, after which the test fails
  int updates = 0;
  do
  {
    this->Run();
    ++updates;
  } while ((*this)->Advance() && updates < Most);
  return updates;
}

Cells LiveFilter::GetTriangles() { return GetCells((*this)->GetOutput()->GetPolys()); }

void Shear(vtkPolyData* mesh, double factor)
{
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
  {
    double x[3];
    mesh->GetPoint(point, x);
    mesh->GetPoints()->SetPoint(point, x[0] + factor * x[1], x[1], x[2]);
  }
  mesh->GetPoints()->Modified();
}
