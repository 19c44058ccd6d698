// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyReader.h"

#include "LegacyArrays.h"
#include "TextCursor.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace delaunayflip
{

namespace
{

/// Colors of a text go from 0 to 1.
unsigned char ToByte(float color)
{
  const float level = 255.0f * color + 0.5f;
  return level >= 0.0f ? static_cast<unsigned char>(std::min(level, 255.0f)) : 0;
}

/// Levels of ghosts, of files before VTK 6.3, as the type that they became.
void UpdateGhosts(vtkAbstractArray* array)
{
  auto* levels = vtkUnsignedCharArray::SafeDownCast(array);
  if (!levels || std::string(levels->GetName()) != "vtkGhostLevels")
  {
    return;
  }
  levels->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < levels->GetNumberOfValues(); ++i)
  {
    levels->SetValue(i, levels->GetValue(i) > 0 ? vtkDataSetAttributes::DUPLICATECELL : 0);
  }
}

class LegacyReader
{
public:
  explicit LegacyReader(const InputFile& file)
    : File(file),
      Cursor(file),
      Arrays(Cursor)
  {
  }

  FileMesh Read()
  {
    this->ReadHead();
    for (std::string keyword = this->Arrays.NextKeyword(); !keyword.empty();
         keyword = this->Arrays.NextKeyword())
    {
      this->ReadSection(keyword);
    }
    if (!this->Mesh()->GetPoints())
    {
      this->File.Fail("has no POINTS (truncated or corrupt)");
    }
    return this->Result;
  }

private:
  vtkPolyData* Mesh() const { return this->Result.Mesh; }

  void ReadHead()
  {
    if (this->Cursor.RestOfLine().rfind("# vtk DataFile Version", 0) != 0)
    {
      this->File.Fail("not a VTK file (it does not start with '# vtk DataFile Version')");
    }
    this->ReadVersion();
    this->Cursor.SkipLine();
    this->Cursor.SkipLine(); // the title
    const std::string encoding = this->Arrays.NextKeyword();
    if (encoding == "binary")
    {
      this->Arrays.SetBinary();
    }
    else if (encoding != "ascii")
    {
      this->Cursor.Fail("neither ASCII nor BINARY");
    }
    if (this->Arrays.NextKeyword() != "dataset")
    {
      this->Cursor.Fail("no DATASET");
    }
    const std::string type = this->Arrays.NextKeyword();
    if (type != "polydata")
    {
      FailOnType(this->File, type);
    }
  }

  void ReadVersion()
  {
    constexpr double newestKnown = 5.1;
    constexpr std::size_t prefix = 22;
    const std::string line(this->File.GetBytes().substr(0, 2 * prefix));
    const double version = std::atof(line.substr(std::min(prefix, line.size())).c_str());
    this->HasOffsets = version >= 5.0;
    if (version > newestKnown)
    {
      char number[32];
      std::snprintf(number, sizeof(number), "%g", version);
      this->Result.Warnings.push_back(
        this->File.GetName() + ": its version, " + number + ", is newer than those known here");
    }
  }

  void ReadSection(const std::string& keyword)
  {
    using Reader = void (LegacyReader::*)();
    static const std::map<std::string, Reader> sections = {
      { "field", &LegacyReader::ReadField },
      { "points", &LegacyReader::ReadPoints },
      { "vertices", &LegacyReader::ReadVertices },
      { "lines", &LegacyReader::ReadLines },
      { "polygons", &LegacyReader::ReadPolygons },
      { "triangle_strips", &LegacyReader::ReadStrips },
      { "cell_data", &LegacyReader::BeginCellData },
      { "point_data", &LegacyReader::BeginPointData },
    };
    static const std::map<std::string, Reader> attributes = {
      { "scalars", &LegacyReader::ReadScalars },
      { "color_scalars", &LegacyReader::ReadColors },
      { "lookup_table", &LegacyReader::ReadLookupTable },
      { "vectors", &LegacyReader::ReadAttribute<vtkDataSetAttributes::VECTORS, 3> },
      { "normals", &LegacyReader::ReadAttribute<vtkDataSetAttributes::NORMALS, 3> },
      { "tensors", &LegacyReader::ReadAttribute<vtkDataSetAttributes::TENSORS, 9> },
      { "tensors6", &LegacyReader::ReadAttribute<vtkDataSetAttributes::TENSORS, 6> },
      { "texture_coordinates", &LegacyReader::ReadTexture },
      { "global_ids", &LegacyReader::ReadAttribute<vtkDataSetAttributes::GLOBALIDS, 1> },
      { "pedigree_ids", &LegacyReader::ReadAttribute<vtkDataSetAttributes::PEDIGREEIDS, 1> },
      { "edge_flags", &LegacyReader::ReadAttribute<vtkDataSetAttributes::EDGEFLAG, 1> },
    };
    const auto section = sections.find(keyword);
    const auto attribute = attributes.find(keyword);
    if (section == sections.end() && (attribute == attributes.end() || !this->Attributes))
    {
      this->Cursor.Fail("an unknown keyword, or one that does not belong here");
    }
    (this->*(section != sections.end() ? section : attribute)->second)();
  }

  void ReadPoints()
  {
    const vtkIdType count = this->Arrays.NextCount();
    vtkNew<vtkPoints> points;
    points->SetData(this->Arrays.ReadNumbers(this->Arrays.NextKeyword(), count, 3));
    this->Mesh()->SetPoints(points);
  }

  void ReadVertices() { this->Mesh()->SetVerts(this->ReadCells()); }
  void ReadLines() { this->Mesh()->SetLines(this->ReadCells()); }
  void ReadPolygons() { this->Mesh()->SetPolys(this->ReadCells()); }
  void ReadStrips() { this->Mesh()->SetStrips(this->ReadCells()); }

  vtkSmartPointer<vtkCellArray> ReadCells()
  {
    const vtkIdType first = this->Arrays.NextCount();
    const vtkIdType second = this->Arrays.NextCount();
    return this->HasOffsets ? this->ReadOffsets(first, second) : this->ReadSizes(first, second);
  }

  /// Since version 5: where each cell begins, and after that the ids of all.
  vtkSmartPointer<vtkCellArray> ReadOffsets(vtkIdType offsets, vtkIdType ids)
  {
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    if (offsets < 1)
    {
      return cells;
    }
    const auto begins = this->ReadNamed("offsets", offsets);
    const auto corners = this->ReadNamed("connectivity", ids);
    vtkIdType last = 0;
    for (vtkIdType cell = 0; cell < offsets; ++cell)
    {
      const auto begin = static_cast<vtkIdType>(begins->GetTuple1(cell));
      if (begin < last || begin > ids || (cell == 0 && begin != 0))
      {
        this->Cursor.Fail("offset " + std::to_string(begin) + " of cell " + std::to_string(cell) +
          " is out of order");
      }
      last = begin;
    }
    if (last != ids || !cells->SetData(begins, corners))
    {
      this->Cursor.Fail(
        "cells of " + std::to_string(last) + " ids, but " + std::to_string(ids) + " ids");
    }
    return cells;
  }

  vtkSmartPointer<vtkDataArray> ReadNamed(const std::string& name, vtkIdType size)
  {
    if (this->Arrays.NextKeyword() != name)
    {
      this->Cursor.Fail("the " + name + " of cells are missing");
    }
    const auto array = this->Arrays.ReadNumbers(this->Arrays.NextKeyword(), size, 1);
    if (array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE)
    {
      this->Cursor.Fail("the " + name + " of cells must be integers");
    }
    if (array->GetDataType() == VTK_INT || vtkTypeInt64Array::SafeDownCast(array))
    {
      return array;
    }
    auto integers = vtkSmartPointer<vtkTypeInt64Array>::New();
    integers->DeepCopy(array);
    return integers;
  }

  /// Before version 5: the number of ids of each cell, and its ids.
  vtkSmartPointer<vtkCellArray> ReadSizes(vtkIdType count, vtkIdType size)
  {
    const auto array = this->Arrays.ReadNumbers("vtkidtype", size, 1);
    const auto* const numbers = vtkIdTypeArray::SafeDownCast(array)->GetPointer(0);
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->AllocateExact(std::min(count, size), std::max<vtkIdType>(size - count, 0));
    vtkIdType place = 0;
    for (vtkIdType cell = 0; cell < count; ++cell)
    {
      const vtkIdType corners = place < size ? numbers[place++] : -1;
      if (corners < 0 || corners > size - place)
      {
        this->Cursor.Fail("cell " + std::to_string(cell) + " of " + std::to_string(count) +
          " does not fit into the " + std::to_string(size) + " numbers of all cells");
      }
      cells->InsertNextCell(corners, numbers + place);
      place += corners;
    }
    if (place != size)
    {
      this->Cursor.Fail(std::to_string(size - place) + " numbers more than the cells have");
    }
    return cells;
  }

  void BeginCellData()
  {
    this->BeginData(this->Mesh()->GetCellData(), this->Mesh()->GetNumberOfCells(), "cells");
  }

  void BeginPointData()
  {
    this->BeginData(this->Mesh()->GetPointData(), this->Mesh()->GetNumberOfPoints(), "points");
  }

  void BeginData(vtkDataSetAttributes* attributes, vtkIdType size, const std::string& what)
  {
    this->Attributes = attributes;
    this->Tuples = this->Arrays.NextCount();
    if (this->Tuples != size)
    {
      this->Cursor.Fail("data for " + std::to_string(this->Tuples) + " " + what +
        ", but there are " + std::to_string(size));
    }
  }

  void ReadScalars()
  {
    const std::string name = this->Arrays.NextName();
    const std::string type = this->Arrays.NextKeyword();
    vtkIdType components = 1;
    this->Cursor.SkipSpace();
    if (!this->Cursor.IsAtLineEnd() && std::isdigit(*this->Cursor.NextBytes(0)))
    {
      components = this->Arrays.NextCount();
    }
    if (this->Arrays.NextKeyword() != "lookup_table")
    {
      this->Cursor.Fail("scalars without LOOKUP_TABLE");
    }
    const std::string table = this->Arrays.NextName();
    const auto array = this->Arrays.ReadNumbers(type, this->Tuples, components);
    if (this->Add(array, name, vtkDataSetAttributes::SCALARS))
    {
      this->TableName = table;
    }
  }

  /// Bytes in binary files, from 0 to 1 in text.
  void ReadColors()
  {
    const std::string name = this->Arrays.NextName();
    const vtkIdType components = this->Arrays.NextCount();
    const bool isBinary = this->Arrays.GetBinary();
    const auto array =
      this->Arrays.ReadNumbers(isBinary ? "unsigned_char" : "float", this->Tuples, components);
    this->Add(isBinary ? array : this->ToBytes(array), name, vtkDataSetAttributes::SCALARS);
  }

  static vtkSmartPointer<vtkDataArray> ToBytes(vtkDataArray* array)
  {
    auto* const colors = vtkFloatArray::SafeDownCast(array);
    auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
    bytes->SetNumberOfComponents(colors->GetNumberOfComponents());
    bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
    std::transform(colors->GetPointer(0), colors->GetPointer(0) + colors->GetNumberOfValues(),
      bytes->GetPointer(0), ToByte);
    return bytes;
  }

  /// A table of the name that the scalars gave.
  void ReadLookupTable()
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
      table->SetTableValue(
        i, color[0] / scale, color[1] / scale, color[2] / scale, color[3] / scale);
    }
    if (this->Attributes->GetScalars() && name == this->TableName)
    {
      this->Attributes->GetScalars()->SetLookupTable(table);
    }
  }

  template <int Attribute, int Components>
  void ReadAttribute()
  {
    const std::string name = this->Arrays.NextName();
    const auto array = this->Arrays.Read(this->Arrays.NextKeyword(), this->Tuples, Components);
    this->Add(array, name, Attribute);
  }

  void ReadTexture()
  {
    const std::string name = this->Arrays.NextName();
    const vtkIdType components = this->Arrays.NextCount();
    const std::string type = this->Arrays.NextKeyword();
    const auto array = this->Arrays.ReadNumbers(type, this->Tuples, components);
    this->Add(array, name, vtkDataSetAttributes::TCOORDS);
  }

  /// Makes the array the attribute if there is none yet, else one among others; whether the former.
  bool Add(vtkAbstractArray* array, const std::string& name, int attribute)
  {
    array->SetName(name.c_str());
    const bool isFirst = !this->Attributes->GetAbstractAttribute(attribute);
    if (!isFirst || this->Attributes->SetAttribute(array, attribute) < 0)
    {
      this->Attributes->AddArray(array);
    }
    return isFirst;
  }

  /// Named arrays, of the points, the cells, or before both of the mesh as a whole.
  void ReadField()
  {
    this->Arrays.NextName();
    const vtkIdType count = this->Arrays.NextCount();
    vtkFieldData* const data = this->Attributes ? this->Attributes : this->Mesh()->GetFieldData();
    for (vtkIdType i = 0; i < count; ++i)
    {
      const std::string name = this->Arrays.NextName();
      if (name == "NULL_ARRAY")
      {
        continue;
      }
      const vtkIdType components = this->Arrays.NextCount();
      const vtkIdType tuples = this->Arrays.NextCount();
      const auto array = this->Arrays.Read(this->Arrays.NextKeyword(), tuples, components);
      array->SetName(name.c_str());
      if (this->Attributes)
      {
        UpdateGhosts(array);
      }
      data->AddArray(array);
    }
  }

  const InputFile& File;
  TextCursor Cursor;
  LegacyArrays Arrays;
  FileMesh Result;
  bool HasOffsets = false;
  vtkDataSetAttributes* Attributes = nullptr; ///< Of the points or cells, when data have begun.
  vtkIdType Tuples = 0; ///< That they have.
  std::string TableName; ///< What the active scalars call their colors.
};

}

void FailOnType(const InputFile& file, const std::string& type)
{
  std::string printable = type.substr(0, 40);
  std::replace_if(
    printable.begin(), printable.end(), [](char letter) { return letter < ' ' || letter > '~'; },
    '?');
  file.Fail("holds " + printable +
    ", not a surface mesh (PolyData); ParaView's Extract Surface (vtkDataSetSurfaceFilter) "
    "extracts "
    "one");
}

FileMesh ReadLegacy(const InputFile& file) { return LegacyReader(file).Read(); }

}
