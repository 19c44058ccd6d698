// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "MalformedArrays.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
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

void AddWrongGhosts(vtkCellData* cells, std::vector<Defect>& defects)
{
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkAbstractArray* ghosts = cells->GetAbstractArray(name);
  if (ghosts && IsWrongGhostArray(ghosts))
  {
    const std::string fault = ghosts->GetDataType() != VTK_UNSIGNED_CHAR
      ? "ghost array that is not of type unsigned char ignored"
      : "ghost array with several components ignored";
    defects.push_back({ fault + ": " + List({ name }), 1, {} });
  }
}

/// @param shortPoints what becomes of point arrays with too few tuples. @param shortCells the same
/// of cell arrays.
std::vector<Defect> ListMalformedArrays(
  vtkPolyData* mesh, const char* shortPoints, const char* shortCells)
{
  std::vector<Defect> defects;
  vtkCellData* cells = mesh->GetCellData();
  AddShortArrays("point", shortPoints,
    FindShortArrays(mesh->GetPointData(), mesh->GetNumberOfPoints()), defects);
  AddShortArrays("cell", shortCells, FindShortArrays(cells, mesh->GetNumberOfCells()), defects);
  AddWrongGhosts(cells, defects);
  return defects;
}

constexpr const char* Passed = "passed unchanged";
constexpr const char* LeftOut = "left out";

}

vtkSmartPointer<vtkCellData> TakeWholeArrays(vtkPolyData* mesh)
{
  return TakeArrays(mesh->GetCellData(), mesh->GetNumberOfCells());
}

vtkSmartPointer<vtkPointData> TakeWholePointArrays(vtkPolyData* mesh)
{
  return TakeArrays(mesh->GetPointData(), mesh->GetNumberOfPoints());
}

bool IsWrongGhostArray(vtkAbstractArray* array)
{
  const char* name = array->GetName();
  return name && std::string(name) == vtkDataSetAttributes::GhostArrayName() &&
    (array->GetDataType() != VTK_UNSIGNED_CHAR || array->GetNumberOfComponents() != 1);
}

vtkSmartPointer<vtkUnsignedCharArray> FindGhosts(vtkPolyData* mesh)
{
  vtkDataArray* array = mesh->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName());
  if (!array || IsWrongGhostArray(array))
  {
    return nullptr;
  }
  if (auto* ghosts = vtkArrayDownCast<vtkUnsignedCharArray>(array))
  {
    return ghosts;
  }
  auto ghosts = vtkSmartPointer<vtkUnsignedCharArray>::New(); // another layout of memory
  ghosts->DeepCopy(array);
  return ghosts;
}

void AddMalformedArrays(vtkPolyData* mesh, bool cellsStay, std::vector<Defect>& defects)
{
  const std::vector<Defect> more = ListMalformedArrays(mesh, Passed, cellsStay ? Passed : LeftOut);
  defects.insert(defects.end(), more.begin(), more.end());
}

void AddMalformedArrays(vtkPolyData* mesh, const std::string& where, std::vector<Note>& notes)
{
  const std::vector<Defect> defects = ListMalformedArrays(mesh, LeftOut, LeftOut);
  if (!defects.empty())
  {
    notes.push_back({ where, DescribeDefects(defects) });
  }
}

}
