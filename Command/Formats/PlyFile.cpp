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

/// @file
/// .ply: a header lists elements (vertex, face, edge) with their number and properties; their
/// values follow as text or as binary numbers of either byte order.

namespace delaunayflip
{

namespace
{

struct PlyType
{
  const char* Name;
  const char* OtherName;
  int VtkType;
};

constexpr PlyType Types[] = { { "char", "int8", VTK_SIGNED_CHAR },
  { "uchar", "uint8", VTK_UNSIGNED_CHAR }, { "short", "int16", VTK_SHORT },
  { "ushort", "uint16", VTK_UNSIGNED_SHORT }, { "int", "int32", VTK_INT },
  { "uint", "uint32", VTK_UNSIGNED_INT }, { "float", "float32", VTK_FLOAT },
  { "double", "float64", VTK_DOUBLE } };

using Names = std::vector<std::string>;

/// Properties that together are an array.
struct PlyGroup
{
  const char* Array;
  Names Properties;
  int Attribute; ///< What the array is for VTK.
};

const char* const PointsName = "x y z"; // no property can have it

/// Larger groups first.
const PlyGroup Groups[] = {
  { PointsName, { "x", "y", "z" }, vtkDataSetAttributes::VECTORS },
  { "Normals", { "nx", "ny", "nz" }, vtkDataSetAttributes::NORMALS },
  { "RGBA", { "red", "green", "blue", "alpha" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "red", "green", "blue" }, vtkDataSetAttributes::SCALARS },
  { "RGB", { "diffuse_red", "diffuse_green", "diffuse_blue" }, vtkDataSetAttributes::SCALARS },
  { "TCoords", { "u", "v" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "s", "t" }, vtkDataSetAttributes::TCOORDS },
  { "TCoords", { "texture_u", "texture_v" }, vtkDataSetAttributes::TCOORDS },
};

/// Replaces arrays of one component by the arrays of their groups.
void JoinGroups(vtkDataSetAttributes* data)
{
  for (const PlyGroup& group : Groups)
  {
    const bool isThere = std::all_of(group.Properties.begin(), group.Properties.end(),
      [data](const std::string& name) { return data->HasArray(name.c_str()); });
    if (!isThere || data->HasArray(group.Array))
    {
      continue;
    }
    const int first = data->GetArray(group.Properties[0].c_str())->GetDataType();
    const bool isUniform = std::all_of(group.Properties.begin(), group.Properties.end(),
      [&](const std::string& name)
      { return data->GetArray(name.c_str())->GetDataType() == first; });
    const bool keepsType = isUniform && (group.Array != PointsName || first == VTK_FLOAT);
    const auto joined =
      vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(keepsType ? first : VTK_DOUBLE));
    joined->SetName(group.Array);
    joined->SetNumberOfComponents(static_cast<int>(group.Properties.size()));
    joined->SetNumberOfTuples(data->GetNumberOfTuples());
    for (std::size_t i = 0; i < group.Properties.size(); ++i)
    {
      const char* const name = group.Properties[i].c_str();
      joined->CopyComponent(static_cast<int>(i), data->GetArray(name), 0);
      data->RemoveArray(name);
    }
    data->AddArray(joined);
    data->SetActiveAttribute(group.Array, group.Attribute);
  }
}

struct PlyProperty
{
  std::string Name;
  int Type;
  int CountType; ///< Of a list, the type of its length; else VTK_VOID.
};

struct PlyElement
{
  std::string Name;
  std::int64_t Count;
  std::vector<PlyProperty> Properties;
};

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
    for (const PlyElement& element : this->Elements)
    {
      this->ReadElement(element);
    }
    const std::string_view rest = this->IsText ? this->Lines.GetRest() : this->Rest;
    if (!rest.empty() && (!this->IsText || this->Lines.Next()))
    {
      this->Warn("left out " + Counted(static_cast<std::int64_t>(rest.size()), "byte") +
        " after its last element");
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
        if (count < 0 || HasName(this->Elements, this->Word(1)))
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
        if (countType == VTK_FLOAT || countType == VTK_DOUBLE ||
          HasName(properties, this->Word(type + 1)))
        {
          this->Lines.Fail("a list whose length is no integer, or a second property of this name");
        }
        properties.push_back({ this->Word(type + 1), this->TypeAt(type), countType });
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
    this->Rest = this->Lines.GetRest();
    this->Vertices = this->CountOf("vertex");
  }

  std::string Word(std::size_t place) const
  {
    return std::string(place < this->Lines.Words.size() ? this->Lines.Words[place] : "");
  }

  int TypeAt(std::size_t place) const
  {
    const std::string name = this->Word(place);
    for (const PlyType& type : Types)
    {
      if (name == type.Name || name == type.OtherName)
      {
        return type.VtkType;
      }
    }
    this->Lines.Fail("unknown type of a property");
  }

  template <typename Things>
  static bool HasName(const Things& things, const std::string& name)
  {
    return std::any_of(
      things.begin(), things.end(), [&name](const auto& thing) { return thing.Name == name; });
  }

  std::int64_t CountOf(const std::string& name) const
  {
    std::int64_t count = 0;
    for (const PlyElement& element : this->Elements)
    {
      count += element.Name == name ? element.Count : 0;
    }
    return count;
  }

  static bool IsIndexList(const PlyElement& element, const PlyProperty& property)
  {
    return element.Name == "face" && property.CountType != VTK_VOID && property.Type < VTK_FLOAT &&
      (property.Name == "vertex_indices" || property.Name == "vertex_index");
  }

  void ReadElement(const PlyElement& element)
  {
    const bool isFace = element.Name == "face";
    const bool isVertex = element.Name == "vertex";
    const bool isKnown = isFace || isVertex || element.Name == "edge";
    if (element.Count == 0 && !isVertex)
    {
      return;
    }
    // A value takes a byte at least.
    const std::size_t bytes = this->IsText ? this->Lines.GetRest().size() : this->Rest.size();
    const std::size_t values = std::max<std::size_t>(element.Properties.size(), 1);
    if (static_cast<std::size_t>(element.Count) > bytes / values)
    {
      this->File.Fail("its header says 'element " + element.Name + " " +
        std::to_string(element.Count) + "', too many for the " +
        Counted(static_cast<std::int64_t>(bytes), "byte") + " left (truncated or corrupt)");
    }
    this->Element = element.Name;
    const std::int64_t before = isFace ? this->CountOf("edge") : 0; // cell data begin with lines
    const vtkNew<vtkCellData> data;
    std::vector<vtkSmartPointer<vtkDataArray>> columns(element.Properties.size()); // null for lists
    int indexLists = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const PlyProperty& property = element.Properties[i];
      if (property.CountType == VTK_VOID)
      {
        columns[i] = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(property.Type));
        columns[i]->SetName(property.Name.c_str());
        columns[i]->SetNumberOfTuples(before + element.Count);
        columns[i]->Fill(0.0);
        data->AddArray(columns[i]);
      }
      else if (IsIndexList(element, property))
      {
        ++indexLists;
      }
      else if (isKnown)
      {
        this->Warn("left out the lists " + property.Name + " of the element " + element.Name);
      }
      else
      {
        this->File.Fail("holds '" + element.Name +
          "', which may hold polygons; known elements are vertex, face and edge");
      }
    }
    if (isFace && indexLists != 1)
    {
      this->File.Fail("its element face needs one list of vertex_indices");
    }
    if (!isKnown)
    {
      this->Warn("left out " + Counted(element.Count, "element") + " of the unknown type '" +
        element.Name + "'");
    }
    this->ReadRows(element, columns, before);
    if (element.Name == "edge")
    {
      this->TakeEdges(data);
      return;
    }
    JoinGroups(data);
    if (isVertex && data->HasArray(PointsName))
    {
      const vtkNew<vtkPoints> points;
      points->SetData(data->GetArray(PointsName));
      data->RemoveArray(PointsName);
      this->Result.Mesh->SetPoints(points);
      this->Result.Mesh->GetPointData()->ShallowCopy(data);
    }
    else if (isFace)
    {
      this->Result.Mesh->GetCellData()->ShallowCopy(data);
    }
  }

  void ReadRows(const PlyElement& element,
    const std::vector<vtkSmartPointer<vtkDataArray>>& columns, std::int64_t before)
  {
    const vtkNew<vtkCellArray> polys;
    for (this->Row = 0; this->Row < element.Count; ++this->Row)
    {
      this->Place = 0;
      if (this->IsText && !this->Lines.Next())
      {
        this->Fail("the file ends here (truncated or corrupt)");
      }
      for (std::size_t i = 0; i < columns.size(); ++i)
      {
        const PlyProperty& property = element.Properties[i];
        if (columns[i])
        {
          columns[i]->SetComponent(before + this->Row, 0, this->Next(property.Type));
        }
        else
        {
          this->ReadList(property, IsIndexList(element, property) ? polys.Get() : nullptr);
        }
      }
      if (this->IsText && this->Place < this->Lines.Words.size())
      {
        this->Fail("more values than the header says");
      }
    }
    if (element.Name == "face")
    {
      this->Result.Mesh->SetPolys(polys);
    }
  }

  void ReadList(const PlyProperty& list, vtkCellArray* cells)
  {
    const auto length = static_cast<std::int64_t>(this->Next(list.CountType));
    const std::size_t left =
      this->IsText ? this->Lines.Words.size() - this->Place : this->Rest.size();
    if (length < 0 || static_cast<std::size_t>(length) > left)
    {
      this->Fail("a list of length " + std::to_string(length) + ", but the values end before");
    }
    if (cells)
    {
      cells->InsertNextCell(static_cast<int>(length));
    }
    for (std::int64_t i = 0; i < length; ++i)
    {
      const double item = this->Next(list.Type);
      if (cells)
      {
        cells->InsertCellPoint(this->RequireVertex(item));
      }
    }
  }

  /// An edge is two scalar properties.
  void TakeEdges(vtkDataSetAttributes* data)
  {
    vtkDataArray* const ends[] = { data->GetArray("vertex1"), data->GetArray("vertex2") };
    if (!ends[0] || !ends[1])
    {
      this->File.Fail("its edges have no vertex1 and vertex2");
    }
    const vtkNew<vtkCellArray> lines;
    this->Lines.Words.clear(); // an error is not in the last line
    for (this->Row = 0; this->Row < ends[0]->GetNumberOfTuples(); ++this->Row)
    {
      lines->InsertNextCell(2);
      lines->InsertCellPoint(this->RequireVertex(ends[0]->GetTuple1(this->Row)));
      lines->InsertCellPoint(this->RequireVertex(ends[1]->GetTuple1(this->Row)));
    }
    this->Result.Mesh->SetLines(lines);
    if (data->GetNumberOfArrays() > 2)
    {
      this->Warn("left out the other properties of its edges");
    }
  }

  vtkIdType RequireVertex(double number) const
  {
    if (!(number >= 0 && number < static_cast<double>(this->Vertices)))
    {
      this->Fail("vertex " + std::to_string(static_cast<std::int64_t>(number)) +
        " is out of range; the number of vertices is " + std::to_string(this->Vertices));
    }
    return static_cast<vtkIdType>(number);
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
    if (this->Rest.size() < sizeof(T))
    {
      this->Fail("the file ends here (truncated or corrupt)");
    }
    std::memcpy(bytes, this->Rest.data(), sizeof(T));
    this->Rest.remove_prefix(sizeof(T));
    if (this->IsSwapped)
    {
      std::reverse(bytes, bytes + sizeof(T));
    }
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  [[noreturn]] void Fail(const std::string& reason) const
  {
    if (this->IsText && !this->Lines.Words.empty())
    {
      this->Lines.Fail(reason);
    }
    this->File.Fail(this->Element + " " + std::to_string(this->Row) + ": " + reason);
  }

  void Warn(const std::string& warning)
  {
    this->Result.Warnings.push_back(this->File.GetName() + ": " + warning);
  }

  const InputFile& File;
  TextLines Lines; ///< The header; if the values are text, these too.
  std::string_view Rest; ///< Binary values that are not read yet.
  bool IsText = false;
  bool IsSwapped = false;
  std::vector<PlyElement> Elements;
  std::int64_t Vertices = 0;
  std::string Element; ///< The kind being read.
  std::int64_t Row = 0; ///< Its number.
  std::size_t Place = 0; ///< Of the next word in this row.
  FileMesh Result;
};

/// A scalar property to be written: a component of an array.
struct PlyColumn
{
  std::string Name;
  int Type;
  vtkDataArray* Array;
  int Component;
};

const char* NameOf(int type)
{
  const auto* const found = std::find_if(std::begin(Types), std::end(Types),
    [type](const PlyType& candidate) { return candidate.VtkType == type; });
  return found == std::end(Types) ? nullptr : found->Name;
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
    const bool isActive = array == data->GetAbstractAttribute(group.Attribute) &&
      (!isColor || array->GetDataType() == VTK_UNSIGNED_CHAR);
    if (group.Properties.size() == components && group.Array != PointsName &&
      (isActive || (isColor && name == group.Array)))
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

/// The properties for the arrays of points or cells. Leaves out arrays that a .ply cannot hold:
/// strings, too large integers, and those whose names are `taken` or used by an earlier array.
std::vector<PlyColumn> PlanColumns(vtkDataSetAttributes* data, vtkIdType size, Names taken)
{
  std::vector<PlyColumn> columns;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    vtkDataArray* const array = data->GetArray(index);
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

std::vector<PlyColumn> PlanVertices(vtkPolyData* mesh)
{
  return PlanColumns(mesh->GetPointData(), mesh->GetNumberOfPoints(), { "x", "y", "z" });
}

std::vector<PlyColumn> PlanFaces(vtkPolyData* mesh)
{
  return PlanColumns(
    mesh->GetCellData(), mesh->GetNumberOfCells(), { "vertex_indices", "vertex_index" });
}

void WriteProperties(std::ostream& out, const std::vector<PlyColumn>& columns)
{
  for (const PlyColumn& column : columns)
  {
    out << "property " << NameOf(column.Type) << ' ' << column.Name << '\n';
  }
}

template <typename T>
void WriteNumber(std::ostream& out, T number)
{
  out.write(reinterpret_cast<const char*>(&number), sizeof(number));
}

void WriteValues(std::ostream& out, const std::vector<PlyColumn>& columns, vtkIdType tuple)
{
  for (const PlyColumn& column : columns)
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
  vtkDataArray* const coordinates = mesh->GetPoints()->GetData();
  const int type = coordinates->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  std::vector<PlyColumn> vertices = { { "x", type, coordinates, 0 }, { "y", type, coordinates, 1 },
    { "z", type, coordinates, 2 } };
  const std::vector<PlyColumn> ofPoints = PlanVertices(mesh);
  vertices.insert(vertices.end(), ofPoints.begin(), ofPoints.end());
  const std::vector<PlyColumn> faces = PlanFaces(mesh);
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
  for (const PlyColumn& column : ofPoints ? PlanVertices(mesh) : PlanFaces(mesh))
  {
    arrays.push_back(column.Array);
  }
  return arrays;
}

}
