// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyAttributes.h"

#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <map>

namespace delaunayflip
{

namespace
{

/// Colours in text files go from 0 to 1.
unsigned char ToByte(float color)
{
  const double level = 255.0 * color + 0.5;
  return level >= 0.0 ? static_cast<unsigned char>(std::min(level, 255.0)) : 0;
}

vtkSmartPointer<vtkDataArray> ToBytes(vtkDataArray* array)
{
  auto* const colors = vtkFloatArray::SafeDownCast(array);
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetNumberOfComponents(colors->GetNumberOfComponents());
  bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
  std::transform(colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues(),
    bytes->GetPointer(0), ToByte);
  return bytes;
}

}

bool LegacyAttributes::Read(const std::string& keyword)
{
  using Reader = void (LegacyAttributes::*)();
  static const std::map<std::string, Reader> attributes = {
    { "scalars", &LegacyAttributes::ReadScalars },
    { "color_scalars", &LegacyAttributes::ReadColors },
    { "lookup_table", &LegacyAttributes::ReadLookupTable },
    { "vectors", &LegacyAttributes::ReadArray<vtkDataSetAttributes::VECTORS, 3> },
    { "normals", &LegacyAttributes::ReadArray<vtkDataSetAttributes::NORMALS, 3> },
    { "tensors", &LegacyAttributes::ReadArray<vtkDataSetAttributes::TENSORS, 9> },
    { "tensors6", &LegacyAttributes::ReadArray<vtkDataSetAttributes::TENSORS, 6> },
    { "texture_coordinates", &LegacyAttributes::ReadTexture },
    { "global_ids", &LegacyAttributes::ReadArray<vtkDataSetAttributes::GLOBALIDS, 1> },
    { "pedigree_ids", &LegacyAttributes::ReadArray<vtkDataSetAttributes::PEDIGREEIDS, 1> },
    { "edge_flags", &LegacyAttributes::ReadArray<vtkDataSetAttributes::EDGEFLAG, 1> },
  };
  const auto reader = attributes.find(keyword);
  if (reader == attributes.end() || !this->Data)
  {
    return false;
  }
  (this->*reader->second)();
  return true;
}

void LegacyAttributes::ReadScalars()
{
  const std::string name = this->Arrays.NextName();
  const std::string type = this->Arrays.NextKeyword();
  vtkIdType components = 1;
  if (this->Arrays.IsAtDigit())
  {
    components = this->Arrays.NextCount();
  }
  if (this->Arrays.NextKeyword() != "lookup_table")
  {
    this->Arrays.Fail("scalars without LOOKUP_TABLE");
  }
  const std::string table = this->Arrays.NextName();
  const auto array = this->Arrays.ReadNumbers(type, this->Tuples, components);
  if (this->Add(array, name, vtkDataSetAttributes::SCALARS))
  {
    this->TableName = table;
  }
}

/// Bytes in binary files, from 0 to 1 in text.
void LegacyAttributes::ReadColors()
{
  const std::string name = this->Arrays.NextName();
  const vtkIdType components = this->Arrays.NextCount();
  const bool isBinary = this->Arrays.GetBinary();
  const auto array =
    this->Arrays.ReadNumbers(isBinary ? "unsigned_char" : "float", this->Tuples, components);
  this->Add(isBinary ? array : ToBytes(array), name, vtkDataSetAttributes::SCALARS);
}

/// Reads a table with the name that the scalars gave.
void LegacyAttributes::ReadLookupTable()
{
  const std::string name = this->Arrays.NextName();
  const vtkIdType size = this->Arrays.NextCount();
  const bool isBinary = this->Arrays.GetBinary();
  const auto colors = this->Arrays.ReadNumbers(isBinary ? "unsigned_char" : "float", size, 4);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(size);
  for (vtkIdType i = 0; i < size; ++i)
  {
    const double scale = isBinary ? 255.0 : 1.0;
    const double* const color = colors->GetTuple4(i);
    table->SetTableValue(i, color[0] / scale, color[1] / scale, color[2] / scale, color[3] / scale);
  }
  if (this->Data->GetScalars() && name == this->TableName)
  {
    this->Data->GetScalars()->SetLookupTable(table);
  }
}

template <int Attribute, int Components>
void LegacyAttributes::ReadArray()
{
  const std::string name = this->Arrays.NextName();
  const auto array = this->Arrays.Read(this->Arrays.NextKeyword(), this->Tuples, Components);
  this->Add(array, name, Attribute);
}

void LegacyAttributes::ReadTexture()
{
  const std::string name = this->Arrays.NextName();
  const vtkIdType components = this->Arrays.NextCount();
  const std::string type = this->Arrays.NextKeyword();
  const auto array = this->Arrays.ReadNumbers(type, this->Tuples, components);
  this->Add(array, name, vtkDataSetAttributes::TCOORDS);
}

/// Makes the array the active attribute if there is none yet, else adds it as an ordinary array.
/// @returns whether it became the active attribute.
bool LegacyAttributes::Add(vtkAbstractArray* array, const std::string& name, int attribute)
{
  array->SetName(name.c_str());
  const bool isFirst = !this->Data->GetAbstractAttribute(attribute);
  if (!isFirst || this->Data->SetAttribute(array, attribute) < 0)
  {
    this->Data->AddArray(array);
  }
  return isFirst;
}

}
