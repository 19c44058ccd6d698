// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "UpdateProgress.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPolyData.h"

#include <utility>

namespace delaunayflip
{
namespace
{

// Time per item in units of what the engine takes per triangle, measured on one thread.
constexpr double FixedEdgesOfTriangle = 0.4;
constexpr double PointOfPolygon = 0.1;
constexpr double PointOfConstraintById = 0.15;
constexpr double PointOfConstraintByPlace = 0.5;
constexpr double RegionOfCell = 0.3;
constexpr double CellOfOutput = 0.03;
constexpr double ValueOfOutput = 0.02;
constexpr double NormalOfOutput = 0.15;
constexpr double AnglesOfOutput = 0.4;

double CountPoints(vtkPolyData* mesh)
{
  return static_cast<double>(mesh->GetPolys()->GetNumberOfConnectivityIds() +
    mesh->GetStrips()->GetNumberOfConnectivityIds());
}

bool HoldsTrianglesOnly(vtkPolyData* mesh)
{
  return mesh->GetNumberOfStrips() == 0 &&
    mesh->GetPolys()->GetNumberOfConnectivityIds() == 3 * mesh->GetNumberOfPolys();
}

/// A polygon of n points is n - 2 triangles.
double CountTriangles(vtkPolyData* mesh)
{
  return CountPoints(mesh) -
    2.0 * static_cast<double>(mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips());
}

double EstimateConstraints(const UpdateWork& work)
{
  double sum = 0.0;
  if (work.LinesAreConstraints)
  {
    sum += PointOfConstraintById *
      static_cast<double>(work.Mesh->GetLines()->GetNumberOfConnectivityIds());
  }
  if (work.Constraints)
  {
    const bool byPlace = work.Constraints->GetNumberOfPoints() > 0 &&
      work.Constraints->GetPoints() != work.Mesh->GetPoints();
    const double points = CountPoints(work.Constraints) +
      static_cast<double>(work.Constraints->GetLines()->GetNumberOfConnectivityIds());
    sum += points * (byPlace ? PointOfConstraintByPlace : PointOfConstraintById);
  }
  return sum;
}

double EstimateOutput(const UpdateWork& work, double triangles)
{
  vtkCellData* data = work.Mesh->GetCellData();
  double perCell = CellOfOutput + (work.WantsAngles ? AnglesOfOutput : 0.0) +
    (data->GetNormals() ? NormalOfOutput : 0.0);
  if (!HoldsTrianglesOnly(work.Mesh))
  {
    perCell += ValueOfOutput * data->GetNumberOfComponents();
  }
  return perCell * triangles;
}

}

UpdatePlan::UpdatePlan(const UpdateWork& work, ProgressObserver observer)
  : Observer(std::move(observer))
{
  const double triangles = CountTriangles(work.Mesh);
  const double cells = static_cast<double>(work.Mesh->GetNumberOfCells());
  this->Ends[FixedEdges] = work.IsWarm ? FixedEdgesOfTriangle * triangles : 0.0;
  this->Ends[Polygons] =
    HoldsTrianglesOnly(work.Mesh) ? 0.0 : PointOfPolygon * CountPoints(work.Mesh);
  this->Ends[Constraints] = EstimateConstraints(work);
  this->Ends[Regions] = work.HasRegions ? RegionOfCell * cells : 0.0;
  this->Ends[Session] = triangles;
  this->Ends[Output] = EstimateOutput(work, triangles);
  double sum = 0.0;
  for (double& end : this->Ends)
  {
    sum += end;
    end = sum;
  }
  for (double& end : this->Ends)
  {
    end = sum > 0.0 ? end / sum : 1.0;
  }
}

ProgressObserver UpdatePlan::MakePartUpTo(Part part) const
{
  return MakePart(this->Observer, part == 0 ? 0.0 : this->Ends[part - 1], this->Ends[part]);
}

}
