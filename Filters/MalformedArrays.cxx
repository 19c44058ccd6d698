// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MalformedArrays.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <string>

namespace delaunayflip
{
namespace
{

/// The names of the arrays of `data` with fewer than `tuples` tuples.
std::vector<std::string> FindShortArrays(vtkDataSetAttributes* data, vtkIdType tuples)
{
  std::vector<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() < tuples)
    {
      names.push_back(array->GetName() ? array->GetName() : "");
    }
  }
  return names;
}

/// A shallow copy without the arrays that have fewer than `tuples` tuples.
template <typename Data>
vtkSmartPointer<Data> TakeArrays(Data* data, vtkIdType tuples)
{
  auto whole = vtkSmartPointer<Data>::New();
  whole->ShallowCopy(data);
  for (int i = whole->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (whole->GetAbstractArray(i)->GetNumberOfTuples() < tuples)
    {
      whole->RemoveArray(i);
    }
  }
  return whole;
}

/// The names in quotes, as many as fit into a warning.
std::string List(const std::vector<std::string>& names)
{
  constexpr std::size_t Most = 3;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < Most; ++i)
  {
    text += (i == 0 ? "\"" : ", \"") + names[i] + "\"";
  }
  return names.size() > Most ? text + ", and " + std::to_string(names.size() - Most) + " more"
                             : text;
}

void AddShortArrays(const std::string& kind, const char* fate,
  const std::vector<std::string>& names, std::vector<Defect>& defects)
{
  if (!names.empty())
  {
    const std::string what = kind + (names.size() == 1 ? " array" : " arrays");
    defects.push_back({ what + " with too few tuples " + fate + ": " + List(names),
      static_cast<std::int64_t>(names.size()), {} });
  }
}

}

vtkSmartPointer<vtkCellData> TakeWholeArrays(vtkPolyData* mesh)
{
  return TakeArrays(mesh->GetCellData(), mesh->GetNumberOfCells());
}

vtkSmartPointer<vtkPointData> TakeWholePointArrays(vtkPolyData* mesh)
{
  return TakeArrays(mesh->GetPointData(), mesh->GetNumberOfPoints());
}

void AddMalformedArrays(vtkPolyData* mesh, bool cellsStay, std::vector<Defect>& defects)
{
  constexpr const char* Passed = "passed unchanged";
  vtkCellData* cells = mesh->GetCellData();
  AddShortArrays(
    "point", Passed, FindShortArrays(mesh->GetPointData(), mesh->GetNumberOfPoints()), defects);
  AddShortArrays("cell", cellsStay ? Passed : "left out",
    FindShortArrays(cells, mesh->GetNumberOfCells()), defects);
  vtkAbstractArray* ghosts = cells->GetAbstractArray(vtkDataSetAttributes::GhostArrayName());
  if (ghosts && !vtkArrayDownCast<vtkUnsignedCharArray>(ghosts))
  {
    defects.push_back({ "ghost array that is not of type unsigned char ignored", 1, {} });
  }
}

void AddShortArrays(vtkPolyData* mesh, const std::string& where, std::vector<Note>& notes)
{
  constexpr const char* Dropped = "left out";
  std::vector<Defect> defects;
  AddShortArrays(
    "point", Dropped, FindShortArrays(mesh->GetPointData(), mesh->GetNumberOfPoints()), defects);
  AddShortArrays(
    "cell", Dropped, FindShortArrays(mesh->GetCellData(), mesh->GetNumberOfCells()), defects);
  if (!defects.empty())
  {
    notes.push_back({ where, DescribeDefects(defects) });
  }
}

}
