// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerVectors.h"

#include "Counted.h"
#include "FileMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <limits>

namespace delaunayflip
{

namespace
{

constexpr std::int64_t None = CornerVectors::None;

/// An array of `size` vectors, chosen by their numbers; NaN where a number is None.
vtkSmartPointer<vtkDoubleArray> Gathered(
  const char* name, const CornerVectors& vectors, const std::vector<std::int64_t>& numbers)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(vectors.Components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()));
  array->Fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] != None)
    {
      array->SetTypedTuple(
        static_cast<vtkIdType>(i), &vectors.Values[vectors.Components * numbers[i]]);
    }
  }
  return array;
}

/// Calls `visit(corner, cell, point)` for every corner of the polygons.
template <typename Function>
void ForEachCorner(vtkCellArray* cells, const Function& visit)
{
  std::size_t corner = 0;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* points = nullptr;
    cells->GetCellAtId(cell, size, points);
    for (vtkIdType i = 0; i < size; ++i)
    {
      visit(corner++, cell, points[i]);
    }
  }
}

/// Vectors of groups of corners: of the corners at a point, or of those of a polygon.
struct GroupVectors
{
  template <typename Function>
  GroupVectors(
    vtkPolyData* mesh, const CornerVectors& vectors, vtkIdType size, const Function& groupOf)
    : OfGroup(size, None)
  {
    std::vector<bool> differs(size);
    ForEachCorner(mesh->GetPolys(),
      [&](std::size_t corner, vtkIdType cell, vtkIdType point)
      {
        const vtkIdType group = groupOf(cell, point);
        std::int64_t& known = this->OfGroup[group];
        const std::int64_t own = vectors.OfCorner[corner];
        differs[group] = differs[group] || !vectors.Agree(known, own);
        known = known == None ? own : known;
      });
    this->Differing = std::count(differs.begin(), differs.end(), true);
  }

  std::vector<std::int64_t> OfGroup;
  std::int64_t Differing = 0; ///< Groups whose corners have different vectors.
};

GroupVectors VectorsOfPoints(vtkPolyData* mesh, const CornerVectors& vectors)
{
  return { mesh, vectors, mesh->GetNumberOfPoints(),
    [](vtkIdType, vtkIdType point) { return point; } };
}

}

bool CornerVectors::Agree(std::int64_t first, std::int64_t second) const
{
  return first == second || first == None || second == None ||
    std::equal(this->Values.begin() + this->Components * first,
      this->Values.begin() + this->Components * (first + 1),
      this->Values.begin() + this->Components * second,
      [](double one, double other) { return one == other || (one != one && other != other); });
}

void AttachTexture(FileMesh& file, const std::string& name, const CornerVectors& texture)
{
  const GroupVectors ofPoints = VectorsOfPoints(file.Mesh, texture);
  if (ofPoints.Differing == 0)
  {
    file.Mesh->GetPointData()->SetTCoords(Gathered("TCoords", texture, ofPoints.OfGroup));
    return;
  }
  file.Warnings.push_back(name +
    ": left out its texture coordinates: " + Counted(ofPoints.Differing, "point") +
    (ofPoints.Differing == 1 ? " has" : " have") + " several of them (on a seam of the texture)");
}

void AttachNormals(FileMesh& file, const std::string& name, const CornerVectors& normals)
{
  const GroupVectors ofPoints = VectorsOfPoints(file.Mesh, normals);
  if (ofPoints.Differing == 0)
  {
    file.Mesh->GetPointData()->SetNormals(Gathered("Normals", normals, ofPoints.OfGroup));
    return;
  }
  const GroupVectors ofCells(file.Mesh, normals, file.Mesh->GetNumberOfPolys(),
    [](vtkIdType cell, vtkIdType) { return cell; });
  // Cell data are in the order verts, lines, polygons.
  if (ofCells.Differing == 0 && file.Mesh->GetNumberOfPolys() == file.Mesh->GetNumberOfCells())
  {
    file.Mesh->GetCellData()->SetNormals(Gathered("Normals", normals, ofCells.OfGroup));
    return;
  }
  file.Notes.push_back(name +
    ": ignored its normals, since they differ both at the triangles of a point and at the corners "
    "of a triangle");
}

}
