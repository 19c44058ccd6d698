// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerVectors.h"

#include "Counted.h"
#include "FileMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
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

/// Finds a point for every corner: one at the same place with the same texture coordinates.
class SeamSplitter
{
public:
  SeamSplitter(vtkPolyData* mesh, const CornerVectors& texture)
    : Mesh(mesh),
      Texture(texture),
      OfPoint(mesh->GetNumberOfPoints(), None),
      Copies(mesh->GetNumberOfPoints(), None),
      Originals(mesh->GetNumberOfPoints())
  {
  }

  /// The number of new points.
  vtkIdType Split()
  {
    vtkCellArray* polys = this->Mesh->GetPolys();
    std::vector<vtkIdType> points;
    points.reserve(this->Texture.OfCorner.size());
    ForEachCorner(polys,
      [this, &points](std::size_t corner, vtkIdType, vtkIdType point)
      { points.push_back(this->FindPoint(point, this->Texture.OfCorner[corner])); });
    vtkNew<vtkIdTypeArray> connectivity;
    connectivity->SetNumberOfValues(static_cast<vtkIdType>(points.size()));
    std::copy(points.begin(), points.end(), connectivity->GetPointer(0));
    vtkNew<vtkCellArray> split;
    vtkNew<vtkIdTypeArray> offsets;
    offsets->DeepCopy(polys->GetOffsetsArray());
    split->SetData(offsets, connectivity);
    this->Mesh->SetPolys(split);
    this->CopyPoints();
    return static_cast<vtkIdType>(this->CopyOf.size());
  }

  const std::vector<std::int64_t>& GetTextureOfPoints() const { return this->OfPoint; }
  const std::vector<vtkIdType>& GetCopies() const { return this->CopyOf; }

private:
  vtkIdType FindPoint(vtkIdType point, std::int64_t texture)
  {
    while (!this->Texture.Agree(this->OfPoint[point], texture))
    {
      if (this->Copies[point] == None)
      {
        this->Copies[point] = this->AddCopy(point);
      }
      point = this->Copies[point];
    }
    this->OfPoint[point] = this->OfPoint[point] == None ? texture : this->OfPoint[point];
    return point;
  }

  vtkIdType AddCopy(vtkIdType point)
  {
    this->CopyOf.push_back(point < this->Originals ? point : this->CopyOf[point - this->Originals]);
    this->OfPoint.push_back(None);
    this->Copies.push_back(None);
    return static_cast<vtkIdType>(this->OfPoint.size()) - 1;
  }

  void CopyPoints()
  {
    vtkDataArray* points = this->Mesh->GetPoints()->GetData();
    vtkPointData* data = this->Mesh->GetPointData();
    for (const vtkIdType point : this->CopyOf)
    {
      points->InsertNextTuple(point, points);
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        data->GetAbstractArray(i)->InsertNextTuple(point, data->GetAbstractArray(i));
      }
    }
  }

  vtkPolyData* Mesh;
  const CornerVectors& Texture;
  std::vector<std::int64_t> OfPoint; ///< The number of each point's texture coordinates.
  std::vector<std::int64_t> Copies; ///< The next point at the same place.
  std::vector<vtkIdType> CopyOf; ///< The originals of the points after the first `Originals`.
  vtkIdType Originals;
};

/// The vector of each of `size` groups of corners, or nothing if corners within a group disagree.
template <typename Function>
std::vector<std::int64_t> GroupVectors(
  vtkPolyData* mesh, const CornerVectors& vectors, vtkIdType size, const Function& groupOf)
{
  std::vector<std::int64_t> ofGroup(size, None);
  bool agree = true;
  ForEachCorner(mesh->GetPolys(),
    [&](std::size_t corner, vtkIdType cell, vtkIdType point)
    {
      std::int64_t& known = ofGroup[groupOf(cell, point)];
      const std::int64_t own = vectors.OfCorner[corner];
      agree = agree && vectors.Agree(known, own);
      known = known == None ? own : known;
    });
  return agree ? ofGroup : std::vector<std::int64_t>();
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
  SeamSplitter splitter(file.Mesh, texture);
  const vtkIdType copies = splitter.Split();
  file.CopiesOf = splitter.GetCopies();
  file.Mesh->GetPointData()->SetTCoords(
    Gathered("TCoords", texture, splitter.GetTextureOfPoints()));
  if (copies > 0)
  {
    file.Notes.push_back(name + ": repeated " + Counted(copies, "point") +
      " along seams of the texture; edges there stay");
  }
}

void AttachNormals(FileMesh& file, const std::string& name, const CornerVectors& normals)
{
  const auto ofPoints = GroupVectors(file.Mesh, normals, file.Mesh->GetNumberOfPoints(),
    [](vtkIdType, vtkIdType point) { return point; });
  if (!ofPoints.empty())
  {
    file.Mesh->GetPointData()->SetNormals(Gathered("Normals", normals, ofPoints));
    return;
  }
  const auto ofCells = GroupVectors(file.Mesh, normals, file.Mesh->GetNumberOfPolys(),
    [](vtkIdType cell, vtkIdType) { return cell; });
  // Cell data are in the order verts, lines, polygons.
  if (!ofCells.empty() && file.Mesh->GetNumberOfPolys() == file.Mesh->GetNumberOfCells())
  {
    file.Mesh->GetCellData()->SetNormals(Gathered("Normals", normals, ofCells));
    return;
  }
  file.Notes.push_back(name +
    ": ignored its normals, since they differ both at the triangles of a point and at the corners "
    "of a triangle");
}

}
