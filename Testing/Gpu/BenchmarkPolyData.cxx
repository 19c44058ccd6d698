// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkPolyData.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>

namespace delaunayflip
{
namespace
{

template <typename Real>
vtkSmartPointer<vtkDataArray> CopyCoordinates(const std::vector<Real>& coordinates)
{
  auto array = vtkSmartPointer<vtkAOSDataArrayTemplate<Real>>::New();
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size() / 3));
  std::copy(coordinates.begin(), coordinates.end(), array->GetPointer(0));
  return array;
}

vtkSmartPointer<vtkCellArray> CopyTriangles(const std::vector<std::int64_t>& ids)
{
  const auto count = static_cast<vtkIdType>(ids.size() / 3);
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkNew<vtkTypeInt64Array> connectivity;
  connectivity->SetNumberOfValues(3 * count);
  std::copy(ids.begin(), ids.end(), connectivity->GetPointer(0));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

}

vtkSmartPointer<vtkPolyData> ToPolyData(const BenchmarkMesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetData(
    mesh.Floats.empty() ? CopyCoordinates(mesh.Doubles) : CopyCoordinates(mesh.Floats));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(CopyTriangles(mesh.Ids));
  vtkNew<vtkCellArray> constraints;
  for (std::size_t i = 0; i < mesh.ConstraintEdges.size(); i += 2)
  {
    constraints->InsertNextCell({ mesh.ConstraintEdges[i], mesh.ConstraintEdges[i + 1] });
  }
  data->SetLines(constraints);
  return data;
}

}
