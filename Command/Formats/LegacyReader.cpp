// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyReader.h"

#include "LegacyArrays.h"
#include "LegacyAttributes.h"
#include "TextCursor.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <map>

namespace delaunayflip
{

namespace
{

/// Converts the ghost levels of files before VTK 6.3 to ghost types.
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
      Arrays(Cursor),
      Attributes(Arrays)
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
        this->File.GetName() + ": is of version " + number + ", newer than any known here");
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
    const auto section = sections.find(keyword);
    if (section != sections.end())
    {
      (this->*section->second)();
    }
    else if (!this->Attributes.Read(keyword))
    {
      this->Cursor.Fail("an unknown keyword, or one that does not belong here");
    }
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

  /// Since version 5: the offset of each cell, followed by the ids of all cells.
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
      this->Cursor.Fail("the last offset is " + std::to_string(last) +
        ", but the number of ids is " + std::to_string(ids));
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
          " exceeds the size of the list of cells, " + std::to_string(size));
      }
      cells->InsertNextCell(corners, numbers + place);
      place += corners;
    }
    if (place != size)
    {
      this->Cursor.Fail("the size of the list of cells is " + std::to_string(size) +
        ", but its cells end at " + std::to_string(place));
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
    const vtkIdType tuples = this->Arrays.NextCount();
    if (tuples != size)
    {
      this->Cursor.Fail("the number of values is " + std::to_string(tuples) +
        ", but the number of " + what + " is " + std::to_string(size));
    }
    this->Attributes.Begin(attributes, tuples);
  }

  /// Named arrays: point data, cell data or, before either has begun, field data.
  void ReadField()
  {
    this->Arrays.NextName();
    const vtkIdType count = this->Arrays.NextCount();
    vtkFieldData* const data =
      this->Attributes.Get() ? this->Attributes.Get() : this->Mesh()->GetFieldData();
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
      if (this->Attributes.Get())
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
  LegacyAttributes Attributes; ///< Those of the points or cells, once their data have begun.
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
