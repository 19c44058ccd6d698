// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "PlyArrays.h"

#include <vtkDataSetAttributes.h>

#include <algorithm>

namespace delaunayflip
{

namespace
{

const char* const PointsName = "x y z";

struct PlyGroup
{
  std::string Array;
  std::vector<std::string> Properties;
};

/// The names in use, larger groups first.
const std::vector<PlyGroup>& Groups()
{
  static const std::vector<PlyGroup> groups = {
    { PointsName, { "x", "y", "z" } },
    { "Normals", { "nx", "ny", "nz" } },
    { "RGBA", { "red", "green", "blue", "alpha" } },
    { "RGB", { "red", "green", "blue" } },
    { "RGB", { "diffuse_red", "diffuse_green", "diffuse_blue" } },
    { "TCoords", { "u", "v" } },
    { "TCoords", { "s", "t" } },
    { "TCoords", { "texture_u", "texture_v" } },
  };
  return groups;
}

int VtkTypeOf(PlyType type)
{
  switch (type)
  {
    case PlyType::Int8:
      return VTK_SIGNED_CHAR;
    case PlyType::UInt8:
      return VTK_UNSIGNED_CHAR;
    case PlyType::Int16:
      return VTK_SHORT;
    case PlyType::UInt16:
      return VTK_UNSIGNED_SHORT;
    case PlyType::Int32:
      return VTK_INT;
    case PlyType::UInt32:
      return VTK_UNSIGNED_INT;
    case PlyType::Float32:
      return VTK_FLOAT;
    default:
      return VTK_DOUBLE;
  }
}

/// An array with zeros before and after it.
vtkSmartPointer<vtkDataArray> Padded(vtkDataArray* array, vtkIdType before, vtkIdType after)
{
  const auto padded = vtk::TakeSmartPointer(array->NewInstance());
  padded->SetName(array->GetName());
  padded->SetNumberOfComponents(array->GetNumberOfComponents());
  padded->SetNumberOfTuples(before + array->GetNumberOfTuples() + after);
  padded->Fill(0.0);
  padded->InsertTuples(before, array->GetNumberOfTuples(), 0, array);
  return padded;
}

}

PlyColumn::PlyColumn(PlyType type, vtkDataArray* array, int component)
  : Type(type),
    Widens(array->GetDataType() != VtkTypeOf(type)),
    Next(static_cast<char*>(array->GetVoidPointer(0)) + component * array->GetDataTypeSize()),
    Stride(static_cast<std::size_t>(array->GetNumberOfComponents() * array->GetDataTypeSize()))
{
}

PlyArrays::PlyArrays(const PlyElement& element)
  : Columns(element.Properties.size()),
    Element(element),
    Assigned(element.Properties.size())
{
  for (const PlyGroup& group : Groups())
  {
    const Members members = this->FindMembers(group.Properties);
    if (members.size() == group.Properties.size())
    {
      this->AddArray(group.Array, members);
    }
  }
  for (std::size_t i = 0; i < element.Properties.size(); ++i)
  {
    if (!this->Assigned[i] && !element.Properties[i].CountType)
    {
      this->AddArray(element.Properties[i].Name, { i });
    }
  }
}

PlyArrays::Members PlyArrays::FindMembers(const std::vector<std::string>& names) const
{
  Members members;
  for (const std::string& name : names)
  {
    for (std::size_t i = 0; i < this->Element.Properties.size(); ++i)
    {
      const PlyProperty& property = this->Element.Properties[i];
      if (property.Name == name && !property.CountType && !this->Assigned[i])
      {
        members.push_back(i);
        break;
      }
    }
  }
  return members;
}

void PlyArrays::AddArray(const std::string& name, const Members& members)
{
  const auto typeOf = [this](std::size_t member) { return this->Element.Properties[member].Type; };
  const PlyType first = typeOf(members[0]);
  const bool isUniform = std::all_of(members.begin(), members.end(),
    [&typeOf, first](std::size_t member) { return typeOf(member) == first; });
  const bool isPoints = name == PointsName;
  const bool widens = !isUniform || (isPoints && first != PlyType::Float32);
  const auto array =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(widens ? VTK_DOUBLE : VtkTypeOf(first)));
  array->SetName(name.c_str());
  array->SetNumberOfComponents(static_cast<int>(members.size()));
  array->SetNumberOfTuples(this->Element.Count);
  for (std::size_t i = 0; i < members.size(); ++i)
  {
    this->Columns[members[i]] = PlyColumn(typeOf(members[i]), array, static_cast<int>(i));
    this->Assigned[members[i]] = true;
  }
  this->Arrays.push_back(array);
}

vtkSmartPointer<vtkDataArray> PlyArrays::TakePoints()
{
  if (this->Arrays.empty() || this->Arrays[0]->GetName() != std::string(PointsName))
  {
    return nullptr;
  }
  const auto points = this->Arrays[0];
  this->Arrays.erase(this->Arrays.begin());
  return points;
}

void PlyArrays::AddTo(vtkDataSetAttributes* data, vtkIdType before, vtkIdType after) const
{
  for (const auto& original : this->Arrays)
  {
    const auto array = before + after > 0 ? Padded(original, before, after) : original;
    const std::string name = array->GetName();
    data->AddArray(array);
    if (name == "RGB" || name == "RGBA")
    {
      data->SetActiveScalars(name.c_str());
    }
    else if (name == "Normals" && array->GetNumberOfComponents() == 3)
    {
      data->SetActiveNormals(name.c_str());
    }
    else if (name == "TCoords" && array->GetNumberOfComponents() == 2)
    {
      data->SetActiveTCoords(name.c_str());
    }
  }
}

}
