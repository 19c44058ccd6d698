// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataArrays.h"

#include "FlipError.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

namespace delaunayflip
{

PointArray ViewPoints(vtkPolyData* mesh, std::vector<double>& storage)
{
  const vtkIdType count = mesh->GetNumberOfPoints();
  if (count == 0)
  {
    return {};
  }
  vtkDataArray* data = mesh->GetPoints()->GetData();
  if (data->GetNumberOfComponents() != 3)
  {
    throw InvalidMesh(
      "Points must have 3 coordinates, not " + std::to_string(data->GetNumberOfComponents()) + ".",
      -1, -1);
  }
  if (auto* floats = vtkArrayDownCast<vtkAOSDataArrayTemplate<float>>(data))
  {
    return { static_cast<const float*>(floats->GetPointer(0)), count };
  }
  if (auto* doubles = vtkArrayDownCast<vtkAOSDataArrayTemplate<double>>(data))
  {
    return { static_cast<const double*>(doubles->GetPointer(0)), count };
  }
  storage.resize(3 * count);
  for (vtkIdType point = 0; point < count; ++point)
  {
    data->GetTuple(point, &storage[3 * point]);
  }
  return { static_cast<const double*>(storage.data()), count };
}

bool HaveSameBits(const PointArray& points, const PointArray& others)
{
  const auto areSame = [&](const auto* a, const auto* b)
  { return a && b && (a == b || std::memcmp(a, b, 3 * points.Count * sizeof(*a)) == 0); };
  return points.Count == others.Count &&
    (areSame(points.Floats, others.Floats) || areSame(points.Doubles, others.Doubles));
}

void PointIdCheck::RequireValid(vtkCellArray* cells) const
{
  if (!cells->IsValid())
  {
    throw InvalidMesh(std::string("The offsets and the connectivity of the cell array of ") +
        this->What + " " + std::to_string(this->FirstCell) +
        " and the following ones contradict each other.",
      this->FirstCell, -1);
  }
}

void PointIdCheck::ThrowOutOfRange(vtkIdType cell, vtkIdType id) const
{
  const vtkIdType cellId = this->FirstCell + cell;
  throw InvalidMesh(std::string("Invalid mesh: ") + this->What + " " + std::to_string(cellId) +
      " names point " + std::to_string(id) + ", but there are " +
      std::to_string(this->NumberOfPoints) + " points, numbered from 0.",
    cellId, id);
}

//------------------------------------------------------------------------------
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

namespace
{

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

}

std::vector<Defect> ListMalformedArrays(vtkPolyData* mesh, bool pointsPass, bool cellsPass)
{
  std::vector<Defect> defects;
  const auto addShort =
    [&](const std::string& kind, vtkDataSetAttributes* data, vtkIdType tuples, bool pass)
  {
    std::vector<std::string> names;
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* array = data->GetAbstractArray(i);
      if (array->GetNumberOfTuples() < tuples)
      {
        names.emplace_back(array->GetName() ? array->GetName() : "");
      }
    }
    if (!names.empty())
    {
      defects.push_back({ kind + (names.size() == 1 ? " array" : " arrays") +
          " with too few tuples " + (pass ? "passed unchanged" : "left out") + ": " + List(names),
        static_cast<std::int64_t>(names.size()), {} });
    }
  };
  addShort("point", mesh->GetPointData(), mesh->GetNumberOfPoints(), pointsPass);
  addShort("cell", mesh->GetCellData(), mesh->GetNumberOfCells(), cellsPass);
  const char* name = vtkDataSetAttributes::GhostArrayName();
  vtkAbstractArray* ghosts = mesh->GetCellData()->GetAbstractArray(name);
  if (ghosts && IsWrongGhostArray(ghosts))
  {
    const std::string fault = ghosts->GetDataType() != VTK_UNSIGNED_CHAR
      ? "ghost array that is not of type unsigned char ignored"
      : "ghost array with several components ignored";
    defects.push_back({ fault + ": " + List({ name }), 1, {} });
  }
  return defects;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkIdList> MakeRange(vtkIdType first, vtkIdType count)
{
  auto range = vtkSmartPointer<vtkIdList>::New();
  range->SetNumberOfIds(count);
  std::iota(range->begin(), range->end(), first);
  return range;
}

vtkSmartPointer<vtkAbstractArray> MakeZeros(vtkAbstractArray* like, vtkIdType tuples)
{
  auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(like->GetDataType()));
  if (array)
  {
    array->SetName(like->GetName());
    array->SetNumberOfComponents(like->GetNumberOfComponents());
    array->SetNumberOfTuples(tuples);
  }
  if (auto* numbers = vtkArrayDownCast<vtkDataArray>(array))
  {
    numbers->Fill(0.0);
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> ExtendArray(
  vtkAbstractArray* array, vtkIdType count, vtkAbstractArray* others, vtkIdList* places)
{
  auto made = MakeZeros(array, count + places->GetNumberOfIds());
  if (made)
  {
    made->CopyInformation(array->GetInformation());
    made->InsertTuples(0, count, 0, array);
  }
  if (made && others)
  {
    made->InsertTuples(MakeRange(count, places->GetNumberOfIds()), places, others);
  }
  return made;
}

void AddArrayAs(int attribute, vtkAbstractArray* array, vtkDataSetAttributes* data)
{
  const int index = data->AddArray(array);
  if (attribute >= 0 && !data->GetAbstractAttribute(attribute))
  {
    data->SetActiveAttribute(index, attribute);
  }
}

bool IsSameKind(vtkAbstractArray* a, vtkAbstractArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents();
}

void JoinTuples(vtkDataSetAttributes* own, vtkDataSetAttributes* more, vtkIdList* sources,
  vtkDataSetAttributes* result)
{
  vtkNew<vtkIdList> ownIds, ownPlaces, otherIds, otherPlaces;
  for (vtkIdType i = 0; i < sources->GetNumberOfIds(); ++i)
  {
    const vtkIdType source = sources->GetId(i);
    (source >= 0 ? ownIds : otherIds)->InsertNextId(source >= 0 ? source : -1 - source);
    (source >= 0 ? ownPlaces : otherPlaces)->InsertNextId(i);
  }
  if (more && own->GetNumberOfArrays() == 0)
  {
    if (ownIds->GetNumberOfIds() == 0)
    {
      result->ShallowCopy(more);
    }
    return;
  }
  result->CopyAllOn();
  result->CopyAllocate(own, sources->GetNumberOfIds());
  result->CopyData(own, ownIds, ownPlaces);
  for (int i = 0; more && i < result->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* target = result->GetAbstractArray(i);
    const char* name = target->GetName();
    vtkAbstractArray* source = more->GetAbstractArray(name ? name : "");
    if (source)
    {
      target->InsertTuples(otherPlaces, otherIds, source);
    }
  }
}

}
