// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "DataArrays.h"
#include "Formats.h"
#include "PlyProperties.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <fstream>
#include <sstream>

/// @file
/// The writer of .ply.

namespace delaunayflip
{

namespace
{

const char* NameOf(int type)
{
  const auto* const found = std::find_if(std::begin(PlyTypes), std::end(PlyTypes),
    [type](const auto& one) { return one.second == type && type < VTK_LONG_LONG; });
  return found == std::end(PlyTypes) ? nullptr : found->first;
}

/// The type of a .ply that holds all values of an array; VTK_VOID if none does.
int TypeFor(vtkDataArray* array)
{
  if (NameOf(array->GetDataType()))
  {
    return array->GetDataType();
  }
  const double* const range = array->GetRange(-1); // of the lengths, if there are components
  return std::max(-range[0], range[1]) < std::ldexp(1.0, 53) ? VTK_DOUBLE : VTK_VOID;
}

/// The names by which other programs know an array, else its own, as one word.
Names PropertyNames(vtkDataSetAttributes* data, vtkDataArray* array)
{
  std::string name = GetName(array);
  if (name.empty())
  {
    name = "values";
  }
  const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
  for (const PlyGroup& group : PlyGroups)
  {
    const bool isColor = group.Attribute == vtkDataSetAttributes::SCALARS;
    const bool isActive = array == data->GetAbstractAttribute(group.Attribute) &&
      (!isColor || array->GetDataType() == VTK_UNSIGNED_CHAR);
    if (group.Properties.size() == components && (isActive || (isColor && name == group.Array)))
    {
      return group.Properties;
    }
  }
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isspace(c) || std::iscntrl(c); },
    '_');
  Names names(components, name);
  for (std::size_t component = 0; component < components && components > 1; ++component)
  {
    names[component] += "_" + std::to_string(component);
  }
  return names;
}

bool HasColumn(const std::vector<PlyProperty>& columns, const std::string& name)
{
  return std::any_of(columns.begin(), columns.end(),
    [&name](const PlyProperty& column) { return column.Name == name; });
}

/// The properties of vertices. Leaves out arrays that a .ply cannot hold: strings, too large
/// integers, and an array if the coordinates or an earlier array use its name.
std::vector<PlyProperty> PlanColumns(vtkPolyData* mesh)
{
  vtkDataArray* const points = mesh->GetPoints()->GetData();
  const int real = points->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  std::vector<PlyProperty> columns = { { "x", real, points, 0 }, { "y", real, points, 1 },
    { "z", real, points, 2 } };
  vtkPointData* const data = mesh->GetPointData();
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    const bool isWhole = array && array->GetNumberOfTuples() >= mesh->GetNumberOfPoints();
    if (!isWhole || TypeFor(array) == VTK_VOID)
    {
      continue;
    }
    const Names names = PropertyNames(data, array);
    const bool isTaken = std::any_of(names.begin(), names.end(),
      [&columns](const std::string& name) { return HasColumn(columns, name); });
    for (std::size_t component = 0; component < names.size() && !isTaken; ++component)
    {
      columns.push_back({ names[component], TypeFor(array), array, static_cast<int>(component) });
    }
  }
  return columns;
}

/// The properties of faces: arrays of integers of cells, and colors. Larger integers are left out.
std::vector<PlyProperty> PlanFaceColumns(vtkPolyData* mesh)
{
  std::vector<PlyProperty> columns;
  vtkCellData* const data = mesh->GetCellData();
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    if (!array || !IsInteger(array->GetDataType()) ||
      array->GetNumberOfTuples() < mesh->GetNumberOfCells())
    {
      continue;
    }
    int type = array->GetDataType();
    if (!NameOf(type))
    {
      const double* const range = array->GetRange(0);
      const bool fits = range[0] >= VTK_INT_MIN && range[1] <= VTK_INT_MAX;
      if (!fits)
      {
        continue;
      }
      type = VTK_INT;
    }
    const Names names = PropertyNames(data, array);
    const bool isTaken = std::any_of(names.begin(), names.end(),
      [&columns](const std::string& name)
      { return HasColumn(columns, name) || name == "vertex_indices" || name == "vertex_index"; });
    const bool isOne = names.size() == 1 || names[0] == "red";
    for (std::size_t i = 0; i < names.size() && !isTaken && isOne; ++i)
    {
      columns.push_back({ names[i], type, array, static_cast<int>(i) });
    }
  }
  return columns;
}

template <typename T>
void WriteNumber(std::ostream& out, T number)
{
  out.write(reinterpret_cast<const char*>(&number), sizeof(number));
}

void WriteRow(std::ostream& out, const std::vector<PlyProperty>& columns, vtkIdType tuple)
{
  for (const PlyProperty& column : columns)
  {
    const double value = column.Array->GetComponent(tuple, column.Component);
    switch (column.Type)
    {
      vtkTemplateMacro(WriteNumber(out, static_cast<VTK_TT>(value)));
    }
  }
}

}

void WritePly(vtkPolyData* mesh, const std::string& path)
{
  const vtkIdType size = mesh->GetNumberOfPoints();
  if (size > VTK_INT_MAX)
  {
    throw CommandError(ExitCode::BadFile, "more points than this file format can number");
  }
  const std::vector<PlyProperty> columns = PlanColumns(mesh);
  const bool isShort = mesh->GetPolys()->GetMaxCellSize() < 256;
  std::ostringstream edges;
  ForEachCell(mesh->GetLines(),
    [&edges](vtkIdType count, const vtkIdType* points)
    {
      for (vtkIdType end = 1; end < count; ++end)
      {
        WriteNumber(edges, static_cast<std::int32_t>(points[end - 1]));
        WriteNumber(edges, static_cast<std::int32_t>(points[end]));
      }
    });

  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\ncomment written by delaunay-flip\nelement vertex "
      << size << '\n';
  for (const PlyProperty& column : columns)
  {
    out << "property " << NameOf(column.Type) << ' ' << column.Name << '\n';
  }
  out << "element face " << mesh->GetNumberOfPolys() << "\nproperty list "
      << (isShort ? "uchar" : "int") << " int vertex_indices\n";
  const std::vector<PlyProperty> ofFaces = PlanFaceColumns(mesh);
  for (const PlyProperty& column : ofFaces)
  {
    out << "property " << NameOf(column.Type) << ' ' << column.Name << '\n';
  }
  if (const std::size_t bytes = edges.str().size())
  {
    out << "element edge " << bytes / 8 << "\nproperty int vertex1\nproperty int vertex2\n";
  }
  out << "end_header\n";
  for (vtkIdType point = 0; point < size; ++point)
  {
    WriteRow(out, columns, point);
  }
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  ForEachCell(mesh->GetPolys(),
    [&](vtkIdType count, const vtkIdType* points)
    {
      if (isShort)
      {
        WriteNumber(out, static_cast<std::uint8_t>(count));
      }
      else
      {
        WriteNumber(out, static_cast<std::int32_t>(count));
      }
      std::for_each(points, points + count,
        [&out](vtkIdType point) { WriteNumber(out, static_cast<std::int32_t>(point)); });
      WriteRow(out, ofFaces, cell++);
    });
  out << edges.str();
}

HeldArrays ArraysOfPly(vtkPolyData* mesh)
{
  HeldArrays held;
  for (const PlyProperty& column : PlanColumns(mesh))
  {
    held.OfPoints.push_back(column.Array);
  }
  for (const PlyProperty& column : PlanFaceColumns(mesh))
  {
    held.OfCells.push_back(column.Array);
  }
  return held;
}

}
