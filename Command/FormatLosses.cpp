// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "FormatLosses.h"

#include "FloatPoints.h"
#include "ObjPlan.h"
#include "PlyWriter.h"
#include "XmlWriter.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <functional>
#include <vector>

namespace delaunayflip
{

namespace
{

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

std::string Joined(const std::vector<std::string>& losses)
{
  std::string list;
  for (const std::string& loss : losses)
  {
    list += (list.empty() || loss.empty() ? "" : ", ") + loss;
  }
  return list;
}

std::string Counted(const std::string& what, vtkIdType count)
{
  return count > 0 ? what + " (" + std::to_string(count) + ")" : std::string();
}

using Holds = std::function<bool(vtkAbstractArray*)>;

/// What a format can hold.
struct FormatLimits
{
  Holds PointData;
  Holds CellData;
  Holds FieldData;
  bool HoldsLines = false;
  bool HoldsVerts = false;
};

FormatLimits LimitsOf(vtkPolyData* mesh, MeshFormat format)
{
  const auto nothing = [](vtkAbstractArray*) { return false; };
  if (format == MeshFormat::PLY)
  {
    const PlyPlan points = PlanPlyVertices(mesh);
    const PlyPlan cells = PlanPlyFaces(mesh);
    return { [points](vtkAbstractArray* array) { return points.Holds(array); },
      [cells](vtkAbstractArray* array) { return cells.Holds(array); }, nothing, true, false };
  }
  if (format == MeshFormat::OBJ)
  {
    const ObjPlan plan(mesh);
    const auto holds = [plan](vtkAbstractArray* array) { return plan.Holds(array); };
    return { holds, holds, holds, true, true };
  }
  return { nothing, nothing, nothing };
}

bool IsOrdinary(vtkDataSetAttributes* data, vtkAbstractArray* array)
{
  const bool isIds = array == data->GetAbstractAttribute(vtkDataSetAttributes::PEDIGREEIDS) ||
    array == data->GetAbstractAttribute(vtkDataSetAttributes::GLOBALIDS);
  return !isIds || CanBeXmlIds(array);
}

std::string DescribeXmlLosses(vtkPolyData* mesh)
{
  std::vector<std::string> losses;
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(mesh->GetPointData()),
         static_cast<vtkDataSetAttributes*>(mesh->GetCellData()) })
  {
    losses.push_back(LostArrays("the id attribute of arrays", data,
      [data](vtkAbstractArray* array) { return IsOrdinary(data, array); }));
  }
  return Joined(losses);
}

}

std::string DescribeLosses(vtkPolyData* mesh, MeshFormat format)
{
  if (format == MeshFormat::VTK)
  {
    return {};
  }
  if (format == MeshFormat::VTP)
  {
    return DescribeXmlLosses(mesh);
  }
  const FormatLimits limits = LimitsOf(mesh, format);
  const bool losesCellData = format == MeshFormat::PLY && mesh->GetNumberOfLines() > 0 &&
    mesh->GetCellData()->GetNumberOfArrays() > 0;
  return Joined({
    Counted("lines", limits.HoldsLines ? 0 : mesh->GetNumberOfLines()),
    Counted("verts", limits.HoldsVerts ? 0 : mesh->GetNumberOfVerts()),
    Counted("unused points", format == MeshFormat::STL ? CountUnusedPoints(mesh) : 0),
    LostArrays("point data", mesh->GetPointData(), limits.PointData),
    LostArrays("cell data", mesh->GetCellData(), limits.CellData),
    losesCellData ? "cell data of lines" : "",
    LostArrays("field data", mesh->GetFieldData(), limits.FieldData),
    format == MeshFormat::STL ? DescribeRoundingToFloat(mesh) : "",
  });
}

}
