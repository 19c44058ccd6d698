// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatLosses.h"

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace delaunayflip
{

namespace
{

bool HoldsPointArray(vtkPointData* data, vtkAbstractArray* array, MeshFormat format)
{
  switch (format)
  {
    case MeshFormat::PLY:
      return array == data->GetTCoords() ||
        (array == data->GetArray("RGB") && array->GetDataType() == VTK_UNSIGNED_CHAR &&
          array->GetNumberOfComponents() == 3);
    case MeshFormat::OBJ:
      return array == data->GetTCoords() || array == data->GetNormals();
    default:
      return false;
  }
}

/// `what` and, in parentheses, the names of the arrays of `data` for which `isHeld` is false.
template <typename Predicate>
std::string LostArrays(const std::string& what, vtkFieldData* data, const Predicate& isHeld)
{
  std::string names;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkAbstractArray* array = data->GetAbstractArray(index);
    if (!isHeld(array))
    {
      names += (names.empty() ? "" : ", ") + std::string(array->GetName() ? array->GetName() : "?");
    }
  }
  return names.empty() ? names : what + " (" + names + ")";
}

bool NeedsDoubles(vtkPoints* points)
{
  const vtkIdType count = points->GetDataType() == VTK_DOUBLE ? points->GetNumberOfPoints() : 0;
  for (vtkIdType point = 0; point < count; ++point)
  {
    const double* const coordinates = points->GetPoint(point);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double value = coordinates[axis];
      // A NaN, which differs from itself, is no loss: float has NaN too.
      if (value == value && static_cast<double>(static_cast<float>(value)) != value)
      {
        return true;
      }
    }
  }
  return false;
}

vtkIdType CountUnusedPoints(vtkPolyData* mesh)
{
  std::vector<bool> used(mesh->GetNumberOfPoints());
  vtkIdType unused = mesh->GetNumberOfPoints();
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
    for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      cell->GetCurrentCell(count, corners);
      for (vtkIdType corner = 0; corner < count; ++corner)
      {
        unused -= used[corners[corner]] ? 0 : 1;
        used[corners[corner]] = true;
      }
    }
  }
  return unused;
}

std::string Counted(const std::string& what, vtkIdType count)
{
  return count > 0 ? what + " (" + std::to_string(count) + ")" : std::string();
}

}

std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format)
{
  if (format == MeshFormat::VTK || format == MeshFormat::VTP)
  {
    return {};
  }
  const auto isHeld = [mesh, format](vtkAbstractArray* array)
  { return HoldsPointArray(mesh->GetPointData(), array, format); };
  const auto never = [](vtkAbstractArray*) { return false; };
  std::string list;
  for (const std::string& loss : {
         Counted("lines", format == MeshFormat::OBJ ? 0 : mesh->GetNumberOfLines()),
         Counted("verts", mesh->GetNumberOfVerts()),
         Counted("unused points", format == MeshFormat::STL ? CountUnusedPoints(mesh) : 0),
         LostArrays("point data", mesh->GetPointData(), isHeld),
         LostArrays("cell data", mesh->GetCellData(), never),
         LostArrays("field data", mesh->GetFieldData(), never),
         std::string(format != MeshFormat::OBJ && NeedsDoubles(mesh->GetPoints())
             ? "double precision of the points"
             : ""),
       })
  {
    list += (list.empty() || loss.empty() ? "" : ", ") + loss;
  }
  return list;
}

}
