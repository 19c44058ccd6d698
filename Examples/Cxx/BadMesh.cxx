// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "BadMesh.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>
#include <vector>

namespace
{

using Point = std::array<double, 2>;
using Triangle = std::array<vtkIdType, 3>;

/// A square with points along its boundary, all joined to one inside.
void MakeFan(int rim, std::vector<Point>& points, std::vector<Triangle>& triangles)
{
  const double sides[4][4] = { { 0, 0, 1, 0 }, { 1, 0, 0, 1 }, { 1, 1, -1, 0 }, { 0, 1, 0, -1 } };
  points = { { 0.44, 0.53 } };
  for (const auto& side : sides)
  {
    for (int i = 0; i < rim; ++i)
    {
      points.push_back({ side[0] + side[2] * i / rim, side[1] + side[3] * i / rim });
    }
  }
  for (vtkIdType i = 0; i < 4 * rim; ++i)
  {
    triangles.push_back({ 0, 1 + i, 1 + (i + 1) % (4 * rim) });
  }
}

}

/// The fan, with its triangles split into three again and again, which makes slivers.
vtkSmartPointer<vtkPolyData> MakeBadMesh(int rim, int splits)
{
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  MakeFan(rim, points, triangles);
  for (int i = 0; i < splits; ++i)
  {
    const Triangle t = triangles[i];
    const auto mix = [&](int k)
    { return 0.28 * points[t[0]][k] + 0.33 * points[t[1]][k] + 0.39 * points[t[2]][k]; };
    const auto p = static_cast<vtkIdType>(points.size());
    points.push_back({ mix(0), mix(1) });
    triangles.insert(triangles.end(), { { t[0], t[1], p }, { t[1], t[2], p }, { t[2], t[0], p } });
  }
  vtkNew<vtkPoints> places;
  for (const Point& point : points)
  {
    places->InsertNextPoint(point[0], point[1], 0.0);
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = splits; i < triangles.size(); ++i)
  {
    cells->InsertNextCell(3, triangles[i].data());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(places);
  mesh->SetPolys(cells);
  return mesh;
}
