// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ObjPlan.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cctype>

namespace delaunayflip
{

namespace
{

/// The array if it has at least `size` tuples of `fewest` to `most` components; else null.
vtkDataArray* Fitting(vtkDataArray* array, vtkIdType size, int fewest, int most)
{
  const bool fits = array && array->GetNumberOfTuples() >= size &&
    array->GetNumberOfComponents() >= fewest && array->GetNumberOfComponents() <= most;
  return fits ? array : nullptr;
}

/// The array named Colors, or the scalars, or RGB, if they are colours.
vtkDataArray* FindColors(vtkPointData* data, vtkIdType size)
{
  if (vtkDataArray* const colors = Fitting(data->GetArray("Colors"), size, 3, 3))
  {
    return colors;
  }
  for (vtkDataArray* array : { data->GetScalars(), data->GetArray("RGB"), data->GetArray("RGBA") })
  {
    if (Fitting(array, size, 3, 4) && array->GetDataType() == VTK_UNSIGNED_CHAR)
    {
      return array;
    }
  }
  return nullptr;
}

/// Whether a name can be written at the end of a line and read back unchanged.
bool IsNameOfLine(const std::string& name)
{
  const auto isBad = [](unsigned char letter) { return std::iscntrl(letter) || letter == '#'; };
  return !name.empty() && std::none_of(name.begin(), name.end(), isBad) && name.front() != ' ' &&
    name.back() != ' ' && name.back() != '\\';
}

vtkStringArray* FindNames(vtkFieldData* data, const char* name)
{
  auto* const names = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    if (!IsNameOfLine(names->GetValue(i)))
    {
      return nullptr;
    }
  }
  return names;
}

ObjLabelArrays FindLabels(vtkPolyData* mesh, const ObjLabel& label)
{
  vtkDataArray* const ids =
    Fitting(mesh->GetCellData()->GetArray(label.Ids), mesh->GetNumberOfCells(), 1, 1);
  vtkStringArray* const names = FindNames(mesh->GetFieldData(), label.Names);
  if (!ids || !names)
  {
    return {};
  }
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const double id = ids->GetTuple1(cell);
    const bool isId = id >= -1.0 && id < static_cast<double>(names->GetNumberOfValues());
    if (!isId || id != static_cast<double>(static_cast<vtkIdType>(id)))
    {
      return {};
    }
  }
  return { ids, names };
}

}

ObjPlan::ObjPlan(vtkPolyData* mesh)
{
  vtkPointData* const data = mesh->GetPointData();
  const vtkIdType points = mesh->GetNumberOfPoints();
  this->Texture = Fitting(data->GetTCoords(), points, 1, 3);
  this->PointNormals = Fitting(data->GetNormals(), points, 3, 3);
  if (!this->PointNormals)
  {
    this->CellNormals = Fitting(mesh->GetCellData()->GetNormals(), mesh->GetNumberOfCells(), 3, 3);
  }
  this->Colors = FindColors(data, points);
  for (std::size_t label = 0; label < ObjLabels.size(); ++label)
  {
    this->Labels[label] = FindLabels(mesh, ObjLabels[label]);
  }
  this->Libraries = FindNames(mesh->GetFieldData(), "MaterialLibraries");
}

bool ObjPlan::Holds(vtkAbstractArray* array) const
{
  const bool isLabel = std::any_of(this->Labels.begin(), this->Labels.end(),
    [array](const ObjLabelArrays& label) { return array == label.Ids || array == label.Names; });
  const bool isColors = array == this->Colors && array->GetNumberOfComponents() == 3;
  return isLabel || isColors || array == this->Texture || array == this->PointNormals ||
    array == this->CellNormals || array == this->Libraries;
}

}
