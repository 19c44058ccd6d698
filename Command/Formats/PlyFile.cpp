// SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
// SPDX-License-Identifier: BSD-3-Clause
#include "CommandError.h"
#include "Formats.h"
#include "InputFile.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

/// @file
/// .ply: a header lists elements (vertex, face, edge) with their number and properties; their
/// values follow as text or as binary numbers of either byte order.

namespace delaunayflip
{

namespace
{

/// The types, each by two names; the first is written.
constexpr std::pair<const char*, int> Types[] = { { "char", VTK_SIGNED_CHAR },
  { "int8", VTK_SIGNED_CHAR }, { "uchar", VTK_UNSIGNED_CHAR }, { "uint8", VTK_UNSIGNED_CHAR },
  { "short", VTK_SHORT }, { "int16", VTK_SHORT }, { "ushort", VTK_UNSIGNED_SHORT },
  { "uint16", VTK_UNSIGNED_SHORT }, { "int", VTK_INT }, { "int32", VTK_INT },
  { "uint", VTK_UNSIGNED_INT }, { "uint32", VTK_UNSIGNED_INT }, { "float", VTK_FLOAT },
  { "float32", VTK_FLOAT }, { "double", VTK_DOUBLE }, { "float64", VTK_DOUBLE } };

using Names = std::vector<std::string>;

constexpr int NoAttribute = -1;

/// Properties that together are an array.
struct PlyGroup
{
  std::string Array;
  Names Properties;
  int Attribute; ///< What the array is for VTK.
};

const char* const PointsName = "x y z"; // no property can have these two names
const char* const EdgesName = "vertex1 vertex2";

/// Larger groups first.
const PlyGroup Groups[] = {
  { PointsName, { "x", "y", "z" }, NoAttribute },
  { EdgesName, { "vertex1", "vertex2" }, NoAttribute },
  { "Normals", { "nx", "ny", "nz" }, vtkDataSetAttributes::NORMALS },
  { "RGBA", { "red", "green", "blue", "alpha" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "red", "green", "blue" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "diffuse_red", "diffuse_green", "diffuse_blue" }, vtkDataSetAttributes::SCALARS },
  { "TCoords", { "u", "v" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "s", "t" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "texture_u", "texture_v" }, vtkDataSetAttributes::TCOORDS },
};

struct PlyProperty
{
  std::string Name;
  int Type;
  vtkDataArray* Array = nullptr; ///< Has the values of a scalar property.
  int Component = 0;
  int CountType = VTK_VOID; ///< Of a list, the type of its length.

  bool IsList() const { return this->CountType != VTK_VOID; }
};

struct PlyElement
{
  std::string Name;
  std::int64_t Count;
  std::vector<PlyProperty> Properties;
};

template <typename Thing>
Thing* Find(std::vector<Thing>& things, const std::string& name)
{
  const auto found = std::find_if(
    things.begin(), things.end(), [&name](const Thing& thing) { return thing.Name == name; });
  return found != things.end() ? &*found : nullptr;
}

/// Makes arrays of `size` tuples for the scalar properties of an element: one for each group that
/// is complete, and one for each other property.
void AddArrays(PlyElement& element, std::int64_t size, vtkDataSetAttributes* data)
{
  std::vector<PlyGroup> groups(std::begin(Groups), std::end(Groups));
  for (const PlyProperty& property : element.Properties)
  {
    groups.push_back({ property.Name, { property.Name }, NoAttribute });
  }
  for (const PlyGroup& group : groups)
  {
    std::vector<PlyProperty*> parts;
    for (const std::string& name : group.Properties)
    {
      PlyProperty* const property = Find(element.Properties, name);
      if (property && !property->Array && !property->IsList())
      {
        parts.push_back(property);
      }
    }
    const bool isTaken = group.Properties.size() > 1 &&
      (Find(element.Properties, group.Array) || data->HasArray(group.Array.c_str()));
    if (isTaken || parts.size() < group.Properties.size())
    {
      continue;
    }
    const int type = parts.front()->Type;
    const bool isUniform = std::all_of(
      parts.begin(), parts.end(), [type](const PlyProperty* part) { return part->Type == type; });
    const bool keepsType = isUniform && (group.Array != PointsName || type == VTK_FLOAT);
    const auto array =
      vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(keepsType ? type : VTK_DOUBLE));
    array->SetName(group.Array.c_str());
    array->SetNumberOfComponents(static_cast<int>(parts.size()));
    array->SetNumberOfTuples(size);
    array->Fill(0.0);
    data->AddArray(array);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      parts[i]->Array = array;
      parts[i]->Component = static_cast<int>(i);
    }
    if (group.Attribute != NoAttribute)
    {
      data->SetActiveAttribute(group.Array.c_str(), group.Attribute);
    }
  }
}

class PlyReader
{
public:
  explicit PlyReader(const InputFile& file)
    : File(file),
      Lines(file)
  {
  }

  FileMesh Read()
  {
    this->ReadHeader();
    for (PlyElement& element : this->Elements)
    {
      if (element.Count > 0 || element.Name == "vertex")
      {
        this->ReadElement(element);
      }
    }
    const std::size_t rest = this->Lines.Rest.size();
    if (rest > 0 && (!this->IsText || this->Lines.Next()))
    {
      this->Warn(
        "left out " + Counted(static_cast<std::int64_t>(rest), "byte") + " after its last element");
    }
    if (!this->Result.Mesh->GetPoints())
    {
      this->File.Fail("has no vertices x, y and z");
    }
    return this->Result;
  }

private:
  void ReadHeader()
  {
    if (!this->Lines.Next() || this->Lines.Words[0] != "ply")
    {
      this->File.Fail("not a PLY file (it does not start with 'ply')");
    }
    std::string format;
    for (std::string keyword; keyword != "end_header";)
    {
      if (!this->Lines.Next())
      {
        this->File.Fail("its header has no end (truncated or corrupt)");
      }
      keyword = this->Lines.Words[0];
      if (keyword == "format")
      {
        format = this->Word(1);
      }
      else if (keyword == "element")
      {
        const auto count = this->Lines.Number<std::int64_t>(2);
        if (count < 0 || Find(this->Elements, this->Word(1)))
        {
          this->Lines.Fail("a negative number of elements, or a second definition of them");
        }
        this->Elements.push_back({ this->Word(1), count, {} });
      }
      else if (keyword == "property" && !this->Elements.empty())
      {
        const bool isList = this->Word(1) == "list";
        const std::size_t type = isList ? 3 : 1;
        const int countType = isList ? this->TypeAt(2) : VTK_VOID;
        auto& properties = this->Elements.back().Properties;
        if (countType >= VTK_FLOAT || Find(properties, this->Word(type + 1)))
        {
          this->Lines.Fail("a list whose length is no integer, or a second property of this name");
        }
        properties.push_back({ this->Word(type + 1), this->TypeAt(type), nullptr, 0, countType });
      }
      else if (keyword != "comment" && keyword != "obj_info" && keyword != "end_header" &&
        keyword != "Created") // by Open Asset Import Library
      {
        this->Lines.Fail("not a line of a PLY header");
      }
    }
    this->IsText = format == "ascii";
    this->IsSwapped = format == "binary_big_endian";
    if (!this->IsText && !this->IsSwapped && format != "binary_little_endian")
    {
      this->File.Fail("unknown format '" + format + "' in its header");
    }
  }

  std::string Word(std::size_t place) const
  {
    return std::string(place < this->Lines.Words.size() ? this->Lines.Words[place] : "");
  }

  int TypeAt(std::size_t place) const
  {
    const std::string name = this->Word(place);
    for (const auto& [known, type] : Types)
    {
      if (name == known)
      {
        return type;
      }
    }
    this->Lines.Fail("unknown type of a property");
  }

  void ReadElement(PlyElement& element)
  {
    // A value takes a byte at least.
    const std::size_t values = std::max<std::size_t>(element.Properties.size(), 1);
    if (static_cast<std::size_t>(element.Count) > this->Lines.Rest.size() / values)
    {
      this->File.Fail("its header says 'element " + element.Name + " " +
        std::to_string(element.Count) + "', too many for the " +
        Counted(static_cast<std::int64_t>(this->Lines.Rest.size()), "byte") +
        " left (truncated or corrupt)");
    }
    const bool isFace = element.Name == "face";
    const bool isKnown = isFace || element.Name == "vertex" || element.Name == "edge";
    const PlyProperty* corners = nullptr;
    for (const PlyProperty& property : element.Properties)
    {
      if (property.IsList() && !isKnown)
      {
        this->File.Fail("holds '" + element.Name +
          "', which may hold polygons; known elements are vertex, face and edge");
      }
      if (isFace && property.IsList() && property.Type < VTK_FLOAT && !corners &&
        (property.Name == "vertex_indices" || property.Name == "vertex_index"))
      {
        corners = &property;
      }
      else if (property.IsList())
      {
        this->Warn("left out the lists " + property.Name + " of the element " + element.Name);
      }
    }
    if (isFace && !corners)
    {
      this->File.Fail("its element face needs a list of vertex_indices");
    }
    if (!isKnown)
    {
      this->Warn("left out " + Counted(element.Count, "element") + " of the unknown type '" +
        element.Name + "'");
    }
    const PlyElement* const edges = isFace ? Find(this->Elements, "edge") : nullptr;
    const std::int64_t before = edges ? edges->Count : 0; // cell data begin with lines
    const vtkNew<vtkCellData> data;
    AddArrays(element, before + element.Count, data);
    for (std::int64_t row = 0; row < element.Count; ++row)
    {
      this->Place = 0;
      if (this->IsText)
      {
        this->Lines.Next(); // without words where the file ends
      }
      for (const PlyProperty& property : element.Properties)
      {
        if (property.Array)
        {
          property.Array->SetComponent(before + row, property.Component, this->Next(property.Type));
        }
        else
        {
          this->ReadList(property, &property == corners);
        }
      }
      if (this->IsText && this->Place < this->Lines.Words.size())
      {
        this->Lines.Fail("more values than the header says");
      }
    }
    this->Take(element.Name, data);
  }

  void ReadList(const PlyProperty& list, bool isPolygon)
  {
    const auto length = static_cast<std::int64_t>(this->Next(list.CountType));
    if (static_cast<std::uint64_t>(length) > this->File.GetBytes().size())
    {
      this->File.Fail("a list of length " + std::to_string(length) + " (corrupt)");
    }
    if (isPolygon)
    {
      this->Polygons->InsertNextCell(static_cast<int>(length));
    }
    for (std::int64_t i = 0; i < length; ++i)
    {
      const double item = this->Next(list.Type);
      if (isPolygon)
      {
        this->Polygons->InsertCellPoint(static_cast<vtkIdType>(item));
      }
    }
  }

  /// Takes an element that has been read.
  void Take(const std::string& name, vtkDataSetAttributes* data)
  {
    vtkPolyData* const mesh = this->Result.Mesh;
    if (name == "vertex" && data->HasArray(PointsName))
    {
      const vtkNew<vtkPoints> points;
      points->SetData(data->GetArray(PointsName));
      mesh->SetPoints(points);
      data->RemoveArray(PointsName);
      mesh->GetPointData()->ShallowCopy(data);
    }
    else if (name == "face")
    {
      mesh->SetPolys(this->Polygons);
      mesh->GetCellData()->ShallowCopy(data);
    }
    else if (name == "edge")
    {
      vtkDataArray* const ends = data->GetArray(EdgesName);
      if (!ends)
      {
        this->File.Fail("its edges have no vertex1 and vertex2");
      }
      const vtkNew<vtkCellArray> lines;
      for (vtkIdType edge = 0; edge < ends->GetNumberOfTuples(); ++edge)
      {
        lines->InsertNextCell({ static_cast<vtkIdType>(ends->GetComponent(edge, 0)),
          static_cast<vtkIdType>(ends->GetComponent(edge, 1)) });
      }
      mesh->SetLines(lines);
      if (data->GetNumberOfArrays() > 1)
      {
        this->Warn("left out the other properties of its edges");
      }
    }
  }

  /// A double holds all numbers of a .ply.
  double Next(int type)
  {
    switch (type)
    {
      vtkTemplateMacro(return static_cast<double>(this->NextOf<VTK_TT>()));
    }
    return 0.0;
  }

  template <typename T>
  T NextOf()
  {
    if (this->IsText)
    {
      return this->Lines.Number<T>(this->Place++);
    }
    T value;
    char bytes[sizeof(T)];
    if (this->Lines.Rest.size() < sizeof(T))
    {
      this->File.Fail("ends before its last value (truncated or corrupt)");
    }
    std::memcpy(bytes, this->Lines.Rest.data(), sizeof(T));
    this->Lines.Rest.remove_prefix(sizeof(T));
    if (this->IsSwapped)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  void Warn(const std::string& warning)
  {
    this->Result.Warnings.push_back(this->File.GetName() + ": " + warning);
  }

  const InputFile& File;
  TextLines Lines; ///< The header, and the values behind it, which may be binary.
  bool IsText = false;
  bool IsSwapped = false;
  std::vector<PlyElement> Elements;
  vtkNew<vtkCellArray> Polygons;
  std::size_t Place = 0; ///< Of the next word in a line of values.
  FileMesh Result;
};

const char* NameOf(int type)
{
  const auto* const found = std::find_if(std::begin(Types), std::end(Types),
    [type](const auto& candidate) { return candidate.second == type; });
  return found == std::end(Types) ? nullptr : found->first;
}

/// The type of a .ply that holds all values of an array; VTK_VOID if none does.
int TypeFor(vtkDataArray* array)
{
  const int type = array->GetDataType() == VTK_CHAR ? VTK_SIGNED_CHAR
    : array->GetDataType() == VTK_BIT               ? VTK_UNSIGNED_CHAR
                                                    : array->GetDataType();
  bool isExact = true;
  for (int component = 0; component < array->GetNumberOfComponents() && !NameOf(type); ++component)
  {
    double range[2];
    array->GetRange(range, component);
    isExact = isExact && std::max(-range[0], range[1]) < 9007199254740992.0; // 2^53
  }
  return NameOf(type) ? type : isExact ? VTK_DOUBLE : VTK_VOID;
}

/// The names by which other programs know an array, else its own, as one word.
Names PropertyNames(vtkDataSetAttributes* data, vtkDataArray* array)
{
  std::string name = array->GetName() && *array->GetName() ? array->GetName() : "values";
  const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
  for (const PlyGroup& group : Groups)
  {
    const bool isColor = group.Attribute == vtkDataSetAttributes::SCALARS;
    const bool isActive = group.Attribute != NoAttribute &&
      array == data->GetAbstractAttribute(group.Attribute) &&
      (!isColor || array->GetDataType() == VTK_UNSIGNED_CHAR);
    if (group.Properties.size() == components && (isActive || (isColor && name == group.Array)))
    {
      return group.Properties;
    }
  }
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isspace(c) || std::iscntrl(c); },
    '_');
  Names names;
  for (std::size_t component = 0; component < components; ++component)
  {
    names.push_back(components == 1 ? name : name + "_" + std::to_string(component));
  }
  return names;
}

/// The properties of vertices or faces. Leaves out arrays that a .ply cannot hold: strings, too
/// large integers, and those whose names are used by an earlier array, coordinates or indices.
std::vector<PlyProperty> PlanColumns(vtkPolyData* mesh, bool ofPoints)
{
  std::vector<PlyProperty> columns;
  Names taken = ofPoints ? Names{ "x", "y", "z" } : Names{ "vertex_indices", "vertex_index" };
  vtkDataArray* const coordinates = mesh->GetPoints()->GetData();
  const int real = coordinates->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  for (int axis = 0; axis < 3 && ofPoints; ++axis)
  {
    columns.push_back({ taken[static_cast<std::size_t>(axis)], real, coordinates, axis });
  }
  vtkDataSetAttributes* const data =
    mesh->GetAttributes(ofPoints ? vtkPolyData::POINT : vtkPolyData::CELL);
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
    const vtkIdType size = ofPoints ? mesh->GetNumberOfPoints() : mesh->GetNumberOfCells();
    const int type = array && array->GetNumberOfTuples() >= size ? TypeFor(array) : VTK_VOID;
    const Names names = type == VTK_VOID ? Names() : PropertyNames(data, array);
    const bool isTaken =
      std::find_first_of(names.begin(), names.end(), taken.begin(), taken.end()) != names.end();
    for (std::size_t component = 0; component < names.size() && !isTaken; ++component)
    {
      columns.push_back({ names[component], type, array, static_cast<int>(component) });
      taken.push_back(names[component]);
    }
  }
  return columns;
}

void WriteProperties(std::ostream& out, const std::vector<PlyProperty>& columns)
{
  for (const PlyProperty& column : columns)
  {
    out << "property " << NameOf(column.Type) << ' ' << column.Name << '\n';
  }
}

template <typename T>
void WriteNumber(std::ostream& out, T number)
{
  out.write(reinterpret_cast<const char*>(&number), sizeof(number));
}

void WriteValues(std::ostream& out, const std::vector<PlyProperty>& columns, vtkIdType tuple)
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

FileMesh ReadPly(const InputFile& file) { return PlyReader(file).Read(); }

void WritePly(vtkPolyData* mesh, const std::string& path)
{
  const vtkIdType size = mesh->GetNumberOfPoints();
  if (size > std::numeric_limits<std::int32_t>::max())
  {
    throw CommandError(ExitCode::BadFile, "more points than this file format can number");
  }
  const std::vector<PlyProperty> vertices = PlanColumns(mesh, true);
  const std::vector<PlyProperty> faces = PlanColumns(mesh, false);
  const bool isShort = mesh->GetPolys()->GetMaxCellSize() < 256;
  std::vector<std::int32_t> edges; // two points each
  ForEachCell(mesh->GetLines(),
    [&edges](vtkIdType count, const vtkIdType* points)
    {
      for (vtkIdType end = 1; end < count; ++end)
      {
        edges.push_back(static_cast<std::int32_t>(points[end - 1]));
        edges.push_back(static_cast<std::int32_t>(points[end]));
      }
    });

  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\ncomment written by delaunay-flip\nelement vertex "
      << size << '\n';
  WriteProperties(out, vertices);
  out << "element face " << mesh->GetNumberOfPolys() << "\nproperty list "
      << (isShort ? "uchar" : "int") << " int vertex_indices\n";
  WriteProperties(out, faces);
  if (!edges.empty())
  {
    out << "element edge " << edges.size() / 2 << "\nproperty int vertex1\nproperty int vertex2\n";
  }
  out << "end_header\n";
  for (vtkIdType point = 0; point < size; ++point)
  {
    WriteValues(out, vertices, point);
  }
  vtkIdType cell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  ForEachCell(mesh->GetPolys(),
    [&](vtkIdType count, const vtkIdType* points)
    {
      isShort ? WriteNumber(out, static_cast<std::uint8_t>(count))
              : WriteNumber(out, static_cast<std::int32_t>(count));
      std::for_each(points, points + count,
        [&out](vtkIdType point) { WriteNumber(out, static_cast<std::int32_t>(point)); });
      WriteValues(out, faces, cell++);
    });
  out.write(reinterpret_cast<const char*>(edges.data()),
    static_cast<std::streamsize>(edges.size() * sizeof(edges[0])));
  out.close();
  if (!out)
  {
    throw CommandError(ExitCode::BadFile, "the file is incomplete");
  }
}

std::vector<vtkAbstractArray*> ArraysOfPly(vtkPolyData* mesh, bool ofPoints)
{
  std::vector<vtkAbstractArray*> arrays;
  for (const PlyProperty& column : PlanColumns(mesh, ofPoints))
  {
    arrays.push_back(column.Array);
  }
  return arrays;
}

}
